# What is drawn, and what it shows: figures/style.gp, which loads this, explains run(i), series, result and the rest.
name(i) = parameter_word(run(i), "physical.flow_rate")
shown = run(count) # the shapes are those of the last run
positions = sprintf("-4 -2 0 2 6 %g", result(shown, "x_g"))

eval figure("pressure", 12, 8)
set xlabel "{/:Italic x}_g / μm"; set ylabel "Δ{/:Italic P} / Pa"
set xrange [-200:500]; set yrange [0:*]
set key right bottom
pressures = ""
do for [i=1:count] {
  stats series_physical(run(i)) using "pressure_drop [Pa]" name "pressure" nooutput
  pressures = listed(pressures, sprintf("%.0f Pa at %s", pressure_max, name(i)))
}
plot for [i=1:count] series_physical(run(i)) using (1e6 * column("x_g [m]")):"pressure_drop [Pa]" with lines linetype i title name(i)
print "**Pressure.** Extra pressure drop that the capsule causes on its way into the tube and along it, at the most", \
  pressures."."

eval figure("shapes", 17, 4.8)
eval view(-5.2, 11.5, -2, 2)
set xtics 1; set ytics 1
plot @wall, for [p in positions] for [side=-1:1:2] \
  profiles(shown) using (at_x_g(p, "x")):(side * column("r")) with lines linetype 1
print sprintf("**Shapes.** The capsule on its way at %s: its membrane is stretched by at most %.0f %%", \
  name(count), 100 * (result(shown, "max_stretch") - 1)), \
  sprintf("in the end and leaves a film of %.3f tube radii.", result(shown, "min_film"))

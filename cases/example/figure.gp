# What is drawn, and what it shows: figures/style.gp, which loads this, explains run(i), series, result and the rest.
name(i) = parameter_word(run(i), "physical.flow_rate")

eval figure("pressure", 12, 8)
set xlabel "{/:Italic x}_g / μm"; set ylabel "Δ{/:Italic P} / Pa"
set yrange [0:*]
set key left top
pressures = ""
do for [i=1:count] {
  stats series_physical(run(i)) using "pressure_drop [Pa]" name "pressure" nooutput
  pressures = listed(pressures, sprintf("%.3g Pa at %s", pressure_max, name(i)))
}
plot for [i=1:count] series_physical(run(i)) using (1e6 * column("x_g [m]")):"pressure_drop [Pa]" with lines linetype i title name(i)
print "**Pressure.** Extra pressure drop that the capsule causes on its way into the tube and along it, at the most", \
  pressures."."

eval figure("shapes", 17, 1.6 + 3.1 * count)
set multiplot layout count, 1 margins 0.08, 0.99, 1.2 / (1.6 + 3.1 * count), 0.99 spacing 0, 0.02
stretches = ""; films = ""
do for [i=1:count] {
  last = result(run(i), "x_g")
  eval view(-5.2, last + 1.6, -1.6, 1.6)
  set xtics 1; set ytics 1
  if (i < count) { set format x ""; unset xlabel } else { set format x "%g" }
  set label 1 name(i) at last + 1.4, 1.3 right front
  positions = sprintf("-4 -2 0 2 4 6 8 %g", last)
  plot @wall, for [p in positions] outline(profiles(run(i)), "x_g", p + 0) using 1:2 with @capsule_fill, \
    for [p in positions] outline(profiles(run(i)), "x_g", p + 0) using 1:2 with lines linetype 1
  stretches = listed(stretches, sprintf("%.0f %%", 100 * (result(run(i), "max_stretch") - 1)))
  films = listed(films, sprintf("%.3f", result(run(i), "min_film")))
}
unset multiplot
print "**Shapes.** The capsule on its way, a row for each run. In the end its membrane is stretched by at most", \
  stretches, "and leaves a film of", films, "tube radii."

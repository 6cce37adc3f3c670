delta(i) = parameter(run(i), "membrane.bending_ratio")
name(i) = "{/:Italic δ} = ".(delta(i) == 0 ? "0" : gprintf("10^{%.4g}", log10(delta(i))))
end(i, quantity) = result(run(i), quantity)
# A run that fails between two profiles ends behind the last one.
last_profile(i) = number(system(sprintf("tail -n 1 %s | cut -d, -f2", quoted(profiles(run(i))))))
# Which runs wrinkled, which came through, and what is said of them.
wrinkled = ""; smooth = ""; wrinkled_at = ""; pressures = ""
do for [i=1:count] {
  if (result_word(run(i), "status") eq "failed") {
    wrinkled = wrinkled." ".i
    wrinkled_at = listed(wrinkled_at, sprintf("%.4g", end(i, "x_g")))
  } else {
    smooth = smooth." ".i
    pressures = listed(pressures, sprintf("%.4f for δ = %.0e", end(i, "pressure_drop"), delta(i)))
  }
}

# The tensions at the rear pole of the membrane without stiffness, at x_g = 1.
stats profiles(run(1)) using (column("S") == 0 ? at_x_g(1, "tension_meridional") : NaN) nooutput
rear_tension = STATS_mean

eval figure("fig02", 17, 6.2)
set multiplot
set origin 0, 0; set size 0.5, 1
eval view(-5.2, 3, -2, 2)
set xtics 1; set ytics 1
positions = sprintf("-4 -1.5 %.10g", last_profile(1))
plot @wall, for [p in positions] outline(profiles(run(1)), "x_g", p + 0) using 1:2 with @capsule_fill, \
  for [p in positions] outline(profiles(run(1)), "x_g", p + 0) using 1:2 with lines linetype 1
rear = number(system(sprintf("awk -F, 'NR > 1 && ($2 - %.10g)^2 < 1e-12 && $3 == 0 {printf \"%%.16e\", $4}' %s", \
  last_profile(1), quoted(profiles(run(1))))))
set origin 0.49, 0; set size noratio 0.24, 1
set xrange [rear - 0.005:rear + 0.035]; set yrange [-0.22:0.22]
unset ylabel; set xtics 0.02; set ytics 0.1
plot for [side=-1:1:2] profiles(run(1)) using (at_x_g(last_profile(1), "x")):(side * column("r")) with lines linetype 1 linewidth 1
set origin 0.72, 0; set size noratio 0.28, 1
set xrange [0:1.2]; set yrange [*:*]
set xlabel "{/:Italic S} / {/:Italic R}_t"; set ylabel "{/:Italic κ}_s {/:Italic R}_t"
set xtics 0.4; set ytics autofreq
set offsets 0, 0, graph 0.5, 0 # room for the key
set key at graph 1, 1 right top samplen 1
last_x_g = last_profile(1)
plot profiles(run(1)) using (at_x_g(last_x_g, "S")):"curvature_meridional" with lines linetype 2 linewidth 1 dashtype 1 \
    title sprintf("{/:Italic x}_g = %g", last_x_g), \
  profiles(run(1)) using (at_x_g(1, "S")):"curvature_meridional" with lines linetype 1 title "{/:Italic x}_g = 1"
unset multiplot
print "**Figure 2.** The capsule without bending stiffness as it enters (left), its rear in detail (centre, with axes of", \
  "different scale), and the curvature of its meridian from the rear pole on (right). At x_g = 1 the rear is smooth but compressed in both directions", \
  sprintf("(both tensions are %.3f G at the pole);", rear_tension), \
  sprintf("at x_g = %g it has wrinkled, in waves as short as the mesh allows.", end(1, "x_g"))

eval figure("fig03", 12, 8)
set xrange [-4:12]; set yrange [0:9.5]
set xlabel x_g_label; set ylabel pressure_label
set key at 12, 9.5 right top maxrows 2 width -1
set multiplot
plot for [i=1:count] series(run(i)) using "x_g":"pressure_drop" with lines linetype i title name(i), \
  for [i in wrinkled] $one using (end(i, "x_g")):(end(i, "pressure_drop")) with points linetype i+0 pointtype 2, \
  NaN with points linetype 1 pointtype 2 title "wrinkled"
set origin 0.48, 0.17; set size 0.49, 0.45
set xrange [0.9:2.3]; set yrange [3.5:4.3]
set xtics 0.5; set ytics 0.2
unset key; unset xlabel; unset ylabel
replot
unset multiplot
print "**Figure 3.** Extra pressure drop for different bending stiffnesses, and where they part. With the smallest", \
  sprintf("values of δ the membrane wrinkles (at x_g = %s). Where the stiffness prevents wrinkles it has a weak effect: at x_g = %g the pressure drop is %s.", \
    wrinkled_at, end(word(smooth, 1), "x_g"), pressures)

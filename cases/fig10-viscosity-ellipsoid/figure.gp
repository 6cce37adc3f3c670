lambda(i) = parameter(run(i), "flow.viscosity_ratio")
name(i) = sprintf("{/:Italic λ} = %g", lambda(i))
line(i) = linetype_of_ratio(lambda(i), i)
one = run_with("flow.viscosity_ratio", 1)
last_x_g = result(one, "x_g")
table3(i, quantity) = published(sprintf("T3-%g-%s", lambda(i), quantity))

eval table("table3")
print "λ,v_g,published,own error,ΔP_ss,published (± 0.05),own error,max abs(v_x - v_g),published,max abs(v_r),published"
do for [i=1:count] {
  print sprintf("%g,%.4f,%s,%.0e,%.3f,%s,%.0e,%.1e,%s,%.1e,%s", lambda(i), \
    result(run(i), "v_g"), cell("%.4f", table3(i, "vg")), error_of(run(i), "v_g"), \
    result(run(i), "pressure_drop"), cell("%.2f", table3(i, "dP")), error_of(run(i), "pressure_drop"), \
    result(run(i), "max_axial_residual"), cell("%.1e", table3(i, "vx")), \
    result(run(i), "max_radial_velocity"), cell("%.1e", table3(i, "vr")))
}
eval end_table("table3")

pressures = ""; marks = ""
lowest = result(one, "pressure_drop"); highest = lowest
do for [i=1:count] {
  marks = marks.mark(line(i), last_x_g, table3(i, "dP"))
  pressures = listed(pressures, distance(result(run(i), "pressure_drop"), table3(i, "dP")))
  lowest = result(run(i), "pressure_drop") < lowest ? result(run(i), "pressure_drop") : lowest
  highest = result(run(i), "pressure_drop") > highest ? result(run(i), "pressure_drop") : highest
}
marks = marks.marks_title(marks, "Table 3")
spread = 100 * (highest - lowest) / result(one, "pressure_drop")

eval figure("fig05b", 8.6, 5.6)
eval view(last_x_g - 1.14, last_x_g + 1.26, 0, 1.3)
set xtics 0.5; set ytics 0.5
set key at last_x_g + 0.5, 0.75
plot @wall, for [i=1:count] profiles(run(i)) using (at_x_g(last_x_g, "x")):"r" with lines linetype line(i) title name(i)
print sprintf("**Figure 5b.** Profiles of the ellipsoid at x_g = %g for different viscosity ratios: parachutes with", last_x_g), \
  sprintf("a sharp rim at the rear. The pressure drops still differ by %.1f %%.", spread)

eval figure("fig10", 12, 8)
set multiplot
set xrange [-4:12]; set yrange [0:50]
set xlabel x_g_label; set ylabel pressure_label
set key at 11.9, 1.5 right bottom maxrows 3 width -2
plot for [i=1:count] series(run(i)) using "x_g":"pressure_drop" with lines linetype line(i) title name(i) @marks
set origin 0.52, 0.5; set size 0.46, 0.46
set xrange [9:12]; set yrange [lowest - 0.3:lowest + 1.3]
set xtics 1; set ytics 0.5
unset key; unset xlabel; unset ylabel
replot
unset multiplot
peak(i) = sprintf("%.2f at x_g = %.2f for λ = %g", result(run(i), "peak_pressure_drop"), result(run(i), "x_g_at_peak"), \
  lambda(i))
print "**Figure 10.** Extra pressure drop of the ellipsoid: the entry peak, higher than the steady value, grows with the", \
  sprintf("viscosity ratio (%s, %s).", peak(1), peak(count)), \
  (pressures eq "" ? "" : "Distances to Table 3: ".pressures.".")

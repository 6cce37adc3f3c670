lambda(i) = parameter(run(i), "flow.viscosity_ratio")
name(i) = sprintf("{/:Italic λ} = %g", lambda(i))
line(i) = linetype_of_ratio(lambda(i), i)
one = run_with("flow.viscosity_ratio", 1)
last_x_g = result(one, "x_g")
table2(i, quantity) = published(sprintf("T2-%g-%s", lambda(i), quantity))

eval table("table2")
print "λ,v_g,published,own error,ΔP_ss,published,own error,max abs(v_x - v_g),published,max abs(v_r),published"
do for [i=1:count] {
  print sprintf("%g,%.4f,%s,%.0e,%.4f,%s,%.0e,%.2e,%s,%.2e,%s", lambda(i), \
    result(run(i), "v_g"), cell("%.4f", table2(i, "vg")), error_of(run(i), "v_g"), \
    result(run(i), "pressure_drop"), cell("%.4f", table2(i, "dP")), error_of(run(i), "pressure_drop"), \
    result(run(i), "max_axial_residual"), cell("%.2e", table2(i, "vx")), \
    result(run(i), "max_radial_velocity"), cell("%.2e", table2(i, "vr")))
}
eval end_table("table2")

# How far the capsules are from the one with λ = 1, and from the published values.
pressures = ""; velocities = ""; pressure_marks = ""; velocity_marks = ""; timed = ""
do for [i=1:count] {
  pressure_marks = pressure_marks.mark(line(i), last_x_g, table2(i, "dP"))
  velocity_marks = velocity_marks.mark(line(i), last_x_g, table2(i, "vg"))
  timed = timed.(run(i) eq one || i == count ? " ".i : "")
  pressures = listed(pressures, distance(result(run(i), "pressure_drop"), table2(i, "dP")))
  velocities = listed(velocities, distance(result(run(i), "v_g"), table2(i, "vg")))
}
pressure_marks = pressure_marks.marks_title(pressure_marks, "Table 2")
velocity_marks = velocity_marks.marks_title(velocity_marks, "Table 2")
lowest = result(one, "pressure_drop"); highest = lowest
do for [i=1:count] {
  lowest = result(run(i), "pressure_drop") < lowest ? result(run(i), "pressure_drop") : lowest
  highest = result(run(i), "pressure_drop") > highest ? result(run(i), "pressure_drop") : highest
}
spread = 100 * (highest - lowest) / result(one, "pressure_drop")
distances_to_table2(list) = list eq "" ? "" : "Distances to Table 2: ".list."."

eval figure("fig05a", 8.6, 5.6)
eval view(last_x_g - 1.14, last_x_g + 1.26, 0, 1.3)
set xtics 0.5; set ytics 0.5
set key at last_x_g + 0.51, 0.65
plot @wall, for [i=1:count] profiles(run(i)) using (at_x_g(last_x_g, "x")):"r" with lines linetype line(i) title name(i)
print sprintf("**Figure 5a.** Profiles at x_g = %g for different viscosity ratios. They agree:", last_x_g), \
  "the steady shape does not depend on the internal liquid."

eval figure("fig07a", 12, 8)
set multiplot
set xrange [-4:12]; set yrange [0:18]
set xlabel x_g_label; set ylabel pressure_label
set key at -3.7, 18 left top
plot for [i=1:count] series(run(i)) using "x_g":"pressure_drop" with lines linetype line(i) title name(i) @pressure_marks
set origin 0.47, 0.18; set size 0.5, 0.46
set xrange [9:12]; set yrange [lowest - 0.4:highest + 0.3]
set xtics 1; set ytics 0.5
unset key; unset xlabel; unset ylabel
replot
unset multiplot
peak(i) = sprintf("%.2f at x_g = %.2f for λ = %g", result(run(i), "peak_pressure_drop"), result(run(i), "x_g_at_peak"), \
  lambda(i))
print sprintf("**Figure 7a.** Extra pressure drop along the pore: a peak just before the entrance (%s, %s),", \
    peak(1), peak(count)), \
  sprintf("a dip, and a rise to one steady value. The values at x_g = %g still differ by %.1f %%,", last_x_g, spread), \
  "because a more viscous capsule takes longer to settle.", distances_to_table2(pressures)

eval figure("fig07b", 12, 8)
set xrange [-4:12]; set yrange [0:1.4]
set xlabel x_g_label; set ylabel velocity_label
set ytics 0.2
set key at 11.8, 0.1 right bottom
plot for [i=1:count] series(run(i)) using "x_g":"v_g" with lines linetype line(i) title name(i) @velocity_marks
print "**Figure 7b.** Velocity of the centre of mass along the pore: the viscosity ratio matters little on the way and", \
  "not in the end.", distances_to_table2(velocities)

# The position at t = 18.7, from the profile of that time.
position(i) = number(system("awk -F, 'NR > 1 && ($1 - 18.7)^2 < 1e-12 {printf \"%.16e\", $2; exit}' ".quoted(profiles(run(i)))))
published_position(i) = published(sprintf("F8-%g", lambda(i)))
places = ""; marks = ""
do for [i in timed] {
  places = listed(places, sprintf("x_g = %.2f for λ = %g", position(i), lambda(i)). \
    (published_position(i) > 0 ? sprintf(" (published: %g)", published_position(i)) : ""))
  marks = marks.mark(line(i), published_position(i), 0)
}
marks = marks.marks_title(marks, "{/:Italic x}_g")
eval figure("fig08", 8.6, 8.6)
eval view(2.3, 4.8, -1.3, 1.3)
set xtics 0.5; set ytics 0.5
set key at 3.6, 0.42 center
plot @wall, for [i in timed] outline(profiles(run(i)), "time", 18.7) using 1:2 with lines linetype line(i + 0) title name(i), \
  for [i in timed] $one using (position(i)):(0) with points linetype line(i + 0) pointtype 2 pointsize 0.7, \
  NaN with points linetype 1 pointtype 2 pointsize 0.7 title "{/:Italic x}_g, here" @marks
print "**Figure 8.** Profiles at t = 18.7. The less viscous capsule is a parachute already, the most viscous one has a", \
  "flat rear and lags behind:", places."."

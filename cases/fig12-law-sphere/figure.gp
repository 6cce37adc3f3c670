law(i) = parameter_word(run(i), "membrane.law")
name(i) = law(i) eq "skalak" ? "Skalak, {/:Italic C} = 1" : "neo-Hookean"
last_x_g = result(run(1), "x_g")
of(which) = sum [i=1:count] (law(i) eq which ? i : 0)
neo_hookean = run(int(of("neo-hookean"))); skalak = run(int(of("skalak")))
published_dP(i) = published(law(i) eq "skalak" ? "F13-SK" : "F13-NH")

eval figure("fig12", 8.6, 6)
eval view(last_x_g - 1.4, last_x_g + 1.6, 0, 1.3)
set xtics 0.5; set ytics 0.5
set key at last_x_g + 0.95, 0.6
plot @wall, for [i=1:count] profiles(run(i)) using (at_x_g(last_x_g, "x")):"r" with lines linetype i title name(i)
print "**Figure 12.** Steady profiles of two spheres that differ in their membrane's law alone, at x_g =", \
  sprintf("%g. The neo-Hookean one is more deformed: its length is %.3f pore radii, the other's %.3f.", last_x_g, \
          result(neo_hookean, "length"), result(skalak, "length"))

distances = ""; marks = ""
do for [i=1:count] {
  marks = marks.mark(i, last_x_g, published_dP(i))
  distances = listed(distances, distance(result(run(i), "pressure_drop"), published_dP(i)))
}
marks = marks.marks_title(marks, "section 4.4")
eval figure("fig13", 12, 8)
set xrange [-4:12]; set yrange [0:14]
set xlabel x_g_label; set ylabel pressure_label
set key at 11.8, 0.5 right bottom
plot for [i=1:count] series(run(i)) using "x_g":"pressure_drop" with lines linetype i title name(i) @marks
print sprintf("**Figure 13.** Extra pressure drop: %.3f for the neo-Hookean sphere in the end,", \
              result(neo_hookean, "pressure_drop")), \
  sprintf("%.3f for Skalak's.", result(skalak, "pressure_drop")), \
  (distances eq "" ? "" : "Distances to the published values: ".distances.".")

eval figure("fig14", 8.6, 6)
set xrange [last_x_g - 1.2:last_x_g + 1.2]; set yrange [0:0.5]
set xlabel x_label; set ylabel "film, 1 – {/:Italic r} / {/:Italic R}_t"
set xtics 0.5; set ytics 0.1
set key at last_x_g - 0.6, 0.06 left bottom
plot for [i=1:count] profiles(run(i)) using (at_x_g(last_x_g, "x")):(1 - column("r")) with lines linetype i title name(i)
print "**Figure 14.** Thickness of the film between membrane and wall. It is thicker around the neo-Hookean sphere,", \
  sprintf("%.4f pore radii at the thinnest against %.4f.", result(neo_hookean, "min_film"), result(skalak, "min_film"))

eval figure("fig15", 8.6, 6)
set xrange [0:2.83]; set yrange [0.8:1.5]
set xlabel arc_label; set ylabel stretch_label
set xtics 0.5; set ytics 0.1
set key at 0.15, 1.47 left top
plot for [i=1:count] profiles(run(i)) using (at_x_g(last_x_g, "S")):"stretch_meridional" with lines linetype i title name(i)
tips = result(neo_hookean, "front_stretch") + result(skalak, "front_stretch")
apart = 200 * (result(neo_hookean, "front_stretch") - result(skalak, "front_stretch")) / tips
print "**Figure 15.** Steady meridional stretch along the membrane, from the rear pole to the front tip. There it is", \
  sprintf("%.3f for the neo-Hookean sphere and %.3f for Skalak's, %.1f %% of the mean apart", \
          result(neo_hookean, "front_stretch"), result(skalak, "front_stretch"), apart). \
  (published("F15") > 0 ? sprintf(" (published: %g %%).", 100 * published("F15")) : ".")

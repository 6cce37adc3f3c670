law(i) = law_title(parameter_word(run(i), "membrane.law"))
radius(i) = parameter(run(i), "capsule.radius")
epsilon(i) = parameter(run(i), "flow.capillary_number")
is(i, r, e) = abs(radius(i) - r) < 1e-9 && abs(epsilon(i) - e) < 1e-9
weakest = ""; widest = ""
do for [i=1:count] {
  if (is(i, 0.7, 0.02)) { weakest = weakest." ".i }
  if (is(i, 0.9, 0.08)) { widest = widest." ".i }
}
stretch(i) = result(run(i), "largest_area_stretch")
tension(i) = result(run(i), "largest_tension")

eval figure("way", 17, 6.5)
set multiplot layout 1, 2
set xrange [-4:6]; set xlabel x_g_label; set key left top title "law, {/:Italic R}_{eq}, {/:Italic ε}"
set yrange [1:2]; set ylabel "largest {/:Italic λ}_s {/:Italic λ}_φ"
plot for [k=1:2] series(run(int(word(widest, k)))) using "x_g":"max_area_stretch" with lines linetype k title law(word(widest, k) + 0).", 0.9, 0.08", \
  for [k=1:2] series(run(int(word(weakest, k)))) using "x_g":"max_area_stretch" with lines linetype k linewidth 0.7 title law(word(weakest, k) + 0).", 0.7, 0.02"
set yrange [0:*]; set ylabel "largest tension / {/:Italic G}"
unset key
plot for [k=1:2] series(run(int(word(widest, k)))) using "x_g":"max_tension" with lines linetype k, \
  for [k=1:2] series(run(int(word(weakest, k)))) using "x_g":"max_tension" with lines linetype k linewidth 0.7
unset multiplot
print "**Area and tension.** Largest area stretch and largest principal tension anywhere on the membrane.", \
  sprintf("In the widest and softest capsule the area of the neo-Hookean membrane is stretched by %.0f %%, Skalak's by %.0f %%", \
    100 * (stretch(word(widest, 1) + 0) - 1), 100 * (stretch(word(widest, 2) + 0) - 1)), \
  sprintf("under tensions of %.2f and %.2f G.", tension(word(widest, 1) + 0), tension(word(widest, 2) + 0))

eval table("map")
print "law,radius,ε,largest area stretch,at x_g,largest tension / G,at x_g"
do for [i=1:count] {
  print sprintf("%s,%g,%g,%.3f,%.1f,%.3f,%.1f", law(i), radius(i), epsilon(i), stretch(i), \
    result(run(i), "x_g_at_largest_area_stretch"), tension(i), result(run(i), "x_g_at_largest_tension"))
}
eval end_table("map")

law(i) = parameter_word(run(i), "membrane.law")
name(i) = law(i) eq "skalak" ? "Skalak, {/:Italic C} = 1" : "neo-Hookean"
last_x_g = result(run(1), "x_g")
larger(a, b) = a > b ? a : b
of(which) = sum [i=1:count] (law(i) eq which ? i : 0)
neo_hookean = run(int(of("neo-hookean"))); skalak = run(int(of("skalak")))

eval figure("fig16", 8.6, 6)
eval view(last_x_g - 1.4, last_x_g + 1.8, 0, 1.3)
set xtics 0.5; set ytics 0.5
set key at last_x_g + 0.98, 0.48 samplen 1.8
plot @wall, for [i=1:count] profiles(run(i)) using (at_x_g(last_x_g, "x")):"r" with lines linetype i title name(i)
print "**Figure 16.** Steady profiles of two ellipsoids that differ in their membrane's law alone, at x_g =", \
  sprintf("%g. The neo-Hookean one is stretched by up to %.0f %%,", last_x_g, 100 * (result(neo_hookean, "max_stretch") - 1)), \
  sprintf("Skalak's by up to %.0f %%; their volumes have changed by at most %.0e.", \
          100 * (result(skalak, "max_stretch") - 1), larger(abs(result(neo_hookean, "volume_change")), \
          abs(result(skalak, "volume_change"))))

eval figure("fig18", 12, 8)
set xrange [-4:12]; set yrange [0:25]
set xlabel x_g_label; set ylabel pressure_label
set key at -3.7, 24 left top
plot for [i=1:count] series(run(i)) using "x_g":"pressure_drop" with lines linetype i title name(i)
print "**Figure 18.** Extra pressure drop of the two ellipsoids. The entry peak is", \
  sprintf("%.2f for the neo-Hookean one and %.2f for Skalak's;", result(neo_hookean, "peak_pressure_drop"), \
          result(skalak, "peak_pressure_drop")), \
  sprintf("in the end they are at %.2f and %.2f.", result(neo_hookean, "pressure_drop"), result(skalak, "pressure_drop"))

law_word(i) = parameter_word(run(i), "membrane.law")
law(i) = law_title(law_word(i))
radius(i) = parameter(run(i), "capsule.radius")
epsilon(i) = parameter(run(i), "flow.capillary_number")
is(i, r, e) = abs(radius(i) - r) < 1e-9 && abs(epsilon(i) - e) < 1e-9
smallest = ""; widest = ""
do for [i=1:count] {
  if (is(i, 0.7, 0.02)) { smallest = smallest." ".i }
  if (is(i, 0.9, 0.08)) { widest = widest." ".i }
}
stretch(i) = result(run(i), "largest_area_stretch")
tension(i) = result(run(i), "largest_tension")

eval figure("way", 17, 6.5)
set multiplot layout 1, 2
set xrange [-4:12]; set xlabel x_g_label; unset key
set yrange [1:*]; set ylabel "largest {/:Italic λ}_s {/:Italic λ}_φ"
plot for [k=1:2] series(run(int(word(widest, k)))) using "x_g":"max_area_stretch" with lines linetype k, \
  for [k=1:2] series(run(int(word(smallest, k)))) using "x_g":"max_area_stretch" with lines linetype k linewidth 0.7
set yrange [0:*]; set ylabel "largest tension / {/:Italic G}"
set key at graph 0.98, 0.6 title "law, {/:Italic R}_{eq}, {/:Italic ε}"
plot for [k=1:2] series(run(int(word(widest, k)))) using "x_g":"max_tension" with lines linetype k title law(word(widest, k) + 0).", 0.9, 0.08", \
  for [k=1:2] series(run(int(word(smallest, k)))) using "x_g":"max_tension" with lines linetype k linewidth 0.7 title law(word(smallest, k) + 0).", 0.7, 0.02"
unset multiplot
print "**Area and tension.** Largest area stretch and largest principal tension anywhere on the membrane.", \
  sprintf("In the widest and softest capsule the area of the neo-Hookean membrane is stretched by %.0f %%, Skalak's by %.0f %%", \
    100 * (stretch(word(widest, 1) + 0) - 1), 100 * (stretch(word(widest, 2) + 0) - 1)), \
  sprintf("under tensions of %.2f and %.2f G.", tension(word(widest, 1) + 0), tension(word(widest, 2) + 0))

# A grid for each law: a block of the capillary numbers for each radius.
do for [name in "neo-hookean skalak"] {
  eval "set print $grid_".name[1:2]
  before = NaN
  do for [i=1:count] {
    if (law_word(i) eq name) {
      if (before == before && radius(i) != before) { print "" }
      print sprintf("%g %g %.6g %.6g", epsilon(i), radius(i), stretch(i), tension(i))
      before = radius(i)
    }
  }
  set print
}
levels_3 = "1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.4, 1.5, 1.6"
levels_4 = "0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75"
eval figure("map", 16, 14)
set datafile separator whitespace; unset datafile columnheaders
set contour base; unset surface; set cntrparam cubicspline; set cntrparam points 8
do for [q=3:4] {
  eval "set cntrparam levels discrete ".(q == 3 ? levels_3 : levels_4)
  do for [name in "ne sk"] {
    eval sprintf("set table $lines_%s_%d; splot $grid_%s using 1:2:%d with lines; unset table", name, q, name, q)
  }
}
unset contour; set surface
set multiplot layout 2, 2
set style textbox opaque noborder margins 0.2, 0.2
set xrange [0.018:0.082]; set yrange [0.69:0.91]
set xlabel "{/:Italic ε}"; set ylabel "{/:Italic R}_{eq} / {/:Italic R}_t"; set xtics 0.02; set ytics 0.05
do for [q=3:4] {
  do for [k=1:2] {
    name = word("ne sk", k)
    set title word("neo-Hookean Skalak", k).(q == 3 ? ": {/:Italic λ}_s {/:Italic λ}_φ" : ": tension / {/:Italic G}")
    eval sprintf("plot $grid_%s using 1:2 with points pointtype 7 pointsize 0.3 linecolor rgb '#A0A0A0', ", name). \
      sprintf("$lines_%s_%d using 1:2 with lines linetype k, '' using 1:2:3 every 1000::5 with labels boxed font ',8'", name, q)
  }
}
unset multiplot
eval defaults
print "**What a membrane has to bear.** Largest area stretch and tension on the whole way, over size and capillary number;", \
  "dots are the marches. A membrane that bears a value bursts on the right of its line."

# From where on a column is above 99 % of its largest value: of a peak its rising flank.
nearly(i, name, largest) = number(system(sprintf("awk -F, -v name=%s -v least=%.10g 'NR == 1 {for (k = 1; k <= NF; ++k) place[$k] = k; next} \
  $place[name] >= least {printf \"%%.3f\", $place[\"x_g\"]; exit}' %s", name, 0.99 * largest, quoted(series(run(i))))))
share_of_arc(i, name) = result(run(i), "S_at_largest_".name) / (pi * radius(i))
eval table("map")
print "law,radius,ε,largest area stretch,± (estimate),99 % of it at x_g,at S/(πa),largest tension / G,± (estimate),99 % of it at x_g,at S/(πa)"
do for [i=1:count] {
  print sprintf("%s,%g,%g,%.3f,%.0e,%.1f,%.2f,%.3f,%.0e,%.1f,%.2f", law(i), radius(i), epsilon(i), \
    stretch(i), error_of(run(i), "largest_area_stretch"), nearly(i, "max_area_stretch", stretch(i)), share_of_arc(i, "area_stretch"), \
    tension(i), error_of(run(i), "largest_tension"), nearly(i, "max_tension", tension(i)), share_of_arc(i, "tension"))
}
eval end_table("map")

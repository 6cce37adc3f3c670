law(i) = parameter_word(run(i), "membrane.law")
aspect(i) = parameter(run(i), "capsule.aspect_ratio")
last_x_g = result(run(1), "x_g")
sphere = 1.0; ellipsoid = 0.28
# The run of a law and a shape.
of(which, ratio) = run(sum [i=1:count] (law(i) eq which && abs(aspect(i) - ratio) < 1e-9 ? i : 0))
tip(which, ratio) = result(of(which, ratio), "front_stretch")
excess(which) = 100 * (tip(which, ellipsoid) / tip(which, sphere) - 1)
title_of(which) = which eq "skalak" ? "Skalak, {/:Italic C} = 1" : "neo-Hookean"

stated = published("F17a-sphere") > 0 ? sprintf("(published: %.2f and %.2f, %g %%).", published("F17a-sphere"), \
  published("F17a-ellipsoid"), 100 * published("F17a-ratio")) : "."

# Stretch along the membrane of both shapes, with published values at the tip, if there are any.
array length_of[2]
do for [panel in "a:neo-hookean b:skalak"] {
  which = panel[3:]
  marks = mark(1, 1, panel[1:1] eq "a" ? published("F17a-sphere") : NaN) \
    .mark(2, 1, panel[1:1] eq "a" ? published("F17a-ellipsoid") : NaN)
  marks = marks.marks_title(marks, "section 4.4")
  set autoscale
  do for [k=1:2] {
    stats profiles(of(which, k == 1 ? sphere : ellipsoid)) using (at_x_g(last_x_g, "S")) nooutput
    length_of[k] = STATS_max
  }
  eval figure("fig17".panel[1:1], 8.6, 6.5)
  set title title_of(which) offset 0, -0.5
  set xrange [0:1.02]; set yrange [0.6:1.9]
  set xlabel "{/:Italic S} / {/:Italic S}_{max}"; set ylabel stretch_label
  set xtics 0.2; set ytics 0.2
  set key at 0.04, 1.88 left top
  eval 'plot profiles(of(which, sphere)) using (at_x_g(last_x_g, "S") / length_of[1]):"stretch_meridional" \
      with lines linetype 1 title "sphere", \
    profiles(of(which, ellipsoid)) using (at_x_g(last_x_g, "S") / length_of[2]):"stretch_meridional" \
      with lines linetype 2 title sprintf("{/:Italic A}/{/:Italic B} = %g", ellipsoid)'.marks
  print sprintf("**Figure 17%s.** Steady meridional stretch of two isovolumic %s capsules along the membrane.", panel[1:1], \
      which eq "skalak" ? "Skalak" : "neo-Hookean"), \
    sprintf("At the front tip it is %.3f for the sphere and %.3f for the ellipsoid, %.1f %% more", \
            tip(which, sphere), tip(which, ellipsoid), excess(which)), \
    (panel[1:1] eq "a" ? stated : \
      sprintf("and so less than without strain hardening (%.1f %%).", excess("neo-hookean")))
}

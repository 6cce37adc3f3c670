name(i) = sprintf("{/:Italic A}/{/:Italic B} = %g", parameter(run(i), "capsule.aspect_ratio"))
# When the centre of mass is at x_g, linear between the rows.
time_at(i, x_g) = number(system(sprintf("awk -F, 'NR > 2 && $2 >= %.10g {printf \"%%.16e\", t + ($1 - t) * (%.10g - x) / ($2 - x); exit} {t = $1; x = $2}' %s", \
  x_g, x_g, quoted(series(run(i))))))

eval figure("fig11", 12, 8)
set xrange [0:32]; set yrange [-4:12]
set xlabel time_label; set ylabel x_g_label
set key at 1, 11.5 left top
plot for [i=1:count] series(run(i)) using "time":"x_g" with lines \
  linetype linetype_of_ratio(parameter(run(i), "flow.viscosity_ratio"), i) dashtype i title name(i)
print "**Figure 11.** Position of the centre of mass in time, at a viscosity ratio of", \
  sprintf("%g. The ellipsoid is at x_g = 1 at t = %.1f, the sphere at %.1f;", \
          parameter(run(1), "flow.viscosity_ratio"), time_at(count, 1), time_at(1, 1)), \
  sprintf("at x_g = 11 the lag has grown to %.1f.", time_at(count, 11) - time_at(1, 11))

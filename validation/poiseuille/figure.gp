mouth = "results/".case."/mouth.csv"
tips = "results/".case."/tips.csv"

eval figure("poiseuille", 12, 8)
set logscale y; set format y "10^{%T}"
set xrange [0:2]; set yrange [1e-5:1]
set xlabel "distance / {/:Italic R}_t"; set ylabel "largest difference / velocity on the axis"
stats mouth using (abs(column("x") - 0.5) < 1e-9 ? column("difference") : NaN) name "half" nooutput
stats tips using (abs(column("distance") - 1) < 1e-9 ? column("upstream") : NaN) name "up" nooutput
stats tips using (abs(column("distance") - 1) < 1e-9 ? column("downstream") : NaN) name "down" nooutput
plot mouth using "x":"difference" with lines linetype 1 title "behind a square mouth", \
  tips using "distance":"upstream" with lines linetype 2 title "upstream of the capsule", \
  tips using "distance":"downstream" with lines linetype 3 title "downstream of the capsule"
print "**Poiseuille's profile.** Largest difference from it across a section: in the empty pore behind a square mouth, and at", \
  "both ends of the steady capsule of Table 2.", \
  sprintf("Half a radius behind the mouth it is %.1f %% of the velocity on the axis, one radius from the", 100 * half_mean), \
  sprintf("capsule's tips %.1f %% upstream and %.1f %% downstream.", 100 * up_mean, 100 * down_mean)

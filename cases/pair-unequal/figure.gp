is_small(i) = strstrt(run(i), "radius=0.8_0.7") > 0
is_soft(i) = strstrt(run(i), "capillary_number=0.02_0.1") > 0
second(i) = results(run(i))."/series-2.csv"
second_profiles(i) = results(run(i))."/profiles-2.csv"
name(i) = (is_small(i) ? "a small " : "a ").(is_soft(i) ? "soft one behind a stiff one" : "stiff one behind a soft one")

eval figure("shapes", 17, 10)
set multiplot layout count, 1 margins 0.04, 0.99, 0.14, 0.99 spacing 0, 0.02
do for [i=1:count] {
  eval view(-1.2, 18.2, -1.15, 1.15)
  unset xlabel; unset ylabel; unset border; unset xtics; unset ytics
  if (i == count) { set xtics 2 nomirror out; set xlabel x_label }
  set arrow 1 from -1.2, 1 to 18.2, 1 nohead linecolor rgb wall_colour linewidth 3
  set arrow 2 from -1.2, -1 to 18.2, -1 nohead linecolor rgb wall_colour linewidth 3
  set label 1 name(i) at 7.5, 0 center
  times = "0 ".sprintf("%.12g", result(run(i), "time"))
  plot for [t in times] for [side=-1:1:2] profiles(run(i)) using (at_time(t + 0, "x")):(side * column("r")) with lines linetype 1, \
    for [t in times] for [side=-1:1:2] second_profiles(i) using (at_time(t + 0, "x")):(side * column("r")) with lines linetype 2
}
unset multiplot
print "**Shapes of unequal pairs.** Each pair at the start and at the end, the leading capsule on the right. Soft: ε = 0.1, stiff: 0.02."

eval figure("gap", 17, 7.5)
set multiplot layout 1, 2
set xrange [0:10.2]; set xlabel time_label; set ylabel "smallest gap / {/:Italic R}_t"; set logscale y; set yrange [0.02:2]
set ytics (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2); set key bottom left samplen 3
plot for [i=1:count] second(i) using "time":"min_gap" with lines linetype i title name(i)
unset logscale; set ytics auto; set ylabel velocity_label; set yrange [1.25:1.45]
unset key
plot for [i=1:count] series(run(i)) using "time":"v_g" with lines linetype i linewidth 0.7, \
  for [i=1:count] second(i) using "time":"v_g" with lines linetype i linewidth 2
unset multiplot
print "**Catching up.** The smallest gap, and the speeds of the leading capsules (thin) and of those behind (thick)."

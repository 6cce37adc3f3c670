pair = run(1)
alone_ahead = run(2)
alone_behind = run(3)
second = results(pair)."/series-2.csv"
second_profiles = results(pair)."/profiles-2.csv"

eval figure("shapes", 13, 11)
times = "0 2 8"
set multiplot layout words(times), 1 margins 0.04, 0.99, 0.12, 0.99 spacing 0, 0.02
do for [n=1:words(times)] {
  t = word(times, n)
  eval view(-5, 10, -1.9, 1.9)
  unset xlabel; unset ylabel; unset border; unset xtics; unset ytics
  if (n == words(times)) { set xtics 2 nomirror out; set xlabel x_label }
  set label 1 "{/:Italic t} = ".t at -4.8, 1.6
  plot @wall, for [side=-1:1:2] profiles(pair) using (at_time(t + 0, "x")):(side * column("r")) with lines linetype 1, \
    for [side=-1:1:2] second_profiles using (at_time(t + 0, "x")):(side * column("r")) with lines linetype 2
}
unset multiplot
print "**Through the mouth.** The leading capsule, black, and the one behind it: at the start, with the first in the mouth, and with the second there."

eval figure("drops", 17, 7.5)
set multiplot layout 1, 2
set xrange [-3.6:4]; set xlabel "{/:Italic x}_g of the capsule / {/:Italic R}_t"; set ylabel pressure_label; set yrange [-12:25]; set ytics 0, 5
set key bottom right samplen 1.5
plot series(alone_ahead) using "x_g":"pressure_drop" with lines linetype 3 linewidth 3 title "alone, from the mouth", \
  series(alone_behind) using "x_g":"pressure_drop" with lines linetype 4 linewidth 3 title "alone, from behind", \
  series(pair) using "x_g":"pressure_share" with lines linetype 1 title "the leading one's share", \
  second using "x_g":"pressure_share" with lines linetype 2 title "the follower's share"
set xlabel "{/:Italic x}_g of the follower / {/:Italic R}_t"; set ylabel "smallest gap / {/:Italic R}_t"; set yrange [0:7]; set ytics autofreq
unset key
plot second using "x_g":"min_gap" with lines linetype 2
unset multiplot
print "**Peaks.** Each capsule's share of the pressure drop against that of one alone from the same start, and how the pair parts."

train = "results/".case."/train.csv"
steady(k) = number(system("awk -F, 'NR == 2 {print $".k."}' ".train))
capsule_file(k) = "results/".case."/five/series".(k == 1 ? "" : "-".k).".csv"

eval figure("five", 17, 7.5)
set multiplot layout 1, 2
set xrange [0:3.6]; set xlabel time_label; set ylabel "speed over that of the train less one"; set yrange [-0.002:0.003]
set key at graph 0.97, 0.84
plot 0 with lines linecolor "gray", for [k=1:5] capsule_file(k) using "time":(column("v_g")/steady("1") - 1) with lines linetype k title sprintf("%d", k)
set ylabel "share over the drop of the train less one"; set yrange [-0.01:0.06]
unset key
plot 0 with lines linecolor "gray", for [k=1:5] capsule_file(k) using "time":(column("pressure_share")/steady("2") - 1) with lines linetype k
unset multiplot
print sprintf("**Five in a row**, numbered from the front: the middle one, 3, becomes one of a train. Opposed neighbours in the train move with the growth rate %.5f; twice the slope of the speed at which two alone part is %.5f.", steady("3"), steady("4"))

eval figure("reservoir", 11, 9)
distances = "results/".case."/reservoir.csv"
set logscale xy; set xrange [1.8:10]; set yrange [1e-4:1e-2]; set format y "10^{%T}"; set xtics (2, 3, 4, 6, 9)
set xlabel "distance of the centres / {/:Italic R}_t"; set ylabel "change of the second one's speed"
set key top right
plot distances using "distance":"change" with linespoints linetype 1 notitle, \
  0.0165*x**-2 with lines linecolor "gray" dashtype 2 title "distance^{−2}"
print "**In the reservoir** capsules feel each other farther than in the tube: the first one is 6 radii in front of the mouth, the second one behind it."

eval figure("errors", 17, 9)
set multiplot layout 1, 2
set logscale xy; set xrange [1e-10:1e-1]; set yrange [1e-10:1e-1]; set format "10^{%T}"; set xtics 1e-10, 100
set xlabel "difference from a refined run"; set ylabel "estimated error"
set key top left
of(file, quantity) = "< grep -e ".quantity." -e capsules results/".case."/".file
plot x with lines linecolor "gray" notitle, 30*x with lines linecolor "gray" dashtype 2 notitle, \
  of("pairs.csv", "gap#") using "difference":"estimate" with points linetype 1 title "pairs: smallest gap", \
  of("pairs.csv", "share") using "difference":"estimate" with points linetype 2 title "shares of the drop", \
  of("pairs.csv", "spacing") using "difference":"estimate" with points linetype 3 title "spacing"
unset ylabel
plot x with lines linecolor "gray" notitle, 30*x with lines linecolor "gray" dashtype 2 notitle, \
  of("trains.csv", "drop") using "difference":"estimate" with points linetype 1 title "trains: pressure drop", \
  of("trains.csv", "v_g") using "difference":"estimate" with points linetype 2 title "speed", \
  of("trains.csv", "min_gap") using "difference":"estimate" with points linetype 3 title "smallest gap", \
  of("trains.csv", "rate") using "difference":"estimate" with points linetype 4 title "growth rates"
unset multiplot
print "**Error estimates** of eight pairs, the largest along the way, and of sixteen trains. Between the lines: one to thirty times the error."

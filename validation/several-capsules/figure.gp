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

eval figure("errors", 11, 9)
set logscale xy; set xrange [1e-10:1e-1]; set yrange [1e-10:1e-1]; set format "10^{%T}"
set xlabel "difference from a refined run"; set ylabel "estimated error"
set key top left
plot x with lines linecolor "gray", 30*x with lines linecolor "gray" dashtype 2, \
  "< grep -e gap# -e capsules results/".case."/pairs.csv" using "difference":"estimate" with points linetype 1 title "smallest gap", \
  "< grep -e share -e capsules results/".case."/pairs.csv" using "difference":"estimate" with points linetype 2 title "shares of the pressure drop", \
  "< grep -e drop -e capsules results/".case."/trains.csv" using "difference":"estimate" with points linetype 3 title "pressure drop of trains"
print "**Error estimates** of eight pairs, the largest along the way, and eight trains. Between the lines: one to thirty times the error."

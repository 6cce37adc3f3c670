table = "results/".case."/limits.csv"
way = "results/".case."/way.csv"
fits = "column('frozen') < 6e-3"
of(scheme, name) = strcol("scheme") eq scheme ? column(name) : NaN
varied(name) = strcol("scheme") eq "euler" && strcol("varied") eq name
stats table using (@fits ? abs(column("measured") / column("frozen") - 1) : NaN) name "error" nooutput
stats table using (abs(column("whole") / column("frozen") - 1)) name "frozen" nooutput
stats table using (of("euler", "frozen")) name "limit" nooutput
stats table using (column("default")) name "default" nooutput
stats table using (varied("nodes") ? log(column("value")) : NaN):(log(column("frozen"))) name "nodes" nooutput
stats table using (varied("capillary_number") ? column("value") : NaN):(column("frozen")) name "number" nooutput
number_slope = log(number_max_y / number_min_y) / log(number_max_x / number_min_x)
stats way using (column("limit")) name "way" nooutput

eval figure("stability-time-step", 12, 10)
set logscale xy; set format "10^{%T}"
set xrange [2e-4:4e-1]; set yrange [2e-4:4e-1]; set size square
set xlabel "limit from the eigenvalues"; set ylabel "step / ({/:Italic πR}_t^3/{/:Italic Q})"
set key bottom right
plot x with lines linetype 1 linecolor rgb "#808080" title "equal", \
  table using "frozen":(of("euler", "measured")) with points linetype 1 title "largest stable step, Euler", \
  table using "frozen":(of("rk2", "measured")) with points linetype 3 title "the same, Heun", \
  table using "frozen":(of("rk4", "measured")) with points linetype 2 title "the same, Runge and Kutta", \
  table using (of("euler", "frozen")):"default" with points linetype 4 title "mean step of the default"
print "**Explicit steps.** Largest step of which a disturbance dies away, found by bisection, against 2 (Euler and Heun) and 2.785", \
  "(Runge and Kutta) over the largest eigenvalue of the linearised motion, for nodes from 28 to 64, bending ratios from 1e-5 to 1e-2,", \
  "capillary numbers from 0.01 to 0.3 and viscosity ratios from 0.1 to 100. They agree within", \
  sprintf("%.1f %% where the limit is below 0.006; longer steps change the shape before the test has ended.", 100 * error_max), \
  sprintf("Freezing the mobility changes the eigenvalue by at most %.1f %%. Euler's limit falls with the nodes like N^%.2f and", \
    100 * frozen_max, nodes_slope), \
  sprintf("grows like ε^%.2f: between %.1e and %.1e here. The default's mean step stays between %.2f and %.2f.", \
    number_slope, limit_min, limit_max, default_min, default_max)

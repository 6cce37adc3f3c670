rates = "results/".case."/rates.csv"
limits = "results/".case."/limits.csv"
stats rates using (column("slow_error") > column("fast_error") ? column("slow_error") : column("fast_error")) name "error" nooutput
stats limits using (column("dilatation") > 9e3 ? column("excess") : NaN) name "excess" nooutput

# Slow rates of P_l with a viscous membrane: of neo-Hookean spheres without pre-stress and bending.
plain(l, shear) = sprintf("< awk -F, 'NR == 1 || $1 == \"neo-hookean\" && $2 == 0 && $3 == 0 && $5 == %g && $6 == 0 && $7 == %d' %s", shear, l, rates)

eval figure("relaxation-rates", 16, 8)
set multiplot layout 1, 2
set logscale xy; set format "%g"
set xrange [0.15:13]; set yrange [0.01:0.6]
set xlabel "{/:Italic λ}"; set ylabel "rate / ({/:Italic G}/{/:Italic μa})"
set key bottom left
plot for [i=1:3] plain(2, word("0 1 10", i) + 0) using 4:8 with lines linetype i title sprintf("{/:Italic P}_2, {/:Italic μ_s} = %s", word("0 1 10", i)), \
  for [i=1:3] plain(3, word("0 1 10", i) + 0) using 4:8 with lines linetype i dashtype 2 title i == 1 ? "{/:Italic P}_3" : "", \
  for [l=2:3] for [i=1:3] plain(l, word("0 1 10", i) + 0) using 4:9 with points linetype i pointtype 7 pointsize 0.4 notitle
set xrange [0.7:1.4e4]; set yrange [1e-7:1]; set format "10^{%T}"
set xlabel "{/:Italic C}"; set ylabel "relaxation time over its limit, less 1"
set key bottom left
ratio(i) = word("0.2 1 5", i) + 0
limit(ratio, shear) = sprintf("< awk -F, 'NR == 1 || $2 == %g && $3 == %g && $4 == 2' %s", ratio, shear, limits)
plot for [i=1:3] limit(ratio(i), 0) using 1:6 with linespoints linetype linetype_of_ratio(ratio(i), i) dashtype 1 pointtype 7 pointsize 0.4 title sprintf("{/:Italic λ} = %g", ratio(i)), \
  for [i=1:3] limit(ratio(i), 10) using 1:6 with linespoints linetype linetype_of_ratio(ratio(i), i) dashtype 2 pointtype 6 pointsize 0.5 title i == 1 ? "{/:Italic μ_s} = 10" : "", \
  [10:1e4] 0.3 / x with lines linecolor rgb "#808080" title "∝ 1/{/:Italic C}"
unset multiplot
print "**Spheres at rest.** Left: rates at which P_2 and P_3 decay, exact (lines) and by the solver (points): all rates of P_2 to P_6,", \
  "for two laws, with and without pre-stress, bending and viscosity of the membrane,", sprintf("agree within %.0e.", error_max), \
  sprintf("Right: distance of Skalak's membrane from one of constant area: it falls as 1/C, and is within %.0e at C = 10^4.", excess_max)

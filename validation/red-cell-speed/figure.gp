transits = "results/".case."/transits.csv"
costs = "results/".case."/costs.csv"
stats transits using (column("seconds")) name "seconds" nooutput
viscosity(mu) = column("shear_viscosity") == mu ? 1 : NaN
# The reference is the finest and the dearest of each: its own error is not known.
is_point(mu) = viscosity(mu) * (column("nodes") < 128 ? 1 : NaN)
way_error(which) = (a = column("v_g_".which), b = column("pressure_drop_".which), a > b ? a : b)
value_at(mu, nodes, k) = number(system(sprintf("awk -F, '$1 == %g && $2 == %g {print $%d}' ", mu, nodes, k).transits))
slower = value_at(200, 128, 6) / value_at(0, 128, 6)
dearer = value_at(200, 112, 5) / value_at(0, 112, 5)

eval figure("red-cell-speed", 16, 8)
set multiplot layout 1, 2
set logscale xy; set format y "10^{%T}"
set xrange [0.8:60]; set yrange [1e-6:1]
set xlabel "CPU time / that of the cheapest march"; set ylabel "largest error along the way, relative"
set key top left
plot for [i=1:2] transits using (is_point(word("0 200", i)) * column("seconds") / seconds_min):(way_error("error")) \
    with linespoints linetype 2*i - 1 pointtype 7 pointsize 0.5 title sprintf("{/:Italic μ_s} = %s", word("0 200", i)), \
  for [i=1:2] transits using (is_point(word("0 200", i)) * column("seconds") / seconds_min):(way_error("estimate")) \
    with linespoints linetype 2*i - 1 linewidth 0.5 pointtype 6 pointsize 0.5 title i == 1 ? "estimated" : ""
set ylabel "error of the time, relative"
plot for [i=1:2] transits using (is_point(word("0 200", i)) * column("seconds") / seconds_min):"time_error" \
    with linespoints linetype 2*i - 1 pointtype 7 pointsize 0.5 title sprintf("{/:Italic μ_s} = %s", word("0 200", i)), \
  for [i=1:2] transits using (is_point(word("0 200", i)) * column("seconds") / seconds_min):"time_estimate" \
    with linespoints linetype 2*i - 1 linewidth 0.5 pointtype 6 pointsize 0.5 title i == 1 ? "estimated" : ""
unset multiplot
print "**A red cell through a short pore**, λ = 5, C = 100, ε = 2, δ = 0.01: largest error of velocity and pressure drop along the way (left)", \
  "and of the time (right) on 64, 88, 112 nodes and shorter and shorter panels of the wall, relative to a march on 128; against CPU time, with the companion.", \
  sprintf("With the viscous membrane the transit takes %.2f times as long, and a march costs %.1f times as much.", slower, dearer)

array names[4] = ["oblate", "biconcave", "transit", "viscous-transit"]
array titles[4] = ["oblate cell in a mouth", "biconcave cell in a mouth", "red cell", "red cell, {/:Italic μ_s} = 200"]
of(i, name) = strcol("cell") eq names[i] ? column(name) : NaN
cost(name, c, k) = number(system(sprintf("awk -F, '$1 == \"%s\" && $2 == %g {print $%d}' ", name, c, k).costs))
ratio(i, k) = 1.0 * cost(names[i], 1e4, k) / cost(names[i], 100, k)
lower(a, b) = a < b ? a : b
upper(a, b) = a > b ? a : b
eval figure("red-cell-area", 16, 8)
set multiplot layout 1, 2
set logscale xy; set xrange [7:1.5e4]; set format x "10^{%T}"
set xlabel "{/:Italic C}"; set ylabel "steps (bold) and velocities (thin)"
set yrange [100:30000]; set format y "%g"; set ytics (100, 200, 500, 1000, 2000, 5000, 10000)
set key top left
plot for [i=1:4] costs using (of(i, "dilatation")):(of(i, "steps")) with linespoints linetype i pointtype 7 pointsize 0.5 title titles[i], \
  for [i=1:4] costs using (of(i, "dilatation")):(of(i, "velocities")) with linespoints linetype i linewidth 0.5 pointtype 6 pointsize 0.5
set yrange [1e-5:3]; set format y "10^{%T}"; set ytics auto
set ylabel "largest change of area"
set key bottom left
plot for [i=1:4] costs using (of(i, "dilatation")):(of(i, "area_change")) with linespoints linetype i pointtype 7 pointsize 0.5, \
  [10:1e4] 2 / x with lines linecolor rgb "#808080" title "∝ 1/{/:Italic C}"
unset multiplot
print "**Membranes that hardly change their area** (Skalak). Left: steps and velocities of a march with C:", \
  sprintf("from C = 100 to 10^4, %.1f to %.1f times the steps, %.1f to %.1f times the CPU time.", \
    lower(lower(ratio(1, 4), ratio(2, 4)), lower(ratio(3, 4), ratio(4, 4))), upper(upper(ratio(1, 4), ratio(2, 4)), upper(ratio(3, 4), ratio(4, 4))), \
    lower(lower(ratio(1, 7), ratio(2, 7)), lower(ratio(3, 7), ratio(4, 7))), upper(upper(ratio(1, 7), ratio(2, 7)), upper(ratio(3, 7), ratio(4, 7)))), \
  "Right: the largest change of area of any node at any time."

# All numbers: columns of a file of results by their places, those after the first `plain` ones with two digits, empty for the
# reference.
rows_of(file, columns, plain) = system(sprintf("awk -F, -v columns='%s' -v plain=%d 'NR > 1 {n = split(columns, k, \" \"); \
  for (i = 1; i <= n; ++i) printf(\"%%s%%s\", i > 1 ? \",\" : \"\", i <= plain ? $k[i] : $k[i] == 0 ? \"\" : sprintf(\"%%.1e\", $k[i])); print \"\"}' %s", columns, plain, file))
eval table("transits")
print "μ_s,nodes,steps,CPU seconds,transit time,error of the time,estimated,of v_g,estimated,of the pressure drop,estimated"
print rows_of(transits, "1 2 4 5 6 7 8 9 10 11 12", 5)
eval end_table("transits")
eval table("costs")
print "cell,C,nodes,steps,velocities,mobilities,CPU seconds,largest change of area"
print rows_of(costs, "1 2 3 4 5 6 7 8", 7)
eval end_table("costs")

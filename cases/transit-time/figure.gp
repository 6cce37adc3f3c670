radius(i) = parameter(run(i), "capsule.radius")
epsilon(i) = parameter(run(i), "flow.capillary_number")
lambda(i) = parameter(run(i), "flow.viscosity_ratio")
is_driven(i) = parameter_word(run(i), "flow.drive") eq "pressure"
of_sizes(i) = strstrt(run(i), "sizes") > 0
# The estimated errors have a "time", too.
transit(i) = number(system("sed -n '/\"transit\": {/,/}/s/^ *\"time\": \\([0-9][^,]*\\),*$/\\1/p' ".quoted(results(run(i))."/summary.json")))
status(i) = entry_word(results(run(i)), "  \"status\"")
set print $times
print "radius,epsilon,lambda,driven,sizes,time"
do for [i=1:count] {
  print sprintf("%g,%g,%g,%d,%d,%g", radius(i), epsilon(i), lambda(i), is_driven(i), of_sizes(i), transit(i))
}
set print
of(r, driven, y) = column("sizes") == 1 && abs(column("radius") - r) < 1e-9 && column("driven") == driven ? y : NaN
radii = "0.7 0.9 1 1.1"

eval figure("transit-time", 16, 8)
set multiplot layout 1, 2 margins 0.08, 0.99, 0.15, 0.89 spacing 0.08, 0
set logscale x; set xrange [0.004:0.13]; set yrange [5:18]
set xlabel "{/:Italic ε}"; set ylabel "transit time / (π{/:Italic R}_t^3/{/:Italic Q}_0)"
set key right top title "{/:Italic R}_{eq} / {/:Italic R}_t"
set title "constant pressure"
plot for [k=1:words(radii)] $times using (of(word(radii, k) + 0, 1, column("epsilon"))):"time" with linespoints linetype k title word(radii, k)
unset key; unset ylabel; set title "constant flow rate"
plot for [k=1:words(radii)] $times using (of(word(radii, k) + 0, 0, column("epsilon"))):"time" with linespoints linetype k
unset multiplot
print "**Transit times.** From one radius before a pore of length 6 to one behind it. At constant pressure a large capsule takes", \
  "longer when it is stiffer; at constant flow rate the stiffness hardly matters. Where a curve ends, stiffer capsules plug the pore."

# Why a capsule does not pass, and where.
end_of(i) = status(i) eq "reached" ? sprintf("%.2f", transit(i)) : sprintf("plugs at x_g = %.1f", result(run(i), "x_g"))
eval table("transit-times")
print "drive,radius,ε,λ,transit time,largest pressure drop"
do for [i=1:count] {
  print sprintf("%s,%g,%g,%g,%s,%.1f", is_driven(i) ? "pressure" : "flow rate", radius(i), epsilon(i), lambda(i), \
    end_of(i), result(run(i), "peak_pressure_drop"))
}
eval end_table("transit-times")

radius(i) = parameter(run(i), "capsule.radius")
epsilon(i) = parameter(run(i), "flow.capillary_number")
lambda(i) = parameter(run(i), "flow.viscosity_ratio")
is_driven(i) = parameter_word(run(i), "flow.drive") eq "pressure"
is_of(i, file) = strstrt(run(i), "transit-time-".file) > 0
# The estimated errors have a "time", too.
transit(i) = number(system("sed -n '/\"transit\": {/,/}/s/^ *\"time\": \\([0-9][^,]*\\),*$/\\1/p' ".quoted(results(run(i))."/summary.json")))
status(i) = entry_word(results(run(i)), "  \"status\"")
set print $times
print "radius,epsilon,lambda,driven,sizes,viscosities,plugs,time"
do for [i=1:count] {
  print sprintf("%g,%g,%g,%d,%d,%d,%d,%g", radius(i), epsilon(i), lambda(i), is_driven(i), is_of(i, "sizes"), \
    is_of(i, "viscosities"), status(i) ne "reached", transit(i))
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

eval figure("viscosity", 10, 7)
set logscale x; set xrange [0.15:33]; set yrange [6:13]
set xlabel "{/:Italic λ}"; set ylabel "transit time / (π{/:Italic R}_t^3/{/:Italic Q}_0)"
set key outside right center title "{/:Italic R}_{eq} / {/:Italic R}_t, constant"
thick(r, driven) = column("viscosities") == 1 && abs(column("radius") - r) < 1e-9 && column("driven") == driven ? column("lambda") : NaN
plot $times using (thick(1.1, 1)):"time" with linespoints linetype 4 title "1.1, pressure", \
  $times using (thick(0.9, 1)):"time" with linespoints linetype 2 title "0.9, pressure", \
  $times using (thick(1.1, 0)):"time" with linespoints linetype 4 linewidth 0.7 title "1.1, flow rate", \
  $times using (thick(0.9, 0)):"time" with linespoints linetype 2 linewidth 0.7 title "0.9, flow rate"
print "**The inner liquid.** Transit time over the viscosity ratio at ε = 0.05. Only a large capsule at constant pressure", \
  "takes longer when its liquid is thick."

# The largest radius that passes and the smallest that does not, for each capillary number at constant pressure.
flows = "0.005 0.01 0.02 0.03"
set print $edge
print "epsilon,passes,plugs"
do for [flow in flows] {
  passes = 0; plugs = 100
  do for [i=1:count] {
    if (is_driven(i) && lambda(i) == 1 && abs(epsilon(i) - flow) < 1e-9) {
      if (status(i) eq "reached" && radius(i) > passes) { passes = radius(i) }
      if (status(i) ne "reached" && radius(i) < plugs) { plugs = radius(i) }
    }
  }
  print sprintf("%s,%g,%g", flow, passes, plugs)
}
set print
eval figure("plugging", 11, 8)
set logscale x; set xrange [0.004:0.13]; set yrange [0.65:1.45]
set xlabel "{/:Italic ε}"; set ylabel "{/:Italic R}_{eq} / {/:Italic R}_t"; set key left top
driven(plugs) = column("driven") == 1 && column("lambda") == 1 && column("plugs") == plugs ? column("radius") : NaN
plot $edge using "epsilon":"passes":"plugs" with filledcurves fillcolor rgb capsule_colour title "the edge lies here", \
  $times using "epsilon":(driven(0)) with points linetype 1 title "passes", \
  $times using "epsilon":(driven(1)) with points linetype 2 pointtype 2 title "plugs the pore"
print "**Which capsules plug the pore.** Marches at constant pressure through a pore of length 6, λ = 1. A capsule of radius", \
  "1.24 passes at ε = 0.03; at 0.005 one of 1.1 does not."

# Why a capsule does not pass, and where.
end_of(i) = status(i) eq "reached" ? sprintf("%.2f", transit(i)) : sprintf("plugs at x_g = %.1f", result(run(i), "x_g"))
eval table("transit-times")
print "drive,radius,ε,λ,transit time,largest pressure drop"
do for [i=1:count] {
  print sprintf("%s,%g,%g,%g,%s,%.1f", is_driven(i) ? "pressure" : "flow rate", radius(i), epsilon(i), lambda(i), \
    end_of(i), result(run(i), "peak_pressure_drop"))
}
eval end_table("transit-times")

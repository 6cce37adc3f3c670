data = "results/".case."/spheres.csv"
speed = "results/".case."/resistance.csv"
radii = "0.3 0.5 0.7 0.8 0.9"
of(r, y) = abs(column("radius") - r) < 1e-9 ? y : NaN
second_mouth = 6

eval figure("spheres", 16, 13)
set multiplot layout 3, 1 margins 0.11, 0.86, 0.09, 0.98 spacing 0, 0.04
set xrange [-5:second_mouth + 5]; set format x ""
set arrow 1 from 0, graph 0 to 0, graph 1 nohead linecolor rgb "#C0C0C0"
set arrow 2 from second_mouth, graph 0 to second_mouth, graph 1 nohead linecolor rgb "#C0C0C0"
set key outside right top title "{/:Italic a}/{/:Italic R}_t"
set ylabel velocity_label; set yrange [0:2]
plot for [k=1:5] data using "x":(of(word(radii, k) + 0, column("v_g"))) with lines linetype k title word(radii, k), \
  for [k=4:5] data using "x":(of(word(radii, k) + 0, column("v_g") * column("flow_rate"))) with lines linetype k linewidth 0.7
unset key
set ylabel "{/:Italic Q} / {/:Italic Q}_0"; set yrange [0.5:1.05]
plot for [k=1:5] data using "x":(of(word(radii, k) + 0, column("flow_rate"))) with lines linetype k
set format x "%g"; set xlabel x_label
set ylabel "Δ{/:Italic R} / ({/:Italic ρ}/π{/:Italic R}_t)"; set yrange [0:*]
plot for [k=1:5] data using "x":(of(word(radii, k) + 0, column("resistance"))) with lines linetype k
unset multiplot
print "**Rigid spheres through a pore.** Velocity at constant flow rate (thin: at constant pressure, the two largest),", \
  "flow rate at constant pressure, and what they add to the resistance. Small spheres move with the liquid on the axis,", \
  "large ones are slower in the tube. Those of 0.5 to 0.8 reduce the flow rate most half a radius before the mouth."

eval figure("resistance", 10, 7)
set logscale xy; set format y "10^{%T}"; set xrange [*:*] reverse
set xlabel "milliseconds for a row"; set ylabel "relative error of the resistance"
plot speed using "milliseconds":"error" with linespoints linetype 1
print "**Speed against accuracy of the resistance.** A sphere of 0.8 in and beside the mouth, at the resolutions of accuracies", \
  "from 1e-2 to 1e-6."

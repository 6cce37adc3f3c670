milliseconds = "(1e3 * column(\"time [s]\"))"
height = result_physical(run(1), "pulse_height [ohm]") / 1e3
width = result_physical(run(1), "pulse_width [s]") * 1e3

eval figure("pulse", 12, 8)
set multiplot layout 2, 1 margins 0.13, 0.98, 0.14, 0.97 spacing 0, 0.05
set xrange [3:17]; set yrange [0:*]; set format x ""
set ylabel "Δ{/:Italic R} / kΩ"; set key left top
plot series_physical(run(1)) using @milliseconds:(column("resistance [ohm]") / 1e3) with lines linetype 1 title "exact", \
  series_physical(run(1)) using @milliseconds:(column("resistance_long_conductor [ohm]") / 1e3) with lines linetype 2 title "long conductor"
unset key; set format x "%g"
set xlabel "time / ms"; set ylabel "{/:Italic Q} / (nl/s)"; set yrange [*:*]
plot series_physical(run(1)) using @milliseconds:(1e12 * column("flow_rate [m3/s]")) with lines linetype 1
unset multiplot
print sprintf("**A pulse in ohm.** An artificial capsule of 20 µm passes a pore of 25 µm under 500 Pa: %.1f kΩ,", height), \
  sprintf("%.1f %% of the empty pore, for %.1f ms.", 100 * entry(results(run(1)), "    \"relative_pulse_height\""), width)

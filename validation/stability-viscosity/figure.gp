directory = "results/".case
systems = directory."/systems.csv"
entrances = directory."/entrances.csv"
steady = directory."/steady.csv"
stats systems using (column("condition")) name "condition" nooutput
stats systems using (column("deviation")) name "eigenvalue" nooutput
stats systems using (column("corrections")) name "corrections" nooutput
stats entrances using (column("seconds")) name "seconds" nooutput
stats entrances using (column("viscosity_ratio") == 1 ? column("seconds") : NaN) name "one" nooutput
stats entrances using (column("volume_change")) name "volume" nooutput
stats steady using (column("accuracy") < 1e-6 ? column("difference") : NaN) name "steady" nooutput
stats steady using (column("residual")) name "residual" nooutput

eval figure("stability-viscosity", 12, 8)
set logscale xy; set format "10^{%T}"; set format y2 "%g"
larger(x) = condition_max / 1000 * (x > 1 ? x : 1 / x)
set xrange [5e-4:2e3]; set yrange [1:1e4]
set xlabel "{/:Italic λ}"; set ylabel "condition number"
set ytics nomirror; set y2label "seconds of an entrance"; set y2range [0:*]; set y2tics; set border 11
set key outside top center horizontal
plot systems using "viscosity_ratio":"condition" with points linetype 1 title "condition number", \
  larger(x) with lines linetype 1 linecolor rgb "#808080" title "∝ larger of {/:Italic λ}, 1/{/:Italic λ}", \
  entrances using "viscosity_ratio":"seconds" axes x1y2 with linespoints linetype 2 title "seconds"
print "**Viscosity ratios from 0.001 to 1000.** The condition number of the membrane's system grows like the larger of λ", \
  sprintf("and 1/λ, up to %.0f, because its smallest eigenvalue is the smaller of 1 and λ, which the solver finds within %.0e.", \
    condition_max, eigenvalue_max), \
  sprintf("With the inverse of the previous shape the solver needs %.0f to %.0f corrections for ten digits. All entrances reach", \
    corrections_min, corrections_max), \
  sprintf("x_g = 1, in at most %.1f times the time of λ = 1; the volume changes by less than %.0e, and the pressure drop of one steady", \
    seconds_max / one_max, volume_max), \
  sprintf("shape depends on λ by at most %.0e, which is in proportion to the velocity of %.0e that remains.", steady_max, residual_max)

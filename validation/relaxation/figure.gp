rates = "results/".case."/rates.csv"
marches = "results/".case."/marches.csv"
of(ratio, name) = system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} $1 == ".ratio." {print $k[\"".name."\"]}' ".marches) + 0

eval figure("relaxation", 13, 9)
set logscale xy
set xrange [0.008:125]
set xlabel "λ"; set ylabel "rate of relaxation / ({/:Italic Q}/π{/:Italic R}_t^3)"
set key bottom left reverse Left
plot rates using "viscosity_ratio":(-column("growth_rate")) with linespoints linetype 1 pointsize 0.4 title "slowest eigenvalue", \
  marches using "viscosity_ratio":(-column("measured")) with points linetype 2 pointsize 1.2 title "decay of max |{/:Italic v_r}| in marches"
print "**Relaxation in the tube.** Rate at which Table 2's capsule approaches its steady state, against the viscosity ratio.", \
  sprintf("λ = 5 and 10 relax at %.3f and %.3f; their marches, from x_g = 9 to 11.84, at %.3f and %.3f.", \
    -of("5", "growth_rate"), -of("10", "growth_rate"), -of("5", "measured"), -of("10", "measured")), \
  sprintf("For λ = 10 the eigenvalue makes the residual at x_g = 9 fall to max|v_r| = %.2e at 11.84; the march has %.2e, Table 2 %.2e.", \
    of("10", "predicted"), of("10", "residual"), published_of("fig07-viscosity-sphere viscosity_ratio=10", "T2-10-vr")), \
  sprintf("It would reach the level of the other runs, 2.1e-5, at x_g = %.1f.", of("10", "steady_at"))

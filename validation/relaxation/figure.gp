rates = "results/".case."/rates.csv"
rows = "results/".case."/rows.csv"
cell_of(row, name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} $1 == \"".row."\" {print $k[\"".name."\"]}' ".rows))

stats rates using (column("viscosity_ratio") > 99 ? -100 * column("growth_rate") : NaN) name "thick" nooutput

eval figure("relaxation", 13, 9)
set logscale xy
set xrange [0.008:125]; set yrange [0.03:2]
set xlabel "{/:Italic λ}"; set ylabel "rate of relaxation / ({/:Italic Q}/π{/:Italic R}_t^3)"
set key bottom left
plot rates using "viscosity_ratio":(-column("growth_rate")) with linespoints linetype 1 pointsize 0.4 title "slowest small motion", \
  [12:100] thick_max / x with lines linetype 2 title "∝ 1/λ"
print "**Relaxation in the tube.** Rate at which Table 2's capsule approaches its steady state, by the slowest small motion about it,", \
  sprintf("against the viscosity ratio: %.3f, %.3f, %.3f and %.3f for λ = 0.2, 1, 5 and 10.", -cell_of("Table 2 0.2", "growth_rate"), \
    -cell_of("Table 2 1", "growth_rate"), -cell_of("Table 2 5", "growth_rate"), -cell_of("Table 2 10", "growth_rate"))

eval figure("relaxation-residuals", 14, 9)
set logscale y; set format y "10^{%T}"
set xrange [-0.6:4.6]; set yrange [1e-6:1e-2]
set xtics ("Table 1" 0, "Table 2, λ = 0.2" 1, "λ = 1" 2, "λ = 5" 3, "λ = 10" 4)
set ylabel "residual velocity / ({/:Italic Q}/π{/:Italic R}_t^2)"
set key top left
plot rows using ($0 - 0.24):"radial_predicted" with points linetype 1 pointtype 1 pointsize 1.5 title "max |{/:Italic v_r}|: small motions", \
  rows using ($0 - 0.16):"radial_in_paper" with points linetype 1 pointtype 4 title "march in the paper's tube", \
  rows using ($0 - 0.08):"radial_published" with points linetype 1 pointtype 7 title "published", \
  rows using ($0 + 0.08):"axial_predicted" with points linetype 2 pointtype 1 pointsize 1.5 title "max |{/:Italic v_x − v}_g|: small motions", \
  rows using ($0 + 0.16):"axial_in_paper" with points linetype 2 pointtype 4 title "march in the paper's tube", \
  rows using ($0 + 0.24):"axial_published" with points linetype 2 pointtype 7 title "published"
print "**The residual velocities of Tables 1 and 2.** Those of a march at x_g = 9, continued by all small motions about the steady state to", \
  "the place of the tables; marches in the paper's tube; and published ones.", \
  sprintf("For λ = 10, max |v_r| is %.2e by the small motions, %.2e in the march, %.2e in the table; max |v_x − v_g| is %.2e, %.2e and %.2e.", \
    cell_of("Table 2 10", "radial_predicted"), cell_of("Table 2 10", "radial_in_paper"), cell_of("Table 2 10", "radial_published"), \
    cell_of("Table 2 10", "axial_predicted"), cell_of("Table 2 10", "axial_in_paper"), cell_of("Table 2 10", "axial_published")), \
  sprintf("To be as steady as the table calls the others, 2.1e-5, it would need a tube in which it gets to x_g = %.1f (in the march: %.1f).", \
    cell_of("Table 2 10", "steady_at"), cell_of("Table 2 10", "steady_at_in_march"))

relaxation = "results/".case."/relaxation.csv"
lambdas = "0.2 1 5 10"
history(i) = "results/".case."/viscosity_ratio=".word(lambdas, i)."/series.csv"
name(i) = "{/:Italic λ} = ".word(lambdas, i)
line(i) = linetype_of_ratio(word(lambdas, i) + 0, i)
row(i, column) = number(system(sprintf("awk -F, 'NR == 1 {for (k = 1; k <= NF; ++k) c[$k] = k} NR == %d {printf \"%%.16e\", $c[\"%s\"]}' %s", \
  i + 1, column, relaxation)))
rate(i) = row(i, "rate")
lengths = ""; residuals = ""; marks = ""; pressures = ""
array A[4]; array R[4]
do for [i=1:4] {
  A[i] = row(i, "amplitude"); R[i] = rate(i)
  residual = published_of("fig07-viscosity-sphere", "T2-".word(lambdas, i)."-vx")
  marks = marks.mark(line(i), 11.84, residual)
  lengths = listed(lengths, sprintf("%.2f (λ = %s)", 1 / rate(i), word(lambdas, i)))
  residuals = listed(residuals, sprintf("%.1e", row(i, "residual_at_table2")))
  pressures = listed(pressures, sprintf("%.4f", row(i, "pressure_drop")))
}
marks = marks.marks_title(marks, "Table 2")

eval figure("relaxation", 12, 8)
set logscale y; set format y "10^{%T}"
set xrange [0:56]; set yrange [1e-7:1]
set xlabel x_g_label; set ylabel "max |{/:Italic v}_x − {/:Italic v}_g| / ({/:Italic Q}/π{/:Italic R}_t^2)"
set key at 55, 0.9 right top
plot for [i=1:4] history(i) using "x_g":"max_axial_residual" with lines linetype line(i) title name(i), \
  for [i=1:4] A[i] * exp(-R[i] * x) with lines linetype line(i) linewidth 0.5 dashtype 1 @marks
print "**Relaxation along the tube.** The largest velocity of the membrane relative to the capsule decays exponentially,", \
  "the slower the more viscous the inner liquid: it falls by a factor of e in", lengths, "pore radii.", \
  sprintf("At x_g = 11.84, where Table 2 is taken, it is still %s:", residuals), \
  "the rows of the viscous capsules are on their way. Once settled in tubes long enough, the pressure drops are", pressures."."

comparison = "results/".case."/comparison.csv"
cell(row, column) = system(sprintf("awk -F, 'NR == 1 {for (k = 1; k <= NF; ++k) c[$k] = k} NR == %d {printf \"%%s\", $c[\"%s\"]}' %s", \
  row + 1, column, comparison))
rows = number(system("awk 'END {print NR - 1}' ".comparison))
worst = 0; worst_meshes = 0; seconds = 0; march_seconds = 0
larger(a, b) = a > b ? a : b
do for [i=1:rows] {
  worst = larger(worst, larger(number(cell(i, "v_g_apart")), number(cell(i, "pressure_drop_apart"))))
  worst_meshes = larger(worst_meshes, number(cell(i, "meshes_apart")))
  seconds = seconds + cell(i, "seconds"); march_seconds = march_seconds + cell(i, "march_seconds")
}

eval figure("agreement", 14, 8)
set logscale y; set format y "10^{%T}"
set yrange [1e-10:1e-4]; set xrange [0.5:rows + 0.5]
set xtics rotate by -30
set ylabel "relative distance"
set bmargin 5
set key top right horizontal
plot comparison using ($0 + 1):"v_g_apart":xtic(1) with points linetype 1 title "march, {/:Italic v}_g", \
  comparison using ($0 + 1):"pressure_drop_apart" with points linetype 2 title "march, Δ{/:Italic P}", \
  comparison using ($0 + 1):"meshes_apart" with points linetype 3 title "another mesh"
print sprintf("**Steady states without marching.** %d capsules, found directly and by marches through a long tube: speed and", rows), \
  sprintf("pressure drop are %.0e apart at most, on two meshes of the steady state %.0e.", worst, worst_meshes), \
  sprintf("Together they took %.0f s of one core, the marches %.0f s.", seconds, march_seconds)

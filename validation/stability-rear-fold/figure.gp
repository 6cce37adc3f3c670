directory = "results/".case
folds = directory."/folds.csv"
meshes = directory."/meshes.csv"
field(name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} NR == 2 {print $k[\"".name."\"]}' ".directory."/fit.csv"))
p = field("curvature_slope"); q = field("nodes_slope"); softest = field("softest")
at(delta, column) = number(system(sprintf("awk -F, 'NR > 1 && $1 / %e < 1.01 && $1 / %e > 0.99 {print $%d}' %s", delta, delta, column, folds)))
hard = number(system("awk -F, 'NR > 1 && $5 != \"nan\" {print $1}' ".folds." | tail -1"))
nodes_at_end = at(hard, 5)
sizes = system("awk -F, 'NR > 1 && !s[$2]++ {print $2}' ".meshes)
last_of(nodes) = number(system("awk -F, 'NR > 1 && $2 == ".nodes." {x = $1} END {print x}' ".meshes))
worst = number(system("awk -F, 'NR > 1 && $8 > m {m = $8} END {print m}' ".meshes))
delta_label = "bending ratio δ"
finest = word(sizes, words(sizes))

eval figure("rear-fold", 12, 9)
set logscale xy; set format x "10^{%T}"
set xrange [8e-7:1e-2]; set yrange [5:300]
set ytics (5, 10, 20, 50, 100, 200)
set xlabel delta_label; set ylabel "curvature × {/:Italic R}_t;  nodes"
set key bottom left
plot meshes using ($2 == finest ? $1 : NaN):"curvature" with linespoints linetype 1 title "largest curvature, ".finest." nodes", \
  [softest:1e-3] at(1e-3, 2) * (x / 1e-3) ** p with lines linetype 1 linewidth 0.7 dashtype 3 title gprintf("δ^{%.2f}", p), \
  folds using "bending_ratio":"nodes" with points linetype 2 title "nodes for 1 % of it", \
  [hard / 3:1e-3] nodes_at_end * (x / hard) ** q with lines linetype 2 linewidth 0.7 dashtype 3 title gprintf("δ^{%.2f}", q), \
  for [i = 1:words(sizes)] "+" using (last_of(word(sizes, i))):(word(sizes, i) + 0) every ::::0 with points linetype 3 \
    title i == 1 ? "softest membrane of a mesh (tried to 10^{−6})" : ""
print "**The rear fold.** Table 3's capsule (Skalak, A/B = 0.28, steady): largest curvature of the meridian, at the rim of the rear, against the", \
  sprintf("bending stiffness, and the nodes that give it to 1 %%. The curvature grows like δ^%.2f from δ = 1e-3 to %.0e,", p, softest), \
  sprintf("from %.1f to %.1f; the nodes like δ^%.2f, up to %.0f. Triangles: the softest membrane that a branch on a mesh reaches.", \
    at(1e-3, 2), at(softest, 2), q, nodes_at_end)

eval figure("rear-fold-meshes", 12, 9)
set logscale xy; set format x "10^{%T}"; set format y "10^{%T}"
set xrange [8e-7:1e-2]; set yrange [1e-10:1e-1]
set xlabel delta_label; set ylabel "relative error"
set key outside top center maxrows 4
plot for [i = 1:words(sizes) - 1] meshes using ($2 == word(sizes, i) + 0 ? $1 : NaN):"curvature_error" with linespoints linetype i \
    title "curvature, ".word(sizes, i)." nodes", \
  for [i = 1:words(sizes) - 1] meshes using ($2 == word(sizes, i) + 0 ? $1 : NaN):"pressure_error" with linespoints linetype i \
    linewidth 0.7 pointsize 0.5 title "Δ{/:Italic P}, ".word(sizes, i)." nodes"
print "**What a mesh resolves.** Errors of the largest curvature and of the pressure drop against ".finest." nodes. Lines end with the last", \
  "membrane for which Newton's method finds a solution on the mesh; for softer ones the program says unresolved. The pressure drop hardly depends", \
  sprintf("on the curvature of the fold: a mesh fails before it is wrong by more than %.1e.", worst)

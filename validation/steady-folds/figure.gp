folds = "results/".case."/folds.csv"
branches = "results/".case."/skalak.csv"
of(capsule, name) = strcol("capsule") eq capsule ? column(name) : NaN
most(file, expression) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} {v = ".expression."; if (v < 0) v = -v; if (v > m) m = v} END {print m + 0}' ".file))
# How each of Skalak's branches ends.
ends_of(dilatation, radius) = system("awk -F, '$1 == ".dilatation." && $2 == ".radius." {printf \"%s at ε = %.3f\", $4 == \"mesh\" ? \"unresolved\" : $4, $5}' ".branches)." (R_eq = ".radius.")"
fold_at(capsule, radius, name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} $1 == \"".capsule."\" && $4 == ".radius." {print $k[\"".name."\"]}' ".folds))
set datafile missing NaN

eval figure("critical-capillary-number", 14, 9)
set xrange [0.68:1.12]; set yrange [0:*]
set xlabel "{/:Italic R}_{eq} / {/:Italic R}_t"; set ylabel "critical {/:Italic ε}"
set key top right
plot folds using (of("sphere", "radius")):(of("sphere", "capillary_number")) with linespoints linetype 1 \
    title "sphere, δ = 0.001", \
  folds using (of("stiff sphere", "radius")):(of("stiff sphere", "capillary_number")) with linespoints linetype 2 \
    title "sphere, δ = 0.01", \
  folds using (of("flat", "radius")):(of("flat", "capillary_number")) with linespoints linetype 3 \
    title "{/:Italic A/B} = 0.5, δ = 0.001"
print "**Beyond Figure 19: the critical capillary number.** Above the line a neo-Hookean capsule has no steady state:", \
  "its branch turns back there and the membrane stretches without bound.", \
  sprintf("For a sphere of δ = 0.001 it falls from %.4f at R_eq = 0.7 to %.4f at 1.1; the stretch at the fold is %.2f and %.2f.", \
    fold_at("sphere", "0.7", "capillary_number"), fold_at("sphere", "1.1", "capillary_number"), \
    fold_at("sphere", "0.7", "max_stretch"), fold_at("sphere", "1.1", "max_stretch")), \
  sprintf("Folds on two meshes are at most %.0e apart, growth rates there at most %.0e.", \
    most(folds, "$k[\"capillary_number\"] - $k[\"coarse\"]"), most(folds, "$k[\"growth_rate\"]")), \
  "Branches of Skalak's law, δ = 0.01, are not seen to run away. With C = 10: ".ends_of("10", "1.1").",", \
  "with C = 1: ".ends_of("1", "0.9").", ".ends_of("1", "1.1").", where the shell buckles;", \
  "with C = 0: ".ends_of("0", "0.7").", ".ends_of("0", "0.9").", ".ends_of("0", "1.1")."."

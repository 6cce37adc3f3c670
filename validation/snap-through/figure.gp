file(name) = "results/".case."/".name.".csv"
of(name, condition) = "<awk -F, 'NR == 1 || (".condition.")' ".file(name)
law_names = "neo-Hookean|Skalak C = 0|Skalak C = 1|Skalak C = 10"
law(k) = system(sprintf("printf '%%s' '%s' | cut -d'|' -f%d", law_names, k))
title_of(k) = word("neo-Hookean Skalak,@{/:Italic@C}@=@0 Skalak,@{/:Italic@C}@=@1 Skalak,@{/:Italic@C}@=@10", k)
spaced(text) = system("printf '%s' \"".text."\" | tr @ ' '")
# Lines of folds, drawn as far as they were followed: a blank line parts one from the next.
line_of(k, key) = sprintf("<awk -F, 'NR == 1 || ($1 == \"%s\" && $3 == \"%s\") {if ($5 != \"\" && t != $2 $4) print \"\"; t = $2 $4; if ($5 != \"\") print}' %s", law(k), key, file("folds"))
cusps_of(key) = sprintf("<awk -F, 'NR == 1 || $2 == \"%s\"' %s", key, file("cusps"))
lines(key) = sprintf("plot for [k=1:3] line_of(k, '%s') using 'value':'capillary_number' with lines linetype k title spaced(title_of(k)), cusps_of('%s') using 'value':'capillary_number' with points pointtype 7 pointsize 0.5 linecolor rgb '#404040' title 'cusp'", key, key)

eval figure("snap-through", 16, 15)
set multiplot layout 2,2
set xlabel "{/:Italic ε}"; set ylabel pressure_label
set xrange [0.007:0.0145]; set yrange [16.9:18.6]; set xtics 0.002
set key top right
set title "Skalak, {/:Italic C} = 1"
one = "$1 == \"Skalak C = 1\" && $2 == \"point\""
plot of("branches", one) using "capillary_number":"pressure_drop" with lines linetype 8 title "steady", \
  of("branches", one." && $7 > 0") using "capillary_number":"pressure_drop" with lines linetype 8 dashtype 2 linewidth 2 title "unstable", \
  of("marches", "$1 == \"rising\"") using "capillary_number":"pressure_drop" with points linetype 1 pointtype 8 title "marches, flow rising", \
  of("marches", "$1 == \"falling\"") using "capillary_number":"pressure_drop" with points linetype 2 pointtype 10 title "falling"
set title "both states between the lines"
set logscale y; set xtics auto; set yrange [0.004:0.05]; set ytics (0.005, 0.01, 0.02, 0.05)
set ylabel "{/:Italic ε}"
set xlabel "{/:Italic R}_{eq} / {/:Italic R}_t"; set xrange [0.48:1]
eval lines("capsule.radius")
unset key
set xlabel "{/:Italic δ}"; set logscale x; set xrange [1.5e-4:3e-3]; set xtics (2e-4, 5e-4, 1e-3, 2e-3); set yrange [0.002:0.02]; set ytics (0.002, 0.005, 0.01, 0.02)
eval lines("membrane.bending_ratio")
set yrange [0.004:0.05]; set ytics (0.005, 0.01, 0.02, 0.05)
set xlabel "{/:Italic A}/{/:Italic B}"; unset logscale x; set xtics auto; set xrange [0.8:1.55]
eval lines("capsule.aspect_ratio")
unset multiplot
cell_of(name, condition, column) = system("awk -F, 'NR > 1 && ".condition." {print $".column."; exit}' ".file(name))
fold(k, which) = system(sprintf("awk -F, '$1 == \"%s\" && $2 == \"fold\" {print $3}' %s | sed -n %dp", law(k), file("branches"), which)) + 0
print "**Round or dented: two stable states of one capsule.** Upper left: a Skalak capsule with C = 1, R_eq = 0.9, δ = 1e-3.", \
  sprintf("Its rear snaps to a dent at ε = %.5f where the flow rises, and back at %.5f where it falls;", fold(3, 1), fold(3, 2)), \
  sprintf("at ε = 0.0116 the drop is %.2f or %.2f.", cell_of("marches", "$1 == \"rising\" && $2 == 0.0116", 3) + 0, cell_of("marches", "$1 == \"falling\" && $2 == 0.0116", 3) + 0), \
  "The other panels: the two folds over size, bending stiffness and shape; they meet in cusps, beyond which the dent grows without a snap."

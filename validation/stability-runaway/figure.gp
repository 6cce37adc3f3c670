directory = "results/".case
marches = directory."/marches.csv"
histories = directory."/histories.csv"
field(file, name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} NR == 2 {print $k[\"".name."\"]}' ".directory."/".file))
exponent = field("fit.csv", "exponent")
factor = field("fit.csv", "factor")
offset = field("fit.csv", "offset")
predicted = field("fit.csv", "predicted_factor")
fold = field("fit.csv", "fold")
fold_stretch = field("fit.csv", "fold_stretch")
pore(row, column) = system(sprintf("awk -F, 'NR == %d {print $%d}' %s/pore.csv", row + 1, column, directory))
distance_label = "distance from the fold, {/:Italic ε} − {/:Italic ε}_c"

exponent_to_3 = field("fit.csv", "exponent_to_3")
eval figure("stability-runaway", 12, 9)
set logscale xy; set format x "10^{%T}"
set xrange [3e-5:3e-2]; set yrange [10:2000]
set xlabel distance_label; set ylabel time_label
set key bottom left
plot marches using ($1 > 0 ? $1 : NaN):"end" with points linetype 1 pointsize 1.2 title "until unbounded (stretch 4)", \
  marches using ($1 > 0 ? $1 : NaN):"time" with points linetype 2 title "to a stretch of 3", \
  [3e-5:4e-3] factor / sqrt(x) + offset with lines linetype 1 title sprintf("%.2f (ε − ε_c)^{−1/2} − %.0f", factor, -offset), \
  predicted / sqrt(x) with lines linetype 3 title "2π / slowest rate at the same distance below"
print "**Slow passage at a fold.** Time that a neo-Hookean sphere (R_eq = 0.7, δ = 0.01) takes in an endless tube from rest until the program", \
  sprintf("calls it unbounded, just above its fold (ε = %.6f, stretch %.2f). Without its constant part, spent before and after the", fold, fold_stretch), \
  sprintf("passage, it goes like (ε - ε_c)^%.3f; the factor is %.2f, and %.2f by the eigenvalue of the stable states below.", \
    exponent, factor, predicted), \
  sprintf("A stretch of 3 is only a little above that of the fold, so the time to it still goes like (ε - ε_c)^%.2f.", exponent_to_3)

eval figure("stability-runaway-histories", 12, 9)
set logscale x; set xrange [1:1000]; set yrange [1:4.2]
set xlabel time_label; set ylabel "largest stretch, ".stretch_label
set key top left
values = system("awk -F, 'NR > 1 && !($1 in s) {s[$1] = 1; print $1}' ".histories)
set arrow from 1, fold_stretch to 1000, fold_stretch nohead linecolor rgb "#888888" dashtype 3
plot for [i = 1:words(values)] histories using (abs($1 - word(values, i)) < 1e-10 ? $2 : NaN):3 with lines \
    linetype (word(values, i) + 0 > fold ? 2 : 1) title i == 1 ? "above the fold" : i == words(values) ? "below" : ""
print sprintf("**Above and below the fold.** Largest stretch against time for %d capillary numbers within %.3f of the fold (dotted: stretch there).", \
    words(values), abs(word(values, 1) - fold)), \
  "Below the fold capsules come to rest. Above it they stay near the fold, longer when they are closer to it, and then run away; each march ends as unbounded.", \
  sprintf("The paper's pore is too short to see this: at ε_c + %.3f the capsule has %s x_g = %.1f with a stretch of %.2f.", \
    number(pore(4, 1)), pore(4, 2), number(pore(4, 3)), number(pore(4, 4)))

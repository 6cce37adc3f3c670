trials = "results/".case."/trials.csv"
summary = "results/".case."/summary.csv"
laws = "results/".case."/laws.csv"
cell(variant, name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} $1 == \"".variant."\" {print $k[\"".name."\"]}' ".summary))
against_noise(q) = sprintf("< printf 'noise,error\\n0.25,%g\\n0.5,%g\\n1,%g\\n2,%g\\n'", cell("noise 0.25", q), cell("law known", q), \
  cell("noise 1", q), cell("noise 2", q))
wrong = sprintf("< printf 'place,bias\\n1,%g\\n2,%g\\n3,%g\\n4,%g\\n5,%g\\n'", cell("no pre-stress", "modulus_bias"), \
  cell("ten times the bending", "modulus_bias"), cell("as skalak", "modulus_bias"), cell("as generalised-hooke", "modulus_bias"), \
  cell("as neo-hookean", "modulus_bias"))

eval figure("fit", 16, 8)
set multiplot layout 1, 2
set logscale xy; set format "%g"
set xrange [0.2:2.5]; set yrange [1e-6:0.1]; set format y "10^{%T}"
set xtics (0.25, 0.5, 1, 2)
set xlabel "noise of a point / pixel"; set ylabel "error, of half of the capsules"
set key bottom right
plot against_noise("modulus_median") using 1:2 with linespoints linetype 1 pointtype 7 pointsize 0.5 title "{/:Italic G}, relative", \
  against_noise("inflation_median") using 1:2 with linespoints linetype 3 pointtype 7 pointsize 0.5 title "inflation", \
  against_noise("size_median") using 1:2 with linespoints linetype 2 pointtype 7 pointsize 0.5 title "{/:Italic a}, relative", \
  0.027 with lines linetype 1 linecolor rgb "#808080" dashtype 3 title "{/:Italic G}, Quesada et al.", \
  0.002 with lines linetype 2 linecolor rgb "#808080" dashtype 4 title "{/:Italic a}, Quesada et al."
unset logscale x
set xtics 0.02, 0.02; set yrange [0.1:1e4]; set xrange [0.015:0.105]
set xlabel "{/:Italic ε}"; set ylabel "AIC of Skalak less that of NH"
set key bottom right
plot laws using (column("inflation_known") == 1 ? column("capillary_number") : NaN):"aic_difference" with linespoints linetype 1 pointtype 7 pointsize 0.4 title "inflation known", \
  laws using (column("inflation_known") == 0 ? column("capillary_number") : NaN):"aic_difference" with linespoints linetype 2 pointtype 7 pointsize 0.4 title "not known", \
  6 with lines linecolor rgb "#808080" dashtype 3 title "evidence 20 to 1"
unset multiplot
print "**Fits of synthetic images.** Left: errors of half of the capsules against the noise of a point, at a pixel of 0.01 R_t, the law known.", \
  sprintf("With half a pixel: %.3f %% of the size, %.2f %% of G, %.1e of the inflation.", 100 * cell("law known", "size_median"), \
    100 * cell("law known", "modulus_median"), cell("law known", "inflation_median")), \
  "Right: how strongly one image tells a neo-Hookean membrane from a Skalak one (C = 1), a = 0.9, inflation 3 %: where half a pixel of noise leaves", \
  "the inflation unknown, from ε = 0.03 on."

eval figure("fit-bias", 14, 8)
set boxwidth 0.5; set style fill solid
set xrange [0.4:5.6]; set yrange [-60:100]
set xtics ("no pre-stress" 1, "bending × 10" 2, "as Skalak" 3, "as Hooke" 4, "as NH" 5)
set ylabel "error of {/:Italic G} / %"
set xzeroaxis; unset key
plot wrong using 1:(100 * $2) with boxes linetype 1
print "**What wrong assumptions do to G.** Median error where the fit knows no pre-stress (there is 0 to 10 %), takes the bending stiffness for ten", \
  "times as large, or takes the law for another one, with the inflation free.", \
  sprintf("Without pre-stress it is %+.0f %%, while an error of the bending stiffness costs %.1f %%.", 100 * cell("no pre-stress", "modulus_bias"), \
    100 * cell("ten times the bending", "modulus_bias"))

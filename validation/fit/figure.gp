trials = "results/".case."/trials.csv"
summary = "results/".case."/summary.csv"
laws = "results/".case."/laws.csv"
views = "results/".case."/views.csv"
cell(variant, name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} $1 == \"".variant."\" {print $k[\"".name."\"]}' ".summary))
against_noise(q) = sprintf("< printf 'noise,error\\n0.25,%g\\n0.5,%g\\n1,%g\\n2,%g\\n'", cell("noise 0.25", q), cell("law known", q), \
  cell("noise 1", q), cell("noise 2", q))
# Shares, and the standard deviation of a share of 90 % in so many fits.
line_of(noise, variant, q) = sprintf("%g,%g,%g\\n", noise, 100 * cell(variant, q), 30 / sqrt(cell(variant, "fits")))
shares(q) = "< printf 'noise,share,deviation\\n".line_of(0.25, "noise 0.25", q).line_of(0.5, "law known", q).line_of(1, "noise 1", q). \
  line_of(2, "noise 2", q)."'"
view(name, parachute) = number(system("awk -F, '$1 == \"".name."\" && $2 == ".parachute." {print $4}' ".views))
bars(parachute) = sprintf("< printf 'place,error\\n1,%g\\n2,%g\\n3,%g\\n4,%g\\n'", view("law known", parachute), view("velocity", parachute), \
  view("silhouette", parachute), view("silhouette and velocity", parachute))
wrong = sprintf("< printf 'place,bias\\n1,%g\\n2,%g\\n3,%g\\n4,%g\\n5,%g\\n'", cell("no pre-stress", "modulus_bias"), \
  cell("ten times the bending", "modulus_bias"), cell("as skalak", "modulus_bias"), cell("as generalised-hooke", "modulus_bias"), \
  cell("as neo-hookean", "modulus_bias"))

eval figure("fit", 22, 8)
set multiplot layout 1, 3
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
unset logscale y; set format y "%g"
set yrange [70:100]; set ytics 70, 5
set ylabel "intervals of 90 % that contain the truth / %"
set key bottom right
plot shares("modulus_inside") using ($1 / 1.04):2:3 with yerrorbars linetype 1 pointtype 7 pointsize 0.5 title "{/:Italic G}", \
  shares("inflation_inside") using 1:2:3 with yerrorbars linetype 3 pointtype 7 pointsize 0.5 title "inflation", \
  shares("size_inside") using ($1 * 1.04):2:3 with yerrorbars linetype 2 pointtype 7 pointsize 0.5 title "{/:Italic a}", \
  90 with lines linecolor rgb "#808080" dashtype 3
unset logscale x; set logscale y; set format y "10^{%T}"; set ytics autofreq
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
  "Middle: intervals of 90 % that contain the truth, with the standard deviation of such a share.", \
  "Right: how strongly one image tells a neo-Hookean membrane from a Skalak one (C = 1), a = 0.9, inflation 3 %: where half a pixel of noise leaves", \
  sprintf("the inflation unknown, from ε = %.2f on.", entry("results/".case, " \"told_apart_from\""))

eval figure("fit-bias", 14, 8)
set boxwidth 0.5; set style fill solid
set xrange [0.4:5.6]; set yrange [*:*]
set xtics ("no pre-stress" 1, "bending × 10" 2, "as Skalak" 3, "as Hooke" 4, "as NH" 5)
set ylabel "error of {/:Italic G} / %"
set xzeroaxis; unset key
plot wrong using 1:(100 * $2) with boxes linetype 1
print "**What wrong assumptions do to G.** Median error where the fit knows no pre-stress (there is 0 to 10 %), takes the bending stiffness for ten", \
  "times as large, or takes the law for another one, with the inflation free.", \
  sprintf("Without pre-stress it is %+.0f %%, while an error of the bending stiffness costs %.1f %%.", 100 * cell("no pre-stress", "modulus_bias"), \
    100 * cell("ten times the bending", "modulus_bias"))

eval figure("fit-views", 14, 8)
set boxwidth 0.35; set style fill solid
set xrange [0.4:4.6]; set yrange [0:*]
set xtics ("meridian" 1, "velocity 1 %%" 2, "silhouette" 3, "both" 4)
set ylabel "standard error of {/:Italic G} / %"
set key above
plot bars(1) using ($1 - 0.19):(100 * $2) with boxes linetype 1 title "concave rear", \
  bars(0) using ($1 + 0.19):(100 * $2) with boxes linetype 3 dashtype 1 title "convex"
print "**What is seen.** Median standard error of G from the whole meridian, with the velocity known to 1 %, from a silhouette, in which a concave rear", \
  "is hidden behind its rim, and from both."

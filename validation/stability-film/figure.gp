directory = "results/".case
quadrature = directory."/quadrature.csv"
plugs = directory."/plugs.csv"
of(layer, points, tolerance) = strcol("layer") eq layer && column("points") == points && column("tolerance") == tolerance ? \
  column("error") : NaN
stats quadrature using (of("double", 12, 1)) name "gauss" nooutput
stats quadrature using (column("tolerance") < 1 ? column("error") / column("tolerance") : NaN) name "near" nooutput
stats quadrature using (column("film_over_panel")) name "film" nooutput
stats plugs using (strcol("end") eq "reached" ? column("film_over_panel") : NaN) name "panels" nooutput

eval figure("stability-film", 12, 10)
set logscale xy; set format "10^{%T}"
set xrange [5e-4:2]; set yrange [1e-16:1e1]
set xlabel "film / length of a panel"; set ylabel "relative error of the velocity"
set key outside top center maxrows 3
plot quadrature using "film_over_panel":(of("single", 12, 1)) with lines linetype 1 title "Gauss's rule, single layer", \
  quadrature using "film_over_panel":(of("double", 12, 1)) with lines linetype 2 title "Gauss's rule, double layer", \
  quadrature using "film_over_panel":(of("double", 5, 1)) with lines linewidth 1 linecolor rgb "#808080" \
    title "five points, double layer", \
  for [d in "6 8 10"] quadrature using "film_over_panel":(of("double", 12, 10 ** -d)) with lines linetype d / 2 \
    title "near rule, tolerance 10^{−".d."}"
print "**Quadrature of a thin film.** Error of the velocity beside a spheroid on 16 panels of 12 points, against a finely divided", \
  sprintf("one, for films from %.0e to %.1f of a panel. Gauss's rule alone is wrong by up to %.2g; the near rule never by more", \
    film_min, film_max, gauss_max), \
  sprintf("than %.1f times its tolerance. The thinnest film of the capsules below that enter is %.2f panels.", near_max, panels_min)

on(nodes, ratio, ended, name) = column("nodes") == nodes && column("viscosity_ratio") == ratio && \
  (strcol("end") eq "reached") == ended ? column(name) : NaN
stats plugs using (on(96, 1, 1, "min_film")) name "thick" nooutput
stats plugs using (on(96, 10, 1, "min_film")) name "thin" nooutput
stats plugs using (strcol("end") eq "reached" ? column("radius") : NaN) name "size" nooutput
stats plugs using (strcol("end") eq "reached" ? NaN : column("min_film")) name "pressed" nooutput
least = 2e-5
shown(film) = film < least ? least : film
ends = system("awk -F, 'NR > 1 && $4 != \"reached\" && !($4 in seen) {seen[$4] = 1; printf \"%s%s\", n++ ? \" or \" : \"\", $4}' ".plugs)
eval figure("stability-plugs", 12, 8)
set logscale y; set format y "10^{%T}"
set xrange [0.85:1.35]; set yrange [1e-5:1]
set xlabel "{/:Italic R}_{eq} / {/:Italic R}_t"; set ylabel "film at the end / {/:Italic R}_t"
set key outside top center maxrows 3
plot for [i=1:3] plugs using "radius":(on(96, 10 ** (i - 1), 1, "min_film")) with linespoints linetype linetype_of_ratio(10 ** (i - 1), 2) \
    title sprintf("{/:Italic λ} = %d", 10 ** (i - 1)), \
  for [n in "48 96"] plugs using (column("radius") + (n == 48 ? -0.004 : 0.004)):(shown(on(n, 100, 0, "min_film"))) \
    with points linetype 2 pointtype n / 12 + 3 title "{/:Italic λ} = 100, failed, ".n." nodes"
print "**Nearly plugged.** Film of Skalak capsules (C = 1, ε = 0.05, 96 nodes) at x_g = 3 against their size: sizes up to", \
  sprintf("%.1f enter, with films down to %.3f with λ = 1 and %.3f with λ = 10. A capsule a hundred times as viscous as the", \
    size_max, thick_min, thin_min), \
  sprintf("liquid outside deforms too slowly: the film at the lip goes down to %.0e and less, where the run ends as %s (none left: drawn at %.0e).", \
    pressed_max, ends, least)

directory = "results/".case
quadrature = directory."/quadrature.csv"
plugs = directory."/plugs.csv"
of(layer, tolerance) = strcol("layer") eq layer && column("tolerance") == tolerance ? column("error") : NaN
stats quadrature using (column("tolerance") == 1 ? column("error") : NaN) name "plain" nooutput
stats quadrature using (column("tolerance") < 1 ? column("error") / column("tolerance") : NaN) name "near" nooutput
stats quadrature using (column("film_over_panel")) name "film" nooutput
stats plugs using (strcol("status") eq "reached" ? column("film_over_panel") : NaN) name "panels" nooutput

eval figure("stability-film", 12, 10)
set logscale xy; set format "10^{%T}"
set xrange [5e-4:2]; set yrange [1e-16:1e1]
set xlabel "film / length of a panel"; set ylabel "relative error of the velocity"
set key outside top center maxrows 3
plot quadrature using "film_over_panel":(of("single", 1)) with lines linetype 1 title "Gauss's rule, single layer", \
  quadrature using "film_over_panel":(of("double", 1)) with lines linetype 2 title "Gauss's rule, double layer", \
  for [d in "6 8 10"] quadrature using "film_over_panel":(of("double", 10 ** -d)) with lines linetype d / 2 \
    title "near rule, tolerance 10^{-".d."}"
print "**Quadrature of a thin film.** Error of the velocity beside a spheroid on 16 panels of 12 points, against a finely divided", \
  sprintf("one, for films from %.0e to %.1f of a panel. Gauss's rule alone is wrong by up to %.2g; the near rule never by more", \
    film_min, film_max, plain_max), \
  sprintf("than %.1f times its tolerance. The thinnest film of the capsules below that come in is %.2f panels.", near_max, panels_min)

reached(ratio, name) = strcol("status") eq "reached" && column("viscosity_ratio") == ratio ? column(name) : NaN
failed(name) = strcol("status") eq "failed" ? column(name) : NaN
stats plugs using (reached(1, "radius")) name "size" nooutput
stats plugs using (reached(1, "min_film")) name "plug" nooutput
stats plugs using (failed("min_film")) name "thin" nooutput
failure = result_word("radius=1.1,viscosity_ratio=100", "failure")
eval figure("stability-plugs", 12, 8)
set logscale y; set format y "10^{%T}"
set xrange [0.8:1.4]; set yrange [1e-4:1]
set xlabel "{/:Italic R}_{eq} / {/:Italic R}_t"; set ylabel "film at the end / {/:Italic R}_t"
plot plugs using "radius":(reached(1, "min_film")) with points linetype 1 title "{/:Italic λ} = 1", \
  plugs using "radius":(reached(100, "min_film")) with points linetype 2 title "{/:Italic λ} = 100", \
  plugs using "radius":(failed("min_film")) with points linetype 3 title failure.", {/:Italic λ} = 100"
print "**Nearly plugged.** Film of Skalak capsules (C = 1, ε = 0.05, 48 nodes) at x_g = 3 against their size: with λ = 1 sizes up to", \
  sprintf("%.1f come in, with films down to %.3f. A capsule a hundred times as viscous as the liquid outside does not give way in time:", \
    size_max, plug_min), \
  sprintf("the film at the lip goes down to %.0e, where the run ends as %s.", thin_min, failure)

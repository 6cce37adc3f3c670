data = "results/".case."/estimates.csv"
quantities = "pressure_drop v_g time max_stretch front_stretch min_film length deformation max_axial_residual flow_rate resistance"
titles = "Δ{/:Italic@P} {/:Italic@v}_g time largest@stretch stretch@in@front film length deformation max@|{/:Italic@v}_x@-@{/:Italic@v}_g| flow@rate resistance"
spaced(text) = system("printf '%s' \"".text."\" | tr @ ' '")
# Velocities and stretches as they are, of the order of one or less; all others relative to the value at the end.
relative(name) = column(name) / (strstrt(strcol("quantity"), "max_") ? 1 : abs(column("value")))
on_the_way(quantity) = strcol("quantity") eq quantity."@x_g" && column("determined") == 1 ? 1 : NaN
of_a_value(x) = strstrt(strcol("quantity"), "@x_g") == 0 && column("determined") == 1 ? 1 : NaN
count(condition) = int(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} ".condition." {n++} END {print n + 0}' ".data))
capsules = int(system("cut -d, -f1 ".data." | sort -u | wc -l")) - 1

eval figure("error-estimate", 14, 11)
set logscale xy
set format "10^{%T}"
set xrange [1e-9:1e-1]; set yrange [1e-9:1e-1]
set size square
set xlabel "relative error, from a refined run"; set ylabel "relative error, estimated"
set key outside right top
plot x with lines linetype 1 linecolor rgb "#808080" title "error", \
  30 * x with lines linetype 1 dashtype (6, 3) linecolor rgb "#808080" title "30 times the error", \
  data using (relative("difference") * of_a_value(0)):(relative("estimate")) with points pointtype 7 pointsize 0.3 \
    linecolor rgb "#A0A0A0" title "at the end, peak", \
  for [q=1:11] data using (relative("difference") * on_the_way(word(quantities, q))):(relative("estimate")) \
    with points pointtype 3 + q linecolor (q - 1) % 5 + 1 title spaced(word(titles, q))
way(condition) = count("$k[\"quantity\"] ~ /@x_g/ && (".condition.")")
single(condition) = count("$k[\"quantity\"] !~ /@x_g/ && (".condition.")")
small = "$k[\"difference\"] - $k[\"floor\"] > $k[\"estimate\"]"
large = "$k[\"holds\"] == 0 && !(".small.")"
print "**Error estimates.** Estimated against true errors of", \
  sprintf("%d capsules, into a pore or through one with two mouths: spheres and ellipsoids, both laws, viscosity ratios from 0.2 to 10, accuracies from 1e-2 to 1e-6;", capsules), \
  sprintf("the largest along the way in colours, those of values at the end, at the peak and at their largest in grey. Of %d of the first", way("1")), \
  sprintf("%d estimates are too small and %d more than 30 times the error, of %d of the others %d and %d.", \
    way(small), way(large), single("1"), single(small), single(large)), \
  sprintf("%d are not drawn, because the refined runs leave them open.", count("$k[\"determined\"] == 0"))

data = "results/".case."/estimates.csv"
quantities = "pressure_drop peak_pressure_drop v_g time max_stretch front_stretch min_film length deformation"
titles = "Δ{/:Italic@P} peak@of@Δ{/:Italic@P} {/:Italic@v}_g time largest@stretch stretch@in@front film length deformation"
spaced(text) = system("printf '%s' \"".text."\" | tr @ ' '")
relative(name) = column(name) / abs(column("value"))
of(quantity) = strcol("quantity") eq quantity && column("determined") == 1 ? 1 : NaN
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
  for [q=1:9] data using (relative("difference") * of(word(quantities, q))):(relative("estimate")) \
    with points pointtype 3 + q linecolor (q - 1) % 5 + 1 title spaced(word(titles, q))
print "**Error estimates.** Estimated against true errors, both relative, of what summary.json reports at the end of", \
  sprintf("%d entrances: spheres and ellipsoids, both laws, viscosity ratios from 0.2 to 10, accuracies from 1e-3 to 1e-6.", capsules), \
  sprintf("Of %d values %d lie between the lines or are too small for the refined runs to say", count("1"), count("$k[\"holds\"] == 1")), \
  sprintf("(%d, not drawn); %d estimates are too small, and %d are more than 30 times the error.", count("$k[\"determined\"] == 0"), \
    count("$k[\"difference\"] - $k[\"floor\"] > $k[\"estimate\"]"), count("$k[\"estimate\"] > 30 * ($k[\"difference\"] + $k[\"floor\"])"))

fitted = "results/".case."/fit/fit.csv"
points = "results/".case."/fit/points.csv"
found(name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} {print $k[\"".name."\"]}' ".quoted(fitted)))
interval(name, scale, form) = sprintf(form." (".form." to ".form.")", scale * found(name), scale * found(name." low"), scale * found(name." high"))

eval figure("fit-example", 12, 9)
set size ratio -1
set xrange [-1:1.2]; set yrange [-1.1:1.1]
set xlabel x_label; set ylabel r_label
set key at 0.15, 0 center
set object 1 rectangle from graph 0, first 1 to graph 1, graph 1 fillcolor rgb wall_colour fillstyle solid noborder behind
set object 2 rectangle from graph 0, graph 0 to graph 1, first -1 fillcolor rgb wall_colour fillstyle solid noborder behind
plot points using "x":"r" with points linetype 3 pointtype 7 pointsize 0.15 title "points", \
  "" using (column("foot_x") + 10 * (column("x") - column("foot_x"))):(-column("foot_r") - 10 * (column("r") - column("foot_r"))) \
    with points linetype 2 pointtype 7 pointsize 0.15 title "distances × 10", \
  outline("results/".case."/fit/profiles.csv", "time", 0) using 1:2 with lines linetype 1 title "fitted meridian"
print "**A capsule fitted to its outline.** Points of one image, both halves above the axis; below it ten times as far from the fitted meridian.", \
  "Found, with 90 % intervals:", interval("physical.capsule_radius", 1e6, "%.2f"), "μm,", interval("physical.shear_modulus", 1e3, "%.2f"), "mN/m,", \
  "inflated by", interval("capsule.inflation", 100, "%.2f"), "%."

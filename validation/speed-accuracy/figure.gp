# The chart, how the time grows, and where it goes. File names: <scene>-<scheme>.csv
data = "results/".case."/"
scenes = "table1 skalak5 ellipsoid"
schemes = "standard rk4 euler paper"
scene_title(s) = word("neo-Hookean@sphere,@Table@1 Skalak@sphere,@{/:Italic@λ}@=@5 Skalak@ellipsoid,@{/:Italic@A}/{/:Italic@B}@=@0.28", s)
spaced(text) = system("printf '%s' \"".text."\" | tr @ ' '")
scheme_title(k) = word("standard@preset Runge-Kutta,@order@4 explicit@Euler paper's@numerics", int(k))
points_of(s, k) = data.word(scenes, s)."-".word(schemes, int(k)).".csv"
there(s, k) = int(system("cat ".points_of(s, k)." 2>/dev/null | awk 'END {print (NR > 1)}'"))
present(s) = (there(s, 1) ? "1 " : "").(there(s, 2) ? "2 " : "").(there(s, 3) ? "3 " : "").(there(s, 4) ? "4" : "")
reference_error(s) = number(system("awk -F, '$1 == \"".word(scenes, s)."\" {print $2}' ".data."references.csv"))
# The paper's first mesh in the files, and the march of the standard preset that is the fastest at less than a tenth
# of its error.
ratios(s) = there(s, 4) ? system("awk -F, 'FNR == 1 {next} FILENAME ~ /paper/ {if ($2 >= 60 && !n) {n = $2; t = $4; e = $6}; next} \
  n && $6 < e / 10 && t / $4 > best {best = t / $4; more = e / $6} \
  END {printf \"%.0f times faster than %d elements and %.0f times more accurate\", best, n, more}' ". \
  points_of(s, 4)." ".points_of(s, 1)) : "the paper's numerics reach the end on no mesh"
measures = "history_error steady_error volume_drift"
measure_title(m) = word("error@of@the@history@of@Δ{/:Italic@P} error@of@Δ{/:Italic@P}@at@{/:Italic@x}_g@=@11.5 drift@of@the@volume", m)
name_of(nodes, steps) = sprintf("%d, %s", nodes, steps < 10000 ? sprintf("%d", steps) : sprintf("%.0fk", steps / 1000))

# y = c x^p from the row `first` on.
fit_power(file, x, y, first) = sprintf("stats '%s' using (log(column('%s'))):(log(column('%s'))) every ::%d name 'fit' nooutput", \
  file, x, y, first)
columns = "lambda1 lambda5 paper"
column_title(c) = word("{/:Italic@λ}@=@1 {/:Italic@λ}@=@5 paper's@numerics", c)
# Of a column and of a scene: two are told by their viscosity ratio, the third has a colour of its own.
line(c) = linetype_of_ratio(word("1 5 0", c) + 0, 5)
scene_line(s) = linetype_of_ratio(word("1 5 0", s) + 0, 6)
kinds = "membrane wall"
array membrane_power[3]; array wall_power[3]; array scene_power[3]
do for [c=1:3] {
  eval fit_power(data."growth-membrane.csv", "nodes", word(columns, c), 3); membrane_power[c] = fit_slope
  eval fit_power(data."growth-wall.csv", "elements", word(columns, c), 2); wall_power[c] = fit_slope
}
do for [s=1:3] {
  eval fit_power(points_of(s, 1), "label", "seconds", 0); scene_power[s] = fit_slope
}
titled(text, power) = spaced(text).": ".gprintf("%.1f", abs(power) < 0.05 ? 0 : power)

eval figure("speed-accuracy", 24, 24)
set multiplot layout 3, 3 margins 0.075, 0.985, 0.055, 0.93 spacing 0.055, 0.05
set logscale xy
set format "10^{%T}"
set xrange [0.006:20000]
# Labels of neighbouring points stand on different sides; the fastest march of the standard preset has room on its left.
# Those of the explicit schemes have the rest.
on_left(k, row) = (k == 1) == (int(row) % 2 == 0)
label_x(k, x) = k == 3 ? x : on_left(k, column(0)) ? x / 4 : x * 4
label_y(k, y) = k == 2 ? y / 2 : k == 3 ? y * 2.4 : on_left(k, column(0)) ? y / 1.3 : y * 1.3
do for [m=1:3] {
  set yrange [(m == 3 ? 1e-10 : 1e-9):1]
  do for [s=1:3] {
    unset title; unset key; unset xlabel; unset ylabel
    if (m == 1) { set title spaced(scene_title(s)) }
    if (m == 3) { set xlabel "CPU seconds" }
    if (s == 1) { set ylabel spaced(measure_title(m)) }
    if (s == 3 && m == 1) { set key at graph 1, 0.02 right bottom } # where most room is
    plot for [k in present(s)] points_of(s, k) using "seconds":word(measures, m) with linespoints linetype int(k) notitle, \
      for [k in present(s)] points_of(s, k) using \
        (label_x(int(k), column("seconds"))):(label_y(int(k), column(word(measures, m)))): \
        (m == 1 ? name_of(column("nodes"), column("steps")) : "") \
        with labels center font ",7" textcolor linetype int(k) notitle, \
      for [k=1:4] NaN with linespoints linetype k title spaced(scheme_title(k))
  }
}
unset multiplot
print "**Speed and accuracy.** CPU seconds against the largest error of the pressure-drop history for x_g from -4 to 11.5,", \
  "relative to the largest pressure drop, beside it the error of the last value and the drift of the volume. Points are", \
  "labelled with nodes or elements of the membrane and steps. At less than a tenth of its error the standard preset is,", \
  "against the paper's numerics,", ratios(1), "on Table 1's sphere;", ratios(2), "on the sphere with λ = 5;", \
  ratios(3), "on the ellipsoid. The references' own errors are", \
  sprintf("%.0e, %.0e and %.0e.", reference_error(1), reference_error(2), reference_error(3)), \
  "Whole marches of the standard preset are timed, without the companion that estimates the error; the other schemes' time", \
  "is that of a step, measured in the same run, times the number of steps, and the paper's histories are stored ones.", \
  "What is not there failed: see the table."

eval figure("cost-growth", 24, 8)
set multiplot layout 1, 3 margins 0.06, 0.985, 0.16, 0.93 spacing 0.07, 0.05
set logscale xy
set key left top
set format y "10^{%T}"
set xlabel "nodes of the membrane, {/:Italic N}_M"; set ylabel "CPU seconds of a velocity"
set xrange [28:300]; set xtics (32, 64, 128, 256)
set yrange [2e-5:1]
plot for [c=1:3] data."growth-membrane.csv" using "nodes":word(columns, c) with linespoints linetype line(c) \
  title titled(column_title(c), membrane_power[c])
set xlabel "elements or points of the wall, {/:Italic N}_B"
set xrange [50:600]; set xtics (60, 120, 240, 480)
plot for [c=1:3] data."growth-wall.csv" using "elements":word(columns, c) with linespoints linetype line(c) \
  title titled(column_title(c), wall_power[c])
set xlabel "accuracy asked for"; set ylabel "CPU seconds of an entrance"
set format x "10^{%T}"; set xtics auto
set xrange [2e-2:5e-8]; set yrange [0.05:50]
plot for [s=1:3] points_of(s, 1) using "label":"seconds" with linespoints linetype scene_line(s) \
  title titled(scene_title(s), scene_power[s])
unset multiplot
print "**How the time grows.** With the nodes of the membrane and the points of the wall: CPU seconds for the velocity of one", \
  "shape; with the accuracy asked for: for a whole entrance. The numbers in the keys are fitted exponents, from 96 nodes", \
  "and 180 points on."

parts = "membrane wall system load jacobian integrator observables"
part_title(p) = word("membrane@on@membrane membrane@and@wall systems load@of@the@membrane Jacobian LU@and@integrator rows", p)
part_colour(p) = word("#000000 #555555 #0072B2 #56B4E9 #D55E00 #E69F00 #CC79A7", p)
shares = data."shares.csv"
share_sum(upto) = upto == 0 ? 0 : share_sum(upto - 1) + column(word(parts, upto))
share_of(scene, part) = system("awk -F, -v p=".part." 'NR == 1 {for (i in a) ; for (i = 1; i <= NF; i++) if ($i == p) k = i} \
  $1 == \"".scene."\" {s = 0; for (i = 2; i <= NF; i++) s += $i; print 100 * $k / s}' ".shares) + 0

eval figure("where-time-goes", 17, 7.5)
set xlabel "CPU seconds"
set yrange [2.7:-0.7]
set xrange [0:*]
set ytics ("Table 1's sphere" 0, "sphere, {/:Italic λ} = 5" 1, "ellipsoid" 2) scale 0
set rmargin 30
set key at graph 1.03, 0.9 left top
plot for [p=1:7] shares using (share_sum(p - 1)):0:(share_sum(p - 1)):(share_sum(p)):(column(0) - 0.3):(column(0) + 0.3) \
  with boxxyerror fillstyle solid noborder linecolor rgb part_colour(p) title spaced(part_title(p))
print "**Where the time goes.** CPU seconds of an entrance at accuracy 1e-4 by part: the kernels between membrane and", \
  "membrane and between membrane and wall, the systems of the wall and of λ ≠ 1, the membrane's load, the Jacobian of the", \
  sprintf("implicit steps, the integrator with its LU factors, and the recorded rows. The kernels take %.0f %% for Table 1's", \
          share_of("table1", "membrane") + share_of("table1", "wall")), \
  sprintf("sphere, the Jacobian %.0f %%; with λ = 5 the systems take %.0f %%.", share_of("table1", "jacobian"), share_of("skalak5", "system"))

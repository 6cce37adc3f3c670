thresholds = "results/".case."/thresholds.csv"
wrinkles = "results/".case."/wrinkles.csv"
of(nodes, name) = column("nodes") == nodes && column("depth") == 1e-4 ? column(name) : NaN
dents(depth) = abs(column("depth") / depth - 1) < 1e-6 ? column("stiffness") : NaN
stats thresholds using (of(80, "stiffness")) name "fine" nooutput
stats thresholds using (of(40, "stiffness")) name "coarse" nooutput
stats thresholds using (of(80, "predicted")) name "sphere" nooutput
stats thresholds using (dents(1e-3)) name "deep" nooutput
stats thresholds using (dents(1e-6)) name "shallow" nooutput
stats wrinkles using (column("length")) name "length" nooutput
stats wrinkles using (column("stiffness") == 1e-5 ? column("length") / column("fastest") : NaN) name "fastest" nooutput
stats wrinkles using (column("stiffness") == 1e-5 ? column("length") / column("static") : NaN) name "static" nooutput
stats wrinkles using (column("place")) name "place" nooutput

eval figure("stability-buckling", 12, 8)
set logscale xy; set format y "10^{%T}"
set xrange [0.015:0.2]; set yrange [2e-8:1e-2]; set xtics (0.02, 0.05, 0.1, 0.2)
set key bottom right
set xlabel "{/:Italic ε}"; set ylabel "smallest {/:Italic δ} without wrinkles"
plot for [n in "40 64 80"] thresholds using "capillary_number":(of(n + 0, "stiffness")) \
    with linespoints linetype n < 50 ? 3 : n < 70 ? 2 : 1 title "dents of 10^{−4}, ".n." nodes", \
  for [k in "3 5 6"] thresholds using "capillary_number":(dents(10 ** -k)) with points linetype 4 pointtype 2 * k - 1 \
    title "dents of 10^{−".k."}, 80 nodes", \
  thresholds using "capillary_number":(of(80, "predicted")) with lines linetype 5 title "static buckling of a sphere"
print "**Wrinkles.** Smallest bending stiffness with which dents of a given depth (in radii), the same on every mesh, do not become", \
  "wrinkles on the way of a neo-Hookean sphere of radius 0.8 into the tube. With dents of a ten-thousandth:", \
  sprintf("from %.1e to %.1e on 80 nodes (%.1e to %.1e on 40), and from %.1e to %.1e with dents of 1e-6 to 1e-3.", \
    fine_min, fine_max, coarse_min, coarse_max, shallow_min, deep_max), \
  sprintf("A static sphere under the same largest compression would need %.1e to %.1e.", sphere_min, sphere_max)

eval figure("stability-wrinkles", 12, 8)
set logscale xy; set format x "10^{%T}"
set xrange [5e-8:2e-5]; set yrange [0.005:1]
set xlabel "{/:Italic δ}"; set ylabel "distance of wrinkles / {/:Italic R}_t"
plot wrinkles using "stiffness":"length" with points linetype 1 title "first wrinkles", \
  wrinkles using "stiffness":"fastest" with linespoints linetype 2 title "fastest growth", \
  2 * pi * (x * 0.64 / 3) ** 0.25 with lines linetype 3 title "2π ({/:Italic δR}^2/{/:Italic E}_s)^{1/4}, static", \
  pi * 0.8 / 96 * 2 with lines linetype 4 title "two nodes"
print "**Length of the first wrinkles** along the undeformed meridian against the stiffness, on 96 nodes. Where the mesh resolves the", \
  "waves that grow fastest in a compressed membrane between two liquids, δ = 1e-5, the wrinkles are", \
  sprintf("%.2f times as long as these and %.2f times as long as the static buckles of a sphere; softer membranes wrinkle as short", \
    fastest_mean, static_mean), \
  sprintf("as mesh and dents allow, down to %.3f. They begin at %.2f to %.2f of the meridian from the rear.", \
    length_min, place_min, place_max)

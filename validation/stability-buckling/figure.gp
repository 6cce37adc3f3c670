thresholds = "results/".case."/thresholds.csv"
wrinkles = "results/".case."/wrinkles.csv"
of(number, name) = column("capillary_number") == number ? column(name) : NaN
stats thresholds using (column("nodes") == 80 ? column("stiffness") : NaN) name "fine" nooutput
stats thresholds using (column("nodes") == 40 ? column("stiffness") : NaN) name "coarse" nooutput
stats thresholds using (column("nodes") == 80 ? column("predicted") : NaN) name "sphere" nooutput
stats wrinkles using (column("length")) name "length" nooutput
stats wrinkles using (column("stiffness") == 1e-5 ? column("length") / column("fastest") : NaN) name "fastest" nooutput
stats wrinkles using (column("stiffness") == 1e-5 ? column("length") / column("static") : NaN) name "static" nooutput
stats wrinkles using (column("place")) name "place" nooutput

eval figure("stability-buckling", 12, 8)
set logscale y; set format y "10^{%T}"
set xrange [35:85]; set yrange [1e-6:1e-2]
set key bottom right
set xlabel "{/:Italic N}_M"; set ylabel "smallest {/:Italic δ} without wrinkles"
plot thresholds using "nodes":(of(0.09, "stiffness")) with points linetype 1 title "{/:Italic ε} = 0.09", \
  thresholds using "nodes":(of(0.03, "stiffness")) with points linetype 2 title "{/:Italic ε} = 0.03", \
  thresholds using "nodes":(of(0.09, "predicted")) with lines linetype 1 title "static buckling of a sphere, 0.09", \
  thresholds using "nodes":(of(0.03, "predicted")) with lines linetype 2 title "static buckling of a sphere, 0.03"
print "**Wrinkles.** Smallest bending stiffness with which dents of a ten-thousandth of the radius, the same on every mesh, become no", \
  sprintf("wrinkles on the way of a neo-Hookean sphere of radius 0.8 into the tube: from %.1e to %.1e on 80 nodes", fine_min, fine_max), \
  sprintf("(%.1e to %.1e on 40). A static sphere under the same largest compression would need %.1e to %.1e.", \
    coarse_min, coarse_max, sphere_min, sphere_max)

eval figure("stability-wrinkles", 12, 8)
set logscale xy; set format x "10^{%T}"
set xrange [5e-8:2e-5]; set yrange [0.005:1]
set xlabel "{/:Italic δ}"; set ylabel "distance of wrinkles / {/:Italic R}_t"
plot wrinkles using "stiffness":"length" with points linetype 1 title "first wrinkles", \
  wrinkles using "stiffness":"fastest" with linespoints linetype 2 title "fastest growth", \
  2 * pi * (x * 0.64 / 3) ** 0.25 with lines linetype 3 title "2π ({/:Italic δR}^2/{/:Italic E}_s)^{1/4}, static", \
  pi * 0.8 / 96 * 2 with lines linetype 4 title "two nodes"
print "**Length of the first wrinkles** along the undeformed meridian against the stiffness, on 96 nodes. Where the mesh carries the", \
  "waves that a compressed membrane between two liquids lets grow fastest, δ = 1e-5, the wrinkles are", \
  sprintf("%.2f times as long as these and %.2f times as long as the static buckles of a sphere; softer membranes wrinkle as short", \
    fastest_mean, static_mean), \
  sprintf("as mesh and dents allow, down to %.3f. They begin at %.2f to %.2f of the meridian from the rear.", \
    length_min, place_min, place_max)

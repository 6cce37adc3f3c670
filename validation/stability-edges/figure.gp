table = "results/".case."/edges.csv"
of(edge, name) = strcol("edge") eq edge ? column(name) : NaN
larger(edge) = strcol("edge") eq edge ? (column("pressure_drop") > column("v_g") ? column("pressure_drop") : column("v_g")) : NaN
need(edge, accuracy) = number(system("awk -F, '$1 == \"".edge."\" && $2 == \"".accuracy."\" {print $3}' results/".case."/needs.csv"))
stats table using (strcol("edge") eq "exit" && column("distance") <= 5 ? column("distance") : NaN):(log(column("pressure_drop"))) \
  name "decay" nooutput

eval figure("stability-edges", 12, 8)
set logscale xy; set format y "10^{%T}"
set xrange [1:300]; set yrange [1e-9:1]
set xlabel "distance / {/:Italic R}_t"; set ylabel "relative change of {/:Italic ΔP} or {/:Italic v}_g, the larger"
set key top right
plot table using "distance":(larger("exit")) with linespoints linetype 1 title "exit plane, from the centre", \
  table using "distance":(larger("start")) with linespoints linetype 2 title "start, before the mouth", \
  table using "distance":(larger("entrance-reservoir")) with linespoints linetype 3 title "entrance section, capsule at -2", \
  table using "distance":(larger("entrance-mouth")) with linespoints linetype 4 title "entrance section, capsule at 0"
print "**Distances of exit, entrance section and start.** Errors of pressure drop and velocity that they cause: exit plane and entrance section by the", \
  "flow around one shape, the start by marches compared from x_g = -1 to 3.", \
  sprintf("The influence of the exit falls like exp(%.1f d) with its distance d from the capsule's centre: %.2f is enough for 1e-4,", \
    decay_slope, need("exit", "0.0001")), \
  sprintf("%.2f for 1e-6. For 1e-5 the entrance section must be %.0f away and for 1e-4 the start at -%.1f.", \
    need("exit", "1e-06"), need("entrance-mouth", "1e-05"), need("start", "0.0001"))

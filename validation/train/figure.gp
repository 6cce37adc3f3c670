trains = "results/".case."/trains.csv"
reaches = "results/".case."/reaches.csv"
set datafile missing NaN
of(law, eps, name) = strcol("law") eq law && column("radius") == 0.8 && column("capillary_number") == eps ? column(name) : NaN
alone(law, eps) = number(system("awk -F, '$1 == \"".law."\" && $2 == 0.8 && $3 == ".eps." {print $7; exit}' ".trains))
reach(law, eps, k) = number(system("awk -F, '$1 == \"".law."\" && $2 == 0.8 && $3 == ".eps." {print $".k."}' ".reaches))
change(law, eps, here) = abs(of(law, here, "pressure_drop")/alone(law, eps) - 1)

eval figure("pressure-drop", 14, 9)
set xrange [0:2]; set logscale y; set yrange [1e-5:1]; set format y "10^{%T}"
set xlabel "gap / {/:Italic R}_t"; set ylabel "change of the pressure drop of each"
set key top right
plot 0.01 with lines dashtype 2 linecolor "gray" notitle, 0.001 with lines dashtype 2 linecolor "gray" notitle, \
  trains using (of("rigid", 0, "min_gap")):(change("rigid", "0", 0)) with linespoints linetype 1 title "rigid spheres", \
  trains using (of("neo-hookean", 0.1, "min_gap")):(change("neo-hookean", "0.1", 0.1)) with linespoints linetype 2 \
    title "neo-Hookean, ε = 0.1", \
  trains using (of("skalak", 0.1, "min_gap")):(change("skalak", "0.1", 0.1)) with linespoints linetype 3 \
    title "Skalak, ε = 0.1"
print "**A train's pressure drop is the sum of isolated ones** unless the gaps are small. R_eq = 0.8, δ = 0.01.", \
  sprintf("It differs by 1 %% from a gap of %.2f on (rigid), %.2f (neo-Hookean), %.2f (Skalak);", \
    reach("rigid", "0", "4"), reach("neo-hookean", "0.1", "4"), reach("skalak", "0.1", "4")), \
  sprintf("by 0.1 %% from %.2f, %.2f, %.2f.", \
    reach("rigid", "0", "5"), reach("neo-hookean", "0.1", "5"), reach("skalak", "0.1", "5"))

eval figure("apparent-viscosity", 14, 9)
set xrange [0:0.45]; set yrange [1:*]
set xlabel "volume fraction in the tube"; set ylabel "apparent viscosity"
set key top left
fraction(period) = 4.0/3*0.8**3/period
plot trains using (fraction(of("rigid", 0, "period"))):(of("rigid", 0, "apparent_viscosity")) with linespoints linetype 1 \
    title "rigid spheres", \
  trains using (fraction(of("neo-hookean", 0.1, "period"))):(of("neo-hookean", 0.1, "apparent_viscosity")) \
    with linespoints linetype 2 title "neo-Hookean, ε = 0.1", \
  trains using (fraction(of("skalak", 0.1, "period"))):(of("skalak", 0.1, "apparent_viscosity")) \
    with linespoints linetype 3 title "Skalak, ε = 0.1", \
  1 + x*alone("rigid", "0")/(8*4.0/3*0.8**3) with lines dashtype 2 linecolor "gray" title "rigid, isolated ones added up"
print "**Apparent viscosity of a train**, relative to the liquid's, against the capsules' share of the tube. R_eq = 0.8."

eval figure("speed-and-pairing", 17, 7.5)
set multiplot layout 1, 2
speed_alone(law, eps) = number(system("awk -F, '$1 == \"".law."\" && $2 == 0.8 && $3 == ".eps." {print $6; exit}' ".trains))
slower(law, eps, here) = of(law, here, "v_g")/speed_alone(law, eps) - 1
set xrange [0:2]; set xlabel "gap / {/:Italic R}_t"; set ylabel "change of the speed"
set key bottom right
plot 0 with lines linecolor "gray", \
  trains using (of("rigid", 0, "min_gap")):(slower("rigid", "0", 0)) with linespoints linetype 1 title "rigid spheres", \
  trains using (of("neo-hookean", 0.1, "min_gap")):(slower("neo-hookean", "0.1", 0.1)) with linespoints linetype 2 \
    title "neo-Hookean, ε = 0.1", \
  trains using (of("skalak", 0.1, "min_gap")):(slower("skalak", "0.1", 0.1)) with linespoints linetype 3 \
    title "Skalak, ε = 0.1"
set logscale y; set yrange [1e-5:10]; set format y "10^{%T}"
set ylabel "decay per unit of time"
set key bottom left
plot trains using (of("neo-hookean", 0.1, "min_gap")):(-of("neo-hookean", 0.1, "growth_rate")) with lines linetype 2 linewidth 0.7 title "equal motions", \
  trains using (of("skalak", 0.1, "min_gap")):(-of("skalak", 0.1, "growth_rate")) with lines linetype 3 linewidth 0.7, \
  trains using (of("neo-hookean", 0.1, "min_gap")):(-of("neo-hookean", 0.1, "pairing_growth_rate")) with linespoints linetype 2 title "neighbours against each other", \
  trains using (of("skalak", 0.1, "min_gap")):(-of("skalak", 0.1, "pairing_growth_rate")) with linespoints linetype 3
unset multiplot
print "**Speed and stability** of trains, R_eq = 0.8. Right: how small motions die away. Beyond a gap of about 1.9 neighbours that are moved against each other drift apart, by less than 1e-4 per unit of time."

epsilon(i) = parameter(run(i), "flow.capillary_number")
viscous(i) = parameter(run(i), "membrane.shear_viscosity") > 0
colour(i) = epsilon(i) > 10 ? 2 : epsilon(i) > 1 ? 1 : 3
name(i) = sprintf("{/:Italic ε} = %g%s", epsilon(i), viscous(i) ? ", {/:Italic μ_s} = 200" : "")
start(i) = number(system("awk -F, 'NR > 1 && $2 > -1 - 1e-6 {printf \"%.16e\", $1; exit}' ".quoted(series(run(i)))))
array begun[count]
do for [i=1:count] { begun[i] = start(i) }
plain = ""; with_friction = ""
do for [i=1:count] { if (viscous(i)) { with_friction = with_friction." ".i } else { plain = plain." ".i } }
second_mouth = parameter(run(1), "pore.exit_x")
with_viscosity(e) = case."-normal,capillary_number=".e.",shear_viscosity=200"
without(e) = case."-normal,capillary_number=".e.",shear_viscosity=0"
stiff = case."-stiff"
transit(run) = number(system("awk -F'[:,]' '/\"transit\":/ {inside = 1} inside && /\"time\":/ {printf \"%.16e\", $2; exit}' ".quoted(results(run)."/summary.json")))

eval figure("shapes", 14, 10.8)
set multiplot layout 2, 1 margins 0.08, 0.99, 0.1, 0.99 spacing 0, 0.08
# Without a viscous membrane the cell is longer in the pore: other places, so that shapes do not overlap.
array places = ["-1.75 1 4.75 8.25", "-1.75 1.5 4.75 8"]
do for [k=1:2] {
  shown = k == 1 ? without("1.75") : with_viscosity("1.75")
  eval view(-3, 9.6, -1.9, 1.9)
  set xtics 1; set ytics 1
  plot @both_walls, for [p in places[k]] outline(profiles(shown), "x_g", p + 0) using 1:2 with @capsule_fill, \
    for [p in places[k]] outline(profiles(shown), "x_g", p + 0) using 1:2 with lines linetype 1
}
unset multiplot
print "**Red cell, shapes.** A red cell at ε = 1.75 (100 Pa), above without a viscosity of its membrane, below with μ_s = 200."

eval figure("pulses", 17, 8)
set xrange [-2:30]; set yrange [0:*]
set xlabel "time since {/:Italic x}_g = -1 / (π{/:Italic R}_t^3/{/:Italic Q}_0)"
set ylabel "Δ{/:Italic R} / ({/:Italic ρ}/π{/:Italic R}_t)"
set key top right
plot for [i in plain] series(run(i)) using (column("time") - begun[i + 0]):"resistance" with lines linetype colour(i) dashtype 3 title name(i), \
  for [i in with_friction] series(run(i)) using (column("time") - begun[i + 0]):"resistance" with lines linetype colour(i) dashtype 1 title name(i)
print "**Red cell, pulses.** Normal cells at 100 and 1000 Pa (ε = 1.75, 17.5), cells that are three times as stiff at 100 Pa (0.58).", \
  sprintf("From x_g = -1 to 7 they take %.1f, %.1f and %.1f without a viscous membrane; normal cells take %.1f and %.1f with one.", \
    transit(without("1.75")), transit(without("17.5")), transit(stiff), \
    transit(with_viscosity("1.75")), transit(with_viscosity("17.5")))

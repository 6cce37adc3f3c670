epsilon(i) = parameter(run(i), "flow.capillary_number")
ratio(i) = parameter(run(i), "capsule.aspect_ratio")
name(i) = sprintf("%s, {/:Italic ε} = %g", ratio(i) == 1 ? "sphere" : "ellipsoid", epsilon(i))
empty = result(run(1), "empty_resistance")
# When the centre is at the mouth: pulses are drawn from there on.
start(i) = number(system("awk -F, 'NR > 1 && $2 > -1e-6 {printf \"%.16e\", $1; exit}' ".quoted(series(run(i)))))
array mouth[count]
do for [i=1:count] { mouth[i] = start(i) }
spheres = ""; ellipsoids = ""
do for [i=1:count] { if (ratio(i) == 1) { spheres = spheres." ".i } else { ellipsoids = ellipsoids." ".i } }
second_mouth = parameter(run(1), "pore.exit_x")
# The empty pore as a long conductor: the integral of 1/r_w^2.
empty_as_long = second_mouth + pi / tan(opening_angle)

stiff = run(int(word(spheres, 1)))
stats series(stiff) using "resistance_long_conductor" name "long" nooutput

eval figure("shapes", 17, 5)
shown = run(int(word(spheres, words(spheres))))
eval view(-3.6, 9.6, -2, 2)
set xtics 1; set ytics 1
plot @both_walls, for [p in "-2 0 2 4 6 8"] outline(profiles(shown), "x_g", p + 0) using 1:2 with @capsule_fill, \
  for [p in "-2 0 2 4 6 8"] outline(profiles(shown), "x_g", p + 0) using 1:2 with lines linetype 1
print sprintf("**Shapes between two mouths.** The sphere at ε = %g on its way through both mouths.", parameter(shown, "flow.capillary_number"))

eval figure("pulse", 17, 11)
set multiplot layout 2, 1 margins 0.1, 0.98, 0.11, 0.98 spacing 0, 0.06
set xrange [-6:9]; set yrange [0:*]
set ylabel "Δ{/:Italic R} / ({/:Italic ρ}/π{/:Italic R}_t)"
set key left top
plot for [i in spheres." ".ellipsoids] series(run(i + 0)) using (column("time") - mouth[i + 0]):"resistance" with lines linetype i + 0 \
    title name(i), \
  for [i in word(spheres, 1)] series(run(i + 0)) using (column("time") - mouth[i + 0]):"resistance_long_conductor" with lines linetype 1 linewidth 0.7 dashtype 3 \
    title sprintf("long conductor, {/:Italic ε} = %g", epsilon(i))
set xlabel "time since {/:Italic x}_g = 0 / (π{/:Italic R}_t^3/{/:Italic Q}_0)"; set ylabel "{/:Italic Q} / {/:Italic Q}_0"
set yrange [*:1.01]; unset key
plot for [i=1:count] series(run(i)) using (column("time") - mouth[i]):"flow_rate" with lines linetype i
unset multiplot
print sprintf("**Pulses in a short pore.** What capsules add to the resistance of a pore of length %g, and the flow rate at constant pressure.", second_mouth), \
  sprintf("The stiffest sphere adds at most %.1f %% of the empty pore's resistance;", 100 * entry(results(stiff), "    \"pulse_height\"") / empty), \
  sprintf("the long conductor says %.1f %%, and it has almost no signal before the mouth.", 100 * long_max / empty)

eval figure("relative", 13, 8)
set xrange [-6:9]; set yrange [0:*]; set key left top
set xlabel "time since {/:Italic x}_g = 0 / (π{/:Italic R}_t^3/{/:Italic Q}_0)"; set ylabel "Δ{/:Italic R} / {/:Italic R} of the empty pore"
stiffest = word(spheres, 1)." ".word(ellipsoids, 1)
plot for [i in stiffest] series(run(i + 0)) using (column("time") - mouth[i + 0]):(column("resistance") / empty) with lines linetype i + 0 title name(i), \
  for [i in stiffest] series(run(i + 0)) using (column("time") - mouth[i + 0]):(column("resistance_long_conductor") / empty_as_long) \
    with lines linetype i + 0 linewidth 0.7 dashtype 3 title "as long conductors"
print sprintf("**Relative pulses.** Each over its own empty pore, whose resistance is %.2f, and %.2f as a long conductor.", empty, empty_as_long), \
  "What the long conductor neglects of both cancels in the plateau, not in the foot."

# By how much the long conductor errs in the height, itself and relative to its own empty pore.
transit(i, name) = number(system("sed -n '/\"transit\": {/,/}/s/^ *\"".name."\": \\([0-9][^,]*\\),*$/\\1/p' ".quoted(results(run(i))."/summary.json")))
eval table("heights")
print "capsule,height,relative to the empty pore,long conductor,the same relative to its own empty pore,rise,fall"
do for [i=1:count] {
  stats series(run(i)) using "resistance" name "exact" nooutput
  stats series(run(i)) using "resistance_long_conductor" name "long" nooutput
  print sprintf("%s ε = %g,%.3f,%.3f,%+.1f %%,%+.1f %%,%.2f,%.2f", ratio(i) == 1 ? "sphere" : "ellipsoid", epsilon(i), transit(i, "pulse_height"), \
    transit(i, "relative_pulse_height"), 100 * (long_max / exact_max - 1), \
    100 * (long_max / empty_as_long / (exact_max / empty) - 1), transit(i, "pulse_rise"), transit(i, "pulse_fall"))
}
eval end_table("heights")

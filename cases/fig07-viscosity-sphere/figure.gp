lambdas = "0.2 1 5 10"
lambda(i) = word(lambdas, i)
run(i) = "viscosity_ratio=".lambda(i)
name(i) = "{/:Italic λ} = ".lambda(i)
last_x_g = 11.84
table2(i, quantity) = published("T2-".lambda(i)."-".quantity)
distance(i, ours, quantity) = 100 * (result(run(i), ours) / table2(i, quantity) - 1)

eval figure("fig05a", 8.6, 5.6)
eval view(10.7, 13.1, 0, 1.3)
set xtics 0.5; set ytics 0.5
set key at 12.35, 0.65
plot @wall, for [i=1:4] profiles(run(i)) using (at_x_g(last_x_g, "x")):"r" with lines linetype i title name(i)
print "**Figure 5a.** Profiles at x_g = 11.84 for four viscosity ratios. They lie on each other: the steady shape", \
  "does not depend on the internal liquid."

eval figure("fig06a", 17, 4.8)
eval view(-5.2, 13, -2, 2)
set xtics 1; set ytics 1
positions = "-4 -1 1.2 3.5 6 9 11.84"
plot @wall, for [p in positions] for [side=-1:1:2] \
    profiles(run(2)) using (at_x_g(p, "x")):(side * column("r")) with @capsule_fill, \
  for [p in positions] for [side=-1:1:2] \
    profiles(run(2)) using (at_x_g(p, "x")):(side * column("r")) with lines linetype 1
print "**Figure 6a.** Successive profiles for a viscosity ratio of 1. The sphere elongates in the mouth and settles to a", \
  sprintf("parachute that is stretched by at most %.1f %%", 100 * (result(run(2), "max_stretch") - 1)), \
  sprintf("and leaves a film of %.3f pore radii.", result(run(2), "min_film"))

eval figure("fig07a", 12, 8)
set multiplot
set xrange [-4:12]; set yrange [0:18]
set xlabel x_g_label; set ylabel pressure_label
set key at -3.7, 18 left top
plot for [i=1:4] series(run(i)) using "x_g":"pressure_drop" with lines linetype i title name(i), \
  for [i=1:4] $one using (last_x_g):(table2(i, "dP")) with points linetype i @published_mark, \
  NaN with points linetype 1 @published_mark title "published, Table 2"
set origin 0.47, 0.18; set size 0.5, 0.46
set xrange [9:12]; set yrange [13.6:14.6]
set xtics 1; set ytics 0.5
unset key; unset xlabel; unset ylabel
replot
unset multiplot
print "**Figure 7a.** Extra pressure drop along the pore: a peak just before the entrance", \
  sprintf("(%.2f at x_g = %.2f for λ = 0.2,", result(run(1), "peak_pressure_drop"), result(run(1), "x_g_at_peak")), \
  sprintf("%.2f at %.2f for λ = 10),", result(run(4), "peak_pressure_drop"), result(run(4), "x_g_at_peak")), \
  "a dip, and a rise to one steady value, from which the most viscous capsule is still", \
  sprintf("%.1f %% away.", 100 * (1 - result(run(4), "pressure_drop") / result(run(2), "pressure_drop"))), \
  sprintf("Distances to Table 2: %+.2f, %+.2f, %+.2f and %+.2f %%.", distance(1, "pressure_drop", "dP"), \
          distance(2, "pressure_drop", "dP"), distance(3, "pressure_drop", "dP"), distance(4, "pressure_drop", "dP"))

eval figure("fig07b", 12, 8)
set xrange [-4:12]; set yrange [0:1.4]
set xlabel x_g_label; set ylabel velocity_label
set ytics 0.2
set key at 11.8, 0.1 right bottom
plot for [i=1:4] series(run(i)) using "x_g":"v_g" with lines linetype i title name(i), \
  for [i=1:4] $one using (last_x_g):(table2(i, "vg")) with points linetype i @published_mark, \
  NaN with points linetype 1 @published_mark title "published, Table 2"
print "**Figure 7b.** Velocity of the centre of mass along the pore: the viscosity ratio matters little on the way and", \
  sprintf("not in the end. Distances to Table 2: %+.3f, %+.3f, %+.3f and %+.3f %%.", distance(1, "v_g", "vg"), \
          distance(2, "v_g", "vg"), distance(3, "v_g", "vg"), distance(4, "v_g", "vg"))

eval figure("fig08", 8.6, 8.6)
eval view(2.3, 4.8, -1.3, 1.3)
set xtics 0.5; set ytics 0.5
set key at 3.75, 0.12 center
plot @wall, for [i=2:4:2] for [side=-1:1:2] profiles(run(i)) using (at_time(18.7, "x")):(side * column("r")) \
  with lines linetype i title (side > 0 ? name(i) : "")
print "**Figure 8.** Profiles at t = 18.7. The capsule with λ = 1 is a parachute already, the one with λ = 10 has a", \
  "flat rear and lags behind."

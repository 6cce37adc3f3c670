angle(i) = parameter(run(i), "pore.opening_angle_deg")
name(i) = sprintf("{/:Italic α} = %g°", angle(i))
last_x_g = result(run(1), "x_g")

# The largest distance between two profiles at the same material points, in pore radii.
difference(i, k) = number(system(sprintf("paste -d, %s %s | awk -F, 'NR == 1 {n = NF / 2} \
  NR > 1 && ($2 - %.10g)^2 < 1e-12 {d = ($4 - $(n + 4))^2 + ($5 - $(n + 5))^2; if (d > most) most = d} \
  END {printf \"%%.16e\", sqrt(most)}'", quoted(profiles(run(i))), quoted(profiles(run(k))), last_x_g)))

eval figure("fig04", 8.6, 6)
eval view(last_x_g - 1.2, last_x_g + 1.8, 0, 1.3)
set xtics 0.5; set ytics 0.5
set key at last_x_g + 0.68, 0.5
plot @wall, for [i=1:count] profiles(run(i)) using (at_x_g(last_x_g, "x")):"r" with lines linetype i title name(i)
print sprintf("**Figure 4.** Profiles at x_g = %g behind two mouths. They are at most", last_x_g), \
  sprintf("%.0e pore radii apart, with pressure drops of %.4f and %.4f:", difference(1, count), \
          result(run(1), "pressure_drop"), result(run(count), "pressure_drop")), \
  "the steady shape does not depend on the mouth. (The paper compares with an earlier study's shape for 45°.)"

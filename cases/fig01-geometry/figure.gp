start = parameter(run(1), "capsule.start_x")
exit_x = parameter(run(1), "pore.exit_x")
ratio = parameter(run(1), "capsule.aspect_ratio")
# Semi-axes, along the axis and across, and the sphericity index of the oblate spheroid.
B = parameter(run(1), "capsule.radius") * ratio**(-1. / 3)
A = ratio * B
eccentricity = sqrt(1 - ratio**2)
surface = 2 * pi * B**2 * (1 + (1 - eccentricity**2) / eccentricity * atanh(eccentricity))
sphericity = (36 * pi)**(1. / 3) * (4 * pi / 3 * A * B**2)**(2. / 3) / surface
degrees = opening_angle / pi * 180

eval figure("fig01", 17, 7)
eval view(-6.8, 16.2, -3.6, 3.6)
set xtics 5; set ytics 1
# What is measured, with arrows: A, B, R_t, the opening angle, the length of the pore.
set arrow from start, 0 to start - A, 0 nohead front
set arrow from start, 0 to start, B nohead front
set label "{/:Italic A}" at start - A - 0.15, 0 right
set label "{/:Italic B}" at start + 0.5, 0.9 left
set arrow from 5.5, 0 to 5.5, 1 heads size 0.25, 20
set label "{/:Italic R}_t" at 5.7, 0.5 left
set arrow from 0, -2.2 to exit_x, -2.2 heads size 0.25, 20 front
set label "{/:Italic L}_P" at exit_x / 2, -2.75 center front
set arrow from 0, 0 to -3.4 / tan(opening_angle), 3.4 nohead dashtype 3
set label "{/:Italic α}" at -1.35, 0.75 center
set arrow from -6.6, 2.9 to -5.2, 2.9 size 0.3, 20
set label "{/:Italic Q}" at -5.9, 3.3 center
set arrow from -6.8, 0 to 16.2, 0 nohead dashtype 4 linewidth 0.5
set arrow from exit_x, -1 to exit_x, 1 nohead linewidth 1.5
# Names of the boundaries and the liquids.
set label "{/:Italic O}" at 0.15, -0.4 left
set label "{/:Italic S}_P" at exit_x + 0.15, 0.5 left
set label "{/:Italic S}_B" at 2, 1.45 center front
set label "to {/:Italic S}_E" at -6.3, -2.95 left
set label "{/:Italic M}" at start + 0.4, -1.3 left
set arrow from start - 0.9, -1.6 to start - 0.05, -0.5 nohead linewidth 0.5 front
set label "Ω_{int}" at start - 1.2, -1.9 center
set label "Ω_{ext}" at 9, -0.5 center
plot @wall, outline(profiles(run(1)), "x_g", start) using 1:2 with @capsule_fill, \
  outline(profiles(run(1)), "x_g", start) using 1:2 with lines linetype 1, \
  [t=pi - opening_angle:pi] '+' using (1.1 * cos(t)):(1.1 * sin(t)) with lines linetype 1 linewidth 0.8
print "**Figure 1.** The computed pore and capsule at its start, to scale, with the names of the paper: a tube behind a", \
  sprintf("hyperbolic mouth of α = %g°, and an ellipsoid of semi-axes A = %.3f and B = %.3f pore radii, whose", degrees, A, B), \
  sprintf("sphericity index is %.4f. The entrance section S_E is %g pore radii upstream.", sphericity, \
          parameter(run(1), "pore.entrance_distance"))

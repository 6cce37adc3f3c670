# Of each shape the run with λ = 1.
lambda(i) = parameter(run(i), "flow.viscosity_ratio")
ratio(i) = parameter(run(i), "capsule.aspect_ratio")
of(sphere) = run(int(sum [i=1:count] (lambda(i) == 1 && (ratio(i) == 1) == sphere ? i : 0)))
last_x_g = result(run(1), "x_g")
positions = sprintf("-4 -1 1.25 3.5 6 9 %g", last_x_g)

do for [part in "a b"] {
  shown = of(part eq "a")
  stats series(shown) using "x_g":"min_film" name "film" nooutput # the thinnest film on the way, and where
  eval figure("fig06".part, 17, 4.8)
  eval view(-5.2, 13, -2, 2)
  set xtics 1; set ytics 1
  plot @wall, for [p in positions] outline(profiles(shown), "x_g", p + 0) using 1:2 with @capsule_fill, \
    for [p in positions] outline(profiles(shown), "x_g", p + 0) using 1:2 with lines linetype linetype_of_ratio(1, 1)
  if (part eq "a") {
    print sprintf("**Figure 6a.** Successive profiles of the sphere for λ = %g.", parameter(shown, "flow.viscosity_ratio")), \
      "It elongates in the mouth and settles to a", \
      sprintf("parachute that is stretched by at most %.1f %%", 100 * (result(shown, "max_stretch") - 1)), \
      sprintf("and leaves a film of %.3f pore radii.", result(shown, "min_film"))
  } else {
    print sprintf("**Figure 6b.** Successive profiles of the ellipsoid for λ = %g.", parameter(shown, "flow.viscosity_ratio")), \
      "It nearly plugs the pore at the entrance:", \
      sprintf("the film is thinnest, %.3f pore radii, at x_g = %.2f;", film_min_y, film_pos_min_y), \
      sprintf("the parachute at the end leaves %.3f.", result(shown, "min_film"))
  }
}

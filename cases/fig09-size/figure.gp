radius(i) = parameter(run(i), "capsule.radius")
lambda(i) = parameter(run(i), "flow.viscosity_ratio")
# The different values in the runs, as words, and the place of one among them.
has_word(list, value) = strstrt(" ".list." ", sprintf(" %g ", value)) > 0
radii = ""; lambdas = ""
do for [i=1:count] {
  radii = has_word(radii, radius(i)) ? radii : radii.sprintf(" %g", radius(i))
  lambdas = has_word(lambdas, lambda(i)) ? lambdas : lambdas.sprintf(" %g", lambda(i))
}
place(list, value) = sum [k=1:words(list)] (word(list, k) eq sprintf("%g", value) ? k : 0)
# The run of a size and a viscosity ratio.
of(size, ratio) = sum [i=1:count] (abs(radius(i) - size) < 1e-9 && abs(lambda(i) - ratio) < 1e-9 ? i : 0)
first_lambda = word(lambdas, 1) + 0
last_lambda = word(lambdas, words(lambdas)) + 0

eval figure("fig09", 12, 9)
set xrange [-4:12]; set yrange [0:40]
set xlabel x_g_label; set ylabel pressure_label
set key at -3.7, 39 left top
do for [size in radii] {
  end = run(int(of(size + 0, first_lambda)))
  set label sprintf("{/:Italic R}_{eq} = %s", size) at result(end, "x_g") - 0.2, result(end, "pressure_drop") right offset 0, 0.8
}
plot for [i=1:count] series(run(i)) using "x_g":"pressure_drop" with lines \
    linetype linetype_of_ratio(lambda(i), int(place(lambdas, lambda(i)))) title (abs(radius(i) - radius(1)) < 1e-9 ? sprintf("{/:Italic λ} = %g", lambda(i)) : "")

peak(size, ratio) = result(run(int(of(size, ratio))), "peak_pressure_drop")
end_pressure(size) = result(run(int(of(size, first_lambda))), "pressure_drop")
growth(a, b) = b / a - 1
of_mean(a, b) = 2 * (b - a) / (a + b)
growths = ""; heights = ""
do for [k=1:words(radii)] {
  size = word(radii, k) + 0
  heights = listed(heights, sprintf("%.1f %% for R_eq = %g", 100 * (peak(size, last_lambda) / peak(size, first_lambda) - 1), size))
  if (k > 1) {
    before = word(radii, k - 1) + 0
    growths = listed(growths, sprintf("by %.1f %% from R_eq = %g to %g, %.1f %% of the mean (the volume: %.1f %%, %.1f %%)", \
      100 * growth(end_pressure(before), end_pressure(size)), before, size, \
      100 * of_mean(end_pressure(before), end_pressure(size)), 100 * growth(before**3, size**3), \
      100 * of_mean(before**3, size**3)))
  }
}
print "**Figure 9.** Extra pressure drop of spheres of different size and viscosity ratio. The entry peak grows from", \
  sprintf("λ = %g to %g by %s.", first_lambda, last_lambda, heights), \
  sprintf("The pressure drop at x_g = %g grows", result(run(1), "x_g")), growths."." \
  .(published("F9-growth") > 0 ? sprintf(" Published from 0.8 to 0.9: %g %% (the volume: %g %%).", \
      100 * published("F9-growth"), 100 * published("F9-volume")) : "")

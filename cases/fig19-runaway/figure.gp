law(i) = parameter_word(run(i), "membrane.law")
nodes(i) = parameter(run(i), "mesh.membrane")
name(i) = sprintf("%s, {/:Italic N}_M = %g", law(i) eq "skalak" ? "Skalak, {/:Italic C} = 1" : "neo-Hookean", nodes(i))
colour(i) = law(i) eq "skalak" ? 2 : 1
# The finest mesh is drawn as a line, the others as points on it.
finest = 0
do for [i=1:count] { finest = nodes(i) > finest ? nodes(i) : finest }
fine = ""; coarse = ""; unbounded = ""; steady = ""
do for [i=1:count] {
  if (nodes(i) == finest) { fine = fine." ".i } else { coarse = coarse." ".i }
  # The stretch that ends the run as unbounded, or the plateau.
  if (parameter_word(run(i), "membrane.law") eq "neo-hookean") {
    unbounded = listed(unbounded, sprintf("x_g = %.2f with %g nodes, the volume changed by %.0e", \
      result(run(i), "x_g"), nodes(i), abs(result(run(i), "volume_change"))))
  } else {
    steady = listed(steady, sprintf("%.4f with %g nodes", result(run(i), "max_stretch"), nodes(i)))
  }
}

eval figure("fig19", 12, 8)
set xrange [-4:12]; set yrange [1:4.2]
set xlabel x_g_label; set ylabel "({/:Italic λ}_s)_{max}"
set key at -3.6, 4.2 left top
plot for [i in fine] series(run(i)) using "x_g":"max_stretch" with lines linetype colour(i) title name(i), \
  for [i in coarse] series(run(i)) using "x_g":"max_stretch" every 8 with points linetype colour(i) pointsize 0.6 title name(i)
print "**Figure 19.** Largest stretch of the membrane at a capillary number of", \
  sprintf("%g. Skalak's membrane hardens and settles (%s).", parameter(run(1), "flow.capillary_number"), steady), \
  sprintf("The neo-Hookean one stretches without end, on every mesh alike: it passes a stretch of 4 at %s.", unbounded)

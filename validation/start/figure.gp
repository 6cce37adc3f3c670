starts = "-2.5 -4 -6"
run(i) = "start_x=".word(starts, i)

eval figure("start", 12, 8)
set xrange [-6:12]; set yrange [0:16]
set xlabel x_g_label; set ylabel pressure_label
set key at 11.8, 0.5 right bottom
plot for [i=1:3] series(run(i)) using "x_g":"pressure_drop" with lines linetype i \
  title "from {/:Italic x}_g = ".word(starts, i)
print "**Start.** Extra pressure drop of one capsule from three starting positions. The curves agree:", \
  sprintf("at x_g = %g the pressure drop is %.5f, %.5f and %.5f.", result(run(1), "x_g"), \
          result(run(1), "pressure_drop"), result(run(2), "pressure_drop"), result(run(3), "pressure_drop"))

law(i) = parameter_word(run(i), "membrane.law")
epsilon(i) = parameter(run(i), "flow.capillary_number")
is_pair(i) = strstrt(run(i), "start_x=2_") > 0
second(i) = results(run(i))."/series-2.csv"
second_profiles(i) = results(run(i))."/profiles-2.csv"
# The run of one capsule alone with the same law and flow.
alone(i) = first_alone(i, 1)
first_alone(i, k) = !is_pair(k) && law(k) eq law(i) && epsilon(k) == epsilon(i) ? k : first_alone(i, k + 1)
array single[count]
array first_gap[count]
pairs = ""
do for [i=1:count] {
  if (is_pair(i)) {
    pairs = pairs." ".i
    single[i] = result(run(alone(i)), "pressure_drop")
    stats second(i) using "min_gap" every ::0::0 name "gap" nooutput
    first_gap[i] = gap_min
  }
}
soft = int(word(pairs, words(pairs) - 2))
colour(i) = law(i) eq "skalak" ? 2 : 1
wide(i) = epsilon(i) > 0.03 ? 1.8 : 0.7

eval figure("shapes", 17, 4.5)
eval view(-0.9, 17.5, -1.15, 1.15)
set xtics 2; set ytics 1
set arrow from -0.9, 1 to 17.5, 1 nohead linecolor rgb wall_colour linewidth 3
set arrow from -0.9, -1 to 17.5, -1 nohead linecolor rgb wall_colour linewidth 3
times = "0 ".sprintf("%.12g", result(run(soft), "time"))
plot for [t in times] for [side=-1:1:2] profiles(run(soft)) using (at_time(t + 0, "x")):(side * column("r")) with lines linetype 1, \
  for [t in times] for [side=-1:1:2] second_profiles(soft) using (at_time(t + 0, "x")):(side * column("r")) with lines linetype 2
print sprintf("**Shapes of a pair.** The %s pair at ε = %g that begins at a gap of %.1f: at the start and at the end, the leading capsule on the right of each.", \
  law_title(law(soft)), epsilon(soft), first_gap[soft])

eval figure("spacing", 17, 7.5)
set multiplot layout 1, 2
set xrange [0:10]; set xlabel time_label; set ylabel "smallest gap / {/:Italic R}_t"; set yrange [0:*]
set key at 9.8, 1.32
plot for [i in pairs] second(i + 0) using "time":"min_gap" with lines linetype colour(i + 0) linewidth wide(i + 0) \
  title (first_gap[i + 0] < 0.2 ? sprintf("%s, {/:Italic ε} = %g", law_title(law(i + 0)), epsilon(i + 0)) : "")
set xrange [0:1.6]; set xlabel "smallest gap / {/:Italic R}_t"; set ylabel "drop of both / twice that of one alone"; set yrange [0.88:1.01]
unset key
plot for [i in pairs] second(i + 0) using (column("time") > 3 ? column("min_gap") : NaN):(column("pressure_drop") / (2 * single[i + 0])) \
  with lines linetype colour(i + 0) linewidth wide(i + 0)
unset multiplot
print "**Gaps of pairs.** How the gaps of pairs change that begin at 0.1, 0.6 and 1.4, and how much of the pressure drop of two single capsules a pair needs, against its gap (t > 3). At the kinks the rim of the rear becomes the nearest place."

eval table("pairs")
print "law,ε,gap at the start,at the end,spacing at the end,drop of both / twice that of one"
do for [i in pairs] {
  print sprintf("%s,%g,%.1f,%.3f,%.4f,%.4f", law_title(law(i + 0)), epsilon(i + 0), first_gap[i + 0], \
    number(system("tail -1 ".quoted(second(i + 0))." | awk -F, '{print $NF}'")), \
    number(system("tail -1 ".quoted(second(i + 0))." | awk -F, '{print $(NF-1)}'")), result(run(i + 0), "pressure_drop") / (2 * single[i + 0]))
}
eval end_table("pairs")

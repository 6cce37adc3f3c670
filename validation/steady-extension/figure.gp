directory = "results/".case
branches = directory."/branches.csv"
folds = directory."/folds.csv"
slopes = directory."/slopes.csv"
field(file, first, name) = system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} $1 == \"".first."\" {print $k[\"".name."\"]}' ".file)
of(sphere, name) = strcol("sphere") eq sphere && strcol("end") ne "fold" ? column(name) : NaN
stable(sphere, name) = of(sphere, "growth_rate") < 0 ? column(name) : NaN
unstable(sphere, name) = of(sphere, "growth_rate") >= 0 ? column(name) : NaN
slope(sphere) = number(field(slopes, sphere, "theory"))
slope_error = number(system("awk -F, 'NR > 1 {e = $3 / $4 - 1; if (e < 0) e = -e; if (e > m) m = e} END {print m}' ".slopes))
last_of(sphere, column) = number(system("awk -F, '$1 == \"".sphere."\" && $7 != \"fold\" {x = $".column."} END {print x}' ".branches))
stiff = "0.01"; soft = "0.001"
fold(delta, name) = number(field(folds, delta, name))
growth = number(system("awk -F, 'NR > 1 {for (i = 4; i <= 5; i++) {v = $i < 0 ? -$i : $i; if (v > m) m = v}} END {print m}' ".folds))
array sphere[4] = ["neo-hookean", "skalak C=0", "skalak C=1", "skalak C=10"]
array label[4] = ["neo-Hookean", "Skalak, {/:Italic C} = 0", "Skalak, {/:Italic C} = 1", "Skalak, {/:Italic C} = 10"]
number_label = "Ca = {/:Italic μea/G}"

eval figure("extension", 14, 10)
set xrange [0:2]; set yrange [0:1]
set xlabel number_label; set ylabel "{/:Italic D} = ({/:Italic L} − {/:Italic B}) / ({/:Italic L} + {/:Italic B})"
set key bottom right
plot for [i = 1:4] branches using (stable(sphere[i], "capillary_number")):"deformation" with lines linetype i title label[i], \
  branches using (unstable(sphere[1], "capillary_number")):"deformation" with lines linetype 5 title "neo-Hookean, unstable", \
  for [i = 1:4] [0:0.12] slope(sphere[i]) * x with lines linetype i linewidth 0.7 dashtype solid \
    title i == 1 ? "small deformations" : "", \
  folds using ($1 + 0 == stiff + 0 ? $2 : NaN):"deformation" with points linetype 1 pointtype 7 title "fold"
print "**Spheres in a uniaxial extension.** Steady deformation against capillary number (δ = 0.01). Thin lines: theory of small", \
  sprintf("deformations, whose slopes (%.3f; %.3f, %.3f, %.3f for C = 0, 1, 10) agree with ours within %.0e.", \
    slope(sphere[1]), slope(sphere[2]), slope(sphere[3]), slope(sphere[4]), slope_error), \
  sprintf("The neo-Hookean branch turns back at Ca = %.6f (%.6f with δ = 0.001), stretched %.2f times, and is unstable from there;", \
    fold(stiff, "capillary_number"), fold(soft, "capillary_number"), fold(stiff, "max_stretch")), \
  sprintf("Skalak's law has no fold up to Ca = %.0f.", last_of(sphere[2], 2))

eval figure("extension-rates", 12, 9)
set logscale xy; set xrange [0.02:2]; set yrange [1e-3:30]
set xlabel number_label; set ylabel "slowest rate of relaxation / {/:Italic e}"
set key bottom left
plot for [i = 1:4] branches using (stable(sphere[i], "capillary_number")):(-column("growth_rate")) with lines linetype i title label[i]
print "**How fast they relax.** Rate of the slowest small motion about these states, inner liquid as viscous as the outer. It goes to", \
  sprintf("zero at the neo-Hookean fold (at most %.0e there on both meshes and for both δ), and falls steadily for Skalak's law, with", growth), \
  sprintf("%.3f, %.3f and %.3f left at Ca = 2 for C = 0, 1 and 10.", -last_of(sphere[2], 6), -last_of(sphere[3], 6), -last_of(sphere[4], 6))

table = "results/".case."/search.csv"
runs = "'table1-mesh' 'fig03-bending bending_ratio=0' 'fig07-viscosity-sphere viscosity_ratio=1' 'fig10-viscosity-ellipsoid viscosity_ratio=1'"
names = "'NH 0.8, {/:Italic ε} = 0.09' 'NH 0.8, {/:Italic ε} = 0.12' 'SK 0.9, {/:Italic ε} = 0.04' 'SK ellipsoid, {/:Italic ε} = 0.04'"
of(i, mesh, name) = strcol("run") eq word(runs, i) && strcol("nodes") eq mesh && strcol("status") eq "reached" ? column(name) : NaN
array stiff[4]
do for [i=1:4] {
  stats table using (abs(column("bending_ratio")/1e-3 - 1) < 1e-6 ? of(i, "coarse", "pressure_drop") : NaN) name "at" nooutput
  stiff[i] = at_mean
}

eval figure("delta-search", 12, 8)
set logscale x; set format x "10^{%T}"
set xrange [5e-7:2e-3]; set yrange [0.99:1.14]
set xlabel "{/:Italic δ}"; set ylabel "Δ{/:Italic P} / Δ{/:Italic P} at {/:Italic δ} = 10^{−3}"
plot for [i=1:4] table using "bending_ratio":(of(i, "coarse", "pressure_drop") / stiff[i]) with points linetype i title word(names, i), \
  for [i=1:4] table using "bending_ratio":(of(i, "fine", "pressure_drop") / stiff[i]) with points linetype i pointtype 2
print "**Stiffness.** Pressure drop at the end against the bending stiffness, for runs that pass (open marks; crosses: on the finer mesh).", \
  "Spheres of radius 0.8 and 0.9 wrinkle at 1e-6 on both meshes, so there is no mark."

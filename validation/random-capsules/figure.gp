verdicts = "results/".case."/verdicts.csv"
count(condition) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} ".condition." {n++} END {print n + 0}' ".verdicts))
seconds(command) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} {print $k[\"seconds\"]}' ".verdicts." | sort -g | ".command))
of(law, verdict) = "<awk -F, 'NR == 1 || ($2 == \"".law."\" && ".verdict.")' ".verdicts
found = "$8 == \"steady\""
ends = "($8 == \"fold\" || $8 == \"softening\")"
unresolved = "$8 != \"steady\" && $8 != \"fold\" && $8 != \"softening\""

eval figure("verdicts", 16, 8)
set multiplot layout 1,2 margins 0.09, 0.98, 0.32, 0.91 spacing 0.12, 0
set logscale x; set xrange [8e-4:0.4]; set yrange [0.25:1.35]; set format x "10^{%T}"
set xlabel "{/:Italic ε}"; set ylabel "{/:Italic R}_{eq} / {/:Italic R}_t"
set key at screen 0.5, 0.06 center bottom horizontal
do for [law in "neo-hookean skalak"] {
  if (law eq "skalak") { unset key } # one for both
  set title law eq "skalak" ? "Skalak" : "neo-Hookean"
  plot of(law, found) using "capillary_number":"R_eq" with points linetype 1 pointtype 6 pointsize 0.5 title "found", \
    of(law, ends) using "capillary_number":"R_eq" with points linetype 2 pointtype 5 pointsize 0.5 title "fold or softening", \
    of(law, unresolved) using "capillary_number":"R_eq" with points linetype 3 pointtype 2 pointsize 0.7 title "not found"
}
unset multiplot
print sprintf("**Steady states of %d random capsules.** Found: %d; a fold ends the branch before: %d; the law softens before: %d; not found: %d.", \
    count("$8 != \"\""), count(found), count("$8 == \"fold\""), count("$8 == \"softening\""), count(unresolved)), \
  sprintf("The median search took %.2f s of one core, the longest %.0f s. Of %d marches that come to rest, %d end within 1e-3 of the steady state.", \
    seconds("awk '{a[NR] = $1} END {print a[int((NR + 1)/2)]}'"), seconds("tail -1"), count("$14 == \"at rest\""), \
    count("$14 == \"at rest\" && $15 < 1e-3 && $16 < 1e-3"))

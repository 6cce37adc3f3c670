verdicts = "results/".case."/verdicts.csv"
estimates = "results/".case."/estimates.csv"
count(file, condition) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} ".condition." {n++} END {print n + 0}' ".file))
ends(condition) = count(verdicts, condition)
of(condition) = "<awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; print; next} ".condition."' "
arrived = "$k[\"end\"] == \"reached\""
long = "$k[\"end\"] == \"too long\""
failed = "$k[\"end\"] != \"reached\" && $k[\"end\"] != \"too long\""
way = "$k[\"quantity\"] ~ /@x_g/"
single = "$k[\"quantity\"] !~ /@x_g/"
small = "$k[\"verdict\"] == \"too small\" && $k[\"warned\"] == 0"
warned = "$k[\"verdict\"] == \"too small\" && $k[\"warned\"] == 1"

eval figure("ends", 16, 8)
set multiplot layout 1,2
set logscale x; set xrange [8e-4:0.4]; set yrange [0.25:1.35]; set format x "10^{%T}"
set xlabel "ε"; set ylabel "{/:Italic R}_{eq} / {/:Italic R}_t"
set key outside bottom center horizontal
plot of(arrived).verdicts using "capillary_number":"R_eq" with points linetype 1 pointtype 6 pointsize 0.5 title "arrives", \
  of(failed).verdicts using "capillary_number":"R_eq" with points linetype 2 pointtype 5 pointsize 0.5 title "does not", \
  of(long).verdicts using "capillary_number":"R_eq" with points linetype 3 pointtype 2 pointsize 0.7 title "takes too long"
set logscale xy; set format xy "10^{%T}"
set xrange [1e-9:1e2]; set yrange [1e-9:1e2]
set xlabel "error, from a refined run"; set ylabel "error, estimated"
plot x with lines linetype 1 linecolor rgb "#808080" title "error", \
  of(single).estimates using "difference":"estimate" with points pointtype 7 pointsize 0.3 linecolor rgb "#A0A0A0" title "at the end, peak", \
  of(way).estimates using "difference":"estimate" with points linetype 2 pointtype 6 pointsize 0.4 title "largest on the way"
unset multiplot
print sprintf("**Random marches.** Of %d, %d arrive, %d end before, and %d take more work than the study may.", \
    ends("$1 != \"\""), ends(arrived), ends(failed), ends(long)), \
  sprintf("Of those that end before, %d arrive on a finer mesh, and the advice helps %d.", \
    ends(failed." && $k[\"refined_end\"] == \"reached\""), ends(failed." && $k[\"helps\"] != \"nothing\"")), \
  sprintf("Against refined runs, %d of %d estimates of the largest error on the way are too small, and %d of %d of an error at the end or at the peak; %d more in marches that say so.", \
    count(estimates, way." && ".small), count(estimates, way), count(estimates, single." && ".small), count(estimates, single), count(estimates, warned))

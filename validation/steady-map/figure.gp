map(law) = "results/".case."/".law.".csv"
summary = "results/".case."/summary.csv"
total(name) = number(system("awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) k[$i] = i; next} {print $k[\"".name."\"]}' ".summary))
law_names = "neo-hookean skalak"
law_titles = "neo-Hookean Skalak,@{/:Italic@C}@=@0"
spaced(text) = system("printf '%s' \"".text."\" | tr @ ' '")

# Contour lines, as blocks of points, of a column.
levels_pressure = "4,6,8,10,12,15,20,25,30"
levels_film = "0.06,0.08,0.1,0.12,0.15,0.2,0.25,0.3"

eval figure("map", 16, 15)
do for [q=1:2] {
  do for [quantity in "pressure_drop min_film"] {
    block = sprintf("$contours_%d_%s", q, quantity)
    set contour base; unset surface
    eval "set cntrparam levels discrete ".(quantity eq "pressure_drop" ? levels_pressure : levels_film)
    set datafile missing NaN
    eval sprintf("set table %s; splot map(word(law_names, %d)) using 'radius':(log10(column('capillary_number'))):'%s' with lines; unset table", block, q, quantity)
  }
}
unset contour; set surface
set datafile separator whitespace; unset datafile columnheaders
set multiplot layout 2,2
set xrange [0.65:1.1]; set yrange [0.01:0.2]; set logscale y
set xlabel "{/:Italic R}_{eq} / {/:Italic R}_t"; set ylabel "{/:Italic ε}"; set xtics 0.7, 0.1
do for [quantity in "pressure_drop min_film"] {
  do for [q=1:2] {
    block = sprintf("$contours_%d_%s", q, quantity)
    set title spaced(word(law_titles, q)).(quantity eq "pressure_drop" ? ": ".pressure_label : ": smallest film / {/:Italic R}_t")
    eval sprintf("plot \"<awk -F, 'NR > 1 && $4 + 0 > 0 {print $2, $3}' %s\" using 1:2 with points pointtype 7 pointsize 0.15 linecolor rgb '#A0A0A0', ", map(word(law_names, q))).sprintf("%s using 1:(10**$2) with lines linetype q, '' using 1:(10**$2):3 every 12::3 with labels font ',8' offset 0,0.4", block)
  }
}
unset multiplot
eval defaults
print "**The steady pressure drop and film over size and capillary number.** Contours of", \
  sprintf("%d steady states on branches of growing flow, one for each size (δ = 0.01, dots; lines of equal value as labelled); at %d further points", \
    total("points"), total("without")), \
  "of the grid of 400 no stable one was reached (neo-Hookean: beyond the folds; Skalak: on 52 nodes).", \
  sprintf("Pressure drops on two meshes are at most %.0e apart; all took %.0f s of one core.", total("pressure_drop_apart"), total("cpu_seconds"))

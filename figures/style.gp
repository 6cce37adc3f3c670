# How every figure looks: formats, font, lines, colours, the pore's wall, and where numbers are found. A case's
# figure.gp says what is drawn and what it shows. To draw a case:
#   gnuplot -c figures/style.gp cases/<id> figures
# and a study: validation/<id>.
# Scales: lengths R_t, velocities Q/(pi R_t^2), pressures mu Q/(pi R_t^3), times pi R_t^3/Q.

source = ARG1
out = ARG2
case = source[strstrt(source, "/") + 1:]
home = out."/".case
pictures = home."/.drawing" # until all are drawn: a script that fails leaves the old ones

# A text as one word of the shell: a run may be called like any case that it is of.
quoted(text) = "'".without_apostrophe(text)."'"
without_apostrophe(text) = strstrt(text, "'") ? \
  text[:strstrt(text, "'") - 1]."'\\''".without_apostrophe(text[strstrt(text, "'") + 1:]) : text

# Results. A run is named as its directory, "viscosity_ratio=1"; "." is the only run of a case without a sweep.
run_list = "results/".case."/runs.txt"
runs = system("cat ".run_list." 2>/dev/null | tr '\n' ' '")
count = int(system("cat ".run_list." 2>/dev/null | wc -l"))
if (count > 0) {
  array run_names[count]
  do for [i=1:count] { run_names[i] = system(sprintf("sed -n %dp ", i).run_list) }
}
run(i) = run_names[i + 0]
results(run) = "results/".case."/".run
series(run) = results(run)."/series.csv"
profiles(run) = results(run)."/profiles.csv"
series_physical(run) = results(run)."/series_physical.csv" # of a case in physical units
# One number, NaN where there is none: of a summary.json, of this case's summaries and their error estimates, of
# tables/published.csv, where the row speaks of this case, another file of its directory, or a case whose runs it shows.
# gnuplot takes "5e-09" for 5 with something behind it, "5.e-09" for what it is.
with_point(text) = strstrt(text, "e") && !strstrt(text, ".") ? text[:strstrt(text, "e") - 1].".".text[strstrt(text, "e"):] : text
number(text) = text eq "" ? NaN : with_point(text) + 0
entry(directory, key) = number(system("awk -F'[:,]' '/^".key.":/ {printf \"%.16e\", $2}' ".quoted(directory."/summary.json")." 2>/dev/null"))
result_in(directory, name) = entry(directory, "  \"".name."\"")
result(run, name) = result_in(results(run), name)
error_of(run, name) = entry(results(run), "    \"".name."\"")
parameter(run, key) = entry(results(run), "    \"".key."\"")
# The same in SI units, of a case in physical units: result_physical(run, "pressure_drop [Pa]"), "pulse_height [ohm]" of the
# transit.
result_physical(run, name) = number(system("awk -v name=".quoted(name)." '{ match($0, /[^ ]/) } \
  (RSTART == 5 || RSTART == 7) && index($0, \"\\\"\" name \"\\\":\") == RSTART \
  { sub(/.*: /, \"\"); printf \"%.16e\", $0; exit }' ".quoted(results(run)."/summary.json")." 2>/dev/null"))
# A word of it: "skalak", "reached".
entry_word(directory, key) = system("sed -n 's/^".key.": \"\\(.*\\)\",*$/\\1/p' ".quoted(directory."/summary.json"))
parameter_word(run, key) = entry_word(results(run), "    \"".key."\"")
result_word(run, name) = entry_word(results(run), "  \"".name."\"")
# The first run in which a key has the value, or else the first of all.
run_with(key, value) = first_of(key, value, 1)
first_of(key, value, i) = i > count ? run(1) : abs(parameter(run(i), key) - value) < 1e-9 ? run(i) : first_of(key, value, i + 1)
published(id) = published_of(case." ".runs, id)
published_of(cases, id) = number(system("cases=".quoted(cases)." case=".quoted(word(cases, 1))." awk -F, ' \
  function is_shown(name,  i, n, words, line) { \
    n = split(ENVIRON[\"cases\"], words, \"[ ,]\"); \
    for (i = 1; i <= n; ++i) if (words[i] == name) return 1; \
    i = length(ENVIRON[\"case\"]) + 1; \
    return substr(name, 1, i) == ENVIRON[\"case\"] \"-\" && \
      (getline line < (\"cases/\" ENVIRON[\"case\"] \"/\" substr(name, i + 1) \".toml\")) >= 0 \
  } \
  $1 == \"".id."\" && is_shown($3) {printf \"%.16e\", $6}' tables/published.csv"))
# In words: a relative distance, "" where there is no published value; a list that grows by an item.
distance(ours, published) = published == published ? sprintf("%+.2f %%", 100 * (ours / published - 1)) : ""
listed(list, item) = list.(list eq "" || item eq "" ? "" : ", ").item
with_comma(list) = list eq "" ? "" : ", ".list
# To plot a single point:  plot $one using (x):(y) with points
$one << end
x
1
end
# In a `using`, for one profile of many: a column where x_g, or the time, has the given value.
at_x_g(position, name) = abs(column("x_g") - position) < 1e-6 ? column(name) : NaN
at_time(time, name) = abs(column("time") - time) < 1e-6 ? column(name) : NaN

# A whole outline, both halves as one closed curve of x and r, in a profile where a column has the value:
#   plot outline(profiles(run(1)), "x_g", -4) using 1:2 with lines
outline(file, column, value) = sprintf("< awk -F, -v name=%s -v value=%.10g ' \
  NR == 1 {for (i = 1; i <= NF; ++i) place[$i] = i; print \"x,r\"; next} \
  ($place[name] - value)^2 < 1e-12 {x[++n] = $place[\"x\"]; r[n] = $place[\"r\"]; print x[n] \",\" r[n]} \
  END {for (i = n; i > 0; --i) print x[i] \",\" (-r[i])}' %s", column, value, quoted(file))

# Colours that the colour-blind tell apart (Okabe and Ito), each with its own dashes and mark.
set linetype 1 linewidth 1.5 linecolor rgb "#000000" dashtype 1 pointtype 6
set linetype 2 linewidth 1.5 linecolor rgb "#D55E00" dashtype (12, 4) pointtype 4
set linetype 3 linewidth 1.5 linecolor rgb "#0072B2" dashtype (4, 3) pointtype 8
set linetype 4 linewidth 1.5 linecolor rgb "#009E73" dashtype (10, 3, 2, 3) pointtype 12
set linetype 5 linewidth 1.5 linecolor rgb "#CC79A7" dashtype (2, 2) pointtype 10
set linetype 6 linewidth 1.5 linecolor rgb "#E69F00" dashtype (8, 2, 2, 2, 2, 2) pointtype 2
# The same one for a viscosity ratio in all figures; a ratio that the paper has not has the given one.
linetype_of_ratio(ratio, other) = ratio == 1 ? 1 : ratio == 0.2 ? 2 : ratio == 5 ? 3 : ratio == 10 ? 4 : other
# A law as people write it.
law_title(law) = law eq "neo-hookean" ? "neo-Hookean" : law eq "skalak" ? "Skalak" : law
wall_colour = "#D8D8D8"
capsule_colour = "#FBE5D6"
capsule_fill = "filledcurves closed fillstyle solid border linewidth 0.5 linecolor rgb capsule_colour"
published_mark = "pointtype 6 pointsize 0.9"
# A published value in the colour of curve i, nothing where there is none, and their entry in the key; added to a list
# that is put at the end of a plot:  marks = marks.mark(i, x, y); marks = marks.marks_title(marks, "Table 2"); plot ... @marks
mark(i, x, y) = x == x && y == y ? \
  sprintf(", $one using (%.10g):(%.10g) with points linetype %d ", x, y, i + 0).published_mark : ""
marks_title(marks, place) = marks eq "" ? "" : ", NaN with points linetype 1 ".published_mark." title 'published, ".place."'"

# `eval figure("fig07a", 12, 8)` opens the picture out/<id>/fig07a of so many centimetres, and the file of its caption
# for `print`.
pixels(centimetres) = centimetres / 2.54 * 96
terminal(width, height) = format eq "svg" \
  ? sprintf("set terminal svg enhanced size %.0f,%.0f font '%s,9' background '#ffffff'", pixels(width), \
            pixels(height), "Liberation Sans, Arial, Helvetica, sans-serif") \
  : sprintf("set terminal pngcairo enhanced size %.0f,%.0f font '%s,9' fontscale 3 linewidth 3 pointscale 3", \
            3 * pixels(width), 3 * pixels(height), "Liberation Sans")
figure(name, width, height) = "reset; ".terminal(width, height)."; ".defaults. \
  sprintf("set output pictures.'/%s.%s'; set print pictures.'/%s.md'; ", name, format, name). \
  sprintf("print '![%s](%s/%s.png)', \"\n\"", name, case, name)
defaults = "set encoding utf8; set datafile separator ','; set datafile columnheaders; set datafile missing NaN; \
  set samples 400; set angles radians; set border 3 linewidth 0.8; set tics nomirror scale 0.6; \
  set key noautotitle Left reverse samplen 2.5 spacing 1.2; set minussign;"

# `eval table("table2")` opens a table of comma-separated rows for `print`; `eval end_table("table2")` writes it as
# Markdown, too. Tables of a case that the paper's values speak of lie beside the figures, in the directory tables; those of
# another, perhaps its copy, with its pictures.
of_the_paper = int(system("cut -d, -f3 tables/published.csv | grep -cxF -e ".quoted(case)))
home_of_tables = of_the_paper > 0 ? out."/../tables" : home
tables = pictures."/tables"
table(name) = sprintf("set print tables.'/%s.csv'", name)
end_table(name) = sprintf("set print; end_table_ = system(as_markdown(tables.'/%s'))", name)
as_markdown(file) = "sed 's/,/ | /g; s/^/| /; s/$/ |/; ".plain_numbers."; 1{p; s/[^|]\\+/ --- /g}' ".quoted(file.".csv")." > ".quoted(file.".md")
# As people write them: 1e-6 for 1e-06, 0.00 for -0.00, −1 for -1.
plain_numbers = 's/\([0-9]e\)+*\(-*\)0\([0-9]\)/\1\2\3/g; s/\(^\|[ (]\)-\(0\.0*\)\([^0-9]\|$\)/\1\2\3/g; \
  s/\(^\|[ (]\)-\([0-9]\)/\1−\2/g'
# A cell: the number in this format, empty where there is none.
cell(form, x) = x == x ? sprintf(form, x) : ""

# Names of the axes, with their scales.
x_g_label = "{/:Italic x}_g / {/:Italic R}_t"
x_label = "{/:Italic x} / {/:Italic R}_t"
r_label = "{/:Italic r} / {/:Italic R}_t"
pressure_label = "Δ{/:Italic P} / (μ{/:Italic Q}/π{/:Italic R}_t^3)"
time_label = "{/:Italic t} / (π{/:Italic R}_t^3/{/:Italic Q})"
arc_label = "{/:Italic S} / {/:Italic R}_t"
stretch_label = "{/:Italic λ}_s"
velocity_label = "{/:Italic v}_g / ({/:Italic Q}/π{/:Italic R}_t^2)"

# The solid around the pore, eq. 1, on both sides of the axis:  plot @wall, ...
opening_angle = count > 0 ? parameter(run(1), "pore.opening_angle_deg") / 180 * pi : NaN
wall_x(t) = t < 0 ? sinh(t) / tan(opening_angle) : t
wall_r(t) = t < 0 ? cosh(t) : 1
wall = "sample [t=-3:20] '+' using (wall_x(t)):(wall_r(t)):(10) with filledcurves linecolor rgb wall_colour, \
               [t=-3:20] '+' using (wall_x(t)):(-wall_r(t)):(-10) with filledcurves linecolor rgb wall_colour"
# The same around a pore with two mouths, where second_mouth is its end:  plot @both_walls, ...
wall_2x(t) = second_mouth - wall_x(second_mouth - t)
both_walls = "sample [t=-3:second_mouth + 3] '+' using (t < second_mouth ? wall_x(t) : wall_2x(t)):(t < second_mouth ? wall_r(t) : wall_r(second_mouth - t)):(10) \
  with filledcurves linecolor rgb wall_colour, \
  [t=-3:second_mouth + 3] '+' using (t < second_mouth ? wall_x(t) : wall_2x(t)):(t < second_mouth ? -wall_r(t) : -wall_r(second_mouth - t)):(-10) \
  with filledcurves linecolor rgb wall_colour"
# The axes of a view along the pore, with equal scales:  eval view(left, right, bottom, top)
view(left, right, bottom, top) = sprintf("set size ratio -1; set xrange [%g:%g]; set yrange [%g:%g]; ", \
  left, right, bottom, top)."set xlabel x_label; set ylabel r_label"

system("rm -rf ".quoted(pictures)."; mkdir -p ".quoted(tables)." ".quoted(home_of_tables))
do for [format in "svg png"] {
  reset; eval defaults
  load source."/figure.gp"
  unset output
}
set print
moved(from, to) = "find ".quoted(from)." -maxdepth 1 -type f -exec mv {} ".quoted(to)." ';'"
system("(cd ".quoted(home)." && rm -f *.svg *.png *.md) && ".moved(pictures, home)." && ".moved(tables, home_of_tables). \
  " && rm -r ".quoted(pictures))
captions = quoted(home)."/*.md"
rewritten = system("for file in ".captions."; do [ ! -e \"$file\" ] || sed -i '".plain_numbers."' \"$file\"; done")
# A caption with a number that is not there, or that begins with one.
set print "-"
numbered = system("grep -lE -- '^(\\*\\*)?[-−0-9]' ".captions)
if (numbered ne "") { print "warning: a caption begins with a number in ".numbered }
incomplete = system("grep -lwiE -- '-?nan' ".captions)
if (incomplete ne "") { print "warning: a number is missing in ".incomplete }

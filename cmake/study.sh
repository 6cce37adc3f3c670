#!/bin/sh
# Runs a study's command, draws its figures whatever the verdict, and ends with the verdict.
#   sh cmake/study.sh ID GNUPLOT COMMAND ARGUMENT...     in the project's directory
id=$1
gnuplot=$2
shift 2
"$@"
verdict=$?
if [ -e "validation/$id/figure.gp" ]; then
  LC_ALL=C.UTF-8 "$gnuplot" -c figures/style.gp "validation/$id" figures || exit
fi
exit $verdict

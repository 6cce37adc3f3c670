#!/bin/sh
# One line: which tests, or parts of them, the last ctest in a build directory has skipped, and how to have them. A test
# says so by a line "skipped: needs the packages a and b", or with anything else that it needs.
#   cmake/skipped.sh BUILD
awk '
  /^[0-9]+\/[0-9]+ Test: / { test = $3; count_of_reasons = 0 }
  /^skipped: / { reasons[++count_of_reasons] = substr($0, 10) }
  /^Test Failed\./ { count_of_reasons = 0 } # what a failed test quotes from elsewhere
  /^"[^"]*" end time: / {
    for (r = 1; r <= count_of_reasons; ++r) {
      why = reasons[r]
      skipped = skipped (skipped == "" ? "" : ", ") test " (" why ")"
      if (why ~ /packages? /) {
        sub(/^.*packages? /, "", why)
        gsub(/,| and /, " ", why)
        count = split(why, names, " ")
        for (i = 1; i <= count; ++i)
          if (!(names[i] in known)) { known[names[i]] = 1; packages = packages " " names[i] }
      }
    }
  }
  END {
    if (skipped == "") { print "no test was skipped"; exit }
    print "skipped: " skipped (packages == "" ? "" : "; to have them: apt-get install" packages)
  }' "$1/Testing/Temporary/LastTest.log"

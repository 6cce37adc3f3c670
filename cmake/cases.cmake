# A directory cases/<id> with a case.toml takes part by being there (cmake/names.cmake finds it):
#   test case-<id>      computes what is missing and compares it with the case's expected.csv and rows of tables/published.csv
#   test figure-<id>    draws its figures in the build directory, without a warning
#   target table-<id>   computes what is missing and writes tables/<id>.csv and .md; all of them: tables
#   target figure-<id>  the same, and draws figures/<id>/* and the paper's tables, tables/table<n>.csv and .md; all of
#                       them, and figures/gallery.md: figures
# An outline cases/<id>/profile.csv has a target figure-<id>, which fits it and draws that.
# Stored results cases/<id>/<name>/<run>/ of another file cases/<id>/<name>.toml have a test case-<id>-<name> and a
# target table-<id>-<name>. What is computed lies in results/ for all of them.
# The target ledger writes tables/ledger.csv and .md, the verdict on each claim of the paper; it is part of figures.
find_program(GNUPLOT gnuplot REQUIRED)
set(DRAW env LC_ALL=C.UTF-8 ${GNUPLOT} -c figures/style.gp) # elsewhere it complains of letters that it cannot write
file(READ tables/published.csv PUBLISHED)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS tables/published.csv)

include(cmake/names.cmake)

add_custom_target(tables)
add_custom_target(figures COMMAND sh cmake/gallery.sh ${CASES} ${FITS} ${STORED_NAMES}
  COMMENT "Writing figures/gallery.md" WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} VERBATIM)
add_custom_target(ledger
  COMMAND sh cmake/accept.sh 1 $<TARGET_FILE:capsule> ledger --table tables/ledger
  COMMENT "Ledger of claims" WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} USES_TERMINAL VERBATIM)
add_dependencies(ledger tables)
# Every claim must have the verdict that the table records.
add_test(NAME ledger COMMAND capsule ledger --table ${CMAKE_CURRENT_BINARY_DIR}/ledger --jobs 2
         WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
set_tests_properties(ledger PROPERTIES LABELS case PROCESSORS 2 TIMEOUT 900 FIXTURES_REQUIRED studies)
add_dependencies(figures ledger)

# The test case-<name> and the target table-<name> for what `capsule check ...` compares.
function(add_comparison name)
  string(FIND "${PUBLISHED}" ",${name}," row)
  if(row EQUAL -1 AND NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/cases/${name}/expected.csv)
    message(WARNING "no expectations for ${name}: add cases/${name}/expected.csv")
  endif()
  add_test(NAME case-${name} COMMAND capsule check ${ARGN} --jobs 2 WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_tests_properties(case-${name} PROPERTIES LABELS case PROCESSORS 2 TIMEOUT 600 FIXTURES_SETUP results-${name})
  # A comparison that differs (1) and a run that fails (3) are written down like any other.
  add_custom_target(table-${name}
    COMMAND sh cmake/accept.sh 1,3 $<TARGET_FILE:capsule> check ${ARGN} --table tables/${name}
    COMMENT "Case ${name}" WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} USES_TERMINAL VERBATIM)
  add_dependencies(table-${name} capsule)
  add_dependencies(tables table-${name})
endfunction()

# The test and the target figure-<id>.
function(add_figures id)
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/cases/${id}/figure.gp)
    message(WARNING "nothing to draw for ${id}: add cases/${id}/figure.gp")
    return()
  endif()
  add_test(NAME figure-${id}
           COMMAND ${DRAW} cases/${id} ${CMAKE_CURRENT_BINARY_DIR}/figures
           WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_tests_properties(figure-${id} PROPERTIES LABELS figure FIXTURES_REQUIRED results-${id}
                       FAIL_REGULAR_EXPRESSION "warning;undefined;cannot")
  add_custom_target(figure-${id} COMMAND ${DRAW} cases/${id} figures
    COMMENT "Drawing ${id}" WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} VERBATIM)
  add_dependencies(figure-${id} table-${id})
  add_dependencies(figures figure-${id})
endfunction()

foreach(id IN LISTS CASES)
  add_comparison(${id} cases/${id})
  add_figures(${id})
endforeach()
foreach(directory name IN ZIP_LISTS STORED STORED_NAMES)
  add_comparison(${name} cases/${directory}.toml --out cases/${directory})
endforeach()
foreach(id IN LISTS FITS)
  add_custom_target(figure-${id}
    COMMAND capsule fit cases/${id}/${id}.toml --profile cases/${id}/profile.csv
    COMMAND ${DRAW} cases/${id} figures
    COMMENT "Fit ${id}" WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} VERBATIM)
  add_dependencies(figures figure-${id})
endforeach()

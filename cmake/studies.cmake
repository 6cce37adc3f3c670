# A directory validation/<id> takes part by being there, with a figure.gp and one of:
#   study.cpp    a program of its own, linked with the solver: called as studies/<id> results/<id> <jobs>, it writes CSV
#                files there, prints what it found and ends with 0 if every claim that it checks holds
#   case.toml    runs that are compared with the case's rows of tables/published.csv
# target study-<id>   computes, then draws figures/<id>/* whatever the verdict, and fails if the verdict says so;
#                     all of them: atlas; `studies` builds the programs of all of them and runs none
# A study.cpp that rows of tables/published.csv speak of leaves its numbers in results/<id>/summary.json: target and test
# ledger wait for it.
add_library(study EXCLUDE_FROM_ALL validation/study.cpp validation/steady_folds.cpp validation/estimates.cpp)
target_include_directories(study PUBLIC validation)
target_link_libraries(study PUBLIC solver PRIVATE warnings)

include(ProcessorCount)
ProcessorCount(PROCESSORS)
add_custom_target(atlas)
add_custom_target(studies)

# The target study-<id>, which takes its verdict from the command.
function(add_study id)
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/validation/${id}/figure.gp)
    message(WARNING "nothing to draw for ${id}: add validation/${id}/figure.gp")
  endif()
  add_custom_target(study-${id} COMMAND sh cmake/study.sh ${id} ${GNUPLOT} ${ARGN}
    COMMENT "Study ${id}" WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} USES_TERMINAL VERBATIM)
  add_dependencies(atlas study-${id})
endfunction()

foreach(id IN LISTS STUDIES)
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/validation/${id}/study.cpp)
    add_study(${id} $<TARGET_FILE:capsule> check validation/${id} --jobs ${PROCESSORS} --table tables/${id})
    add_dependencies(study-${id} capsule)
    continue()
  endif()
  add_executable(${id}-program EXCLUDE_FROM_ALL validation/${id}/study.cpp)
  set_target_properties(${id}-program PROPERTIES OUTPUT_NAME ${id} RUNTIME_OUTPUT_DIRECTORY studies)
  target_link_libraries(${id}-program PRIVATE study warnings)
  add_dependencies(studies ${id}-program)
  add_study(${id} $<TARGET_FILE:${id}-program> results/${id} ${PROCESSORS})
  add_dependencies(study-${id} ${id}-program)
  string(FIND "${PUBLISHED}" ",${id}," row)
  if(NOT row EQUAL -1)
    add_dependencies(ledger study-${id})
    add_test(NAME study-${id} COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target study-${id})
    set_tests_properties(study-${id} PROPERTIES LABELS case PROCESSORS 2 FIXTURES_SETUP studies)
  endif()
endforeach()

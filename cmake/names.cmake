# Which directories take part by being there, and what they are called:
#   CASES                  <id> of cases/<id>/case.toml
#   FITS                   <id> of cases/<id>/profile.csv, an outline that `capsule fit cases/<id>/<id>.toml` takes
#   STORED, STORED_NAMES   <id>/<name> and <id>-<name> of results that are stored with a case, cases/<id>/<name>/<run>/
#   STUDIES                <id> of validation/<id>/study.cpp and validation/<id>/case.toml
# A directory whose name cannot be used is left out with a warning, and nothing else. What comes or goes configures again.

# names_in(<variable> <folder> <pattern>): the directories of the folder that hold a file which fits the pattern.
function(names_in variable folder pattern)
  foreach(which IN ITEMS . ${pattern}) # all of them, then these
    execute_process(COMMAND sh cmake/names.sh ${folder} ${which} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
                    OUTPUT_VARIABLE names ERROR_VARIABLE left_out OUTPUT_STRIP_TRAILING_WHITESPACE
                    COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\n" ";" names "${names}")
    if(which STREQUAL "." AND EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder})
      list(TRANSFORM names PREPEND ${folder}/ OUTPUT_VARIABLE directories)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder} ${directories})
    endif()
  endforeach()
  if(left_out)
    string(REGEX REPLACE "\n(.)" "\n \\1" left_out "${left_out}") # a line that begins with a space stays as it is
    message(WARNING " ${left_out}")
  endif()
  set(${variable} ${names} PARENT_SCOPE)
endfunction()

include(cmake/taken_names.cmake)

# take_name(<name> <directory> <list> <item>...): adds the item to the list, and so on, if the name is free.
macro(take_name name directory)
  if("${name}" IN_LIST TAKEN_NAMES OR "${name}" MATCHES "^table[0-9]+$")
    message(WARNING " ${directory} is left out: the name '${name}' is taken")
  else()
    list(APPEND TAKEN_NAMES ${name})
    set(remaining ${ARGN})
    while(remaining)
      list(POP_FRONT remaining list item)
      list(APPEND ${list} ${item})
    endwhile()
  endif()
endmacro()

names_in(programs validation study.cpp)
names_in(names validation case.toml)
list(APPEND names ${programs})
list(REMOVE_DUPLICATES names)
foreach(id IN LISTS names)
  take_name(${id} validation/${id} STUDIES ${id})
endforeach()
names_in(names cases case.toml)
foreach(id IN LISTS names)
  take_name(${id} cases/${id} CASES ${id})
endforeach()
names_in(names cases profile.csv)
foreach(id IN LISTS names)
  take_name(${id} cases/${id} FITS ${id})
endforeach()
foreach(id IN LISTS CASES)
  names_in(names cases/${id} */summary.json)
  foreach(name IN LISTS names)
    take_name(${id}-${name} cases/${id}/${name} STORED ${id}/${name} STORED_NAMES ${id}-${name})
  endforeach()
endforeach()

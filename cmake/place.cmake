# Where the project may lie: anywhere, but for what CMake and ninja cannot do themselves. A path that CMake would take for
# several, for a pattern or for code is refused by name. Beyond that, ninja 1.11 reads `gcc -MD` only up to some
# characters: then it misses a file and compiles all of them again each time.
foreach(place IN ITEMS "${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}")
  if("${place}" MATCHES "[]\\[;\"\\#*?<>|\n]|[$][A-Za-z]*{")
    message(FATAL_ERROR " ${place}\n cannot be built in: CMake and ninja do not bear '${CMAKE_MATCH_0}' in the name of a directory")
  endif()
  if("${place}" MATCHES "[&'`^\t]")
    message(WARNING " ${place}\n will compile everything in each build: ninja does not bear '${CMAKE_MATCH_0}' in the name of a directory")
    break() # once is enough
  endif()
endforeach()

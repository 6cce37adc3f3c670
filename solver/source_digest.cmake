# Writes OUTPUT, a source file that defines the digest of everything the solver is made of, in SOURCES.
file(GLOB sources ${SOURCES}/*.cpp ${SOURCES}/*.hpp)
list(SORT sources)
foreach(source IN LISTS sources)
  file(SHA256 ${source} hash)
  string(APPEND hashes ${hash})
endforeach()
string(SHA256 digest "${hashes}")
file(WRITE ${OUTPUT} "#include \"build_info.hpp\"\nconst char *const capsule::build_info::source_digest = \"${digest}\";\n")

# Names that no case and no study may have: `capsule new` refuses them, too. In results/, figures/ and tables/ a name
# belongs to one; and a study's program is called as the study, so that a target of this name would be made twice.
set(TAKEN_NAMES
  benchmark branch ledger published runs steady # in results/ and tables/; so are table1, table2 ...
  gallery.md style.gp                           # in figures/
  all clean edit_cache help install list_install_components package package_source rebuild_cache test # targets of CMake
  atlas benchmarks capsule figures fuzzers report studies tables)                                     # and of the project

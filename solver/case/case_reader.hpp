#pragma once
// What case files and --set give the keys: sections, sweeps and inheritance resolved, each value checked against its own
// key and kept with its place; the last of several wins. What a case makes of it is up to case_file.hpp. Throws nothing:
// errors become complaints.
#include "case/key.hpp"
#include "case/located_text.hpp"
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace capsule {

struct GivenValue {
  Value value;
  TextPlace place;
};

// What one key was given: one value, or those of its sweep.
struct Assignment {
  const Key *key = nullptr;
  bool sweep = false;
  TextPlace place;
  std::size_t level =
      0; // of what gave it: 0 is the file that inherits from none, --set stands above all files
  std::vector<GivenValue> values;
};

// Everything that is gathered while files are read.
struct CaseReader {
  LocatedText text;
  std::vector<Assignment> assignments; // the inherited ones first
  std::size_t level = 0;               // of what is being read
  bool complete = true;                // no file or --set had to be left out
  std::map<std::string, TextPlace> sections;
  std::vector<std::string> meant; // keys that unknown ones probably stand for
  // Where the case inherits from several files: their names, and which of them is read here.
  std::vector<std::string> families;
  std::size_t family = 0;

  void complain(const TextPlace &place, const std::string &message, const std::string &hint = "") {
    text.complain({place, message, hint});
  }
};

// Adds what stands there; errors become complaints.
void read_case_file(CaseReader &reader, const std::filesystem::path &file);
// "key=value", where the value may be a bare word.
void read_override(CaseReader &reader, const std::string &argument);

// The file that a path of the command line or of `inherit` stands for.
std::filesystem::path case_file_of(const std::filesystem::path &path);
// The directory's name for its case.toml; another file of a case directory carries both names.
std::string case_name_of(const std::filesystem::path &file);

} // namespace capsule

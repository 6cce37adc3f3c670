#include "case_file.hpp"
#include "build_info.hpp"
#include "case_keys.hpp"
#include "failure.hpp"
#include "text.hpp"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <toml++/toml.h>
#include <tuple>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// A text that was read: a file, or one --set.
struct Source {
  std::string label; // how messages name it
  std::vector<std::u32string> lines;
};

struct Place {
  std::size_t source = 0;
  std::size_t line = 1;
  std::size_t column = 1;
  auto operator<=>(const Place &) const = default; // NOLINT(modernize-use-nullptr): the check misreads this
};

struct Error {
  Place place;
  Complaint complaint;
};

// What one key was given: one value, or those of its sweep.
struct Assignment {
  const Key *key = nullptr;
  bool sweep = false;
  Place place;
  struct Given {
    Value value;
    Place place;
  };
  std::vector<Given> values;
};

// Without the byte order mark that is allowed in front.
std::u32string characters_of(const std::string &text) {
  const std::u32string characters = decoded(text);
  return characters.substr(characters.starts_with(U'\ufeff') ? 1 : 0);
}

std::vector<std::u32string> split_lines(const std::u32string &text) {
  std::vector<std::u32string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(U'\n', begin), text.size());
    const bool carriage_return = end > begin && text[end - 1] == U'\r';
    lines.push_back(text.substr(begin, end - begin - (carriage_return ? 1 : 0)));
    begin = end + 1;
  }
  return lines;
}

// Lines of the source around a place, and a caret below it: one column for each character, whatever the file holds.
std::string excerpt(const std::u32string &line, const Place &place) {
  constexpr std::size_t longest = 160;
  const std::size_t column = std::min(place.column - 1, line.size());
  const std::size_t begin = column < longest ? 0 : column - longest / 2;
  std::u32string shown = line.substr(begin, longest), margin = line.substr(begin, column - begin);
  for (char32_t &c : shown)
    c = c == U'\t' || is_printable(c) ? c : U'?';
  for (char32_t &c : margin)
    c = c == U'\t' ? U'\t' : U' ';
  return fmt::format("{:5} | {}\n      | {}^\n", place.line, encoded(shown), encoded(margin));
}

// What a file's own words may have brought into a message, without commands to the terminal.
std::string without_controls(const std::string &text) {
  std::string shown;
  for (const char32_t c : decoded(text))
    shown += is_printable(c) ? encoded({&c, 1}) : fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c));
  return shown;
}

std::string error_text(const Error &error, const std::vector<Source> &sources) {
  const Place &place = error.place;
  const Source &source = sources.at(place.source);
  std::string text = fmt::format("{}:{}:{}: error: {}\n", source.label, place.line, place.column,
                                 without_controls(error.complaint.message));
  if (place.line <= source.lines.size())
    text += excerpt(source.lines[place.line - 1], place);
  if (!error.complaint.hint.empty())
    text += without_controls(error.complaint.hint) + "\n";
  return text;
}

// Everything that is gathered while files are read.
struct Reader {
  std::vector<Source> sources;
  std::vector<Error> errors;
  std::vector<Assignment> assignments; // the inherited ones first
  bool complete = true;                // no file or --set had to be left out
  std::map<std::string, Place> sections;
  std::vector<std::string> meant; // keys that unknown ones probably stand for
  // Where the case inherits from several files: their names, and which of them is read here.
  std::vector<std::string> families;
  std::size_t family = 0;

  std::size_t add_source(const std::string &label, const std::string &text) {
    sources.push_back({label, split_lines(characters_of(text))});
    return sources.size() - 1;
  }

  // The rest of the line.
  std::string text_at(const Place &place) const {
    const std::vector<std::u32string> &lines = sources[place.source].lines;
    if (place.line > lines.size() || place.column > lines[place.line - 1].size())
      return {};
    return encoded(std::u32string_view(lines[place.line - 1]).substr(place.column - 1));
  }

  void complain(const Place &place, std::string message, std::string hint = "") {
    const auto same = [&](const Error &e) { return e.place == place && e.complaint.message == message; };
    if (std::ranges::none_of(errors, same)) // the runs of a sweep may fail alike
      errors.push_back({place, {std::move(message), std::move(hint)}});
  }

  void throw_if_any() {
    if (errors.empty())
      return;
    std::ranges::stable_sort(errors, {}, &Error::place);
    std::string text;
    for (const Error &error : errors)
      text += error_text(error, sources);
    throw InputError(text);
  }
};

Place place_of(std::size_t source, const toml::source_position &position) {
  return {source, std::max<std::size_t>(1, position.line), std::max<std::size_t>(1, position.column)};
}

// Where a key begins as it is written: "flow.type" for its last part too.
Place key_place(const Reader &reader, std::size_t source, const toml::key &key) {
  Place place = place_of(source, key.source().begin);
  const std::vector<std::u32string> &lines = reader.sources[source].lines;
  constexpr std::u32string_view ends = U" \t{,";
  if (place.line <= lines.size()) {
    const std::u32string &line = lines[place.line - 1];
    while (place.column > 1 && place.column - 2 < line.size() &&
           ends.find(line[place.column - 2]) == ends.npos)
      --place.column;
  }
  return place;
}

std::string type_in_words(const toml::node &node) {
  switch (node.type()) {
  case toml::node_type::table:
    return "a table";
  case toml::node_type::boolean:
    return node.as_boolean()->get() ? "true" : "false";
  case toml::node_type::array:
    return "a list";
  default:
    return "a date or time";
  }
}

Value to_value(const toml::node &node) {
  if (const auto *text = node.as_string())
    return text->get();
  if (const auto *integer = node.as_integer())
    return std::int64_t{integer->get()};
  if (const auto *number = node.as_floating_point())
    return number->get();
  if (const toml::array *array = node.as_array()) {
    std::vector<double> list;
    for (const toml::node &entry : *array) {
      if (!entry.is_number())
        return Unsupported{"a list with other things than numbers"};
      list.push_back(entry.value<double>().value());
    }
    return list;
  }
  return Unsupported{type_in_words(node)};
}

bool is_section(const std::string &name) {
  return std::ranges::any_of(keys(), [&](const Key &key) { return key.name.starts_with(name + "."); });
}

std::string section_of(const std::string &name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(0, dot);
}

// The key that a wrong name most likely meant.
std::string nearest_key(const std::string &name) {
  std::vector<std::string> all, last, here;
  for (const Key &key : keys()) {
    all.push_back(key.name);
    last.emplace_back(last_component(key.name));
    if (section_of(key.name) == section_of(name))
      here.emplace_back(last_component(key.name));
  }
  const std::string word(last_component(name));
  if (const std::string near = nearest_word(word, here); !near.empty())
    return section_of(name).empty() ? near : section_of(name) + "." + near;
  if (const std::string near = nearest_word(word, last); !near.empty())
    return all.at(static_cast<std::size_t>(std::ranges::find(last, near) - last.begin()));
  return nearest_word(name, all);
}

void complain_unknown(Reader &reader, const Place &place, const std::string &name, bool sweep) {
  if (is_section(name)) {
    reader.complain(place, fmt::format("'{}' is a section, not a key", name),
                    fmt::format("write [{}] and its keys below", name));
    return;
  }
  const std::string near = nearest_key(name);
  // As it would be written at the same place: below [flow] without the section.
  const bool same_section = section_of(near) == section_of(name);
  const bool below_section = reader.text_at(place).starts_with(last_component(name));
  const std::string shown = same_section && below_section ? std::string(last_component(near)) : near;
  reader.meant.push_back(near);
  reader.complain(place, fmt::format("unknown key '{}'{}", name, sweep ? " in sweep" : ""),
                  near.empty() ? "`capsule keys` lists them all" : fmt::format("did you mean '{}'?", shown));
}

// A single value or, for a sweep, the values of the list; complains about each that the key cannot take.
std::vector<Assignment::Given> given_values(Reader &reader, std::size_t source, const Key &key, bool sweep,
                                            const toml::node &node) {
  const Place place = place_of(source, node.source().begin);
  std::vector<Assignment::Given> values;
  if (!sweep)
    values.push_back({to_value(node), place});
  else if (const toml::array *array = node.as_array())
    for (const toml::node &entry : *array)
      values.push_back({to_value(entry), place_of(source, entry.source().begin)});
  if (values.empty())
    reader.complain(place, fmt::format("the sweep of {} must be a list of one or more values", key.name));
  Case scratch;
  std::vector<std::string> seen;
  for (const Assignment::Given &given : values) {
    if (auto complaint = set_value(key, given.value, scratch)) {
      reader.complain(given.place, complaint->message, complaint->hint);
      continue;
    }
    forget_spellings(scratch);
    const std::string text = value_text(get_value(key, scratch).value_or(given.value));
    if (std::ranges::find(seen, text) != seen.end())
      reader.complain(given.place, fmt::format("{} = {} stands twice in the sweep", key.name, text));
    seen.push_back(text);
  }
  return values;
}

bool can_be_swept(const Key &key) {
  return !std::holds_alternative<Member<std::string>>(key.field) &&
         !std::holds_alternative<Member<std::vector<double>>>(key.field);
}

// Every value of a file or a --set, as assignments in the order in which they stand.
struct Flattener {
  Reader &reader;
  std::size_t source;
  std::vector<Assignment> found;

  void leaf(const std::string &name, bool sweep, const Place &place, const toml::node &node) {
    const Key *key = find_key(name);
    if (key == nullptr)
      complain_unknown(reader, place, name, sweep);
    else if (sweep && !can_be_swept(*key))
      reader.complain(place, fmt::format("'{}' cannot be swept", name));
    else
      found.push_back({key, sweep, place, given_values(reader, source, *key, sweep, node)});
  }

  void table(const toml::table &table, const std::string &prefix, bool sweep) {
    for (auto &&[key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      const Place place = key_place(reader, source, key);
      const bool sweeps = sweep || name == "sweep";
      if (name == "sweep" && !sweep && !node.is_table())
        reader.complain(place, "'sweep' is a section, not a key", "write sweep.\"any.key\" = [...]");
      else if (const toml::table *inner = node.as_table(); inner != nullptr && find_key(name) == nullptr) {
        reader.sections.try_emplace(name, place);
        if (inner->empty() && !sweeps && !is_section(name))
          complain_unknown(reader, place, name, sweep);
        this->table(*inner, name == "sweep" && !sweep ? "" : name + ".", sweeps);
      } else
        leaf(name, sweep, place, node);
    }
  }
};

void collect(Reader &reader, std::size_t source, const toml::table &root) {
  Flattener flattener{reader, source, {}};
  flattener.table(root, "", false);
  std::ranges::sort(flattener.found, {}, &Assignment::place);
  for (const Assignment &assignment : flattener.found) {
    const auto same = std::ranges::find(reader.assignments, assignment.key, &Assignment::key);
    if (same != reader.assignments.end()) {
      if (same->place.source == source)
        reader.complain(assignment.place, fmt::format("'{}' is both set and swept", assignment.key->name));
      reader.assignments.erase(same);
    }
    reader.assignments.push_back(assignment);
  }
}

// The file that a path of the command line or of `inherit` stands for.
fs::path case_file_of(const fs::path &path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? path / "case.toml" : path;
}

// The text of a regular file, or why it cannot be had.
std::variant<std::string, Complaint> read_text(const fs::path &file) {
  std::error_code ec;
  const fs::file_status status = fs::status(file, ec);
  if (status.type() == fs::file_type::not_found)
    return Complaint{"no such file",
                     file.filename() == "case.toml" ? "a case directory holds a case.toml" : ""};
  if (status.type() == fs::file_type::directory)
    return Complaint{"is a directory, not a file", ""};
  if (ec)
    return Complaint{"cannot be read: " + ec.message(), ""};
  if (status.type() != fs::file_type::regular)
    return Complaint{"is not a regular file", ""};
  constexpr std::uintmax_t most_bytes = 1000000;
  if (fs::file_size(file, ec) > most_bytes && !ec)
    return Complaint{"is larger than any case file", ""};
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream && stream.peek() != std::ifstream::traits_type::eof())
    text << stream.rdbuf();
  if (!stream.is_open() || stream.bad())
    return Complaint{std::string("cannot be read: ") + std::strerror(errno), ""};
  return text.str();
}

bool is_ascii(char32_t c) {
  return c < 0x80;
}

// The first character beyond ASCII that begins a line joined to the one before by a backslash; also in a literal
// string, where a backslash joins nothing.
std::size_t find_joined(const std::u32string &text) {
  constexpr const char32_t *white = U" \t\v\f\r\n";
  for (std::size_t at = text.find(U'\\'); at != text.npos; at = text.find(U'\\', at + 1)) {
    const std::size_t next = text.find_first_not_of(white, at + 1);
    if (next != text.npos && !is_ascii(text[next]) && text.find(U'\n', at) < next)
      return next;
  }
  return text.npos;
}

Place place_of(std::size_t source, std::u32string_view text, std::size_t at) {
  const std::u32string_view before = text.substr(0, at);
  const auto lines = static_cast<std::size_t>(std::ranges::count(before, U'\n'));
  return {source, lines + 1, before.size() - (before.rfind(U'\n') + 1) + 1};
}

// What toml++ says of a text whose characters beyond ASCII it was given as question marks.
std::string description_of(const toml::parse_error &error, const Place &place, const std::u32string &text) {
  std::string description(error.description());
  const std::vector<std::u32string> lines = split_lines(text);
  const std::size_t mark = description.rfind("'?'");
  if (mark != std::string::npos && place.line <= lines.size() && place.column <= lines[place.line - 1].size())
    description.replace(mark + 1, 1, encoded({&lines[place.line - 1][place.column - 1], 1}));
  return description;
}

// The table that a text is, or what is wrong with it. What toml++ 3.3 does is not defined where it asks whether a
// character beyond ASCII is white space: outside of strings and comments, where it would be an error like the ASCII
// character in its place, and behind a backslash that joins two lines of a string.
std::variant<toml::table, Error> parse(std::size_t source, const std::string &text) {
  const std::u32string characters = characters_of(text);
  if (const std::size_t zero = characters.find(U'\0'); zero != characters.npos)
    return Error{place_of(source, characters, zero), {"not a text file: byte 0", ""}};
  if (const auto [wrong, unused] = std::ranges::mismatch(text, encoded(decoded(text))); wrong != text.end()) {
    const std::u32string before = characters_of({text.begin(), wrong});
    return Error{place_of(source, before, before.size()),
                 {fmt::format("not UTF-8: byte 0x{:02x}", static_cast<unsigned char>(*wrong)), ""}};
  }
  if (const std::size_t joined = find_joined(characters); joined != characters.npos)
    return Error{place_of(source, characters, joined),
                 {"a joined line must begin with an ASCII character", ""}};
  try {
    std::string ascii;
    for (const char32_t c : characters)
      ascii += is_ascii(c) ? static_cast<char>(c) : '?';
    const toml::table well_formed = toml::parse(std::string_view(ascii)); // or it throws
    return toml::parse(std::string_view(text));
  } catch (const toml::parse_error &error) {
    const Place place = place_of(source, error.source().begin);
    return Error{place, {description_of(error, place, characters), ""}};
  }
}

// The directory's name for its case.toml; another file of a case directory carries both names.
std::string name_of(const fs::path &file) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(file, ignored);
  std::string directory = whole.parent_path().filename().string();
  if (whole.filename() == "case.toml")
    return directory;
  const bool in_case_directory = fs::exists(whole.parent_path() / "case.toml", ignored);
  return (in_case_directory ? directory + "-" : "") + whole.stem().string();
}

// The file to inherit from: the only one, or that of the reader's family.
std::optional<fs::path> inherited_file(Reader &reader, const Place &place, const toml::node &node,
                                       const fs::path &file) {
  if (const auto *name = node.as_string())
    return case_file_of(file.parent_path() / name->get());
  const toml::array *list = node.as_array();
  if (list == nullptr || list->empty() || !list->is_homogeneous(toml::node_type::string)) {
    reader.complain(place, "inherit must be the path of a file, or a list of paths");
    return std::nullopt;
  }
  if (!reader.families.empty()) {
    reader.complain(place, "only one of a case's files can inherit from several");
    return std::nullopt;
  }
  std::vector<fs::path> files;
  for (const toml::node &name : *list) {
    files.push_back(case_file_of(file.parent_path() / name.as_string()->get()));
    const std::string family = name_of(files.back());
    if (std::ranges::find(reader.families, family) != reader.families.end())
      reader.complain(place, fmt::format("'{}' stands twice in inherit", family));
    reader.families.push_back(family);
  }
  return files[reader.family];
}

void read_file(Reader &reader, const fs::path &file, std::vector<fs::path> &chain);

void follow_inherit(Reader &reader, std::size_t source, toml::table &root, const fs::path &file,
                    std::vector<fs::path> &chain) {
  const auto node = root.find("inherit");
  if (node == root.end())
    return;
  const Place place = place_of(source, node->second.source().begin);
  const std::optional<fs::path> found = inherited_file(reader, place, node->second, file);
  root.erase(node);
  if (!found)
    return;
  const fs::path &parent = *found;
  std::error_code ignored;
  if (std::ranges::find(chain, fs::weakly_canonical(parent, ignored)) != chain.end()) {
    reader.complain(place, fmt::format("'{}' inherits from itself", parent.string()));
    reader.complete = false;
    return;
  }
  const auto text = read_text(parent);
  if (const auto *complaint = std::get_if<Complaint>(&text)) {
    reader.complain(place, fmt::format("'{}': {}", parent.string(), complaint->message), complaint->hint);
    reader.complete = false;
    return;
  }
  read_file(reader, parent, chain);
}

void read_file(Reader &reader, const fs::path &file, std::vector<fs::path> &chain) {
  const auto text = read_text(file);
  const auto *content = std::get_if<std::string>(&text);
  const std::size_t source = reader.add_source(file.string(), content ? *content : "");
  if (!content) {
    const auto &complaint = std::get<Complaint>(text);
    reader.complain({source}, complaint.message, complaint.hint);
    reader.complete = false;
    return;
  }
  auto parsed = parse(source, *content);
  if (const auto *error = std::get_if<Error>(&parsed)) {
    reader.complain(error->place, error->complaint.message);
    reader.complete = false;
    return;
  }
  auto &root = std::get<toml::table>(parsed);
  if (root.empty())
    reader.complain({source}, "the file holds no keys");
  std::error_code ignored;
  chain.push_back(fs::weakly_canonical(file, ignored));
  follow_inherit(reader, source, root, file, chain);
  chain.pop_back();
  collect(reader, source, root);
}

// "key=value", where the value may be a bare word.
void read_override(Reader &reader, const std::string &argument) {
  const std::size_t source = reader.add_source("--set", argument);
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos || argument.find('\n') != std::string::npos) {
    reader.complain({source}, "expected key=value");
    return;
  }
  auto parsed = parse(source, argument);
  if (std::holds_alternative<Error>(parsed))
    parsed = parse(source, argument.substr(0, equals + 1) + value_text(argument.substr(equals + 1)));
  if (const auto *error = std::get_if<Error>(&parsed)) {
    reader.complain(error->place, error->complaint.message);
    reader.complete = false;
  } else
    collect(reader, source, std::get<toml::table>(parsed));
}

// The values of one run: for each assignment the index of its value.
using Selection = std::vector<std::size_t>;

std::vector<Selection> all_selections(const std::vector<Assignment> &assignments) {
  std::vector<Selection> selections{{}};
  for (const Assignment &assignment : assignments) {
    std::vector<Selection> longer;
    for (const Selection &selection : selections)
      for (std::size_t i = 0; i < assignment.values.size(); ++i) {
        longer.push_back(selection);
        longer.back().push_back(i);
      }
    selections = std::move(longer);
  }
  return selections;
}

// One run while it is put together: what was given, where, and what follows.
struct Builder {
  Reader &reader;
  const Selection &selection;
  RunInput run;
  std::vector<std::string> derived; // keys whose value follows from the physical ones
  bool measured_well = true;        // no physical key was complained of

  const Assignment::Given *given(const std::string &name) const {
    for (std::size_t i = 0; i < reader.assignments.size(); ++i)
      if (reader.assignments[i].key->name == name)
        return &reader.assignments[i].values[selection[i]];
    return nullptr;
  }

  bool swept(const std::string &name) const {
    const auto same = [&](const Assignment &a) { return a.key->name == name && a.sweep; };
    return std::ranges::any_of(reader.assignments, same);
  }

  // Complains at the first of the keys that was given, or else at the file's beginning.
  void complain(const std::vector<std::string> &names, const std::string &message,
                const std::string &hint = "") {
    Place place;
    for (const std::string &name : names)
      if (const auto *value = given(name)) {
        place = value->place;
        break;
      }
    reader.complain(place, message, hint);
  }

  // Section 3 of the paper; values that are given override it.
  void apply_preset() {
    if (const auto *numerics = given("numerics"))
      set_value(*find_key("numerics"), numerics->value, run.physics);
    if (run.physics.numerics == Numerics::paper) {
      run.physics.mesh = {60, 120, 30};
      run.physics.time.scheme = Scheme::euler;
    }
  }

  // What a directory may be called by: no unit, no slash.
  std::string si_number(const Key &key) const {
    return number_text(std::get<Measured>(key.field).member.of(run.physics).si);
  }

  void take_values() {
    for (std::size_t i = 0; i < reader.assignments.size(); ++i) {
      const Assignment &assignment = reader.assignments[i];
      const Value &value = assignment.values[selection[i]].value;
      if (set_value(*assignment.key, value, run.physics))
        stand_in(*assignment.key);
      if (assignment.sweep) {
        const auto *word = std::get_if<std::string>(&value);
        const bool measured = std::holds_alternative<Measured>(assignment.key->field);
        run.name += fmt::format("{}{}={}", run.name.empty() ? "" : ",", last_component(assignment.key->name),
                                measured ? si_number(*assignment.key)
                                : word   ? *word
                                         : value_text(value));
      }
    }
  }

  // Any quantity for a physical key that was complained of, so that what follows from it is not missed.
  void stand_in(const Key &key) {
    const auto *measured = std::get_if<Measured>(&key.field);
    if (!measured)
      return;
    measured->member.in(run.physics).si = 1;
    measured_well = false;
  }

  // The dimensionless values that follow from the physical ones; a value that is given too must agree.
  void derive() {
    for (const std::string &name : reader.meant)
      if (const Key *key = find_key(name); key != nullptr && !given(name))
        stand_in(*key);
    if (!has_physical(run.physics))
      return;
    for (const PhysicalComplaint &why : physical_complaints(run.physics)) {
      std::vector<std::string> places = why.keys;
      std::ranges::copy(physical_keys(), std::back_inserter(places));
      complain(places, why.message, "`capsule keys` tells what physical.* means");
      measured_well = false;
    }
    for (const Derived &value : derived_values(run.physics)) {
      derived.push_back(value.key);
      if (measured_well)
        take_derived(value);
    }
  }

  void take_derived(const Derived &value) {
    const Key &key = *find_key(value.key);
    const double stated = number_of(key, run.physics);
    if (auto complaint = set_value(key, value.value, run.physics))
      complain({value.from}, complaint->message, complaint->hint);
    if (given(value.key) && std::abs(stated / value.value - 1) > 1e-9)
      complain({value.key},
               fmt::format("{} = {}, but {} makes it {}", value.key, number_text(stated), value.from,
                           number_text(value.value)),
               "leave one of them out");
  }

  static std::vector<std::string> physical_keys() {
    std::vector<std::string> names;
    for (const Key &key : keys())
      if (std::holds_alternative<Measured>(key.field))
        names.push_back(key.name);
    return names;
  }

  static double number_of(const Key &key, const Case &physics) {
    return std::get<Member<double>>(key.field).of(physics);
  }

  // Defaults that depend on other keys.
  void complete() {
    Case &c = run.physics;
    if (c.time.scheme == Scheme::euler && !given("time.step"))
      c.time.step = 2.5e-4;
    if (c.flow.type == FlowType::extension) {
      if (!given("pore.shape"))
        c.pore.shape = PoreShape::none;
      if (!given("capsule.radius"))
        c.capsule.radius = 1;
      if (!given("capsule.start_x"))
        c.capsule.start_x = 0;
    } else if (!c.until.x_g && !c.until.time)
      c.until.x_g = 11.84;
  }

  bool has_required() {
    bool all = true;
    for (const Key &key : keys()) {
      const bool scale = key.name == "capsule.radius" && run.physics.flow.type == FlowType::extension;
      if (!key.required || given(key.name) || scale || std::ranges::find(derived, key.name) != derived.end())
        continue;
      all = false;
      if (std::ranges::find(reader.meant, key.name) != reader.meant.end())
        continue;
      const auto section = reader.sections.find(section_of(key.name));
      reader.complain(section == reader.sections.end() ? Place{} : section->second,
                      fmt::format("missing key '{}'", key.name), key.meaning + ": " + allowed_text(key));
    }
    return all;
  }

  void check_scheme() {
    Case &c = run.physics;
    const bool given_steps = c.time.scheme != Scheme::bdf;
    const std::string unused = given_steps ? "time.tolerance" : "time.step";
    // With a sweep over several schemes each key serves some of the runs.
    if (given(unused) && !swept("time.scheme") && !swept("numerics"))
      complain({unused},
               fmt::format("{} means nothing to time.scheme = {}", unused,
                           value_text(*get_value(*find_key("time.scheme"), c))),
               given_steps ? "give time.step" : "give time.tolerance, or an explicit time.scheme");
    (given_steps ? c.time.tolerance : c.time.step) = 0;
    if (given_steps && c.time.step == 0)
      complain({"time.scheme"}, "time.scheme = \"rk4\" needs a time.step",
               "the longest stable step is about 1.4 times that of \"euler\"; both fall with mesh.membrane");
  }

  // Section 3 of the paper is one method for one flow, and alone in having elements on the exit section.
  void check_numerics() {
    Case &c = run.physics;
    if (c.numerics == Numerics::standard) {
      if (given("mesh.exit") && !swept("numerics"))
        complain({"mesh.exit"}, "mesh.exit means nothing to numerics = \"standard\"",
                 "leave out mesh.exit, or give numerics = \"paper\"");
      c.mesh.exit = 0;
      return;
    }
    if (c.time.scheme != Scheme::euler)
      complain({"time.scheme", "numerics"}, "numerics = \"paper\" marches with Euler's scheme only",
               "leave out time.scheme, or set it to \"euler\"");
    if (c.flow.type != FlowType::pore)
      complain({"flow.type", "numerics"}, "numerics = \"paper\" computes no unbounded liquid",
               "flow.type = \"extension\" needs numerics = \"standard\"");
    else if (c.pore.shape != PoreShape::hyperbolic)
      complain({"pore.shape", "numerics"}, "numerics = \"paper\" has the hyperbolic pore only",
               "another pore.shape needs numerics = \"standard\"");
  }

  void check_extension() {
    const Case &c = run.physics;
    if (c.pore.shape != PoreShape::none)
      complain({"pore.shape", "flow.type"}, "an extension is unbounded", "pore.shape must be \"none\"");
    if (c.capsule.radius != 1)
      complain({"capsule.radius"}, "in an extension lengths are scaled with the capsule's radius",
               "leave out capsule.radius, or set it to 1");
  }

  void check_end_of_extension() {
    const Case &c = run.physics;
    if (c.capsule.start_x != 0)
      complain({"capsule.start_x"}, "in an extension the capsule starts in the centre of the flow",
               "leave out capsule.start_x, or set it to 0");
    if (!c.until.time)
      complain({"flow.type"}, "an extension needs until.time");
    if (c.until.x_g || !c.output.profiles_at_x_g.empty())
      complain({"until.x_g", "output.profiles_at_x_g"}, "in an extension the capsule stays where it is",
               "use until.time and output.profiles_at_time");
  }

  // The undeformed capsule between the two end sections and inside the wall of eq. 1.
  void check_start() {
    const Case &c = run.physics;
    const double half_length = c.capsule.radius * std::pow(c.capsule.aspect_ratio, 2.0 / 3);
    const double half_width = c.capsule.radius / std::cbrt(c.capsule.aspect_ratio);
    const double x_0 = c.capsule.start_x;
    const double back = x_0 - half_length, front = x_0 + half_length;
    if (back <= -c.pore.entrance_distance)
      complain({"capsule.start_x", "pore.entrance_distance", "capsule.radius"},
               fmt::format("capsule outside the reservoir: it begins at x = {:.4g}", back),
               fmt::format("the entrance section is at x = {}", number_text(-c.pore.entrance_distance)));
    if (front >= c.pore.exit_x)
      complain({"capsule.start_x", "pore.exit_x", "capsule.radius"},
               fmt::format("capsule beyond the exit: it ends at x = {:.4g}", front),
               fmt::format("the exit section is at x = {}", number_text(c.pore.exit_x)));

    // r_w^2 - r^2 along the capsule is a parabola on each side of x = 0.
    const double slope = std::pow(half_width / half_length, 2);
    const double opening = c.pore.shape == PoreShape::tube
                               ? 0
                               : std::pow(std::tan(c.pore.opening_angle_deg * std::numbers::pi / 180), 2);
    const auto smallest = [&](double from, double to, double growth) {
      const double x = std::clamp(x_0 * slope / (growth + slope), from, to);
      return 1 - half_width * half_width + growth * x * x + slope * (x - x_0) * (x - x_0);
    };
    const bool upstream = back < 0 && smallest(back, std::min(front, 0.0), opening) <= 0;
    const bool downstream = front > 0 && smallest(std::max(back, 0.0), front, 0) <= 0;
    if (upstream || downstream)
      complain({"capsule.start_x", "capsule.radius"}, "capsule larger than the pore's entrance at its start",
               fmt::format("its largest radius is {:.4g} at x = {}; the tube's is 1 from x = 0 on",
                           half_width, number_text(x_0)));
  }

  void check_end() {
    const Case &c = run.physics;
    const double half_length = c.capsule.radius * std::pow(c.capsule.aspect_ratio, 2.0 / 3);
    if (c.until.x_g && *c.until.x_g <= c.capsule.start_x)
      complain({"until.x_g", "capsule.start_x"},
               fmt::format("until.x_g = {} lies upstream of the start", number_text(*c.until.x_g)),
               fmt::format("capsule.start_x is {}", number_text(c.capsule.start_x)));
    if (c.until.x_g && *c.until.x_g + half_length >= c.pore.exit_x)
      complain({"until.x_g", "pore.exit_x", "capsule.radius"},
               fmt::format("at until.x_g = {} the capsule would cross the exit section",
                           number_text(*c.until.x_g)),
               fmt::format("pore.exit_x is {}", number_text(c.pore.exit_x)));
    const double last = c.until.x_g.value_or(c.pore.exit_x);
    for (const double x : c.output.profiles_at_x_g)
      if (x < c.capsule.start_x || x > last)
        complain(
            {"output.profiles_at_x_g"}, fmt::format("the capsule never comes to x_g = {}", number_text(x)),
            fmt::format("its way goes from {} to {}", number_text(c.capsule.start_x), number_text(last)));
  }

  void check_physics(const Task &task) {
    const Case &c = run.physics;
    check_scheme();
    check_numerics();
    if (!task.motion && c.numerics == Numerics::paper)
      complain({"numerics"}, "numerics = \"paper\" only marches in time",
               "steady states need numerics = \"standard\"");
    if (c.flow.type == FlowType::extension)
      check_extension();
    else if (c.pore.shape == PoreShape::none)
      complain({"pore.shape"}, "a pore flow needs a pore",
               "pore.shape = \"none\" goes with flow.type = \"extension\"");
    if (task.motion)
      check_way();
  }

  // From the start to the end of a motion.
  void check_way() {
    const Case &c = run.physics;
    if (c.flow.type == FlowType::extension) {
      check_end_of_extension();
    } else if (c.pore.shape != PoreShape::none) {
      check_start();
      check_end();
    }
    for (const double t : c.output.profiles_at_time)
      if (c.until.time && t > *c.until.time)
        complain({"output.profiles_at_time"}, fmt::format("time {} comes after the end", number_text(t)),
                 fmt::format("until.time is {}", number_text(*c.until.time)));
  }
};

std::vector<RunInput> build_runs(Reader &reader, const Task &task) {
  constexpr std::size_t most_runs = 10000;
  std::size_t count = 1;
  for (const Assignment &assignment : reader.assignments)
    count = std::min(count * assignment.values.size(), most_runs + 1);
  if (count > most_runs) {
    reader.complain({}, fmt::format("the sweeps make more than {} runs", most_runs));
    return {};
  }
  const bool valid = reader.errors.empty();
  std::vector<RunInput> runs;
  for (const Selection &selection : all_selections(reader.assignments)) {
    Builder builder{reader, selection, {}, {}};
    builder.apply_preset();
    builder.take_values();
    builder.derive();
    builder.complete();
    if (builder.has_required() && valid)
      builder.check_physics(task);
    runs.push_back(std::move(builder.run));
  }
  return runs;
}

// The input without what makes no difference to the results.
std::string what_counts(const Case &physics, const Task &task) {
  Case relevant = physics;
  if (!task.motion) {
    relevant.capsule.start_x = Case{}.capsule.start_x;
    relevant.time = {};
    relevant.until = {};
    relevant.output = {};
    if (relevant.pore.shape != PoreShape::none)
      relevant.pore = {.shape = PoreShape::tube};
  }
  forget_spellings(relevant);
  relevant.title.clear();
  relevant.paper.clear();
  if (physics.numerics == Numerics::paper) // its meshes and its step are given
    relevant.accuracy = Case{}.accuracy;
  return resolved_toml(relevant);
}

} // namespace

CaseInput read_case(const fs::path &path, const std::vector<std::string> &overrides, const Task &task) {
  CaseInput input;
  input.file = case_file_of(path);
  input.name = name_of(input.file);
  std::size_t families = 1;
  for (std::size_t i = 0; i < families; ++i) {
    Reader reader;
    reader.family = i;
    std::vector<fs::path> chain;
    read_file(reader, input.file, chain);
    for (const std::string &argument : overrides)
      read_override(reader, argument);
    std::vector<RunInput> runs;
    if (reader.complete)
      runs = build_runs(reader, task);
    reader.throw_if_any();
    for (RunInput &run : runs) {
      if (!reader.families.empty())
        run.name = reader.families[i] + (run.name.empty() ? "" : ",") + run.name;
      input.runs.push_back(std::move(run));
    }
    families = std::max<std::size_t>(1, reader.families.size());
  }
  return input;
}

std::string resolved_toml(const Case &physics) {
  std::string text, section;
  for (const Key &key : keys()) {
    const auto value = get_value(key, physics);
    if (!value)
      continue;
    if (section_of(key.name) != section) {
      section = section_of(key.name);
      text += fmt::format("\n[{}]\n", section);
    }
    text += fmt::format("{} = {}\n", last_component(key.name), value_text(*value));
  }
  return text;
}

bool same_input(const Case &a, const Case &b, const Task &task) {
  return what_counts(a, task) == what_counts(b, task);
}

std::string run_identity(const Case &physics, const Task &task) {
  // FNV-1a, 64 bit
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c :
       fmt::format("{}\n{}\n{}", build_info::source_digest, task.name, what_counts(physics, task)))
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return fmt::format("{:016x}", hash);
}

} // namespace capsule

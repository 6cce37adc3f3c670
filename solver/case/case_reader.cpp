#include "case/case_reader.hpp"
#include "base/text.hpp"
#include "case/case.hpp"
#include "case/keys.hpp"
#include "case/symbols.hpp"
#include "case/toml_text.hpp"
#include "case/value_lists.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <toml++/toml.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// Where a key begins as it is written: "flow.type" for its last part too.
TextPlace key_place(const CaseReader &reader, std::size_t source, const toml::key &key) {
  TextPlace place = place_of(source, key.source().begin);
  const std::vector<std::u32string> &lines = reader.text.sources[source].lines;
  constexpr std::u32string_view ends = U" \t{,";
  if (place.line <= lines.size()) {
    const std::u32string &line = lines[place.line - 1];
    while (place.column > 1 && place.column - 2 < line.size() &&
           ends.find(line[place.column - 2]) == std::u32string_view::npos)
      --place.column;
  }
  return place;
}

std::string type_in_words(const toml::node &node) {
  switch (node.type()) {
  case toml::node_type::table:
    return "a table";
  case toml::node_type::array:
    return "a list";
  default:
    return "a date or time";
  }
}

Value to_value(const toml::node &node) {
  if (const auto *truth = node.as_boolean())
    return truth->get();
  if (const auto *text = node.as_string())
    return text->get();
  if (const auto *integer = node.as_integer())
    return std::int64_t{integer->get()};
  if (const auto *number = node.as_floating_point())
    return number->get();
  if (const toml::array *array = node.as_array()) {
    if (!array->empty() && array->is_homogeneous(toml::node_type::string)) {
      Words words;
      for (const toml::node &entry : *array)
        words.push_back(entry.as_string()->get());
      return words;
    }
    std::vector<double> list;
    for (const toml::node &entry : *array) {
      if (!entry.is_number())
        return Unsupported{"a list with other things than numbers"};
      list.push_back(entry.value<double>().value());
    }
    return list;
  }
  if (const toml::table *table = node.as_table()) {
    Intervals intervals;
    if (read_intervals(*table, "", intervals))
      return intervals;
  }
  return Unsupported{type_in_words(node)};
}

bool is_section(const std::string &name) {
  return std::ranges::any_of(keys(), [&](const Key &key) { return key.name.starts_with(name + "."); });
}

void complain_unknown(CaseReader &reader, const TextPlace &place, const std::string &name, bool sweep) {
  if (is_section(name)) {
    reader.complain(place, fmt::format("'{}' is a section, not a key", name),
                    fmt::format("write [{}] and its keys below", name));
    return;
  }
  const std::string near = nearest_key(name);
  // As it would be written at the same place: below [flow] without the section.
  const bool same_section = section_of(near) == section_of(name);
  const bool below_section = reader.text.text_at(place).starts_with(last_component(name));
  const std::string shown = same_section && below_section ? std::string(last_component(near)) : near;
  reader.meant.push_back(near);
  const char *part = name.ends_with("diameter") && near.ends_with("radius") ? ", half of it" : "";
  reader.complain(place, fmt::format("unknown key '{}'{}", name, sweep ? " in sweep" : ""),
                  near.empty() ? "`capsule keys` lists them all"
                               : fmt::format("did you mean '{}'{}?", shown, part));
}

// What this key has for each capsule, or the only value.
std::vector<Value> values_of_capsules(const Key &key, const Value &value) {
  return key.of_each_capsule ? entries_of(value) : std::vector{value};
}

// A single value or, for a sweep, the values of the list; complains about each that the key cannot take.
std::vector<GivenValue> given_values(CaseReader &reader, std::size_t source, const Key &key, bool sweep,
                                     const toml::node &node) {
  const TextPlace place = place_of(source, node.source().begin);
  std::vector<GivenValue> values;
  if (!sweep)
    values.push_back({to_value(node), place});
  else if (const toml::array *array = node.as_array())
    for (const toml::node &entry : *array)
      values.push_back({to_value(entry), place_of(source, entry.source().begin)});
  if (values.empty())
    reader.complain(place, fmt::format("the sweep of {} must be a list of one or more values", key.name));
  Case scratch;
  std::vector<std::string> seen;
  for (const GivenValue &given : values) {
    std::string text;
    const std::vector<Value> entries = values_of_capsules(key, given.value);
    bool good = !entries.empty();
    if (!good)
      reader.complain(given.place, fmt::format("{} has no value for any capsule", key.name),
                      one_value_or_each);
    for (const Value &value : entries) {
      if (auto complaint = set_value(key, value, scratch)) {
        reader.complain(given.place, complaint->message, complaint->hint);
        good = false;
        break;
      }
      forget_spellings(scratch);
      text += (text.empty() ? "" : ", ") + value_text(get_value(key, scratch).value_or(value));
    }
    if (!good)
      continue;
    if (std::ranges::find(seen, text) != seen.end())
      reader.complain(given.place, fmt::format("{} = {} stands twice in the sweep", key.name, text));
    seen.push_back(text);
  }
  return values;
}

bool can_be_swept(const Key &key) {
  return !std::holds_alternative<Member<std::string>>(key.field) && section_of(key.name) != "fit" &&
         !std::holds_alternative<Member<Words>>(key.field) &&
         !std::holds_alternative<Member<std::vector<double>>>(key.field);
}

// Every value of a file or a --set, as assignments in the order in which they stand.
struct Flattener {
  CaseReader &reader;
  std::size_t source;
  std::vector<Assignment> found;

  void leaf(const std::string &name, bool sweep, const TextPlace &place, const toml::node &node) {
    const Key *key = find_key(name);
    if (key == nullptr)
      complain_unknown(reader, place, name, sweep);
    else if (sweep && !can_be_swept(*key))
      reader.complain(place, fmt::format("'{}' cannot be swept", name));
    else
      found.push_back({key, sweep, place, reader.level, given_values(reader, source, *key, sweep, node)});
  }

  // A misspelt section is one mistake: what it holds is read as if it had the right name.
  std::string section_meant(const TextPlace &place, const std::string &name) {
    std::vector<std::string> known = {"sweep"};
    for (const Key &key : keys())
      known.push_back(section_of(key.name));
    if (std::ranges::find(known, name) != known.end() || find_key(name) != nullptr)
      return name;
    std::string near = nearest_word(name, known);
    if (near.empty())
      return name;
    reader.complain(place, fmt::format("unknown section '{}'", name),
                    fmt::format("did you mean '{}'?", near));
    return near;
  }

  void table(const toml::table &table, const std::string &prefix, bool sweep) {
    for (auto &&[key, node] : table) {
      std::string name = prefix + std::string(key.str());
      const TextPlace place = key_place(reader, source, key);
      if (prefix.empty() && !sweep && node.is_table())
        name = section_meant(place, name);
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

// What --set gives instead of a swept key's values is a sweep of one: its run goes by its name among those of the case.
void collect(CaseReader &reader, std::size_t source, const toml::table &root, bool by_set = false) {
  Flattener flattener{reader, source, {}};
  flattener.table(root, "", false);
  std::ranges::sort(flattener.found, {}, &Assignment::place);
  for (Assignment &assignment : flattener.found) {
    const auto same = std::ranges::find(reader.assignments, assignment.key, &Assignment::key);
    if (same != reader.assignments.end()) {
      if (same->place.source == source)
        reader.complain(
            assignment.place,
            fmt::format("'{}' {}", assignment.key->name,
                        same->sweep == assignment.sweep ? "stands here again" : "is both set and swept"));
      if (by_set && same->sweep) {
        assignment.sweep = true;
        *same = assignment; // in its place in the names of runs
        continue;
      }
      reader.assignments.erase(same);
    }
    reader.assignments.push_back(assignment);
  }
}

// The file to inherit from: the only one, or that of the reader's family.
std::optional<fs::path> inherited_file(CaseReader &reader, const TextPlace &place, const toml::node &node,
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
    const std::string family = case_name_of(files.back());
    if (std::ranges::find(reader.families, family) != reader.families.end())
      reader.complain(place, fmt::format("'{}' stands twice in inherit", family));
    reader.families.push_back(family);
  }
  return files[reader.family];
}

void read_file(CaseReader &reader, const fs::path &file, std::vector<fs::path> &chain);

void follow_inherit(CaseReader &reader, std::size_t source, toml::table &root, const fs::path &file,
                    std::vector<fs::path> &chain) {
  const auto node = root.find("inherit");
  if (node == root.end())
    return;
  const TextPlace place = place_of(source, node->second.source().begin);
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

void read_file(CaseReader &reader, const fs::path &file, std::vector<fs::path> &chain) {
  const auto text = read_text(file);
  const auto *content = std::get_if<std::string>(&text);
  const std::size_t source = reader.text.add_source(file.string(), content ? *content : "");
  if (!content) {
    const auto &complaint = std::get<Complaint>(text);
    reader.complain({source}, complaint.message, complaint.hint);
    reader.complete = false;
    return;
  }
  auto parsed = parse_toml(source, *content);
  if (const auto *error = std::get_if<LocatedError>(&parsed)) {
    reader.text.complain(*error);
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
  ++reader.level;
}

} // namespace

void read_case_file(CaseReader &reader, const fs::path &file) {
  std::vector<fs::path> chain;
  read_file(reader, file, chain);
}

void read_override(CaseReader &reader, const std::string &argument) {
  const std::size_t source = reader.text.add_source("--set", argument);
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos || argument.find('\n') != std::string::npos) {
    reader.complain({source}, "expected key=value");
    return;
  }
  auto parsed = parse_toml(source, argument);
  // What begins as TOML is no bare word.
  const std::size_t begin = argument.find_first_not_of(" \t", equals + 1);
  const bool bare =
      begin == std::string::npos || std::string_view("[{\"'").find(argument[begin]) == std::string_view::npos;
  if (bare && std::holds_alternative<LocatedError>(parsed))
    parsed =
        parse_toml(source, argument.substr(0, equals + 1) + value_text(trimmed(argument.substr(equals + 1))));
  if (const auto *error = std::get_if<LocatedError>(&parsed)) {
    reader.text.complain(*error);
    reader.complete = false;
  } else
    collect(reader, source, std::get<toml::table>(parsed), true);
}

fs::path case_file_of(const fs::path &path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? path / "case.toml" : path;
}

std::string case_name_of(const fs::path &file) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(file, ignored).lexically_normal(); // a link goes by its own name
  std::string directory = whole.parent_path().filename().string();
  if (whole.filename() == "case.toml")
    return directory;
  const bool in_case_directory = fs::exists(whole.parent_path() / "case.toml", ignored);
  return (in_case_directory ? directory + "-" : "") + whole.stem().string();
}

} // namespace capsule

#include "case/case_file.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/case_checks.hpp"
#include "case/chosen.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "case/value_lists.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>

namespace capsule {
namespace {

namespace fs = std::filesystem;

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

// Which of the values that a case gives mean something to one of its runs, by the names of the keys, and what is to be said
// of the others.
struct Usage {
  std::set<std::string> useful;
  std::map<std::string, LocatedError> useless;
};

// One run while it is put together: what was given, where, and what follows.
struct Builder {
  Chosen chosen;
  const Task &task;
  RunInput run;
  std::vector<std::string> derived; // keys whose value follows from the physical ones
  bool physical_ok = true;          // no error in a physical key

  // Section 3 of the paper; values that are given override it.
  void apply_preset() {
    if (const auto *numerics = chosen.given("numerics"))
      set_value(*find_key("numerics"), numerics->value, run.physics);
    if (run.physics.numerics == Numerics::paper) {
      run.physics.mesh = {60, 120, 30};
      run.physics.time.scheme = Scheme::euler;
    }
  }

  void take_values() {
    for (std::size_t i = 0; i < chosen.reader.assignments.size(); ++i) {
      const Assignment &assignment = chosen.reader.assignments[i];
      if (set_value(*assignment.key, chosen.value(i), run.physics))
        stand_in(*assignment.key);
    }
  }

  // The shape that the flow asks for; what other keys mean follows from it.
  void choose_shape() {
    if (run.physics.flow.type == FlowType::extension && !chosen.stands("pore.shape", "flow.type"))
      run.physics.pore.shape = PoreShape::none;
  }

  // Leaves out what means nothing to this run. That is no error where other runs use the value, nor where it is inherited
  // and the key that decides is not.
  void leave_out(Usage &usage) {
    for (const Assignment &assignment : chosen.reader.assignments) {
      const Key &key = *assignment.key;
      const bool of_candidates = task.fit && key.scope.key == "membrane.law";
      if (means_something(key, run.physics) || of_candidates) {
        usage.useful.insert(key.name);
        continue;
      }
      if (chosen.stands(key.name, key.scope.key) && chosen.stands(key.name, key.scope.decided_by))
        usage.useless.try_emplace(key.name, LocatedError{chosen.given(key.name)->place,
                                                         why_meaningless(key, run.physics),
                                                         fmt::format("it belongs to {}", scope_text(key))});
      reset_value(key, run.physics);
    }
  }

  // Any quantity for a physical key that was complained of, so that what follows from it is not missed.
  void stand_in(const Key &key) {
    const auto *measured = std::get_if<Measured>(&key.field);
    if (!measured)
      return;
    measured->member.in(run.physics).si = 1;
    physical_ok = false;
  }

  // The dimensionless values that follow from the physical ones; a value that is given too must agree but for its rounding,
  // and gives way.
  void derive() {
    for (const std::string &name : chosen.reader.meant)
      if (const Key *key = find_key(name); key != nullptr && !chosen.given(name))
        stand_in(*key);
    if (!has_physical(run.physics))
      return;
    const auto is_given = [&](const std::string &name) { return chosen.given(name) != nullptr; };
    for (const PhysicalComplaint &why : physical_complaints(run.physics, task.fit)) {
      if (!std::ranges::all_of(why.keys, is_given)) // one of them is a stand-in
        continue;
      std::vector<std::string> places = why.keys;
      std::ranges::copy(physical_keys(), std::back_inserter(places));
      chosen.complain(places, why.message, "`capsule keys` tells what physical.* means");
      physical_ok = false;
    }
    for (const Derived &value : derived_values(run.physics, task.fit)) {
      derived.push_back(value.key);
      if (physical_ok)
        take_derived(value);
    }
  }

  void take_derived(const Derived &value) {
    const Key &key = *find_key(value.key);
    const std::optional<double> stated = number(key, run.physics);
    if (auto complaint = set_value(key, value.value, run.physics))
      chosen.complain({value.from},
                      fmt::format("{} makes {} = {:.4g}{}, which is out of range", value.from, value.key,
                                  value.value, value.unit),
                      complaint->hint);
    constexpr double rounding = 5e-4; // to four digits
    if (stated && chosen.given(value.key) && std::abs(*stated / value.value - 1) > rounding)
      chosen.complain({value.key},
                      fmt::format("{} = {}, but {} makes it {}", value.key, number_text(*stated), value.from,
                                  number_text(value.value)),
                      "leave one of them out, or let them agree to four digits");
  }

  static std::vector<std::string> physical_keys() {
    std::vector<std::string> names;
    for (const Key &key : keys())
      if (std::holds_alternative<Measured>(key.field))
        names.push_back(key.name);
    return names;
  }

  // Defaults that depend on other keys.
  void complete() {
    Case &c = run.physics;
    if (task.fit && c.fit.unknowns.empty())
      c.fit.unknowns = {"capsule.radius", "flow.capillary_number"};
    if (c.time.scheme == Scheme::euler && !chosen.given("time.step"))
      c.time.step = 2.5e-4;
    if (c.flow.type == FlowType::extension) {
      if (!chosen.stands("capsule.radius", "flow.type"))
        c.capsule.radius = 1;
      if (!chosen.stands("capsule.start_x", "flow.type"))
        c.capsule.start_x = 0;
    } else if (!c.until.by_place() && !c.until.time)
      c.until.x_g = c.pore.shape == PoreShape::two_mouths ? c.pore.exit_x + 4 : 11.84;
  }

  // By a fit.
  bool is_to_be_found(const std::string &key) const {
    const FitSpec &fit = run.physics.fit;
    return task.fit && (std::ranges::find(fit.unknowns, key) != fit.unknowns.end() ||
                        (key == "membrane.law" && !fit.laws.empty()));
  }

  bool has_required() {
    bool all = true;
    for (const Key &key : keys()) {
      const bool scale = key.name == "capsule.radius" && run.physics.flow.type == FlowType::extension;
      if (!key.required || chosen.given(key.name) || scale || is_to_be_found(key.name) ||
          std::ranges::find(derived, key.name) != derived.end())
        continue;
      all = false;
      if (std::ranges::find(chosen.reader.meant, key.name) != chosen.reader.meant.end())
        continue;
      const auto section = chosen.reader.sections.find(section_of(key.name));
      chosen.reader.complain(section == chosen.reader.sections.end() ? TextPlace{} : section->second,
                             fmt::format("missing key '{}'", key.name),
                             key.meaning + ": " + allowed_text(key));
    }
    return all;
  }
};

// One of the cases that a case inherits from, or the case itself.
struct Family {
  CaseReader reader;
  std::vector<RunInput> runs = {};
  Usage usage = {};
};

// A run's directory is called as the run, and no file system takes longer names.
bool has_usable_name(Family &family, const std::string &name) {
  constexpr std::size_t longest = 255; // bytes
  CaseReader &reader = family.reader;
  const std::size_t before = reader.families.empty() ? 0 : reader.families[reader.family].size() + 1;
  if (before + name.size() <= longest)
    return true;
  const auto sweep = std::ranges::find_if(reader.assignments, &Assignment::sweep);
  reader.complain(
      sweep == reader.assignments.end() ? TextPlace{} : sweep->place,
      fmt::format("the sweeps give the runs names of {} bytes; the directory of a run can have {}",
                  before + name.size(), longest),
      "sweep fewer keys at a time, or values of fewer digits; one value for all runs needs no sweep");
  return false;
}

// Lists have a value for each capsule.
bool lists_agree(const Chosen &chosen) {
  const std::size_t capsules = chosen.capsules();
  for (std::size_t i = 0; i < chosen.reader.assignments.size(); ++i) {
    const Assignment &assignment = chosen.reader.assignments[i];
    const GivenValue &given = assignment.values[chosen.selection[i]];
    const std::size_t values =
        assignment.key->of_each_capsule ? entries_of(given.value).size() : std::size_t{1};
    if (values == 0) // the key has complained
      return false;
    if (values == 1 || values == capsules)
      continue;
    chosen.reader.complain(
        given.place,
        fmt::format("{} has {} values for {}", assignment.key->name, values, counted(capsules, "capsule")),
        one_value_or_each);
    return false;
  }
  return true;
}

// A quantity as it was typed, of what a directory may be called by: "5uL_per_min" for "5 µL/min".
std::string directory_text(const Quantity &quantity) {
  if (quantity.written.empty())
    return number_text(quantity.si);
  std::string text;
  for (const char32_t c : decoded(quantity.written))
    if (c == U'/')
      text += "_per_";
    else if (c == U'\u00b5' || c == U'\u03bc')
      text += 'u';
    else if (c < 128 && (std::isalnum(static_cast<int>(c)) != 0 || c == U'.' || c == U'-' || c == U'+'))
      text += static_cast<char>(c);
  return text;
}

// Of all capsules; once, if they have the same.
std::string directory_text(const Key &key, const Case &physics) {
  std::vector<std::string> texts;
  for (const Case *capsule : capsules_of(physics))
    texts.push_back(directory_text(std::get<Measured>(key.field).member.of(*capsule)));
  if (std::ranges::all_of(texts, [&](const std::string &text) { return text == texts.front(); }))
    texts.resize(1);
  return fmt::format("{}", fmt::join(texts, "_"));
}

// By the swept values that make a difference to a capsule.
std::string run_name(const Chosen &chosen, const Case &physics, const Task &task) {
  std::string name;
  const std::vector<const Case *> capsules = capsules_of(physics);
  for (std::size_t i = 0; i < chosen.reader.assignments.size(); ++i) {
    const Assignment &assignment = chosen.reader.assignments[i];
    const Key &key = *assignment.key;
    const auto matters = [&](const Case *capsule) {
      return means_something(key, *capsule) && (task.motion || steady_states_depend_on(key, *capsule));
    };
    if (!assignment.sweep || std::ranges::none_of(capsules, matters))
      continue;
    name += fmt::format("{}{}={}", name.empty() ? "" : ",", short_name(key),
                        std::holds_alternative<Measured>(key.field)
                            ? directory_text(key, physics)
                            : plain_text(assignment.values[chosen.selection[i]].value));
  }
  return name;
}

// All capsules of one run, each as a case of its own; the leading one's has the others behind it.
RunInput build_run(Family &family, const Selection &selection, const Task &task, bool valid) {
  CaseReader &reader = family.reader;
  RunInput run;
  bool good = valid;
  const std::size_t capsules = Chosen{reader, selection}.capsules();
  for (std::size_t k = 0; k < capsules; ++k) {
    Builder builder{{reader, selection, k, true}, task, {}, {}};
    Usage usage;
    builder.apply_preset();
    builder.take_values();
    builder.choose_shape();
    builder.leave_out(usage);
    builder.derive();
    builder.complete();
    const bool whole = builder.has_required() || task.fit; // what a fit misses may be a misspelt unknown
    good = good && whole && builder.physical_ok;
    if (good) {
      check_together(builder.chosen, builder.run.physics, task);
      family.usage.useful.merge(usage.useful);
      family.usage.useless.merge(usage.useless);
    }
    if (k == 0)
      run = std::move(builder.run);
    else
      run.physics.followers.push_back(std::move(builder.run.physics));
  }
  run.name = run_name({reader, selection}, run.physics, task);
  if (good)
    check_capsules({reader, selection}, run.physics, task);
  return run;
}

void build_runs(Family &family, const Task &task) {
  constexpr std::size_t most_runs = 10000;
  CaseReader &reader = family.reader;
  std::size_t count = 1;
  for (const Assignment &assignment : reader.assignments)
    count = std::min(count * assignment.values.size(), most_runs + 1);
  if (count > most_runs) {
    reader.complain({}, fmt::format("the sweeps make more than {} runs", most_runs));
    return;
  }
  const bool valid = reader.text.errors.empty();
  std::set<std::string> names;
  for (const Selection &selection : all_selections(reader.assignments)) {
    if (!lists_agree({reader, selection}))
      return;
    RunInput run = build_run(family, selection, task, valid);
    if (!has_usable_name(family, run.name))
      return;
    // Swept values that mean nothing to a run would only make it again.
    if (names.insert(run.name).second)
      family.runs.push_back(std::move(run));
  }
}

// `resolved`: what an earlier version wrote of keys that mean nothing is passed over.
CaseInput read(const fs::path &path, const std::vector<std::string> &overrides, const Task &task,
               bool resolved) {
  CaseInput input;
  input.file = case_file_of(path);
  input.name = case_name_of(input.file);
  std::vector<Family> families;
  std::set<std::string> useful;
  do {
    Family &family = families.emplace_back();
    family.reader.family = families.size() - 1;
    read_case_file(family.reader, input.file);
    for (const std::string &argument : overrides)
      read_override(family.reader, argument);
    if (family.reader.complete)
      build_runs(family, task);
    useful.merge(family.usage.useful);
  } while (families.size() < families.front().reader.families.size());
  for (Family &family : families) {
    CaseReader &reader = family.reader;
    for (const auto &[key, error] : family.usage.useless)
      if (!resolved && !useful.contains(key))
        reader.text.complain(error);
    reader.text.throw_if_any();
    for (RunInput &run : family.runs) {
      if (!reader.families.empty())
        run.name = reader.families[reader.family] + (run.name.empty() ? "" : ",") + run.name;
      input.runs.push_back(std::move(run));
    }
  }
  return input;
}

// What a fit would find for this case, if it has a table [fit] and everything else that a fit needs.
std::string found_by_a_fit(const fs::path &path, const std::vector<std::string> &overrides) {
  CaseReader reader;
  read_case_file(reader, case_file_of(path));
  if (!reader.sections.contains("fit"))
    return "";
  try {
    const CaseInput input = read(path, overrides, {.motion = false, .name = "fit", .fit = true}, false);
    const FitSpec &fit = input.runs.at(0).physics.fit;
    return fmt::format("{}{}", fmt::join(fit.unknowns, ", "), fit.laws.empty() ? "" : " and the law");
  } catch (const InputError &) {
    return "";
  }
}

} // namespace

CaseInput read_case(const fs::path &path, const std::vector<std::string> &overrides, const Task &task) {
  try {
    return read(path, overrides, task, false);
  } catch (const InputError &) {
    const std::string found = task.fit ? "" : found_by_a_fit(path, overrides);
    if (found.empty())
      throw;
    throw InputError(fmt::format("{}:1:1: error: this case is one for `capsule fit`, which finds {}\n"
                                 "give values instead of [fit] to compute it\n",
                                 case_file_of(path).string(), found));
  }
}

Case read_resolved(const fs::path &file, const Task &task) {
  return read(file, {}, task, true).runs.at(0).physics;
}

} // namespace capsule

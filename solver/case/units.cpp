#include "case/units.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <string_view>
#include <vector>

namespace capsule {
namespace {

// In SI units factor 10^decimal 60^sixty. Decimal units have the factor 1 and lose no digit.
struct Unit {
  std::string_view symbol;
  int decimal, sixty;
  Dimension of;
  double factor = 1;
};
constexpr std::array units = {Unit{"m", 0, 0, dimension::length},
                              Unit{"micron", -6, 0, dimension::length},
                              Unit{"g", -3, 0, {0, 1, 0}},
                              Unit{"s", 0, 0, dimension::time},
                              Unit{"sec", 0, 0, dimension::time},
                              Unit{"min", 0, 1, dimension::time},
                              Unit{"minute", 0, 1, dimension::time},
                              Unit{"h", 0, 2, dimension::time},
                              Unit{"hr", 0, 2, dimension::time},
                              Unit{"hour", 0, 2, dimension::time},
                              Unit{"l", -3, 0, {3, 0, 0}},
                              Unit{"L", -3, 0, {3, 0, 0}},
                              Unit{"cc", -6, 0, {3, 0, 0}},
                              Unit{"N", 0, 0, {1, 1, -2}},
                              Unit{"dyn", -5, 0, {1, 1, -2}},
                              Unit{"Pa", 0, 0, dimension::pressure},
                              Unit{"bar", 5, 0, dimension::pressure},
                              Unit{"atm", 0, 0, dimension::pressure, 101325},
                              Unit{"psi", 0, 0, dimension::pressure, 6894.757293168},
                              Unit{"mmHg", 0, 0, dimension::pressure, 133.322387415},
                              Unit{"Torr", 0, 0, dimension::pressure, 101325.0 / 760},
                              Unit{"mmH2O", 0, 0, dimension::pressure, 9.80665},
                              Unit{"cmH2O", 0, 0, dimension::pressure, 98.0665},
                              Unit{"P", -1, 0, dimension::viscosity},
                              Unit{"ohm", 0, 0, dimension::resistance},
                              Unit{"Ohm", 0, 0, dimension::resistance},
                              Unit{"\u03a9", 0, 0, dimension::resistance}, // the Greek letter
                              Unit{"\u2126", 0, 0, dimension::resistance}, // the ohm sign
                              Unit{"J", 0, 0, dimension::energy},
                              Unit{"erg", -7, 0, dimension::energy},
                              Unit{"kT", -23, 0, dimension::energy, 1.380649 * 298.15}}; // at 25 C

// Beginning with those that a mistyped one most likely stands for.
struct Prefix {
  std::string_view symbol;
  int decimal;
};
constexpr std::array<Prefix, 14> prefixes = {{{"", 0},
                                              {"u", -6},
                                              {"m", -3},
                                              {"n", -9},
                                              {"p", -12},
                                              {"f", -15},
                                              {"a", -18},
                                              {"c", -2},
                                              {"d", -1},
                                              {"h", 2},
                                              {"z", -21},
                                              {"k", 3},
                                              {"M", 6},
                                              {"G", 9}}};

// What has a name: its SI unit, an example, and other units that it is often given in.
struct Kind {
  Dimension of;
  std::string name, si, example;
  std::vector<std::string> others;
};

const std::vector<Kind> &kinds() {
  static const std::vector<Kind> table = {
      {dimension::length, "a length", "m", "5 um", {"µm", "micron", "nm", "mm", "cm", "m"}},
      {dimension::viscosity, "a viscosity", "Pa.s", "1 mPa.s", {"mPa s", "Pa.s", "cP", "P", "g/(cm.s)"}},
      {dimension::flow_rate, "a flow rate", "m3/s", "0.1 nl/s", {"pl/s", "ul/min", "ml/h", "um^3/s", "m3/s"}},
      {dimension::pressure,
       "a pressure",
       "Pa",
       "20 Pa",
       {"kPa", "mbar", "mmHg", "cmH2O", "psi", "N/m2", "dyn/cm2"}},
      {dimension::tension, "a tension", "N/m", "0.02 mN/m", {"uN/m", "pN/um", "dyn/cm", "N/m", "mJ/m2"}},
      {dimension::surface_viscosity,
       "a surface viscosity",
       "N.s/m",
       "0.5 uN.s/m",
       {"uN s/m", "N.s/m", "dyn.s/cm", "kg/s"}},
      {dimension::density, "a density", "kg/m3", "1 g/cm3", {"kg/m3", "g/ml", "kg/l"}},
      {dimension::energy, "an energy", "J", "0.5 aJ", {"fJ", "J", "kT", "erg", "pN.um", "N.m"}},
      {dimension::velocity, "a velocity", "m/s", "1 mm/s", {"um/s", "m/s"}},
      {dimension::time, "a time", "s", "1 s", {"ms", "min", "h"}},
      {dimension::resistance, "a resistance", "ohm", "10 kohm", {"ohm", "Mohm"}},
      {dimension::resistivity, "a resistivity", "ohm.m", "0.65 ohm.m", {"ohm m", "ohm.cm"}}};
  return table;
}

const Kind *find_kind(const Dimension &of) {
  const auto found = std::ranges::find(kinds(), of, &Kind::of);
  return found == kinds().end() ? nullptr : &*found;
}

// A unit with its prefix: "um" is 1e-6 m. The bare unit comes first: "min" is a minute, "m" a metre.
std::optional<Unit> find_unit(std::string_view name) {
  for (const Prefix &prefix : prefixes)
    for (const Unit &unit : units)
      if (name.starts_with(prefix.symbol) && name.substr(prefix.symbol.size()) == unit.symbol)
        return Unit{name, prefix.decimal + unit.decimal, unit.sixty, unit.of, unit.factor};
  return std::nullopt;
}

// The ASCII spelling: "µm³·s⁻¹" is "um3.s-1". What has none stays as it is.
std::string in_ascii(std::string_view text) {
  constexpr std::array<std::pair<std::u32string_view, char>, 15> spellings = {
      {{U"\u00b5\u03bc", 'u'}, // the micro sign and the Greek letter
       {U"*\u00b7\u00d7\u22c5", '.'},
       {U"\u00a0\u2009\u202f", ' '}, // spaces of typesetters
       {U"\u207b\u2212", '-'},
       {U"\u2070", '0'},
       {U"\u00b9", '1'},
       {U"\u00b2", '2'},
       {U"\u00b3", '3'},
       {U"\u2074", '4'},
       {U"\u2075", '5'},
       {U"\u2076", '6'},
       {U"\u2077", '7'},
       {U"\u2078", '8'},
       {U"\u2079", '9'},
       {U"\u2044\u2215", '/'}}};
  std::u32string ascii;
  for (const char32_t c : decoded(text)) {
    const auto *const known = std::ranges::find_if(
        spellings, [c](const auto &spelling) { return spelling.first.find(c) != std::u32string_view::npos; });
    ascii += known == spellings.end() ? c : static_cast<char32_t>(known->second);
  }
  return encoded(ascii);
}

constexpr const char *exponent_begins = "^-0123456789";

// The product of units from left to right.
struct UnitReader {
  std::string_view rest;
  int side = 1; // -1 behind a slash
  Unit product{"", 0, 0, {}};

  bool take(char c) {
    const bool here = rest.starts_with(c);
    rest.remove_prefix(here ? 1 : 0);
    return here;
  }
  bool take_per() {
    constexpr std::string_view per = "per ";
    const bool here = rest.starts_with(per);
    rest.remove_prefix(here ? per.size() : 0);
    return here;
  }
  void skip_spaces() { rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size())); }

  // Whether a power of a unit stands here. The symbol may end in a digit's place only where such a unit is known: "cmH2O".
  bool power() {
    const std::string_view word = this->word();
    for (std::size_t letters = word.size(); letters > 0; --letters) {
      const std::optional<Unit> unit = find_unit(word.substr(0, letters));
      const std::optional<int> exponent = read_exponent(word.substr(letters));
      if (unit && exponent) {
        multiply(*unit, side * *exponent);
        rest.remove_prefix(word.size());
        return true;
      }
    }
    return false;
  }

  static std::optional<int> read_exponent(std::string_view text) {
    constexpr int largest = 9;
    if (text.empty())
      return 1;
    if (text.starts_with('^'))
      text.remove_prefix(1);
    int exponent = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
    const bool whole = error == std::errc() && last == text.data() + text.size();
    return whole && exponent >= -largest && exponent <= largest ? std::optional(exponent) : std::nullopt;
  }

  void multiply(const Unit &unit, int exponent) {
    product.decimal += exponent * unit.decimal;
    product.sixty += exponent * unit.sixty;
    product.factor *= std::pow(unit.factor, exponent);
    product.of.length += exponent * unit.of.length;
    product.of.mass += exponent * unit.of.mass;
    product.of.time += exponent * unit.of.time;
    product.of.current += exponent * unit.of.current;
  }

  // Whether all of it is units; if not, the rest begins with what is none.
  bool units() {
    for (;;) {
      skip_spaces();
      if (!power())
        return false;
      skip_spaces();
      if (rest.empty())
        return true;
      if (take('/') || take_per()) {
        side = -1;
        skip_spaces();
        if (rest.starts_with('(') && rest.ends_with(')'))
          rest = rest.substr(1, rest.size() - 2);
      } else
        take('.');
    }
  }

  std::string_view word() const { return rest.substr(0, rest.find_first_of(" ./()")); }
};

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// Whether a suggested text may stand for a typed one: a word's first letter may be its prefix, and a suggestion must not
// change the magnitude. Capitals are mixed up, and y, mu and mc are typed for the Greek letter.
bool same_first_letters(std::string_view typed, std::string_view suggested) {
  const auto first_letters = [](std::string_view text, bool typed_by_hand) {
    std::string letters;
    bool inside = false;
    for (std::size_t k = 0; k < text.size(); ++k) {
      const bool letter = std::isalpha(static_cast<unsigned char>(text[k])) != 0;
      const char first = lower(text[k]), second = k + 1 < text.size() ? lower(text[k + 1]) : ' ';
      if (letter && !inside)
        letters +=
            first == 'y' || (typed_by_hand && first == 'm' && (second == 'u' || second == 'c')) ? 'u' : first;
      inside = letter;
    }
    return letters;
  };
  const std::string of_typed = first_letters(typed, true), of_suggested = first_letters(suggested, false);
  // "mPas" lacks the dot of "mPa.s".
  return of_suggested.starts_with(of_typed);
}

// The units that a text with a wrong word in it, in ASCII, most likely meant: usual ones, or others in the word's place.
std::string nearest_units(const std::string &text, std::string_view wrong, const Dimension &wanted) {
  constexpr std::size_t longest = 30; // longer than any that is near to one
  const Kind *kind = find_kind(wanted);
  if (kind == nullptr || text.size() > longest)
    return "";
  std::vector<std::string> candidates = kind->others;
  candidates.insert(candidates.begin(), kind->example.substr(kind->example.find(' ') + 1));
  const std::size_t letters = std::min(wrong.find_first_of(exponent_begins), wrong.size());
  for (const Prefix &prefix : prefixes)
    for (const Unit &unit : units) {
      const auto offset = static_cast<std::size_t>(wrong.data() - text.data());
      for (const std::size_t replaced : {letters, wrong.size()}) { // without its exponent, or all of the word
        std::string candidate = text;
        candidate.replace(offset, replaced, fmt::format("{}{}", prefix.symbol, unit.symbol));
        UnitReader reader{candidate};
        if (reader.units() && reader.product.of == wanted)
          candidates.push_back(std::move(candidate));
      }
    }
  std::erase_if(candidates,
                [&](const std::string &candidate) { return !same_first_letters(text, candidate); });
  return nearest_word(text, candidates);
}

// number factor 10^decimal 60^sixty, the decimal part as if the digits had been typed so: 5 and -6 are the double 5e-6.
// Zero or infinite where no double is near.
double scaled(double number, const Unit &unit) {
  const std::string text = number_text(number);
  const std::size_t e = text.find('e');
  const int exponent = unit.decimal + (e == std::string::npos ? 0 : std::stoi(text.substr(e + 1)));
  const double decimal = std::strtod(fmt::format("{}e{}", text.substr(0, e), exponent).c_str(), nullptr);
  const double whole = decimal * unit.factor;
  const double sixties = std::pow(60, std::abs(unit.sixty));
  return unit.sixty < 0 ? whole / sixties : whole * sixties;
}

// The same quantity with its number in the notation that is read here, if it is in another: "5e-6 m" for "5d-6 m".
std::string respelled_quantity(const std::string &text) {
  constexpr std::size_t longest = 40;
  for (std::size_t digits = std::min(text.size(), longest); digits > 0; --digits) {
    const std::string number = respelled_number(text.substr(0, digits));
    const bool ends_here = digits == text.size() ||
                           std::string_view("0123456789.,").find(text[digits]) == std::string_view::npos;
    if (!number.empty() && ends_here)
      return number == text.substr(0, digits) ? "" : number + text.substr(digits);
  }
  return "";
}

std::string power_text(const char *symbol, int exponent) {
  return exponent == 0 ? "" : fmt::format(".{}{}", symbol, exponent == 1 ? "" : std::to_string(exponent));
}

std::string name_of(const Dimension &of) {
  const Kind *kind = find_kind(of);
  return kind                ? kind->name
         : of == Dimension{} ? "a number without dimension"
                             : fmt::format("a quantity in {}", unit_text(of));
}

} // namespace

std::variant<Quantity, NoQuantity> read_quantity(const std::string &typed, const Dimension &wanted) {
  const std::string text = trimmed(typed);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc())
    return NoQuantity{fmt::format("'{}' is no number with a unit", text), respelled_quantity(text)};
  const auto digits = static_cast<std::size_t>(end - text.data());
  const std::string unit_part = trimmed(in_ascii(std::string_view(text).substr(digits)));
  if (unit_part.empty())
    return NoQuantity{fmt::format("'{}' has no unit", text), ""};
  if (text[digits] == ',')
    return NoQuantity{fmt::format("'{}' has a comma in its number", text), respelled_quantity(text)};
  if (const std::string meant = respelled_quantity(text);
      !meant.empty() && std::tolower(static_cast<unsigned char>(text[digits])) == 'd')
    return NoQuantity{fmt::format("'{}' has a d in its number", text), meant};
  if (unit_part.substr(std::min(unit_part.find_first_not_of(".x "), unit_part.size())).starts_with("10"))
    return NoQuantity{fmt::format("'{}': a power of ten is written as in 5e-6", text), ""};
  UnitReader reader{unit_part};
  if (!reader.units()) {
    const std::string_view word = reader.word();
    const std::string near = word.empty() ? "" : nearest_units(unit_part, word, wanted);
    return NoQuantity{word.empty() ? fmt::format("a unit is missing in '{}'", text)
                                   : fmt::format("unknown unit '{}' in '{}'", word, text),
                      near.empty() ? "" : fmt::format("{} {}", text.substr(0, digits), near)};
  }
  if (reader.product.of != wanted)
    return NoQuantity{fmt::format("'{}' is {}, not {}", text, name_of(reader.product.of), name_of(wanted)),
                      ""};
  const double si = scaled(number, reader.product);
  if (!(number > 0))
    return NoQuantity{fmt::format("'{}' is not above 0", text), ""};
  if (!std::isnormal(si))
    return NoQuantity{fmt::format("'{}' is beyond what numbers can hold", text), ""};
  return Quantity{si, text};
}

std::string unit_text(const Dimension &of) {
  if (const Kind *kind = find_kind(of))
    return kind->si;
  // The kilogram is a gram with a prefix.
  return (power_text("m", of.length) + power_text("kg", of.mass) + power_text("s", of.time) +
          power_text("A", of.current))
      .substr(1);
}

TypedUnit typed_unit(const Quantity &quantity, const Dimension &of) {
  char *unit = nullptr;
  const double typed = std::strtod(quantity.written.c_str(), &unit); // 0 where nothing was typed
  return typed > 0 ? TypedUnit{trimmed(unit), quantity.si / typed} : TypedUnit{unit_text(of), 1};
}

std::string quantity_text(const Quantity &quantity, const Dimension &of) {
  return quantity.written.empty() ? fmt::format("{} {}", number_text(quantity.si), unit_text(of))
                                  : quantity.written;
}

std::string examples_text(const Dimension &of) {
  const Kind &kind = *find_kind(of);
  return fmt::format("{} such as '{}' (or {})", kind.name, kind.example, fmt::join(kind.others, ", "));
}

} // namespace capsule

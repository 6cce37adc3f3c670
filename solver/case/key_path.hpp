#pragma once
// The number behind a key of a case, and the way of a key from one number to another. A key that is given by its name
// has a real number for its value. Throws nothing.
#include "case/case.hpp"
#include <optional>
#include <string>

namespace capsule {

struct Key;

// The value of a key; none if it is not a number, or not given.
std::optional<double> number(const Key &key, const Case &input);

double number(const std::string &key, const Case &input);
// The case with another number behind a key, whatever its range.
Case with_number(Case input, const std::string &key, double value);

// What changes of a key's value are measured by: the value itself, and for the inflation 1 + alpha_p, the stretch.
double natural_size(const std::string &key, double value);

// Whether a fold at this value, on a way that begins at another one, is met as the flow grows: it is the critical flow rate.
bool is_critical(const std::string &key, double from, double fold);

// A key of a case on its way from the value that it has there, at part 0, to another one, at part 1; further, too.
// Between positive values the eighth root changes evenly, which suits values of any magnitude, and zero: a way from
// 1e-2 to 1e-5, or to 0, has no part that needs much shorter steps than the others. The inflation changes evenly.
class KeyPath {
public:
  KeyPath(std::string key, const Case &from, double to);
  const std::string &key() const { return key_; }
  bool needed() const { return from_ != to_; }
  double value(double part) const;
  double part(double value) const; // its inverse
  double slope(double part) const; // d value/d part
  Case at(double part) const;
  std::string text(double part) const; // "flow.capillary_number = 0.05", in physical units "... (20 nl/s)"
  // The same of a fold. One that is met as the flow grows has a name: "flow.capillary_number = 0.05 +- 2e-7 (20 nl/s),
  // the critical flow rate", without physical units "the critical capillary number". The value's error may be unknown.
  std::string fold_text(double part, std::optional<double> error = {}) const;

private:
  bool is_straight() const { return from_ < 0 || to_ < 0 || natural_size(key_, 0) > 0; }
  std::string text(double part, std::optional<double> error) const;
  double even(double value) const; // what changes evenly: the value or its eighth root
  double root(double part) const;

  std::string key_;
  Case start_;
  double from_, to_;
};

} // namespace capsule

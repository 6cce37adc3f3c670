#pragma once
// Failures. Each says what happened, where, and what to try.
#include <stdexcept>
#include <string>

namespace capsule {

// Bad input or usage (exit code 2). The text is complete: file, line, column, caret.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file cannot be read or written (exit code 4).
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The computation cannot go on (exit code 3). `kind` is one word for scripts: "touching", "folded", "wrinkled",
// "unresolved", "volume", "step", "not-a-number", "self-contact", "exit", "fold"; or "unbounded", which ends a run but is
// not a failure of it. `advice` says what to try.
struct NumericsFailure : std::runtime_error {
  std::string kind;
  std::string advice;
  NumericsFailure(std::string kind_, const std::string &what, std::string advice_)
      : std::runtime_error(what), kind(std::move(kind_)), advice(std::move(advice_)) {}
};

} // namespace capsule

#pragma once
// Failures. Each says what happened, where, and what to try.
#include <cstddef>
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

// Why a computation cannot go on, one word each, which scripts read too; paper-notes/files.md says what they mean. `burst`
// and `unbounded` end a march and are no failures of it.
namespace failure_kind {
inline constexpr const char *touching = "touching", *self_contact = "self-contact", *folded = "folded",
                            *wrinkled = "wrinkled", *exit = "exit", *volume = "volume", *step = "step",
                            *unresolved = "unresolved", *not_a_number = "not-a-number", *fold = "fold",
                            *softening = "softening", *burst = "burst", *unbounded = "unbounded";
}

// The computation cannot go on (exit code 3). `kind` is one of these words, `advice` says what to try.
struct NumericsFailure : std::runtime_error {
  std::string kind;
  std::string advice;
  std::size_t capsule = 0; // number of the capsule; 0 where there is one or it concerns all
  NumericsFailure(std::string kind_, const std::string &what, std::string advice_)
      : std::runtime_error(what), kind(std::move(kind_)), advice(std::move(advice_)) {}
};

} // namespace capsule

#pragma once
// What the program's exit code says.
namespace capsule {

enum class ExitCode {
  done = 0,
  differs = 1,         // a comparison, from what is recorded
  bad_input = 2,       // or usage
  numerics_failed = 3, // or what nobody foresaw
  files_failed = 4,
  interrupted = 130
};

} // namespace capsule

#pragma once
// The commands that compare a case with what is expected of it. They throw InputError, FileError and NumericsFailure.
#include "program/computation.hpp"
#include "program/exit_code.hpp"

namespace capsule {

// Computes what is missing and compares with expected values.
ExitCode check_case(const Arguments &arguments);
// The same for all cases that the table of published values speaks of; writes the ledger.
ExitCode write_ledger(const Arguments &arguments);
} // namespace capsule

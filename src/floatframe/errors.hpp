#pragma once
// What functions throw. InputError: every error of an input, each with its place; RunError: what
// was asked for cannot be started; OutputError: a file cannot be written. All are std::exception.
// Steps do not throw: they return a StepReport.
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/output_error.hpp"
#include "floatframe/loops/run_error.hpp"

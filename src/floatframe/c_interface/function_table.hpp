#pragma once
// The functions of floatframe.h as a table, for a program that holds several copies of them, one
// for each instruction set: the binaries of FMUs. All but `floatframe_open`, which stands on the
// readers of model files.
#include "floatframe/c_interface/floatframe.h"

// clang-format off
#define FLOATFRAME_FUNCTIONS(F)                                                                  \
  F(interface_version) F(version) F(open_memory) F(close) F(message) F(model_name)               \
  F(fingerprint) F(set_option) F(start) F(reset) F(note_count) F(note) F(time) F(step_size)      \
  F(step) F(step_by) F(step_count) F(substep_count) F(iteration_count) F(input_count)            \
  F(input_name) F(input_unit) F(input_initial) F(input_low) F(input_high) F(find_input)          \
  F(input) F(set_input) F(output_count) F(output_name) F(output_unit) F(find_output) F(output)   \
  F(outputs) F(parameter_count) F(parameter_name) F(parameter_unit) F(parameter_about)           \
  F(find_parameter) F(parameter) F(set_parameter) F(set_parameters) F(save) F(saved) F(restore)
// clang-format on

namespace floatframe {
/// The type of a pointer to the function, which tests may replace by one without `noexcept`.
template <class Result, class... Args>
auto pointer_to(Result (*)(Args...) noexcept) -> Result (*)(Args...);
}  // namespace floatframe

/// `floatframe_step` is `step`, and so on.
struct floatframe_functions {
#define FLOATFRAME_MEMBER(name) decltype(floatframe::pointer_to(&floatframe_##name)) name;
  FLOATFRAME_FUNCTIONS(FLOATFRAME_MEMBER)
#undef FLOATFRAME_MEMBER
};

/// Never changes. Not a function of the library: programs call those of floatframe.h.
#if defined(__GNUC__) && !defined(_WIN32)
extern "C" __attribute__((visibility("hidden")))
#else
extern "C"
#endif
const floatframe_functions*
floatframe_function_table() noexcept;

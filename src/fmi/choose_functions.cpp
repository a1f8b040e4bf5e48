// An FMU for x86-64 holds the runtime twice, compiled for every processor and for those with AVX2
// and FMA (x86-64-v3), as the library is: the steps are the same, their last digits differ.
#include "fmi/functions.hpp"

#if FLOATFRAME_FMU_V3
/// `floatframe_function_table` of the other copy, which has this name in the binary.
extern "C" const floatframe_functions* floatframe_function_table_v3() noexcept;
#endif

namespace floatframe::fmi {
namespace {

/// What x86-64-v3 means is what the dynamic linker has, which chooses the copy of the library: FMUs
/// and programs step alike on one processor.
const floatframe_functions& chosen() noexcept {
#if FLOATFRAME_FMU_V3
  if (__builtin_cpu_supports("x86-64-v3")) return *floatframe_function_table_v3();
#endif
  return *floatframe_function_table();
}

}  // namespace

const floatframe_functions& functions() noexcept {
  static const floatframe_functions& table = chosen();
  return table;
}

}  // namespace floatframe::fmi

// In the binary of an FMU: the functions of the simulation for the processor it runs on. Both
// copies stand in one file, each with all of its names hidden but that of its table.
#include "fmi/functions.hpp"

#ifdef FLOATFRAME_FMU_TWO_COPIES
extern "C" const floatframe_functions* floatframe_function_table_v3() noexcept;
#endif

namespace floatframe::fmi {

const floatframe_functions& functions() noexcept {
#ifdef FLOATFRAME_FMU_TWO_COPIES
  static const bool is_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (is_v3) return *floatframe_function_table_v3();
#endif
  return *floatframe_function_table();
}

}  // namespace floatframe::fmi

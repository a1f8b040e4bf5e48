#include "floatframe/c_interface/function_table.hpp"

const floatframe_functions* floatframe_function_table() noexcept {
  static constexpr floatframe_functions table{
#define FLOATFRAME_ENTRY(name) &floatframe_##name,
      FLOATFRAME_FUNCTIONS(FLOATFRAME_ENTRY)
#undef FLOATFRAME_ENTRY
  };
  return &table;
}

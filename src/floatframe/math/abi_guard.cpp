#include "floatframe/math/abi_guard.hpp"

namespace floatframe::abi {

template <int max_align_bytes, int max_static_align_bytes, long stack_allocation_limit,
          int malloc_already_aligned, int index_bytes, int row_major, int eigen_world,
          int eigen_major, int eigen_minor>
void compile_with_the_settings_of_the_CMake_package() noexcept {}

template void compile_with_the_settings_of_the_CMake_package<FLOATFRAME_ABI_SETTINGS>() noexcept;

}  // namespace floatframe::abi

#pragma once
// Programs compiled with other settings of Eigen than the library allocate and free its matrices
// differently, and corrupt memory. Every file that includes a header of Floatframe refers to a
// function whose name contains its compile settings; the library defines the one for its settings,
// so that other programs do not link:
//   undefined reference to `floatframe::abi::compile_with_the_settings_of_the_CMake_package<16, 16,
//   131072, 1, 8, 0, 3, 4, 0>()'
// with EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES, EIGEN_STACK_ALLOCATION_LIMIT,
// EIGEN_MALLOC_ALREADY_ALIGNED, the bytes of EIGEN_DEFAULT_DENSE_INDEX_TYPE, whether matrices are
// row-major (EIGEN_DEFAULT_TO_ROW_MAJOR) and the version of Eigen, as this file saw them.
#include <Eigen/Core>

namespace floatframe::abi {

template <int max_align_bytes, int max_static_align_bytes, long stack_allocation_limit,
          int malloc_already_aligned, int index_bytes, int row_major, int eigen_world,
          int eigen_major, int eigen_minor>
void compile_with_the_settings_of_the_CMake_package() noexcept;

#define FLOATFRAME_ABI_SETTINGS                                                      \
  EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES, EIGEN_STACK_ALLOCATION_LIMIT, \
      EIGEN_MALLOC_ALREADY_ALIGNED, static_cast<int>(sizeof(Eigen::Index)),          \
      static_cast<int>(EIGEN_DEFAULT_MATRIX_STORAGE_ORDER_OPTION) & Eigen::RowMajor, \
      EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION

// In every object file, also in optimised ones and with unused sections dropped: one pointer that
// is never read. An inline variable would not work: of several with different settings the linker
// takes one.
#if defined(__has_cpp_attribute) && __has_cpp_attribute(gnu::retain)
[[gnu::used, gnu::retain]]
#else
[[gnu::used]]
#endif
static void (*const settings_of_this_file)() noexcept =
    &compile_with_the_settings_of_the_CMake_package<FLOATFRAME_ABI_SETTINGS>;

}  // namespace floatframe::abi

// MATLAB files are read as they are written; damaged ones are refused. Those of SciPy are read in
// python/tests.
#include "floatframe/formats/matlab/mat_read.hpp"

#include <gtest/gtest.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/body_file/npy.hpp"

namespace floatframe {
namespace {

const std::vector<std::string> mat_names{"Kraft [N·m]", "", "𝛼 and β"};

std::string example_mat() {
  return mat_file({{"A", MatX{{1.5, -2.0, 3.0}, {4.0, 5.0, 1e300}}},
                   {"names", mat_names},
                   {"none", MatX(0, 3)}});
}

TEST(MatRead, IsWhatWasWritten) {
  const std::vector<MatVariable> all = read_mat(example_mat());
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "A");
  EXPECT_EQ(std::get<MatX>(all[0].value), (MatX{{1.5, -2.0, 3.0}, {4.0, 5.0, 1e300}}));
  EXPECT_EQ(std::get<std::vector<std::string>>(all[1].value), mat_names);
  EXPECT_EQ(std::get<MatX>(all[2].value).cols(), 3);
}

TEST(MatRead, DamagedFilesAreRefused) {
  const std::string whole = example_mat();
  int refused = 0;
  for (std::size_t n = 0; n < whole.size(); ++n) {
    try {
      read_mat(whole.substr(0, n));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, static_cast<int>(whole.size()) - 10);  // but between variables
  for (std::size_t n = 128; n < whole.size(); ++n) {
    std::string changed = whole;
    changed[n] = static_cast<char>(changed[n] ^ 0x55);
    try {
      read_mat(changed);
    } catch (const InputError&) {
    }
  }
}

TEST(MatRead, TextsOfNumpyAreWhatWasWritten) {
  EXPECT_EQ(read_npy_texts(npy_texts(mat_names)), mat_names);
  EXPECT_THROW(read_npy_texts(npy_bytes({{1}, std::vector<double>{1.0}})), InputError);
}

}  // namespace
}  // namespace floatframe

#pragma once
// Matrices of Nastran's OUTPUT4, as text or binary (numbers of four bytes, in either order), stored
// by whole columns or by strings of them.
#include <Eigen/SparseCore>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

struct Op4Matrix {
  std::string name;  ///< upper case
  int rows = 0, columns = 0;
  int form = 0;  ///< 1: square, 2: rectangular, 6: symmetric
  int type = 0;  ///< 1, 2: real, single and double; 3, 4: complex
  std::vector<Eigen::Triplet<double>> entries;

  bool real_square() const { return (form == 1 || form == 6) && type <= 2 && rows == columns; }
};

bool looks_like_op4(std::string_view beginning);
/// All matrices of a file; entries of those that are real and square only. Throws InputError.
std::vector<Op4Matrix> read_op4_matrices(const std::string& bytes, const std::string& file);

}  // namespace floatframe

#pragma once
// Matrices of Nastran's OUTPUT4, as text or binary (numbers of four bytes, in either order), stored
// by whole columns or by strings of them.
//
// Superelements in matrices of Nastran's OUTPUT4 (.op4): stiffness KXX, KAA or KAAX, and mass and
// viscous damping that begin with M and B. Nodes come from Nastran cards next to the file. Rows are
// the degrees of freedom of EXTRN, else of ASET and QSET, else all, in ascending order; or those of
// a CSV "node,dir".
#include <Eigen/SparseCore>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formats/fe_file.hpp"

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

FeModel read_op4(const std::filesystem::path& file, const FeReadOptions& options);

}  // namespace floatframe

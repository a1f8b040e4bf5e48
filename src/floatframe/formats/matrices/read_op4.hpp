#pragma once
// Superelements in matrices of Nastran's OUTPUT4 (.op4): stiffness KXX, KAA or KAAX, and mass and
// viscous damping that begin with M and B. Nodes come from Nastran cards beside the file. Rows are
// the degrees of freedom of EXTRN, else of ASET and QSET, else all, in ascending order; or those of
// a CSV "node,dir".
#include <string_view>

#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

FeModel read_op4(const std::filesystem::path& file, const FeReadOptions& options);

}  // namespace floatframe

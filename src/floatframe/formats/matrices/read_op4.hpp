#pragma once
// Superelements and other reduced models in matrices of Nastran's OUTPUT4 (.op4): of all matrices
// of the file the stiffness KXX, KAA or KAAX, the mass and the viscous damping that begin with M
// and B and have its size. Nodes come from Nastran cards beside the file, of EXTSEOUT arm.pch or
// arm.asm; the rows are the degrees of freedom of EXTRN, else of ASET and QSET, else all six of
// each node and one of each scalar point, in ascending order; or those of a CSV "node,dir".
#include <string_view>

#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

FeModel read_op4(const std::filesystem::path& file, const FeReadOptions& options);

}  // namespace floatframe

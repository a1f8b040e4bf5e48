#pragma once
// MATLAB files of level 5 (versions 5 to 7), read: real matrices of numbers, texts and cells of
// texts; variables of other classes are left out. mat_file.hpp has the layout; what MATLAB and
// SciPy write besides is numbers in the smallest type that holds them, elements of at most 4 bytes
// within 8, and variables that are not compressed.
#include <string_view>

#include "floatframe/formats/matlab/mat_file.hpp"

namespace floatframe {

/// Throws InputError with one sentence, without a location: another format or version, damaged,
/// too large.
std::vector<MatVariable> read_mat(std::string_view bytes);

}  // namespace floatframe

#pragma once
// MATLAB files of version 7 (level 5, compressed): matrices of doubles and columns of
// texts. A file is a header of 128 bytes, then of each variable an element
//   miCOMPRESSED (15), number of bytes, a zlib stream of
//     miMATRIX (14), number of bytes: flags, dimensions, name, values or cells
// in which every element is filled up to 8 bytes. Little-endian, texts
// as UTF-16 in miUINT16 as MATLAB writes them. The format is public ("MAT-File
// Format", The MathWorks); the library for it on Debian, libmatio, brings HDF5 with it, for files
// of version 7.3 that are not written here.
#include <string>
#include <variant>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct MatVariable {
  std::string name;  ///< letters, digits and '_', a letter first, at most 63
  std::variant<MatX, std::vector<std::string>> value;  ///< texts: UTF-8; a column of cells
};

/// The bytes of a file; equal variables give equal bytes.
std::string mat_file(const std::vector<MatVariable>& variables);

}  // namespace floatframe

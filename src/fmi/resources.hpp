#pragma once
// Where the packed model of an FMU is, and its bytes.
#include <string>
#include <vector>

namespace floatframe::fmi {

/// The file `model.ffm` in the folder `resources`, which FMI 2 names by a URI (file:///tmp/a%20b,
/// file:/C:/tmp, file://localhost/tmp) and FMI 3 by a path. Empty: the URI is of another scheme or
/// of another computer.
std::string model_path(const std::string& resources);

/// All bytes of a file; `path` in UTF-8, on Windows too. False: it cannot be read.
bool read_file(const std::string& path, std::vector<unsigned char>& bytes);

}  // namespace floatframe::fmi

#pragma once
// Gmsh meshes (.msh) of version 4.1, ASCII and binary, and 2. Elements of the highest dimension
// form the part; lower ones (skins) only define sets: a physical group of points, curves or
// surfaces is a node set, one of volumes an element set; a group without a name is "surface 5".
// The format has no material: it comes from the options.
#include <string>
#include <string_view>

#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

bool looks_like_gmsh(std::string_view beginning);
FeModel read_gmsh(const std::filesystem::path& file, const FeReadOptions& options);
/// From the bytes of an uncompressed file; `name` is the file in messages.
FeModel parse_gmsh(std::string_view bytes, const std::string& name, const FeReadOptions& options);

}  // namespace floatframe

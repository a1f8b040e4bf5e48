#pragma once
// Universal files (.unv) of I-DEAS as meshes: nodes (datasets 15, 781, 2411), elements (780, 2412)
// and groups (2435, 2452, 2467, 2477). Solid elements form the part; shells, beams and rods are
// read as skins and edges, which only define node sets; rigid elements that share nodes form one
// rigid spider. The format's materials are not read: the material comes from the options. Nor are
// its tables of properties, which hold the values of springs and lumped masses: these are rejected.
#include <string_view>

#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

class TextSource;

bool looks_like_unv(std::string_view beginning);
FeModel read_unv(const std::filesystem::path& file, const FeReadOptions& options);
FeModel read_unv(TextSource& source, const FeReadOptions& options);

}  // namespace floatframe

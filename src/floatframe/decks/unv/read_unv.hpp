#pragma once
// Universal files (.unv) of I-DEAS as meshes: nodes (datasets 15, 781, 2411), elements (780, 2412)
// and groups (2435, 2452, 2467, 2477). Solid elements are the part; shells, beams and rods are
// taken as skins and edges, which only make node sets; rigid elements that share nodes are one
// rigid spider. The format's materials are not read: the material comes from the options. Nor are
// its tables of properties, where springs and lumped masses have their values: these are refused.
#include <string_view>

#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

class TextSource;

bool looks_like_unv(std::string_view beginning);
FeModel read_unv(const std::filesystem::path& file, const FeReadOptions& options);
FeModel read_unv(TextSource& source, const FeReadOptions& options);

}  // namespace floatframe

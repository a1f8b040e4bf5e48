#pragma once
// Direct input matrices punched by Nastran and OptiStruct (.pch): stiffness KAAX, mass MAAX and
// viscous damping BAAX (any names that begin with K, M and B) of PARAM,EXTOUT,DMIGPCH or EXTSEOUT.
// Nodes come from GRID cards in the same file, from the deck given in the options, or from a deck
// with the same name next to it.
#include <string_view>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

bool looks_like_dmig(std::string_view beginning);
FeModel read_dmig(const std::filesystem::path& file, const FeReadOptions& options);
/// `mass` and `damping` may be null: then they are in the first source, damping if it is there.
FeModel read_dmig(TextSource& stiffness, TextSource* mass, FeModel nodes,
                  TextSource* damping = nullptr);

}  // namespace floatframe

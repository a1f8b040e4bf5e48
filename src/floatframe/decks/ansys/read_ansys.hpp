#pragma once
// ANSYS decks (.cdb) as CDWRITE writes them, blocked or not, and input files of the same commands.
#include <filesystem>
#include <string_view>

#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

class TextSource;

bool looks_like_ansys(std::string_view beginning);
FeModel read_ansys(const std::filesystem::path& file, const FeReadOptions& options);
FeModel read_ansys(TextSource& source, const FeReadOptions& options);
/// Nodes, components and supports alone, for matrices.
FeModel read_ansys_nodes(TextSource& source);

}  // namespace floatframe

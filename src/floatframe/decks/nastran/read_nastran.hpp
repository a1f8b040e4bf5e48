#pragma once
// Nastran bulk data (.bdf, .dat, .nas, .fem): nodes with coordinate systems, solids, flat shells,
// bars, point masses, rigid and averaging elements, multi-point constraints, supports;
// docs/fe-files.md lists the cards. An unread card that may change stiffness or mass is an
// error; others are listed in the notes. WTMASS is applied. A file without properties and materials
// is a mesh: surfaces in it are skins that define node sets. Sets are "PID 3" and
// "SET 5"; names in comments of pre-processors replace these or are added to them.
#include <string_view>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

enum class NastranPart {
  all,
  nodes  ///< nodes and supports; for matrices
};

bool looks_like_nastran(std::string_view beginning);
FeModel read_nastran(const std::filesystem::path& file, const FeReadOptions& options);
/// `has_control`: executive and case control come first.
FeModel read_nastran(TextSource& source, bool has_control, const FeReadOptions& options,
                     NastranPart part = NastranPart::all);

}  // namespace floatframe

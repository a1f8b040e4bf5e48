#pragma once
// Abaqus and CalculiX decks (.inp): nodes, elements, sets, surfaces, isotropic materials, sections,
// masses, rigid bodies, couplings, equations, supports; flat or with one part and one instance.
// docs/fe-files.md lists the keywords. An unread keyword that would change stiffness or mass is an
// error; others are listed in the notes.
#include <string_view>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

enum class DeckPart {
  all,
  nodes  ///< nodes, sets (those of elements as nodes), spiders and supports; for matrices
};

bool looks_like_abaqus(std::string_view beginning);
FeModel read_abaqus(const std::filesystem::path& file, const FeReadOptions& options);
FeModel read_abaqus(TextSource& source, const FeReadOptions& options,
                    DeckPart part = DeckPart::all);

}  // namespace floatframe

#pragma once
// Readers and writers of decks (Abaqus, CalculiX, Nastran, ANSYS, universal files): a library of
// its own (FLOATFRAME_DECKS), which lies beside this one and is loaded with the first file.
#include <vector>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/written/mesh_writer.hpp"

namespace floatframe {

struct DeckComponent {
  std::vector<FeFormat> readers;
  std::vector<MeshFormat> writers;
};

/// Empty where the component was not built.
const DeckComponent& deck_component();

/// What sentences on unknown files should add: nothing, or that decks need the component.
const char* deck_component_missing();

/// Of the component; null where that is not linked, but loaded.
extern "C" __attribute__((weak)) const DeckComponent* floatframe_deck_component();

}  // namespace floatframe

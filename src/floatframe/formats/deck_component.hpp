#pragma once
// Readers and writers of decks (Abaqus, CalculiX, Nastran, ANSYS, universal files): a separate
// library (FLOATFRAME_DECKS) next to this one, loaded with the first file.
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

/// Addition to messages on unknown files: empty, or that decks need the component.
const char* deck_component_missing();

/// From the component; null if it is not linked, but loaded.
extern "C" __attribute__((weak)) const DeckComponent* floatframe_deck_component();

}  // namespace floatframe

// Readers and writers of the component: one entry each.
#include "floatframe/decks/abaqus/read_abaqus.hpp"
#include "floatframe/decks/ansys/read_ansys.hpp"
#include "floatframe/decks/calculix/calculix_text.hpp"
#include "floatframe/decks/nastran/read_nastran.hpp"
#include "floatframe/decks/unv/read_unv.hpp"
#include "floatframe/formats/deck_component.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"

namespace floatframe {
namespace {

FeModel abaqus_nodes(const std::filesystem::path& file) {
  TextSource source(file);
  return read_abaqus(source, {}, DeckPart::nodes);
}

FeModel ansys_nodes(const std::filesystem::path& file) {
  TextSource source(file);
  return read_ansys_nodes(source);
}

FeModel nastran_nodes(const std::filesystem::path& file) {
  const bool has_control = has_begin_bulk(read_beginning(file, std::size_t{1} << 20));
  TextSource source(file);
  return read_nastran(source, has_control, {}, NastranPart::nodes);
}

// clang-format off
const FeFormat readers[] = {
    {"abaqus", "Abaqus / CalculiX deck (.inp)", {".inp"}, looks_like_abaqus, read_abaqus, false,
     abaqus_nodes},
    {"ansys", "ANSYS deck (.cdb), experimental", {".cdb"}, looks_like_ansys, read_ansys, false,
     ansys_nodes},
    {"nastran", "Nastran bulk data (.bdf)", {".bdf", ".dat", ".nas", ".fem", ".blk"},
     looks_like_nastran, read_nastran, false, nastran_nodes},
    {"unv", "Universal file (.unv), experimental", {".unv"}, looks_like_unv, read_unv, true}};
// clang-format on
const MeshFormat writer{"calculix", "CalculiX deck (.inp)", ".inp", calculix_deck};

}  // namespace

extern "C" const DeckComponent* floatframe_deck_component() {
  static const DeckComponent component{{std::begin(readers), std::end(readers)}, {writer}};
  return &component;
}

}  // namespace floatframe

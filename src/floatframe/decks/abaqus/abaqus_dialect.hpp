#pragma once
// Abaqus and CalculiX read the same keywords, but not always as the same thing: the number of a
// round beam section is its radius in Abaqus and its diameter in CalculiX. What only one of the two
// programs knows shows whose deck it is.
#include <optional>
#include <string>

#include "floatframe/decks/abaqus/abaqus_lines.hpp"
#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

/// The first thing found in a deck that only Abaqus has, and the first that only CalculiX has.
struct DialectClues {
  struct Clue {
    std::string what;  ///< "*PART"
    FeSource at;
  };
  std::optional<Clue> abaqus, calculix;
  /// SYSTEM=Z RECTANGULAR is of Abaqus too, but CalculiX takes it without a word as RECTANGULAR.
  std::optional<Clue> axes;
  bool by_axes = false;  ///< nothing else shows whose deck it is

  void add(DeckDialect of, std::string what, const FeSource& at);
  /// Looks at a keyword, in a step or before it, and at its parameters.
  void look_at(const AbaqusKeyword& keyword);
  /// Looks at a type of elements.
  void look_at_type(const std::string& type, const FeSource& at);
  /// All of the deck has been looked at.
  void settle();
};

}  // namespace floatframe

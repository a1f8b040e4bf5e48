#pragma once
// Beams whose section changes along them (PBEAM, PBEAML with stations). A, I1, I2, I12, J and the
// nonstructural mass are linear between stations, as in Nastran. Such a beam becomes a chain of
// beams of constant section with nodes of their own. A piece has the mean area, so that mass is
// exact, and I and J with which torsion and a constant moment are, the mean over its length of 1/I
// and 1/J,
//   I = (I_b - I_a)/ln(I_b/I_a).
// Under a force at its end the deflection of a cantilever of ratio r and n pieces is off by about
// 0.25 ln(r)/n^2: n is chosen for 0.05 %. Its elongation is off by less than 0.1 %.
#include <map>
#include <string>
#include <vector>

#include "floatframe/decks/nastran/nastran_content.hpp"

namespace floatframe {

struct NastranBuild;

/// Stations of a beam as they stand on the card; blanks are filled when all are
/// known.
void read_nastran_beam_stations(NastranFields& f, NastranProperty& p,
                                std::vector<NastranStation> stations);

/// A piece of a tapered beam.
struct NastranPiece {
  double from = 0.0, to = 1.0;  ///< of the length
  BeamSection section;
  double turn = 0.0;
  double nonstructural = 0.0;
};

/// Pieces of the tapered properties of a file, as many as the file may have.
class NastranTapers {
 public:
  explicit NastranTapers(NastranBuild& build);
  /// Empty if the property is not tapered.
  const std::vector<NastranPiece>& pieces(int property) const;

 private:
  std::map<int, std::vector<NastranPiece>> pieces_;
};

}  // namespace floatframe

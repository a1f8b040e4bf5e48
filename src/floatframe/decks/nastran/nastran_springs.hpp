#pragma once
// Springs, bushings and rods of Nastran bulk data.
#include <map>
#include <optional>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// CELAS1 to 4, CBUSH, CBUSH1D.
struct NastranSpring {
  const char* card = "";
  int id = 0, property = 0;
  std::array<int, 2> nodes{};       ///< second 0: the ground
  std::array<int, 2> components{};  ///< CELAS: 0 to 5; -1: none, of a scalar point
  std::optional<double> stiffness;  ///< CELAS2, CELAS4
  // CBUSH
  int system = -1;                  ///< CID; -1: by the line of its nodes
  int orientation_node = 0;         ///< GO
  Vec3 orientation = Vec3::Zero();  ///< X, in the displacement system of GA
  double place = 0.5;               ///< S: on the line from GA to GB
  int offset_system = -1;           ///< OCID; -1: `place` counts
  Vec3 offset = Vec3::Zero();       ///< from GA
  FeSource at;
};

struct NastranSprings {
  std::vector<NastranSpring> list;
  std::map<int, std::pair<double, FeSource>> pelas;
  std::map<int, std::pair<Vec6, FeSource>> pbush;
  std::map<int, std::pair<double, FeSource>> pbush1d;
  std::optional<FeSource> damping;  ///< the first GE or B
};

struct NastranContent;
struct NastranBuild;
class NastranFields;
void read_nastran_celas(NastranFields&, NastranContent&);
void read_nastran_pelas(NastranFields&, NastranContent&);
void read_nastran_bush(NastranFields&, NastranContent&);
void read_nastran_pbush(NastranFields&, NastranContent&);
void read_nastran_bush1d(NastranFields&, NastranContent&);
void read_nastran_pbush1d(NastranFields&, NastranContent&);
void read_nastran_rod(NastranFields&, NastranContent&);  ///< CROD, CTUBE, CONROD

void build_nastran_springs(NastranBuild& build);
/// GJ/L of rods; after what gives rotations to nodes.
void build_nastran_torsion(NastranBuild& build);

}  // namespace floatframe

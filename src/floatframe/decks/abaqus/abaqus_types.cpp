#include <algorithm>

#include "floatframe/decks/abaqus/abaqus_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

constexpr const char* hybrid = "without its pressure field";
constexpr const char* cold = "without their temperatures";
constexpr const char* full =
    "with full integration as in CalculiX (Abaqus takes the change of volume at the centre)";
constexpr const char* unmodified = "as C3D10, without the modified formulation";
constexpr const char* with_shear = "as Timoshenko beams with the shear factors of Abaqus";
constexpr const char* middle_shear =
    "with four points and the shear strain of their middle (Abaqus and CalculiX take one point)";
constexpr const char* triangles =
    "as flat triangles between all their nodes, twice as fine as their corners";

/// TypesAlike that are read in the same way, between blanks.
struct TypesAlike {
  const char* names;
  Family family;
  int nodes;
  FeElementType type = FeElementType::beam2;
  const char* remark = nullptr;
};

constexpr TypesAlike types_of_abaqus[] = {
    {"C3D4", Family::solid, 4, FeElementType::tet4},
    {"C3D4H", Family::solid, 4, FeElementType::tet4, hybrid},
    {"C3D4T", Family::solid, 4, FeElementType::tet4, cold},
    {"C3D10", Family::solid, 10, FeElementType::tet10},
    {"C3D10H", Family::solid, 10, FeElementType::tet10, hybrid},
    {"C3D10I", Family::solid, 10, FeElementType::tet10, "as C3D10"},
    {"C3D10M C3D10MH C3D10MT", Family::solid, 10, FeElementType::tet10, unmodified},
    {"C3D10T", Family::solid, 10, FeElementType::tet10, cold},
    {"C3D5", Family::solid, 5, FeElementType::pyramid5},
    {"C3D5H", Family::solid, 5, FeElementType::pyramid5, hybrid},
    {"C3D6", Family::solid, 6, FeElementType::wedge6},
    {"C3D6T", Family::solid, 6, FeElementType::wedge6, cold},
    {"C3D15", Family::solid, 15, FeElementType::wedge15},
    {"C3D8", Family::solid, 8, FeElementType::hex8, full},
    {"C3D8H", Family::solid, 8, FeElementType::hex8, hybrid},
    {"C3D8I", Family::solid, 8, FeElementType::hex8i},
    {"C3D8T C3D8HT", Family::solid, 8, FeElementType::hex8, cold},
    {"C3D8RT", Family::solid, 8, FeElementType::hex8r, cold},
    {"C3D8R", Family::solid, 8, FeElementType::hex8r},
    {"C3D20", Family::solid, 20, FeElementType::hex20},
    {"C3D20H", Family::solid, 20, FeElementType::hex20, hybrid},
    {"C3D20R", Family::solid, 20, FeElementType::hex20r},
    {"C3D20T", Family::solid, 20, FeElementType::hex20, cold},
    {"C3D20RT", Family::solid, 20, FeElementType::hex20r, cold},
    {"C3D20RH", Family::solid, 20, FeElementType::hex20r, hybrid},
    {"S3 S3R", Family::shell, 3, FeElementType::tri3},
    {"S3T S3RT", Family::shell, 3, FeElementType::tri3, cold},
    {"STRI3", Family::shell, 3, FeElementType::tri3},
    {"S4", Family::shell, 4, FeElementType::quad4},
    {"S4R S4R5", Family::shell, 4, FeElementType::quad4, "as S4"},
    {"S4T S4RT", Family::shell, 4, FeElementType::quad4, cold},
    {"S6 STRI65", Family::shell, 6, FeElementType::tri6, triangles},
    {"S8 S8R S8R5", Family::shell, 8, FeElementType::quad8, triangles},
    {"B31 B31R B31H", Family::beam, 2, FeElementType::beam2, with_shear},
    {"B33", Family::beam, 2, FeElementType::beam2},
    {"B32 B32R B32H", Family::beam, 3, FeElementType::beam3},
    {"CPS3 CPE3 CAX3", Family::skin, 3},
    {"CPS4 CPS4R CPE4 CPE4R CAX4", Family::skin, 4},
    {"CPS6 CPE6 CAX6", Family::skin, 6},
    {"CPS8 CPS8R CPE8 CPE8R CAX8", Family::skin, 8},
    {"M3D3", Family::membrane, 3, FeElementType::membrane3},
    {"M3D4", Family::membrane, 4, FeElementType::membrane4},
    {"M3D4R", Family::membrane, 4, FeElementType::membrane4s, middle_shear},
    {"M3D6", Family::membrane, 6, FeElementType::membrane6},
    {"M3D8", Family::membrane, 8, FeElementType::membrane8},
    {"M3D8R", Family::membrane, 8, FeElementType::membrane8r},
    {"SFM3D3", Family::skin, 3},
    {"SFM3D4 SFM3D4R", Family::skin, 4},
    {"SFM3D6", Family::skin, 6},
    {"SFM3D8", Family::skin, 8},
    {"R3D3", Family::skin, 3},
    {"R3D4", Family::skin, 4},
    {"RB3D2", Family::skin, 2},
    {"T3D2", Family::rod, 2, FeElementType::rod2},
    {"T3D3", Family::skin, 3},
    {"MASS", Family::mass, 1},
    {"ROTARYI", Family::rotary, 1},
    {"SPRINGA SPRING2", Family::spring, 2},
    {"SPRING1", Family::spring, 1},
    {"DASHPOTA DASHPOT2", Family::damper, 2},
    {"DASHPOT1", Family::damper, 1},
    {"GAPUNI", Family::gap, 2},
    {"DCOUP3D", Family::coupling, 1}};

const std::vector<AbaqusType>& all_types() {
  static const std::vector<AbaqusType> all = [] {
    std::vector<AbaqusType> out;
    for (const TypesAlike& t : types_of_abaqus) {
      std::string_view rest = t.names;
      for (std::string_view name = next_word(rest); !name.empty(); name = next_word(rest))
        out.push_back({std::string(name), t.family, t.nodes, t.type, t.remark});
    }
    return out;
  }();
  return all;
}

}  // namespace

const AbaqusType* find_abaqus_type(std::string_view name) {
  const std::vector<AbaqusType>& all = all_types();
  const auto it = std::find_if(all.begin(), all.end(),
                               [&](const AbaqusType& t) { return same_word(t.name, name); });
  return it == all.end() ? nullptr : &*it;
}

std::vector<std::string> abaqus_type_names() {
  std::vector<std::string> names;
  for (const AbaqusType& t : all_types()) names.push_back(t.name);
  return names;
}

}  // namespace floatframe

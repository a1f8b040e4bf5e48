#include <algorithm>
#include <array>

#include "floatframe/decks/abaqus/abaqus_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

constexpr const char* hybrid = "without its pressure field";
constexpr const char* cold = "without their temperatures";
constexpr const char* full =
    "with full integration as in CalculiX (Abaqus takes the change of volume at the centre)";
constexpr const char* with_shear = "as Timoshenko beams with the shear factors of Abaqus";

constexpr const char* middle_shear =
    "with four points and the shear strain of their middle (Abaqus and CalculiX take one point)";
constexpr const char* triangles =
    "as flat triangles between all their nodes, twice as fine as their corners";

constexpr AbaqusType solid(const char* name, int nodes, ElementType type,
                           const char* remark = nullptr) {
  return {name, Family::solid, nodes, type, remark};
}
constexpr AbaqusType skin(const char* name, int nodes) {
  return {name, Family::skin, nodes, ElementType::tri3, nullptr};
}
constexpr AbaqusType shell(const char* name, int nodes, ElementType type,
                           const char* remark = nullptr) {
  return {name, Family::shell, nodes, type, remark};
}
constexpr AbaqusType membrane(const char* name, int nodes, ElementType type,
                              const char* remark = nullptr) {
  return {name, Family::membrane, nodes, type, remark};
}
constexpr AbaqusType beam(const char* name, int nodes, ElementType type,
                          const char* remark = nullptr) {
  return {name, Family::beam, nodes, type, remark};
}

constexpr AbaqusType point(const char* name, Family family, int nodes) {
  return {name, family, nodes, ElementType::beam2, nullptr};
}

constexpr std::array types_of_abaqus{
    solid("C3D4", 4, ElementType::tet4),
    solid("C3D4H", 4, ElementType::tet4, hybrid),
    solid("C3D4T", 4, ElementType::tet4, cold),
    solid("C3D10", 10, ElementType::tet10),
    solid("C3D10H", 10, ElementType::tet10, hybrid),
    solid("C3D10I", 10, ElementType::tet10, "as C3D10"),
    solid("C3D10M", 10, ElementType::tet10, "as C3D10, without the modified formulation"),
    solid("C3D10MH", 10, ElementType::tet10, "as C3D10, without the modified formulation"),
    solid("C3D10MT", 10, ElementType::tet10, "as C3D10, without the modified formulation"),
    solid("C3D10T", 10, ElementType::tet10, cold),
    solid("C3D5", 5, ElementType::pyramid5),
    solid("C3D5H", 5, ElementType::pyramid5, hybrid),
    solid("C3D6", 6, ElementType::wedge6),
    solid("C3D6T", 6, ElementType::wedge6, cold),
    solid("C3D15", 15, ElementType::wedge15),
    solid("C3D8", 8, ElementType::hex8, full),
    solid("C3D8H", 8, ElementType::hex8, hybrid),
    solid("C3D8I", 8, ElementType::hex8i),
    solid("C3D8T", 8, ElementType::hex8, cold),
    solid("C3D8HT", 8, ElementType::hex8, cold),
    solid("C3D8RT", 8, ElementType::hex8r, cold),
    solid("C3D8R", 8, ElementType::hex8r),
    solid("C3D20", 20, ElementType::hex20),
    solid("C3D20H", 20, ElementType::hex20, hybrid),
    solid("C3D20R", 20, ElementType::hex20r),
    solid("C3D20T", 20, ElementType::hex20, cold),
    solid("C3D20RT", 20, ElementType::hex20r, cold),
    solid("C3D20RH", 20, ElementType::hex20r, hybrid),
    shell("S3", 3, ElementType::tri3),
    shell("S3R", 3, ElementType::tri3),
    shell("S3T", 3, ElementType::tri3, cold),
    shell("S3RT", 3, ElementType::tri3, cold),
    shell("STRI3", 3, ElementType::tri3),
    shell("S4", 4, ElementType::quad4),
    shell("S4R", 4, ElementType::quad4, "as S4"),
    shell("S4T", 4, ElementType::quad4, cold),
    shell("S4RT", 4, ElementType::quad4, cold),
    shell("S4R5", 4, ElementType::quad4, "as S4"),
    shell("S6", 6, ElementType::tri6, triangles),
    shell("STRI65", 6, ElementType::tri6, triangles),
    shell("S8", 8, ElementType::quad8, triangles),
    shell("S8R", 8, ElementType::quad8, triangles),
    shell("S8R5", 8, ElementType::quad8, triangles),
    beam("B31", 2, ElementType::beam2, with_shear),
    beam("B31R", 2, ElementType::beam2, with_shear),
    beam("B31H", 2, ElementType::beam2, with_shear),
    beam("B33", 2, ElementType::beam2),
    beam("B32", 3, ElementType::beam3),
    beam("B32R", 3, ElementType::beam3),
    beam("B32H", 3, ElementType::beam3),
    skin("CPS3", 3),
    skin("CPS4", 4),
    skin("CPS4R", 4),
    skin("CPS6", 6),
    skin("CPS8", 8),
    skin("CPS8R", 8),
    skin("CPE3", 3),
    skin("CPE4", 4),
    skin("CPE4R", 4),
    skin("CPE6", 6),
    skin("CPE8", 8),
    skin("CPE8R", 8),
    skin("CAX3", 3),
    skin("CAX4", 4),
    skin("CAX6", 6),
    skin("CAX8", 8),
    membrane("M3D3", 3, ElementType::membrane3),
    membrane("M3D4", 4, ElementType::membrane4),
    membrane("M3D4R", 4, ElementType::membrane4s, middle_shear),
    membrane("M3D6", 6, ElementType::membrane6),
    membrane("M3D8", 8, ElementType::membrane8),
    membrane("M3D8R", 8, ElementType::membrane8r),
    skin("SFM3D3", 3),
    skin("SFM3D4", 4),
    skin("SFM3D6", 6),
    skin("SFM3D4R", 4),
    skin("SFM3D8", 8),
    skin("R3D3", 3),
    skin("R3D4", 4),
    skin("RB3D2", 2),
    AbaqusType{"T3D2", Family::rod, 2, ElementType::rod2, nullptr},
    skin("T3D3", 3),
    AbaqusType{"MASS", Family::mass, 1, ElementType::beam2, nullptr},
    AbaqusType{"ROTARYI", Family::rotary, 1, ElementType::beam2, nullptr},
    point("SPRINGA", Family::spring, 2),
    point("SPRING1", Family::spring, 1),
    point("SPRING2", Family::spring, 2),
    point("DASHPOTA", Family::damper, 2),
    point("DASHPOT1", Family::damper, 1),
    point("DASHPOT2", Family::damper, 2),
    point("GAPUNI", Family::gap, 2),
    AbaqusType{"DCOUP3D", Family::coupling, 1, ElementType::beam2, nullptr},
};

}  // namespace

const AbaqusType* find_abaqus_type(std::string_view name) noexcept {
  const auto it = std::find_if(types_of_abaqus.begin(), types_of_abaqus.end(),
                               [&](const AbaqusType& t) { return same_word(t.name, name); });
  return it == types_of_abaqus.end() ? nullptr : &*it;
}

std::vector<std::string> abaqus_type_names() {
  std::vector<std::string> names;
  for (const AbaqusType& t : types_of_abaqus) names.emplace_back(t.name);
  return names;
}

}  // namespace floatframe

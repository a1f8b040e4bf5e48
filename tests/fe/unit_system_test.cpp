// Unit systems by name and the conversion to SI; faces of elements.
#include "floatframe/fe/unit_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "floatframe/fe/element_faces.hpp"

namespace floatframe {
namespace {

TEST(UnitSystem, SteelIsSteelInAllOfThem) {
  struct Case {
    const char* name;
    double young, density;  // of steel in these units
  };
  // in-lbf-s: 2.1e11 Pa = 30457925 psi, 7850 kg/m3 = 7.3454e-4 lbf s2/in4.
  for (const Case& c :
       {Case{"si", 2.1e11, 7850.0}, Case{"m-kg-s", 2.1e11, 7850.0}, Case{"mm-t-s", 2.1e5, 7.85e-9},
        Case{"MM-KG-MS", 210.0, 7.85e-6}, Case{"mm-kg-s", 2.1e8, 7.85e-6},
        Case{"mm-g-ms", 2.1e5, 7.85e-3}, Case{"cm-g-s", 2.1e12, 7.85},
        Case{"mm-N-s", 2.1e5, 7.85e-9}, Case{"m-kN-s", 2.1e8, 7.85},
        Case{"in-lbf-s", 30457924.92, 7.3454449e-4}, Case{"ft-slug-s", 4385941188.0, 15.2315146}}) {
    const std::optional<UnitSystem> units = find_unit_system(c.name);
    ASSERT_TRUE(units.has_value()) << c.name;
    EXPECT_NEAR(c.young * units->pressure(), 2.1e11, 1e-6 * 2.1e11) << c.name;
    EXPECT_NEAR(c.density * units->density(), 7850.0, 1e-6 * 7850.0) << c.name;
  }
  for (const char* name : {"", "mm", "mm-t", "mm-t-s-s", "mm-t-h", "mm-s-s", "furlong-kg-s"}) {
    EXPECT_FALSE(find_unit_system(name).has_value()) << name;
  }
  for (const std::string& name : unit_system_names()) {
    EXPECT_TRUE(find_unit_system(name).has_value()) << name;
  }
}

TEST(UnitSystem, EverythingInAModelIsConverted) {
  FeModel model;
  model.positions = {Vec3(1000, 0, 0), Vec3(0, 2000, 0)};
  model.materials = {{210000.0, 0.3, 7.85e-9}};
  model.sections = {{100.0, 2e4, 3e4, 4e4}};
  model.shells = {{2.0}};
  model.masses = {{0, 0.001, Mat3(Vec3(1.0, 2.0, 3.0).asDiagonal())}};
  model.equations = {{{{0, 0, 1.0}, {1, 5, 50.0}}, {}}};
  FeMatrices matrices;
  matrices.dofs = {{0, 0}, {0, 5}};
  matrices.K.resize(2, 2);
  matrices.M.resize(2, 2);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      matrices.K.insert(i, j) = 1.0;  // N/mm, N, N mm
      matrices.M.insert(i, j) = 1.0;  // t, t mm, t mm2
    }
  }
  model.matrices = matrices;
  to_si(model, *find_unit_system("mm-t-s"));
  EXPECT_NEAR(model.positions[1].y(), 2.0, 1e-15);
  EXPECT_NEAR(model.materials[0].young, 2.1e11, 1.0);
  EXPECT_NEAR(model.materials[0].density, 7850.0, 1e-9);
  EXPECT_NEAR(model.sections[0].A, 1e-4, 1e-18);
  EXPECT_NEAR(model.sections[0].J, 4e-8, 1e-22);
  EXPECT_NEAR(model.shells[0].thickness, 2e-3, 1e-17);
  EXPECT_NEAR(model.masses[0].mass, 1.0, 1e-14);
  EXPECT_NEAR(model.masses[0].J(2, 2), 3e-3, 1e-17);
  // u + 50 mm theta = 0 is u + 0.05 m theta = 0.
  EXPECT_EQ(model.equations[0].terms[0].factor, 1.0);
  EXPECT_NEAR(model.equations[0].terms[1].factor, 0.05, 1e-16);
  EXPECT_NEAR(model.matrices->K.coeff(0, 0), 1e3, 1e-10);
  EXPECT_NEAR(model.matrices->K.coeff(0, 1), 1.0, 1e-13);
  EXPECT_NEAR(model.matrices->K.coeff(1, 1), 1e-3, 1e-16);
  EXPECT_NEAR(model.matrices->M.coeff(0, 0), 1e3, 1e-10);
  EXPECT_NEAR(model.matrices->M.coeff(0, 1), 1.0, 1e-13);
  EXPECT_NEAR(model.matrices->M.coeff(1, 1), 1e-3, 1e-16);
}

TEST(ElementFaces, EncloseTheElement) {
  const std::vector<Vec3> tet{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Vec3> wedge{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const std::vector<Vec3> hex{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                              {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  const Pairs tet_edges{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  const Pairs wedge_edges{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  const Pairs hex_edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                        {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  struct Case {
    FeElementType type;
    const std::vector<Vec3>* corners;
    const Pairs* edges;
    double volume;
  };
  for (const Case& c : {Case{FeElementType::tet4, &tet, nullptr, 1.0 / 6.0},
                        Case{FeElementType::tet10, &tet, &tet_edges, 1.0 / 6.0},
                        Case{FeElementType::wedge6, &wedge, nullptr, 0.5},
                        Case{FeElementType::wedge15, &wedge, &wedge_edges, 0.5},
                        Case{FeElementType::hex8, &hex, nullptr, 1.0},
                        Case{FeElementType::hex20r, &hex, &hex_edges, 1.0}}) {
    std::vector<Vec3> p = *c.corners;
    if (c.edges != nullptr) {
      for (const auto& [a, b] : *c.edges) p.push_back(0.5 * (p[a] + p[b]));
    }
    ASSERT_EQ(static_cast<int>(p.size()), element_nodes(c.type));
    double six = 0.0;
    for (const FaceNodes& face : element_faces(c.type)) {
      EXPECT_EQ(face.count, c.edges == nullptr ? face.corners : 2 * face.corners);
      const auto at = [&](int k) { return p[face.nodes[k]]; };
      for (int k = 2; k < face.corners; ++k) six += at(0).dot(at(k - 1).cross(at(k)));
      for (int k = face.corners; k < face.count; ++k) {
        const int a = k - face.corners;
        EXPECT_EQ(at(k), Vec3(0.5 * (at(a) + at((a + 1) % face.corners))));
      }
    }
    EXPECT_NEAR(six / 6.0, c.volume, 1e-15);
  }
}

}  // namespace
}  // namespace floatframe

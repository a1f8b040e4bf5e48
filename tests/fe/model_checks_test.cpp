// Errors and suspicious places of imported models; the surface and the stresses there.
#include "floatframe/fe/model_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/surface.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "support/error_of.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

const std::string deck_folder = FLOATFRAME_TEST_DATA "/fe/";

/// n x n x n unit bricks, each divided into two wedges, or five tetrahedra, or left alone; as they
/// would come from a file: node k of the file is number k + 1, its elements begin in line 11.
FeModel block(FeElementType type, int n) {
  FeModel model;
  model.files = {"block.inp"};
  model.materials = {{2e11, 0.3, 7800}};
  model.material_names = {"STEEL"};
  const int m = n + 1;
  for (int k = 0; k < m * m * m; ++k) {
    model.positions.emplace_back(k % m, k / m % m, k / m / m);
    model.node_ids.push_back(k + 1);
  }
  for (int c = 0; c < n * n * n; ++c) {
    const int a = c % n + c / n % n * m + c / n / n * m * m;
    const int corner[8] = {a,         a + 1,         a + 1 + m,         a + m,
                           a + m * m, a + 1 + m * m, a + 1 + m + m * m, a + m + m * m};
    const auto add = [&](std::initializer_list<int> local) {
      FeElement e;
      e.type = type;
      e.id = static_cast<int>(model.elements.size()) + 1;
      e.source = {0, 10 + e.id};
      std::size_t i = 0;
      for (const int l : local) e.nodes[i++] = corner[l];
      model.elements.push_back(e);
    };
    if (type == FeElementType::wedge6) {
      add({0, 1, 2, 4, 5, 6});
      add({0, 2, 3, 4, 6, 7});
    } else if (type == FeElementType::tet4) {  // six about the diagonal 0-6: faces of cells match
      add({0, 1, 2, 6});
      add({0, 2, 3, 6});
      add({0, 3, 7, 6});
      add({0, 7, 4, 6});
      add({0, 4, 5, 6});
      add({0, 5, 1, 6});
    } else {
      add({0, 1, 2, 3, 4, 5, 6, 7});
    }
  }
  return model;
}

std::string errors(const FeModel& model) {
  return error_of([&] { validate(model); });
}

TEST(Validation, NamesElementsOfTheFile) {
  FeModel model = block(FeElementType::hex8, 2);
  EXPECT_EQ(errors(model), "no error");
  std::swap(model.elements[3].nodes[0], model.elements[3].nodes[4]);
  model.elements[5].material = 4;
  model.elements[6].nodes[2] = model.elements[6].nodes[1];
  model.elements[7].nodes[0] = -3;
  EXPECT_EQ(errors(model),
            "block.inp:14: geometry\nblock.inp:16: missing\nblock.inp:17: duplicate\n"
            "block.inp:18: out_of_range");
}

TEST(Validation, TypesOutOfTheList) {
  FeModel model = block(FeElementType::hex8, 1);
  model.elements[0].type = static_cast<FeElementType>(1000);
  EXPECT_THROW(validate(model), InputError);
  model.elements[0].type = static_cast<FeElementType>(-1);
  EXPECT_THROW(validate(model), InputError);
}

TEST(Validation, TwentyOfAKind) {
  FeModel model = block(FeElementType::tet4, 2);
  for (FeElement& e : model.elements) std::swap(e.nodes[0], e.nodes[1]);
  const std::string all = errors(model);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 20);
  EXPECT_TRUE(all.starts_with("block.inp:11: geometry\n")) << all;
  EXPECT_TRUE(all.ends_with("\ngeometry (28)")) << all;
  model.materials.clear();
  EXPECT_EQ(errors(model), "missing");
}

TEST(Validation, SpidersSetsAndMatrices) {
  FeModel model = block(FeElementType::hex8, 1);
  Spider s;
  s.name = "A";
  s.source = {0, 40};
  s.reference = 0;
  s.nodes = {1, 2, 2};
  s.weights = {1, -1};
  model.spiders = {s, Spider{}};
  model.node_sets["BAD"] = {3, 99};
  model.surfaces["TOP"] = {{0, 6}};
  model.masses.push_back({3, 1.0, Mat3::Identity()});
  model.matrices.emplace();
  EXPECT_EQ(errors(model),
            "contradiction\nblock.inp:40: duplicate\nblock.inp:40: wrong_count\n"
            "block.inp:40: out_of_range\nmissing\nnot_found\nnot_found\nexclusive");
  model = block(FeElementType::hex8, 1);
  model.elements.clear();
  model.matrices.emplace();
  model.matrices->K.resize(2, 2);
  model.matrices->M.resize(2, 2);
  model.matrices->K.insert(0, 1) = 1.0;
  model.matrices->dofs = {{0, 0}, {0, 0}};
  EXPECT_EQ(errors(model), "duplicate\ncontradiction");
}

TEST(Warnings, SuspiciousValues) {
  FeModel model = block(FeElementType::hex8, 2);
  EXPECT_TRUE(model_warnings(model).empty());
  EXPECT_EQ(corner_quality(model, model.elements[0]), 1.0);
  model.positions.emplace_back(5, 5, 5);
  model.node_ids.push_back(77);
  model.materials[0].density = 0.0;
  model.elements.push_back(model.elements[2]);
  model.elements.back().id = 50;
  // The middle node almost in the plane of three of its neighbours.
  model.positions[13] = Vec3(0.06, 0.06, 0.06);
  const std::vector<std::string> w = model_warnings(model);
  ASSERT_EQ(w.size(), 4u);
  const std::string shapes =
      "1 element has a corner whose Jacobian is below 0.01 of that of the regular shape; worst: "
      "element ";
  EXPECT_EQ(w[0].substr(0, shapes.size()), shapes);
  EXPECT_EQ(w[1], "material 'STEEL' has no density: 9 elements are without mass");
  EXPECT_EQ(w[2],
            "1 element lies on the nodes of another one: mass and stiffness count twice there; "
            "first: element 3 (hex8) and element 50 (hex8)");
  EXPECT_EQ(
      w[3],
      "1 node is in no element, mass or constraint (as those that only orient beams): node 77");
  EXPECT_EQ(unreferenced_nodes(model), std::vector<int>{27});
  // Slender elements.
  model = block(FeElementType::wedge6, 1);
  for (Vec3& p : model.positions) p(2) *= 30.0;
  EXPECT_EQ(model_warnings(model),
            std::vector<std::string>{
                "2 elements have edges whose longest is more than 20 times the shortest; worst: "
                "element 2 (wedge6): 30, element 1 (wedge6): 30"});
}

TEST(Warnings, QualityOfRegularAndCurvedElements) {
  FeModel model;
  model.positions = {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  std::swap(model.positions[1], model.positions[2]);
  FeElement e;
  e.type = FeElementType::tet4;
  e.nodes = {0, 1, 2, 3};
  const double q = corner_quality(model, e);
  EXPECT_NEAR(std::abs(q), 1.0, 1e-14);
  // The A-arm of the data set: minimal Jacobian at Gauss points and corners over the mean is 0.31,
  // so no element is near to being inverted.
  const FeModel arm = read_fe_file(deck_folder + "aarm_coarse_free.inp");
  EXPECT_TRUE(model_warnings(arm).empty());
  EXPECT_NEAR(volume(arm) / 701265.222794732, 1.0, 2e-6);
  EXPECT_NEAR(volume_times_density(arm) / 5.504932e-3, 1.0, 2e-6);
}

double enclosed_volume(const FeModel& model, const Surface& s) {
  double six = 0.0;
  for (const auto& t : s.triangles) {
    const auto p = [&](std::size_t i) {
      const int node = s.nodes[t[i]];
      return model.positions[node];
    };
    six += p(0).dot(p(1).cross(p(2)));
  }
  return six / 6.0;
}

TEST(Surfaces, EncloseTheVolumeWithOutwardNormals) {
  for (const FeElementType type :
       {FeElementType::hex8, FeElementType::wedge6, FeElementType::tet4}) {
    const FeModel model = block(type, 3);
    EXPECT_EQ(errors(model), "no error");
    const Surface s = outer_surface(model);
    EXPECT_NEAR(enclosed_volume(model, s), 27.0, 1e-12) << fe_element_name(type);
    EXPECT_EQ(s.triangles.size(), 6u * 9u * 2u);
    EXPECT_EQ(s.nodes.size(), 56u);
  }
  for (const char* name : {"aarm_coarse", "conrod_coarse", "beam_c3d20"}) {
    const FeModel model = read_fe_file(deck_folder + name + "_free.inp");
    const Surface s = outer_surface(model);
    EXPECT_NEAR(enclosed_volume(model, s) / volume(model), 1.0, 3e-3) << name;
    // Closed: every edge runs once in each direction.
    std::set<std::pair<int, int>> edges;
    for (const auto& t : s.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second);
      }
    }
    for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
  }
}

TEST(Surfaces, LinesOfBeams) {
  FeModel model;
  for (int k = 0; k < 5; ++k) model.positions.emplace_back(k, 0, 0);
  FeElement two, three;
  two.nodes = {1, 2};
  three.type = FeElementType::beam3;
  three.nodes = {2, 3, 4};
  model.elements = {two, three};
  const Surface s = outer_surface(model);
  EXPECT_EQ(s.nodes, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(s.lines, (std::vector<std::array<int, 2>>{{0, 1}, {1, 2}, {2, 3}}));
}

// One brick, bent: hex8 answers with shear that is not there, hex8i and hex8r do not.
TEST(Solids, BendingOfOneBrick) {
  const double expected = 1.0 / 12.0;  // E I / L for E = 1, L = 1, nu = 0: energy per angle^2 ...
  for (const FeElementType type :
       {FeElementType::hex8, FeElementType::hex8i, FeElementType::hex8r}) {
    FeModel model = block(type, 1);
    model.materials[0] = {1.0, 0.0, 1.0};
    // Ends turn by +-1/2 about y: u = (x - 1/2) (z - 1/2); the brick may bow.
    const FeSystem system = assemble(model);
    VecX u(24);
    for (int k = 0; k < 8; ++k) {
      const Vec3 p = model.positions[k] - Vec3::Constant(0.5);
      u.segment<3>(3 * k) = Vec3(p(0) * p(2), 0, 0);
    }
    const double energy = u.dot(system.K * u);
    if (type == FeElementType::hex8) {
      EXPECT_NEAR(energy, expected * 1.5, 1e-12);  // the shear G gamma^2 = 1/2 x^2
    } else {
      EXPECT_NEAR(energy, expected, 1e-12) << fe_element_name(type);
    }
  }
}

}  // namespace
}  // namespace floatframe::test

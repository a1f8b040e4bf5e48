// Assembled matrices against those that CalculiX 2.20 exported (tests/data/fe/ccx, the rows that
// the files name), the model as points.
#include "floatframe/fe/fe_system.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <map>

#include "fe/mixed_model.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/math/so3.hpp"
#include "support/fe_models.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

const std::string folder = FLOATFRAME_TEST_DATA "/fe/";

/// An entry of the exported matrices. Rows are named by node and direction.
struct Entry {
  int row_node, row_axis, column_node, column_axis;
  double K, M;
};

std::vector<Entry> read_entries(const std::string& file) {
  const std::string text = read_whole_file(folder + "ccx/" + file);
  std::vector<Entry> entries;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto number = [&](auto& value) {
    while (at < end && (*at == ' ' || *at == '\n' || *at == '.')) ++at;
    at = std::from_chars(at, end, value).ptr;
  };
  while (at < end) {
    if (*at == '#') {
      while (at < end && *at++ != '\n') {
      }
      continue;
    }
    Entry e{};
    number(e.row_node);
    number(e.row_axis);
    number(e.column_node);
    number(e.column_axis);
    number(e.K);
    number(e.M);
    entries.push_back(e);
    if (at < end && *at == '\n') ++at;
  }
  return entries;
}

struct Comparison {
  double K = 0.0, M = 0.0;  ///< largest deviations, relative to the largest entry
  std::size_t entries = 0;
};

/// Columns that the file holds are complete: what it does not name is zero.
Comparison compare(const FeModel& model, const FeSystem& system, const std::string& file) {
  std::map<int, int> index;
  for (int k = 0; k < model.nodes(); ++k) {
    index[model.node_ids.empty() ? k + 1 : model.node_ids[k]] = k;
  }
  std::map<int, int> turning;  // CalculiX keeps the rotations of a spider in a node of their own
  for (const Spider& s : model.spiders) turning[s.rotation_node] = s.reference;
  const auto row = [&](int id, int axis) {
    const int node = index.at(id);
    const auto it = turning.find(node);
    return it == turning.end() ? system.row(node, axis - 1) : system.row(it->second, axis + 2);
  };
  Comparison c;
  double K = 0.0, M = 0.0;
  const std::vector<Entry> entries = read_entries(file);
  for (const Entry& e : entries) {
    const int i = row(e.row_node, e.row_axis), j = row(e.column_node, e.column_axis);
    K = std::max(K, std::abs(e.K));
    M = std::max(M, std::abs(e.M));
    c.K = std::max(c.K, std::abs(e.K - system.K.coeff(i, j)));
    c.M = std::max(c.M, std::abs(e.M - system.M.coeff(i, j)));
  }
  c.K /= K;
  c.M /= M;
  c.entries = entries.size();
  return c;
}

TEST(FeSystem, EqualsCalculixMatricesOfTheParts) {
  for (const char* name : {"aarm_coarse", "conrod_coarse", "beam_c3d20", "beam_c3d20r"}) {
    SCOPED_TRACE(name);
    const FeModel model = read_fe_file(folder + name + "_free.inp");
    validate(model);
    const Comparison c =
        compare(model, assemble(model, Integration::ccx), std::string(name) + ".txt.gz");
    EXPECT_GT(c.entries, 10000u);
    EXPECT_LT(c.K, 1e-12);
    EXPECT_LT(c.M, 1e-12);
  }
}

TEST(FeSystem, RigidSpidersEqualCalculixRigidBodies) {
  for (const char* name : {"aarm_coarse", "conrod_coarse"}) {
    SCOPED_TRACE(name);
    const FeModel model = read_fe_file(folder + name + "_rbe2_free.inp");
    validate(model);
    const FeSystem system = assemble(model, Integration::ccx);
    const Comparison c = compare(model, system, std::string(name) + "_rbe2.txt.gz");
    EXPECT_LT(c.K, 1e-12);
    EXPECT_LT(c.M, 1e-12);
    // The reference has its six rows, the nodes of the spider none.
    const Spider& s = model.spiders[0];
    EXPECT_EQ(system.row(s.reference, 5), system.first[s.reference] + 5);
    EXPECT_EQ(system.row(s.nodes[0], 0), -1);
  }
}

// Small distorted meshes of every solid, quadratic ones with curved edges.
TEST(FeSystem, EqualsCalculixOnDistortedPatches) {
  const char* equal[] = {"c3d4", "c3d6", "c3d8", "c3d10", "c3d15", "c3d20", "c3d20r"};
  for (const char* name : equal) {
    SCOPED_TRACE(name);
    const FeModel model = read_fe_file(folder + "ccx/patch_" + name + ".inp.gz");
    const Comparison c =
        compare(model, assemble(model, Integration::ccx), "patch_" + std::string(name) + ".txt.gz");
    EXPECT_GT(c.entries, 1000u);
    EXPECT_LT(c.K, 1e-12);
    EXPECT_LT(c.M, 1e-12);
  }
}

struct MassProperties {
  double mass;
  Vec3 centre;
  Mat3 J;
};

MassProperties mass_properties(const PointModel& points) {
  const VecX m = points.M_s * VecX::Ones(points.p.cols());
  const Mat3 S = points.p * (points.M_s * points.p.transpose());
  return {m.sum(), points.p * m / m.sum(), S.trace() * Mat3::Identity() - S};
}

// README of the data set: mass properties that follow from the exported mass matrix, in mm and t.
TEST(PointModels, MassPropertiesOfTheParts) {
  struct Case {
    const char* name;
    double mass;
    Vec3 centre, J;
  };
  const Case cases[] = {
      {"aarm_coarse",
       5.504932e-3,
       {-4.44839, 159.06175, 1.57664},
       {189.80474, 47.47849, 236.28763}},
      {"conrod_coarse", 6.240875e-4, {46.22882, 0, -0.0013}, {0.22280, 3.37508, 3.55595}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const FeModel model = read_fe_file(folder + c.name + "_free.inp");
    const FeSystem system = assemble(model, Integration::ccx);
    const MassProperties got = mass_properties(point_model(model, system, Integration::ccx));
    EXPECT_NEAR(got.mass / c.mass, 1.0, 1e-7);
    EXPECT_LT((got.centre - c.centre).cwiseAbs().maxCoeff(), 3e-5);
    EXPECT_LT((got.J.diagonal() - c.J).cwiseAbs().maxCoeff(), 6e-6);
    // The exact mass matrix has the same mass up to the points on curved edges.
    const MassProperties exact = mass_properties(point_model(model, assemble(model)));
    EXPECT_NEAR(exact.mass / c.mass, 1.0, 2e-5);
  }
}

TEST(PointModels, ElementsWithRotaryInertiaAreExact) {
  // Shells, 3-node beams and point masses: translation isotropic, rotation any.
  FeModel model = mixed_model(Spider::Kind::rigid);
  model.elements.pop_back();
  model.shells = {{0.01}};
  model.positions.emplace_back(0.4, 0.2, 0.1);
  add_element(model, FeElementType::tri3, {12, 13, 14});
  model.positions.emplace_back(0.35, 0.04, 0.06);
  add_element(model, FeElementType::beam3, {12, 15, 13});
  validate(model);
  const FeSystem system = assemble(model);
  const PointModel points = point_model(model, system);
  EXPECT_LT(points.anisotropy, 1e-12);
  Random random(4);
  const VecX q = random.matrix(system.size(), 1);
  const VecX v = points.T * q;
  double energy = 0.0;
  for (int i = 0; i < 3; ++i) {
    VecX component(points.p.cols());
    for (int k = 0; k < points.p.cols(); ++k) component(k) = v(3 * k + i);
    energy += component.dot(points.M_s * component);
  }
  EXPECT_NEAR(energy / q.dot(system.M * q), 1.0, 1e-12);
}

// Matrices of another program in place of elements: the same system, with spiders on top.
TEST(FeSystem, GivenMatricesAreReducedLikeElements) {
  FeModel elements = mixed_model(Spider::Kind::rigid);
  elements.elements.pop_back();
  elements.masses.clear();
  FeModel plain = elements;
  plain.spiders.clear();
  const FeSystem made = assemble(plain);
  FeModel given = elements;
  given.elements.clear();
  given.matrices.emplace();
  // Rows in an order of their own.
  const int n = made.size();
  Eigen::PermutationMatrix<Eigen::Dynamic> order(n);
  for (int i = 0; i < n; ++i) order.indices()(i) = (7 * i + 3) % n;
  ASSERT_EQ(n % 7 != 0, true);
  given.matrices->K = made.K.twistedBy(order);
  given.matrices->M = made.M.twistedBy(order);
  given.matrices->dofs.resize(n);
  for (int i = 0; i < n; ++i) {
    given.matrices->dofs[order.indices()(i)] = made.dofs[i];
  }
  validate(given);
  const FeSystem a = assemble(elements), b = assemble(given);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LT((MatX(a.K) - MatX(b.K)).cwiseAbs().maxCoeff(), 1e-12 * a.K.coeffs().maxCoeff());
  EXPECT_LT((MatX(a.M) - MatX(b.M)).cwiseAbs().maxCoeff(), 1e-12 * a.M.coeffs().maxCoeff());
  EXPECT_EQ(MatX(a.T), MatX(b.T));
}

}  // namespace
}  // namespace floatframe::test

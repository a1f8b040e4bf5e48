// The mass matrix of a reduced part is that of its elements or its matrices in all blocks, also
// where masses differ between directions.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "support/contains.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

/// Interfaces at the ends, markers at all other nodes.
PartOptions ends_and_nodes(const FeModel& model, int modes) {
  PartOptions options;
  options.modes = modes;
  options.stresses = false;
  for (int k = 0; k < model.nodes(); ++k) {
    const std::string name = "n" + std::to_string(k);
    const NodeChoice place = nearest_to(model.positions[k]);
    if (k == 0 || k + 1 == model.nodes()) {
      options.interfaces.push_back(interface_at(name, place));
    } else {
      options.markers.push_back({name, place, {}});
    }
  }
  return options;
}

/// Rigid motions and modes at all degrees of freedom of a model whose nodes have six.
MatX all_shapes(const FeModel& model, const FeSystem& system, const FlexibleBody& body) {
  MatX Z = MatX::Zero(system.size(), 6 + body.modes());
  for (const ModalNode& node : body.nodes) {
    const int first = system.first[static_cast<std::size_t>(std::stoi(node.name.substr(1)))];
    const Vec3& p = node.p;
    Z.block<6, 6>(first, 0).setIdentity();
    Z.block<3, 3>(first, 3) << 0, p.z(), -p.y(), -p.z(), 0, p.x(), p.y(), -p.x(), 0;
    Z.block(first, 6, 3, body.modes()) = node.X;
    Z.block(first + 3, 6, 3, body.modes()) = node.X_theta;
  }
  EXPECT_EQ(static_cast<int>(body.nodes.size()), model.nodes());
  return Z;
}

/// Elastic eigenvalues of the free structure, ascending.
VecX elastic(const MatX& K, const MatX& M) {
  const VecX all = generalised_eigenvalues(K, M).values;
  return all.tail(all.size() - 6);
}

void expect_mass_of(const FeModel& model, const PartOptions& options) {
  const ReducedPart part = reduce_part(model, options);
  const FeSystem system = assemble(model);
  const MatX Z = all_shapes(model, system, part.body);
  const MatX M = Z.transpose() * (system.M * Z), got = mass_matrix_at_rest(part.body.invariants);
  const VecX size = M.diagonal().cwiseAbs().cwiseSqrt();
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index j = 0; j < M.cols(); ++j)
      EXPECT_NEAR(got(i, j), M(i, j), 1e-10 * size(i) * size(j)) << i << " " << j;
  const VecX expected = elastic(Z.transpose() * (system.K * Z), M);
  for (std::size_t k = 0; k < part.health.free_frequencies.size(); ++k) {
    const double f = hertz_of_eigenvalue(expected(static_cast<Eigen::Index>(k)));
    EXPECT_NEAR(part.health.free_frequencies[k].reduced / f, 1.0, 1e-9) << k;
  }
}

FeModel b33_shaft() {
  FeModel model = read_fe_file(fe_data("b33_shaft.inp"));
  to_si(model, *find_unit_system("m-kg-s"));
  return model;
}

TEST(PartMass, OfConsistentBeams) {
  const FeModel model = b33_shaft();
  for (const int modes : {6, 20}) expect_mass_of(model, ends_and_nodes(model, modes));
  FeModel thick = model;
  for (BeamSection& s : thick.sections) s.shear_y = s.shear_z = 0.8 * s.A;
  for (Vec3& p : thick.positions) p += Vec3(0.3, 0.2 * p.x() * p.x(), -0.1);
  thick.masses.push_back({7, 12.0, Vec3(0.2, 0.1, 0.1).asDiagonal()});
  expect_mass_of(thick, ends_and_nodes(thick, 20));
}

TEST(PartMass, FreeFrequenciesOfAShaftOfBeams) {
  const FeModel model = b33_shaft();
  const HealthReport health = reduce_part(model, ends_and_nodes(model, 60)).health;
  // Bending comes in pairs; the full model has these.
  int found = 0;
  for (const double f : {453.469, 1228.040, 2354.406})
    for (const FrequencyPair& pair : health.free_frequencies)
      if (std::abs(pair.full / f - 1.0) < 1e-6) {
        EXPECT_LT(std::abs(pair.relative_error()), 2.5e-5) << f;
        ++found;
      }
  EXPECT_EQ(found, 6);
  EXPECT_FALSE(contains(health.warnings, "directions"));
}

// Two nodes of a Nastran superelement, the mass matrix of a beam: all modes are the file's.
TEST(PartMass, OfMatricesOfABeam) {
  FeModel model = read_fe_file(fe_data("beam_superelement.pch"));
  to_si(model, *find_unit_system("m-kg-s"));
  PartOptions options = ends_and_nodes(model, 0);
  options.method = ModeMethod::free_free;
  options.modes = 6;
  expect_mass_of(model, options);
  const ReducedPart part = reduce_part(model, options);
  ASSERT_EQ(part.health.free_frequencies.size(), 6u);
  EXPECT_NEAR(part.health.free_frequencies[2].reduced, 326.7, 0.05);
  EXPECT_EQ(count_with(part.health.warnings, "changes with the deformation is unknown"), 1);
}

// Five bars with lumped mass: the fifth bending mode makes seven motions of six masses.
TEST(PartMass, MoreMotionsThanMasses) {
  FeModel model = read_fe_file(fe_data("lumped_bars.bdf"));
  to_si(model, *find_unit_system("m-kg-s"));
  PartOptions options;
  options.stresses = false;
  options.interfaces.push_back(interface_at("A", nearest_to(model.positions[0])));
  options.modes = 9;
  const ReducedPart part = reduce_part(model, options);
  EXPECT_EQ(part.body.modes(), 8);
  const ModeHealth& last = part.health.normal_modes[8];
  EXPECT_TRUE(last.kept);
  EXPECT_NEAR(last.frequency, 1149.97529382, 1e-6);  // Bernoulli bars, rotations condensed
  EXPECT_EQ(count_with(part.health.notes, "of the modes 1 combined motions move no mass"), 1);
}

}  // namespace
}  // namespace floatframe::test

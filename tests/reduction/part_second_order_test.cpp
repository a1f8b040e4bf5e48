// Displacements of second order of parts: rotating beams of solids against Wright and CalculiX,
// Euler's load, body references, methods, mirrors, and bars as parts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/body/mirrored.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "reduction/part_beam.hpp"
#include "reduction/rotating_cantilever.hpp"
#include "support/iltis_parts.hpp"
#include "support/quadratic_mesh.hpp"

namespace floatframe::test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// w^2 of a body that turns about z through its origin, against its frame.
VecX spun_lambda(const FlexibleBody& body, double speed) {
  const InertiaInvariants& v = body.invariants;
  const MatX C =
      v.Sij[0][0] + v.Sij[1][1] + body.second_order->S2i[0][0] + body.second_order->S2i[1][1];
  return generalised_eigenvalues(MatX(body.K - speed * speed * C), modal_mass(v)).values;
}

/// Bricks along x from the origin, the section about the x axis.
FeModel centred(int nx, int across, double length, double width) {
  FeModel model = brick_beam(nx, across, across, length, width);
  for (Vec3& p : model.positions) p -= Vec3(0.0, 0.5 * width, 0.5 * width);
  return model;
}

PartOptions clamped(const std::string& set, int modes) {
  PartOptions options;
  options.interfaces = {bore(set)};
  options.reference = {BodyReference::Kind::node, set};
  options.modes = modes;
  options.check_free_modes = false;
  options.stresses = false;
  return options;
}

void expect_wright(const FeModel& model) {
  const FlexibleBody body = reduce_part(model, clamped("A", 10)).body;
  ASSERT_TRUE(body.second_order);
  const VecX rest = spun_lambda(body, 0.0);
  // Of the bending stiffness that the mesh has at rest.
  const double unit = std::sqrt(rest(1)) / turning_beam[0].first;
  for (const TurningBeam& beam : turning_beam) {
    SCOPED_TRACE(beam.speed);
    const VecX lambda = spun_lambda(body, beam.speed * unit);
    const double ratio = beam.first / turning_beam[0].first;
    EXPECT_NEAR(std::sqrt(lambda(1) / rest(1)) / ratio, 1.0, 2e-3);
    // In the plane, against what the flap has.
    const double lag = lambda(0) / (unit * unit) + beam.speed * beam.speed;
    EXPECT_NEAR(std::sqrt(lag * unit * unit / rest(0)) / ratio, 1.0, 2e-3);
    EXPECT_NEAR(std::sqrt(lambda(5) / rest(5)) / (beam.third / turning_beam[0].third), 1.0, 2e-3);
  }
}

TEST(PartSecondOrder, RotatingBeamOfBricks) { expect_wright(hex20_of(centred(30, 1, 1.0, 0.01))); }

TEST(PartSecondOrder, RotatingBeamOfTetrahedra) {
  expect_wright(tets_of(centred(40, 1, 1.0, 0.01), true));
}

TEST(PartSecondOrder, RotatingBeamOfCalculix) {
  const FeModel model = steel_part("beam_c3d20r_mesh.inp.gz", "m-kg-s");
  const FlexibleBody body = reduce_part(model, clamped("END_A", 12)).body;
  // data/fe/reference_frequencies.json, beam_rot_0 .. beam_rot_200 [Hz].
  const struct {
    double speed;
    double f[6];
  } runs[] = {{0.0, {16.72992, 16.72992, 104.6518, 104.6518, 292.1663, 292.1663}},
              {50.0, {17.08785, 18.84943, 106.2967, 106.5935, 293.9852, 294.0923}},
              {100.0, {18.05758, 24.06874, 111.0864, 112.2183, 299.3678, 299.7884}},
              {200.0, {20.94697, 38.10133, 128.4584, 132.335, 319.8887, 321.4603}}};
  for (const auto& run : runs) {
    const VecX lambda = spun_lambda(body, run.speed);
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(std::sqrt(lambda(k)) / two_pi / run.f[k], 1.0, 5e-3) << run.speed << " " << k;
  }
}

TEST(PartSecondOrder, EulerLoadOfAColumn) {
  PartOptions options = clamped("A", 10);
  options.markers = {{"tip", {.set = "B"}, {}}};
  const FlexibleBody body = reduce_part(hex20_of(centred(20, 1, 1.0, 0.02)), options).body;
  ASSERT_EQ(body.second_order->nodes[1].node, 1);
  const VecX load = generalised_eigenvalues(MatX(-body.second_order->nodes[1].h[0]), body.K).values;
  const double euler =
      std::pow(std::numbers::pi / 2.0, 2) * steel.young * 0.02 * 0.02 * 0.02 * 0.02 / 12.0;
  EXPECT_NEAR(1.0 / (load(load.size() - 1) * euler), 1.0, 0.01);
}

// A rigid arm d at the end of a column of length L that carries the load at its end: with
// k = sqrt(P/EI) it buckles where k d tan(k L) = 1. The nodes of the spider are fixed to the
// reference at the end of the arm.
TEST(PartSecondOrder, ColumnWithARigidArm) {
  PartOptions options = clamped("A", 10);
  options.interfaces.push_back(bore("B", Vec3(1.3, 0.0, 0.0)));
  const FlexibleBody body = reduce_part(hex20_of(centred(20, 1, 1.0, 0.02)), options).body;
  const VecX load = generalised_eigenvalues(MatX(-body.second_order->nodes[1].h[0]), body.K).values;
  double low = 0.1, high = 1.5;
  for (int i = 0; i < 60; ++i) {
    const double k = 0.5 * (low + high);
    (k * 0.3 * std::tan(k) < 1.0 ? low : high) = k;
  }
  const double exact = low * low * steel.young * 0.02 * 0.02 * 0.02 * 0.02 / 12.0;
  EXPECT_NEAR(1.0 / (load(load.size() - 1) * exact), 1.0, 0.01);
}

/// Largest entry of all matrices h.
double size_of(const SecondOrder& s) {
  double size = 0.0;
  for (const SecondOrderNode& node : s.nodes)
    for (const MatX& h : node.h) size = std::max(size, h.cwiseAbs().maxCoeff());
  return size;
}

TEST(PartSecondOrder, VanishesWhereTheReferenceHolds) {
  PartOptions options = both_ends(6);
  // What rigid spiders hold moves on circles beside the field that the reference holds.
  for (InterfaceDescription& d : options.interfaces) d.kind = Spider::Kind::mean;
  for (const ModeMethod method :
       {ModeMethod::craig_bampton, ModeMethod::craig_chang, ModeMethod::free_free}) {
    options.method = method;
    options.reference = {};
    const FlexibleBody mean = reduce_part(beam(), options).body;
    const SecondOrder& s = *mean.second_order;
    const double size = size_of(s);
    EXPECT_GT(size, 0.0);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = (j + 1) % 3;
      EXPECT_LT(s.S2[j].cwiseAbs().maxCoeff(), 1e-7 * size * mean.invariants.m);
      EXPECT_LT((s.S2i[j][k] - s.S2i[k][j]).cwiseAbs().maxCoeff(), 1e-7 * size * mean.invariants.m);
    }
    if (method == ModeMethod::free_free) continue;
    options.reference = {BodyReference::Kind::node, "B"};
    const FlexibleBody held = reduce_part(beam(), options).body;
    for (std::size_t j = 0; j < 3; ++j) {
      const SecondOrderNode& node = held.second_order->nodes[1];
      EXPECT_LT(node.h[j].cwiseAbs().maxCoeff(), 1e-7 * size_of(*held.second_order));
      EXPECT_LT(node.theta[j].cwiseAbs().maxCoeff(), 1e-6 * size_of(*held.second_order));
    }
  }
}

/// Two ways to the modes of one part: the same stiffening, first bending frequencies.
TEST(PartSecondOrder, MethodsAgree) {
  PartOptions options = both_ends(20);
  options.reference = {BodyReference::Kind::node, "A"};
  const FlexibleBody bampton = reduce_part(beam(), options).body;
  options.method = ModeMethod::craig_chang;
  const FlexibleBody chang = reduce_part(beam(), options).body;
  const VecX a = spun_lambda(bampton, 800.0), b = spun_lambda(chang, 800.0);
  const VecX rest = spun_lambda(bampton, 0.0);
  EXPECT_GT(a(1) / rest(1), 1.2);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a(k) / b(k), 1.0, 1e-3);
}

TEST(PartSecondOrder, BarsAsParts) {
  BarFrame frame = straight_bar(1.0, 0.02, 6);
  frame.points.emplace_back("end", Vec3(1.2, 0.6, 0.3));
  frame.bars.push_back(frame.bars[0]);
  frame.bars[1].name = "second";
  frame.bars[1].from = "outer";
  frame.bars[1].to = "end";
  const FeModel model = build_bar_frame(frame);
  const int root = model.find_node("inner"), end = model.find_node("end");
  PartOptions options;
  for (const auto& [name, node] : {std::pair{"start", root}, {"stop", end}})
    options.interfaces.push_back(interface_at(name, nearest_to(model.positions[node])));
  options.reference = {BodyReference::Kind::node, "start"};
  options.modes = 4;
  const FlexibleBody part = reduce_part(model, options).body;
  ReductionOptions bar;
  bar.clamped = {{"inner", all_dofs}};
  bar.interfaces = {{"end", all_dofs}};
  bar.normal_modes = 4;
  bar.mass_model = MassModel::hermite;
  bar.section_inertia = true;
  bar.orthonormalise = true;
  const FlexibleBody body = reduce(model, bar);
  ASSERT_EQ(part.modes(), body.modes());
  // The same modes but for their signs and what the masses differ in.
  const MatX& h = body.second_order->nodes[end].h[0];
  const MatX& other = part.second_order->nodes[1].h[0];
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(other(k, k), h(k, k), 0.01 * h.cwiseAbs()(k, k));
}

TEST(PartSecondOrder, MirrorsCommute) {
  // Nothing of it is symmetric, so no modes are double.
  FeModel model = tets_of(brick_beam(4, 2, 1, 0.4, 0.05), true);
  for (Vec3& p : model.positions) {
    p.y() *= 1.0 + p.x();
    p.z() += 0.2 * p.x() * p.x() + 0.1 * p.y();
  }
  const Mat3 P = Vec3(1.0, 1.0, -1.0).asDiagonal();
  FeModel other = model;
  for (Vec3& p : other.positions) p = P * p;
  for (FeElement& e : other.elements) {
    std::swap(e.nodes[1], e.nodes[2]);
    std::swap(e.nodes[4], e.nodes[6]);
    std::swap(e.nodes[8], e.nodes[9]);
  }
  PartOptions options = both_ends(3);
  const FlexibleBody body = mirrored(reduce_part(model, options).body, P);
  const FlexibleBody made = reduce_part(other, options).body;
  const auto nm = static_cast<Eigen::Index>(body.modes());
  VecX sign(nm);
  for (Eigen::Index a = 0; a < nm; ++a)
    sign(a) = body.nodes[0].X.col(a).dot(made.nodes[0].X.col(a)) > 0.0 ? 1.0 : -1.0;
  const double size = size_of(*body.second_order);
  const auto same = [&](const MatX& a, const MatX& b) {
    EXPECT_LT((a - MatX(sign.asDiagonal() * b * sign.asDiagonal())).cwiseAbs().maxCoeff(),
              1e-5 * size);
  };
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i)
      same(body.second_order->S2i[i][j], made.second_order->S2i[i][j]);
    for (std::size_t k = 0; k < 2; ++k) {
      same(body.second_order->nodes[k].h[j], made.second_order->nodes[k].h[j]);
      same(body.second_order->nodes[k].theta[j], made.second_order->nodes[k].theta[j]);
    }
  }
}

}  // namespace
}  // namespace floatframe::test

// Displacements of second order of bars: Southwell's coefficient, rotating cantilevers, Euler's
// load, frames against the axial forces of unit loads.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/body/mirrored.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/body/with_modes.hpp"
#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "reduction/rotating_cantilever.hpp"
#include "support/iltis_parts.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

constexpr double L = 2.0, EI = 2e11 * std::numbers::pi / 64.0 * 1.6e-7, rho = 7500.0;
constexpr double A = std::numbers::pi / 4.0 * 4e-4;

BarFrame round_bar(int elements) { return straight_bar(L, 0.02, elements); }

ReductionOptions cantilever(int modes, MassModel mass = MassModel::hermite) {
  ReductionOptions options;
  options.clamped = {{"inner", all_dofs}};
  options.normal_modes = modes;
  options.mass_model = mass;
  options.eigen_mass = MassModel::hermite;
  return options;
}

/// w^2 of the body that turns about z through its origin, against its frame.
VecX turning_lambda(const FlexibleBody& body, double speed, bool stiffened = true) {
  const InertiaInvariants& v = body.invariants;
  MatX C = v.Sij[0][0] + v.Sij[1][1];
  if (stiffened) C += body.second_order->S2i[0][0] + body.second_order->S2i[1][1];
  return generalised_eigenvalues(MatX(body.K - speed * speed * C), modal_mass(v)).values;
}

TEST(BarSecondOrder, Southwell) {
  const FlexibleBody body = reduce(build_bar_frame(round_bar(20)), cantilever(2));
  // The first mode of a clamped bar, integrated directly: int x int_0^x w'^2 dx = int (L^2 -
  // x^2)/2 w'^2.
  const double b = 1.8751040687119611;
  const double sigma = (std::cosh(b) + std::cos(b)) / (std::sinh(b) + std::sin(b));
  double stiffening = 0.0, mass = 0.0, sum = 0.0;
  const int n = 2000;
  for (int k = 0; k <= n; ++k) {
    const double s = static_cast<double>(k) / n, x = b * s;
    const double simpson = (k == 0 || k == n ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / (3.0 * n);
    const double w = std::cosh(x) - std::cos(x) - sigma * (std::sinh(x) - std::sin(x));
    const double slope = b * (std::sinh(x) + std::sin(x) - sigma * (std::cosh(x) - std::cos(x)));
    stiffening += simpson * 0.5 * (1.0 - s * s) * slope * slope;
    sum += simpson * (1.0 - s) * slope * slope;
    mass += simpson * w * w;
  }
  EXPECT_NEAR(stiffening / mass, 1.1933, 5e-5);
  const MatX M = modal_mass(body.invariants);
  for (int a = 0; a < 2; ++a) {
    EXPECT_NEAR(-body.second_order->S2i[0][0](a, a) / M(a, a), stiffening / mass, 2e-6);
    EXPECT_NEAR(-body.second_order->S2[0](a, a) / M(a, a), sum / mass / L, 2e-6);
  }
  for (int j = 1; j < 3; ++j) EXPECT_LT(body.second_order->S2[j].norm(), 1e-12);
}

TEST(BarSecondOrder, RotatingCantilever) {
  const double unit = std::sqrt(EI / (rho * A * std::pow(L, 4)));
  for (const MassModel mass : {MassModel::hermite, MassModel::isoparametric}) {
    const FlexibleBody body = reduce(build_bar_frame(round_bar(60)), cantilever(10, mass));
    for (const auto& [speed, first, third] : turning_beam) {
      SCOPED_TRACE(speed);
      const VecX lambda = turning_lambda(body, speed * unit) / (unit * unit);
      // In pairs: in the plane mu^2 = flap^2 - speed^2.
      for (const auto& [mode, flap, tolerance] :
           {std::tuple{0, first, 1e-3}, std::tuple{2, third, 1e-2}}) {
        EXPECT_NEAR(std::sqrt(lambda(2 * mode + 1)) / flap, 1.0, tolerance);
        EXPECT_NEAR((lambda(2 * mode) + speed * speed) / (flap * flap), 1.0, 2.0 * tolerance);
      }
      const VecX soft = turning_lambda(body, speed * unit, false) / (unit * unit);
      const double rest = turning_beam[0].first * turning_beam[0].first;
      EXPECT_NEAR(soft(0) + speed * speed, rest, 0.01 * rest);
    }
  }
}

TEST(BarSecondOrder, EulerLoad) {
  const FeModel model = build_bar_frame(round_bar(20));
  for (const bool analytic : {false, true}) {
    ReductionOptions options = cantilever(6);
    if (analytic) options.analytic = AnalyticShapes{3};
    const FlexibleBody body = reduce(model, options);
    const SecondOrderNode& tip = body.second_order->nodes[model.find_node("outer")];
    ASSERT_EQ(tip.node, model.find_node("outer"));
    // K + P h_1: the force -P e_1 at the tip.
    const VecX load = generalised_eigenvalues(MatX(-tip.h[0]), body.K).values;
    const double euler = std::pow(std::numbers::pi / (2.0 * L), 2) * EI;
    EXPECT_NEAR(1.0 / (load(load.size() - 1) * euler), 1.0, 0.01) << analytic;
  }
}

/// int v'^T w'' - w'^T v'' dx of an element, its symmetric part.
MatX twist_of(const Mat3& T, double l, const FeElement& e, const MatX& X) {
  MatX v(4, X.cols()), w(4, X.cols());
  for (int k = 0; k < 2; ++k) {
    const MatX u = T.transpose() * X.middleRows<3>(6 * e.nodes[k]);
    const MatX r = T.transpose() * X.middleRows<3>(6 * e.nodes[k] + 3);
    v.row(2 * k) = u.row(1);
    v.row(2 * k + 1) = r.row(2);
    w.row(2 * k) = u.row(2);
    w.row(2 * k + 1) = -r.row(1);
  }
  MatX sum = MatX::Zero(X.cols(), X.cols());
  for (const auto& [s, weight] : {std::pair{0.5 - std::sqrt(0.15), 5.0 / 18.0},
                                  {0.5, 4.0 / 9.0},
                                  {0.5 + std::sqrt(0.15), 5.0 / 18.0}}) {
    const Eigen::RowVector4d d(6 * (s * s - s) / l, 1 - 4 * s + 3 * s * s, 6 * (s - s * s) / l,
                               3 * s * s - 2 * s);
    const Eigen::RowVector4d dd(6 * (2 * s - 1) / (l * l), (6 * s - 4) / l,
                                6 * (1 - 2 * s) / (l * l), (6 * s - 2) / l);
    const MatX half = (d * v).transpose() * (dd * w) - (d * w).transpose() * (dd * v);
    sum += 0.5 * weight * l * (half + half.transpose());
  }
  return sum;
}

/// Linear static response of the frame held at some dofs, and -X^T K_sigma X of its axial forces
/// and torques.
MatX loaded(const FeModel& model, const MatX& X, const std::vector<int>& held, const VecX& f) {
  MatX K(assemble_stiffness(model));
  VecX load = f;
  for (const int dof : held) {
    K.row(dof).setZero();
    K.col(dof).setZero();
    K(dof, dof) = 1.0;
    load(dof) = 0.0;
  }
  const VecX u = ldlt_solve(K, load);
  MatX out = MatX::Zero(X.cols(), X.cols());
  for (const FeElement& e : model.elements) {
    const ElementInput in = gather(model, e);
    const double l = (in.p[1] - in.p[0]).norm();
    const Mat3 T = beam_axes(in);
    const auto end = [&](int k) { return Vec3(u.segment<3>(6 * e.nodes[k])); };
    const double N = in.material.young * in.section.A / l * T.col(0).dot(end(1) - end(0));
    const auto turn = [&](int k) { return Vec3(u.segment<3>(6 * e.nodes[k] + 3)); };
    const double torque = in.material.shear() * in.section.J / l * T.col(0).dot(turn(1) - turn(0));
    out += torque * twist_of(T, l, e, X);
    const VecX phi =
        ((X.middleRows<3>(6 * e.nodes[1] + 3) - X.middleRows<3>(6 * e.nodes[0] + 3)).transpose() *
         T.col(0));
    out -= N * (in.section.Iy + in.section.Iz) / (in.section.A * l) * phi * phi.transpose();
    Eigen::Matrix4d G;
    G << 36, 3 * l, -36, 3 * l, 3 * l, 4 * l * l, -3 * l, -l * l, -36, -3 * l, 36, -3 * l, 3 * l,
        -l * l, -3 * l, 4 * l * l;
    for (int plane = 1; plane < 3; ++plane) {
      MatX q(4, X.cols());
      for (int k = 0; k < 2; ++k) {
        q.row(2 * k) = T.col(plane).transpose() * X.middleRows<3>(6 * e.nodes[k]);
        const Vec3 axis = plane == 1 ? Vec3(T.col(2)) : Vec3(-T.col(1));
        q.row(2 * k + 1) = axis.transpose() * X.middleRows<3>(6 * e.nodes[k] + 3);
      }
      out -= N / (30.0 * l) * q.transpose() * G * q;
    }
  }
  return out;
}

std::vector<int> dofs_of(const FeModel& model, const std::vector<NodeDofs>& list) {
  std::vector<int> out;
  for (const NodeDofs& c : list)
    for (int axis = 0; axis < 6; ++axis)
      if (((c.mask >> axis) & 1u) != 0) out.push_back(6 * model.find_node(c.node) + axis);
  return out;
}

void expect_unit_loads(const BarFrame& frame, const ReductionOptions& options) {
  const FeModel model = build_bar_frame(frame);
  const FlexibleBody body = reduce(model, options);
  ASSERT_TRUE(body.second_order);
  const MatX X = craig_bampton_modes(model, options).X;
  const std::vector<int> held = dofs_of(model, options.clamped);
  double scale = 0.0;
  for (const SecondOrderNode& node : body.second_order->nodes)
    for (int j = 0; j < 3; ++j) scale = std::max(scale, node.h[j].cwiseAbs().maxCoeff());
  EXPECT_GT(scale, 0.0);
  const SparseRows M = assemble_scalar_mass(model);
  for (int j = 0; j < 3; ++j) {
    VecX all = VecX::Zero(X.rows());
    for (int k = 0; k < model.nodes(); ++k) {
      for (SparseRows::InnerIterator it(M, k); it; ++it) all(6 * k + j) += it.value();
      const VecX force = VecX::Unit(X.rows(), 6 * k + j);
      const VecX moment = VecX::Unit(X.rows(), 6 * k + 3 + j);
      const SecondOrderNode& node = body.second_order->nodes[k];
      ASSERT_EQ(node.node, k);
      EXPECT_LT((node.h[j] - loaded(model, X, held, force)).norm(), 1e-7 * scale);
      EXPECT_LT((node.theta[j] - loaded(model, X, held, moment)).norm(), 1e-5 * scale);
      if (body.projection) {
        EXPECT_EQ(node.h[j], body.projection->h.middleRows(X.cols() * (3 * k + j), X.cols()));
      }
    }
    const MatX S2 = loaded(model, X, held, all);
    EXPECT_LT((body.second_order->S2[j] - S2).norm(), 1e-7 * scale * body.invariants.m);
  }
}

BarFrame bent_frame() {
  BarFrame frame = straight_bar(1.0, 0.02, 3);
  frame.points.emplace_back("end", Vec3(1.2, 0.6, 0.3));
  frame.bars.push_back(frame.bars[0]);
  frame.bars[1].name = "second";
  frame.bars[1].from = "outer";
  frame.bars[1].to = "end";
  return frame;
}

TEST(BarSecondOrder, FramesUnderUnitLoads) {
  ReductionOptions clamped = cantilever(5, MassModel::isoparametric);
  clamped.interfaces = {{"end", 6u}};
  expect_unit_loads(bent_frame(), clamped);
  // Held in the middle, by a chord, and by more than it needs.
  ReductionOptions middle = clamped;
  middle.clamped = {{"outer", all_dofs}};
  expect_unit_loads(bent_frame(), middle);
  ReductionOptions chord = clamped;
  chord.clamped = {{"inner", 15u}, {"outer", 6u}};
  chord.interfaces.clear();
  expect_unit_loads(straight_bar(1.0, 0.02, 6), chord);
  ReductionOptions both = chord;
  both.clamped = {{"inner", all_dofs}, {"outer", all_dofs}};
  expect_unit_loads(straight_bar(1.0, 0.02, 6), both);
  ReductionOptions arm = a_arm_options();
  expect_unit_loads(a_arm_frame(5), arm);
}

TEST(BarSecondOrder, IntegralsOfTheMassModels) {
  // The linear mass misses what happens inside of the elements: second order in their length.
  double last = 0.0;
  for (const int elements : {5, 10, 20}) {
    BarFrame frame = bent_frame();
    for (Bar& bar : frame.bars) bar.elements = elements;
    const FeModel mesh = build_bar_frame(frame);
    const FlexibleBody exact = reduce(mesh, cantilever(4));
    const FlexibleBody linear = reduce(mesh, cantilever(4, MassModel::isoparametric));
    const double error =
        relative_error(linear.second_order->S2i[0][0], exact.second_order->S2i[0][0]);
    EXPECT_LT(error, 0.1);
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 4.0, 0.5);
    }
    last = error;
  }
}

/// The second moments of a flat bar: a blade that twists is turned back by its own rotation.
TEST(BarSecondOrder, PropellerMoment) {
  BarFrame frame = straight_bar(1.0, 0.02, 10);
  frame.bars[0].section = BeamSection::rectangle(0.06, 0.01);
  frame.bars[0].reference = Vec3::UnitY();
  ReductionOptions options = cantilever(0);
  options.interfaces = {{"outer", 8u}};
  options.section_inertia = true;
  const FlexibleBody body = reduce(build_bar_frame(frame), options);
  const InertiaInvariants& v = body.invariants;
  const double C =
      (v.Sij[0][0] + v.Sij[1][1] + body.turning->S2i[0][0] + body.turning->S2i[1][1])(0, 0);
  const double flat = 0.06 * 0.06, thin = 0.01 * 0.01;
  EXPECT_NEAR(-C / modal_mass(v)(0, 0), (flat - thin) / (flat + thin), 1e-12);
}

void expect_same(const SecondOrder& a, const SecondOrder& b) {
  double scale = 0.0;
  for (const SecondOrderNode& node : b.nodes)
    for (const MatX& h : node.h) scale = std::max(scale, h.norm());
  const auto same = [&](const MatX& x, const MatX& y) { EXPECT_LT((x - y).norm(), 1e-9 * scale); };
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t j = 0; j < 3; ++j) {
    same(a.S2[j], b.S2[j]);
    for (std::size_t i = 0; i < 3; ++i) same(a.S2i[i][j], b.S2i[i][j]);
    for (std::size_t k = 0; k < a.nodes.size(); ++k) {
      EXPECT_EQ(a.nodes[k].node, b.nodes[k].node);
      same(a.nodes[k].h[j], b.nodes[k].h[j]);
      same(a.nodes[k].theta[j], b.nodes[k].theta[j]);
    }
  }
}

TEST(BarSecondOrder, MirrorsModesAndOrthonormalModes) {
  ReductionOptions options = cantilever(5, MassModel::isoparametric);
  options.clamped = {{"inner", 15u}, {"end", 6u}};
  const BarFrame frame = bent_frame();
  const FlexibleBody body = reduce(build_bar_frame(frame), options);
  const Mat3 P = Vec3(1.0, -1.0, 1.0).asDiagonal();
  const FlexibleBody there = mirrored(body, P);
  // The mirrored frame with the mirrored modes.
  BarFrame other = frame;
  for (auto& [name, p] : other.points) p = P * p;
  for (Bar& bar : other.bars) bar.reference = P * bar.reference;
  ReductionOptions given = options;
  given.basis = MatX(6 * body.nodes.size(), body.modes());
  for (std::size_t k = 0; k < body.nodes.size(); ++k) {
    given.basis->middleRows<3>(6 * k) = there.nodes[k].X;
    given.basis->middleRows<3>(6 * k + 3) = there.nodes[k].X_theta;
  }
  const FlexibleBody made = reduce(build_bar_frame(other), given);
  expect_same(*there.second_order, *made.second_order);
  EXPECT_LT((there.projection->h - made.projection->h).norm(), 1e-9 * made.projection->h.norm());
  expect_same(*mirrored(there, P).second_order, *body.second_order);
  EXPECT_EQ(mirrored(there, P).projection->h, body.projection->h);

  const FlexibleBody some = with_modes(body, {3, 1});
  const MatX& all = body.second_order->nodes[5].h[0];
  EXPECT_EQ(some.second_order->nodes[5].h[0](0, 1), all(3, 1));
  EXPECT_EQ(some.second_order->S2i[2][0](1, 1), body.second_order->S2i[2][0](1, 1));
  EXPECT_EQ(some.projection->h.middleRows(2 * 15, 2), some.second_order->nodes[5].h[0]);
  EXPECT_EQ(with_modes(body, {}).second_order, nullptr);

  ReductionOptions ortho = options;
  ortho.orthonormalise = true;
  const FlexibleBody turned = reduce(build_bar_frame(frame), ortho);
  const MatX C = qr_solve(body.projection->X, turned.projection->X);
  expect_same(combined(*body.second_order, C), *turned.second_order);
}

}  // namespace
}  // namespace floatframe::test

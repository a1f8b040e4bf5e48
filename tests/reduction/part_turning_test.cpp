// What turns with the nodes of a part, to second order: the kinetic energy of integrals and
// `turning` against that of sections and discs turned by exact rotations, whose remainder falls
// with the cube of the amplitude; the twist of second order of a shaft that is bent in two planes.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"
#include "floatframe/math/so3.hpp"
#include "reduction/part_beam.hpp"
#include "support/body_energy.hpp"
#include "support/fe_models.hpp"

namespace floatframe::test {
namespace {

/// Marks every node with rotations, so that the body knows its motion.
PartOptions all_nodes(const FeModel& model, int modes) {
  PartOptions options;
  options.modes = modes;
  options.check_free_modes = false;
  options.stresses = false;
  options.keep_projection = true;
  for (int k = 0; k < model.nodes(); ++k) {
    const NodeChoice place = nearest_to(model.positions[k]);
    if (k == 0)
      options.interfaces.push_back(interface_at("n0", place));
    else
      options.markers.push_back({"n" + std::to_string(k), place, {}});
  }
  return options;
}

/// Bars with different Iy and Iz, a disc at a node, one on an arm, one on an arm of that arm.
FeModel rotor(bool straight) {
  FeModel model;
  model.materials = {steel};
  model.sections = {BeamSection::rectangle(0.02, 0.05)};
  constexpr int n = 4;
  for (int k = 0; k <= n; ++k)
    model.positions.emplace_back(0.2 * k, straight ? 0.0 : 0.02 * k * k,
                                 straight ? 0.0 : 0.1 * std::sin(0.7 * k));
  for (int k = 0; k < n; ++k)
    add_element(model, FeElementType::beam2, {k, k + 1}).reference =
        Vec3(0.1, straight ? 0.2 : 0.3 * k, 1.0);
  Mat3 J;
  J << 3, 0.2, 0.1, 0.2, 4, -0.3, 0.1, -0.3, 5;
  model.masses.push_back({1, 3.0, 1e-2 * J});
  if (straight) return model;
  int reference = 3;
  for (const Vec3& arm : {Vec3(0.0, 0.1, 0.15), Vec3(0.1, -0.05, 0.1)}) {
    add_spider(model, reference, {model.nodes()});
    model.positions.push_back(model.positions[reference] + arm);
    reference = model.nodes() - 1;
    model.masses.push_back({reference, 1.0 + arm.y(), 5e-3 * J});
  }
  return model;
}

/// Motion of a place: displacement and rotation vector.
struct Motion {
  Vec3 u, theta;
};

/// The kinetic energy of a part whose nodes move and turn as the body says, the angular velocity of
/// its frame w, its origin at rest.
class ExactPart {
 public:
  ExactPart(const FeModel& model, const FlexibleBody& body) : model_(model) {
    for (int k = 0; k < model.nodes(); ++k)
      for (const ModalNode& node : body.nodes)
        if (node.name == "n" + std::to_string(k)) nodes_.push_back(&node);
    leaders_.assign(model.positions.size(), -1);
    for (const Spider& s : model.spiders) leaders_[s.nodes[0]] = s.reference;
  }

  /// `twist`: rotation about x of second order at each node, a form of the modes; may be empty.
  double energy(const Vec3& w, const VecX& y, const VecX& ydot,
                const std::vector<MatX>& twist) const {
    double T = 0.0;
    const double h = 1e-4 / std::max(ydot.norm(), 1e-12) * y.norm();
    for (const FeElement& e : model_.elements) {
      const ElementInput in = gather(model_, e);
      static const LineRule rule = gauss_jacobi(6, 0);
      const double L = (in.p[1] - in.p[0]).norm();
      for (int g = 0; g < 6; ++g) {
        const double s = rule.u(g), line = in.material.density * rule.weight(g) * L;
        const BeamSection& c = in.section;
        const Mat3 A = beam_axes(in);
        const Mat3 J = line * A * Vec3(c.Iy + c.Iz, c.Iy, c.Iz).asDiagonal() * A.transpose();
        T += piece(w, line * c.A, J, in.p[0] + s * (in.p[1] - in.p[0]), h,
                   [&](double t) { return station(e, in, s, y + t * ydot, twist); });
      }
    }
    for (const PointMass& m : model_.masses)
      T += piece(w, m.mass, m.J, model_.positions[m.node], h,
                 [&](double t) { return motion(m.node, y + t * ydot, twist); });
    return T;
  }

 private:
  Motion motion(int k, const VecX& y, const std::vector<MatX>& twist) const {
    if (leaders_[k] >= 0) {
      Motion m = motion(leaders_[k], y, twist);
      const Vec3 arm = model_.positions[k] - model_.positions[leaders_[k]];
      m.u += rotation_exp(m.theta) * arm - arm;
      return m;
    }
    Motion m{nodes_[k]->X * y, nodes_[k]->X_theta * y};
    if (!twist.empty()) m.theta.x() += 0.5 * y.dot(twist[k] * y);
    return m;
  }

  Motion station(const FeElement& e, const ElementInput& in, double s, const VecX& y,
                 const std::vector<MatX>& twist) const {
    const double L = (in.p[1] - in.p[0]).norm();
    const Mat3 A = beam_axes(in);
    Vec3 q[4];
    for (int k = 0; k < 2; ++k) {
      const Motion m = motion(e.nodes[static_cast<std::size_t>(k)], y, {});
      q[2 * k] = A.transpose() * m.u;
      q[2 * k + 1] = A.transpose() * m.theta;
    }
    const double s2 = s * s, s3 = s2 * s;
    const double N[4] = {1 - 3 * s2 + 2 * s3, L * (s - 2 * s2 + s3), 3 * s2 - 2 * s3,
                         L * (s3 - s2)};
    const double D[4] = {6 * (s2 - s) / L, 1 - 4 * s + 3 * s2, 6 * (s - s2) / L, 3 * s2 - 2 * s};
    Vec3 u, theta;
    u(0) = (1 - s) * q[0](0) + s * q[2](0);
    theta(0) = (1 - s) * q[1](0) + s * q[3](0);
    u(1) = N[0] * q[0](1) + N[1] * q[1](2) + N[2] * q[2](1) + N[3] * q[3](2);
    u(2) = N[0] * q[0](2) - N[1] * q[1](1) + N[2] * q[2](2) - N[3] * q[3](1);
    theta(2) = D[0] * q[0](1) + D[1] * q[1](2) + D[2] * q[2](1) + D[3] * q[3](2);
    theta(1) = -(D[0] * q[0](2) - D[1] * q[1](1) + D[2] * q[2](2) - D[3] * q[3](1));
    Motion out{A * u, A * theta};
    if (!twist.empty())
      out.theta.x() +=
          0.5 * ((1 - s) * y.dot(twist[e.nodes[0]] * y) + s * y.dot(twist[e.nodes[1]] * y));
    return out;
  }

  /// Of a mass and an inertia at p; velocities by differences.
  template <class Move>
  static double piece(const Vec3& w, double mass, const Mat3& J, const Vec3& p, double h,
                      Move&& move) {
    const Motion now = move(0.0), before = move(-h), after = move(h);
    const Mat3 R = rotation_exp(now.theta);
    const Vec3 v = w.cross(p + now.u) + (after.u - before.u) / (2 * h);
    const Mat3 step = rotation_exp(after.theta) * rotation_exp(before.theta).transpose();
    const Vec3 spin = w + quaternion_log(Eigen::Quaterniond(step)) / (2 * h);
    return 0.5 * mass * v.squaredNorm() + 0.5 * spin.dot(R * J * R.transpose() * spin);
  }

  const FeModel& model_;
  std::vector<const ModalNode*> nodes_;
  std::vector<int> leaders_;
};

/// Remainders at e and e/2, over e^2.
void expect_cubic(const FeModel& model, const FlexibleBody& body, const SecondOrder& turning,
                  const std::vector<MatX>& twist) {
  const ExactPart exact(model, body);
  const int nm = body.modes();
  VecX y(nm), ydot(nm);
  for (int k = 0; k < nm; ++k) {
    y(k) = std::sin(1.0 + k) / (1.0 + k);
    ydot(k) = std::cos(2.0 + 3 * k) / (1.0 + k);
  }
  double size = 0.0;  // rotations of one
  for (const ModalNode& node : body.nodes) size = std::max(size, (node.X_theta * y).norm());
  y /= size;
  ydot *= 100.0 / size;
  const Vec3 w(60.0, -40.0, 80.0);
  double rest[2];
  for (int k = 0; k < 2; ++k) {
    const double e = k == 0 ? 0.02 : 0.01;
    const double T = exact.energy(w, e * y, e * ydot, twist);
    rest[k] = (T - energy_of(body.invariants, turning, w, e * y, e * ydot)) / (e * e);
    const double linear = T - energy_of(body.invariants, SecondOrder::zero(nm), w, e * y, e * ydot);
    EXPECT_GT(std::abs(linear) / (e * e), 20.0 * std::abs(rest[k]));
  }
  EXPECT_LT(std::abs(rest[1]), 0.55 * std::abs(rest[0]) + 1e-9);
}

SecondOrder without_twist(const FlexibleBody& body) {
  SecondOrder out = *body.turning;
  const SecondOrder& twist = *body.projection->twist;
  for (std::size_t j = 0; j < 3; ++j) {
    out.S2[j] -= twist.S2[j];
    for (std::size_t i = 0; i < 3; ++i) out.S2i[i][j] -= twist.S2i[i][j];
  }
  return out;
}

TEST(PartTurning, KineticEnergyOfWhatTurns) {
  const FeModel model = rotor(false);
  PartOptions options = all_nodes(model, 6);
  for (const ModeMethod method : {ModeMethod::craig_bampton, ModeMethod::free_free}) {
    options.method = method;
    const FlexibleBody body = reduce_part(model, options).body;
    ASSERT_TRUE(body.turning);
    expect_cubic(model, body, without_twist(body), {});
  }
}

/// The twist of second order of a straight shaft that starts at node 0, of all nodes:
///   theta2' = 1/2 (v' w'' - w' v'')
std::vector<MatX> twist_of(const FeModel& model, const FlexibleBody& body) {
  const auto nm = static_cast<Eigen::Index>(body.modes());
  std::vector<MatX> out = {MatX::Zero(nm, nm)};
  const LineRule rule = gauss_jacobi(4, 0);
  const double L = model.positions[1].x();
  for (std::size_t k = 0; k + 1 < model.positions.size(); ++k) {
    MatX sum = MatX::Zero(nm, nm);
    for (int g = 0; g < 4; ++g) {
      const double s = rule.u(g);
      const double D[4] = {6 * (s * s - s) / L, 1 - 4 * s + 3 * s * s, 6 * (s - s * s) / L,
                           3 * s * s - 2 * s};
      const double C[4] = {(12 * s - 6) / (L * L), (6 * s - 4) / L, (6 - 12 * s) / (L * L),
                           (6 * s - 2) / L};
      const auto field = [&](const double* shape, int u, int r, double sign) {
        VecX row = VecX::Zero(nm);
        for (std::size_t end = 0; end < 2; ++end) {
          const ModalNode& node = body.nodes[k + end];
          row += shape[2 * end] * node.X.row(u).transpose() +
                 sign * shape[2 * end + 1] * node.X_theta.row(r).transpose();
        }
        return row;
      };
      const VecX v1 = field(D, 1, 2, 1), v2 = field(C, 1, 2, 1);
      const VecX w1 = field(D, 2, 1, -1), w2 = field(C, 2, 1, -1);
      const MatX half = 0.5 * rule.weight(g) * L * (v1 * w2.transpose() - w1 * v2.transpose());
      sum += half + half.transpose();
    }
    out.emplace_back(out.back() + sum);
  }
  return out;
}

TEST(PartTurning, TwistOfAShaftBentInTwoPlanes) {
  const FeModel model = rotor(true);
  PartOptions options = all_nodes(model, 8);
  options.reference = {BodyReference::Kind::node, "n0"};
  const FlexibleBody body = reduce_part(model, options).body;
  const std::vector<MatX> twist = twist_of(model, body);
  ASSERT_GT(twist.back().cwiseAbs().maxCoeff(), 1e-3);
  // At the nodes.
  for (std::size_t k = 1; k < body.nodes.size(); ++k)
    EXPECT_LT((body.second_order->nodes[k].theta[0] - twist[k]).norm(), 1e-8 * twist[k].norm())
        << k << "\n"
        << body.second_order->nodes[k].theta[0] << "\n\n"
        << twist[k];
  expect_cubic(model, body, *body.turning, twist);
  // Stiffening does not count it again: it is what axial forces work on.
  MatX all = MatX::Zero(body.modes(), body.modes());
  for (std::size_t i = 1; i < 3; ++i) all += body.second_order->S2i[i][3 - i];
  EXPECT_LT(all.norm(), 1e-9 * body.turning->S2i[1][2].norm());
}

/// The matrices of (theta x (theta x arm))_j.
std::array<MatX, 3> circle(const MatX& theta, const Vec3& arm) {
  std::array<MatX, 3> out;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const MatX mixed = 0.5 * theta.row(j).transpose() * (arm.transpose() * theta);
    out[static_cast<std::size_t>(j)] =
        mixed + mixed.transpose() - arm(j) * theta.transpose() * theta;
  }
  return out;
}

// The points of the projection method hold what the integrals have beside the twist.
TEST(PartTurning, ProjectionDataHoldTheSame) {
  FeModel model = rotor(false);
  // A beam between arms of two nodes: its sections are fixed to both.
  add_spider(model, 2, {model.nodes()});
  model.positions.push_back(model.positions[2] + Vec3(0.0, -0.1, 0.12));
  FeElement beside = model.elements[0];
  beside.nodes = {5, model.nodes() - 1};
  model.elements.push_back(beside);
  const FlexibleBody body = reduce_part(model, all_nodes(model, 6)).body;
  const ProjectionData& data = *body.projection;
  SecondOrder sum = SecondOrder::zero(body.modes());
  for (const ProjectionData::TurningPoint& t : data.turning) {
    Vec3 first = Vec3::Zero();
    double mass = 0.0;
    for (SparseRows::InnerIterator it(data.M_s, t.point); it; ++it) {
      mass += it.value();
      first += it.value() * data.p.col(it.col());
    }
    const auto h = circle(data.rotations.middleRows<3>(3 * t.rotation), t.arm);
    for (std::size_t j = 0; j < 3; ++j) {
      sum.S2[j] += mass * h[j];
      for (std::size_t i = 0; i < 3; ++i)
        sum.S2i[i][j] += first(static_cast<Eigen::Index>(i)) * h[j];
    }
  }
  const SecondOrder expected = without_twist(body);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_LT((sum.S2[j] - expected.S2[j]).norm(), 1e-10);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((sum.S2i[i][j] - expected.S2i[i][j]).norm(), 1e-9 * (1.0 + sum.S2i[i][j].norm()));
  }
}

// A marker on a node that is fixed to another one moves on a circle about that.
TEST(PartTurning, MarkersOnRigidArms) {
  const FeModel model = rotor(false);
  const FlexibleBody body = reduce_part(model, all_nodes(model, 6)).body;
  const auto place = [&](const std::string& name) {
    for (std::size_t k = 0; k < body.nodes.size(); ++k)
      if (body.nodes[k].name == name) return k;
    return body.nodes.size();
  };
  const std::size_t hub = place("n3"), tip = place("n6");
  const SecondOrderNode &a = body.second_order->nodes[hub], &b = body.second_order->nodes[tip];
  const Vec3 arm = body.nodes[tip].p - body.nodes[hub].p;
  const auto h = circle(body.nodes[hub].X_theta, arm);
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
    const MatX turned = arm(static_cast<Eigen::Index>(l)) * a.theta[k] -
                        arm(static_cast<Eigen::Index>(k)) * a.theta[l];
    EXPECT_LT((b.h[j] - a.h[j] - turned - h[j]).norm(), 1e-8 * b.h[j].norm()) << j;
    EXPECT_LT((b.theta[j] - a.theta[j]).norm(), 1e-8 * a.theta[j].norm()) << j;
    EXPECT_GT(h[j].norm(), 0.01 * b.h[j].norm());
  }
}

// Of solids nothing turns with the nodes, with rigid interfaces too.
TEST(PartTurning, SolidsHaveNone) {
  const FlexibleBody body = reduce_part(brick_beam(6, 1, 1, 0.6, 0.03), both_ends(4)).body;
  EXPECT_FALSE(body.turning);
  EXPECT_TRUE(body.second_order);
}

}  // namespace
}  // namespace floatframe::test

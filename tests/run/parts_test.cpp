// Reduced solid parts in motion: a connecting rod that tumbles freely, described in three body
// frames; a falling beam of bricks against CalculiX's geometrically nonlinear run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/start/initial_state.hpp"
#include "support/descriptions.hpp"
#include "support/fe_parts.hpp"
#include "support/figures.hpp"
#include "support/random_model.hpp"
#include "support/trajectory_models.hpp"

namespace floatframe::test {
namespace {

OutputDescription node_output(const std::string& body, const std::string& node, int axis) {
  return make_output(fmt::format("{}.{}", node, axis), {body, Vec3::Zero(), node, {}}, axis);
}

// ---------------------------------------------------------------------------------------------
// Tumbling connecting rod

constexpr double rod_length = 0.14;  // between the bores [m]

/// The connecting rod with 12 modes in one of the body frames; a pin of 0.2 kg at the small end
/// keeps the mean axes and Buckens' frame apart.
const ReducedPart& rod(BodyReference::Kind kind) {
  static std::map<BodyReference::Kind, ReducedPart> known;
  const auto it = known.find(kind);
  if (it != known.end()) return it->second;
  FeModel model = steel_part("conrod_coarse_mesh.inp.gz", "mm-t-s");
  const InterfaceDescription small = bore("SMALL_END", Vec3(0.14, 0.0, 0.0));
  InterfaceDescription spider = small;  // the interface is the spider that holds the pin
  spider.name = "pin";
  const int pin = add_interface(model, spider);
  model.masses.push_back({pin, 0.2, Mat3::Zero()});
  PartOptions options;
  options.interfaces = {bore("BIG_END", Vec3::Zero()), small};
  options.modes = 6;
  options.reference.kind = kind;
  if (kind == BodyReference::Kind::node) options.reference.node = "BIG_END";
  options.check_free_modes = options.stresses = false;
  options.keep_projection = true;
  return known.emplace(kind, reduce_part(std::move(model), options)).first->second;
}

/// Initial velocity of the free body: a rigid motion about its origin and rates of the amplitudes.
struct Launch {
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();
  VecX rates;
};

/// The velocity field `field` (3 rows per node) as rigid motion and amplitude rates of a part;
/// `residual`: what of it the part's modes cannot represent, relative.
Launch represent(const ReducedPart& part, const VecX& field, double& residual) {
  const ProjectionData& mesh = *part.body.projection;
  const int n = mesh.nodes();
  MatX A(3 * n, 6 + mesh.X.cols());
  for (int k = 0; k < n; ++k) {
    A.block<3, 3>(3 * k, 0).setIdentity();
    A.block<3, 3>(3 * k, 3) = -skew(Vec3(mesh.p.col(k)));
  }
  A.rightCols(mesh.X.cols()) = mesh.X;
  // Columns of one size: the modes and the rigid motions differ by orders of magnitude.
  const VecX scale = A.colwise().norm().cwiseInverse();
  const MatX scaled = A * scale.asDiagonal();
  const VecX x = scale.asDiagonal() * qr_solve(scaled, field);
  residual = (A * x - field).norm() / field.norm();
  return {x.head<3>(), x.segment<3>(3), x.tail(mesh.X.cols())};
}

/// Field of the lowest elastic free mode, largest displacement 1.
VecX lowest_mode_field() {
  const ReducedPart& part = rod(BodyReference::Kind::mean_axis);
  const InertiaInvariants& v = part.body.invariants;
  const MatX M = v.Sij[0][0] + v.Sij[1][1] + v.Sij[2][2];
  const VecX field = part.body.projection->X * generalised_eigen(part.body.K, M).vectors.col(0);
  return field / field.cwiseAbs().maxCoeff();
}

struct Tumble {
  Vec3 big_end, small_end;                           ///< at the end of the run [m]
  double energy = 0.0, linear = 0.0, angular = 0.0;  ///< relative drift
};

const Vec3 spin(20.0, 150.0, 60.0);            // [rad/s]
const Vec3 flight(0.5, -0.3, 2.0);             // [m/s]
constexpr double omega = 2.0 * M_PI * 1600.0;  // about that of the lowest mode [rad/s]

/// Angular momentum about the world's origin and linear momentum.
void momenta(const RelativeFormulation& f, const State& s, const FlexibleBody& body, Vec3& linear,
             Vec3& angular) {
  const InertiaInvariants& v = body.invariants;
  const int nm = v.modes();
  const VecX y = s.q.tail(nm), yd = s.v.tail(nm);
  const BodyKinematics& b = f.motion().body(0);
  const Mat3& A = b.R_WB;
  const Vec3 &r0 = b.p_WB, &v0 = b.v_WB, &w = b.w_WB;
  const Vec3 m_bar = v.m_u + v.S * y;  // (29)
  Mat3 P_bar = v.P_u, rate = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double linear_part = v.Si[i].row(j).dot(y) + v.Si[j].row(i).dot(y);
      P_bar(i, j) += linear_part + y.dot(v.Sij[i][j] * y);            // (33)
      rate(i, j) = v.Si[i].row(j).dot(yd) + y.dot(v.Sij[i][j] * yd);  // (38)
    }
  }
  const Mat3 J_bar = P_bar.trace() * Mat3::Identity() - P_bar;  // (21)
  const Vec3 relative(rate(1, 2) - rate(2, 1), rate(2, 0) - rate(0, 2), rate(0, 1) - rate(1, 0));
  linear = v.m * v0 + w.cross(A * m_bar) + A * (v.S * yd);
  angular = r0.cross(linear) + (A * m_bar).cross(v0) + A * (J_bar * (A.transpose() * w) + relative);
}

/// Flies for `duration` from rest in the undeformed shape, with the lowest mode set off to an
/// amplitude of `amplitude` [m].
Tumble tumble(BodyReference::Kind kind, double amplitude, double step, double duration) {
  static const VecX field = lowest_mode_field();
  const ReducedPart& part = rod(kind);
  double residual = 0.0;
  const Launch start = represent(part, amplitude * omega * field, residual);
  EXPECT_LT(residual, 1e-8) << "the frames share one space of shapes";
  ModelDescription d;
  d.gravity.setZero();
  d.bodies = {make_body("rod", part.body)};
  JointDescription j = make_joint("joint", JointType::free, "ground", "rod");
  // The joint's displacement is that of the node at the origin, the big end; its rotation is the
  // frame's.
  const Vec3 v = flight + start.v + part.body.nodes.front().X * start.rates;
  const Vec3 w = spin + start.w;
  j.velocity = {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
  d.joints.push_back(j);
  d.amplitude_rates["rod"] = start.rates;
  for (const char* node : {"BIG_END", "SMALL_END"})
    for (int axis = 0; axis < 3; ++axis) d.outputs.push_back(node_output("rod", node, axis));
  const Model model = build_model(d);
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  const StepOptions options{.tolerance = 1e-14,
                            .penalty_mass = default_penalty_mass(model, Coordinates::relative)};
  State s = relative_start(f, Start::given);
  start_accelerations(f, s, options.penalty_mass);
  evaluate_at(f, 0.0, s.q, s.v);
  Vec3 p0, h0, p1, h1;
  momenta(f, s, part.body, p0, h0);
  const double e0 = f.kinetic_energy(s.v) + elastic_energy(f.motion());
  AugmentedLagrangian<RelativeFormulation> integrator(f, options);
  Tumble t;
  const long steps = std::lround(duration / step);
  for (long k = 0; k < steps; ++k) {
    const StepAttempt r = integrator.attempt(s, step);
    if (!r.accepted()) {
      ADD_FAILURE() << "step " << k;
      return t;
    }
    if ((k + 1) % std::max(1l, steps / 16) != 0) continue;
    evaluate_at(f, s.t, s.q, s.v);
    momenta(f, s, part.body, p1, h1);
    const double e1 = f.kinetic_energy(s.v) + elastic_energy(f.motion());
    t.energy = std::max(t.energy, std::abs(e1 / e0 - 1.0));
    t.linear = std::max(t.linear, (p1 - p0).norm() / p0.norm());
    t.angular = std::max(t.angular, (h1 - h0).norm() / h0.norm());
    evaluate_at(f, s.t, s.q, s.v);
  }
  const auto place = [&](std::size_t first) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = f.motion().place(model.outputs[first].marker)[axis];
    return p;
  };
  t.big_end = place(0);
  t.small_end = place(3);
  return t;
}

TEST(TumblingRod, BodyFramesDifferAtSecondOrderOfTheDeformation) {
  using Kind = BodyReference::Kind;
  const double step = 5e-7, duration = 1.5e-3;
  const auto difference = [&](Kind a, Kind b, double amplitude) {
    const Tumble x = tumble(a, amplitude, step, duration), y = tumble(b, amplitude, step, duration);
    return std::max((x.big_end - y.big_end).norm(), (x.small_end - y.small_end).norm());
  };
  const std::pair<Kind, Kind> pairs[] = {
      {Kind::node, Kind::mean_axis}, {Kind::node, Kind::buckens}, {Kind::mean_axis, Kind::buckens}};
  const char* names[] = {"node - mean axis", "node - Buckens", "mean axis - Buckens"};
  for (std::size_t k = 0; k < 3; ++k) {
    double previous = 0.0;
    for (const double ratio : {0.02, 0.01, 0.005}) {
      const double d = difference(pairs[k].first, pairs[k].second, ratio * rod_length);
      figure(fmt::format("{}, amplitude {} of the length, difference [m]", names[k], ratio), d);
      if (previous > 0.0) {
        EXPECT_GT(std::log2(previous / d), 1.8) << names[k];
        EXPECT_LT(std::log2(previous / d), 2.2) << names[k];
      }
      previous = d;
    }
    const double small = difference(pairs[k].first, pairs[k].second, 1e-6 * rod_length);
    figure(fmt::format("{}, amplitude 1e-6 of the length, difference [m]", names[k]), small);
    EXPECT_LT(small, 1e-9) << names[k];
  }
}

TEST(TumblingRod, EnergyAndMomentaDriftWithTheSquareOfTheStep) {
  using Kind = BodyReference::Kind;
  const char* names[] = {"mean axis", "Buckens", "node"};
  const Kind kinds[] = {Kind::mean_axis, Kind::buckens, Kind::node};
  for (std::size_t k = 0; k < 3; ++k) {
    Tumble last;
    for (const double step : {4e-6, 2e-6, 1e-6}) {
      const Tumble t = tumble(kinds[k], 0.005 * rod_length, step, 4e-3);
      figure(fmt::format("{}, step {} s, energy drift", names[k], step), t.energy);
      figure(fmt::format("{}, step {} s, linear momentum drift", names[k], step), t.linear);
      figure(fmt::format("{}, step {} s, angular momentum drift", names[k], step), t.angular);
      if (step < 4e-6) {
        // What is conserved to rounding has no order.
        EXPECT_LT(t.energy, last.energy / 3.4 + 1e-11) << names[k];
        EXPECT_LT(t.linear, last.linear / 3.4 + 1e-11) << names[k];
        EXPECT_LT(t.angular, last.angular / 3.4 + 1e-11) << names[k];
      }
      last = t;
    }
  }
}

// ---------------------------------------------------------------------------------------------
// Falling beam: 1 m x 20 mm x 20 mm, 40 bricks, hinged at one end, released from horizontal

double pendulum_deviation(double young, const std::string& reference, BodyReference::Kind kind,
                          bool stiffening = false) {
  FeModel model = steel_part("pend_c3d20r_mesh.inp.gz", "m-kg-s");
  model.materials[0].young = young;
  PartOptions options;
  options.interfaces = {bore("END_A", Vec3::Zero()), bore("END_B", Vec3(1.0, 0.0, 0.0))};
  MarkerDescription middle;
  middle.name = middle.choice.set = "MID";
  options.markers = {middle};
  options.modes = 6;
  options.reference.kind = kind;
  if (kind == BodyReference::Kind::node) options.reference.node = "END_A";
  options.check_free_modes = options.stresses = false;

  ModelDescription d;
  d.bodies = {make_body("beam", reduce_part(std::move(model), options).body)};
  d.joints = {
      make_joint("hinge", JointType::revolute, "ground", "beam", Vec3::Zero(), Vec3::UnitY())};
  d.joints[0].child.node = "END_A";
  for (const char* node : {"END_B", "MID"})
    for (const int axis : {0, 2}) d.outputs.push_back(node_output("beam", node, axis));
  d.simulation.geometric_stiffening = stiffening;
  d.simulation.step = 5e-4;
  d.simulation.duration = 1.0;
  d.simulation.output_interval = 0.01;
  const RunResult r = completed_run(d);
  const trajectories::Csv csv =
      trajectories::read_csv(std::string(FLOATFRAME_TEST_DATA) + "/fe/" + reference);
  double worst = 0.0;
  for (std::size_t i = 0; i < csv.rows.size() && i + 1 < r.table.rows(); ++i) {
    EXPECT_NEAR(csv.rows[i][0], r.table.at(i + 1, 0), 1e-9);
    for (std::size_t point = 0; point < 2; ++point) {
      const double dx = r.table.at(i + 1, 1 + 2 * point) - r.table.at(0, 1 + 2 * point) -
                        csv.rows[i][1 + 2 * point];
      const double dz = r.table.at(i + 1, 2 + 2 * point) - csv.rows[i][2 + 2 * point];
      worst = std::max(worst, std::hypot(dx, dz));
    }
  }
  EXPECT_EQ(csv.rows.size(), 100u);
  return worst;
}

// Steel bends by 0.07 mm: linear modes are enough. Source: CalculiX 2.20, *DYNAMIC, NLGEOM, 10
// B32R; its runs agree among each other to 2e-4 m.
TEST(FallingBeam, SteelFollowsTheNonlinearRun) {
  for (const auto kind : {BodyReference::Kind::node, BodyReference::Kind::mean_axis}) {
    const double d = pendulum_deviation(2.1e11, "pendulum_steel.csv", kind);
    figure("steel beam, largest deviation [m]", d);
    EXPECT_LT(d, 2e-4);
  }
}

// A hundredth of the stiffness bends by 7 mm: linear modes stretch the beam as it bends and miss
// the geometric stiffening. The lower bound says that this limit is there.
TEST(FallingBeam, SoftBeamShowsTheLimitOfLinearModes) {
  for (const auto kind : {BodyReference::Kind::node, BodyReference::Kind::mean_axis}) {
    const double d = pendulum_deviation(2.1e9, "pendulum_soft.csv", kind);
    figure("soft beam, largest deviation [m]", d);
    EXPECT_LT(d, 8e-3);
    EXPECT_GT(d, 1e-3);
  }
}

TEST(FallingBeam, SoftBeamWithGeometricStiffeningFollowsTheNonlinearRun) {
  for (const auto kind : {BodyReference::Kind::node, BodyReference::Kind::mean_axis}) {
    const double d = pendulum_deviation(2.1e9, "pendulum_soft.csv", kind, true);
    figure("soft beam, stiffened, largest deviation [m]", d);
    EXPECT_LT(d, 8e-4);
  }
}

}  // namespace
}  // namespace floatframe::test

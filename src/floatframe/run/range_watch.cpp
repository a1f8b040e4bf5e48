#include "floatframe/run/range_watch.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <set>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/body/surface_points.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/vector_text.hpp"

namespace floatframe {
namespace {

double largest_column(const Mat3X& X, Eigen::Index k) { return X.col(k).norm(); }

/// Lowest angular frequency of K x = w^2 M x, also with modes without mass: M x = (1/w^2) K x.
/// `mode` gets its x, with x^T K x = 1.
double lowest_frequency_of(const FlexibleBody& body, VecX& mode) {
  if (body.modes() == 0) return 0.0;
  const MatX M = modal_mass(body.invariants);
  const SymmetricEigen inverse = generalised_eigen(M, body.K);
  if (!inverse.found) return 0.0;
  Eigen::Index which = 0;
  const double most = inverse.values.maxCoeff(&which);
  mode = inverse.vectors.col(which);
  return most > 0.0 && std::isfinite(most) ? 1.0 / std::sqrt(most) : 0.0;
}

/// Second moments of the mass about its centre [kg m2].
Mat3 central_moments(const InertiaInvariants& v) {
  const Vec3 c = v.centre_of_mass();
  return v.P_u - v.m * c * c.transpose();
}

/// For unit spins about the columns of E: the fraction that changes the stiffness of the body, 0 or
/// 1. Sections of a shaft that spins about its axis are rigid: this spin loads nothing.
Vec3 stiffening_directions(const FlexibleBody& body, const Mat3& E) {
  if (!body.second_order) return Vec3::Ones();
  Vec3 size;
  for (int k = 0; k < 3; ++k) {
    const Mat3 G = E.col(k) * E.col(k).transpose() - Mat3::Identity();
    MatX K_G = MatX::Zero(body.modes(), body.modes());
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) K_G += G(j, i) * body.second_order->S2i[i][j];
    size[k] = K_G.norm();
  }
  return (size.array() > 1e-3 * size.maxCoeff()).select(Vec3::Ones(), Vec3::Zero());
}

}  // namespace

BodyRange::BodyRange(const Model& model, int index) : data_(*model.bodies[index].data) {
  if (data_.modes() == 0) return;
  const Mat3 P = central_moments(data_.invariants);
  if (data_.invariants.m > 0.0 && P.trace() > 0.0) {
    size_ = 2.0 * std::sqrt(P.trace() / data_.invariants.m);
    // Spin w causes the load int |w x u|^2 dm = w^T (tr(P) I - P) w.
    const Mat3 pull = (P.trace() * Mat3::Identity() - P) / P.trace();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(pull);
    const Mat3 E = solver.eigenvectors();
    const Vec3 stretch = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    stretch_ =
        E * stretch.cwiseProduct(stiffening_directions(data_, E)).asDiagonal() * E.transpose();
  }
  if (!data_.nodes.empty()) {
    Vec3 low = data_.nodes.front().p, high = low;
    for (const ModalNode& n : data_.nodes) {
      low = low.cwiseMin(n.p);
      high = high.cwiseMax(n.p);
    }
    size_ = std::max(size_, (high - low).norm());
  }
  VecX mode;
  lowest_ = lowest_frequency_of(data_, mode);
  if (!model.bodies[index].stiffens()) softened_ = lowest_;
  if (lowest_ > 0.0 && data_.second_order) estimate_stiffening(mode);
  choose_nodes(model, index);
}

/// K_G of a spin w e: w^2 sum S2i_ij (e e^T - 1)_ji.
void BodyRange::estimate_stiffening(const VecX& mode) {
  Mat3 q;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) q(i, j) = mode.dot(data_.second_order->S2i[i][j] * mode);
  const Mat3 pull = 0.5 * (q + q.transpose()) - q.trace() * Mat3::Identity();
  const double most = Eigen::SelfAdjointEigenSolver<Mat3>(pull).eigenvalues().maxCoeff();
  stiffening_ = std::max(0.0, most / mode.dot(data_.K * mode));
}

void BodyRange::choose_nodes(const Model& model, int index) {
  std::set<int> chosen;
  for (const Marker& m : model.markers)
    if (m.body == index && m.node >= 0) chosen.insert(m.node);
  for (std::size_t n = 0; n < data_.nodes.size(); ++n)
    if (is_surface_point(data_.nodes[n])) chosen.insert(static_cast<int>(n));
  displaced_ = rotated_ = VecX::Zero(data_.modes());
  for (Eigen::Index k = 0; k < data_.modes(); ++k) {
    int moves = -1, turns = -1;
    for (std::size_t n = 0; n < data_.nodes.size(); ++n) {
      const double move = largest_column(data_.nodes[n].X, k);
      const double turn = largest_column(data_.nodes[n].X_theta, k);
      if (move > displaced_[k]) {
        displaced_[k] = move;
        moves = static_cast<int>(n);
      }
      if (turn > rotated_[k]) {
        rotated_[k] = turn;
        turns = static_cast<int>(n);
      }
    }
    if (moves >= 0) chosen.insert(moves);
    if (turns >= 0) chosen.insert(turns);
  }
  nodes_.assign(chosen.begin(), chosen.end());
}

std::string BodyRange::node_name(int node) const {
  if (node < 0 || static_cast<std::size_t>(node) >= data_.nodes.size()) return "";
  const ModalNode& n = data_.nodes[node];
  if (is_surface_point(n)) return "the surface point at " + vector_text(n.p, 4) + " m";
  return "node " + (n.name.empty() ? std::to_string(node + 1) : "'" + n.name + "'");
}

void BodyRange::observe(double t, double h, const Vec3& w, const double* y,
                        const RangeLimits& l) noexcept {
  assert(h > 0.0 && (y || data_.modes() == 0));
  turn_.offer(h * w.norm(), t, l.turn);
  const Eigen::Index modes = data_.modes();
  if (modes == 0) return;
  if (softened_ > 0.0) spin_.offer(loading_spin(w), t, l.spin * softened_);
  // All modes together move no node farther than the sum of each: single nodes are checked only if
  // that sum could be a new largest value.
  double move = 0.0, turn = 0.0;
  for (Eigen::Index k = 0; k < modes; ++k) {
    move += displaced_[k] * std::abs(y[k]);
    turn += rotated_[k] * std::abs(y[k]);
  }
  if (move <= displacement_.value && turn <= rotation_.value) return;
  for (const int n : nodes_) {
    const ModalNode& node = data_.nodes[n];
    Vec3 u = Vec3::Zero(), theta = Vec3::Zero();
    for (Eigen::Index k = 0; k < modes; ++k) {
      u += y[k] * node.X.col(k);
      theta += y[k] * node.X_theta.col(k);
    }
    if (u.norm() > displacement_.value) displacement_.node = n;
    if (theta.norm() > rotation_.value) rotation_.node = n;
    displacement_.offer(u.norm(), t, l.displacement * size_);
    rotation_.offer(theta.norm(), t, l.rotation);
  }
}

double BodyRange::displacement_now(const double* y) const noexcept {
  assert(y || data_.modes() == 0);
  const Eigen::Index modes = data_.modes();
  double most = 0.0;
  for (const int n : nodes_) {
    const double* x = data_.nodes[static_cast<std::size_t>(n)].X.data();
    double u[3] = {0.0, 0.0, 0.0};
    for (Eigen::Index k = 0; k < modes; ++k, x += 3)
      for (int c = 0; c < 3; ++c) u[c] += y[k] * x[c];
    most = std::max(most, u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  }
  return std::sqrt(most);
}

double BodyRange::displacement_of_one_mode(const double* y) const noexcept {
  assert(y || data_.modes() == 0);
  double most = 0.0;
  for (Eigen::Index k = 0; k < data_.modes(); ++k)
    most = std::max(most, displaced_[k] * std::abs(y[k]));
  return most;
}

double PhaseMeter::energy() const noexcept {
  return count_ > 0 ? 0.5 * mass_ * spread_ / static_cast<double>(count_) : 0.0;
}

double PhaseMeter::speed() const noexcept {
  return count_ > 0 ? std::sqrt(std::max(0.0, spread_) / static_cast<double>(count_)) : 0.0;
}

double PhaseMeter::phase() const noexcept {
  if (!(spread_ > 0.0)) return 0.0;
  return std::acos(std::clamp(1.0 - changes_ / (2.0 * spread_), -1.0, 1.0));
}

TurnWatch::TurnWatch(const Model& model, double step) : model_(model), step_(step) {
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& force = model.elements[k];
    const bool counts = force.counts_turns();
    if (!counts && !ends_at_half_turn(force)) continue;
    Watched x;
    x.force = static_cast<int>(k);
    x.counts = counts;
    watched_.push_back(x);
  }
}

void TurnWatch::warn(std::vector<RangeWarning>& out) const {
  const Watched* first = nullptr;
  int others = -1;
  for (const Watched& x : watched_) {
    if (x.first < 0.0) continue;
    ++others;
    if (first == nullptr || x.first < first->first) first = &x;
  }
  if (first == nullptr) return;
  const Element& force = model_.elements[first->force];
  const std::string who = fmt::format("{} '{}'{}", element_type_name(force.type), force.name,
                                      others > 0 ? fmt::format(" (and {} more)", others) : "");
  if (first->counts) {
    out.push_back({RangeLimit::half_turn,
                   fmt::format("{} turns by more than half a turn in one step of {:g} s at t = "
                               "{:.4g} s ({:.3g} rad at most) and so loses count of its turns; "
                               "take a step of at most {:.2g} s",
                               who, step_, first->first, first->most,
                               0.5 * step_ * std::numbers::pi / first->most)});
    return;
  }
  out.push_back(
      {RangeLimit::half_turn,
       fmt::format("{} has turned past half a turn at t = {:.4g} s: the rotation vector that its "
                   "laws are of jumps there to the other side, and its moments with it; what turns "
                   "further needs a joint_spring on a revolute joint, which counts turns, or, for "
                   "dampers alone, rotation_rate: angular_velocity",
                   who, first->first)});
}

RangeWatch::RangeWatch(const Model& model, double step, const RangeLimits& limits)
    : model_(model), step_(step), limits_(limits), turns_(model, step) {
  assert(step > 0.0);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    bodies_.emplace_back(model, static_cast<int>(i));
    const InertiaInvariants& v = model.bodies[i].data->invariants;
    const double turning = v.inertia_about_centre().trace() / 3.0;
    std::vector<PhaseMeter> meters{PhaseMeter(v.m), PhaseMeter(std::max(0.0, turning))};
    const MatX M_ff = modal_mass(v);
    for (Eigen::Index k = 0; k < v.modes(); ++k) meters.emplace_back(M_ff(k, k));
    meters_.push_back(std::move(meters));
  }
}

double RangeWatch::noise() const noexcept {
  double mass = 0.0;
  for (const Body& b : model_.bodies) mass += b.data->invariants.m;
  return 0.5 * mass * least_motion * least_motion / (step_ * step_);
}

}  // namespace floatframe

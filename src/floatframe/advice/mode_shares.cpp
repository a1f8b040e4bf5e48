#include "floatframe/advice/mode_shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {
namespace {

/// M_ff - M_fr M_rr^-1 M_rf: the modal mass of a body that is free to recoil.
MatX recoil_mass(const InertiaInvariants& v) {
  const MatX M = mass_matrix_at_rest(v);
  const Mat6 M_rr = M.topLeftCorner<6, 6>();
  const MatX M_rf = M.topRightCorner(6, v.modes());
  // A thin rod has no inertia about its axis: the least-norm solution leaves that rotation zero.
  return modal_mass(v) - M_rf.transpose() * LeastNorm(M_rr, 1e-12).solve(M_rf);
}

double frequency_of(double stiffness, double mass) {
  if (!(stiffness > 0.0)) return 0.0;
  if (!(mass > 0.0)) return std::numeric_limits<double>::infinity();
  return hertz(std::sqrt(stiffness / mass));
}

/// K x = omega^2 M x with a mass matrix that need not be definite: M x = (1 / omega^2) K x.
VecX frequencies(const MatX& K, const MatX& M) {
  const SymmetricEigen inverse = generalised_eigenvalues(M, K);
  VecX f = VecX::Constant(K.rows(), std::numeric_limits<double>::infinity());
  if (!inverse.found) return f;
  const double least = 1e-14 * inverse.values.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < f.size(); ++k)
    if (inverse.values[k] > least) f[k] = hertz(1.0 / std::sqrt(inverse.values[k]));
  std::sort(f.begin(), f.end());
  return f;
}

/// Markers through which joints and elements act on a body; outputs do not load it.
std::set<int> loaded_markers(const Model& model, int body) {
  std::set<int> markers;
  const auto add = [&](int m) {
    if (m >= 0 && model.markers[m].body == body) markers.insert(m);
  };
  for (const Joint& j : model.joints) add(j.frame_F), add(j.frame_M);
  for (const Element& e : model.elements)
    for (const int marker : e.markers) add(marker);
  return markers;
}

/// One column for each unit load.
MatX unit_loads(const Model& model, int index) {
  const Body& body = model.bodies[index];
  std::vector<VecX> columns;
  for (const int m : loaded_markers(model, index)) {
    const Marker& marker = model.markers[m];
    if (marker.node < 0) continue;
    const ModalNode& node = body.data->nodes[marker.node];
    const Mat3X X = node.X - skew(marker.X_NM.p) * node.X_theta;
    for (int i = 0; i < 3; ++i) columns.emplace_back(X.row(i).transpose());
    if (!marker.rotates) continue;
    for (int i = 0; i < 3; ++i) columns.emplace_back(node.X_theta.row(i).transpose() / body.length);
  }
  MatX loads(body.modes(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    loads.col(static_cast<Eigen::Index>(k)) = columns[k];
  return loads;
}

/// The share of each amplitude in the strain energy of the states in the columns of `y`.
VecX shares(const MatX& K, const MatX& K_inverse, const MatX& y) {
  const double all = (K * y).cwiseProduct(y).sum();
  VecX share = VecX::Zero(K.rows());
  for (Eigen::Index k = 0; k < K.rows(); ++k)
    if (all > 0.0 && K_inverse(k, k) > 0.0)
      share[k] = y.row(k).squaredNorm() / (K_inverse(k, k) * all);
  return share;
}

}  // namespace

BodyAdvice body_advice(const Model& model, int index, const MatX& y, const VecX& times, double h) {
  const Body& body = model.bodies[index];
  const FlexibleBody& data = *body.data;
  const MatX M = modal_mass(data.invariants), M_free = recoil_mass(data.invariants);
  const MatX K_inverse = LeastNorm(data.K).pseudo_inverse();
  const VecX static_shares = shares(data.K, K_inverse, K_inverse * unit_loads(model, index));
  const VecX dynamic_shares = shares(data.K, K_inverse, y);
  BodyAdvice advice;
  advice.body = index;
  advice.name = body.name;
  advice.free_frequencies = frequencies(data.K, M_free);
  for (int k = 0; k < body.modes(); ++k) {
    ModeAdvice m;
    m.mode = k;
    const std::size_t n = k;
    m.name = n < data.mode_names.size() ? data.mode_names[n] : "mode " + std::to_string(k + 1);
    m.frequency = frequency_of(data.K(k, k), M(k, k));
    m.free_frequency = frequency_of(data.K(k, k), std::max(M_free(k, k), 1e-12 * M(k, k)));
    m.step_phase = omega_of(m.free_frequency) * h;
    m.static_share = static_shares[k];
    m.dynamic_share = dynamic_shares[k];
    const auto series = y.row(k);
    const Eigen::Index count = series.size();
    if (count > 0) {
      m.rms = std::sqrt(series.squaredNorm() / static_cast<double>(count));
      m.peak = series.cwiseAbs().maxCoeff();
      const double mean = series.mean();
      double kinetic = 0.0, strain = 0.0;
      for (Eigen::Index t = 1; t < count; ++t) {
        const double dt = times[t] - times[t - 1];
        if (!(dt > 0.0)) continue;
        const double rate = (series[t] - series[t - 1]) / dt;
        const double middle = 0.5 * (series[t] + series[t - 1]) - mean;
        kinetic += M(k, k) * rate * rate * dt;
        strain += data.K(k, k) * middle * middle * dt;
      }
      m.kinetic_ratio = strain > 0.0 ? kinetic / strain : 0.0;
    }
    advice.modes.push_back(std::move(m));
  }
  return advice;
}

}  // namespace floatframe

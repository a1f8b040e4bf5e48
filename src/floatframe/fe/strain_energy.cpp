#include "floatframe/fe/strain_energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {
namespace {

constexpr int many_beams = 1000;

/// Calls `use(q, Ke q)` with the deformations of each element, one column per shape.
template <class Use>
void each_element(const FeModel& model, const MatX& U, const MatX& Theta, Integration integration,
                  Use&& use) {
  MatX Ke, q, f;
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    const ElementInput in = gather(model, e, integration);
    kernel.stiffness(in, Ke);
    const int d = kernel.dofs_per_node, n = kernel.nodes;
    q.resize(d * n, U.cols());
    Mat3X u = Mat3X::Zero(3, U.cols()), w = u;
    Vec3 centre = Vec3::Zero();
    for (int k = 0; k < n; ++k) {
      const Eigen::Index row = 3 * e.nodes[k];
      u += U.middleRows<3>(row) / n;
      if (d == 6) w += Theta.middleRows<3>(row) / n;
      centre += in.p[k] / n;
    }
    for (int k = 0; k < n; ++k) {
      const Eigen::Index row = 3 * e.nodes[k];
      q.middleRows<3>(d * k) = U.middleRows<3>(row) - u;
      if (d != 6) continue;
      const Vec3 r = in.p[k] - centre;
      for (Eigen::Index a = 0; a < U.cols(); ++a)
        q.col(a).segment<3>(6 * k) -= Vec3(w.col(a)).cross(r);
      q.middleRows<3>(6 * k + 3) = Theta.middleRows<3>(row) - w;
    }
    f.noalias() = Ke * q;
    use(q, f);
  }
}

}  // namespace

MatX strain_energy(const FeModel& model, const MatX& U, const MatX& Theta,
                   Integration integration) {
  MatX K = MatX::Zero(U.cols(), U.cols());
  each_element(model, U, Theta, integration,
               [&](const MatX& q, const MatX& f) { K.noalias() += q.transpose() * f; });
  if (!model.springs.empty()) K += spring_energy(model, U, Theta);
  return 0.5 * (K + K.transpose());
}

VecX strain_energy_of_each(const FeModel& model, const MatX& U, const MatX& Theta,
                           Integration integration) {
  VecX k = VecX::Zero(U.cols());
  each_element(model, U, Theta, integration, [&](const MatX& q, const MatX& f) {
    k += q.cwiseProduct(f).colwise().sum().transpose();
  });
  if (!model.springs.empty()) k += spring_energy(model, U, Theta).diagonal();
  return k;
}

void check_digits(const FeModel& model, const MatX& U, const MatX& Theta, const VecX& stiffness,
                  const std::vector<std::string>& names, Integration integration) {
  if (model.elements.empty() || stiffness.size() == 0) return;
  const VecX energy = strain_energy_of_each(model, U, Theta, integration);
  Eigen::Index worst = 0;
  const VecX error = (stiffness - energy).cwiseAbs().cwiseQuotient(energy.cwiseAbs());
  for (Eigen::Index k = 0; k < error.size(); ++k)
    if (!(error(k) <= error(worst))) worst = k;
  if (error(worst) <= sixth_digit) return;
  throw InputError(
      ErrorCode::too_large,
      fmt::format("the {} elements are too many for double precision: the stiffness of the mode "
                  "'{}' and its strain energy differ by {:.1e}, at most {:.0e} is accepted (six "
                  "digits of a frequency; rounding grows with the fourth power of the number of "
                  "elements in a row); use fewer elements",
                  model.elements.size(), names[worst], error(worst), sixth_digit));
}

void with_digits_hint(const FeModel& model, const std::function<void()>& factor) {
  try {
    factor();
  } catch (const InputError& error) {
    const auto beams = std::count_if(model.elements.begin(), model.elements.end(),
                                     [](const FeElement& e) { return is_beam(e.type); });
    if (beams < many_beams) throw;
    std::vector<ErrorEntry> errors = error.errors();
    for (ErrorEntry& entry : errors)
      entry.message += fmt::format(
          "; or the {} beams in a row are too many for double precision: use fewer", beams);
    throw InputError(std::move(errors));
  }
}

}  // namespace floatframe

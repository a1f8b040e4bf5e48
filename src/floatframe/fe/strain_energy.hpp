#pragma once
// The modal stiffness X^T K X element by element. The motion of the whole part is subtracted from
// the displacements of each element before its matrix is used,
//   u_k - mean(u) - w x (p_k - mean(p)),  theta_k - w,  w = mean(theta)
// (elements with rotations), so that in meshes of very many elements the digits of the deformation
// are not lost in those of the displacement: a bending shape over n beams is good to n^2 roundings,
// where products with the assembled K lose n^4. Hence also a measure of the loss elsewhere.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

/// Three of the six rows of each node: those from `axis` on.
inline MatX rows_of_nodes(const MatX& X, int axis) {
  MatX out(X.rows() / 2, X.cols());
  for (Eigen::Index k = 0; 6 * k < X.rows(); ++k)
    out.middleRows<3>(3 * k) = X.middleRows<3>(6 * k + axis);
  return out;
}

/// U, Theta: translations and rotations of all nodes, 3 rows per node, one column per shape. Models
/// given by matrices have no elements and no energy here.
MatX strain_energy(const FeModel& model, const MatX& U, const MatX& Theta,
                   Integration integration = Integration::exact);
/// The diagonal of it.
VecX strain_energy_of_each(const FeModel& model, const MatX& U, const MatX& Theta,
                           Integration integration = Integration::exact);

/// Relative error of a stiffness (w^2) above which the sixth digit of a frequency is lost.
inline constexpr double sixth_digit = 2e-6;

/// Throws InputError if a stiffness of the shapes differs by more than that from their strain
/// energy: then the model has too many elements for double precision. `names`: of the shapes.
void check_digits(const FeModel& model, const MatX& U, const MatX& Theta, const VecX& stiffness,
                  const std::vector<std::string>& names,
                  Integration integration = Integration::exact);

/// Runs `factor`; if it finds a singular stiffness, and there are so many beams that round-off may
/// be the cause, the error mentions it.
void with_digits_hint(const FeModel& model, const std::function<void()>& factor);

}  // namespace floatframe

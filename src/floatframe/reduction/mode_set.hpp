#pragma once
// Modes by whatever method, and the body that is made of them: the road that bars and parts share.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/cut_pair.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/reduction/eigenmodes.hpp"

namespace floatframe {

/// Mode shapes and what is known about them, before the body is made.
struct ModeSet {
  MatX X;            ///< rows of the structure x nm
  MatX K;            ///< nm x nm
  VecX frequencies;  ///< of the dynamic modes [Hz]
  std::vector<std::string> names;
};

/// Of a structure held at its interfaces (FixedInterface, BarChains): the number of normal modes
/// that a largest number and a frequency limit [Hz] (0: none) leave.
template <class Fixed>
int normal_mode_count(const Fixed& fixed, std::optional<int> number, double max_frequency) {
  if (!(max_frequency > 0.0)) return number.value_or(fixed.inner());
  const int below = fixed.count_below(max_frequency);
  return number ? std::min(below, *number) : below;
}

/// Of modes with these frequencies, ascending, the `kept` lowest, or one more if it is the partner
/// of the last (body/cut_pair.hpp).
int with_whole_pair(const VecX& omega, Eigen::Index kept);

/// A number of modes below a frequency limit [Hz], or as many as there may be so that the partner
/// of the last is among them.
template <class Fixed>
int count_with_partner(const Fixed& fixed, int below, double max_frequency) {
  return std::max(below, fixed.count_below(max_frequency * (1.0 + equal_frequencies)));
}

/// Constraint modes of the interface dofs, named by `names`, then the normal modes. They do not
/// couple in the stiffness, normal modes not among themselves.
template <class Fixed>
ModeSet craig_bampton_set(const Fixed& fixed, const Eigenmodes& normal,
                          std::vector<std::string> names) {
  const auto nb = static_cast<Eigen::Index>(names.size()), nn = normal.omega.size();
  ModeSet set;
  set.X.resize(normal.shapes.rows(), nb + nn);
  set.X.leftCols(nb) = fixed.constraint_modes();
  set.X.rightCols(nn) = normal.shapes;
  set.K = MatX::Zero(nb + nn, nb + nn);
  set.K.topLeftCorner(nb, nb) = fixed.guyan_stiffness(set.X.leftCols(nb));
  set.K.diagonal().tail(nn) = normal.omega.cwiseAbs2();
  set.frequencies = normal.frequencies();
  for (Eigen::Index a = 0; a < nn; ++a) names.push_back("normal " + std::to_string(a + 1));
  set.names = std::move(names);
  return set;
}

/// The body of modes: everything but its nodes, its damping and the data of the projection method.
FlexibleBody body_of_modes(ModeSet modes, InertiaInvariants invariants);

}  // namespace floatframe

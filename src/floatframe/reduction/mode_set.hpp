#pragma once
// Modes by any method, and the body built from them: the common path of bars and parts.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/cut_pair.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/reduction/eigenmodes.hpp"

namespace floatframe {

/// Mode shapes and their properties, before the body is built.
struct ModeSet {
  MatX X;            ///< rows of the structure x nm
  MatX K;            ///< nm x nm
  VecX frequencies;  ///< of the dynamic modes [Hz]
  std::vector<std::string> names;
  int equal_left_out = 0;  ///< as of FlexibleBody
};

/// For a structure held at its interfaces (FixedInterface, BarChains): the number of normal modes
/// within a largest number and a frequency limit [Hz] (0: none).
template <class Fixed>
int normal_mode_count(const Fixed& fixed, std::optional<int> number, double max_frequency) {
  if (!(max_frequency > 0.0)) return number.value_or(fixed.inner());
  const int below = fixed.count_below(max_frequency);
  return number ? std::min(below, *number) : below;
}

/// Number of modes with at most the frequency [Hz] of the last of `kept`: more than kept if a
/// group of equal frequency is cut (body/cut_pair.hpp).
template <class Fixed>
int count_with_group(const Fixed& fixed, int kept, double last) {
  if (kept == 0 || kept >= fixed.inner()) return kept;
  return std::max(kept, fixed.count_below(last * (1.0 + equal_frequencies)));
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

/// The body from modes: everything except its nodes, its damping and the data of the projection
FlexibleBody body_of_modes(ModeSet modes, InertiaInvariants invariants);

}  // namespace floatframe

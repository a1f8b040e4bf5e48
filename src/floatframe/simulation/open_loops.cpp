// What contradicts what: with the Jacobian J of the constraints the part e = (I - J J+) r of the
// residual r is out of reach of all coordinates. Its rows belong to the constraints that contradict
// each other. Where all but row i are met, row i misses by e_i / (I - J J+)_ii.
#include "floatframe/simulation/open_loops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/math/dense.hpp"
#include "floatframe/simulation/initial_state.hpp"

namespace floatframe {
namespace {

/// The part whose row has the largest magnitude.
std::size_t worst_part(const ConstraintSet& constraints, const VecX& r) {
  Eigen::Index row = 0;
  r.cwiseAbs().maxCoeff(&row);
  return constraints.part_of_row(static_cast<int>(row));
}

const char* unit_of(const ConstraintPart& part, bool rates) {
  if (constraint_kind(part.type).angle) return rates ? "rad/s" : "rad";
  return rates ? "m/s" : "m";
}

/// Rows of angles are lengths.
double in_unit(const ConstraintPart& part, double x) {
  return std::abs(constraint_kind(part.type).angle ? x / part.scale : x);
}

std::string motions_text(RelativeFormulation& f, const VecX& residual, bool rates) {
  const ConstraintSet& constraints = f.constraint_set();
  const MatX J = f.constraint_jacobian();
  const LeastNorm solver(J, 1e-11);
  const auto out_of_reach = [&](const VecX& r) { return VecX(r - J * solver.solve(r)); };
  const VecX e = out_of_reach(residual);
  const double counts = 1e-6 * e.lpNorm<Eigen::Infinity>();
  std::vector<std::string> names;
  std::size_t worst = constraints.parts().size();
  double most = 0.0;
  for (std::size_t k = 0; k < constraints.parts().size(); ++k) {
    const double x = std::abs(e[constraints.offset(k)]);
    if (constraints.parts()[k].motion == nullptr || !(x > counts)) continue;
    names.push_back(f.model().joints[constraints.parts()[k].owner.index].name);
    if (x > (1.0 + 1e-6) * most) {  // of equal ones the first
      most = x;
      worst = k;
    }
  }
  // Positions that one motion asks for may be out of the reach of its loop: that loop stays open.
  if (names.empty() || (names.size() == 1 && !rates)) return {};
  const Eigen::Index row = constraints.offset(worst);
  const double own = out_of_reach(VecX::Unit(residual.size(), row))[row];
  const ConstraintPart& part = constraints.parts()[worst];
  return fmt::format("the prescribed {} of {} {}: {} is off by {:.3g} {} if {} met",
                     names.size() == 1 ? "motion" : "motions", named_text("joint", "joints", names),
                     names.size() == 1 ? "contradicts the constraints" : "contradict each other",
                     owner_name(f.model(), part.owner), in_unit(part, e[row] / own),
                     unit_of(part, rates),
                     names.size() == 1 ? "the constraints are" : "the rest is");
}

}  // namespace

std::string open_loops_text(RelativeFormulation& f, const VecX& residual, bool rates) {
  if (std::string text = motions_text(f, residual, rates); !text.empty()) return text;
  const ConstraintSet& constraints = f.constraint_set();
  const ConstraintPart& part = constraints.parts()[worst_part(constraints, residual)];
  return fmt::format("{} {} {:.3g} {}", owner_name(f.model(), part.owner),
                     rates ? "opens at" : "has a gap of",
                     in_unit(part, residual.lpNorm<Eigen::Infinity>()), unit_of(part, rates));
}

}  // namespace floatframe

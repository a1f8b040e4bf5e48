#include "floatframe/run/branch_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "floatframe/loops/redundancy.hpp"

namespace floatframe {
namespace {

/// " of joint 'a', joint 'b' and 3 more"
std::string branch_owners(const ConstraintSet& constraints, const std::vector<int>& rows) {
  std::vector<std::string> owners;
  for (const int row : rows) {
    if (constraints.part_of_row(row) == constraints.parts().size()) continue;
    const std::string owner = constraints.owner_of_row(row);
    if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
  }
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, owners.size()); ++k)
    text += (k == 0 ? " of " : ", ") + owners[k];
  if (owners.size() > most) text += fmt::format(" and {} more", owners.size() - most);
  return text;
}

}  // namespace

BranchWatch::BranchWatch(double step, int configurations)
    : step_(step), highest_(std::numeric_limits<double>::lowest()) {
  assert(step > 0.0 && configurations >= 0);
  first_.q = deepest_.q = start_.q = best_.q = VecX::Zero(configurations);
}

void BranchWatch::observe(const State& s, const StepAttempt& last) noexcept {
  assert(s.q.size() == first_.q.size());
  // Substeps have a separate metric.
  if (!std::isfinite(last.log_pivots) || std::abs(last.size - step_) > 1e-6 * step_) return;
  const double x = last.log_pivots;
  highest_ = std::max(highest_, x);
  start_.offer_first(x, s);
  if (best_.found == 0.0 || x > best_.value + rise) best_.keep(x, s);
  if (x > highest_ - depth) {
    first_ended_ = first_.found;
    return;
  }
  if (first_ended_ == 0.0) first_.offer(x, s);
  deepest_.offer(x, s);
}

std::optional<RangeWarning> BranchWatch::judged(const MatX& J, double usual,
                                                const ConstraintSet& constraints, double t) {
  if (!nearly_dependent(J) || !(independence(J) < part_of_usual * usual)) return {};
  return RangeWarning{RangeLimit::branch,
                      fmt::format("the mechanism passes a singular position at t = {:.4g} s: "
                                  "constraints{} nearly depend on each other there, so that it may "
                                  "go on in more than one way; compare with a run in smaller steps",
                                  t, branch_owners(constraints, dependent_rows(J)))};
}

std::optional<RangeWarning> BranchWatch::warning(Formulation& f) const {
  for (const Dip* d : {&first_, &deepest_}) {
    if (d->found == 0.0 || d->q.size() != f.configurations() || f.velocities() > most_coordinates)
      continue;
    const auto constraints_at = [&](const Dip& dip) {
      kinematics_at(f, dip.t, dip.q, VecX::Zero(f.velocities()));
      return f.constraint_jacobian();
    };
    const double usual =
        std::max(independence(constraints_at(start_)), independence(constraints_at(best_)));
    if (auto found = judged(constraints_at(*d), usual, f.constraint_set(), d->t)) return found;
  }
  return {};
}

}  // namespace floatframe

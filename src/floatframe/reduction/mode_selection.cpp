#include "floatframe/reduction/mode_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/reduction/mode_basis.hpp"
#include "floatframe/reduction/rigid_check.hpp"

namespace floatframe {
namespace {

constexpr int most_modes = 400;

/// Rigid motions about the centre of mass.
MatX about_centre(const MatX& R, const SparseMatrix& M) {
  const Mat6 M_rr = R.transpose() * (M * R);
  // The static moment m c is in the coupling of translations and rotations.
  const double m = M_rr.topLeftCorner<3, 3>().trace() / 3.0;
  const Vec3 c(M_rr(1, 5) / m, M_rr(2, 3) / m, M_rr(0, 4) / m);
  MatX C = R;
  for (int k = 0; k < 3; ++k) {
    // w x (p - c) = w x p - w x c
    const Vec3 shift = Vec3::Unit(k).cross(c);
    C.col(3 + k) -= R.leftCols<3>() * shift;
  }
  return C;
}

/// One mode more than requested, if available: it shows whether it is the partner of the last.
Eigenmodes modes_and_next(const FixedInterface& fixed, int count, bool at_most) {
  if (count == 0 || count >= fixed.inner()) return fixed.normal_modes(count, at_most);
  Eigenmodes modes = fixed.normal_modes(count + 1, true);
  return modes.omega.size() < count && !at_most ? fixed.normal_modes(count) : modes;
}

/// Number of these modes that are kept; `with_group()` returns the number needed for a whole group
/// of equal frequency. `given`: their number is given.
template <class WithGroup>
int whole_groups(const VecX& omega, int kept, bool given, const WithGroup& with_group,
                 int& equal_left_out) {
  equal_left_out = 0;
  if (kept == 0 || kept >= omega.size() || !equal_frequency(omega[kept - 1], omega[kept]))
    return kept;
  const int whole = std::max(kept + 1, with_group());
  if (!given) return whole;
  equal_left_out = whole - kept;
  return kept;
}

}  // namespace

std::optional<int> most_normal_modes(const PartOptions& options) {
  const bool limited = options.max_frequency > 0.0 || options.effective_mass > 0.0;
  if (options.modes || limited) return options.modes;
  return default_modes;
}

Eigenmodes select_fixed_modes(const FixedInterface& fixed, const PlacedPart& part,
                              const std::vector<int>& boundary, std::vector<ModeHealth>& list,
                              int& equal_left_out) {
  const FeSystem& system = part.system;
  const PartOptions& options = part.options;
  int count = normal_mode_count(fixed, most_normal_modes(options), options.max_frequency);
  const MatX C = about_centre(part.R, system.M);
  const MatX MC = system.M * C;
  const Vec6 total = (C.transpose() * MC).diagonal();
  // Limit given by the inner dofs.
  MatX inner = C;
  for (const int row : boundary) inner.row(row).setZero();
  const Vec6 reachable = (inner.transpose() * (system.M * inner)).diagonal();

  const bool by_mass = options.effective_mass > 0.0;
  int solved = by_mass ? std::min(count, 20) : count;
  // The default number is a limit: small parts have fewer.
  const bool at_most = !options.modes && !by_mass && !(options.max_frequency > 0.0);
  const bool given = options.modes && count == *options.modes;
  Eigenmodes modes = modes_and_next(fixed, solved, at_most);
  if (at_most) solved = count = std::min(count, static_cast<int>(modes.omega.size()));
  Vec6 sum = Vec6::Zero();
  int kept = 0;
  bool reached = false;
  const auto keep = [&] {
    const Vec6 share = (MC.transpose() * modes.shapes.col(kept)).array().square();
    ModeHealth m;
    m.name = fmt::format("normal {}", kept + 1);
    m.frequency = hertz(modes.omega(kept));
    for (int k = 0; k < 6; ++k) m.effective_mass(k) = total(k) > 0.0 ? share(k) / total(k) : 0.0;
    list.push_back(m);
    sum += share;
    ++kept;
  };
  while (true) {
    while (kept < solved && !reached) {
      keep();
      reached = by_mass && (sum.array() >= options.effective_mass * reachable.array()).all();
    }
    if (!by_mass || reached || solved == count) break;
    if (solved == most_modes) {
      Eigen::Index worst = 0;
      (sum.array() / reachable.array()).minCoeff(&worst);
      throw InputError(
          ErrorCode::out_of_range,
          fmt::format("{} fixed-interface modes reach only {:.1f} % of the effective mass in {}, "
                      "not {:.1f} %; ask for less, or for a number of modes",
                      most_modes, 100.0 * sum(worst) / reachable(worst), node_dof_words[worst],
                      100.0 * options.effective_mass));
    }
    solved = std::min({count, 2 * solved, most_modes});
    modes = modes_and_next(fixed, solved, false);
  }
  const int whole = whole_groups(
      modes.omega, kept, given && !reached,
      [&] { return count_with_group(fixed, kept, hertz(modes.omega[kept - 1])); }, equal_left_out);
  if (whole > modes.omega.size()) {  // modes of the group are other combinations of it then
    modes = fixed.normal_modes(whole, true);
    list.clear();
    kept = 0;
  }
  while (kept < std::min(whole, static_cast<int>(modes.omega.size()))) keep();
  return {modes.omega.head(kept), modes.shapes.leftCols(kept)};
}

Eigenpairs select_free_modes(const FreeStructure& structure, const PlacedPart& part,
                             std::vector<ModeHealth>& list, int& equal_left_out) {
  const FeSystem& system = part.system;
  const PartOptions& options = part.options;
  int count = most_normal_modes(options).value_or(system.size() - 6);
  if (options.max_frequency > 0.0)
    count = std::clamp(structure.count_below(options.max_frequency) - 6, 0, count);
  const int most = std::max(system.size() - 6, 0);
  if (!options.modes) count = std::min(count, most);
  if (count > most) {
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("{} normal modes are requested, but of the {} degrees of freedom "
                                 "of the free part only {} remain besides its six rigid motions",
                                 count, system.size(), most));
  }
  // At least one is computed: a mechanism is rejected for any number of modes.
  // One more than kept reveals a pair that is cut.
  const int looked_at = count > 0 ? std::min(count + 1, most) : std::min(most, 1);
  const Eigenpairs all = structure.modes(looked_at + 6);
  if (all.shapes.cols() > 6) check_stiffness_of(part.model, system, all.shapes.col(6));
  const auto found = static_cast<int>(std::max<Eigen::Index>(all.lambda.size() - 6, 0));
  if (!options.modes) count = std::min(count, found);
  if (count > found) {
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("{} normal modes are requested, but the mass allows only {}", count, found));
  }
  const auto elastic_of = [](const Eigenpairs& pairs, Eigen::Index n) {
    return Eigenpairs{pairs.lambda.segment(6, n), pairs.shapes.middleCols(6, n)};
  };
  const VecX omega = all.lambda.tail(found).cwiseMax(0.0).cwiseSqrt();
  const int whole = whole_groups(
      omega, count, options.modes && count == *options.modes,
      [&] {
        return structure.count_below(hertz(omega[count - 1]) * (1.0 + equal_frequencies)) - 6;
      },
      equal_left_out);
  Eigenpairs elastic = elastic_of(all, std::min(whole, found));
  if (whole > found) elastic = elastic_of(structure.modes(whole + 6), whole);
  count = static_cast<int>(elastic.lambda.size());
  for (int a = 0; a < count; ++a) {
    ModeHealth m;
    m.name = fmt::format("normal {}", a + 1);
    m.frequency = hertz(std::sqrt(std::max(elastic.lambda(a), 0.0)));
    list.push_back(m);
  }
  return elastic;
}

}  // namespace floatframe

#include "floatframe/stepping/memory_check.hpp"

#include <fmt/format.h>

#include <cmath>

namespace floatframe {
namespace {

using Numbers = std::span<const double>;

Numbers numbers(const VecX& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

struct MemoryNumbers {
  const char* name;
  Numbers given, own;
};

/// Common checks of the counters and times of a simulation.
bool consistent(const StepperMemory& m, double step) {
  constexpr std::int64_t most = std::int64_t{1} << 53;  // above it sums would not be exact
  const double t = m.state.t;
  if (!std::isfinite(t) || !std::isfinite(m.base) || m.since_base < 0 || m.since_base > most)
    return false;
  const double expected = m.base + static_cast<double>(m.since_base) * step;
  if (!(std::abs(expected - t) <= 1e-6 * step + 1e-12 * std::abs(t))) return false;
  const TangentReuse& e = m.tangent_reuse;
  if (!(e.contraction >= 0.0 && e.contraction <= 1.0) || std::isinf(e.valid_at)) return false;
  const StepCounters& c = m.counters;
  for (const std::int64_t n : {c.steps, c.substeps, c.iterations, c.factorizations, c.cut_short,
                               c.edges, c.edges_passed, c.corners})
    if (n < 0 || n > most) return false;
  return c.max_position_violation >= 0.0 && c.max_velocity_violation >= 0.0 &&
         c.max_load_contraction >= 0.0;
}

}  // namespace

bool all_finite(Numbers v) noexcept {
  for (const double x : v)
    if (!std::isfinite(x)) return false;
  return true;
}

std::string memory_complaint(const StepperMemory& d, const StepperMemory& own, const Formulation& f,
                             double step) {
  for (const MemoryNumbers& x : std::initializer_list<MemoryNumbers>{
           {"coordinates", numbers(d.state.q), numbers(own.state.q)},
           {"velocities", numbers(d.state.v), numbers(own.state.v)},
           {"accelerations", numbers(d.state.a), numbers(own.state.a)},
           {"accelerations", numbers(d.state.a_alg), numbers(own.state.a_alg)},
           {"multipliers", numbers(d.state.lambda), numbers(own.state.lambda)},
           {"states of elements", numbers(d.state.z), numbers(own.state.z)},
           {"states of elements", numbers(d.state.zd), numbers(own.state.zd)},
           {"states of elements", numbers(d.state.zd_alg), numbers(own.state.zd_alg)},
           {"spring angles", d.spring_angles, own.spring_angles},
           {"inputs", d.inputs, own.inputs}}) {
    if (x.given.size() != x.own.size())
      return fmt::format("is damaged: {} of another number", x.name);
    if (!all_finite(x.given)) return fmt::format("is damaged: {} that are not finite", x.name);
  }
  if (!f.has_rotations(d.state.q)) return "is damaged: coordinates that are no rotations";
  if (d.force_branches.size() != own.force_branches.size())
    return "is damaged: branches of forces of another number";
  for (const std::int64_t branch : d.force_branches)
    if (branch < free_branch) return "is damaged: branches of forces that do not exist";
  if (d.outputs.size() != own.outputs.size()) return "is damaged: outputs of another number";
  for (std::size_t k = 0; k < d.outputs.size(); ++k) {
    const FollowedOutput& o = d.outputs[k];
    bool finite = std::isfinite(o.time) && all_finite(o.values);
    for (const FollowedOutput& part : o.parts)
      finite = finite && std::isfinite(part.time) && all_finite(part.values);
    if (!finite) return "is damaged: outputs that are not finite";
    if (o.parts.size() != own.outputs[k].parts.size())
      return "is damaged: outputs with formulas of another size";
  }
  if (!consistent(d, step)) return "is damaged: times or counters that do not fit together";
  return {};
}

}  // namespace floatframe

#include "floatframe/export/stress_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floatframe {
namespace {

/// Size of one product: its result (6 x 64 rows, 64 columns, 200 kB) stays in the cache.
constexpr Eigen::Index instants_at_once = 64, places_at_once = 64;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The square of the von Mises stress.
double squared_von_mises(const double* s) noexcept {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return 0.5 * (a * a + b * b + c * c) + 3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

}  // namespace

StressEnvelopeOf::StressEnvelopeOf(const BodyStress& stress, int modes)
    : stress_(stress),
      Y_(modes, instants_at_once),
      C_(body_load_cases + modes, instants_at_once),
      values_(6 * places_at_once, instants_at_once) {
  const auto places = static_cast<Eigen::Index>(stress.places.size());
  const auto sections = static_cast<Eigen::Index>(stress.sections.size());
  squares_ = VecX::Constant(places, -1.0);
  envelope_.von_mises = VecX::Zero(places);
  envelope_.time = VecX::Zero(places);
  envelope_.stress = Mat6X::Zero(6, places);
  envelope_.least = Mat6X::Constant(6, sections, infinity);
  envelope_.largest = Mat6X::Constant(6, sections, -infinity);
  envelope_.least_time = envelope_.largest_time = Mat6X::Zero(6, sections);
}

void StressEnvelopeOf::add(double time, const VecX& y, const VecX& c) {
  const auto column = static_cast<Eigen::Index>(times_.size());
  Y_.col(column) = y;
  C_.col(column) = c;
  times_.push_back(time);
  if (column + 1 == instants_at_once) flush();
}

const StressEnvelope& StressEnvelopeOf::result() {
  flush();
  for (Eigen::Index p = 0; p < envelope_.von_mises.size(); ++p)
    envelope_.von_mises(p) = std::sqrt(squared_von_mises(envelope_.stress.col(p).data()));
  return envelope_;
}

void StressEnvelopeOf::flush() {
  const auto instants = static_cast<Eigen::Index>(times_.size());
  if (instants == 0) return;
  flush_places(instants);
  flush_sections(instants);
  times_.clear();
}

void StressEnvelopeOf::flush_places(Eigen::Index instants) {
  const bool loads = stress_.loads.size() > 0;
  for (Eigen::Index first = 0; first < squares_.size(); first += places_at_once) {
    const Eigen::Index places = std::min(places_at_once, squares_.size() - first);
    auto S = values_.topLeftCorner(6 * places, instants);
    S.noalias() = stress_.modes.middleRows(6 * first, 6 * places) * Y_.leftCols(instants);
    if (loads)
      S.noalias() += stress_.loads.middleRows(6 * first, 6 * places) * C_.leftCols(instants);
    for (Eigen::Index k = 0; k < instants; ++k) {
      const double* s = &values_(0, k);
      for (Eigen::Index p = first; p < first + places; ++p, s += 6) {
        const double found = squared_von_mises(s);
        if (!(found > squares_(p))) continue;
        squares_(p) = found;
        envelope_.time(p) = times_[static_cast<std::size_t>(k)];
        envelope_.stress.col(p) = Eigen::Map<const Vec6>(s);
      }
    }
  }
}

void StressEnvelopeOf::flush_sections(Eigen::Index instants) {
  if (stress_.sections.empty()) return;
  MatX F = stress_.section_modes * Y_.leftCols(instants);
  if (stress_.section_loads.size() > 0)
    F.noalias() += stress_.section_loads * C_.leftCols(instants);
  for (Eigen::Index k = 0; k < instants; ++k) {
    const double time = times_[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < F.rows(); ++i) {
      // The places of a 6 x sections matrix are in the order of the rows of F.
      if (F(i, k) < envelope_.least.data()[i]) {
        envelope_.least.data()[i] = F(i, k);
        envelope_.least_time.data()[i] = time;
      }
      if (F(i, k) > envelope_.largest.data()[i]) {
        envelope_.largest.data()[i] = F(i, k);
        envelope_.largest_time.data()[i] = time;
      }
    }
  }
}

}  // namespace floatframe

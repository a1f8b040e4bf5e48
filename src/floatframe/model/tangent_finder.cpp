// Exact derivatives of elements: their laws over dual numbers.
#include <algorithm>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

namespace {

/// The motion, without a change of its directions, which are zero but within `along_marker`.
void take_values(const MarkerState& from, MarkerMotion<Dual>& to) noexcept {
  for (int c = 0; c < 3; ++c) {
    to.r[c].v = from.r[c];
    to.v[c].v = from.v[c];
    to.w[c].v = from.w[c];
  }
  for (int k = 0; k < 9; ++k) to.R(k).v = from.R(k);
}

/// `unit` times the derivatives in the directions (dr, dpi, v, w).
void take_directions(const MarkerState& m, double unit, MarkerMotion<Dual>& to) noexcept {
  for (int c = 0; c < 3; ++c) {
    to.r[c].d[c] = unit;
    to.v[c].d[6 + c] = unit;
    to.w[c].d[9 + c] = unit;
    const Mat3 turned = unit * (skew(Vec3::Unit(c)) * m.R);
    for (int k = 0; k < 9; ++k) to.R(k).d[3 + c] = turned(k);
  }
}

}  // namespace

TangentFinder::TangentFinder(const Model& model, const Element& element)
    : efforts_(element.markers.size(), element.states, element.further()),
      motions_(element.markers.size()),
      states_(element.states + (element.remembers ? 0 : element.kept)),
      links_(model.links.size()) {
  const Eigen::Index n = 6 * std::ssize(element.markers),
                     results = element.states + 3 + element.further(),
                     inner = element.states + link_count(element);
  out_ = {MatX::Zero(n, n),       MatX::Zero(n, n),       MatX::Zero(n, inner),
          MatX::Zero(results, n), MatX::Zero(results, n), MatX::Zero(results, inner)};
  for (const MarkerMotion<Dual>& m : motions_) markers_.push_back(&m);
  for (const Signal& signal : element.signals)
    if (signal.link >= 0) own_links_.push_back(signal.link);
}

void TangentFinder::evaluate(const Ports& in, const double* input_changes) noexcept {
  efforts_.clear();
  if (!in.element.acts) return;
  element_kind(in.element.type)
      .dual({in.model, in.element, markers_.data(), in.origin, in.t, in.reference_angle, in.inputs,
             in.branch, states_.data(), in.state_weight, links_.data(), in.angles, in.kept,
             input_changes, in.rest_slopes},
            efforts_);
}

/// The ports, without directions.
void TangentFinder::take_ports(const Ports& in) noexcept {
  for (int i = 0; i < std::ssize(motions_); ++i) take_values(in.marker(i), motions_[i]);
  std::copy(in.states, in.states + states_.size(), states_.begin());
  for (const int link : own_links_) links_[link] = in.links[link];
}

const EffortsOf<Dual>& TangentFinder::along_marker(const Ports& in, int marker) noexcept {
  take_ports(in);
  take_directions(in.marker(marker), 1.0, motions_[marker]);
  evaluate(in);
  take_directions(in.marker(marker), 0.0, motions_[marker]);
  return efforts_;
}

const EffortsOf<Dual>& TangentFinder::along_inner(const Ports& in, int first) noexcept {
  take_ports(in);
  const int ns = in.element.states, last = first + dual_directions;
  for (int i = first; i < std::min(ns, last); ++i) states_[i].d[i - first] = 1.0;
  for (int i = 0; i < std::ssize(own_links_); ++i)
    if (ns + i >= first && ns + i < last) links_[own_links_[i]].d[ns + i - first] = 1.0;
  evaluate(in);
  return efforts_;
}

const EffortsOf<Dual>& TangentFinder::along_signals(const Ports& in, const VecX& inputs,
                                                    const VecX& links) noexcept {
  assert(std::ssize(in.inputs) == inputs.size() && std::ssize(links_) == links.size());
  take_ports(in);
  for (const int link : own_links_) links_[link].d[0] = links[link];
  evaluate(in, inputs.data());
  return efforts_;
}

const Dual::Directions& TangentFinder::wrench(Eigen::Index row) const noexcept {
  const WrenchOf<Dual>& w = efforts_.wrench[row / 6];
  return (row % 6 < 3 ? w.F[row % 6] : w.T[row % 6 - 3]).d;
}

const Dual::Directions& TangentFinder::result(Eigen::Index row) const noexcept {
  const auto states = std::ssize(efforts_.state_rates);
  if (row < states) return efforts_.state_rates[row].d;
  return efforts_.result(row - states).d;
}

const EffortTangent& TangentFinder::find_inner(const Ports& in) noexcept {
  const int inner = out_.slopes.cols();
  for (int first = 0; first < inner; first += dual_directions) {
    along_inner(in, first);
    for (int i = first; i < std::min(inner, first + dual_directions); ++i) {
      for (Eigen::Index row = 0; row < out_.of_inner.rows(); ++row)
        out_.of_inner(row, i) = -wrench(row)[i - first];
      for (Eigen::Index row = 0; row < out_.slopes.rows(); ++row)
        out_.slopes(row, i) = result(row)[i - first];
    }
  }
  return out_;
}

const EffortTangent& TangentFinder::find_results(const Ports& in) noexcept {
  find_along_markers(in, false);
  return find_inner(in);
}

const EffortTangent& TangentFinder::find(const Ports& in) noexcept {
  find_along_markers(in, true);
  return find_inner(in);
}

void TangentFinder::find_along_markers(const Ports& in, bool of_wrenches) noexcept {
  for (int j = 0; j < std::ssize(motions_); ++j) {
    along_marker(in, j);
    for (Eigen::Index row = 0; of_wrenches && row < out_.K.rows(); ++row) {
      out_.K.row(row).segment<6>(6 * j) = -wrench(row).head<6>().matrix().transpose();
      out_.C.row(row).segment<6>(6 * j) = -wrench(row).tail<6>().matrix().transpose();
    }
    for (Eigen::Index row = 0; row < out_.motion.rows(); ++row) {
      out_.motion.row(row).segment<6>(6 * j) = result(row).head<6>().matrix().transpose();
      out_.rates.row(row).segment<6>(6 * j) = result(row).tail<6>().matrix().transpose();
    }
  }
}

EffortTangent exact_tangent(const Ports& in) {
  return TangentFinder(in.model, in.element).find(in);
}

}  // namespace floatframe

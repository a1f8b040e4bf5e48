#pragma once
// Numbers and texts as bytes, for stored states: numbers are little-endian, doubles bit by bit. One
// function defines the order for writing and for reading: `s(x)` of a StateWriter stores x, of a
// StateReader restores it.
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

class StateWriter {
 public:
  void raw(std::string_view text) {
    for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  }
  void operator()(std::uint64_t n) {
    for (int k = 0; k < 8; ++k) bytes.push_back(static_cast<std::byte>(n >> (8 * k)));
  }
  void operator()(std::int64_t n) { (*this)(static_cast<std::uint64_t>(n)); }
  void operator()(double x) { (*this)(std::bit_cast<std::uint64_t>(x)); }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    raw(text);
  }
  void operator()(const VecX& v) {
    (*this)(static_cast<std::uint64_t>(v.size()));
    for (Eigen::Index k = 0; k < v.size(); ++k) (*this)(v[k]);
  }
  template <class Number>
  void operator()(const std::vector<Number>& v) {
    (*this)(static_cast<std::uint64_t>(v.size()));
    for (const Number x : v) (*this)(x);
  }
  void operator()(const Vec3& v) {
    for (int k = 0; k < 3; ++k) (*this)(v[k]);
  }
  void operator()(const std::vector<FollowedOutput>& outputs) {
    (*this)(static_cast<std::uint64_t>(outputs.size()));
    for (const FollowedOutput& o : outputs) {
      (*this)(static_cast<std::uint64_t>(o.started));
      (*this)(o.time);
      for (const double x : o.values) (*this)(x);
      (*this)(o.parts);
    }
  }
  std::vector<std::byte> bytes;
};

/// Allocates no more memory than bytes remain.
class StateReader {
 public:
  /// `what`: their name, in the sentence about damaged bytes.
  StateReader(std::span<const std::byte> bytes, const char* what) : left_(bytes), what_(what) {}
  bool at_end() const { return left_.empty(); }

  void operator()(std::uint64_t& n) {
    if (left_.size() < 8) short_of();
    n = 0;
    for (std::size_t k = 0; k < 8; ++k) n |= std::to_integer<std::uint64_t>(left_[k]) << (8 * k);
    left_ = left_.subspan(8);
  }
  void operator()(std::int64_t& n) { n = static_cast<std::int64_t>(number()); }
  void operator()(double& x) { x = std::bit_cast<double>(number()); }
  void operator()(std::string& text) {
    const std::size_t n = count(1);
    text.resize(n);
    if (n > 0) std::memcpy(text.data(), left_.data(), n);
    left_ = left_.subspan(n);
  }
  void operator()(VecX& v) {
    v.resize(static_cast<Eigen::Index>(count(8)));
    for (Eigen::Index k = 0; k < v.size(); ++k) (*this)(v[k]);
  }
  template <class Number>
  void operator()(std::vector<Number>& v) {
    v.resize(count(8));
    for (Number& x : v) (*this)(x);
  }
  void operator()(Vec3& v) {
    for (int k = 0; k < 3; ++k) (*this)(v[k]);
  }
  void operator()(std::vector<FollowedOutput>& outputs) {
    outputs.resize(count(72));
    for (FollowedOutput& o : outputs) {
      o.started = number() != 0;
      (*this)(o.time);
      for (double& x : o.values) (*this)(x);
      (*this)(o.parts);
    }
  }

 private:
  [[noreturn]] void short_of() const {
    throw InputError(ErrorCode::damaged, std::string(what_) + " is damaged: it ends too early");
  }
  std::uint64_t number() {
    std::uint64_t n = 0;
    (*this)(n);
    return n;
  }
  std::size_t count(std::size_t size_of_one) {
    const std::uint64_t n = number();
    if (n > left_.size() / size_of_one) short_of();
    return n;
  }
  std::span<const std::byte> left_;
  const char* what_;
};

/// Everything that determines the next steps.
template <class Stream, class Memory>
void serialize_steps(Stream& s, Memory& m) {
  s(m.since_base);
  s(m.base);
  s(m.state.t);
  for (auto* v : {&m.state.q, &m.state.v, &m.state.a, &m.state.a_alg, &m.state.lambda, &m.state.z,
                  &m.state.zd, &m.state.zd_alg})
    s(*v);
  s(m.spring_angles);
  s(m.force_branches);
  s(m.tangent_reuse.valid_at);
  s(m.tangent_reuse.contraction);
  s(m.outputs);
  s(m.inputs);
  auto& c = m.counters;
  for (auto* n : {&c.steps, &c.substeps, &c.iterations, &c.factorizations, &c.cut_short, &c.edges,
                  &c.edges_passed, &c.corners})
    s(*n);
  s(c.max_position_violation);
  s(c.max_velocity_violation);
  s(c.max_load_contraction);
}

}  // namespace floatframe

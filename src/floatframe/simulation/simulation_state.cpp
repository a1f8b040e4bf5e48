#include "floatframe/simulation/simulation_state.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <string_view>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/simulation/simulation_memory.hpp"

namespace floatframe {
namespace {

constexpr std::string_view state_magic = "ffstate\n";
constexpr std::uint64_t state_version = 1;
constexpr std::size_t checksum_size = 32;

std::string checksum(std::span<const std::byte> bytes) {
  return content_hash({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// The content in one order, for writing and for reading.
template <class Stream, class Data>
void walk(Stream& s, Data& d) {
  auto& m = d.steps;
  s(d.fingerprint);
  for (auto* n : {&d.coordinates, &d.inertia, &d.max_iterations, &m.since_base}) s(*n);
  for (auto* x :
       {&d.step, &d.spectral_radius, &d.tolerance, &d.min_step, &d.penalty, &d.position_tolerance,
        &d.velocity_tolerance, &m.base, &d.joints_time, &m.state.t})
    s(*x);
  for (auto* v : {&m.state.q, &m.state.v, &m.state.a, &m.state.a_alg, &m.state.lambda}) s(*v);
  for (auto* v : {&m.spring_angles, &d.inputs, &d.row, &d.joints}) s(*v);
  s(m.runner.experience.continues_at);
  s(m.runner.experience.reuse_rate);
  s(m.runner.outputs);
  auto& c = m.runner.counters;
  for (auto* n : {&c.steps, &c.substeps, &c.iterations, &c.factorizations, &c.cut_short}) s(*n);
  s(c.max_position_violation);
  s(c.max_velocity_violation);
}

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
  void operator()(const std::vector<double>& v) {
    (*this)(static_cast<std::uint64_t>(v.size()));
    for (const double x : v) (*this)(x);
  }
  void operator()(const std::vector<FollowedOutput>& outputs) {
    (*this)(static_cast<std::uint64_t>(outputs.size()));
    for (const FollowedOutput& o : outputs) {
      (*this)(static_cast<std::uint64_t>(o.started));
      for (const double x : {o.time, o.position, o.rate}) (*this)(x);
    }
  }
  std::vector<std::byte> bytes;
};

/// Asks for no more memory than bytes are left.
class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : left_(bytes) {}
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
  void operator()(std::vector<double>& v) {
    v.resize(count(8));
    for (double& x : v) (*this)(x);
  }
  void operator()(std::vector<FollowedOutput>& outputs) {
    outputs.resize(count(32));
    for (FollowedOutput& o : outputs) {
      o.started = number() != 0;
      for (double* x : {&o.time, &o.position, &o.rate}) (*this)(*x);
    }
  }

 private:
  [[noreturn]] static void short_of() {
    throw InputError("the saved state is damaged: it ends too early");
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
};

}  // namespace

double SimulationState::time() const noexcept { return data_ ? data_->steps.state.t : 0.0; }

std::vector<std::byte> SimulationState::to_bytes() const {
  if (!data_) throw InputError("found a saved state that is empty, expected one of a simulation");
  StateWriter out;
  out.raw(state_magic);
  out(state_version);
  walk(out, *data_);
  out.raw(checksum(out.bytes));
  return std::move(out.bytes);
}

SimulationState SimulationState::from_bytes(std::span<const std::byte> bytes) {
  if (bytes.size() < state_magic.size() ||
      std::memcmp(bytes.data(), state_magic.data(), state_magic.size()) != 0)
    throw InputError("this is not the saved state of a simulation: expected bytes of to_bytes()");
  if (bytes.size() < state_magic.size() + 8 + checksum_size)
    throw InputError("the saved state is damaged: it ends too early");
  std::uint64_t version = 0;
  StateReader(bytes.subspan(state_magic.size()))(version);
  if (version != state_version)
    throw InputError(fmt::format("the saved state has version {}, this program reads version {}",
                                 version, state_version));
  const auto content = bytes.first(bytes.size() - checksum_size);
  if (std::memcmp(bytes.last(checksum_size).data(), checksum(content).data(), checksum_size) != 0)
    throw InputError("the saved state is damaged: its checksum does not fit its content");
  auto data = std::make_shared<Data>();
  StateReader in(content.subspan(state_magic.size() + 8));
  walk(in, *data);
  if (!in.at_end()) throw InputError("the saved state is damaged: it goes on after its end");
  return SimulationState(std::move(data));
}

}  // namespace floatframe

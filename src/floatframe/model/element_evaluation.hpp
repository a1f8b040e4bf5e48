#pragma once
// What an element does in a motion: the wrenches on its markers, and the part of the tangent that a
// symmetric factorisation can use: rows g with weights, -dQ/dq ~ sum k g g^T, -dQ/dqdot ~ sum c g
// g^T. Most are a scalar f(s, sdot) of a measure s with gradient g, tension positive: generalised
// force Q = -f g. The formulas are given in the file of each type (model/elements/<type>.cpp).
//
// Steps use the rows. The exact derivatives come from the same law with dual numbers
// (math/dual.hpp): linear systems use them, and the tests compare the rows with them. What the rows
// leave out is listed for each kind in its regimes and checked by the tests: the dependence of
// rates on positions (smaller than the damping by h |v| / s, h the step), the rotation of axes and
// loads, all nonsymmetric terms. This costs iterations, not accuracy.
//
// States z of an element are variables of first order: its law also gives zdot(ports, z). Steps
// eliminate them: at every iterate z solves
//   w z + z_hat = zdot(ports, z)                                                               (1)
// with the scheme of the step (integrator/state_scheme.hpp), so that dz = (w - zdot_z)^-1 zdot_p dp
// for a motion dp of the ports, and the rows are those of the efforts with z following. Behind them
// are numbers that stay constant in a step and change between steps (`after_step`).
#include <cassert>
#include <cstdint>
#include <exception>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "floatframe/math/dual.hpp"
#include "floatframe/model/law_energy.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// What an element gives back, over any scalar; rows for doubles only.
template <class S>
struct EffortsOf {
  static constexpr int most_rows = 12;
  std::vector<WrenchOf<S>> wrench;  ///< on each marker
  S force = 0.0, length = 0.0, rate = 0.0;
  std::vector<S> further;  ///< values of an element that has more than one
  S energy = 0.0;          ///< potential energy [J]
  /// For springs: rate of the energy in the present motion, including that of targets, and power
  /// dissipated by the damper [W]. Tyres leave both at zero: their energy jumps with the road.
  S energy_rate = 0.0, damping = 0.0;
  std::exception_ptr thrown;  ///< by a function of a program; the force is then not a number

  /// Weights of g g^T in -dQ/dq [N/m] and in -dQ/dqdot [N s/m].
  struct Weights {
    double k = 0.0, c = 0.0;
  };
  std::vector<S> state_rates;        ///< zdot
  std::vector<double> state_slopes;  ///< d(zdot_i)/dz_j: [i states + j]; zero until it is set

  int row_count = 0;
  Weights rows[most_rows];
  std::vector<WrenchOf<S>> gradients;  ///< of row r on marker i: [r markers + i]

  EffortsOf() = default;
  explicit EffortsOf(std::size_t markers, std::size_t states = 0, std::size_t values_further = 0)
      : wrench(markers),
        further(values_further),
        state_rates(states),
        state_slopes(states * states),
        gradients(std::is_same_v<S, double> ? most_rows * markers : 0) {}
  std::size_t markers() const noexcept { return wrench.size(); }
  /// In the order of `SignalLink::result`.
  const S& result(int k) const noexcept {
    return k > 2 ? further[k - 3] : k == 2 ? rate : k == 1 ? length : force;
  }
  const WrenchOf<S>* gradient(int row) const noexcept {
    return gradients.data() + static_cast<std::size_t>(row) * wrench.size();
  }
  WrenchOf<S>* gradient(int row) noexcept {
    return gradients.data() + static_cast<std::size_t>(row) * wrench.size();
  }
  /// Everything to zero.
  void clear() noexcept {
    for (WrenchOf<S>& w : wrench) w.F = w.T = Eigen::Matrix<S, 3, 1>::Zero();
    for (S& rate_of_state : state_rates) rate_of_state = 0.0;
    for (S& value : further) value = 0.0;
    for (double& slope : state_slopes) slope = 0.0;
    row_count = 0;
    force = length = rate = energy = energy_rate = damping = 0.0;
  }
  /// The wrenches f g on markers 0 and 1 and no others.
  void set_pair(const S& f, const WrenchPair<S>& g) noexcept {
    wrench[0] = {f * g.a.F, f * g.a.T};
    wrench[1] = {f * g.b.F, f * g.b.T};
  }
  /// Adds the wrenches f g on markers 0 and 1.
  void add_pair(const S& f, const WrenchPair<S>& g) noexcept {
    wrench[0].F += f * g.a.F;
    wrench[0].T += f * g.a.T;
    wrench[1].F += f * g.b.F;
    wrench[1].T += f * g.b.T;
  }
  /// A row; its gradients are to be filled, on every marker. None for dual numbers.
  WrenchOf<S>* add_row(double k, double c) noexcept requires std::is_same_v<S, double> {
    assert(row_count < most_rows && !gradients.empty());
    rows[row_count] = {k, c};
    return gradient(row_count++);
  }
  /// A row of an element of two markers.
  void add_pair_row(const WrenchPair<S>& g, double k, double c) noexcept {
    if constexpr (std::is_same_v<S, double>) {
      WrenchOf<S>* row = add_row(k, c);
      row[0] = g.a;
      row[1] = g.b;
    }
  }
};
using Efforts = EffortsOf<double>;

/// No branch is held: the law is evaluated on the branch of the present position.
inline constexpr std::int64_t free_branch = -1;

/// A signal of an element in one configuration: its value and derivatives in time. Those of inputs
/// and of results of other elements are not known and taken as zero.
template <class S>
struct SignalValue {
  S f = 0.0;
  double df = 0.0, ddf = 0.0;
};

/// What an element acts on in one configuration.
template <class S>
struct PortsOf {
  using Scalar = S;
  using Marker = std::conditional_t<std::is_same_v<S, double>, MarkerState, MarkerMotion<S>>;
  const Model& model;
  const Element& element;
  const Marker* const* markers;       ///< those of the element
  const Vec3& origin;                 ///< reference point of the markers' positions
  double t;                           ///< [s]
  double reference_angle = 0.0;       ///< selects the turn of a joint angle [rad]
  std::span<const double> inputs;     ///< values of model.inputs
  std::int64_t branch = free_branch;  ///< the held branch
  const S* states = nullptr;          ///< z, and behind them the kept numbers
  /// w of (1); infinite: z is constant.
  double state_weight = std::numeric_limits<double>::infinity();
  const S* links = nullptr;  ///< of model.links, times their factors
  const double* angles =
      nullptr;                   ///< the last ones of its coordinates whose turns are counted [rad]
  const double* kept = nullptr;  ///< the kept numbers
  /// Of dual numbers: what the first direction is of each input; null: inputs are constant.
  const double* input_changes = nullptr;
  /// At rest, where states follow deflections (`Deflection`): the slope of each state over that of
  /// its element; null: not at rest.
  const double* rest_slopes = nullptr;
  /// Of elements with `rates_first`: only the rates of the states and their slopes are asked for.
  bool rates_alone = false;

  S input(std::size_t i) const noexcept {
    S value = inputs[i];
    if constexpr (!std::is_same_v<S, double>)
      if (input_changes) value.d[0] = input_changes[i];
    return value;
  }
  const S& state(std::size_t i) const noexcept { return states[i]; }
  /// dz/dp = zdot_p times this, of a state with the slope zdot_z that no other state enters.
  double followed(double slope) const noexcept { return 1.0 / (state_weight - slope); }
  const Marker& marker(int i) const noexcept { return *markers[i]; }
  template <class Keys>
  const Keys& keys() const noexcept {
    return *std::get_if<Keys>(element.keys.get());
  }
  template <class Data>
  const Data& data() const noexcept {
    return *static_cast<const Data*>(element.data.get());
  }
  /// Value and derivatives in time of a signal port; zero if it is not given.
  SignalValue<S> signal(std::size_t port) const noexcept {
    return element.signals[port].given ? given_signal(element.signals[port]) : SignalValue<S>{};
  }
  SignalValue<S> given_signal(const Signal& signal) const noexcept;
};
using Ports = PortsOf<double>;
using DualPorts = PortsOf<Dual>;

/// Derivatives of the wrenches (torques in world axes about the marker points) with respect to
/// small motions and rates of the markers: per marker (dr, dpi), R_new = exp(skew(dpi)) R, and
/// (v, w).
struct EffortTangent {
  MatX K;  ///< -d(wrenches)/d(motion)
  MatX C;  ///< -d(wrenches)/d(rates)
  /// Inner variables: the states, and the signals from other elements in the order of their ports.
  MatX of_inner;  ///< -d(wrenches)/d(inner)
  /// Of zdot, and behind it of the results (`SignalLink::result`): d/d(motion), d/d(rates),
  /// d/d(inner).
  MatX motion, rates, slopes;
};
/// The number of signals of an element from other elements.
int link_count(const Element& element) noexcept;

/// Event function of the active branch of a law: see `branch_side`.
struct BranchSide {
  /// Continuous distance of the motion from the edge of the branch: positive beyond the edge.
  double beyond = -1.0;
  std::int64_t next = 0;  ///< the branch that follows across the nearest edge
};

/// `in.reference_angle`: the angle that results is within half a turn of it. `out` has room for the
/// markers of the element.
void evaluate_element(const Ports& in, Efforts& out) noexcept;

/// Finds the exact derivatives of one element by dual numbers. Step time: no heap, noexcept.
class TangentFinder {
 public:
  /// For an element of `model`. Allocates.
  TangentFinder(const Model& model, const Element& element);
  /// With the ports of this element.
  const EffortTangent& find(const Ports& in) noexcept;
  /// All but K and C.
  const EffortTangent& find_results(const Ports& in) noexcept;
  /// Only `of_inner` and `slopes`.
  const EffortTangent& find_inner(const Ports& in) noexcept;
  /// With respect to the motion and rates of a marker: directions (dr, dpi, v, w).
  const EffortsOf<Dual>& along_marker(const Ports& in, int marker) noexcept;
  /// To the inner variables from `first` on.
  const EffortsOf<Dual>& along_inner(const Ports& in, int first) noexcept;
  /// Along changes of model.inputs and of model.links: in the first direction.
  const EffortsOf<Dual>& along_signals(const Ports& in, const VecX& inputs,
                                       const VecX& links) noexcept;

 private:
  void take_ports(const Ports& in) noexcept;
  void find_along_markers(const Ports& in, bool of_wrenches) noexcept;
  void evaluate(const Ports& in, const double* input_changes = nullptr) noexcept;
  const Dual::Directions& wrench(Eigen::Index row) const noexcept;
  const Dual::Directions& result(Eigen::Index row) const noexcept;

  EffortTangent out_;
  EffortsOf<Dual> efforts_;
  std::vector<MarkerMotion<Dual>> motions_;
  std::vector<const MarkerMotion<Dual>*> markers_;
  std::vector<Dual> states_, links_;
  std::vector<int> own_links_;  ///< in `links_`, in the order of the ports
};
/// The same once. Allocates.
EffortTangent exact_tangent(const Ports& in);

/// Where the force of an element or its slope jumps - an edge of the road, contact, a corner of a
/// law - the element changes from one branch of its law to another. Each branch is smooth and
/// extends beyond its edges, so a step may end on the wrong side of an edge and be repeated up to
/// it. Without a held branch: returns the branch of the present position in `next`.
bool has_branches(const Element& element) noexcept;
BranchSide branch_side(const Ports& in) noexcept;

}  // namespace floatframe

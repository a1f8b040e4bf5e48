#include "floatframe/rotors/rotor_symmetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "floatframe/body/cut_pair.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/element_outputs.hpp"

namespace floatframe {
namespace {

/// Mass properties of welded bodies, in the design configuration, world axes.
struct RigidRotor {
  double mass = 0.0;
  Vec3 centre = Vec3::Zero();
  Mat3 J = Mat3::Zero();  ///< about the centre

  RigidRotor(const Model& model, const std::vector<int>& bodies) {
    Vec3 moment = Vec3::Zero();
    const auto body = [&](int i) -> const Body& { return model.bodies[i]; };
    for (const int i : bodies) {
      const InertiaInvariants& I = body(i).data->invariants;
      moment += I.m * (body(i).X_WB * I.centre_of_mass());
      mass += I.m;
    }
    if (!(mass > 0.0)) return;
    centre = moment / mass;
    for (const int i : bodies) {
      const InertiaInvariants& I = body(i).data->invariants;
      const Mat3& R = body(i).X_WB.R;
      const Vec3 r = body(i).X_WB * I.centre_of_mass() - centre;
      J += R * I.inertia_about_centre() * R.transpose() +
           I.m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
  }
};

/// Moments of inertia normal to an axis: largest and smallest, and the product with the axis.
struct AcrossInertia {
  double low, high, product;

  AcrossInertia(const Mat3& J, const Vec3& axis) {
    const Vec3 e1 = axis.unitOrthogonal(), e2 = axis.cross(e1);
    const double a = e1.dot(J * e1), b = e2.dot(J * e2), c = e1.dot(J * e2);
    const double root = std::sqrt(0.25 * (a - b) * (a - b) + c * c);
    low = 0.5 * (a + b) - root;
    high = 0.5 * (a + b) + root;
    product = std::hypot(e1.dot(J * axis), e2.dot(J * axis));
  }
  bool symmetric() const { return high - low <= 1e-3 * high && product <= 1e-3 * high; }
};

std::vector<int> bodies_of(const Rotor& rotor) {
  std::vector<int> bodies;
  for (const RotorBody& r : rotor.bodies) bodies.push_back(r.body);
  return bodies;
}

std::string distance_text(const Model& model, const RotorBody& r) {
  const Body& b = model.bodies[r.body];
  const Vec3 c = b.data->invariants.centre_of_mass() - r.p_BP;
  const double off = (c - r.axis * r.axis.dot(c)).norm(), m = b.data->invariants.m;
  return fmt::format("the mass of body '{}' ({:.4g} kg) is {:.4g} m off the axis ({:.4g} kg m)",
                     b.name, m, off, m * off);
}

/// The mass farthest off the axis, if the rotor is out of balance.
std::optional<std::string> unbalance(const Model& model, const Rotor& rotor) {
  Vec3 sum = Vec3::Zero();
  double mass = 0.0, largest = 0.0;
  const RotorBody* worst = nullptr;
  for (const RotorBody& r : rotor.bodies) {
    const Body& b = model.bodies[r.body];
    const Vec3 c = b.data->invariants.centre_of_mass() - r.p_BP;
    const Vec3 moment = b.data->invariants.m * (b.X_WB.R * (c - r.axis * r.axis.dot(c)));
    sum += moment;
    mass += b.data->invariants.m;
    if (moment.norm() <= largest) continue;
    largest = moment.norm();
    worst = &r;
  }
  if (!worst || sum.norm() <= 1e-6 * mass * rotor.length) return std::nullopt;
  return distance_text(model, *worst) +
         fmt::format(
             "; put it on the axis, or leave it out (`response --rotor {}=FROM:TO:STEP --unbalance "
             "BODY=KG_M` shows what it does)",
             rotor.name);
}

/// Index of the one of `axes` (world) shared by all bearings between `bodies` and others.
std::optional<int> axis_of_bearings(const Model& model, const std::vector<int>& bodies,
                                    const Mat3& axes) {
  const auto on_rotor = [&](int marker) {
    if (marker < 0) return false;
    const int body = model.markers[marker].body;
    return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
  };
  std::vector<int> along{0, 1, 2};
  bool bearings = false;
  for (const Element& force : model.elements) {
    if (!is_bearing(force.type)) continue;
    const int a = force.markers[0], b = force.markers[1];
    if (on_rotor(a) == on_rotor(b)) continue;
    const Marker& m = model.markers[on_rotor(a) ? a : b];
    const Vec3 z = model.bodies[m.body].X_WB.R * m.X_NM.R.col(2);
    bearings = true;
    std::erase_if(along, [&](int k) { return z.cross(axes.col(k)).norm() > 1e-6; });
  }
  if (!bearings || along.size() != 1) return std::nullopt;
  return along.front();
}

}  // namespace

std::vector<std::string> asymmetries(const Model& model, const Rotor& rotor) {
  std::vector<std::string> found;
  if (auto text = unbalance(model, rotor)) found.push_back(std::move(*text));
  const RotorBody& first = rotor.bodies.front();
  const Vec3 axis = model.bodies[first.body].X_WB.R * first.axis;
  const AcrossInertia across(RigidRotor(model, bodies_of(rotor)).J, axis);
  if (found.empty() && !across.symmetric())
    found.push_back(
        across.product > 1e-3 * across.high
            ? fmt::format(
                  "its axis is no principal axis of its inertia (product of inertia {:.4g} kg m2)",
                  across.product)
            : fmt::format("its moments of inertia across the axis are {:.6g} and {:.6g} kg m2",
                          across.low, across.high));
  for (const RotorBody& r : rotor.bodies) {
    const Body& b = model.bodies[r.body];
    const VecX& f = b.data->fixed_interface_frequencies;
    const Eigen::Index n = f.size();
    const bool bars = n > 0 && b.data->mode_names.back().rfind("normal ", 0) == 0;
    if (const auto cut = cut_pair(*b.data)) {
      found.push_back(fmt::format("body '{}': {}", b.name,
                                  cut_pair_text(*cut, bars ? "normal_modes" : "modes")));
    } else if (n > 0 && !bars && (n == 1 || !equal_frequency(f[n - 2], f[n - 1]))) {
      // Body files do not contain the omitted modes.
      found.push_back(
          fmt::format("body '{}': its last mode ({:.6g} Hz) may be one of a pair that 'modes: {}' "
                      "cuts (the report of its reduction says so)",
                      b.name, f[n - 1], n));
    }
  }
  return found;
}

void require_symmetry(const Model& model, const Rotor& rotor, double dependence) {
  if (dependence <= symmetric_enough) return;
  std::string reasons;
  for (const std::string& text : asymmetries(model, rotor))
    reasons += (reasons.empty() ? ": " : "; ") + text;
  throw RunError(
      ErrorCode::not_steady,
      fmt::format(
          "'{}': the linear system depends on the angle of the rotor (eigenvalues change by {:.2g} "
          "%), so that no eigenvalues tell of its vibrations{}{}{}",
          rotor.name, 100.0 * dependence, reasons,
          reasons.empty()
              ? "; expected a rotor that is symmetric about its axis, with modes in equal pairs"
              : "",
          rotor.other_axis));
}

int fitting_axis(const Model& model, const std::string& joint, const std::vector<int>& bodies,
                 const Mat3& axes) {
  std::vector<int> symmetric;
  if (const auto along = axis_of_bearings(model, bodies, axes)) return *along;
  const Mat3 J = RigidRotor(model, bodies).J;
  std::string names;
  for (int k = 0; k < 3; ++k)
    if (AcrossInertia(J, axes.col(k)).symmetric()) {
      symmetric.push_back(k);
      names += fmt::format("{}{}", names.empty() ? "" : ", ", "xyz"[k]);
    }
  if (symmetric.size() == 1) return symmetric.front();
  throw InputError(
      ErrorCode::unsupported,
      symmetric.empty()
          ? fmt::format("the rotor on the free joint '{}' is symmetric about none of the joint's "
                        "axes x, y, z; name the one that it turns about with --axis",
                        joint)
          : fmt::format("the rotor on the free joint '{}' is symmetric about {}; name the one that "
                        "it turns about with --axis",
                        joint, names));
}

std::string other_axis_of_bearings(const Model& model, const std::vector<int>& bodies,
                                   const Mat3& axes, const Vec3& axis) {
  const auto along = axis_of_bearings(model, bodies, axes);
  if (!along || axes.col(*along).cross(axis).norm() < 1e-6) return {};
  return fmt::format("; the bearings of the rotor have the axis {} of the joint", "xyz"[*along]);
}

}  // namespace floatframe

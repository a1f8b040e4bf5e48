#include "floatframe/fe/unit_system.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace floatframe {
namespace {

struct Unit {
  const char* name;
  double value;  // SI
};

constexpr double inch = 0.0254, foot = 0.3048;   // [m], exact
constexpr double pound = 0.45359237;             // [kg], exact
constexpr double pound_force = pound * 9.80665;  // [N], exact
constexpr double slug = pound_force / foot;      // [kg] = lbf s2/ft

constexpr std::array lengths{Unit{"m", 1.0},   Unit{"mm", 1e-3}, Unit{"cm", 1e-2},
                             Unit{"dm", 0.1},  Unit{"um", 1e-6}, Unit{"km", 1e3},
                             Unit{"in", inch}, Unit{"ft", foot}};
constexpr std::array masses{
    Unit{"kg", 1.0},   Unit{"g", 1e-3},    Unit{"mg", 1e-6},   Unit{"t", 1e3},
    Unit{"lb", pound}, Unit{"lbm", pound}, Unit{"slug", slug}, Unit{"slinch", pound_force / inch}};
// A unit of force instead of mass: the mass that it accelerates by one length per time squared.
constexpr std::array forces{Unit{"n", 1.0},    Unit{"kn", 1e3},          Unit{"mn", 1e6},
                            Unit{"dan", 10.0}, Unit{"lbf", pound_force}, Unit{"kgf", 9.80665}};
constexpr std::array times{Unit{"s", 1.0}, Unit{"ms", 1e-3}, Unit{"us", 1e-6}};

template <std::size_t n>
const Unit* find(const std::array<Unit, n>& list, std::string_view name) {
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Unit& u) { return name == u.name; });
  return it == list.end() ? nullptr : &*it;
}

}  // namespace

std::optional<UnitSystem> find_unit_system(const std::string& name) {
  std::string lower;
  for (const char c : name) {
    lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  if (lower == "si") lower = "m-kg-s";
  const Unit *length = nullptr, *mass = nullptr, *force = nullptr, *time = nullptr;
  std::string_view rest = lower;
  int words = 0;
  for (bool more = true; more; ++words) {
    const std::size_t dash = rest.find('-');
    const std::string_view word = rest.substr(0, dash);
    more = dash != std::string_view::npos;
    if (more) rest.remove_prefix(dash + 1);
    if (const Unit* l = find(lengths, word)) {
      length = l;
    } else if (const Unit* m = find(masses, word)) {
      mass = m;
    } else if (const Unit* f = find(forces, word)) {
      force = f;
    } else if (const Unit* t = find(times, word)) {
      time = t;
    } else {
      return std::nullopt;
    }
  }
  if (words != 3 || length == nullptr || time == nullptr || (mass == nullptr && force == nullptr)) {
    return std::nullopt;
  }
  UnitSystem units;
  units.name =
      std::string(length->name) + "-" + (mass != nullptr ? mass : force)->name + "-" + time->name;
  units.length = length->value;
  units.time = time->value;
  units.mass =
      mass != nullptr ? mass->value : force->value * time->value * time->value / length->value;
  return units;
}

std::vector<std::string> unit_system_names() {
  return {"m-kg-s",  "si",     "mm-t-s",   "mm-kg-ms", "mm-kg-s",
          "mm-g-ms", "cm-g-s", "in-lbf-s", "ft-slug-s"};
}

void to_si(FeModel& model, const UnitSystem& units) {
  const double l = units.length, l2 = l * l, l4 = l2 * l2;
  model.units = units.name;
  for (Vec3& p : model.positions) p *= l;
  for (Material& m : model.materials) {
    m.young *= units.pressure();
    m.density *= units.density();
    if (m.elasticity) *m.elasticity *= units.pressure();
  }
  for (BeamSection& s : model.sections) {
    for (double* x : {&s.A, &s.shear_y, &s.shear_z}) *x *= l2;
    s.Iy *= l4;
    s.Iz *= l4;
    s.J *= l4;
    for (double* x : {&s.width, &s.height, &s.bore}) *x *= l;
  }
  for (ShellSection& s : model.shells) {
    s.thickness *= l;
    s.shear *= l;
    s.offset *= l;
    s.mass *= units.mass / l2;
    s.coupling *= units.pressure();
    for (ShellPly& ply : s.plies) ply.thickness *= l;
  }
  for (Layup& layup : model.layups)
    for (ShellPly& ply : layup.plies) ply.thickness *= l;
  for (Orientation& o : model.orientations) o.origin *= l;
  // k e^2 is an energy. With translations e is a length, and rotations count with lengths.
  for (Spring& s : model.springs) {
    const bool turns_only =
        s.directions[0].head<3>().isZero(0.0) && s.directions[1].head<3>().isZero(0.0);
    s.stiffness *= turns_only ? units.force() * l : units.force() / l;
    if (turns_only) continue;
    for (Vec6& d : s.directions) d.tail<3>() *= l;
  }
  for (PointMass& m : model.masses) {
    m.mass *= units.mass;
    m.J *= units.mass * l2;
  }
  // sum_t a u + sum_r b theta = 0, times the unit of length: sum_t a (l u) + sum_r (l b) theta = 0.
  for (LinearEquation& equation : model.equations) {
    for (LinearEquation::Term& term : equation.terms) {
      if (term.axis >= 3) term.factor *= l;
    }
  }
  if (!model.matrices) return;
  // q^T K q and dq^T M dq are energies; translations are lengths, rotations are radians.
  FeMatrices& matrices = *model.matrices;
  const double energy = units.force() * l, inertia = units.mass * l2;
  const auto unit = [&](Eigen::Index i) { return matrices.dofs[i].axis < 3 ? l : 1.0; };
  const auto scale = [&](SparseMatrix& matrix, double whole) {
    for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
      for (SparseMatrix::InnerIterator it(matrix, column); it; ++it) {
        it.valueRef() *= whole / (unit(it.row()) * unit(it.col()));
      }
    }
  };
  scale(matrices.K, energy);
  scale(matrices.M, inertia);
  scale(matrices.C, energy * units.time);
}

}  // namespace floatframe

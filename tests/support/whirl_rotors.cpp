#include "support/whirl_rotors.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

namespace floatframe::test {
namespace {

std::string nastran_deck(const AssembledRotor& r) {
  const double I = r.second_moment();
  std::string t = "SOL 103\nCEND\nBEGIN BULK\n";
  for (int k = 0; k < r.nodes(); ++k) t += fmt::format("GRID,{},,{:.6f},0.,0.\n", k + 1, r.x[k]);
  for (int k = 1; k < r.nodes(); ++k) t += fmt::format("CBAR,{0},1,{0},{1},0.,1.,0.\n", k, k + 1);
  t += fmt::format("PBAR,1,1,{:.9e},{:.9e},{:.9e},{:.9e}\n", r.area(), I, I, 2 * I);
  if (r.shear_factor > 0.0) t += fmt::format(",,,,,,,,\n,{0},{0}\n", r.shear_factor);
  t += fmt::format("MAT1,1,{:.6e},,{},{}.\n", r.young, r.poisson, r.density);
  int id = 100;
  for (const AssembledRotor::Disc& d : r.discs)
    t += fmt::format("CONM2,{},{},,{:.9f}\n,{:.9f},,{:.9f},,,{:.9f}\n", id++, d.node + 1, d.m,
                     d.J_p, d.J_t, d.J_t);
  return t + "ENDDATA\n";
}

std::string masses(const AssembledRotor& r, int first_node) {
  std::string t;
  int k = 0;
  for (const AssembledRotor::Disc& d : r.discs) {
    const int node = first_node < 0 ? d.node + 1 : first_node + k;
    t += fmt::format(
        "*ELEMENT, TYPE=MASS, ELSET=DM{0}\n{1}, {2}\n*MASS, ELSET=DM{0}\n{3:.12g}\n"
        "*ELEMENT, TYPE=ROTARYI, ELSET=DR{0}\n{4}, {2}\n*ROTARY INERTIA, ELSET=DR{0}\n"
        "{5:.12g}, {6:.12g}, {6:.12g}\n",
        k, 100001 + 2 * k, node, d.m, 100002 + 2 * k, d.J_p, d.J_t);
    ++k;
  }
  return t;
}

std::string material(const AssembledRotor& r) {
  return fmt::format("*MATERIAL, NAME=M\n*ELASTIC\n{}, {}\n*DENSITY\n{}\n", r.young, r.poisson,
                     r.density);
}

std::string abaqus_deck(const AssembledRotor& r) {
  std::string t = "*NODE\n";
  for (int k = 0; k < r.nodes(); ++k) t += fmt::format("{}, {:.9g}, 0, 0\n", k + 1, r.x[k]);
  t += "*ELEMENT, TYPE=B33, ELSET=E\n";
  for (int k = 1; k < r.nodes(); ++k) t += fmt::format("{0}, {0}, {1}\n", k, k + 1);
  t += fmt::format("*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=CIRC\n{}\n0,1,0\n", r.diameter / 2);
  return t + material(r) + masses(r, -1);
}

/// A cylinder of 20-node bricks: four in a square about the axis, eight around them.
class SolidShaft {
 public:
  explicit SolidShaft(const AssembledRotor& r) : r_(r) { section(); }

  std::string deck() {
    const int parts = r_.nodes() - 1;
    std::string elements = "*ELEMENT, TYPE=C3D20, ELSET=E\n";
    int id = 0;
    for (int e = 0; e < parts; ++e)
      for (const std::array<int, 8>& q : quads_) {
        // y, z turn from the first to the next corner, x along the shaft.
        elements += fmt::format("{}", ++id);
        const auto add = [&](int layer, int point) {
          elements += fmt::format(", {}", node(layer, point));
        };
        for (int c = 0; c < 4; ++c) add(2 * e, q[c]);
        for (int c = 0; c < 4; ++c) add(2 * e + 2, q[c]);
        for (int c = 4; c < 8; ++c) add(2 * e, q[c]);
        elements += ",\n";
        std::string last;
        for (int c = 4; c < 8; ++c) last += fmt::format("{}, ", node(2 * e + 2, q[c]));
        for (int c = 0; c < 4; ++c)
          last += fmt::format("{}{}", node(2 * e + 1, q[c]), c < 3 ? ", " : "\n");
        elements += last;
      }
    std::string t = "*NODE\n";
    for (const auto& [key, number] : numbers_) {
      const auto& [layer, point] = key;
      const double x =
          layer % 2 == 0 ? r_.x[layer / 2] : 0.5 * (r_.x[layer / 2] + r_.x[layer / 2 + 1]);
      t += fmt::format("{}, {:.12g}, {:.12g}, {:.12g}\n", number, x, points_[point][0],
                       points_[point][1]);
    }
    for (std::size_t k = 0; k < r_.discs.size(); ++k)
      t += fmt::format("{}, {:.12g}, 0, 0\n", 50001 + k, r_.x[r_.discs[k].node]);
    t += elements + "*SOLID SECTION, ELSET=E, MATERIAL=M\n" + material(r_);
    for (std::size_t k = 0; k < r_.discs.size(); ++k) {
      t += set(fmt::format("DISC{}", k), 2 * r_.discs[k].node);
      t += fmt::format(
          "*SURFACE, TYPE=NODE, NAME=S{0}\nDISC{0}, 1.0\n*COUPLING, REF NODE={1}, SURFACE=S{0}, "
          "CONSTRAINT NAME=C{0}\n*DISTRIBUTING\n",
          k, 50001 + k);
    }
    t += set("A", 0) + set("B", 2 * parts);
    return t + masses(r_, 50001);
  }

 private:
  int point(double y, double z) {
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (std::hypot(points_[k][0] - y, points_[k][1] - z) < 1e-9) return static_cast<int>(k);
    points_.push_back({y, z});
    return static_cast<int>(points_.size()) - 1;
  }
  using Place = std::array<double, 2>;
  static Place middle(const Place& a, const Place& b) {
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  }
  /// Corners a, b, c, d and the middles between them; on the circle those of `b` and `c`.
  void quad(const Place& a, const Place& b, const Place& c, const Place& d, bool outside) {
    Place outer = middle(b, c);
    if (outside) {
      const double stretch = r_.diameter / 2 / std::hypot(outer[0], outer[1]);
      outer = {outer[0] * stretch, outer[1] * stretch};
    }
    const Place all[8] = {a, b, c, d, middle(a, b), outer, middle(c, d), middle(d, a)};
    std::array<int, 8> q{};
    for (int k = 0; k < 8; ++k) q[k] = point(all[k][0], all[k][1]);
    quads_.push_back(q);
  }
  void section() {
    const double R = r_.diameter / 2, h = 0.55 * R;
    const auto at = [&](double radius, int eighth) {
      const double angle = std::numbers::pi / 4 * eighth;
      return Place{radius * std::cos(angle), radius * std::sin(angle)};
    };
    const auto inner = [&](int eighth) { return at(eighth % 2 == 0 ? h : 1.25 * h, eighth); };
    for (int k = 0; k < 8; k += 2) quad({0.0, 0.0}, inner(k), inner(k + 1), inner(k + 2), false);
    for (int k = 0; k < 8; ++k) quad(inner(k), at(R, k), at(R, k + 1), inner(k + 1), true);
  }
  int node(int layer, int point) {
    return numbers_.try_emplace({layer, point}, static_cast<int>(numbers_.size()) + 1)
        .first->second;
  }
  std::string set(const std::string& name, int layer) const {
    std::string t = "*NSET, NSET=" + name + "\n";
    for (const auto& [key, number] : numbers_)
      if (key.first == layer) t += fmt::format("{}\n", number);
    return t;
  }

  const AssembledRotor& r_;
  std::vector<Place> points_;
  std::vector<std::array<int, 8>> quads_;
  std::map<std::pair<int, int>, int> numbers_;
};

std::string bearing(const char* name, const AssembledRotor::Bearing& b, double x, const char* at,
                    double axial) {
  return fmt::format(
      "  {}: {{type: bearing, from: {{body: ground, at: [{:.9g}, 0, 0]}}, to: {{body: shaft, {}}}, "
      "axis: x, axis_2: y, stiffness: [[{}, {}, 0, 0, 0, 0], [{}, {}, 0, 0, 0, 0], [0, 0, {}, 0, "
      "0, "
      "0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]], damping: [[{}, {}], [{}, "
      "{}]]}}\n",
      name, x, at, b.K(0, 0), b.K(0, 1), b.K(1, 0), b.K(1, 1), axial, b.C(0, 0), b.C(0, 1),
      b.C(1, 0), b.C(1, 1));
}

/// A shaft of bars from disc to disc, which are bodies welded to it.
std::string bars(const AssembledRotor& r, const RotorOptions& o) {
  std::vector<int> stops{0};
  for (const AssembledRotor::Disc& d : r.discs) stops.push_back(d.node);
  stops.push_back(r.nodes() - 1);
  const auto last = stops.size() - 1;
  std::string t = "points: {";
  for (std::size_t k = 0; k <= last; ++k)
    t += fmt::format("{}p{}: [{:.9g}, 0, 0]", k > 0 ? ", " : "", k, r.x[stops[k]]);
  t += fmt::format(
      "}}\nbodies:\n  shaft:\n    flexible:\n      material: {{young: {}, poisson: {}, density: "
      "{}}}\n      bars:\n",
      r.young, r.poisson, r.density);
  for (std::size_t k = 0; k < last; ++k)
    t += fmt::format("        b{}: {{from: p{}, to: p{}, elements: {}, section: {{round: {}}}}}\n",
                     k, k, k + 1, stops[k + 1] - stops[k], r.diameter);
  t += "      clamped: [p0]\n      static_modes:\n";
  for (std::size_t k = 1; k <= last; ++k)
    t += fmt::format("        - {{point: p{}, dofs: [y, z, ry, rz]}}\n", k);
  t += "      normal_modes: 25\n      mass_model: hermite\n      section_inertia: true\n";
  if (!o.stiffening.empty()) t += "    geometric_stiffening: " + o.stiffening + "\n";
  std::string joints;
  for (std::size_t k = 0; k < r.discs.size(); ++k) {
    const AssembledRotor::Disc& d = r.discs[k];
    t += fmt::format(
        "  disc{}: {{rigid: {{mass: {:.12g}, centre_of_mass: p{}, inertia: [{:.12g}, {:.12g}, "
        "{:.12g}]}}}}\n",
        k, d.m, k + 1, d.J_p, d.J_t, d.J_t);
    joints += fmt::format("  hub{0}: {{type: weld, parent: shaft, child: disc{0}, at: p{1}}}\n", k,
                          k + 1);
  }
  return t +
         fmt::format(
             "joints:\n  motor: {{type: free, child: shaft, at: p0, velocity: [0, 0, 0, "
             "{}, 0, 0]}}\n",
             o.speed) +
         joints;
}

std::string part(const TemporaryFolder& folder, const AssembledRotor& r, const RotorOptions& o) {
  std::string file, keys;
  const std::string ends =
      fmt::format("interfaces: {{A: {{node: 1}}, B: {{node: {}}}}}, modes: {}", r.nodes(), o.modes);
  switch (o.kind) {
    case RotorKind::cbar:
      file = folder.write("rotor.bdf", nastran_deck(r));
      keys = fmt::format("units: si, {}, mass_form: {}", ends, o.lumped ? "lumped" : "consistent");
      break;
    case RotorKind::b33:
      file = folder.write("rotor.inp", abaqus_deck(r));
      keys = "units: si, dialect: abaqus, mass_form: consistent, " + ends;
      break;
    default:
      file = folder.write("rotor.inp", SolidShaft(r).deck());
      keys =
          "units: si, dialect: abaqus, "
          "interfaces: {A: {set: A, type: mean}, B: {set: B, type: mean}}, modes: 25";
  }
  std::string t = fmt::format(
      "bodies:\n  shaft:\n    flexible: {{file: {}, {}, free_check: false, reference: {}{}}}\n",
      file, keys, o.node_frame ? "{node: A}" : "mean_axis",
      o.inertia == "projection" ? ", projection: true" : "");
  if (!o.stiffening.empty()) t += "    geometric_stiffening: " + o.stiffening + "\n";
  return t + fmt::format(
                 "joints:\n  motor: {{type: free, child: shaft, child_node: A, velocity: [0, "
                 "{}, 0, {}, 0, 0]}}\n",
                 o.across, o.speed);
}

}  // namespace

std::string write_rotor(const TemporaryFolder& folder, const AssembledRotor& rotor,
                        const RotorOptions& o) {
  const bool of_bars = o.kind == RotorKind::bars;
  std::string t = "floatframe: 1\nname: rotor\ngravity: [0, 0, 0]\n";
  t += of_bars ? bars(rotor, o) : part(folder, rotor, o);
  t += "forces:\n";
  const std::size_t last = rotor.discs.size() + 1;
  t += bearing("left", rotor.bearings[0], rotor.x.front(), of_bars ? "at: p0" : "node: A", 1e7);
  t += bearing("right", rotor.bearings[1], rotor.x.back(),
               of_bars ? fmt::format("at: p{}", last).c_str() : "node: B", 0.0);
  t += o.extra;
  t += fmt::format("simulation: {{step: {}, duration: {}, coordinates: {}, inertia: {}}}\n", o.step,
                   o.duration, o.coordinates, o.inertia);
  return folder.write("rotor.yaml", t);
}

}  // namespace floatframe::test

// Bars: wrong units, bending stiffnesses and their directions.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "floatframe/fe/unit_system.hpp"
#include "floatframe/model/build_flexible.hpp"
#include "floatframe/model/hint_list.hpp"

namespace floatframe {
namespace {

struct BarMaterial {
  double young = 0.0, density = 0.0;                                ///< [Pa], [kg/m3]
  double wave_speed() const { return std::sqrt(young / density); }  ///< [m/s]
};

/// From rubber and foam to diamond. Each number alone may be valid; the combination is limited:
/// waves travel at 30 m/s in soft rubber, at 18 km/s in diamond.
bool usual_material(const BarMaterial& m) {
  if (!(m.young > 1e5 && m.young < 2e12)) return false;
  if (m.density == 0.0) return true;
  return m.density > 20.0 && m.density < 3e4 && m.wave_speed() > 10.0 && m.wave_speed() < 2.5e4;
}

/// Usual structural materials.
bool likely_material(const BarMaterial& m) {
  return m.young > 1e6 && m.young < 1.3e12 && m.density > 100.0 && m.density < 2.3e4 &&
         m.wave_speed() > 50.0 && m.wave_speed() < 2e4;
}

std::string material_text(const BarMaterial& m) {
  return fmt::format("a Young's modulus of {:.4g} Pa and a density of {:.4g} kg/m3", m.young,
                     m.density);
}

/// Units in which the numbers match a likely material; empty: none.
std::string meant_units(const BarMaterial& m) {
  struct Meant {
    std::string text;
    double young, density;  ///< SI value of one
  };
  std::vector<Meant> all{{"the density may be in g/cm3", 1.0, 1e3},
                         {"the density may be in t/mm3", 1.0, 1e12},
                         {"the density may be in kg/mm3", 1.0, 1e9},
                         {"Young's modulus may be in GPa", 1e9, 1.0},
                         {"Young's modulus may be in MPa", 1e6, 1.0}};
  for (const char* name : {"mm-t-s", "mm-kg-ms", "mm-kg-s", "cm-g-s", "in-lbf-s"})
    if (const auto u = find_unit_system(name))
      all.push_back({fmt::format("it may be in {}", name), u->pressure(), u->density()});
  all.push_back({"it may be in GPa and g/cm3", 1e9, 1e3});
  all.push_back({"it may be in MPa and g/cm3", 1e6, 1e3});
  for (const Meant& unit : all) {
    const BarMaterial there{unit.young * m.young, unit.density * m.density};
    if (likely_material(there))
      return fmt::format("{}: {:.4g} Pa, {:.4g} kg/m3", unit.text, there.young, there.density);
  }
  return "";
}

/// Size of the section, or for given constants the largest length that they correspond to [m].
double section_size(const BeamSection& s) {
  if (s.outline != BeamSection::Outline::unknown) return std::max(s.width, s.height);
  const double gyration = s.A > 0.0 ? std::sqrt(std::max(s.Iy, s.Iz) / s.A) : 0.0;
  return std::max(std::sqrt(s.A), gyration);
}

double frame_size(const FrameDescription& f) {
  Eigen::AlignedBox3d box;
  for (const auto& [name, p] : f.points) box.extend(p);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

void hint_at_lengths(const std::string& body, const FrameDescription& f, HintList& out) {
  const double size = frame_size(f);
  if (!(size > 1e-3 && size < 200.0)) {
    const double in_mm = 1e-3 * size;
    out.add("body", body,
            fmt::format("its points are up to {:.4g} m apart, which is unusual; {}", size,
                        in_mm > 1e-3 && in_mm < 200.0
                            ? fmt::format("they may be in mm: {:.4g} m", in_mm)
                            : std::string("a model file is in m")));
    return;
  }
  for (const BarDescription& bar : f.bars) {
    const double across = section_size(bar_section(bar.section));
    if (!(across > size)) continue;
    out.add(
        "body", body,
        fmt::format("the section of its bar '{}' measures {:.4g} m, more than the body, whose "
                    "points are {:.4g} m apart, which is unusual; {}",
                    bar.name, across, size,
                    1e-3 * across < size ? fmt::format("it may be in mm: {:.4g} m", 1e-3 * across)
                                         : std::string("a model file has m, m2 and m4")));
    return;
  }
}

/// The template of a body: its directions in the design configuration.
Vec3 design_direction(const BodyDescription& body, const Vec3& d) {
  return body.X_WB.R * (body.mirror * (body.X_WT.R.transpose() * d));
}

/// For a line, whose sense does not matter: its largest component is positive.
Vec3 line_direction(const Vec3& d) {
  Eigen::Index largest = 0;
  d.cwiseAbs().maxCoeff(&largest);
  return d[largest] < 0.0 ? Vec3(-d) : d;
}

bool same_bending(const BarBending& a, const BarBending& b) {
  for (std::size_t k = 0; k < 2; ++k)
    if (std::abs(a.stiffness[k] - b.stiffness[k]) > 1e-9 * a.stiffness[0]) return false;
  if (a.alike()) return true;
  return std::abs(a.direction[0].dot(b.direction[0])) > 1.0 - 1e-6 &&
         std::abs(a.direction[1].dot(b.direction[1])) > 1.0 - 1e-6;
}

/// The start point of a bar, in its template.
Vec3 bar_start(const FrameDescription& f, const BarDescription& bar) {
  if (!bar.from_bar) return f.points.at(bar.from);
  const auto other = std::find_if(f.bars.begin(), f.bars.end(),
                                  [&](const BarDescription& b) { return b.name == *bar.from_bar; });
  const Vec3 from = bar_start(f, *other);
  return from + bar.from_fraction * (f.points.at(other->to) - from);
}

}  // namespace

void hint_at_units(const ModelDescription& description, HintList& out) {
  for (const BodyDescription& body : description.bodies) {
    const auto* frame = std::get_if<FlexibleDescription>(&body.kind);
    if (frame == nullptr) continue;
    const BarMaterial m{frame->young, frame->density};
    if (!usual_material(m)) {
      const std::string meant = meant_units(m);
      out.add("body", body.name,
              fmt::format("its material has {}, which is unusual; {}", material_text(m),
                          meant.empty() ? "a model file is in Pa and kg/m3" : meant));
    }
    hint_at_lengths(body.name, *frame, out);
  }
}

std::vector<BarBending> bar_bending(const ModelDescription& description, const Model& model) {
  std::vector<BarBending> out;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const BodyDescription& body = description.bodies[i];
    const auto* frame = std::get_if<FlexibleDescription>(&body.kind);
    if (frame == nullptr || model.bodies[i].modes() == 0) continue;
    const std::size_t first = out.size();
    for (const BarDescription& bar : frame->bars) {
      // Local axes as in the element: y in the plane of the bar and its reference.
      const Vec3 x = (frame->points.at(bar.to) - bar_start(*frame, bar)).normalized();
      const Vec3 y = (bar.reference - x * x.dot(bar.reference)).normalized(), z = x.cross(y);
      const BeamSection s = bar_section(bar.section);
      BarBending b;
      b.body = static_cast<int>(i);
      b.bars = {bar.name};
      b.stiffness = {frame->young * s.Iz, frame->young * s.Iy};  // bending along y, along z
      b.direction = {line_direction(design_direction(body, y)),
                     line_direction(design_direction(body, z))};
      if (b.stiffness[0] < b.stiffness[1]) {
        std::swap(b.stiffness[0], b.stiffness[1]);
        std::swap(b.direction[0], b.direction[1]);
      }
      const auto known = std::find_if(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                                      [&](const BarBending& o) { return same_bending(o, b); });
      if (known == out.end())
        out.push_back(std::move(b));
      else
        known->bars.push_back(bar.name);
    }
  }
  return out;
}

}  // namespace floatframe

// Most files do not state the units. Numbers that no material has indicate a wrong choice.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/fe/unit_system.hpp"
#include "floatframe/reduction/part_health.hpp"

namespace floatframe {
namespace {

/// Quantities used by the check; zero: unknown.
struct Numbers {
  double density = 0.0;  ///< of the first material, or mass per volume of the box [kg/m3]
  double young = 0.0;    ///< [Pa]
  double size = 0.0;     ///< diagonal of the box [m]
  bool of_material = false;
};

bool usual(const Numbers& x) {
  const double least = x.of_material ? 20.0 : 1.0;
  if (x.density > 0.0 && !(x.density > least && x.density < 3e4)) return false;
  if (x.young > 0.0 && !(x.young > 1e5 && x.young < 2e12)) return false;
  return x.size > 1e-3 && x.size < 200.0;
}

Numbers numbers_of(const FeModel& model, double mass) {
  Numbers x;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : model.positions) box.extend(p);
  x.size = box.isEmpty() ? 0.0 : box.diagonal().norm();
  for (const FeElement& e : model.elements) {
    const Material& m = model.materials[e.material];
    if (m.density == 0.0) continue;
    x.density = m.density;
    x.young = m.young;
    x.of_material = true;
    return x;
  }
  const double volume = box.isEmpty() ? 0.0 : box.volume();
  if (volume > 1e-6 * std::pow(x.size, 3)) x.density = mass / volume;
  return x;
}

std::string text(const Numbers& x) {
  std::string out = fmt::format("a size of {:.3g} m", x.size);
  if (x.density > 0.0) out = fmt::format("a density of {:.3g} kg/m3 and ", x.density) + out;
  if (x.young > 0.0) out = fmt::format("a Young's modulus of {:.3g} Pa, ", x.young) + out;
  return out;
}

}  // namespace

std::string unit_guess(const FeModel& model, double mass) {
  const Numbers x = numbers_of(model, mass);
  if (usual(x)) return "";
  const std::string found = "the part has " + text(x) + ", which is unusual";
  // A material can be explained by other units; the box about masses on springs has any density.
  if (!x.of_material) return found + "; check the units of the file";
  std::vector<std::string> read_as{"m-kg-s", "mm-t-s", "mm-kg-ms", "mm-kg-s"};
  if (!model.units.empty()) read_as = {model.units};
  for (const std::string& given_name : read_as) {
    const auto given = find_unit_system(given_name);
    for (const char* meant_name :
         {"mm-t-s", "m-kg-s", "mm-kg-ms", "mm-kg-s", "cm-g-s", "in-lbf-s"}) {
      const auto meant = find_unit_system(meant_name);
      if (!given || !meant || given_name == meant_name) continue;
      Numbers y = x;
      y.density *= meant->density() / given->density();
      y.young *= meant->pressure() / given->pressure();
      y.size *= meant->length / given->length;
      if (!usual(y)) continue;
      const std::string read = model.units.empty()
                                   ? "if the file was read as " + given_name + ", it"
                                   : "read as " + given_name + ", it";
      return fmt::format("{}; {} may be in {}: then it has {}", found, read, meant_name, text(y));
    }
  }
  return found + "; check the units of the file";
}

}  // namespace floatframe

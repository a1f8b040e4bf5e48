// The group of a flexible body made of bars: material, masses, reference, modes; with the checks
// that need the geometry.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "floatframe/core/suggest.hpp"
#include "floatframe/io/read_parts.hpp"

namespace floatframe {
namespace {

const std::vector<std::string> dof_names{"x", "y", "z", "rx", "ry", "rz"};

class FlexibleReader {
 public:
  FlexibleReader(const ModelInstance& self, YamlSection& section)
      : self_(self), section_(section) {}

  FlexibleRead read() {
    material();
    read_bars(self_, section_, out_);
    masses();
    modes();
    section_.finish();
    return std::move(out_);
  }

 private:
  FlexibleDescription& f() { return out_.description; }

  void material() {
    const auto value = section_.require("material");
    if (!value) return;
    auto m = value->section("a map with young, poisson, density");
    if (!m) return;
    f().young = m->required_number("young", positive_number("Pa"), 1.0);
    NumberRule poisson{"a number above -1 and below 0.5", "", -1.0, 0.5, true, true};
    f().poisson = m->required_number("poisson", poisson, 0.3);
    f().density = m->required_number("density", positive_number("kg/m3"), 1.0);
    m->finish();
  }

  /// A node of this body by the name of its point.
  std::optional<std::string> node_name(const YamlValue& value) {
    const auto name = value.text("the name of an end point of a bar");
    if (!name) return std::nullopt;
    if (out_.named_nodes.count(*name)) return name;
    if (!out_.sound) return std::nullopt;
    std::vector<std::string> known;
    for (const auto& [key, unused] : out_.named_nodes) known.push_back(key);
    value.fault("found '" + *name + "', expected an end point of a bar of this body" +
                did_you_mean(*name, known));
    return std::nullopt;
  }

  void masses() {
    const auto value = section_.get("masses");
    if (!value) return;
    for (const YamlValue& item : value->list("a list of masses {point, mass}")) {
      auto s = item.section("a mass {point, mass}");
      if (!s) continue;
      NodeMass m;
      m.origin = s->origin();
      const auto point = s->require("point");
      const auto name = point ? node_name(*point) : std::nullopt;
      m.mass = s->required_number("mass", non_negative_number("kg"), 0.0);
      s->finish();
      if (!name) continue;
      m.node = *name;
      f().masses.push_back(std::move(m));
    }
  }

  /// One entry per dof, so that the order of the modes is that of the file.
  std::vector<NodeDofs> dofs(const char* key) {
    std::vector<NodeDofs> out;
    const auto value = section_.get(key);
    if (!value) return out;
    for (const YamlValue& item : value->list("a list of points or {point, dofs}")) {
      NodeDofs d;
      std::vector<unsigned> bits;
      std::optional<std::string> name;
      if (item.is_map()) {
        auto s = item.section();
        d.origin = s->origin();
        const auto point = s->require("point");
        name = point ? node_name(*point) : std::nullopt;
        if (const auto v = s->require("dofs")) {
          if (v->is_list()) {
            for (const YamlValue& w : v->list())
              if (const auto k = w.word(dof_names)) bits.push_back(static_cast<unsigned>(*k));
            if (v->node().items.empty())
              v->fault("found an empty list, expected directions such as [x, y, z]");
          } else if (const auto t = v->text("all or a list of x, y, z, rx, ry, rz")) {
            if (*t == "all")
              bits = {0, 1, 2, 3, 4, 5};
            else
              v->unexpected("all or a list of x, y, z, rx, ry, rz");
          }
        }
        s->finish();
      } else {
        d.origin.mark = item.mark();
        name = node_name(item);
        bits = {0, 1, 2, 3, 4, 5};
      }
      if (!name) continue;
      for (unsigned k : bits) {
        const auto [it, fresh] = taken_.insert({*name, k});
        if (!fresh)
          item.fault("the direction " + dof_names[k] + " of '" + *name +
                     "' is named twice in clamped and static_modes, expected once");
        d.node = *name;
        d.mask = 1u << k;
        if (fresh) out.push_back(d);
      }
    }
    return out;
  }

  void modes() {
    if (const auto v = section_.get("mass_model"))
      if (const auto w = v->word({"isoparametric", "six_dof", "hermite"}))
        f().mass_model = static_cast<MassModel>(*w);
    f().orthonormalise = section_.boolean("orthonormal", false);
    f().section_inertia = section_.boolean("section_inertia", false);
    if (f().section_inertia && f().mass_model == MassModel::isoparametric)
      section_.get("section_inertia")
          ->fault(
              "found true with the isoparametric mass model, expected mass_model six_dof or "
              "hermite");
    NumberRule ratio{"a fraction of critical damping from 0 to 1", "", 0.0, 1.0};
    f().damping_ratio = section_.number("damping", ratio, 0.0);
    const std::size_t faults_before = self_.context.faults->size();
    f().clamped = dofs("clamped");
    f().interfaces = dofs("static_modes");
    const auto normal = section_.get("normal_modes");
    const auto analytic = section_.get("analytic");
    const auto basis = section_.get("basis");
    if (analytic) {
      if (auto s = analytic->section("a map with dynamic_per_plane")) {
        const auto n = s->require("dynamic_per_plane");
        f().analytic.emplace();
        f().analytic->dynamic_per_plane =
            n ? n->integer(0, 50, "a number of shapes").value_or(0) : 0;
        s->finish();
        out_.modes = 2 * (1 + f().analytic->dynamic_per_plane);
      }
      if (f().bars.size() > 1 || !f().masses.empty())
        analytic->fault("analytic shapes need one straight bar without masses, found " +
                        std::to_string(f().bars.size()) + " bars and " +
                        std::to_string(f().masses.size()) + " masses");
    }
    for (const char* key : {"clamped", "static_modes", "normal_modes"}) {
      if (!section_.has(key) || (!analytic && !basis)) continue;
      if (analytic || std::string(key) != "clamped")
        section_.get(key)->fault(std::string("is not used with ") +
                                 (analytic ? "analytic shapes" : "a given basis") +
                                 ", expected no such key");
    }
    if (analytic && basis) basis->fault("found with analytic shapes, expected one of the two");
    if (analytic) return;
    if (basis) {
      read_basis(*basis);
      return;
    }
    if (normal && normal->is_map()) {
      auto s = normal->section();
      f().max_frequency = s->required_number("below", positive_number("Hz"), 1.0);
      s->finish();
    } else if (normal) {
      const auto n = normal->integer(0, 10000, "a number of modes, or {below: frequency},");
      f().normal_modes = n.value_or(0);
      const auto rows = static_cast<int>(out_.nodes.size()) *
                        (f().mass_model == MassModel::isoparametric ? 3 : 6);
      if (n && out_.sound && *n > rows)
        normal->fault("found " + std::to_string(*n) + " modes, expected at most " +
                      std::to_string(rows) + ", the number of degrees of freedom with mass");
    }
    out_.modes =
        f().max_frequency > 0.0 ? -1 : static_cast<int>(f().interfaces.size()) + f().normal_modes;
    if (out_.modes == 0 && self_.context.faults->size() == faults_before)
      section_.fault("found no modes, expected static_modes, normal_modes, analytic or basis");
    if (!section_.has("clamped"))
      section_.fault("missing key 'clamped'");
    else if (out_.sound)
      reference_removes_rigid_motion();
  }

  /// The clamped dofs must leave no rigid motion: the rows of rigid motions at these dofs have
  /// rank 6.
  void reference_removes_rigid_motion() {
    Vec3 centre = Vec3::Zero();
    double size = 0.0;
    for (const Vec3& p : out_.nodes) centre += p / static_cast<double>(out_.nodes.size());
    for (const Vec3& p : out_.nodes) size = std::max(size, (p - centre).norm());
    MatX rows(static_cast<Eigen::Index>(f().clamped.size()), 6);
    for (std::size_t i = 0; i < f().clamped.size(); ++i) {
      const Vec3 p = (f().points.at(f().clamped[i].node) - centre) / size;
      unsigned k = 0;
      while (!(f().clamped[i].mask & (1u << k))) ++k;
      Vec6 row = Vec6::Zero();  // row . (translation, rotation) = motion of this dof
      const Vec3 e = Vec3::Unit(static_cast<Eigen::Index>(k % 3));
      if (k < 3) {
        row.head<3>() = e;
        row.tail<3>() = p.cross(e);
      } else {
        row.tail<3>() = e;
      }
      rows.row(static_cast<Eigen::Index>(i)) = row.transpose();
    }
    Eigen::Index rank = 0;
    if (rows.rows() > 0) {
      Eigen::ColPivHouseholderQR<MatX> qr(rows);
      qr.setThreshold(1e-9);
      rank = qr.rank();
    }
    if (rank < 6)
      section_.get("clamped")->fault("these degrees of freedom leave " + std::to_string(6 - rank) +
                                     (rank == 5 ? " rigid motion" : " rigid motions") +
                                     " of the body free, expected none");
  }

  /// A CSV file without header: 6 rows a node (ux uy uz rx ry rz), one column a mode, in the body
  /// frame.
  void read_basis(const YamlValue& value) {
    const auto name = value.text("the name of a CSV file");
    if (!name) return;
    const std::string file = beside(self_, *name);
    std::string text;
    if (!read_text_file(file, text, *value.context().faults, value.mark(), value.path())) return;
    std::vector<std::vector<double>> rows;
    std::istringstream in(text);
    std::string line;
    int number = 0;
    const auto complain = [&](const std::string& sentence) {
      value.context().faults->add({file, number, 1}, sentence);
    };
    while (std::getline(in, line)) {
      ++number;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty() || line[0] == '#') continue;
      std::vector<double> row;
      std::istringstream cells(line);
      std::string cell;
      while (std::getline(cells, cell, ',')) {
        const std::size_t a = cell.find_first_not_of(" \t"), b = cell.find_last_not_of(" \t");
        const std::string word = a == std::string::npos ? "" : cell.substr(a, b - a + 1);
        const PlainScalar p = classify_plain_scalar(word);
        if (p.kind != PlainScalar::Kind::number)
          return complain("found '" + word.substr(0, 40) +
                          "', expected numbers separated by commas");
        row.push_back(p.number);
      }
      if (!rows.empty() && row.size() != rows.front().size())
        return complain("found " + std::to_string(row.size()) + " columns, expected " +
                        std::to_string(rows.front().size()) + " as in the first row");
      rows.push_back(std::move(row));
    }
    if (out_.sound && rows.size() != 6 * out_.nodes.size()) {
      value.fault("'" + file + "' has " + std::to_string(rows.size()) +
                  " rows, expected 6 for each of the " + std::to_string(out_.nodes.size()) +
                  " nodes");
      return;
    }
    if (rows.empty() || rows.front().empty()) return;
    MatX basis(static_cast<Eigen::Index>(rows.size()),
               static_cast<Eigen::Index>(rows.front().size()));
    for (Eigen::Index i = 0; i < basis.rows(); ++i)
      for (Eigen::Index j = 0; j < basis.cols(); ++j)
        basis(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    out_.modes = static_cast<int>(basis.cols());
    f().basis = std::move(basis);
  }

  const ModelInstance& self_;
  YamlSection& section_;
  FlexibleRead out_;
  std::set<std::pair<std::string, unsigned>> taken_;
};

}  // namespace

FlexibleRead read_flexible(const ModelInstance& self, YamlSection section) {
  return FlexibleReader(self, section).read();
}

}  // namespace floatframe

// The group of a flexible body made of bars: material, masses, reference, modes; with the checks
// that need the geometry.
#include <bit>
#include <set>
#include <sstream>

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

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
    f().young = m->required_number("young", rules::young, 1.0);
    f().poisson = m->required_number("poisson", rules::poisson, 0.3);
    f().density = m->required_number("density", rules::density, 1.0);
    m->finish();
  }

  /// A node of this body by the name of its point, at the key `point`.
  std::optional<std::string> node_name(YamlSection& s) {
    const auto point = s.require("point");
    return point ? node_name(*point) : std::nullopt;
  }
  std::optional<std::string> node_name(const YamlValue& value) {
    const auto name = value.text("the name of an end point of a bar");
    if (!name) return std::nullopt;
    if (out_.named_nodes.count(*name)) return name;
    if (!out_.valid) return std::nullopt;
    value.not_known(sentences::no_end_point(*name), *name,
                    [&] { return keys_of(out_.named_nodes); });
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
      const auto name = node_name(*s);
      m.mass = s->required_number("mass", rules::mass, 0.0);
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
        name = node_name(*s);
        if (const auto v = s->require("dofs")) bits = read_dofs(*v);
        s->finish();
      } else {
        d.origin.mark = item.mark();
        name = node_name(item);
        bits = {0, 1, 2, 3, 4, 5};
      }
      if (!name) continue;
      for (unsigned k : bits) {
        const auto [it, fresh] = taken_.insert({*name, k});
        if (!fresh) item.error(ErrorCode::duplicate, sentences::dof_twice(*name, k));
        d.node = *name;
        d.mask = 1u << k;
        if (fresh) out.push_back(d);
      }
    }
    return out;
  }

  /// Bars with the directions of the forces on a path along them.
  void path_shapes() {
    const auto value = section_.get("path_shapes");
    if (!value) return;
    for (const YamlValue& item : value->list("a list of bars {bar, dofs}")) {
      auto s = item.section("a bar {bar, dofs}");
      if (!s) continue;
      NodeDofs d;
      d.origin = s->origin();
      const auto bar = s->require("bar");
      if (const auto name = bar ? bar->text("the name of a bar") : std::nullopt) d.node = *name;
      if (const auto dofs = s->require("dofs"))
        for (const unsigned k : read_dofs(*dofs)) d.mask |= 1u << k;
      s->finish();
      if (!d.node.empty() && d.mask != 0) f().path.push_back(d);
    }
  }

  void modes() {
    section_.word("mass_model", rules::mass_models, f().mass_model);
    f().orthonormalise = section_.boolean("orthonormal", false);
    f().section_inertia = section_.boolean("section_inertia", false);
    if (const auto v = section_.get("section_inertia"))
      v->complain(ErrorCode::contradiction,
                  sentences::section_inertia(f().section_inertia,
                                             f().mass_model == MassModel::isoparametric));
    if (const auto v = section_.get("damping")) f().damping = read_damping(*v);
    const std::size_t errors_before = self_.context.errors->size();
    f().clamped = dofs("clamped");
    f().interfaces = dofs("static_modes");
    path_shapes();
    const auto normal = section_.get("normal_modes");
    const auto analytic = section_.get("analytic");
    const auto basis = section_.get("basis");
    if (analytic) {
      if (auto s = analytic->section("a map with dynamic_per_plane")) {
        const auto n = s->require("dynamic_per_plane");
        f().analytic.emplace();
        f().analytic->dynamic_per_plane = n ? n->integer(rules::analytic_shapes).value_or(0) : 0;
        s->finish();
        out_.modes = 2 * (1 + f().analytic->dynamic_per_plane);
      }
      analytic->complain(ErrorCode::wrong_value,
                         sentences::analytic_shapes(f().bars.size(), f().masses.size()));
    }
    for (const char* key : {"clamped", "static_modes", "path_shapes", "normal_modes"}) {
      if (!section_.has(key) || (!analytic && !basis)) continue;
      if (analytic || std::string(key) != "clamped")
        section_.get(key)->error(ErrorCode::exclusive,
                                 std::string("is not used with ") +
                                     (analytic ? "analytic shapes" : "a given basis") +
                                     "; remove this key");
    }
    if (analytic && basis)
      basis->error(ErrorCode::exclusive, "excludes analytic shapes; remove one of them");
    if (analytic) return;
    if (basis) {
      read_basis(*basis);
      return;
    }
    if (normal && normal->is_map()) {
      auto s = normal->section();
      f().max_frequency = s->required_number("below", rules::mode_frequency, 1.0);
      s->finish();
    } else if (normal) {
      const auto n = normal->integer(rules::normal_modes);
      f().normal_modes = n.value_or(0);
      if (n && out_.valid)
        normal->complain(ErrorCode::out_of_range,
                         sentences::more_modes_than_dofs(
                             *n, out_.nodes.size(), f().mass_model == MassModel::isoparametric));
    }
    out_.modes = f().max_frequency > 0.0 || !f().path.empty()
                     ? -1
                     : static_cast<int>(f().interfaces.size()) + f().normal_modes;
    if (out_.modes == 0 && self_.context.errors->size() == errors_before)
      section_.error(ErrorCode::missing, sentences::no_modes());
    if (!section_.has("clamped"))
      section_.error(ErrorCode::missing, "missing key 'clamped'");
    else if (out_.valid)
      reference_removes_rigid_motion();
  }

  /// The clamped dofs must leave no rigid motion.
  void reference_removes_rigid_motion() {
    std::vector<std::pair<Vec3, unsigned>> clamped;
    for (const NodeDofs& d : f().clamped)
      clamped.emplace_back(f().points.at(d.node), static_cast<unsigned>(std::countr_zero(d.mask)));
    section_.get("clamped")->complain(ErrorCode::singular, sentences::body_reference(clamped));
  }

  /// A CSV file without header: 6 rows per node (ux uy uz rx ry rz), one column per mode, in the
  /// body frame.
  void read_basis(const YamlValue& value) {
    const auto name = value.text("the name of a CSV file");
    if (!name) return;
    const std::string file = sibling_path(self_, *name);
    std::string text;
    if (!read_text_file(file, text, *value.context().errors, value.mark(), value.path())) return;
    std::vector<std::vector<double>> rows;
    std::istringstream in(text);
    std::string line;
    int number = 0;
    const auto complain = [&](ErrorCode code, const std::string& sentence) {
      value.context().errors->add(code, {file, number, 1}, sentence);
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
          return complain(ErrorCode::out_of_range, "found '" + word.substr(0, 40) +
                                                       "', expected numbers separated by commas");
        row.push_back(p.number);
      }
      if (!rows.empty() && row.size() != rows.front().size())
        return complain(ErrorCode::wrong_count,
                        "found " + std::to_string(row.size()) + " columns, expected " +
                            std::to_string(rows.front().size()) + " as in the first row");
      rows.push_back(std::move(row));
    }
    if (out_.valid && rows.size() != 6 * out_.nodes.size()) {
      value.error(ErrorCode::wrong_count, "'" + file + "' has " + std::to_string(rows.size()) +
                                              " rows, expected 6 for each of the " +
                                              std::to_string(out_.nodes.size()) + " nodes");
      return;
    }
    if (rows.empty() || rows.front().empty()) return;
    MatX basis(static_cast<Eigen::Index>(rows.size()),
               static_cast<Eigen::Index>(rows.front().size()));
    for (Eigen::Index i = 0; i < basis.rows(); ++i)
      for (Eigen::Index j = 0; j < basis.cols(); ++j) basis(i, j) = rows[i][j];
    out_.modes = static_cast<int>(basis.cols());
    f().basis = std::move(basis);
  }

  const ModelInstance& self_;
  YamlSection& section_;
  FlexibleRead out_;
  std::set<std::pair<std::string, unsigned>> taken_;
};

}  // namespace

std::vector<unsigned> read_dofs(const YamlValue& value) {
  constexpr const char* what = "all or a list of x, y, z, rx, ry, rz";
  std::vector<unsigned> out;
  if (value.is_list()) {
    for (const YamlValue& item : value.list())
      if (const auto k = item.word(node_dof_words)) out.push_back(static_cast<unsigned>(*k));
    if (value.node().items.empty())
      value.error(ErrorCode::missing, "found an empty list, expected directions such as [x, y, z]");
  } else if (const auto t = value.text(what)) {
    if (*t == "all")
      out = {0, 1, 2, 3, 4, 5};
    else
      value.unexpected(what);
  }
  return out;
}

FlexibleRead read_flexible(const ModelInstance& self, YamlSection section) {
  return FlexibleReader(self, section).read();
}

}  // namespace floatframe

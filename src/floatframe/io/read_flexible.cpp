// The `flexible` group of a body: bars, sections, reference, modes; with the checks that need the
// geometry.
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

struct BarGeometry {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  int elements = 1;
  bool sound = false;
};

class FlexibleReader {
 public:
  FlexibleReader(const ModelInstance& self, YamlSection& section)
      : self_(self), section_(section) {}

  FlexibleRead read() {
    material();
    if (const auto bars = section_.require("bars")) {
      const auto list = bars->named("a map of names to bars");
      if (bars->is_map() && list.empty()) bars->fault("found no bars, expected at least one");
      for (const auto& [name, value] : list) bar(name, value);
    }
    out_.sound = sound_ && !geometry_.empty();
    if (out_.sound) connectivity();
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

  SectionDescription cross_section(const YamlValue& value) {
    const SectionDescription absent = SolidRound{1.0};
    auto s = value.section("a map with round, tube, rectangle, or area, Iy, Iz, J");
    if (!s) return absent;
    SectionDescription result = absent;
    int forms = 0;
    if (const auto v = s->get("round")) {
      ++forms;
      result = SolidRound{v->number(positive_number("m")).value_or(1.0)};
    }
    if (const auto v = s->get("tube")) {
      ++forms;
      const auto d = v->numbers(2, 2, positive_number("m"), "outer and inner diameter [D, d] [m]");
      if (d && (*d)[1] >= (*d)[0])
        v->fault("found the inner diameter " + number_text((*d)[1]) +
                 ", expected less than the outer one, " + number_text((*d)[0]) + " [m]");
      else if (d)
        result = HollowRound{(*d)[0], (*d)[1]};
    }
    if (const auto v = s->get("rectangle")) {
      ++forms;
      const auto d = v->numbers(2, 2, positive_number("m"), "width and height [w, h] [m]");
      if (d) result = Rectangle{(*d)[0], (*d)[1]};
    }
    const bool explicit_form = s->has("area") || s->has("Iy") || s->has("Iz") || s->has("J");
    if (explicit_form) {
      ++forms;
      SectionConstants c;
      c.A = s->required_number("area", positive_number("m2"), 1.0);
      c.Iy = s->required_number("Iy", positive_number("m4"), 1.0);
      c.Iz = s->required_number("Iz", positive_number("m4"), 1.0);
      c.J = s->required_number("J", positive_number("m4"), 1.0);
      result = c;
    } else {
      for (const char* k : {"area", "Iy", "Iz", "J"}) s->get(k);
    }
    s->finish();
    if (forms != 1)
      s->fault("found " + std::to_string(forms) +
               " sections, expected one of round, tube, rectangle, or area, Iy, Iz, J");
    return result;
  }

  /// A point name of this file.
  std::optional<std::string> point_name(const YamlValue& value) {
    const auto name = value.text("the name of a point");
    if (!name) return std::nullopt;
    const auto p = self_.points.find(*name);
    if (p == self_.points.end()) {
      std::vector<std::string> known;
      for (const auto& [key, unused] : self_.points) known.push_back(key);
      value.fault("unknown point '" + *name + "'" + did_you_mean(*name, known));
      return std::nullopt;
    }
    if (!p->second.allFinite()) return std::nullopt;
    f().points.emplace(*name, p->second);
    return name;
  }

  std::size_t node_at(const std::string& name, const Vec3& p) {
    const auto it = out_.named_nodes.find(name);
    if (it != out_.named_nodes.end()) return it->second;
    out_.nodes.push_back(p);
    return out_.named_nodes.emplace(name, out_.nodes.size() - 1).first->second;
  }

  void bar(const std::string& name, const YamlValue& value) {
    auto s = value.section("a bar with from, to, elements, section");
    if (!s) {
      sound_ = false;
      return;
    }
    BarDescription b;
    BarGeometry g;
    b.name = name;
    b.origin = s->origin();
    std::size_t start = 0;
    bool good = true;
    const auto elements = s->require("elements");
    b.elements = elements ? elements->integer(1, 100000, "a number of elements").value_or(1) : 1;
    const auto from = s->require("from");
    if (from && from->is_map()) {
      good = branch(*from, b, g, start);
    } else {
      const auto p = from ? point_name(*from) : std::nullopt;
      good = p.has_value();
      if (p) {
        b.from = *p;
        g.from = f().points.at(*p);
        start = node_at(*p, g.from);
        graph(start);
      }
    }
    const auto to = s->require("to");
    const auto q = to ? point_name(*to) : std::nullopt;
    good = good && q;
    if (q) b.to = *q, g.to = f().points.at(*q);
    if (const auto v = s->require("section")) b.section = cross_section(*v);
    const auto reference = s->get("reference");
    const auto direction = reference ? read_direction(*reference) : std::nullopt;
    s->finish();
    if (good) {
      const Vec3 axis = g.to - g.from;
      if (!(axis.norm() > 1e-9)) {
        s->fault("found length " + number_text(axis.norm()) +
                 ", expected a bar of positive length [m]");
        good = false;
      } else {
        const auto parallel = [&](const Vec3& r) {
          return r.cross(axis).norm() <= 1e-3 * r.norm() * axis.norm();
        };
        b.reference = direction.value_or(parallel(Vec3::UnitZ()) ? Vec3::UnitX() : Vec3::UnitZ());
        if (direction && parallel(*direction))
          reference->fault("found a direction parallel to the bar, expected another");
      }
    }
    g.elements = b.elements;
    g.sound = good;
    if (good) {
      const std::size_t before = out_.nodes.size();
      for (int k = 1; k < b.elements; ++k) {
        out_.nodes.push_back(g.from + (g.to - g.from) * k / b.elements);
        graph(out_.nodes.size() - 1);
      }
      const std::size_t end = node_at(b.to, g.to);
      graph(end);
      inner_[name] = before;
      starts_[name] = start;
      unite(start, end);
      for (int k = 1; k < b.elements; ++k) unite(start, before + static_cast<std::size_t>(k) - 1);
      if (f().bars.empty()) out_.first_point = g.from;
      links_.emplace_back(start, value);
    } else {
      sound_ = false;
    }
    geometry_[name] = g;
    f().bars.push_back(std::move(b));
  }

  /// from: {bar: name, at: fraction}
  bool branch(const YamlValue& value, BarDescription& b, BarGeometry& g, std::size_t& start) {
    auto s = value.section();
    const auto bar_value = s->require("bar");
    const auto at_value = s->require("at");
    s->finish();
    const auto name = bar_value ? bar_value->text("the name of an earlier bar") : std::nullopt;
    const NumberRule share{"a number from 0 to 1", "", 0.0, 1.0};
    const double at = at_value ? at_value->number(share).value_or(-1.0) : -1.0;
    if (!name) return false;
    const auto it = geometry_.find(*name);
    if (it == geometry_.end()) {
      std::vector<std::string> known;
      for (const auto& [key, unused] : geometry_) known.push_back(key);
      bar_value->fault("unknown bar '" + *name + "'" + did_you_mean(*name, known) +
                       " (bars are known after they are written)");
      return false;
    }
    if (at < 0.0 || !it->second.sound) return false;
    const BarGeometry& other = it->second;
    const double position = at * other.elements;
    const double nearest = std::round(position);
    if (std::abs(position - nearest) > 1e-6) {
      const double low = std::floor(position), high = std::ceil(position);
      at_value->fault("found " + number_text(at) + ", but bar '" + *name + "' has " +
                      std::to_string(other.elements) +
                      " elements and no node there; the nearest are at " +
                      fraction(low, other.elements) + " and " + fraction(high, other.elements));
      return false;
    }
    b.from_bar = *name;
    b.from_fraction = at;
    g.from = other.from + (other.to - other.from) * (nearest / other.elements);
    const int k = static_cast<int>(nearest);
    start = k == 0                ? starts_[*name]
            : k == other.elements ? end_of(*name)
                                  : inner_[*name] + static_cast<std::size_t>(k) - 1;
    return true;
  }

  std::size_t end_of(const std::string& bar_name) {
    for (const BarDescription& b : f().bars)
      if (b.name == bar_name) return out_.named_nodes.at(b.to);
    return 0;
  }

  static std::string fraction(double k, int n) {
    return number_text(k) + "/" + std::to_string(n) + " = " +
           number_text(std::round(k / n * 1e6) / 1e6);
  }

  // Which nodes hang together.
  void graph(std::size_t node) {
    while (parent_.size() <= node) parent_.push_back(parent_.size());
  }
  std::size_t leader(std::size_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void unite(std::size_t a, std::size_t b) {
    graph(std::max(a, b));
    parent_[leader(a)] = leader(b);
  }
  void connectivity() {
    for (const auto& [node, value] : links_)
      if (leader(node) != leader(links_.front().first)) {
        value.context().faults->add(value.entity_mark(),
                                    value.path() + ": the bar is not connected to '" +
                                        f().bars.front().name +
                                        "', expected all bars of a body to hang together");
        return;
      }
  }

  /// A node of this body by the name of its point.
  std::optional<std::string> node_name(const YamlValue& value) {
    const auto name = value.text("the name of an end point of a bar");
    if (!name) return std::nullopt;
    if (out_.named_nodes.count(*name)) return name;
    if (!sound_) return std::nullopt;
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
      if (n && sound_ && *n > rows)
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
    const std::string& own = self_.document->file;
    const std::size_t slash = own.find_last_of('/');
    const std::string file =
        (*name)[0] == '/' || slash == std::string::npos ? *name : own.substr(0, slash + 1) + *name;
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
    if (sound_ && rows.size() != 6 * out_.nodes.size()) {
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
  bool sound_ = true;
  std::map<std::string, BarGeometry> geometry_;
  std::map<std::string, std::size_t> inner_, starts_;  // first inner node, start node of a bar
  std::vector<std::size_t> parent_;
  std::vector<std::pair<std::size_t, YamlValue>> links_;  // start node of each bar
  std::set<std::pair<std::string, unsigned>> taken_;
};

}  // namespace

FlexibleRead read_flexible(const ModelInstance& self, YamlSection section) {
  return FlexibleReader(self, section).read();
}

}  // namespace floatframe

// A group with a finite-element file: the options of `floatframe reduce` as keys. Lengths and the
// material are in the units of that file.
#include <set>

#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/parts/part_job.hpp"

namespace floatframe {
namespace {

const std::vector<std::string> dof_words{"x", "y", "z", "rx", "ry", "rz"};
const NumberRule fraction{"a number above 0 and up to 1", "", 0.0, 1.0, true};

class JobReader {
 public:
  JobReader(const ModelInstance& self, YamlSection& section) : self_(self), s_(section) {}

  std::optional<PartJob> read() {
    const std::size_t before = self_.context.errors->size();
    files();
    if (const auto v = s_.get("interfaces"))
      for (const auto& [name, value] : v->named("a map of names to interfaces", true))
        interface(name, value);
    if (const auto v = s_.get("markers"))
      for (const auto& [name, value] : v->named("a map of names to markers", true))
        marker(name, value);
    selection();
    reference();
    switches();
    s_.finish();
    if (self_.context.errors->size() > before) return std::nullopt;
    return std::move(job_);
  }

 private:
  PartOptions& o() { return job_.options; }

  std::filesystem::path path(const char* key) {
    const auto v = s_.get(key);
    const auto name = v ? v->text("the name of a file") : std::nullopt;
    return name ? std::filesystem::path(beside(self_, *name)) : std::filesystem::path();
  }

  void files() {
    s_.require("file");
    job_.file = path("file");
    job_.read.nodes = path("nodes");
    job_.read.mass = path("mass");
    job_.read.dofs = path("dofs");
    if (const auto v = s_.require("units"))
      if (const auto name = v->text("a unit system such as mm-t-s")) {
        job_.units = *name;
        try {
          unit_system(*name);
        } catch (const InputError& error) {
          v->error(error.what());
        }
      }
    if (const auto v = s_.get("format"))
      if (const auto name = v->text("the name of a format")) {
        std::vector<std::string> known;
        for (const FeFormat& f : fe_formats()) known.emplace_back(f.name);
        if (const auto k = v->word(known)) job_.format = known[*k];
      }
    if (const auto v = s_.get("dialect"))
      if (const auto k = v->word({"abaqus", "calculix"}))
        job_.read.dialect = *k == 0 ? DeckDialect::abaqus : DeckDialect::calculix;
    if (const auto v = s_.get("material"))
      if (auto m = v->section("a map with young, poisson, density")) {
        Material material;
        material.young = m->required_number("young", positive_number(""), 1.0);
        material.poisson = m->required_number(
            "poisson", {"a number above -1 and below 0.5", "", -1.0, 0.5, true, true}, 0.3);
        material.density = m->required_number("density", positive_number(""), 1.0);
        m->finish();
        job_.read.material = material;
      }
  }

  Vec3 vector(YamlSection& s, const char* key) {
    const auto v = s.require(key);
    return v ? v->vector("").value_or(Vec3::Zero()) : Vec3::Zero();
  }

  /// The one way of choosing nodes; an error at none or several.
  void choice(YamlSection& s, NodeChoice& c) {
    int ways = 0;
    const auto group = [&](const char* key, NodeChoice::By by, const char* what) {
      const auto v = s.get(key);
      std::optional<YamlSection> g;
      if (v) {
        ++ways;
        c.by = by;
        g = v->section(what);
      }
      return g;
    };
    if (const auto v = s.get("set")) {
      ++ways;
      c.by = NodeChoice::By::set;
      c.set = v->text("the name of a set").value_or("");
    }
    if (const auto v = s.get("node")) {
      ++ways;
      c.by = NodeChoice::By::node;
      c.number = v->integer(1, 2147483647, "the number of a node").value_or(1);
    }
    if (const auto v = s.get("nearest")) {
      ++ways;
      c.by = NodeChoice::By::nearest;
      c.point = v->vector("").value_or(Vec3::Zero());
    }
    if (auto g = group("plane", NodeChoice::By::plane, "a map with point and normal")) {
      c.point = vector(*g, "point");
      direction(*g, "normal", c.axis);
      g->finish();
    }
    if (auto g = group("cylinder", NodeChoice::By::cylinder,
                       "a map with point, axis, radius and length")) {
      c.point = vector(*g, "point");
      direction(*g, "axis", c.axis);
      c.radius = g->required_number("radius", positive_number(""), 1.0);
      c.length = g->number("length", positive_number(""), 0.0);
      g->finish();
    }
    if (auto g = group("sphere", NodeChoice::By::sphere, "a map with point and radius")) {
      c.point = vector(*g, "point");
      c.radius = g->required_number("radius", positive_number(""), 1.0);
      g->finish();
    }
    c.tolerance = s.number("tolerance", positive_number(""), 0.0);
    if (ways != 1)
      s.error("found " + std::to_string(ways) +
              " ways to choose nodes, expected one of set, node, nearest, plane, cylinder, sphere");
  }

  static void direction(YamlSection& s, const char* key, Vec3& out) {
    const auto v = s.require(key);
    if (const auto d = v ? read_direction(*v) : std::nullopt) out = d->stableNormalized();
  }

  /// False and an error if the name is taken.
  bool name_is_new(const std::string& name, const YamlValue& value) {
    if (names_.insert(name).second) return true;
    value.error("found the name twice in interfaces and markers, expected once");
    return false;
  }

  void interface(const std::string& name, const YamlValue& value) {
    auto s = value.section("an interface with set, node, nearest, plane, cylinder or sphere");
    if (!s || !name_is_new(name, value)) return;
    InterfaceDescription i;
    i.name = name;
    choice(*s, i.choice);
    if (const auto v = s->get("at")) i.at = v->vector("");
    if (const auto v = s->get("type"))
      if (v->word({"rigid", "mean"}) == std::size_t{1}) i.kind = Spider::Kind::mean;
    if (const auto v = s->get("dofs")) i.mask = dofs(*v);
    s->finish();
    o().interfaces.push_back(std::move(i));
  }

  static unsigned dofs(const YamlValue& value) {
    if (value.is_list()) {
      unsigned mask = 0;
      for (const YamlValue& item : value.list())
        if (const auto k = item.word(dof_words)) mask |= 1u << *k;
      if (value.node().items.empty())
        value.error("found an empty list, expected directions such as [x, y, z]");
      return mask;
    }
    const auto t = value.text("all or a list of x, y, z, rx, ry, rz");
    if (t && *t != "all") value.unexpected("all or a list of x, y, z, rx, ry, rz");
    return 63u;
  }

  void marker(const std::string& name, const YamlValue& value) {
    auto s = value.section("a marker with set, node, nearest, plane, cylinder or sphere");
    if (!s || !name_is_new(name, value)) return;
    MarkerDescription m;
    m.name = name;
    choice(*s, m.choice);
    if (const auto v = s->get("at")) m.at = v->vector("");
    m.residual = s->boolean("residual", false);
    s->finish();
    o().markers.push_back(std::move(m));
  }

  void selection() {
    if (const auto v = s_.get("modes")) o().modes = v->integer(0, 10000, "a number of modes");
    o().max_frequency = s_.number("fmax", positive_number("Hz"), 0.0);
    o().effective_mass = s_.number("effective_mass", fraction, 0.0);
    if (!s_.has("modes") && !s_.has("fmax") && !s_.has("effective_mass")) o().modes = default_modes;
  }

  void reference() {
    if (const auto v = s_.get("method"))
      if (const auto w = v->word({"craig_bampton", "free_free", "craig_chang"}))
        o().method = static_cast<ModeMethod>(*w);
    const auto v = s_.get("reference");
    if (!v) return;
    if (v->is_map()) {
      auto s = v->section();
      const auto node = s->require("node");
      s->finish();
      const auto name = node ? node->text("the name of an interface") : std::nullopt;
      if (!name) return;
      o().reference = {BodyReference::Kind::node, *name};
      std::vector<std::string> known;
      for (const InterfaceDescription& i : o().interfaces) known.push_back(i.name);
      for (const std::string& k : known)
        if (k == *name) return;
      node->error("unknown interface '" + *name + "'" +
                  self_.context.errors->suggestion(*name, [&] { return known; }));
    } else if (const auto w = v->word({"mean_axis", "buckens"})) {
      o().reference.kind = static_cast<BodyReference::Kind>(*w);
    }
  }

  void switches() {
    if (const auto v = s_.get("integration"))
      if (v->word({"exact", "ccx"}) == std::size_t{1}) o().integration = Integration::ccx;
    o().damping_ratio =
        s_.number("damping", {"a fraction of critical damping from 0 to 1", "", 0.0, 1.0}, 0.0);
    o().check_free_modes = s_.boolean("free_check", true);
    o().stresses = s_.boolean("stresses", false);
    o().keep_projection = s_.boolean("projection", false);
    if (const auto v = s_.get("solver"))
      if (const auto w = v->word({"auto", "mumps", "eigen"}))
        o().solver = static_cast<SparseSolver>(*w);
  }

  const ModelInstance& self_;
  YamlSection& s_;
  PartJob job_;
  std::set<std::string> names_;
};

}  // namespace

std::optional<PartJob> read_part_job(const ModelInstance& self, YamlSection section) {
  return JobReader(self, section).read();
}

}  // namespace floatframe

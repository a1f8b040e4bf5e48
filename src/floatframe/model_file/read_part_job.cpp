// A group with a finite-element file: the options of `floatframe reduce` as keys. Lengths and the
// material are in the units of that file.
#include <algorithm>
#include <set>

#include "floatframe/description/rules.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/parts/node_ways.hpp"
#include "floatframe/parts/part_options.hpp"
#include "floatframe/parts/part_text.hpp"

namespace floatframe {
namespace {

using Special = PartOption::Special;

class JobReader {
 public:
  JobReader(const ModelInstance& self, YamlSection& section) : self_(self), s_(section) {}

  std::optional<PartJob> read() {
    const std::size_t before = self_.context.errors->size();
    s_.require("file");
    job_.file = path("file");
    for (const PartOption& option : part_options())
      std::visit([&](const auto& kind) { value(option, kind); }, option.kind);
    s_.finish();
    if (self_.context.errors->size() > before) return std::nullopt;
    return std::move(job_);
  }

 private:
  PartOptions& o() { return job_.options; }

  void value(const PartOption& option, const PartOption::Number& number) {
    o().*number.at = s_.number(option.key, number.rule, 0.0);
  }
  void value(const PartOption& option, const PartOption::Count& count) {
    if (const auto v = s_.get(option.key)) o().*count.at = v->integer(count.rule);
  }
  void value(const PartOption& option, const PartOption::Word& word) {
    if (const auto v = s_.get(option.key))
      if (const auto k = v->word(word.words)) word.set(job_, word.first + static_cast<int>(*k));
  }
  void value(const PartOption& option, const PartOption::Switch& on) {
    o().*on.at = s_.boolean(option.key, on.absent);
  }
  void value(const PartOption& option, const PartOption::File& file) {
    job_.read.*file.at = path(option.key);
  }
  void value(const PartOption& option, const Special& special) {
    switch (special.what) {
      case Special::What::units:
        return units(option.key);
      case Special::What::format:
        return format(option.key);
      case Special::What::material:
        return material(option.key);
      case Special::What::densities:
        return named_numbers(option.key, job_.read.densities, non_negative_number(""),
                             "a map of materials to densities");
      case Special::What::thicknesses:
        return named_numbers(option.key, job_.read.thicknesses, positive_number(""),
                             "a map of groups to thicknesses");
      case Special::What::contact:
        return contact(option);
      case Special::What::temperature:
        if (const auto v = s_.get(option.key)) job_.read.temperature = v->number(any_number(""));
        return;
      case Special::What::damping:
        if (const auto v = s_.get(option.key)) o().damping = read_damping(*v);
        return;
      case Special::What::interfaces:
        if (const auto v = s_.get(option.key))
          for (const auto& [name, place] : v->named("a map of names to interfaces", true))
            interface(name, place);
        return;
      case Special::What::markers:
        if (const auto v = s_.get(option.key))
          for (const auto& [name, place] : v->named("a map of names to markers", true))
            marker(name, place);
        return;
      case Special::What::reference:
        return reference(option.key);
    }
  }

  std::filesystem::path path(const char* key) {
    const auto v = s_.get(key);
    const auto name = v ? v->text("the name of a file") : std::nullopt;
    return name ? std::filesystem::path(sibling_path(self_, *name)) : std::filesystem::path();
  }

  void units(const char* key) {
    const auto v = s_.require(key);
    const auto name = v ? v->text("a unit system such as mm-t-s") : std::nullopt;
    if (!name) return;
    job_.units = *name;
    try {
      unit_system(*name);
    } catch (const InputError& error) {
      v->error(ErrorCode::wrong_value, error.what());
    }
  }

  void format(const char* key) {
    const auto v = s_.get(key);
    if (!v || !v->text("the name of a format")) return;
    std::vector<std::string> known;
    for (const FeFormat& f : fe_formats()) known.emplace_back(f.name);
    if (const auto k = v->word(known)) job_.format = known[*k];
  }

  void material(const char* key) {
    const auto v = s_.get(key);
    auto m = v ? v->section("a map with young, poisson, density") : std::nullopt;
    if (!m) return;
    Material material;
    material.young = m->required_number("young", positive_number(""), 1.0);
    material.poisson = m->required_number("poisson", rules::poisson, 0.3);
    material.density = m->required_number("density", positive_number(""), 1.0);
    m->finish();
    job_.read.material = material;
  }

  /// A number for all, or a map of names to numbers.
  void named_numbers(const char* key, std::map<std::string, double>& numbers,
                     const NumberRule& rule, const char* expected) {
    const auto v = s_.get(key);
    if (!v) return;
    if (!v->is_map()) {
      numbers[""] = v->number(rule).value_or(1.0);
      return;
    }
    for (const auto& [name, number] : v->named(expected, true))
      numbers[name] = number.number(rule).value_or(1.0);
  }

  void contact(const PartOption& option) {
    const auto v = s_.get(option.key);
    const auto text = v ? v->text("ignore, tied or tied:DISTANCE") : std::nullopt;
    if (!text) return;
    try {
      std::get<Special>(option.kind).parse(job_, *text);
    } catch (const InputError&) {
      v->unexpected("ignore, tied or tied:DISTANCE");
    }
  }

  /// The single method of selecting nodes; an error if there are none or several.
  void choice(YamlSection& s, NodeChoice& c) {
    int ways = 0;
    std::vector<const char*> words;
    for (const NodeWay& way : node_ways()) {
      words.push_back(way.word);
      const auto v = s.get(way.word);
      if (!v) continue;
      ++ways;
      c.by = way.by;
      if (way.values.size() == 1)
        put(c, *v, way.values.front());
      else
        values(c, *v, way);
    }
    c.tolerance = s.number("tolerance", positive_number(""), 0.0);
    if (ways != 1)
      s.error(ErrorCode::wrong_count, "found " + std::to_string(ways) +
                                          " ways to choose nodes, expected one of " +
                                          joined(words, ", "));
  }

  /// The map of a method with several values.
  static void values(NodeChoice& c, const YamlValue& value, const NodeWay& way) {
    std::vector<const char*> keys;
    for (const NodeWayValue& v : way.values) keys.push_back(v.key);
    const char* last = keys.back();
    keys.pop_back();
    auto s = value.section(("a map with " + joined(keys, ", ") + " and " + last).c_str());
    if (!s) return;
    for (const NodeWayValue& v : way.values) {
      const auto* length = std::get_if<NodeWayValue::Length>(&v.kind);
      const bool required = !length || length->required;
      if (const auto given = required ? s->require(v.key) : s->get(v.key)) put(c, *given, v);
    }
    s->finish();
  }

  static void put(NodeChoice& c, const YamlValue& given, const NodeWayValue& value) {
    using V = NodeWayValue;
    if (const auto* name = std::get_if<V::Name>(&value.kind)) {
      const std::string what = std::string("the name of a ") + value.key;
      c.*name->at = given.text(what.c_str()).value_or("");
    } else if (const auto* whole = std::get_if<V::Number>(&value.kind)) {
      const std::string what = std::string("the number of a ") + value.key;
      c.*whole->at = given.integer(1, 2147483647, what.c_str()).value_or(1);
    } else if (const auto* point = std::get_if<V::Point>(&value.kind)) {
      c.*point->at = given.vector("").value_or(Vec3::Zero());
    } else if (const auto* axis = std::get_if<V::Direction>(&value.kind)) {
      if (const auto d = read_direction(given)) c.*axis->at = d->stableNormalized();
    } else {
      c.*std::get<V::Length>(value.kind).at = given.number(positive_number("")).value_or(1.0);
    }
  }

  static std::string joined(const std::vector<const char*>& words, const char* between) {
    std::string text;
    for (const char* word : words) text += (text.empty() ? "" : between) + std::string(word);
    return text;
  }

  /// False and an error if the name is already used.
  bool is_unused_name(const std::string& name, const YamlValue& value) {
    if (names_.insert(name).second) return true;
    value.error(ErrorCode::duplicate,
                "found the name twice in interfaces and markers, expected once");
    return false;
  }

  /// The common keys of interfaces and markers.
  template <class Place>
  std::optional<YamlSection> begin(const std::string& name, const YamlValue& value,
                                   const char* what, Place& place) {
    auto s = value.section(what);
    if (!s || !is_unused_name(name, value)) return std::nullopt;
    place.name = name;
    choice(*s, place.choice);
    if (const auto v = s->get("at")) place.at = v->vector("");
    return s;
  }

  void interface(const std::string& name, const YamlValue& value) {
    InterfaceDescription i;
    auto s =
        begin(name, value, "an interface with set, node, nearest, plane, cylinder or sphere", i);
    if (!s) return;
    s->word("type", tie_words, i.kind);
    if (const auto v = s->get("dofs")) {
      i.mask = 0;
      for (const unsigned k : read_dofs(*v)) i.mask |= 1u << k;
    }
    s->finish();
    o().interfaces.push_back(std::move(i));
  }

  void marker(const std::string& name, const YamlValue& value) {
    MarkerDescription m;
    auto s = begin(name, value, "a marker with set, node, nearest, plane, cylinder or sphere", m);
    if (!s) return;
    m.residual = s->boolean("residual", false);
    s->finish();
    o().markers.push_back(std::move(m));
  }

  void reference(const char* key) {
    const auto v = s_.get(key);
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
      if (std::find(known.begin(), known.end(), *name) != known.end()) return;
      node->not_known("unknown interface '" + *name + "'", *name, [&] { return known; });
    } else if (const auto w = v->word(reference_words)) {
      o().reference.kind = static_cast<BodyReference::Kind>(*w);
    }
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

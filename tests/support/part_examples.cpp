#include "support/part_examples.hpp"

#include "floatframe/parts/node_ways.hpp"

namespace floatframe::test {
namespace {

using O = PartOption;
using Texts = std::vector<std::pair<std::string, std::string>>;

std::string way_text(const NodeWay& way, bool yaml) {
  const bool map = yaml && way.values.size() > 1;
  std::string text = std::string(way.word) + (yaml ? ": " : ":") + (map ? "{" : "");
  for (std::size_t k = 0; k < way.values.size(); ++k) {
    const NodeWayValue& v = way.values[k];
    const bool vector = std::holds_alternative<NodeWayValue::Point>(v.kind) ||
                        std::holds_alternative<NodeWayValue::Direction>(v.kind);
    const std::string value = vector                                               ? "0,0,1"
                              : std::holds_alternative<NodeWayValue::Name>(v.kind) ? "SOME"
                                                                                   : "12";
    if (k > 0) text += yaml ? ", " : ",";
    if (map || (!yaml && k > 0)) text += std::string(v.key) + (yaml ? ": " : "=");
    text += yaml && vector ? "[" + value + "]" : value;
  }
  return text + (map ? "}" : "");
}

/// Every way of choosing nodes, and the other properties of a place; `more`: of this kind of place.
Texts places(const Texts& more) {
  Texts out;
  for (const NodeWay& way : node_ways()) {
    const std::string text = "P=" + way_text(way, false), yaml = way_text(way, true);
    out.emplace_back(text, "{P: {" + yaml + "}}");
    if (way.by_distance)
      out.emplace_back(text + ",tolerance=0.5", "{P: {" + yaml + ", tolerance: 0.5}}");
    out.emplace_back(text + ",at=1,2,3", "{P: {" + yaml + ", at: [1, 2, 3]}}");
  }
  for (const auto& [text, yaml] : more)
    out.emplace_back("P=set:SOME," + text, "{P: {set: SOME, " + yaml + "}}");
  return out;
}

Texts special(O::Special::What what) {
  using What = O::Special::What;
  switch (what) {
    case What::units:
      return {{"mm-t-s", "mm-t-s"}};
    case What::format: {
      Texts out;
      for (const FeFormat& f : fe_formats()) out.emplace_back(f.name, f.name);
      return out;
    }
    case What::material:
      return {{"3,0.25,2", "{young: 3, poisson: 0.25, density: 2}"},
              {"3,0.25,4", "{young: 3, poisson: 0.25, density: 4}"},
              {"3,0.05,4", "{young: 3, poisson: 0.05, density: 4}"},
              {"5,0.25,2", "{young: 5, poisson: 0.25, density: 2}"}};
    case What::densities:
      return {{"7.5", "7.5"}, {"STEEL=7.5", "{STEEL: 7.5}"}, {"STEEL=0", "{STEEL: 0}"}};
    case What::thicknesses:
      return {{"2.5", "2.5"}, {"RIB=2.5", "{RIB: 2.5}"}, {"RIB=3", "{RIB: 3}"}};
    case What::contact:
      return {{"ignore", "ignore"}, {"tied", "tied"}, {"tied:0.5", "tied:0.5"}};
    case What::temperature:
      return {{"80", "80"}, {"-40.5", "-40.5"}};
    case What::damping:
      return {{"0.25", "0.25"},
              {"0.5", "{fraction: 0.5}"},
              {"0.25,reference=free", "{fraction: 0.25, reference: free}"},
              {"0.25,reference=mounted", "{fraction: 0.25, reference: mounted}"},
              {"0.25,reference=mounted,frequency=2.5",
               "{fraction: 0.25, reference: mounted, frequency: 2.5}"},
              {"0.25,0.5", "{fractions: [0.25, 0.5]}"},
              {"bands:100=0.01,1000=0.1,1", "{bands: usual}"},
              {"bands:200=0.25,0.5", "{bands: [[200, 0.25], 0.5]}"},
              {"rayleigh:2,0", "{rayleigh: [2, 0]}"},
              {"rayleigh:0.5,0.25,reference=free", "{rayleigh: [0.5, 0.25], reference: free}"}};
    case What::interfaces:
      return places({{"type=mean", "type: mean"},
                     {"dofs=xyz", "dofs: [x, y, z]"},
                     {"dofs=x+rz", "dofs: [x, rz]"},
                     {"dofs=rxyz", "dofs: [rx, ry, rz]"}});
    case What::markers:
      return places({{"residual", "residual: true"}});
    case What::reference:
      return {{"buckens", "buckens"}, {"node:A", "{node: A}"}};
  }
  return {};
}

struct Values {
  Texts operator()(const O::Number&) const { return {{"0.25", "0.25"}, {"0.5", "0.5"}}; }
  Texts operator()(const O::Count&) const { return {{"3", "3"}, {"7", "7"}}; }
  Texts operator()(const O::Word& o) const {
    Texts out;
    const PartJob absent;
    for (std::size_t k = 0; k < o.words.size(); ++k)
      if (o.first + static_cast<int>(k) != o.get(absent)) out.emplace_back(o.words[k], o.words[k]);
    return out;
  }
  Texts operator()(const O::Switch& o) const { return {{"true", o.flag ? "true" : "false"}}; }
  Texts operator()(const O::File&) const { return {{"other.txt", "other.txt"}}; }
  Texts operator()(const O::Special& o) const { return special(o.what); }
};

}  // namespace

std::vector<PartExample> part_examples() {
  std::vector<PartExample> out;
  for (const PartOption& option : part_options())
    for (const auto& [text, yaml] : std::visit(Values{}, option.kind))
      out.push_back({&option, text, yaml});
  return out;
}

}  // namespace floatframe::test

// Formulas of model files: their parameters become numbers, their names those of the whole model.
// The tables that they use.
#include <algorithm>
#include <string_view>

#include "floatframe/description/sentences.hpp"
#include "floatframe/formulas/function_words.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/yaml/expressions_read.hpp"
#include "floatframe/yaml/read_table.hpp"

namespace floatframe {
namespace {

constexpr std::string_view law_variables = "xv";

/// Parameters and names of one file.
class Binder {
 public:
  /// `own`: the variables of a law or height, a letter each; empty: the formula is of the model.
  Binder(const ModelInstance& self, std::string_view own) : self_(self), own_(own) {}

  void bind(SyntaxNode& node) const {
    using Kind = SyntaxNode::Kind;
    if (node.kind == Kind::name) return name(node);
    const bool call = node.kind == Kind::call;
    if (call && !is_function_name(node.word)) return measure(node);
    const bool table = call && (node.word == "table" || node.word == "table2");
    for (std::size_t k = table ? 1 : 0; k < node.parts.size(); ++k) bind(node.parts[k]);
  }

 private:
  void name(SyntaxNode& node) const {
    if (const auto it = self_.scope.find(node.word); it != self_.scope.end()) {
      if (const char* other = also(node.word))
        throw ExpressionError("found '" + node.word + "', a parameter and also " + other +
                              ", expected another name of one of them");
      if (const bool* b = std::get_if<bool>(&it->second))
        node = {SyntaxNode::Kind::truth, *b ? 1.0 : 0.0, *b ? "true" : "false", {}};
      else if (const double* x = std::get_if<double>(&it->second))
        node = {SyntaxNode::Kind::number, *x, "", {}};
      else
        node = {SyntaxNode::Kind::text, 0.0, std::get<std::string>(it->second), {}};
      return;
    }
    const std::string& word = node.word;
    if (word == "t" || word == "time" || constant_value(word) || !own_.empty()) return;
    const auto input = self_.resolve(EntityKind::input, word);
    node.word = input ? *input : self_.prefix + word;
  }
  /// What a parameter of this name would hide; null: nothing.
  const char* also(const std::string& word) const {
    if (word == "t" || word == "time") return "the time";
    if (!own_.empty())
      return word.size() == 1 && own_.find(word) != own_.npos ? "a variable of the law" : nullptr;
    return self_.resolve(EntityKind::input, word) ? "an input" : nullptr;
  }
  /// The name of the entity in the first argument.
  void measure(SyntaxNode& node) const {
    for (std::size_t k = 1; k < node.parts.size(); ++k)
      if (node.parts[k].kind != SyntaxNode::Kind::name) bind(node.parts[k]);
    if (node.parts.empty()) return;
    SyntaxNode& entity = node.parts[0];
    if (entity.kind != SyntaxNode::Kind::name && entity.kind != SyntaxNode::Kind::text) return;
    for (const EntityKind kind :
         {EntityKind::joint, EntityKind::force, EntityKind::controller, EntityKind::body,
          EntityKind::rod, EntityKind::constraint, EntityKind::coupling})
      if (const auto full = self_.resolve(kind, entity.word)) {
        entity.word = *full;
        entity.kind = SyntaxNode::Kind::text;
        return;
      }
  }

  const ModelInstance& self_;
  std::string_view own_;
};

/// Ascending numbers of a grid.
bool ascending(const YamlValue& value, const std::vector<double>& x) {
  const auto wrong =
      std::adjacent_find(x.begin(), x.end(), [](double a, double b) { return !(a < b); });
  if (wrong == x.end()) return true;
  value.error(ErrorCode::wrong_value, "found " + number_text(wrong[1]) + " after " +
                                          number_text(wrong[0]) + ", expected ascending numbers");
  return false;
}

/// {x: [...], y: [...], values: [[...], ...]}, a row of values for each x.
std::shared_ptr<const GridTable> read_grid(const YamlValue& value) {
  auto s = value.section("a map with x, y and values");
  if (!s) return nullptr;
  constexpr std::size_t most = 10000;
  const auto axis = [&](const char* key) -> std::vector<double> {
    const auto v = s->require(key);
    const auto x = v ? v->numbers(2, most, any_number(""), "at least 2 numbers") : std::nullopt;
    return x && ascending(*v, *x) ? *x : std::vector<double>();
  };
  const std::vector<double> x = axis("x"), y = axis("y");
  const auto rows = s->require("values");
  s->finish();
  if (x.empty() || y.empty() || !rows) return nullptr;
  const std::vector<YamlValue> list = rows->list("rows of numbers");
  if (list.size() != x.size()) {
    rows->error(ErrorCode::wrong_count, "found " + std::to_string(list.size()) +
                                            " rows, expected " + std::to_string(x.size()) +
                                            ", one for each x");
    return nullptr;
  }
  GridTable grid{VecX::Map(x.data(), std::ssize(x)), VecX::Map(y.data(), std::ssize(y)),
                 MatX(std::ssize(x), std::ssize(y))};
  const std::string what = std::to_string(y.size()) + " numbers, one for each y";
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto row = list[i].numbers(y.size(), y.size(), any_number(""), what.c_str());
    if (!row) return nullptr;
    grid.values.row(i) = VecX::Map(row->data(), grid.values.cols()).transpose();
  }
  return std::make_shared<const GridTable>(std::move(grid));
}

SharedFormula compiled(const ModelInstance& self, const YamlValue& value, std::string_view own) {
  const auto text = value.parameter();
  if (!text) return nullptr;
  try {
    SyntaxNode tree = parse_expression(value_text(*text));
    if (auto* read = ExpressionsRead::current()) read->in_formula(tree, self.scope);
    Binder(self, own).bind(tree);
    const Placement& x = self.world;
    return compile_formula(tree, self.tables, {x.P.diagonal(), x.t - x.P * self.shift});
  } catch (const ExpressionError& e) {
    value.error(ErrorCode::wrong_value, e.what());
    return nullptr;
  }
}

}  // namespace

SharedFormula read_formula(const ModelInstance& self, const YamlValue& value) {
  return compiled(self, value, "");
}

SharedFormula read_shape(const ModelInstance& self, const YamlValue& value) {
  return compiled(self, value, law_variables);
}

SharedFormula read_height(const ModelInstance& self, const YamlValue& value) {
  return compiled(self, value, "xy");
}

std::optional<ForceFunction> read_force_function(const ModelInstance& self,
                                                 const YamlValue& value) {
  if (value.is_scalar()) return ForceFunction::named(value.node().text);
  auto section = value.is_map() ? value.section() : std::nullopt;
  const auto text = section ? section->get("formula") : std::nullopt;
  if (!text) {
    value.error(ErrorCode::unsupported, sentences::function_in_file(value.found()));
    return std::nullopt;
  }
  section->finish();
  const SharedFormula f = compiled(self, *text, law_variables);
  if (!f) return std::nullopt;
  try {
    return ForceFunction::of(f);
  } catch (const InputError& e) {
    text->error(ErrorCode::not_found, e.what());
    return std::nullopt;
  }
}

void read_tables(ModelInstance& self) {
  const auto value = self.root->get("tables");
  if (!value) return;
  for (const auto& [name, entry] : value->named("a map of names to tables")) {
    auto section = entry.section("a map with grid or one of linear, polynomial, piecewise, table");
    if (!section) continue;
    if (const auto grid = section->get("grid")) {
      section->finish();
      if (auto read = read_grid(*grid)) self.tables.grids.emplace(name, std::move(read));
    } else {
      self.tables.curves.emplace(
          name, std::make_shared<const PiecewisePolynomial>(read_law(entry, 0.0, {"", "", ""})));
    }
  }
}

}  // namespace floatframe

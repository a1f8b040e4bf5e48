// Reader of benchmark.yaml.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "floatframe/description/rules.hpp"
#include "floatframe/validation/benchmark.hpp"
#include "floatframe/yaml/read_table.hpp"

namespace floatframe {
namespace {

constexpr const char* what_a_check_is =
    "a check, for example {output: tip.x, reference: [[1, 0.3]], absolute: 1.0e-6}";

/// The frequency of a vibration, or a table of the output over the time.
void read_reference(YamlSection& s, BenchmarkCheck& c) {
  if (c.vibration > 0) {
    c.reference = {{0.0, s.required_number("value", positive_number("Hz"), 1.0)}};
    return;
  }
  const auto v = s.require("reference");
  if (!v) return;
  const TableRows table = read_table_rows(*v, any_number(""), "a point [time, value]", "time");
  for (const TableRow& row : table.rows) {
    if (row.point.x < 0.0)
      table.error(ErrorCode::out_of_range, row,
                  "found the time " + number_text(row.point.x) + ", expected one >= 0 [s]");
    c.reference.push_back(row.point);
  }
  if (table.good && c.reference.empty())
    v->unexpected("at least one reference value", ErrorCode::wrong_count);
}

BenchmarkCheck read_check(const YamlValue& value) {
  BenchmarkCheck c;
  c.mark = value.mark();
  c.path = value.path();
  auto s = value.section(what_a_check_is);
  if (!s) return c;
  const auto output = s->get("output"), vibration = s->get("vibration");
  if (output.has_value() == vibration.has_value())
    s->error(ErrorCode::wrong_count, std::string("found ") + (output ? "both" : "neither") +
                                         " 'output' and 'vibration', expected one of them");
  if (output) c.output = output->text("the name of an output").value_or("");
  if (vibration && !output)
    c.vibration = vibration->integer(1, 10000, "the number of a vibration").value_or(1);
  const auto quantity = s->get("quantity");
  c.quantity = c.vibration > 0 ? "vibration " + std::to_string(c.vibration) : c.output;
  if (quantity) c.quantity = quantity->text("the name of a quantity").value_or(c.quantity);
  if (output || vibration) read_reference(*s, c);
  c.absolute = s->number("absolute", non_negative_number(""), 0.0);
  c.relative = s->number("relative", non_negative_number(""), 0.0);
  if (!s->has("absolute") && !s->has("relative"))
    s->error(ErrorCode::missing, "missing key 'absolute' or 'relative', the tolerance");
  s->finish();
  return c;
}

void read_coordinates(const YamlValue& value, std::vector<Coordinates>& out) {
  out.clear();
  for (const YamlValue& item : value.list("a list of relative and absolute"))
    if (const auto k = item.word(rules::coordinates)) {
      const auto c = static_cast<Coordinates>(*k);
      if (std::find(out.begin(), out.end(), c) != out.end())
        item.error(ErrorCode::duplicate, "found " + item.found() + " twice");
      out.push_back(c);
    }
  if (value.is_list() && out.empty()) value.unexpected("relative, absolute or both");
}

void read_keys(YamlSection& root, Benchmark& b) {
  if (const auto version = root.require("floatframe")) version->integer(1, 1, "version 1");
  const auto text = [&](const char* key, std::string& place) {
    if (const auto v = root.get(key)) place = v->text().value_or(place);
  };
  text("title", b.title);
  text("source", b.source);
  if (const auto v = root.require("model"))
    if (const auto name = v->text("the name of a model file"))
      b.model = (std::filesystem::path(b.file).parent_path() / *name).lexically_normal().string();
  if (const auto v = root.get("coordinates")) read_coordinates(*v, b.coordinates);
  if (const auto v = root.get("set")) {
    b.settings_mark = v->mark();
    for (const auto& [name, value] :
         v->named("a map of parameters, or options of the simulation, to values", true))
      if (const auto x = value.parameter()) b.settings.push_back(name + "=" + value_text(*x));
  }
  b.extrapolate = root.boolean("extrapolate", false);
  if (const auto v = root.require("checks")) {
    for (const YamlValue& item : v->list("a list of checks")) b.checks.push_back(read_check(item));
    if (v->is_list() && b.checks.empty()) v->unexpected(what_a_check_is, ErrorCode::wrong_count);
  }
  root.finish();
}

}  // namespace

double BenchmarkCheck::size() const noexcept {
  double largest = 0.0;
  for (const TablePoint& p : reference) largest = std::max(largest, std::abs(p.f));
  return largest;
}

double BenchmarkCheck::tolerance() const noexcept { return absolute + relative * size(); }

Benchmark read_benchmark(const std::string& file) {
  Benchmark b;
  b.file = file;
  const auto path = std::filesystem::absolute(file).lexically_normal();
  b.name = path.parent_path().filename().string();
  if (const std::string own = path.stem().stem().string(); own != "benchmark") b.name += "/" + own;
  b.title = b.name;
  b.coordinates = {Coordinates::relative, Coordinates::absolute};
  ReadErrors errors;
  std::string text;
  if (read_text_file(file, text, errors, {}, "")) {
    const YamlDocument document = parse_yaml(file, text, errors);
    const ParameterScope none;
    CsvFiles tables;
    const ReadContext context{&document.file, &none, &errors, &tables};
    const YamlValue top(context, document.root, "");
    if (!top.is_map()) {
      if (errors.empty())
        errors.add(ErrorCode::wrong_value, {file, 1, 1},
                   "found " + top.found() + ", expected a map of keys such as 'checks'");
    } else {
      YamlSection root(top);
      read_keys(root, b);
    }
  }
  if (!errors.empty()) throw InputError(errors.take());
  return b;
}

}  // namespace floatframe

#include "floatframe/model_file/pack_model.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/formulas/syntax_tree.hpp"
#include "floatframe/model_file/description_numbers.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/model_file/parsed_files.hpp"
#include "floatframe/model_file/tunable_parameters.hpp"

namespace floatframe {
namespace {

/// The numbers of the packed description are those that were read.
bool same_places(const TunableParameters& found, const DescriptionBytes& content) {
  for (const TunableParameters::Number& n : found.numbers)
    if (n.place >= content.doubles.size() || content.doubles[n.place] >= content.bodies ||
        number_at(content, n.place) != n.value)
      return false;
  return true;
}

std::string names_text(const PackedModel& model) {
  if (model.parameters().empty()) return "none: it has no parameters that take new values";
  std::vector<const char*> words;
  for (const PackedParameter& p : model.parameters()) words.push_back(p.name.c_str());
  return alternatives(words);
}

}  // namespace

PackedModel pack_model(const std::string& path, const std::vector<ParameterOverride>& overrides,
                       const ModelPacking& packing, std::vector<std::string>* fixed) {
  if (is_packed_file(path))
    throw InputError(ErrorCode::wrong_file, {path, 0, 0},
                     "found a packed model, expected the model file that it was packed from");
  ReadOptions options;
  options.parsed = std::make_shared<ParsedFiles>();
  const auto reader = [&](const std::vector<ParameterOverride>& values) {
    std::vector<ParameterOverride> all = overrides;
    all.insert(all.end(), values.begin(), values.end());
    ModelDescription d = read_model(path, all, nullptr, options);
    if (packing.change) packing.change(d);
    return d;
  };
  ExpressionsRead expressions;
  const ModelDescription description = reader({});
  expressions.stop();
  PackedModel out = packed(description, build_model(description), packing.contents);
  TunableParameters found = tunable_parameters(description, expressions, reader);
  if (!same_places(found, out.content())) {
    found = {};
    found.fixed.push_back(
        "the numbers of the packed model stand in other places than those of "
        "the file, so that no parameter can change");
  }
  std::vector<PackedExpression> numbers;
  for (const TunableParameters::Number& n : found.numbers)
    numbers.push_back({n.formula, out.content().doubles[n.place], n.factor});
  out.tune(std::move(found.parameters), std::move(found.formulas), std::move(numbers));
  if (fixed) *fixed = std::move(found.fixed);
  return out;
}

std::vector<double> packed_values(const PackedModel& model,
                                  const std::vector<ParameterOverride>& overrides) {
  std::vector<double> values;
  for (const PackedParameter& p : model.parameters()) values.push_back(p.value);
  ErrorList errors;
  for (const ParameterOverride& o : overrides) {
    const std::string what = "--set " + o.name + "=" + o.value.substr(0, 100) + ": ";
    const int k = model.find_parameter(o.name);
    const PlainScalar p = classify_plain_scalar(o.value);
    if (k < 0)
      errors.add(ErrorCode::unknown_key, {},
                 what + "found a packed model whose parameter '" + o.name +
                     "' is fixed or does not exist, expected " + names_text(model));
    else if (p.kind != PlainScalar::Kind::number)
      errors.add(ErrorCode::not_a_number, {}, what + "found " + o.value + ", expected a number");
    else
      values[k] = p.number;
  }
  errors.throw_if_any();
  return values;
}

bool is_packed_file(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;  // a pipe would be waited for
  std::ifstream file(path, std::ios::binary);
  std::array<char, 64> first{};
  file.read(first.data(), first.size());
  const auto bytes = std::as_bytes(std::span(first.data(), std::size_t(file.gcount())));
  return is_packed_model(bytes);
}

}  // namespace floatframe

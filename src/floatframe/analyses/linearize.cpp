// Linearize: the model as zdot = A z + B u, y = C z + D u between named inputs and outputs, at the
// start, in equilibrium or after a time; A, B, C, D to files of NumPy, MATLAB and tables.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "floatframe/formats/matlab/mat_file.hpp"
#include "floatframe/linear/linear_ports.hpp"
#include "floatframe/linear/operating_point.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

struct LinearizeOptions {
  LinearPorts ports;
  std::string at;
};

/// Data for the files.
struct LinearizeResult {
  std::string model;
  LinearModel linear;
  StateSpace space;
};

std::vector<std::string> linearize_names(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(c.name);
  return names;
}
std::vector<std::string> linearize_units(const std::vector<Column>& columns) {
  std::vector<std::string> units;
  for (const Column& c : columns) units.push_back(c.unit);
  return units;
}

std::string linearize_text(const LinearizeResult& r) {
  const StateSpace& s = r.space;
  const std::string& stiffening = r.linear.system.stiffening;
  std::string text = stiffening.empty() ? "" : stiffening + ".\n\n";
  text += fmt::format("{}: {}, {}, {} at t = {:g} s\n\n", r.model,
                      plural(static_cast<long>(s.states.size()), "state"),
                      plural(static_cast<long>(s.inputs.size()), "input"),
                      plural(static_cast<long>(s.outputs.size()), "output"), r.linear.time);
  TextTable states({"state", ""}, {1});
  for (std::size_t k = 0; k < s.states.size(); ++k)
    states.add({std::to_string(k + 1), s.states[k]});
  text += states.text();
  if (!s.inputs.empty()) {
    TextTable inputs({"input", "unit", "value there"}, {1});
    for (std::size_t k = 0; k < s.inputs.size(); ++k)
      inputs.add({s.inputs[k].name, s.inputs[k].unit,
                  r.linear.inputs[k].order() > 0
                      ? ""
                      : fmt::format("{:.6g}", r.linear.input_values[static_cast<long>(k)])});
    text += "\n" + inputs.text();
  }
  if (!s.outputs.empty()) {
    TextTable outputs({"output", "unit", "value there"}, {1});
    for (std::size_t k = 0; k < s.outputs.size(); ++k)
      outputs.add({s.outputs[k].name, s.outputs[k].unit,
                   fmt::format("{:.6g}", r.linear.output_values[static_cast<long>(k)])});
    text += "\n" + outputs.text();
  }
  text +=
      "\nzdot = A z + B u, y = C z + D u in changes from there; --npz, --mat, --csv and --json "
      "give the matrices.\n";
  for (const std::string& note : r.linear.system.notes) text += "Note: " + note + ".\n";
  return text;
}

std::string linearize_json(const LinearizeResult& r) {
  using Json = nlohmann::ordered_json;
  const auto list = [](const std::vector<Column>& columns) {
    Json all = Json::array();
    for (const Column& c : columns) all.push_back({{"name", c.name}, {"unit", c.unit}});
    return all;
  };
  const StateSpace& s = r.space;
  return json_document({{"model", r.model},
                        {"time_s", r.linear.time},
                        {"states", s.states},
                        {"inputs", list(s.inputs)},
                        {"outputs", list(s.outputs)},
                        {"input_values", json_array(r.linear.input_values)},
                        {"output_values", json_array(r.linear.output_values)},
                        {"A", json_rows(s.A)},
                        {"B", json_rows(s.B)},
                        {"C", json_rows(s.C)},
                        {"D", json_rows(s.D)},
                        {"largest_speed", r.linear.system.speed},
                        {"largest_acceleration", r.linear.system.acceleration},
                        {"stiffening_counted_in", r.linear.system.stiffened},
                        {"notes", r.linear.system.notes}});
}

/// All data for the files of matrices, by name.
std::vector<MatVariable> linearize_variables(const LinearizeResult& r) {
  const StateSpace& s = r.space;
  const auto column = [](const VecX& v) { return MatX(v); };
  return {{"A", s.A},
          {"B", s.B},
          {"C", s.C},
          {"D", s.D},
          {"states", s.states},
          {"inputs", linearize_names(s.inputs)},
          {"input_units", linearize_units(s.inputs)},
          {"outputs", linearize_names(s.outputs)},
          {"output_units", linearize_units(s.outputs)},
          {"input_values", column(r.linear.input_values)},
          {"output_values", column(r.linear.output_values)},
          {"time", column(VecX::Constant(1, r.linear.time))}};
}

std::string linearize_npz(const LinearizeResult& r) {
  std::vector<std::string> names, contents;
  for (const MatVariable& v : linearize_variables(r)) {
    names.push_back(v.name + ".npy");
    if (const auto* texts = std::get_if<std::vector<std::string>>(&v.value)) {
      contents.push_back(npy_texts(*texts));
      continue;
    }
    const MatX& m = std::get<MatX>(v.value);
    std::vector<double> rows;
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j) rows.push_back(m(i, j));
    const bool matrix = v.name.size() == 1;
    NpyArray array{{static_cast<std::size_t>(m.rows())}, std::move(rows)};
    if (matrix) array.shape.push_back(static_cast<std::size_t>(m.cols()));
    if (v.name == "time") array.shape.clear();
    contents.push_back(npy_bytes(array));
  }
  std::vector<ZipMember> members;
  for (std::size_t k = 0; k < names.size(); ++k) members.push_back({names[k], contents[k]});
  return zip_archive(members);
}

/// [A B; C D] with names: one row per state and output, one column per state and input.
std::string linearize_csv(const LinearizeResult& r) {
  const StateSpace& s = r.space;
  std::string text = "of";
  for (const std::string& state : s.states) text += "," + csv_field(state);
  for (const Column& c : s.inputs) text += "," + csv_title(c.name, c.unit);
  text += "\n";
  const auto row = [&](const std::string& title, const MatX& left, const MatX& right,
                       Eigen::Index k) {
    text += title;
    for (Eigen::Index j = 0; j < left.cols(); ++j) text += fmt::format(",{:.17g}", left(k, j));
    for (Eigen::Index j = 0; j < right.cols(); ++j) text += fmt::format(",{:.17g}", right(k, j));
    text += "\n";
  };
  for (std::size_t k = 0; k < s.states.size(); ++k)
    row(csv_field("derivative of " + s.states[k]), s.A, s.B, static_cast<Eigen::Index>(k));
  for (std::size_t k = 0; k < s.outputs.size(); ++k)
    row(csv_title(s.outputs[k].name, s.outputs[k].unit), s.C, s.D, static_cast<Eigen::Index>(k));
  return text;
}

AnalysisReport report_linearize(const Model& given, const LinearizeOptions& options) {
  const auto r = std::make_shared<LinearizeResult>();
  r->model = given.name;
  r->linear = linear_model(counted_at_operating_point(given, options.at).model, options.ports);
  r->space = state_space(r->linear);
  return {.text = linearize_text(*r),
          .json = linearize_json(*r),
          .files = {[r] { return linearize_npz(*r); },
                    [r] { return mat_file(linearize_variables(*r)); },
                    [r] { return linearize_csv(*r); }}};
}

}  // namespace

Analysis linearize_analysis() {
  const auto o = std::make_shared<LinearizeOptions>();
  return {
      .name = "linearize",
      .help = "The model as a linear system A, B, C, D between named inputs and outputs (SI units)",
      .options = {word_list("--inputs", o->ports.inputs, {},
                            "Inputs of the model, 'motion of JOINT', 'road', 'road at TYRE'; "
                            "default: all"),
                  word_list("--outputs", o->ports.outputs, {},
                            "Outputs of the model; default: all"),
                  operating_point_option(o->at)},
      .json_help = "JSON on standard output",
      .files = {{"--npz", "Write the matrices as arrays of NumPy"},
                {"--mat", "Write the matrices as a MATLAB file (version 7)"},
                {"--csv", "Write [A B; C D] as a table with names"}},
      .footer =
          "Roads enter by the rate of their height, prescribed motions by their acceleration; "
          "value and rate\nare then states.\n"
          "Exit codes: 0 done, 1 the start cannot be found, 2 bad input.",
      .run = [o](const Model& model) { return report_linearize(model, *o); }};
}

}  // namespace floatframe

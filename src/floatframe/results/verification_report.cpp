#include "floatframe/results/verification_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/text_table.hpp"

namespace floatframe {
namespace {

/// The estimated error relative to the range of the output, or to its size if it is constant.
double relative_error(const VerifiedOutput& o) noexcept {
  if (o.convergence == Convergence::round_off) return 0.0;
  const double size = o.range > 0.0 ? o.range : o.magnitude;
  return size > 0.0 ? o.error / size : std::numeric_limits<double>::infinity();
}

/// Relative to the range, or to 1e-6 of the largest output of the same unit: an output that is
/// rounding compared with others would come first otherwise.
std::vector<const VerifiedOutput*> largest_error_first(const Verification& v) {
  std::map<std::string, double> largest;  // by unit
  for (const VerifiedOutput& o : v.outputs)
    largest[o.column.unit] = std::max(largest[o.column.unit], o.magnitude);
  std::vector<std::pair<double, const VerifiedOutput*>> order;
  for (const VerifiedOutput& o : v.outputs) {
    const double size = std::max(o.range, 1e-6 * largest[o.column.unit]);
    order.emplace_back(o.range > 0.0 ? relative_error(o) * o.range / size : relative_error(o), &o);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const VerifiedOutput*> out;
  for (const auto& [weight, o] : order) out.push_back(o);
  return out;
}

std::string percent(double x) { return fmt::format("{:.2g} %", 100.0 * x); }

std::string order_text(const VerifiedOutput& o) {
  switch (o.convergence) {
    case Convergence::regular:
      return fmt::format("{:.2f}", o.order);
    case Convergence::round_off:
      return "- (round-off)";
    case Convergence::none:
      return "- (not converging)";
    case Convergence::too_coarse:
      return "- (too coarse)";
    case Convergence::unknown:
      break;
  }
  return "-";
}

}  // namespace

std::string verification_scope(const Verification& v) {
  return fmt::format("steps of {:g} and {:g} ms, at {} from {:g} to {:g} s", 500.0 * v.step,
                     250.0 * v.step, plural(v.instants, "instant"), v.from, v.to);
}

std::string verification_verdict(const Verification& v) {
  const auto worst = largest_error_first(v);
  if (worst.empty()) return "nothing to compare";
  if (relative_error(*worst.front()) == 0.0) return "differences at round-off";
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const VerifiedOutput& o : v.outputs)
    if (o.convergence == Convergence::regular) {
      low = std::min(low, o.order);
      high = std::max(high, o.order);
    }
  const std::string error =
      fmt::format("largest {} of the range of {}", percent(relative_error(*worst.front())),
                  worst.front()->column.name);
  if (low > high) return error;
  const std::string orders = high - low < 0.05 ? fmt::format("order {:.1f}", low)
                                               : fmt::format("orders {:.1f} to {:.1f}", low, high);
  return error + ", " + orders;
}

std::vector<std::string> verification_columns() {
  return {"output", "unit", "largest difference", "at [s]", "order", "error", "of its range"};
}

std::vector<std::vector<std::string>> verification_rows(const Verification& v, std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  for (const VerifiedOutput* o : largest_error_first(v)) {
    if (rows.size() == most) break;
    const bool at_least = o->convergence == Convergence::none;
    rows.push_back({o->column.name, o->column.unit, fmt::format("{:.3g}", o->largest),
                    fmt::format("{:.6g}", o->at), order_text(*o),
                    fmt::format("{}{:.2g}", at_least ? ">= " : "", o->error),
                    o->convergence == Convergence::round_off ? "" : percent(relative_error(*o))});
  }
  return rows;
}

std::string verification_text(const Verification& v) {
  constexpr long most = 12;
  std::string text = fmt::format("verified with {}, {:.3g} s of processor time: {}\n",
                                 verification_scope(v), v.cpu, printable(verification_verdict(v)));
  const auto round_off = std::count_if(
      v.outputs.begin(), v.outputs.end(),
      [](const VerifiedOutput& o) { return o.convergence == Convergence::round_off; });
  const long all = std::ssize(v.outputs), shown = std::min(all - round_off, most);
  TextTable table(verification_columns(), {0, 1});
  for (std::vector<std::string>& row : verification_rows(v, shown)) {
    for (std::string& cell : row) cell = printable(cell);
    table.add(std::move(row));
  }
  if (!table.empty()) text += table.text(2);
  if (all > shown)
    text += fmt::format("  and {} more{}; all are in the summary\n", all - shown,
                        round_off > 0 ? fmt::format(", {} of them at round-off", round_off) : "");
  return text;
}

nlohmann::ordered_json verification_json(const Verification& v) {
  using Json = nlohmann::ordered_json;
  Json outputs = Json::array();
  for (const VerifiedOutput& o : v.outputs)
    outputs.push_back({{"name", o.column.name},
                       {"unit", o.column.unit},
                       {"largest_difference", o.largest},
                       {"at_s", o.at},
                       {"range", o.range},
                       {"convergence", convergence_names[index_of(o.convergence)]},
                       {"order", o.convergence == Convergence::regular ? Json(o.order) : Json()},
                       {"error", o.error}});
  return {{"steps_s", {v.step, v.step / 2.0, v.step / 4.0}},
          {"instants", v.instants},
          {"from_s", v.from},
          {"to_s", v.to},
          {"cpu_s", v.cpu},
          {"sentences", v.sentences},
          {"outputs", std::move(outputs)}};
}

}  // namespace floatframe

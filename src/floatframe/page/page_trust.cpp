#include "floatframe/page/page_trust.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "floatframe/history/state_history.hpp"
#include "floatframe/page/html_text.hpp"
#include "floatframe/page/page_curves.hpp"
#include "floatframe/page/page_json.hpp"
#include "floatframe/results/verification_report.hpp"
#include "floatframe/run/range_watch.hpp"
#include "floatframe/run/state_layout.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// One curve: (number in the row - start) / divisor.
struct TrustCurve {
  std::size_t column = 0;
  std::string name{}, label{}, unit{}, group{}, kind{};
  double start = 0.0, divisor = 1.0;
  bool per_step = false;    ///< divided by the steps since the previous instant
  bool since_last = false;  ///< undefined at the start
  double limit = 0.0;       ///< 0: none
};

TrustCurve effort_curve(const HistoryHealth& h) {
  TrustCurve c{.name = h.name, .unit = h.unit, .group = h.group};
  c.since_last = true;
  if (h.name == "position_violation") {
    c.label = "largest violation of a position constraint";
  } else if (h.name == "velocity_violation") {
    c.label = "largest violation of a velocity constraint";
  } else if (h.name == "substeps") {
    c.label = "extra steps by halving";
    c.kind = "extra steps by halving";
    return c;
  } else {
    c.label = h.name == "factorizations" ? "factorisations per step" : h.name + " per step";
    c.kind = "per step";
    c.per_step = true;
    return c;
  }
  c.kind = "violation";
  return c;
}

TrustCurve energy_curve(const HistoryHealth& h, double at_start) {
  TrustCurve c{.name = "energy." + h.name, .unit = h.unit, .group = h.group, .kind = "energy"};
  const bool work = h.name.starts_with("work_of_"), remainder = h.name == "remainder";
  c.label = h.name == "tyres"     ? "energy kept in tyres"
            : h.name == "elastic" ? "elastic (modes)"
            : remainder           ? "remainder"
                                  : spaced_words(h.name);
  if (!work && !remainder) c.start = at_start;
  return c;
}

TrustCurve range_curve(const HistoryHealth& h) {
  const bool mode = h.name.ends_with(".largest_mode");
  TrustCurve c{.name = h.name, .label = h.body, .unit = "%", .group = h.group};
  c.kind = mode ? "Largest modal amplitude" : "Elastic displacement";
  c.divisor = 0.01 * h.size;
  c.limit = 100.0 * RangeLimits().displacement;
  return c;
}

std::vector<TrustCurve> trust_curves(const HistoryHeader& header, const std::vector<double>& row,
                                     std::size_t first) {
  std::vector<TrustCurve> out;
  for (std::size_t k = 0; k < header.health.size(); ++k) {
    const HistoryHealth& h = header.health[k];
    if (h.name == "steps" || (h.group == "range" && !(h.size > 0.0))) continue;
    TrustCurve c = h.group == "energy"  ? energy_curve(h, row[first + k])
                   : h.group == "range" ? range_curve(h)
                                        : effort_curve(h);
    c.column = first + k;
    out.push_back(std::move(c));
  }
  return out;
}

Json channel_json(const TrustCurve& c, const std::vector<double>& values, double noise,
                  PageBuffer& buffer) {
  const Extent e = extent_of(values);
  const std::vector<float> numbers(values.begin(), values.end());
  return {{"name", c.name},
          {"label", c.label},
          {"unit", c.unit},
          {"group", c.group},
          {"kind", c.kind},
          {"data", buffer.add(std::span<const float>(numbers), {numbers.size()})},
          {"offset", 0.0},
          {"limit", c.limit > 0.0 ? Json(c.limit) : Json()},
          {"constant", e.constant()},
          {"noise", e.size() > 0.0 && e.size() <= noise}};
}

/// Noise level of the balance terms due to rounding and tolerances: 1e-9 of the largest.
double energy_noise(const std::vector<TrustCurve>& curves, const PageCurves& values) {
  double most = 0.0;
  for (std::size_t k = 0; k < curves.size(); ++k)
    if (curves[k].group == "energy") most = std::max(most, extent_of(values.values[k]).size());
  return 1e-9 * most;
}

}  // namespace

void add_trust_curves(const StateHistory& history, Json& trust, PageBuffer& buffer) {
  const HistoryHeader& header = history.header();
  const HistoryGroup* group = header.find(health_group);
  if (!group || group->count == 0 || history.instants() == 0) return;
  std::vector<double> row(header.columns);
  history.instant(0, row);
  const std::vector<TrustCurve> curves = trust_curves(header, row, group->first);
  std::size_t steps = 0;
  for (std::size_t k = 0; k < header.health.size(); ++k)
    if (header.health[k].name == "steps") steps = group->first + k;
  std::vector<Column> columns{{"time", "s"}};
  for (const TrustCurve& c : curves) columns.push_back({c.name, c.unit});
  const PageCurves values = page_curves(
      columns, history.instants(), most_numbers_of_trust, [&](std::size_t k, double* out) {
        history.instant(k, row);
        *out++ = row[0];
        const double made = steps > 0 ? row[steps] : 0.0;
        for (const TrustCurve& c : curves) {
          const double x = (row[c.column] - c.start) / (c.per_step ? made : c.divisor);
          *out++ = c.since_last && !(made > 0.0) ? no_number : x;
        }
      });
  const double noise = energy_noise(curves, values);
  Json channels = Json::array();
  for (std::size_t k = 0; k < curves.size(); ++k)
    channels.push_back(channel_json(curves[k], values.values[k],
                                    curves[k].group == "energy" ? noise : 0.0, buffer));
  trust["time"] = buffer.add(std::span<const double>(values.time), {values.time.size()});
  trust["channels"] = std::move(channels);
  trust["notes"] = {
      {"constraints", "After the steps since the recorded instant before, the largest."},
      {"energy",
       "Changes of energies since the start, and work done on the system up to each instant, "
       "positive where it adds energy. Changes less work are the remainder: the energy error "
       "of the integration."},
      {"effort", "Of the steps since the recorded instant before."},
      {"range",
       "Relative to the size of the body; of a modal amplitude the largest displacement that it "
       "makes. Linear modes hold for small deformations: beyond a tenth of the size the run "
       "warns."}};
}

void add_verification(const Verification& v, Json& trust) {
  std::string note = "The run was made again with " + verification_scope(v) +
                     ". The order is log2 of the ratio of the largest differences, the error of "
                     "the run is extrapolated with it.";
  for (const std::string& sentence : v.sentences) {
    note += ' ' + sentence + '.';
    char& first = note[note.size() - sentence.size() - 1];
    first = static_cast<char>(std::toupper(static_cast<unsigned char>(first)));
  }
  trust["tables"] = tables_json({{"Dependence on the step", verification_columns(),
                                  verification_rows(v, v.outputs.size()), note}});
}

}  // namespace floatframe

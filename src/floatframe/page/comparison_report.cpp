#include "floatframe/page/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "floatframe/core/plural.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/text_pieces.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

std::string listed(const std::vector<std::string>& names) { return names_text(names, 5); }

}  // namespace

bool beyond(const ComparedResults& r, const ChannelDifference& d) {
  return r.tolerance && !agrees(d, *r.tolerance);
}

std::vector<const ChannelDifference*> worst_first(const ResultsComparison& c) {
  constexpr double rounding = 1e-6;
  std::map<std::string, double> largest;  // by unit
  std::vector<const ChannelDifference*> order;
  for (const ChannelDifference& d : c.channels) {
    order.push_back(&d);
    double& size = largest[d.unit];
    size = std::max(size, d.size);
  }
  const auto weight = [&](const ChannelDifference& d) {
    const double size = std::max(d.size, rounding * largest[d.unit]);
    return size > 0.0 ? d.largest / size : d.relative();
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const auto* x, const auto* y) { return weight(*x) > weight(*y); });
  return order;
}

std::vector<std::string> comparison_notes(const ComparedResults& r) {
  const ResultsComparison& c = r.comparison;
  std::vector<std::string> notes;
  if (c.interpolated)
    notes.push_back(fmt::format(
        "the instants of the two differ: compared at those of '{}', between which the other "
        "is taken as linear",
        r.file_a));
  if (c.torn_a || c.torn_b)
    notes.push_back(fmt::format("the last line of '{}' was cut off and is left out",
                                c.torn_a ? r.file_a : r.file_b));
  if (!r.tolerance || r.overlap) {
    if (c.spans_differ())
      notes.push_back(
          fmt::format("compared from {:g} to {:g} s: the one covers {:g} to {:g} s, "
                      "the other {:g} to {:g} s",
                      c.from, c.to, c.start_a, c.end_a, c.start_b, c.end_b));
  }
  if (!r.tolerance) {
    for (const auto& [names, file] : {std::pair{&c.only_a, &r.file_a}, {&c.only_b, &r.file_b}})
      if (!names->empty()) notes.push_back(fmt::format("only in '{}': {}", *file, listed(*names)));
    if (!c.other_units.empty())
      notes.push_back("in different units, not compared: " + listed(c.other_units));
  }
  return notes;
}

std::string comparison_verdict(const ComparedResults& r) {
  const ResultsComparison& c = r.comparison;
  const std::string compared =
      fmt::format("{} at {}", plural(static_cast<long>(c.channels.size()), "channel", "channels"),
                  plural(static_cast<long>(c.instants), "instant", "instants"));
  if (std::all_of(c.channels.begin(), c.channels.end(),
                  [](const ChannelDifference& d) { return d.largest == 0.0; }))
    return "equal to the last bit: " + compared;
  if (!r.tolerance) return compared;
  const auto count = std::count_if(c.channels.begin(), c.channels.end(),
                                   [&](const ChannelDifference& d) { return beyond(r, d); });
  const std::string within =
      r.tolerance->absolute > 0.0
          ? fmt::format("{:g} of the size and {:g}", r.tolerance->relative, r.tolerance->absolute)
          : fmt::format("{:g} of the size", r.tolerance->relative);
  if (count == 0) return fmt::format("within {}: {}", within, compared);
  return fmt::format("{} of {} beyond {}", count, compared, within);
}

std::vector<std::string> disagreements(const ComparedResults& r) {
  std::vector<std::string> out;
  if (!r.tolerance) return out;
  const ResultsComparison& c = r.comparison;
  for (const auto& [names, file] : {std::pair{&c.only_a, &r.file_a}, {&c.only_b, &r.file_b}})
    if (!names->empty()) out.push_back(fmt::format("only in '{}': {}", *file, listed(*names)));
  if (!c.other_units.empty()) out.push_back("in different units: " + listed(c.other_units));
  if (c.spans_differ() && !r.overlap)
    out.push_back(
        fmt::format("'{}' covers {:g} to {:g} s, '{}' covers {:g} to {:g} s (--overlap compares "
                    "the span that both have)",
                    r.file_a, c.start_a, c.end_a, r.file_b, c.start_b, c.end_b));
  std::vector<std::string> names;
  for (const ChannelDifference* d : worst_first(c))
    if (beyond(r, *d)) names.push_back(fmt::format("{} ({:.2g})", d->name, d->largest));
  if (!names.empty()) out.push_back("beyond the tolerance: " + listed(names));
  return out;
}

std::string comparison_text(const ComparedResults& r) {
  std::string text = fmt::format("A  {}\nB  {}\n{}\n", printable(r.file_a), printable(r.file_b),
                                 comparison_verdict(r));
  for (const std::string& note : comparison_notes(r)) text += "note: " + printable(note) + "\n";
  TextTable table({"channel", "unit", "largest difference", "at [s]", "RMS", "size of A",
                   "difference/size", ""},
                  {0, 1, 7});
  for (const ChannelDifference* d : worst_first(r.comparison)) {
    if (d->largest == 0.0) continue;
    table.add({printable(d->name), printable(d->unit), fmt::format("{:.4g}", d->largest),
               fmt::format("{:.6g}", d->at), fmt::format("{:.4g}", d->rms),
               fmt::format("{:.4g}", d->size), fmt::format("{:.2g}", d->relative()),
               beyond(r, *d) ? "beyond" : ""});
  }
  if (!table.empty()) text += "\n" + table.text();
  const auto equal = std::count_if(r.comparison.channels.begin(), r.comparison.channels.end(),
                                   [](const ChannelDifference& d) { return d.largest == 0.0; });
  if (equal > 0 && !table.empty())
    text += fmt::format("and {} to the last bit\n",
                        plural(equal, "channel that is equal", "channels that are equal"));
  return text;
}

std::string comparison_json(const ComparedResults& r) {
  using Json = nlohmann::ordered_json;
  const ResultsComparison& c = r.comparison;
  Json channels = Json::array();
  for (const ChannelDifference& d : c.channels)
    channels.push_back({{"name", d.name},
                        {"unit", d.unit},
                        {"largest", d.largest},
                        {"at_s", d.at},
                        {"rms", d.rms},
                        {"size", d.size},
                        {"agrees", r.tolerance ? Json(!beyond(r, d)) : Json()}});
  const auto span = [](double start, double end) { return Json{{"from_s", start}, {"to_s", end}}; };
  return json_document({{"a", r.file_a},
                        {"b", r.file_b},
                        {"relative_tolerance", r.tolerance ? Json(r.tolerance->relative) : Json()},
                        {"absolute_tolerance", r.tolerance ? Json(r.tolerance->absolute) : Json()},
                        {"agrees", r.tolerance ? Json(disagreements(r).empty()) : Json()},
                        {"disagreements", disagreements(r)},
                        {"instants", c.instants},
                        {"interpolated", c.interpolated},
                        {"compared", span(c.from, c.to)},
                        {"span_a", span(c.start_a, c.end_a)},
                        {"span_b", span(c.start_b, c.end_b)},
                        {"only_in_a", c.only_a},
                        {"only_in_b", c.only_b},
                        {"other_units", c.other_units},
                        {"channels", channels}});
}

}  // namespace floatframe

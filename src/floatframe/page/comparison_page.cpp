#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/page/comparison_report.hpp"
#include "floatframe/page/page_json.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

Json by_name(const Json& curves) {
  Json out = Json::object();
  for (const Json& channel : curves["channels"])
    out[channel["name"].get_ref<const std::string&>()] = channel;
  return out;
}

/// A channel with the curves of both results; a distinct kind gives it a separate plot.
Json both_curves(const ComparedResults& r, const ChannelDifference& d, Json channel,
                 const Json& other) {
  channel["kind"] = d.name;
  if (d.largest == 0.0 && channel["constant"].get<bool>()) return channel;
  channel["constant"] = false;
  // A channel that is rounding noise in one result may be a signal in the other.
  channel["noise"] = channel["noise"].get<bool>() && other["noise"].get<bool>();
  channel["other"] = other["data"];
  channel["other_offset"] = other["offset"];
  channel["difference"] = {{"max", std::isfinite(d.largest) ? Json(d.largest) : Json()},
                           {"rms", d.rms},
                           {"beyond", beyond(r, d)}};
  return channel;
}

}  // namespace

std::string comparison_page(const ComparedResults& r, const PageCurves& a, const PageCurves& b,
                            const std::string& software) {
  PageBuffer buffer;
  const Json first = curves_json(a, {}, buffer), second = curves_json(b, {}, buffer);
  const Json of_a = by_name(first), of_b = by_name(second);
  Json channels = Json::array();
  for (const ChannelDifference* d : worst_first(r.comparison))
    channels.push_back(both_curves(r, *d, of_a.at(d->name), of_b.at(d->name)));
  Json sentences = Json::array({comparison_verdict(r) + "."});
  for (const std::string& note : comparison_notes(r)) sentences.push_back(note);
  const char* state = !r.tolerance ? "compared" : disagreements(r).empty() ? "agree" : "differ";
  const ResultsComparison& c = r.comparison;
  const auto span = [](double start, double end) {
    return fmt::format("{:g} to {:g} s", start, end);
  };
  FactTable facts{"Compared",
                  {{"A", r.file_a},
                   {"B", r.file_b},
                   {"A covers", span(c.start_a, c.end_a)},
                   {"B covers", span(c.start_b, c.end_b)},
                   {"channels", std::to_string(c.channels.size())},
                   {"instants", std::to_string(c.instants)}}};
  Json page =
      empty_page("compare", "Comparison", software,
                 {{"state", state}, {"sentences", sentences}, {"warnings", disagreements(r)}});
  page["facts"] = facts_json({std::move(facts)});
  page["curves"] = {{"time", first["time"]},
                    {"other_time", second["time"]},
                    {"names", {"A: " + r.file_a, "B: " + r.file_b}},
                    {"channels", std::move(channels)}};
  return page_html(page_template(), page, buffer);
}

}  // namespace floatframe

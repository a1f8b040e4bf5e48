#include "floatframe/export/export_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"

namespace floatframe {
namespace {

[[noreturn]] void refuse_selection(ErrorCode code, const StateHistory& history,
                                   const std::string& what) {
  throw InputError(code, SourceMark{history.name(), 0, 0}, what);
}

std::string range_text(const ExportSelection& s) {
  if (std::isinf(s.to)) return fmt::format("from {:g} s on", s.from);
  if (std::isinf(s.from)) return fmt::format("up to {:g} s", s.to);
  return fmt::format("from {:g} to {:g} s", s.from, s.to);
}

}  // namespace

std::vector<std::size_t> selected_instants(const StateHistory& history,
                                           const ExportSelection& selection) {
  const std::size_t count = history.instants();
  if (count == 0)
    refuse_selection(ErrorCode::missing, history,
                     "found no recorded instant, expected one at least");
  std::vector<double> row(history.header().columns);
  std::vector<std::size_t> out;
  double first = 0.0, last = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    history.instant(k, row);
    last = row[0];
    if (k == 0) first = last;
    const double rounding = 1e-12 * std::max(1.0, std::abs(last));
    if (last >= selection.from - rounding && last <= selection.to + rounding) out.push_back(k);
  }
  if (out.empty())
    refuse_selection(
        ErrorCode::missing, history,
        fmt::format("found no recorded instant {}, expected some of the {} from {:g} to {:g} s",
                    range_text(selection), count, first, last));
  const auto every = static_cast<std::size_t>(selection.every);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < out.size(); k += every) out[kept++] = out[k];
  out.resize(kept);
  return out;
}

std::vector<int> selected_bodies(const StateHistory& history, const Model& model,
                                 const ExportSelection& selection) {
  const HistoryHeader& h = history.header();
  if (h.bodies.size() != model.bodies.size())
    refuse_selection(ErrorCode::mismatch, history, "its states are not of this model");
  std::vector<int> out;
  std::vector<std::string> known;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (selection.bodies.empty() && h.bodies[b].pose >= 0) out.push_back(static_cast<int>(b));
    known.push_back(model.bodies[b].name);
  }
  for (const std::string& name : selection.bodies) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end())
      throw InputError(ErrorCode::not_found,
                       fmt::format("--body: found '{}', expected a body of the model{}", name,
                                   did_you_mean(name, known)));
    const auto b = static_cast<std::size_t>(at - known.begin());
    if (h.bodies[b].pose < 0)
      refuse_selection(ErrorCode::missing, history,
                       fmt::format("the states of body '{}' were not recorded", name));
    out.push_back(static_cast<int>(b));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  if (out.empty())
    refuse_selection(ErrorCode::missing, history, "found no body whose states were recorded");
  return out;
}

}  // namespace floatframe

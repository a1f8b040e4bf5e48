// What goes into a plot: groups of columns, tick positions.
#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/report/svg_plot.hpp"

namespace floatframe {
namespace {

/// What columns of a plot share: the last two words of a name of three or more, the last of two,
/// nothing of one.
std::string shared_ending(const std::string& name) {
  const std::size_t last = name.rfind('.');
  if (last == std::string::npos || last == 0) return "";
  const std::size_t before = name.rfind('.', last - 1);
  return before == std::string::npos ? name.substr(last + 1) : name.substr(before + 1);
}

std::string last_word(const std::string& name) {
  const std::size_t last = name.rfind('.');
  return last == std::string::npos ? name : name.substr(last + 1);
}

PlotGroup make_group(const std::vector<Column>& columns, std::vector<std::size_t> indices,
                     const std::string& ending) {
  PlotGroup group;
  const Column& first = columns[indices.front()];
  group.unit = first.unit;
  group.columns = std::move(indices);
  if (group.columns.size() == 1) {
    group.title = first.name;
    group.quantity = last_word(first.name);
    return group;
  }
  group.quantity = last_word(ending);
  group.title = ending;
  if (ending.empty()) {
    for (const std::size_t c : group.columns) {
      group.title += (group.title.empty() ? "" : ", ") + columns[c].name;
    }
  }
  return group;
}

}  // namespace

std::vector<PlotGroup> group_columns(const std::vector<Column>& columns) {
  using Key = std::pair<std::string, std::string>;  // unit, ending
  std::vector<Key> order;
  std::map<Key, std::vector<std::size_t>> members;
  for (std::size_t c = 1; c < columns.size(); ++c) {
    const Key key{columns[c].unit, shared_ending(columns[c].name)};
    if (members[key].empty()) order.push_back(key);
    members[key].push_back(c);
  }
  std::vector<PlotGroup> groups;
  for (const Key& key : order) {
    const std::vector<std::size_t>& all = members[key];
    const std::size_t plots = (all.size() + max_curves_per_plot - 1) / max_curves_per_plot;
    for (std::size_t p = 0; p < plots; ++p) {
      const auto from = static_cast<std::ptrdiff_t>(p * all.size() / plots);
      const auto to = static_cast<std::ptrdiff_t>((p + 1) * all.size() / plots);
      groups.push_back(make_group(
          columns, std::vector<std::size_t>(all.begin() + from, all.begin() + to), key.second));
    }
  }
  return groups;
}

Ticks nice_ticks(double low, double high, int about, bool cover) {
  const double rough = (high - low) / std::max(about, 1);
  if (!(rough > 0.0) || !std::isfinite(rough)) return {low, 1.0, 1};
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * decade;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough * (1.0 - 1e-9)) {
      step = factor * decade;
      break;
    }
  }
  // A value just beyond a tick counts as on it: 40.0001 m must not stretch the axis to 50 m.
  const double slack = cover ? 0.01 : 1e-9;
  const double from = cover ? std::floor(low / step + slack) : std::ceil(low / step - slack);
  const double to = cover ? std::ceil(high / step - slack) : std::floor(high / step + slack);
  return {from * step, step, static_cast<int>(to - from) + 1};
}

}  // namespace floatframe

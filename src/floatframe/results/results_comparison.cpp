#include "floatframe/results/results_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/core/text_pieces.hpp"

namespace floatframe {
namespace {

/// Two programs or step sizes write the same instant with different last digits.
bool same_instant(double a, double b) noexcept {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

/// Differences of one channel, accumulated row by row.
struct Gathered {
  double largest = 0.0, at = 0.0, squares = 0.0;
  std::size_t numbers = 0;

  void add(double t, double a, double b) noexcept {
    const bool both = std::isfinite(a) && std::isfinite(b);
    if (!both && (a == b || (std::isnan(a) && std::isnan(b)))) return;
    const double d = both ? std::abs(a - b) : std::numeric_limits<double>::infinity();
    if (d > largest) {
      largest = d;
      at = t;
    }
    if (!both) return;
    squares += d * d;
    ++numbers;
  }
};

struct Pair {
  std::size_t a, b;  ///< columns
};

/// Reads both tables in parallel, keeping the next row of B and the one before it.
class Merge {
 public:
  Merge(ResultsReader& a, ResultsReader& b, const std::vector<Pair>& pairs)
      : a_(a),
        b_(b),
        pairs_(pairs),
        common_(pairs.size()),
        all_(pairs.size()),
        size_(pairs.size(), 0.0) {}

  void run(ResultsComparison& out) {
    for (ResultsReader* r : {&a_, &b_})
      if (!r->next())
        throw InputError(ErrorCode::missing, {r->file(), 0, 0}, "there is no row of results");
    out.start_a = a_.time();
    out.start_b = out.end_b = b_.time();
    do {
      note_sizes();
      advance_to(a_.time());
      take_row();
      out.end_a = a_.time();
    } while (a_.next());
    while (next_) advance();
    out.end_b = before_.front();
    out.torn_a = a_.torn();
    out.torn_b = b_.torn();
    finish(out);
  }

 private:
  void note_sizes() noexcept {
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double size = std::abs(a_.row()[pairs_[k].a]);
      if (std::isfinite(size)) size_[k] = std::max(size_[k], size);
    }
  }

  void advance() {
    before_ = b_.row();
    next_ = b_.next();
    matched_ = false;
  }

  /// Advances until the next row of B is at t or later.
  void advance_to(double t) {
    while (next_ && b_.time() < t && !same_instant(b_.time(), t)) {
      if (!matched_ && rows_a_ > 0) ++passed_;
      advance();
    }
  }

  void take_row() {
    const double t = a_.time();
    if (!next_) return;  // B has ended
    const double now = b_.time();
    const bool same = same_instant(now, t);
    if (!same && before_.empty()) return;  // B has not begun
    if (rows_a_ == 0) first_ = t;
    last_ = t;
    ++rows_a_;
    rows_b_ += passed_;
    passed_ = 0;
    if (same) {
      ++both_;
      ++rows_b_;
      matched_ = true;
    }
    const double w = same ? 1.0 : (t - before_.front()) / (now - before_.front());
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double x = a_.row()[pairs_[k].a];
      double y = b_.row()[pairs_[k].b];
      if (same)
        common_[k].add(t, x, y);
      else
        y = before_[pairs_[k].b] + w * (y - before_[pairs_[k].b]);
      all_[k].add(t, x, y);
    }
  }

  void finish(ResultsComparison& out) const {
    if (rows_a_ == 0)
      throw InputError(ErrorCode::out_of_range, {b_.file(), 0, 0},
                       fmt::format("found results from {:g} to {:g} s, expected some at the times "
                                   "of '{}' from {:g} to {:g} s",
                                   out.start_b, out.end_b, a_.file(), out.start_a, out.end_a));
    out.interpolated = both_ < std::min(rows_a_, rows_b_) || both_ == 0;
    out.instants = out.interpolated ? rows_a_ : both_;
    out.from = first_;
    out.to = last_;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Gathered& g = out.interpolated ? all_[k] : common_[k];
      const Column& column = a_.columns()[pairs_[k].a];
      out.channels.push_back(
          {column.name, column.unit, g.largest, g.at,
           g.numbers > 0 ? std::sqrt(g.squares / static_cast<double>(g.numbers)) : 0.0, size_[k]});
    }
  }

  ResultsReader &a_, &b_;
  const std::vector<Pair>& pairs_;
  std::vector<Gathered> common_, all_;
  std::vector<double> size_;
  std::vector<double> before_;  ///< the row of B before the next one, or empty
  bool next_ = true;
  bool matched_ = false;  ///< the next row of B is at an instant of A
  /// In the common span: rows of A and of B, rows of B that A has passed, common instants.
  std::size_t rows_a_ = 0, rows_b_ = 0, passed_ = 0, both_ = 0;
  double first_ = 0.0, last_ = 0.0;
};

std::vector<std::string> names_of(const ResultsReader& r) {
  std::vector<std::string> names;
  for (std::size_t c = 1; c < r.columns().size(); ++c) names.push_back(r.columns()[c].name);
  return names;
}

void require_channels(const ResultsReader& r, const std::vector<std::string>& names) {
  const std::vector<std::string> known = names_of(r);
  const std::set<std::string> have(known.begin(), known.end());
  for (const std::string& name : names)
    if (!have.contains(name))
      throw InputError(ErrorCode::not_found, {r.file(), 1, 0},
                       fmt::format("there is no channel '{}'{}", name, did_you_mean(name, known)));
}

/// "'x', 'y' and 3 more"
std::string some_names(const std::vector<std::string>& names) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back("'" + name + "'");
  return names.empty() ? "none" : names_text(quoted, 4);
}

InputError no_common_channels(const ResultsReader& a, const ResultsReader& b,
                              const ResultsComparison& found) {
  const std::string units =
      found.other_units.empty() ? "" : "; of other units: " + some_names(found.other_units);
  return InputError(
      ErrorCode::missing, {b.file(), 1, 0},
      fmt::format("found no channel that '{}' has too, expected one or more (here {}, there {}{})",
                  a.file(), some_names(found.only_b), some_names(found.only_a), units));
}

}  // namespace

bool ResultsComparison::spans_differ() const noexcept {
  return !same_instant(start_a, start_b) || !same_instant(end_a, end_b);
}

bool agrees(const ChannelDifference& d, const ComparisonTolerance& tolerance) noexcept {
  return d.largest <= tolerance.absolute + tolerance.relative * d.size;
}

ResultsComparison compare_results(ResultsReader& a, ResultsReader& b,
                                  const std::vector<std::string>& names) {
  require_channels(a, names);
  require_channels(b, names);
  const std::set<std::string> wanted(names.begin(), names.end());
  const auto is_selected = [&](const std::string& name) {
    return wanted.empty() || wanted.contains(name);
  };
  std::map<std::string, std::size_t> columns_b;
  for (std::size_t c = 1; c < b.columns().size(); ++c) columns_b[b.columns()[c].name] = c;
  ResultsComparison out;
  std::vector<Pair> pairs;
  std::set<std::string> of_a;
  for (std::size_t c = 1; c < a.columns().size(); ++c) {
    const Column& column = a.columns()[c];
    if (!is_selected(column.name)) continue;
    of_a.insert(column.name);
    const auto it = columns_b.find(column.name);
    if (it == columns_b.end())
      out.only_a.push_back(column.name);
    else if (const std::string& unit = b.columns()[it->second].unit; unit != column.unit)
      out.other_units.push_back(fmt::format("{} [{}] and [{}]", column.name, column.unit, unit));
    else
      pairs.push_back({c, it->second});
  }
  for (std::size_t c = 1; c < b.columns().size(); ++c) {
    const std::string& name = b.columns()[c].name;
    if (is_selected(name) && !of_a.contains(name)) out.only_b.push_back(name);
  }
  if (pairs.empty()) throw no_common_channels(a, b, out);
  Merge(a, b, pairs).run(out);
  return out;
}

}  // namespace floatframe

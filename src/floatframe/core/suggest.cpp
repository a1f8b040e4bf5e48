#include "floatframe/core/suggest.hpp"

#include <algorithm>
#include <cstdlib>

namespace floatframe {
namespace {
/// Limits the time: among very many names only the first are compared [letter pairs].
constexpr std::size_t most_comparisons = 2'000'000;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[n];
}

const std::string* nearest(std::string_view name, const std::vector<std::string>& known) {
  if (name.size() > 100) return nullptr;
  const std::string* best = nullptr;
  int distance = std::max(name.size() > 1 ? 1 : 0, static_cast<int>(name.size()) / 3) + 1;
  std::size_t comparisons = 0;
  for (const std::string& k : known) {
    const auto longer = static_cast<int>(k.size()) - static_cast<int>(name.size());
    if (k.size() > 100 || std::abs(longer) >= distance) continue;
    if ((comparisons += name.size() * k.size()) > most_comparisons) break;
    const int d = edit_distance(name, k);
    if (d < distance) distance = d, best = &k;
  }
  if (best || name.size() < 3) return best;
  // An abbreviation: the shortest known name that starts with it.
  for (const std::string& k : known)
    if (std::string_view(k).substr(0, name.size()) == name && (!best || k.size() < best->size()))
      best = &k;
  return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const std::string* best = nearest(name, known);
  return best ? ", did you mean '" + *best + "'?" : std::string();
}

}  // namespace floatframe

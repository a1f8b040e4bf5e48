#include "floatframe/formats/written/written_numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <unordered_set>

#include "floatframe/core/plural.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// `ids`, or 1, 2, 3, ... if they are not all positive and different.
std::vector<int> usable_numbers(std::vector<int> ids, std::size_t count, const char* what,
                                std::vector<std::string>& notes) {
  bool usable = ids.size() == count;
  std::unordered_set<int> seen;
  for (const int id : ids) usable = usable && id > 0 && seen.insert(id).second;
  if (usable) return ids;
  const bool given =
      ids.size() == count && std::any_of(ids.begin(), ids.end(), [](int i) { return i > 0; });
  if (given)
    notes.push_back(
        fmt::format("the {} are numbered anew: their numbers are not all different", what));
  ids.resize(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<int>(i) + 1;
  return ids;
}

int largest_number(const std::vector<int>& numbers) {
  return numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
}

constexpr WrittenCell written_cells[] = {
    {1, 2, 3, 1},  {1, 3, 21, 8},                                   // lines
    {2, 3, 5, 2},  {2, 4, 9, 3},    {2, 6, 22, 9}, {2, 8, 23, 16},  // triangles, quadrilaterals
    {3, 4, 10, 4}, {3, 10, 24, 11},                                 // tetrahedra
    {3, 5, 14, 7}, {3, 13, 27, 19},                                 // pyramids
    {3, 6, 13, 6}, {3, 15, 26, 18},                                 // wedges
    {3, 8, 12, 5}, {3, 20, 25, 17},                                 // bricks
};

}  // namespace

const WrittenCell& written_cell(FeElementType type) {
  const ElementKernel& kernel = element_kernel(type);
  const int dimension = is_beam(type) || is_rod(type)           ? 1
                        : kernel.family == ElementFamily::solid ? 3
                                                                : 2;
  return *std::find_if(std::begin(written_cells), std::end(written_cells), [&](const auto& cell) {
    return cell.dimension == dimension && cell.nodes == kernel.nodes;
  });
}

WrittenNumbers written_numbers(const FeModel& model, std::vector<std::string>& notes) {
  WrittenNumbers out;
  std::vector<int> nodes = model.node_ids;
  if (nodes.empty())
    for (int i = 0; i < model.nodes(); ++i) nodes.push_back(i + 1);
  out.node = usable_numbers(std::move(nodes), model.positions.size(), "nodes", notes);
  std::vector<int> elements;
  for (const FeElement& e : model.elements) elements.push_back(e.id);
  out.element = usable_numbers(std::move(elements), model.elements.size(), "elements", notes);
  out.last_node = largest_number(out.node);
  out.last_element = largest_number(out.element);
  return out;
}

std::string written_name(const std::string& name, bool upper, std::set<std::string>& used) {
  std::string base;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0 && u < 128)
      base += upper ? static_cast<char>(std::toupper(u)) : c;
    else
      base += c == '-' ? '-' : '_';
  }
  if (base.empty()) base = "_";
  base.resize(std::min<std::size_t>(base.size(), 60));
  std::string out = base;
  for (int n = 2; !used.insert(out).second; ++n) out = fmt::format("{}_{}", base, n);
  return out;
}

void RenamedNames::add(const std::string& given, const std::string& written) {
  const auto same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  if (!std::equal(given.begin(), given.end(), written.begin(), written.end(), same))
    pairs_.emplace(given, written);
}

void RenamedNames::note(std::vector<std::string>& notes) const {
  if (pairs_.empty()) return;
  constexpr std::size_t most = 5;
  std::vector<std::string> shown;
  for (const auto& [given, written] : pairs_) {
    if (shown.size() == most) break;
    shown.push_back(fmt::format("'{}' as {}", given, written));
  }
  notes.push_back(fmt::format(
      "{} written otherwise (letters, digits, '_' and '-', at most 60, each once): {}{}",
      plural(static_cast<long>(pairs_.size()), "name is", "names are"), fmt::join(shown, ", "),
      shown.size() < pairs_.size() ? ", ..." : ""));
}

std::string written_material(const FeModel& model, int material) {
  const auto at = static_cast<std::size_t>(material);
  if (material >= 0 && at < model.material_names.size() && !model.material_names[at].empty())
    return model.material_names[at];
  return fmt::format("MATERIAL_{}", material + 1);
}

}  // namespace floatframe

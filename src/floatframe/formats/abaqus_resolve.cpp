#include "floatframe/formats/abaqus_resolve.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/suggest.hpp"
#include "floatframe/formats/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int deepest_set = 200;
// Sets of sets of sets can name the same nodes again and again.
constexpr std::uint64_t most_work = 500'000'000;

}  // namespace

AbaqusResolver::AbaqusResolver(const AbaqusContent& content, TextSource& source, Of of)
    : content_(content),
      source_(source),
      sets_(of == Of::nodes ? content.node_sets : content.element_sets),
      index_of_label_(of == Of::nodes ? content.node_of_label : content.element_of_label),
      word_(of == Of::nodes ? "node" : "element"),
      count_(of == Of::nodes ? content.nodes.size() : content.elements.size()) {
  ascending_.reserve(index_of_label_.size());
  for (const auto& [label, index] : index_of_label_) ascending_.push_back(label);
  std::sort(ascending_.begin(), ascending_.end());
}

const AbaqusContent::Key* AbaqusResolver::find_set(const AbaqusReference& reference) const {
  for (const AbaqusScope scope : {reference.scope, AbaqusScope::assembly, AbaqusScope::part}) {
    const auto it = sets_.find({scope, reference.name});
    if (it != sets_.end()) return &it->first;
  }
  return nullptr;
}

void AbaqusResolver::missing(const AbaqusReference& reference) {
  std::string help;
  if (reference.name >= 0) {
    std::vector<std::string> known;
    for (const auto& [key, set] : sets_) {
      known.push_back(content_.names[static_cast<std::size_t>(key.second)]);
    }
    help = did_you_mean(content_.names[static_cast<std::size_t>(reference.name)], known);
  }
  source_.fault(reference.at,
                fmt::format("{} is not there{}", content_.text(reference, word_), help));
}

void AbaqusResolver::add(int index, std::vector<int>& list, std::vector<char>& seen) const {
  char& flag = seen[static_cast<std::size_t>(index)];
  if (flag != 0) return;
  flag = 1;
  list.push_back(index);
}

void AbaqusResolver::append_range(const AbaqusReference& item, std::vector<int>& list,
                                  std::vector<char>& seen) {
  const std::int64_t first = AbaqusContent::label(item.scope, item.first),
                     last = AbaqusContent::label(item.scope, item.last);
  auto it = std::lower_bound(ascending_.begin(), ascending_.end(), first);
  long found = 0;
  for (; it != ascending_.end() && *it <= last; ++it) {
    ++work_;
    if ((*it - first) % item.step != 0) continue;
    ++found;
    add(index_of_label_.at(*it), list, seen);
  }
  const long wanted = static_cast<long>((last - first) / item.step) + 1;
  if (found == 0) {
    source_.fault(item.at,
                  fmt::format("none of the {}s {} to {} is there", word_, item.first, item.last));
  } else if (found < wanted) {
    if (gaps_ == 0) first_gap_ = item.at;
    gaps_ += wanted - found;
  }
}

void AbaqusResolver::append(const AbaqusReference& item, std::vector<int>& list,
                            std::vector<char>& seen) {
  if (++work_ > most_work) source_.stop(item.at, "the sets of sets have too many members");
  if (item.name < 0 && item.first != item.last) return append_range(item, list, seen);
  if (item.name < 0) {
    const auto it = index_of_label_.find(AbaqusContent::label(item.scope, item.first));
    if (it == index_of_label_.end()) return missing(item);
    return add(it->second, list, seen);
  }
  const AbaqusContent::Key* const key = find_set(item);
  if (key == nullptr) return missing(item);
  Members& set = members_[*key];
  if (set.state == State::busy) {
    source_.stop(item.at,
                 fmt::format("{} set {} contains itself", word_,
                             shown(content_.names[static_cast<std::size_t>(key->second)])));
  }
  const std::vector<int>& inner = members(*key, depth_);
  work_ += inner.size();
  for (const int index : inner) add(index, list, seen);
}

const std::vector<int>& AbaqusResolver::members(const AbaqusContent::Key& key) {
  return members(key, 0);
}

const std::vector<int>& AbaqusResolver::members(const AbaqusContent::Key& key, int depth) {
  Members& result = members_[key];
  if (result.state == State::done) return result.list;
  const AbaqusSet& set = sets_.at(key);
  if (depth >= deepest_set) {
    source_.stop(set.at, fmt::format("sets are nested deeper than {}", deepest_set));
  }
  result.state = State::busy;
  const std::size_t before = source_.faults();
  std::vector<char> seen(count_, 0);
  std::vector<int> list;
  for (const AbaqusReference& item : set.items) {
    // A set that is opened again may name itself.
    if (item.name == key.second && item.scope == key.first) continue;
    depth_ = depth + 1;
    append(item, list, seen);
  }
  depth_ = depth;
  if (list.empty() && source_.faults() == before) {
    source_.fault(set.at, fmt::format("{} set {} is empty", word_,
                                      shown(content_.names[static_cast<std::size_t>(key.second)])));
  }
  result.list = std::move(list);
  result.state = State::done;
  return result.list;
}

std::vector<int> AbaqusResolver::resolve(const AbaqusReference& reference) {
  if (reference.name >= 0) {
    const AbaqusContent::Key* const key = find_set(reference);
    if (key != nullptr) return members(*key);
    missing(reference);
    return {};
  }
  const auto it = index_of_label_.find(AbaqusContent::label(reference.scope, reference.first));
  if (it != index_of_label_.end()) return {it->second};
  missing(reference);
  return {};
}

int AbaqusResolver::one(const AbaqusReference& reference, std::string_view what) {
  const std::vector<int> found = resolve(reference);
  if (found.size() == 1) return found.front();
  if (!found.empty()) {
    source_.fault(reference.at, fmt::format("{}: {} has {} {}s, expected one", what,
                                            content_.text(reference, word_), found.size(), word_));
  }
  return -1;
}

}  // namespace floatframe

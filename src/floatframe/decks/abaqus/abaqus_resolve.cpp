#include <algorithm>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int deepest_set = 200;
// Members that are named in all: these, and so many times the nodes or elements of the deck.
constexpr std::uint64_t work_of_any_deck = 10'000'000, work_of_a_member = 100;

}  // namespace

AbaqusResolver::AbaqusResolver(const AbaqusContent& content, TextSource& source, Of of)
    : content_(content),
      source_(source),
      sets_(of == Of::nodes ? content.node_sets : content.element_sets),
      index_of_label_(of == Of::nodes ? content.nodes.index() : content.elements.index()),
      word_(of == Of::nodes ? "node" : "element"),
      list_of_(of == Of::nodes ? content.nodes.size() : content.elements.size(), 0),
      most_work_(work_of_any_deck + work_of_a_member * list_of_.size()) {
  ascending_.reserve(index_of_label_.size());
  for (const auto& [label, index] : index_of_label_) ascending_.push_back(label);
  std::sort(ascending_.begin(), ascending_.end());
}

int AbaqusResolver::find_number(const AbaqusReference& reference) const {
  const auto it = index_of_label_.find(scoped_number(reference.scope, reference.first));
  return it == index_of_label_.end() ? -1 : it->second;
}

const AbaqusContent::Key* AbaqusResolver::find_set(const AbaqusReference& reference) const {
  const auto* entry = find_abaqus_name(content_, sets_, reference.scope, reference.name).entry;
  return entry == nullptr ? nullptr : &entry->first;
}

void AbaqusResolver::missing(const AbaqusReference& reference) {
  if (reference.name >= 0 &&
      find_abaqus_name(content_, sets_, reference.scope, reference.name).several)
    return source_.error(ErrorCode::duplicate, reference.at,
                         "{} is in several instances: put the name of one and a dot before it",
                         content_.text(reference, word_));
  std::string help;
  if (reference.name >= 0 && sets_.size() <= most_known)
    help = did_you_mean(content_.names[reference.name], abaqus_names_of(content_, sets_));
  source_.error(ErrorCode::not_found, reference.at, "{} does not exist{}",
                content_.text(reference, word_), help);
}

void AbaqusResolver::spend(std::uint64_t count, const FeSource& at) {
  work_ += count;
  if (work_ <= most_work_) return;
  source_.stop(ErrorCode::too_large, at,
               "the sets of {0}s, and what names them, have more than {1} members in all, too many "
               "for a deck of {2} {0}s",
               word_, most_work_, list_of_.size());
}

void AbaqusResolver::add(int index, std::vector<int>& list) {
  int& last = list_of_[index];
  if (last == list_) return;
  last = list_;
  list.push_back(index);
}

void AbaqusResolver::append_range(const AbaqusReference& item, std::vector<int>& list) {
  const std::int64_t first = scoped_number(item.scope, item.first),
                     last = scoped_number(item.scope, item.last);
  auto it = std::lower_bound(ascending_.begin(), ascending_.end(), first);
  long found = 0;
  std::uint64_t looked_at = 0;
  for (; it != ascending_.end() && *it <= last; ++it) {
    ++looked_at;
    if ((*it - first) % item.step != 0) continue;
    ++found;
    add(index_of_label_.at(*it), list);
  }
  spend(looked_at, item.at);
  const long wanted = static_cast<long>((last - first) / item.step) + 1;
  if (found == 0) {
    source_.error(ErrorCode::not_found, item.at, "none of the {}s {} to {} is there", word_,
                  item.first, item.last);
  } else if (found < wanted) {
    if (gaps_ == 0) first_gap_ = item.at;
    gaps_ += wanted - found;
  }
}

void AbaqusResolver::append(const AbaqusReference& item, std::vector<int>& list) {
  if (item.name < 0 && item.first != item.last) return append_range(item, list);
  if (item.name < 0) {
    const int index = find_number(item);
    return index < 0 ? missing(item) : add(index, list);
  }
  const AbaqusContent::Key* const key = find_set(item);
  if (key == nullptr) return missing(item);
  const std::vector<int>& inner = members_[*key].list;
  spend(inner.size(), item.at);
  for (const int index : inner) add(index, list);
}

const std::vector<int>& AbaqusResolver::members(const AbaqusContent::Key& key, int depth) {
  Members& result = members_[key];
  if (result.state == State::done) return result.list;
  const AbaqusSet& set = sets_.at(key);
  if (depth >= deepest_set)
    source_.stop(ErrorCode::too_large, set.at, "sets are nested deeper than {}", deepest_set);
  result.state = State::busy;
  const std::size_t before = source_.errors();
  // A set that is opened again may name itself.
  const auto itself = [&](const AbaqusReference& item) {
    return item.name == key.second && item.scope == key.first;
  };
  // Nested sets come first: then one mark per member is enough for all lists.
  for (const AbaqusReference& item : set.items) {
    const AbaqusContent::Key* const inner =
        item.name < 0 || itself(item) ? nullptr : find_set(item);
    if (inner == nullptr) continue;
    if (members_[*inner].state == State::busy)
      source_.stop(ErrorCode::cycle, item.at, "{} set {} contains itself", word_,
                   shown(content_.names[inner->second]));
    members(*inner, depth + 1);
  }
  ++list_;
  std::vector<int> list;
  for (const AbaqusReference& item : set.items)
    if (!itself(item)) append(item, list);
  if (list.empty() && source_.errors() == before)
    source_.error(ErrorCode::missing, set.at, "{} set {} is empty", word_,
                  shown(content_.names[key.second]));
  result.list = std::move(list);
  result.state = State::done;
  return result.list;
}

std::vector<int> AbaqusResolver::resolve(const AbaqusReference& reference) {
  if (const int index = reference.name < 0 ? find_number(reference) : -1; index >= 0)
    return {index};
  if (const AbaqusContent::Key* const key = reference.name < 0 ? nullptr : find_set(reference)) {
    const std::vector<int>& list = members(*key);
    spend(list.size(), reference.at);
    return list;
  }
  missing(reference);
  return {};
}

int AbaqusResolver::one(const AbaqusReference& reference, std::string_view what) {
  const std::vector<int> found = resolve(reference);
  if (found.size() == 1) return found.front();
  if (!found.empty())
    source_.error(ErrorCode::wrong_count, reference.at, "{}: {} has {} {}s, expected one", what,
                  content_.text(reference, word_), found.size(), word_);
  return -1;
}

}  // namespace floatframe

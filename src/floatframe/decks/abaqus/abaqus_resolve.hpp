#pragma once
// Numbers and names of an Abaqus deck as indices of its nodes and elements.
#include <map>
#include <vector>

#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_content.hpp"

namespace floatframe {

/// What a name means, seen from a scope: there, in the assembly, in the only instance that has it.
template <typename T>
struct AbaqusNamed {
  const std::pair<const AbaqusContent::Key, T>* entry = nullptr;
  bool several = false;  ///< instances have it
};
template <typename T>
AbaqusNamed<T> find_abaqus_name(const AbaqusContent& c, const std::map<AbaqusContent::Key, T>& map,
                                AbaqusScope scope, int name) {
  AbaqusNamed<T> found;
  for (const AbaqusScope s : {scope, AbaqusScope::assembly}) {
    const auto it = map.find({s, name});
    if (it != map.end()) return {&*it, false};
  }
  const auto look = [&](AbaqusScope s) {
    const auto it = map.find({s, name});
    if (it == map.end()) return;
    found.several = found.entry != nullptr;
    found.entry = &*it;
  };
  if (c.instances.empty()) look(AbaqusScope::part);
  for (const auto& [s, instance] : c.instances) {
    look(s);
    if (found.several) return {nullptr, true};
  }
  return found;
}

/// Names of sets or surfaces, to choose from.
template <typename T>
std::vector<std::string> abaqus_names_of(const AbaqusContent& c,
                                         const std::map<AbaqusContent::Key, T>& map) {
  std::vector<std::string> names;
  for (const auto& [key, value] : map) {
    if (names.size() == most_known) break;
    names.push_back(c.names[key.second]);
  }
  return names;
}

/// The name of a set or surface in the model: with that of the instance where others have the same.
template <typename T>
std::string abaqus_model_name(const AbaqusContent& c, const AbaqusContent::Key& key,
                              const std::map<AbaqusContent::Key, T>& map) {
  const std::string& name = c.names[key.second];
  const auto instance = c.instances.find(key.first);
  if (instance == c.instances.end()) return name;
  bool twice = map.contains({AbaqusScope::assembly, key.second});
  for (const auto& [s, other] : c.instances)
    twice = twice || (s != key.first && map.contains({s, key.second}));
  return twice ? instance->second.name + "." + name : name;
}

/// Resolves references to nodes or to elements; what is not there is an error, once. Sets of sets
/// can name the same nodes again and again in a few bytes: the members that are named in all are
/// limited in proportion to the deck.
class AbaqusResolver {
 public:
  enum class Of { nodes, elements };
  AbaqusResolver(const AbaqusContent& content, TextSource& source, Of of);

  /// Indices in the order of the deck, each once.
  std::vector<int> resolve(const AbaqusReference& reference);
  /// The one node of a reference; -1 and an error that begins with `what` if it is not one.
  int one(const AbaqusReference& reference, std::string_view what);
  /// All members of a set; `depth`: of sets that it is in.
  const std::vector<int>& members(const AbaqusContent::Key& key, int depth = 0);
  /// Counts members that are named at a place; throws if there are too many in all.
  void spend(std::uint64_t count, const FeSource& at);
  /// Numbers of GENERATE that are not there: how many, and where the first range stands.
  long gaps() const noexcept { return gaps_; }
  const FeSource& first_gap() const noexcept { return first_gap_; }

 private:
  enum class State { open, busy, done };
  struct Members {
    State state = State::open;
    std::vector<int> list;
  };
  int find_number(const AbaqusReference& reference) const;  ///< -1 if it is not there
  const AbaqusContent::Key* find_set(const AbaqusReference& reference) const;
  void append(const AbaqusReference& item, std::vector<int>& list);
  void append_range(const AbaqusReference& item, std::vector<int>& list);
  void add(int index, std::vector<int>& list);
  void missing(const AbaqusReference& reference);

  const AbaqusContent& content_;
  TextSource& source_;
  const std::map<AbaqusContent::Key, AbaqusSet>& sets_;
  const std::unordered_map<std::int64_t, int>& index_of_label_;
  std::string_view word_;                // "node", "element"
  std::vector<std::int64_t> ascending_;  // labels
  std::map<AbaqusContent::Key, Members> members_;
  std::vector<int> list_of_;  // of each node or element: the last list that got it
  int list_ = 0;              // number of the list that is being made
  std::uint64_t most_work_ = 0, work_ = 0;
  long gaps_ = 0;
  FeSource first_gap_;
};

}  // namespace floatframe

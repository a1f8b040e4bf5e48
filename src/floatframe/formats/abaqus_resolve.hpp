#pragma once
// Numbers and names of an Abaqus deck as indices of its nodes and elements.
#include <map>
#include <span>
#include <vector>

#include "floatframe/formats/abaqus_content.hpp"

namespace floatframe {

/// Resolves references to nodes or to elements; what is not there is a fault, once.
class AbaqusResolver {
 public:
  enum class Of { nodes, elements };
  AbaqusResolver(const AbaqusContent& content, TextSource& source, Of of);

  /// Indices in the order of the deck, each once.
  std::vector<int> resolve(const AbaqusReference& reference);
  /// The one node of a reference; -1 and a fault that begins with `what` if it is not one.
  int one(const AbaqusReference& reference, std::string_view what);
  /// All members of a set.
  const std::vector<int>& members(const AbaqusContent::Key& key);
  /// Numbers of GENERATE that are not there: how many, and where the first range stands.
  long gaps() const noexcept { return gaps_; }
  const FeSource& first_gap() const noexcept { return first_gap_; }

 private:
  enum class State { open, busy, done };
  struct Members {
    State state = State::open;
    std::vector<int> list;
  };
  const AbaqusContent::Key* find_set(const AbaqusReference& reference) const;
  void append(const AbaqusReference& item, std::vector<int>& list, std::vector<char>& seen);
  void append_range(const AbaqusReference& item, std::vector<int>& list, std::vector<char>& seen);
  const std::vector<int>& members(const AbaqusContent::Key& key, int depth);
  void add(int index, std::vector<int>& list, std::vector<char>& seen) const;
  void missing(const AbaqusReference& reference);

  const AbaqusContent& content_;
  TextSource& source_;
  const std::map<AbaqusContent::Key, AbaqusSet>& sets_;
  const std::unordered_map<std::int64_t, int>& index_of_label_;
  std::string_view word_;                // "node", "element"
  std::size_t count_ = 0;                // nodes or elements in the deck
  std::vector<std::int64_t> ascending_;  // labels
  std::map<AbaqusContent::Key, Members> members_;
  int depth_ = 0;
  std::uint64_t work_ = 0;
  long gaps_ = 0;
  FeSource first_gap_;
};

}  // namespace floatframe

#pragma once
// Words of a static text; '*' matches any end.
#include <algorithm>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

class WordList {
 public:
  explicit WordList(std::string_view text) {
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text))
      if (word.ends_with('*'))
        beginnings_.push_back(word.substr(0, word.size() - 1));
      else
        words_.insert(word);
  }
  bool contains(std::string_view name) const {
    return words_.contains(name) ||
           std::any_of(beginnings_.begin(), beginnings_.end(),
                       [name](std::string_view word) { return name.starts_with(word); });
  }

 private:
  std::unordered_set<std::string_view> words_;
  std::vector<std::string_view> beginnings_;
};

}  // namespace floatframe

#pragma once
// Cards that repeat the card before: '=' in a field takes over that field, '==' it and all after
// it, '*x' or '*(x)' adds x to it; '=' in field 1 takes over the name, '=n' or '=(n)' there makes n
// more cards, each with the same additions again.
#include <string>
#include <utility>
#include <vector>

#include "floatframe/formats/nastran/nastran_card.hpp"

namespace floatframe {

class NastranReplication {
 public:
  explicit NastranReplication(TextSource& source) : source_(source) {}

  /// The next card of '=n'; false if none is left.
  bool next(NastranCard& card, const NastranCard& before);
  /// Makes a card whole that takes something over. False if it stands for no card: '=n'.
  bool complete(NastranCard& card, const NastranCard& before);

 private:
  bool repeat(const NastranCard& card, const NastranCard& before);
  std::string increased(const NastranCard& card, const NastranCard& before, std::size_t i);
  /// The fields are of this object until the card after the next.
  void give(std::vector<std::string> fields, NastranCard& card);

  TextSource& source_;
  std::vector<std::string> now_, before_;
  std::vector<std::pair<std::size_t, std::string>> steps_;  // of the last card that took over
  FeSource made_;                                           // where that card is
  FeSource at_;                                             // of '=n'
  int left_ = 0;
  std::size_t repeated_ = 0;
};

}  // namespace floatframe

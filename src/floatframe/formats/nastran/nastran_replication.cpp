#include "floatframe/formats/nastran/nastran_replication.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_repeated = 1'000'000;

/// '*x', '*(x)' without the sign and the parentheses.
std::string_view inside(std::string_view text) {
  text = trimmed(text.substr(1));
  if (text.size() >= 2 && text.front() == '(' && text.back() == ')')
    text = trimmed(text.substr(1, text.size() - 2));
  return text;
}

bool takes_over(std::string_view field) {
  return !field.empty() && (field[0] == '=' || field[0] == '*' || field[0] == '%');
}

bool same_place(const FeSource& a, const FeSource& b) {
  return a.file == b.file && a.line == b.line;
}

}  // namespace

/// Whole numbers stay whole.
std::string NastranReplication::increased(const NastranCard& card, const NastranCard& before,
                                          std::size_t i) {
  const std::string_view old = before.field(i), step = inside(card.field(i));
  if (card.field(i)[0] == '*') {
    const auto whole = parse_integer(old), by = parse_integer(step);
    if (whole && by) return std::to_string(static_cast<long long>(*whole) + *by);
    const auto from = parse_real(old), real = parse_real(step);
    if (from && real && std::isfinite(*from + *real)) {
      const std::string sum = fmt::format("{}", *from + *real);
      return sum.find_first_of(".e") == std::string::npos ? sum + "." : sum;
    }
  }
  source_.error(card.place(i),
                fmt::format("field {} is {} and that of the card before {}; '=', '==', and '*' "
                            "with a number to add to a number are read",
                            i % 8 + 2, shown(card.field(i)), shown(old)));
  return std::string(old);
}

void NastranReplication::give(std::vector<std::string> fields, NastranCard& card) {
  before_ = std::move(now_);
  now_ = std::move(fields);
  card.fields.assign(now_.begin(), now_.end());
}

bool NastranReplication::next(NastranCard& card, const NastranCard& before) {
  if (left_ == 0) return false;
  --left_;
  card = before;
  std::vector<std::string> fields(before.fields.begin(), before.fields.end());
  for (const auto& [i, step] : steps_) {
    card.fields[i] = step;
    fields[i] = increased(card, before, i);
  }
  card.at = at_;
  card.continuations.clear();
  give(std::move(fields), card);
  made_ = at_;
  return true;
}

/// '=n' or '=(n)' in field 1.
bool NastranReplication::repeat(const NastranCard& card, const NastranCard& before) {
  const auto number = parse_label(inside(card.name));
  if (!number || !card.fields.empty() || !same_place(before.at, made_)) {
    source_.stop(card.at,
                 fmt::format("found {} in field 1, expected '=' and the fields of a card, or after "
                             "such a card '=n', how many more there are",
                             shown(card.name)));
  }
  repeated_ += static_cast<std::size_t>(*number);
  if (repeated_ > most_repeated) {
    source_.stop(card.at,
                 fmt::format("more than {} cards are repeated by '=n'; write the deck with its "
                             "cards",
                             most_repeated));
  }
  source_.make(*number);
  left_ = *number;
  at_ = card.at;
  return false;
}

bool NastranReplication::complete(NastranCard& card, const NastranCard& before) {
  if (card.name[0] == '=' && card.name != "=") return repeat(card, before);
  // Equations and titles have these signs in their text.
  const bool own = card.name != "=";
  if (own && (card.name != before.name || card.name == "DEQATN" ||
              std::none_of(card.fields.begin(), card.fields.end(), takes_over)))
    return true;
  if (before.name.empty()) {
    source_.stop(card.at, "found '=' in field 1, but there is no card before to repeat");
  }
  steps_.clear();
  std::vector<std::string> fields;
  for (std::size_t i = 0; i < card.fields.size(); ++i) {
    const std::string_view field = card.field(i);
    if (field == "==") {
      for (; i < before.fields.size(); ++i) fields.emplace_back(before.field(i));
      break;
    }
    if (field == "=") {
      fields.emplace_back(before.field(i));
    } else if (takes_over(field)) {
      steps_.emplace_back(i, field);
      fields.push_back(increased(card, before, i));
    } else {
      fields.emplace_back(field);
    }
  }
  card.name = before.name;
  made_ = card.at;
  give(std::move(fields), card);
  return true;
}

}  // namespace floatframe

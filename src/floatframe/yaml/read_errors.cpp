#include "floatframe/yaml/read_errors.hpp"

#include <algorithm>
#include <functional>

#include "floatframe/core/ascii.hpp"
#include "floatframe/core/printable.hpp"

namespace floatframe {
namespace {

constexpr std::size_t longest_message = 2000;

std::uint64_t hash(std::string_view text) { return std::hash<std::string_view>{}(text); }

/// Removes a suggestion, since suggestions are limited: the sentence is otherwise the same.
std::string_view without_suggestion(std::string_view message) {
  return message.substr(0, message.find(", did you mean '"));
}

/// The sentence without its path, names, expressions and numbers.
std::string skeleton(std::string_view message) {
  const std::size_t path = message.find(": ");
  std::string out;
  for (std::size_t k = path == std::string::npos ? 0 : path + 2; k < message.size(); ++k) {
    const char c = message[k];
    if (c == '\'' || (c == '$' && k + 1 < message.size() && message[k + 1] == '{')) {
      k = std::min(message.find(c == '\'' ? '\'' : '}', k + 1), message.size());
      out += c;
    } else if (!is_digit(c)) {
      out += c;
    }
  }
  return out;
}

ErrorEntry more(ErrorCode code, const SourceMark& first, std::size_t n, const char* what) {
  return {first, code, "... and " + std::to_string(n) + " more of " + what, n};
}

}  // namespace

void ReadErrors::add(ErrorEntry entry) {
  ++added_;
  const std::string_view sentence = without_suggestion(entry.message);
  if (!seen_.insert(hash(entry.mark.before(std::string(sentence)))).second) return;
  Kind* kind = &others_;
  const std::uint64_t key = hash(skeleton(sentence));
  if (const auto it = kinds_.find(key); it != kinds_.end())
    kind = &it->second;
  else if (kinds_.size() < limits::errors)
    kind = &kinds_[key];
  if (kind != &others_ && kind->kept < limits::errors_of_a_kind &&
      errors_.size() < limits::errors) {
    ++kind->kept;
    std::string text = printable(entry.message);
    if (text.size() > longest_message) {
      std::size_t end = longest_message;
      while ((static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;
      text.resize(end);
      text += " ...";
    }
    entry.message = std::move(text);
    entry.path = printable(entry.path.substr(0, longest_message));
    errors_.push_back(std::move(entry));
    return;
  }
  if (kind->kept == 0) kind = &others_;  // of a kind not shown
  if (kind->omitted == 0) kind->first = entry.mark, kind->code = entry.code;
  kind->omitted += entry.count;
}

std::vector<ErrorEntry> ReadErrors::take() {
  for (const auto& [key, kind] : kinds_)
    if (kind.omitted > 0) errors_.push_back(more(kind.code, kind.first, kind.omitted, "this kind"));
  if (others_.omitted > 0)
    errors_.push_back(more(others_.code, others_.first, others_.omitted, "other kinds"));
  return std::move(errors_);
}

bool ReadErrors::take_of(const char* what, std::size_t amount, std::size_t most,
                         const SourceMark& mark, const std::string& path) {
  std::size_t& taken = taken_[what];
  const bool before = taken <= most;
  taken = amount > most - std::min(taken, most) ? most + 1 : taken + amount;
  if (taken <= most) return true;
  exhausted_ = true;
  if (before)
    add(ErrorCode::too_large, mark,
        (path.empty() ? "" : path + ": ") + "found more than " + std::to_string(most) + " " + what +
            ", expected fewer");
  return false;
}

}  // namespace floatframe

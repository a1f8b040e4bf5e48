#include "floatframe/formats/nastran/nastran_cards.hpp"

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_commands = 1000;

/// BEGIN, BEGIN BULK, BEGIN SUPER=3, ...
bool is_begin(std::string_view line) { return same_word(next_word(line), "BEGIN"); }

/// BEGIN BULK (or BEGIN alone) of the model itself, not of a superelement or of an auxiliary model.
bool is_begin_bulk(std::string_view line) {
  if (!same_word(next_word(line), "BEGIN")) return false;
  const std::string_view second = next_word(line);
  return second.empty() || (same_word(second, "BULK") && trimmed(line).empty());
}

constexpr const char* one_model =
    "{} begins the bulk data of a superelement or of another model, which is not read: write one "
    "model with one BEGIN BULK";

/// Continuation marks are compared without the sign that begins them, or without the first
/// character whatever it is: the column of the sign does not count.
bool same_mark(std::string_view a, std::string_view b) {
  const auto without_sign = [](std::string_view mark) {
    return !mark.empty() && (mark[0] == '+' || mark[0] == '*') ? mark.substr(1) : mark;
  };
  const std::string_view x = without_sign(a), y = without_sign(b);
  return x.empty() || y.empty() || same_word(x, y) || same_word(a.substr(1), b.substr(1));
}

bool is_continuation(std::string_view name) {
  return name.empty() || name[0] == '+' || name[0] == '*';
}

}  // namespace

std::string_view card_name(std::string_view line) noexcept {
  return line.substr(0, std::min(line.find_first_of(", *\t"), line.size()));
}

bool has_begin_bulk(std::string_view beginning) {
  while (!beginning.empty()) {
    const std::string_view line = next_line(beginning);
    if (is_begin(line.substr(0, line.find('$')))) return true;
  }
  return false;
}

NastranCards::NastranCards(TextSource& source, bool has_control, NastranBegin begin)
    : source_(source), begin_(begin), begun_(has_control) {
  if (has_control) read_control();
}

bool NastranCards::begins(std::string_view line) const {
  return begin_ == NastranBegin::any ? is_begin(line) : is_begin_bulk(line);
}

void NastranCards::read_control() {
  bool executive = true;  // before CEND: solution sequences and changes of them, which are not read
  std::string_view line;
  while (source_.next(line)) {
    line = trimmed(line.substr(0, line.find('$')));
    if (begins(line)) return;
    if (is_begin(line))
      source_.stop(ErrorCode::unsupported, source_.here(), fmt::format(one_model, shown(line)));
    std::string_view rest = line;
    const std::string_view word = next_word(rest);
    control_.there = control_.there || !(word.empty() || same_word(word, "INCLUDE"));
    if (same_word(word, "INCLUDE"))
      include(line, executive);
    else if (same_word(word, "CEND"))
      executive = false;
    else
      command(line);
  }
}

void NastranCards::command(std::string_view line) {
  const std::size_t end = std::min(line.find_first_of("=(, \t"), line.size());
  const std::string_view word = line.substr(0, end);
  // Alters of the executive control have lines PARAM // that are something else.
  if (same_word(word, "PARAM") && trimmed(line.substr(end)).starts_with(',') &&
      cards_of_control_.size() < most_commands) {
    NastranCard card;
    card.name = "PARAM";
    split_commas(line, card.fields);
    card.fields.erase(card.fields.begin());
    card.at = source_.here();
    cards_of_control_.push_back(std::move(card));
    return;
  }
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return;
  const std::string_view value = trimmed(line.substr(equals + 1));
  const auto id = parse_label(value);
  for (const auto& [known, sets] : {std::pair{"MPC", &control_.mpc}, {"SPC", &control_.spc}}) {
    if (!same_word(word, known)) continue;
    if (id && sets->size() < most_commands) sets->emplace_back(*id, source_.here());
    return;
  }
  if (same_word(word.substr(0, word.find('(')), "STATSUB")) control_.preload = source_.here();
  for (const char* known : {"K2GG", "M2GG", "K2PP", "M2PP", "A2GG", "NSM", "MFLUID"}) {
    if (!same_word(word, known) || same_word(value, "NONE")) continue;
    if (control_.additions.size() < most_commands)
      control_.additions.emplace_back(fmt::format("{} = {}", known, value.substr(0, 40)),
                                      source_.here());
  }
}

/// The next line that is neither blank nor a comment, without the comment at its end.
bool NastranCards::next_text(std::string_view& text) {
  while (source_.next(text)) {
    const std::size_t dollar = text.find('$');
    if (dollar != std::string_view::npos) {
      comment(text.substr(dollar + 1));
      text = text.substr(0, dollar);
    }
    if (!trimmed(text).empty()) return true;
  }
  return false;
}

/// "$HMNAME PROP 3"bracket" 4" and "$HMSET 5 1 "bores"" (HyperMesh), "$ FEMAP Property 3 :
/// bracket".
void NastranCards::comment(std::string_view text) {
  std::string_view rest = text;
  const std::string_view first = next_word(rest);
  const bool set = same_word(first, "HMSET"), hypermesh = set || same_word(first, "HMNAME");
  if (!hypermesh && !same_word(first, "FEMAP")) return;
  const std::string_view kind = set ? "SET" : next_word(rest);
  std::map<int, std::string>* const names = set                         ? &names_.sets
                                            : begins_with(kind, "PROP") ? &names_.properties
                                            : begins_with(kind, "MAT")  ? &names_.materials
                                                                        : nullptr;
  const std::size_t open = rest.find(hypermesh ? '"' : ':');
  if (names == nullptr || open == std::string_view::npos) return;
  std::string_view before = rest.substr(0, open), name = rest.substr(open + 1);
  const auto number = parse_label(next_word(before));
  if (hypermesh) name = name.substr(0, name.find('"'));
  name = trimmed(name);
  if (number && !name.empty()) names->try_emplace(*number, name);
}

void NastranCards::split(std::string_view text, Line& line) {
  line.data.clear();
  line.mark = {};
  if (text.find(',') < 72) {  // a comment in the tenth field may contain a comma
    std::vector<std::string_view> fields;
    split_commas(text, fields);
    line.name = fields[0];
    line.large = line.name.ends_with('*') || line.name.starts_with('*');
    const std::size_t width = line.large ? 4 : 8;
    while (fields.size() > width + 2 && fields.back().empty()) fields.pop_back();
    // A line that was put back is returned again.
    if (fields.size() > width + 2 &&
        std::exchange(too_long_, source_.here().line) != source_.here().line)
      source_.error(ErrorCode::wrong_count,
                    "the line has {} fields; a line in free field has at most {}", fields.size(),
                    width + 2);
    for (std::size_t i = 1; i <= width; ++i)
      line.data.push_back(i < fields.size() ? fields[i] : std::string_view{});
    if (fields.size() > width + 1) line.mark = fields[width + 1];
    return;
  }
  if (text.find('\t') != std::string_view::npos) {
    std::string wide;  // up to the last column that counts
    for (const char c : text) {
      if (wide.size() >= 80) break;
      wide.append(c == '\t' ? 8 - wide.size() % 8 : 1, c == '\t' ? ' ' : c);
    }
    text = expanded_.emplace_back(std::move(wide));
  }
  const auto columns = [text](std::size_t from, std::size_t width) {
    return from < text.size() ? trimmed(text.substr(from, width)) : std::string_view{};
  };
  line.name = columns(0, 8);
  line.large = line.name.ends_with('*') || line.name.starts_with('*');
  const std::size_t width = line.large ? 16 : 8;
  for (std::size_t from = 8; from < 72; from += width) line.data.push_back(columns(from, width));
  line.mark = columns(72, 8);
}

/// INCLUDE 'file', also over several lines.
void NastranCards::include(std::string_view text, bool executive) {
  const FeSource at = source_.here();
  std::string path(trimmed(trimmed(text).substr(7)));
  const char quote = !path.empty() && (path[0] == '\'' || path[0] == '"') ? path[0] : '\0';
  std::string_view line;
  while (quote != '\0' && path.find(quote, 1) == std::string::npos) {
    if (path.size() > 4096 || !source_.next(line))
      source_.stop(ErrorCode::missing, at, "the name of the included file has no closing quote");
    path += trimmed(line);
  }
  if (quote != '\0') path = path.substr(1, path.find(quote, 1) - 1);
  if (!executive) return source_.include(path, at);
  if (!source_.include_if_there(path, at)) control_.missing_includes.push_back(path);
}

bool NastranCards::next(NastranCard& card) {
  if (!cards_of_control_.empty()) {
    card = std::move(cards_of_control_.front());
    cards_of_control_.pop_front();
    return true;
  }
  expanded_.clear();
  std::string_view text;
  for (bool found = false; !found;) {
    if (!next_text(text)) return false;
    if (begins_with(trimmed(text), "INCLUDE") && text.find(',') == std::string_view::npos)
      include(text, false);
    else if (!is_begin(text))
      found = true;
    else if (!begins(trimmed(text)) || std::exchange(begun_, true))
      source_.stop(ErrorCode::unsupported, source_.here(),
                   fmt::format(one_model, shown(trimmed(text))));
  }
  ended_ = begins_with(text, "ENDDATA");
  if (ended_) return false;
  Line line;
  split(text, line);
  if (is_continuation(line.name))
    source_.stop(ErrorCode::wrong_value, source_.here(), "found a continuation {}, expected a card",
                 shown(line.name));
  if (line.name.ends_with('*')) line.name.remove_suffix(1);
  card.name = upper_case(trimmed(line.name));
  card.fields = line.data;
  card.continuations.clear();
  card.at = source_.here();
  std::string_view mark = line.mark;
  while (next_text(text)) {
    const bool include = begins_with(trimmed(text), "INCLUDE");
    if (!include) split(text, line);
    if (include || !is_continuation(line.name)) {
      source_.put_back();
      break;
    }
    if (!same_mark(mark, line.name))
      source_.error(ErrorCode::incomplete,
                    "the continuation {} does not follow the card with this mark; the card before "
                    "({} in line {}) has {}",
                    shown(line.name), card.name, card.at.line, shown(mark));
    const std::size_t width = line.large ? 4 : 8;
    while (card.fields.size() % width != 0) card.fields.emplace_back();
    card.continuations.emplace_back(card.fields.size(), source_.here());
    card.fields.insert(card.fields.end(), line.data.begin(), line.data.end());
    mark = line.mark;
  }
  while (!card.fields.empty() && card.fields.back().empty()) card.fields.pop_back();
  const auto repeats = [](std::string_view field) { return field == "=" || field == "=="; };
  if (card.name.starts_with('=') ||
      (card.name != "DEQATN" && std::any_of(card.fields.begin(), card.fields.end(), repeats)))
    source_.stop(ErrorCode::unsupported, card.at,
                 "a field is '=', which repeats one of the card before and is not read: write the "
                 "cards out, as Nastran does with ECHO = PUNCH");
  return true;
}

}  // namespace floatframe

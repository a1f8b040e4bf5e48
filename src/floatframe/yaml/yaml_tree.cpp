#include "floatframe/yaml/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <array>
#include <cstdint>
#include <map>
#include <sstream>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/yaml/expression.hpp"

namespace floatframe {
namespace {

constexpr int deepest_nesting = 50;
constexpr int most_open_brackets =
    1000;  // the parser reads a whole line before it reports anything
constexpr std::uint64_t largest_file = 16u << 20u;

// Inside `${...}` the characters that would end a plain scalar in a flow list or map are replaced
// by control characters (which the text cannot contain) for the YAML parser, so that `[0, ${a},
// ${min(b, c)}]` needs no quotes.
constexpr std::array<std::pair<char, char>, 8> hidden{{{'{', '\x01'},
                                                       {'}', '\x02'},
                                                       {',', '\x03'},
                                                       {'[', '\x04'},
                                                       {']', '\x05'},
                                                       {'#', '\x06'},
                                                       {':', '\x07'},
                                                       {'?', '\x08'}}};

std::string too_deep() {
  return "lists and maps are nested too deeply, at most " + std::to_string(deepest_nesting) +
         " levels are allowed";
}

void hide_expressions(std::string& text) {
  for (std::size_t at = text.find("${"); at != std::string::npos; at = text.find("${", at + 1)) {
    const std::size_t end = text.find_first_of("}\n", at);
    if (end == std::string::npos) return;
    if (text[end] == '\n') {  // none is closed on this line
      at = end;
      continue;
    }
    for (std::size_t k = at + 1; k <= end; ++k)
      for (const auto& [plain, substitute] : hidden)
        if (text[k] == plain) text[k] = substitute;
  }
}

std::string revealed(std::string text) {
  bool inside = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    inside = inside || (k > 0 && text[k - 1] == '$' && text[k] == hidden[0].second);
    if (!inside) continue;  // a control character that was written as \x01
    for (const auto& [plain, substitute] : hidden)
      if (text[k] == substitute) text[k] = plain;
    inside = text[k] != '}';
  }
  return text;
}

struct ParseAborted {};

class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& file, YamlNode& root, ReadErrors& errors)
      : file_(file), root_(root), errors_(errors) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse(mark, "", anchor);
    value(node_at(mark), false);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    error(ErrorCode::wrong_value, mark, "aliases (*name) are not allowed, use parameters");
    value(node_at(mark), false);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse(mark, tag, anchor);
    YamlNode n = node_at(mark);
    n.kind = YamlNode::Kind::scalar;
    n.text = revealed(value);
    n.quoted = tag == "!";
    n.refused = !check_characters(mark, n.text);
    last_ = n.quoted ? mark : YAML::Mark::null_mark();
    this->value(std::move(n), false);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlNode::Kind::sequence);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlNode::Kind::map);
  }
  void OnMapEnd() override { close(); }
  bool empty() const { return !seen_; }
  /// Location of the last scalar, if it is in quotes.
  const YAML::Mark& last_quoted() const { return last_; }
  std::size_t values() const { return values_; }

 private:
  struct Level {
    YamlNode node;
    bool has_key = false;
    bool skip = false;  // the value belongs to a rejected key
    YamlEntry entry;
    std::map<std::string, int> keys;  // key -> line
  };

  void error(ErrorCode code, const YAML::Mark& mark, std::string message) {
    errors_.add(code, {file_, mark.line + 1, mark.column + 1}, std::move(message));
  }
  /// The next value of the file.
  YamlNode node_at(const YAML::Mark& mark) {
    if (++values_ > limits::file_values) {
      error(ErrorCode::too_large, mark,
            "found more than " + std::to_string(limits::file_values) +
                " values in one file, expected fewer (tables may stand in CSV files)");
      throw ParseAborted{};
    }
    YamlNode n;
    n.line = mark.line + 1;
    n.column = mark.column + 1;
    return n;
  }
  bool check_characters(const YAML::Mark& mark, std::string& text) {
    if (text.size() > longest_text) {
      error(ErrorCode::out_of_range, mark,
            "found a text of " + std::to_string(text.size()) + " characters, expected at most " +
                std::to_string(longest_text));
      text.resize(100);
      while (!text.empty() && utf8_length(text, text.size() - 1) == 0) text.pop_back();
      return false;
    }
    for (std::size_t k = 0; k < text.size(); ++k)
      if (is_control(text, k) && text[k] != '\n' && text[k] != '\t') {
        error(ErrorCode::wrong_value, mark,
              "found the text '" + printable(text.substr(0, 40)) +
                  "', expected no control characters");
        return false;
      }
    return true;
  }
  void refuse(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != 0)
      error(ErrorCode::wrong_value, mark, "anchors (&name) are not allowed, use parameters");
    if (!tag.empty() && tag != "?" && tag != "!")
      error(ErrorCode::wrong_value, mark, "tags (!name) are not allowed");
  }
  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            YamlNode::Kind kind) {
    refuse(mark, tag, anchor);
    YamlNode n = node_at(mark);
    n.kind = kind;
    if (stack_.size() >= static_cast<std::size_t>(deepest_nesting)) {
      error(ErrorCode::too_large, mark, too_deep());
      throw ParseAborted{};
    }
    stack_.emplace_back().node = std::move(n);
  }
  void close() {
    YamlNode n = std::move(stack_.back().node);
    stack_.pop_back();
    value(std::move(n), true);
  }

  void value(YamlNode n, bool compound) {
    if (stack_.empty()) {
      root_ = std::move(n);
      seen_ = true;
      return;
    }
    Level& top = stack_.back();
    if (top.node.kind == YamlNode::Kind::sequence) {
      top.node.items.push_back(std::move(n));
      return;
    }
    if (top.has_key) {
      top.entry.value = std::move(n);
      if (top.entry.value.line == 0) {
        top.entry.value.line = top.entry.line;
        top.entry.value.column = top.entry.column;
      }
      if (!top.skip) top.node.entries.push_back(std::move(top.entry));
      top.has_key = false;
      return;
    }
    top.has_key = true;
    top.skip = false;
    top.entry = YamlEntry{n.text, n.line, n.column, {}};
    const auto skip = [&](ErrorCode code, const std::string& sentence) {
      errors_.add(code, {file_, n.line, n.column}, sentence);
      top.skip = true;
    };
    if (compound || n.kind != YamlNode::Kind::scalar)
      skip(ErrorCode::wrong_value, "a key must be a name");
    else if (n.text == "<<" && !n.quoted)
      skip(ErrorCode::wrong_value, "merge keys (<<) are not allowed, use parameters or subsystems");
    else if (const auto [it, fresh] = top.keys.emplace(n.text, n.line); !fresh)
      skip(ErrorCode::duplicate,
           "duplicate key '" + n.text + "', first used in line " + std::to_string(it->second));
  }

  const std::string& file_;
  YamlNode& root_;
  ReadErrors& errors_;
  std::vector<Level> stack_;
  std::size_t values_ = 0;
  bool seen_ = false;
  YAML::Mark last_ = YAML::Mark::null_mark();
};

/// Rejects binary data, line ends that YAML does not have and tabs in the indentation.
bool check_text(const std::string& file, const std::string& text, ReadErrors& errors) {
  int line = 1;
  std::size_t start = 0;
  bool indentation = true;
  int brackets = 0;
  SourceMark deep;  // location of excessive nesting
  for (std::size_t k = 0; k < text.size();) {
    const char c = text[k];
    const std::size_t n = utf8_length(text, k);
    const auto mark = [&] { return SourceMark{file, line, static_cast<int>(k - start) + 1}; };
    const auto u = static_cast<unsigned char>(c);
    if (n == 0 || u == 0x7F || (u < 0x20 && c != '\n' && c != '\r' && c != '\t')) {
      errors.add(ErrorCode::wrong_file, mark(),
                 text.starts_with("PK\3\4")
                     ? "found a zip archive, as FMUs are, expected a text file"
                     : "this is not a text file (UTF-8)");
      return false;
    }
    if (c == '\r' && k + 1 < text.size() && text[k + 1] != '\n') {
      errors.add(ErrorCode::wrong_file, mark(),
                 "a carriage return without a line feed, expected lines that end with LF or CRLF");
      return false;
    }
    if ((c == '[' || c == '{') && ++brackets == deepest_nesting) deep = mark();
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (brackets > most_open_brackets) {
      errors.add(ErrorCode::too_large, deep, too_deep());
      return false;
    }
    if (c == '\t' && indentation) {
      const std::size_t next = text.find_first_not_of(" \t\r", k);
      if (next != std::string::npos && text[next] != '\n' && text[next] != '#') {
        errors.add(ErrorCode::wrong_file, mark(), "a tab in the indentation, use spaces");
        return false;
      }
      indentation = false;  // the line is blank
    }
    if (c == '\n') {
      ++line;
      start = k + 1;
      indentation = true;
    } else if (c != ' ' && c != '\t') {
      indentation = false;
    }
    k += n;
  }
  return true;
}

/// The parser would take the end of the file for the closing quote.
bool is_closed(const std::string& text, const YAML::Mark& begin) {
  std::size_t at = 0;
  for (int line = 0; line < begin.line; ++line) at = text.find('\n', at) + 1;
  at += begin.column;
  if (at >= text.size() || (text[at] != '"' && text[at] != '\'')) return true;  // a block
  const char quote = text[at];
  for (++at; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (text[at] == quote) {
      if (quote == '"' || at + 1 == text.size() || text[at + 1] != quote) return true;
      ++at;
    }
  }
  return false;
}

thread_local std::map<std::string, std::string>* files_read = nullptr;

}  // namespace

YamlDocument parse_yaml(const std::string& file, const std::string& original, ReadErrors& errors) {
  YamlDocument document{file, {}, 0};
  std::string text = original;
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
  if (!check_text(file, text, errors)) return document;
  hide_expressions(text);
  std::istringstream stream(text);
  TreeBuilder builder(file, document.root, errors);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder) || builder.empty()) {
      errors.add(ErrorCode::missing, {file, 1, 1}, "the file is empty");
      return document;
    }
    document.values = builder.values();
    if (const YAML::Mark& last = builder.last_quoted(); !last.is_null() && !is_closed(text, last)) {
      errors.add(ErrorCode::wrong_file, {file, last.line + 1, last.column + 1},
                 "the text in quotes that begins here is not closed");
      return YamlDocument{file, {}, 0};
    }
    YamlNode second;
    ReadErrors ignored;
    TreeBuilder more(file, second, ignored);
    if (parser.HandleNextDocument(more))
      errors.add(ErrorCode::duplicate,
                 {file, second.line > 0 ? second.line : 1, second.column > 0 ? second.column : 1},
                 "a second document starts here, a model file holds one");
  } catch (const ParseAborted&) {
  } catch (const YAML::Exception& e) {
    SourceMark mark{file, e.mark.line + 1, e.mark.column + 1};
    if (e.mark.is_null()) mark.line = mark.column = 1;
    const bool open = e.msg == "illegal EOF in scalar";
    errors.add(ErrorCode::wrong_file, mark,
               open ? "a text in quotes is not closed" : "YAML syntax: " + revealed(e.msg));
  } catch (const std::exception& e) {  // the recursion limit of the parser
    errors.add(ErrorCode::wrong_file, {file, 1, 1}, std::string("YAML syntax: ") + e.what());
  }
  return document;
}

bool read_text_file(const std::string& file, std::string& text, ErrorList& errors,
                    const SourceMark& where, const std::string& subject) {
  const std::string why = read_regular_file(file, largest_file, text);
  if (why.empty()) {
    note_file_read(file, content_hash(text));
    return true;
  }
  if (where.file.empty())
    errors.add(ErrorCode::unreadable, {file, 0, 0}, why);
  else
    errors.add(ErrorCode::unreadable, where, subject + ": '" + file + "': " + why);
  return false;
}

bool read_text_file(const std::string& file, std::string& text, ReadErrors& errors,
                    const SourceMark& where, const std::string& subject) {
  ErrorList found;
  const bool good = read_text_file(file, text, found, where, subject);
  for (ErrorEntry& entry : found.take()) errors.add(std::move(entry));
  return good;
}

void note_file_read(const std::string& file, const std::string& hash) {
  if (files_read) files_read->insert_or_assign(file, hash);
}

FilesRead::FilesRead(std::map<std::string, std::string>& hashes) : before_(files_read) {
  files_read = &hashes;
}

FilesRead::~FilesRead() { files_read = before_; }

}  // namespace floatframe

// The grammar of SID_FEM, one item a line:
//   <nodes> <modes> : comment
//   part / new modal / refmod .. end refmod / frame { new node .. end node } end frame / blocks /
//   end modal / end part
// A block is "name", order, nrow, ncol, nq, nqn, structure, entries m0(r,c) and m1(r,q,c), "end
// name". Blanks do not matter. Memory is taken for the sizes that the number of modes implies,
// never for what a block claims.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "floatframe/formats/sid_content.hpp"
#include "floatframe/formats/text_fields.hpp"
#include "floatframe/formats/text_source.hpp"

namespace floatframe {
namespace {

constexpr int most_modes = 500;

/// A line as "key = value"; the key without blanks.
struct Item {
  std::string key;
  std::string_view value;
  bool has_value = false;
};

/// Entry m0(row,column) or m1(row,mode,column), counted from 0.
struct Entry {
  int order = 0, row = 0, mode = 0, column = 0;
};

class SidParser {
 public:
  SidParser(std::string_view text, const std::string& name)
      : source_(std::string(text), name), name_(name) {}

  SidContent parse() {
    first_line();
    expect("part");
    expect("newmodal");
    while (true) {
      const Item item = next("'end modal'");
      if (item.key == "endmodal") break;
      if (item.key == "refmod") {
        refmod();
      } else if (item.key == "frame") {
        frames();
      } else if (SidTaylor* block = modal_block(item.key)) {
        if (block->line > 0) {
          source_.fault(fmt::format("block {} is in the file twice, first in line {}", item.key,
                                    block->line));
        }
        read_block(item.key, *block);
      } else {
        source_.fault(fmt::format(
            "unknown block {} (expected refmod, frame, mdCM, J, Ct, Cr, Me, Gr, Ge, Oe, ksigma, Ke "
            "or De)",
            shown(item.key)));
        skip(item.key);
      }
    }
    expect("endpart");
    check_complete();
    source_.throw_if_any();
    return std::move(content_);
  }

 private:
  [[noreturn]] void stop(std::string message) { source_.stop(source_.here(), std::move(message)); }

  Item next(const char* wanted) {
    std::string_view text;
    while (source_.next(text)) {
      text = trimmed(text);
      if (!text.empty()) break;
    }
    if (text.empty()) stop(fmt::format("the file ends where {} was expected", wanted));
    Item item;
    const std::size_t equals = text.find('=');
    item.has_value = equals != std::string_view::npos;
    for (const char c : text.substr(0, equals)) {
      if (c != ' ' && c != '\t') item.key += c;
    }
    if (item.has_value) item.value = trimmed(text.substr(equals + 1));
    return item;
  }

  void expect(const char* key) {
    const std::string words = key == std::string_view("newmodal")  ? "new modal"
                              : key == std::string_view("endpart") ? "end part"
                                                                   : key;
    const Item item = next(fmt::format("'{}'", words).c_str());
    if (item.key != key) stop(fmt::format("found {}, expected '{}'", shown(item.key), words));
  }

  void first_line() {
    std::string_view text;
    if (!source_.next(text)) stop("the file is empty");
    const std::string_view numbers = text.substr(0, text.find(':'));
    std::vector<std::string_view> fields;
    split_blanks(numbers, fields);
    const auto nodes = fields.size() == 2 ? parse_integer(fields[0]) : std::nullopt;
    const auto modes = fields.size() == 2 ? parse_integer(fields[1]) : std::nullopt;
    if (!nodes || !modes || *nodes < 0 || *modes < 0) {
      stop(
          fmt::format("found {}, expected the numbers of nodes and of modes, as in '3 1 : comment'",
                      shown(trimmed(text))));
    }
    if (*modes > most_modes) {
      stop(fmt::format("{} modes are more than the {} that can be read", *modes, most_modes));
    }
    nodes_ = *nodes;
    const int nq = content_.modes = *modes;
    content_.comment = std::string(trimmed(
        text.size() > numbers.size() ? text.substr(numbers.size() + 1) : std::string_view{}));
    content_.mdCM = SidTaylor(3, 1, nq);
    content_.J = SidTaylor(6, 1, nq);
    content_.Ct = SidTaylor(nq, 3, 0);
    content_.Cr = SidTaylor(nq, 3, 0);
    content_.Me = SidTaylor(nq, nq, 0);
    content_.Gr = SidTaylor(3, 3 * nq, 0);
    content_.Ge = SidTaylor(nq, 3 * nq, 0);
    content_.Oe = SidTaylor(nq, 6, 0);
    content_.ksigma = SidTaylor(nq, 1, 0);
    content_.Ke = SidTaylor(nq, nq, 0);
    content_.De = SidTaylor(nq, nq, 0);
  }

  SidTaylor* modal_block(const std::string& key) {
    const std::array<std::pair<const char*, SidTaylor*>, 11> blocks = {
        {{"mdCM", &content_.mdCM},
         {"J", &content_.J},
         {"Ct", &content_.Ct},
         {"Cr", &content_.Cr},
         {"Me", &content_.Me},
         {"Gr", &content_.Gr},
         {"Ge", &content_.Ge},
         {"Oe", &content_.Oe},
         {"ksigma", &content_.ksigma},
         {"Ke", &content_.Ke},
         {"De", &content_.De}}};
    for (const auto& [name, block] : blocks) {
      if (key == name) return block;
    }
    return nullptr;
  }

  /// To the end of something unknown; what has no end is one line.
  void skip(const std::string& key) {
    const FeSource begin = source_.here();
    const std::string end = "end" + key;
    std::string_view text;
    while (source_.next(text)) {
      std::string words;
      for (const char c : text) {
        if (c != ' ' && c != '\t') words += c;
      }
      if (words == end) return;
    }
    source_.stop(begin, fmt::format("{} has no end", shown(key)));
  }

  void refmod() {
    while (true) {
      const Item item = next("'end refmod'");
      if (item.key == "endrefmod") return;
      if (item.key == "mass") {
        content_.mass_line = source_.here().line;
        content_.mass = real(item.value).value_or(1.0);
        if (content_.mass <= 0.0) source_.fault("the mass is not positive");
      } else if (item.key == "nelastq") {
        const auto n = parse_integer(item.value);
        if (!n || *n != content_.modes) {
          source_.fault(fmt::format("nelastq is {}, the first line of the file says {} modes",
                                    shown(item.value), content_.modes));
        }
      } else if (item.key.starts_with("ielastq")) {
        mode_name(item);
      } else {
        source_.fault(fmt::format("unknown item {} in refmod (expected mass, nelastq or ielastq)",
                                  shown(item.key)));
      }
    }
  }

  void mode_name(const Item& item) {
    std::string_view number = std::string_view(item.key).substr(7);
    if (number.size() > 2) number = number.substr(1, number.size() - 2);
    const auto k = parse_integer(number);
    if (!k || *k < 1 || *k > content_.modes) {
      source_.fault(
          fmt::format("{} names no mode (there are {})", shown(item.key), content_.modes));
      return;
    }
    content_.mode_names.resize(static_cast<std::size_t>(content_.modes));
    std::string_view name = item.value;
    if (name.ends_with("Hz")) name = trimmed(name.substr(0, name.rfind(':')));
    content_.mode_names[static_cast<std::size_t>(*k - 1)] = std::string(name);
  }

  void frames() {
    if (frame_line_ > 0) {
      source_.fault(fmt::format("block frame is in the file twice, first in line {}", frame_line_));
    }
    frame_line_ = source_.here().line;
    while (true) {
      const Item item = next("'new node' or 'end frame'");
      if (item.key == "endframe") break;
      if (item.key != "newnode") {
        stop(fmt::format("found {}, expected 'new node' or 'end frame'", shown(item.key)));
      }
      node(std::string(item.value));
    }
    if (static_cast<int>(content_.frames.size()) != nodes_) {
      source_.fault({0, frame_line_},
                    fmt::format("block frame has {} nodes, the first line of the file says {}",
                                content_.frames.size(), nodes_));
    }
  }

  void node(std::string id) {
    const int nq = content_.modes;
    const FeSource begin = source_.here();
    SidFrame f;
    f.node = std::move(id);
    f.origin = SidTaylor(3, 1, 0);
    f.phi = SidTaylor(3, nq, 0);
    f.psi = SidTaylor(3, nq, 0);
    f.AP = SidTaylor(3, 3, 0);
    SidTaylor sigma(6, nq, 0);
    while (true) {
      const Item item = next("'end node'");
      if (item.key == "endnode") break;
      SidTaylor* block = item.key == "origin"  ? &f.origin
                         : item.key == "phi"   ? &f.phi
                         : item.key == "psi"   ? &f.psi
                         : item.key == "AP"    ? &f.AP
                         : item.key == "sigma" ? &sigma
                                               : nullptr;
      if (block != nullptr) {
        read_block(item.key, *block);
      } else if (item.key == "rframe") {
        std::string words;
        for (const char c : item.value) {
          if (c != ' ' && c != '\t') words += c;
        }
        if (!same_word(words, "bodyref")) {
          source_.fault(
              fmt::format("rframe is {}, expected 'body ref': nodes relative to another "
                          "frame are not read",
                          shown(item.value)));
        }
      } else {
        source_.fault(fmt::format(
            "unknown item {} in a node (expected rframe, origin, phi, psi, AP or sigma)",
            shown(item.key)));
        if (!item.has_value) skip(item.key);
      }
    }
    if (f.origin.line == 0) {
      source_.fault(begin, fmt::format("node {} has no origin", shown(f.node)));
    }
    if (f.phi.line == 0 && nq > 0) {
      source_.fault(begin, fmt::format("node {} has no phi", shown(f.node)));
    }
    for (const SidFrame& other : content_.frames) {
      if (other.node == f.node) {
        source_.fault(begin, fmt::format("node {} is in the file twice", shown(f.node)));
        break;
      }
    }
    content_.frames.push_back(std::move(f));
  }

  std::optional<double> real(std::string_view field) {
    const auto value = parse_real(field);
    if (!value) source_.fault(not_a_real(field));
    return value;
  }

  /// `block` comes with the size that it must have.
  void read_block(const std::string& name, SidTaylor& block);
  void read_header(const std::string& name, const Item& item, SidTaylor& block);
  void read_entry(const std::string& name, const Item& item, SidTaylor& block);
  std::optional<Entry> entry_of(const std::string& name, const std::string& key,
                                const SidTaylor& block);
  void finish(const std::string& name, SidTaylor& block);
  void check_complete();

  TextSource source_;
  std::string name_;
  SidContent content_;
  int nodes_ = 0;
  int frame_line_ = 0;

  // Of the block being read.
  int order_ = 0, structure_ = 3;
  bool sizes_fit_ = true;
  MatX seen0_;  // line of each entry of m0
  std::vector<MatX> seen1_;
};

void SidParser::read_block(const std::string& name, SidTaylor& block) {
  block.line = source_.here().line;
  block.m0.setZero();
  block.m1.clear();
  order_ = 0;
  structure_ = 3;
  sizes_fit_ = true;
  seen0_ = MatX();
  seen1_.clear();
  const std::string end = "end" + name;
  const std::string wanted = fmt::format("'end {}'", name);
  while (true) {
    const Item item = next(wanted.c_str());
    if (item.key == end) break;
    if (!item.has_value) {
      stop(fmt::format("found {} in block {}, expected {}", shown(item.key), name, wanted));
    }
    if (item.key.starts_with("m0(") || item.key.starts_with("m1(")) {
      if (sizes_fit_) read_entry(name, item, block);
    } else {
      read_header(name, item, block);
    }
  }
  if (sizes_fit_) finish(name, block);
}

void SidParser::read_header(const std::string& name, const Item& item, SidTaylor& block) {
  if (seen0_.size() > 0) {
    source_.fault(fmt::format("{} of block {} comes after its entries", shown(item.key), name));
    return;
  }
  const auto value = parse_integer(item.value);
  if (!value) {
    source_.fault(
        fmt::format("{} of block {}: {}", shown(item.key), name, not_an_integer(item.value)));
    return;
  }
  const auto size = [&](Eigen::Index expected, const char* why) {
    if (*value == expected) return;
    sizes_fit_ = false;
    source_.fault(
        fmt::format("block {}: {} is {}, expected {}{}", name, item.key, *value, expected, why));
  };
  if (item.key == "order") {
    order_ = *value;
    if (order_ < 0 || order_ > 1) {
      sizes_fit_ = false;
      source_.fault(fmt::format("block {}: order is {}, expected 0 or 1", name, *value));
    }
  } else if (item.key == "nrow") {
    if (name == "J" && *value == 3) {
      block.m0 = Mat3::Zero();
    } else {
      size(block.m0.rows(), "");
    }
  } else if (item.key == "ncol") {
    if (name == "sigma" && *value == 1) {
      block.m0 = Vec6::Zero();
    } else {
      size(name == "J" ? (block.m0.rows() == 3 ? 3 : 1) : block.m0.cols(), "");
    }
  } else if (item.key == "nq") {
    if (*value != 0 || order_ == 1) size(content_.modes, ", the number of modes");
  } else if (item.key == "nqn") {
    size(0, ": terms of second order are not read");
  } else if (item.key == "structure") {
    structure_ = *value;
    if (structure_ < 0 || structure_ > 4) {
      sizes_fit_ = false;
      source_.fault(fmt::format("block {}: structure is {}, expected 0 to 4", name, *value));
    } else if (structure_ == 4 && block.m0.rows() != block.m0.cols()) {
      sizes_fit_ = false;
      source_.fault(
          fmt::format("block {}: structure 4 (unit matrix) needs a square block, not "
                      "{} x {}",
                      name, block.m0.rows(), block.m0.cols()));
    }
  } else {
    source_.fault(
        fmt::format("unknown item {} in block {} (expected order, nrow, ncol, nq, nqn, "
                    "structure, m0 or m1)",
                    shown(item.key), name));
  }
}

std::optional<Entry> SidParser::entry_of(const std::string& name, const std::string& key,
                                         const SidTaylor& block) {
  const std::size_t close = key.find(')');
  std::vector<std::string_view> fields;
  split_commas(std::string_view(key).substr(3, close == std::string::npos ? 0 : close - 3), fields);
  Entry e;
  e.order = key[1] == '1' ? 1 : 0;
  std::vector<int> index;
  for (const std::string_view field : fields) index.push_back(parse_integer(field).value_or(0) - 1);
  if (close + 1 != key.size() || index.size() != (e.order == 1 ? 3u : 2u)) {
    source_.fault(
        fmt::format("{} in block {} is no entry; expected m0(row,column) or "
                    "m1(row,mode,column)",
                    shown(key), name));
    return std::nullopt;
  }
  e.row = index.front();
  e.column = index.back();
  if (e.order == 1) e.mode = index[1];
  if (e.row < 0 || e.row >= block.m0.rows() || e.column < 0 || e.column >= block.m0.cols() ||
      e.mode < 0 || (e.order == 1 && e.mode >= content_.modes)) {
    source_.fault(fmt::format("{} is outside of block {}, which is {} x {} with {} modes",
                              shown(key), name, block.m0.rows(), block.m0.cols(), content_.modes));
    return std::nullopt;
  }
  if (e.order == 1 && order_ == 0) {
    source_.fault(fmt::format("{} in block {}, whose order is 0", shown(key), name));
    return std::nullopt;
  }
  return e;
}

void SidParser::read_entry(const std::string& name, const Item& item, SidTaylor& block) {
  const auto e = entry_of(name, item.key, block);
  if (!e) return;
  const auto value = real(item.value);
  if (!value) return;
  if (structure_ == 0 || structure_ == 4) {
    source_.fault(fmt::format("{} in block {}, whose structure {} has no entries", shown(item.key),
                              name, structure_));
    return;
  }
  if (structure_ == 1 && e->row != e->column && *value != 0.0) {
    source_.fault(
        fmt::format("{} in block {}, whose structure 1 is diagonal", shown(item.key), name));
    return;
  }
  if (seen0_.size() == 0) seen0_ = MatX::Zero(block.m0.rows(), block.m0.cols());
  if (e->order == 1 && block.m1.empty()) {
    const auto modes = static_cast<std::size_t>(content_.modes);
    block.m1.assign(modes, MatX::Zero(block.m0.rows(), block.m0.cols()));
    seen1_ = block.m1;
  }
  const auto mode = static_cast<std::size_t>(e->mode);
  MatX& values = e->order == 1 ? block.m1[mode] : block.m0;
  double& line = (e->order == 1 ? seen1_[mode] : seen0_)(e->row, e->column);
  if (line > 0.0) {
    source_.fault(fmt::format("{} of block {} is in the file twice, first in line {}",
                              shown(item.key), name, line));
    return;
  }
  line = source_.here().line;
  values(e->row, e->column) = *value;
}

/// Fills what the structure implies.
void SidParser::finish(const std::string& name, SidTaylor& block) {
  if (structure_ == 4) block.m0.setIdentity();
  if (order_ == 1 && block.m1.empty()) {
    block.m1.assign(static_cast<std::size_t>(content_.modes),
                    MatX::Zero(block.m0.rows(), block.m0.cols()));
  }
  if (structure_ != 2 || block.m0.rows() != block.m0.cols() || seen0_.size() == 0) return;
  const double scale = block.m0.cwiseAbs().maxCoeff();
  for (Eigen::Index r = 0; r < block.m0.rows(); ++r) {
    for (Eigen::Index c = 0; c < r; ++c) {
      double &lower = block.m0(r, c), &upper = block.m0(c, r);
      if (seen0_(r, c) == 0.0) {
        lower = upper;
      } else if (seen0_(c, r) == 0.0) {
        upper = lower;
      } else if (std::abs(upper - lower) > 1e-6 * scale) {
        source_.fault(
            {0, static_cast<int>(std::max(seen0_(r, c), seen0_(c, r)))},
            fmt::format("block {} is symmetric by its structure 2, but m0({},{}) = {} and "
                        "m0({},{}) = {}",
                        name, r + 1, c + 1, lower, c + 1, r + 1, upper));
      }
    }
  }
}

void SidParser::check_complete() {
  const auto need = [&](const char* name, bool there) {
    if (!there) source_.fault(fmt::format("the file has no {}", name));
  };
  need("mass in block refmod", content_.mass_line > 0);
  if (nodes_ > 0) need("block frame", frame_line_ > 0);
  need("block mdCM", content_.mdCM.line > 0);
  need("block J", content_.J.line > 0);
  if (content_.modes == 0) return;
  need("block Ct", content_.Ct.line > 0);
  need("block Cr", content_.Cr.line > 0);
  need("block Me", content_.Me.line > 0);
  need("block Ke", content_.Ke.line > 0);
}

}  // namespace

SidContent parse_sid_content(std::string_view text, const std::string& name) {
  return SidParser(text, name).parse();
}

}  // namespace floatframe

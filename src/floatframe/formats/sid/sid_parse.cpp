// The grammar of SID_FEM, one item per line:
//   <nodes> <modes> : comment
//   part / new modal / refmod .. end refmod / frame { new node .. end node } end frame / blocks /
//   end modal / end part
// A block is "name", order, nrow, ncol, nq, nqn, structure, entries m0(r,c) and m1(r,q,c), "end
// name". Blanks do not matter. Memory is allocated for the sizes implied by the number of modes,
// never for those claimed in a block.
#include <algorithm>
#include <set>

#include "floatframe/formats/sid/sid_block.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int most_modes = 500;

class SidParser {
 public:
  SidParser(std::string_view text, const std::string& name) : source_(std::string(text), name) {}

  SidContent parse() {
    first_line();
    expect_sid_item(source_, "part");
    expect_sid_item(source_, "newmodal");
    while (true) {
      const SidItem item = next("'end modal'");
      if (item.key == "endmodal") break;
      if (item.key == "refmod") {
        refmod();
      } else if (item.key == "frame") {
        frames();
      } else if (SidTaylor* block = block_of(content_, sid_modal_blocks, item.key)) {
        if (block->line > 0)
          source_.error(ErrorCode::duplicate, "block {} is in the file twice, first in line {}",
                        item.key, block->line);
        read_sid_block(source_, item.key, content_.modes, *block);
      } else {
        source_.error(ErrorCode::unknown_key,
                      "unknown block {} (expected refmod, frame, mdCM, J, Ct, Cr, Me, Gr, Ge, Oe, "
                      "ksigma, Ke or De)",
                      shown(item.key));
        skip_sid_block(source_, item.key);
      }
    }
    expect_sid_item(source_, "endpart");
    check_complete();
    source_.throw_if_any();
    return std::move(content_);
  }

 private:
  SidItem next(const char* wanted) { return next_sid_item(source_, wanted); }

  void first_line() {
    std::string_view text;
    if (!source_.next(text)) source_.stop(ErrorCode::missing, "the file is empty");
    const std::string_view numbers = text.substr(0, text.find(':'));
    std::vector<std::string_view> fields;
    split_blanks(numbers, fields);
    const auto nodes = fields.size() == 2 ? parse_integer(fields[0]) : std::nullopt;
    const auto modes = fields.size() == 2 ? parse_integer(fields[1]) : std::nullopt;
    if (!nodes || !modes || *nodes < 0 || *modes < 0)
      source_.stop(ErrorCode::wrong_value,
                   "found {}, expected the numbers of nodes and of modes, as in '3 1 : comment'",
                   shown(trimmed(text)));
    if (*modes > most_modes)
      source_.stop(ErrorCode::too_large, "{} modes are more than the {} that can be read", *modes,
                   most_modes);
    nodes_ = *nodes;
    const int nq = content_.modes = *modes;
    content_.comment = std::string(trimmed(
        text.size() > numbers.size() ? text.substr(numbers.size() + 1) : std::string_view{}));
    for (const auto& b : sid_modal_blocks) content_.*b.block = b.zero(nq, 0);
  }

  /// Null if none of the blocks has this name.
  template <class Owner, std::size_t N>
  static SidTaylor* block_of(Owner& owner, const SidBlock<Owner> (&blocks)[N],
                             const std::string& key) {
    const auto* known = std::find_if(std::begin(blocks), std::end(blocks),
                                     [&](const auto& b) { return key == b.name; });
    return known == std::end(blocks) ? nullptr : &(owner.*known->block);
  }

  void refmod() {
    while (true) {
      const SidItem item = next("'end refmod'");
      if (item.key == "endrefmod") return;
      if (item.key == "mass") {
        content_.mass_line = source_.here().line;
        content_.mass = sid_real(source_, item.value).value_or(1.0);
        if (content_.mass <= 0.0)
          source_.error(ErrorCode::out_of_range, "the mass is not positive");
      } else if (item.key == "nelastq") {
        const auto n = parse_integer(item.value);
        if (!n || *n != content_.modes)
          source_.error(ErrorCode::contradiction,
                        "nelastq is {}, the first line of the file gives {} modes",
                        shown(item.value), content_.modes);
      } else if (item.key.starts_with("ielastq")) {
        mode_name(item);
      } else {
        source_.error(ErrorCode::unknown_key,
                      "unknown item {} in refmod (expected mass, nelastq or ielastq)",
                      shown(item.key));
      }
    }
  }

  void mode_name(const SidItem& item) {
    std::string_view number = std::string_view(item.key).substr(7);
    if (number.size() > 2) number = number.substr(1, number.size() - 2);
    const auto k = parse_integer(number);
    if (!k || *k < 1 || *k > content_.modes)
      return source_.error(ErrorCode::not_found, "{} names no mode (there are {})", shown(item.key),
                           content_.modes);
    content_.mode_names.resize(content_.modes);
    std::string_view name = item.value;
    if (name.ends_with("Hz")) name = trimmed(name.substr(0, name.rfind(':')));
    content_.mode_names[*k - 1] = std::string(name);
  }

  void frames() {
    if (frame_line_ > 0)
      source_.error(ErrorCode::duplicate, "block frame is in the file twice, first in line {}",
                    frame_line_);
    frame_line_ = source_.here().line;
    while (true) {
      const SidItem item = next("'new node' or 'end frame'");
      if (item.key == "endframe") break;
      if (item.key != "newnode")
        source_.stop(ErrorCode::wrong_value, "found {}, expected 'new node' or 'end frame'",
                     shown(item.key));
      node(std::string(item.value));
    }
    if (static_cast<int>(content_.frames.size()) != nodes_)
      source_.error(ErrorCode::contradiction, {0, frame_line_},
                    "block frame has {} nodes, the first line of the file gives {}",
                    content_.frames.size(), nodes_);
  }

  void node(std::string id) {
    const int nq = content_.modes;
    const FeSource begin = source_.here();
    SidFrame f;
    f.node = std::move(id);
    for (const auto& b : sid_frame_blocks) f.*b.block = b.zero(nq, 0);
    SidTaylor sigma(6, nq, 0);
    while (true) {
      const SidItem item = next("'end node'");
      if (item.key == "endnode") break;
      SidTaylor* block = item.key == "sigma" ? &sigma : block_of(f, sid_frame_blocks, item.key);
      if (block != nullptr) {
        read_sid_block(source_, item.key, content_.modes, *block);
      } else if (item.key == "rframe") {
        if (!same_word(without_blanks(item.value), "bodyref"))
          source_.error(
              ErrorCode::unsupported,
              "rframe is {}, expected 'body ref': nodes relative to another frame are not read",
              shown(item.value));
      } else {
        source_.error(ErrorCode::unknown_key,
                      "unknown item {} in a node (expected rframe, origin, phi, psi, AP or sigma)",
                      shown(item.key));
        if (!item.has_value) skip_sid_block(source_, item.key);
      }
    }
    if (f.origin.line == 0)
      source_.error(ErrorCode::missing, begin, "node {} has no origin", shown(f.node));

    if (f.phi.line == 0 && nq > 0)
      source_.error(ErrorCode::missing, begin, "node {} has no phi", shown(f.node));

    if (!taken_.insert(f.node).second)
      source_.error(ErrorCode::duplicate, begin, "node {} is in the file twice", shown(f.node));
    content_.frames.push_back(std::move(f));
  }

  void check_complete() {
    const auto need = [&](const std::string& name, bool there) {
      if (!there) source_.error(ErrorCode::missing, "the file has no {}", name);
    };
    need("mass in block refmod", content_.mass_line > 0);
    if (nodes_ > 0) need("block frame", frame_line_ > 0);
    for (const auto& b : sid_modal_blocks)
      if (b.needed == SidModal::always || (b.needed == SidModal::with_modes && content_.modes > 0))
        need(fmt::format("block {}", b.name), (content_.*b.block).line > 0);
  }

  TextSource source_;
  SidContent content_;
  int nodes_ = 0;
  int frame_line_ = 0;
  std::set<std::string> taken_;  // names of nodes
};

}  // namespace

SidContent parse_sid_content(std::string_view text, const std::string& name) {
  return SidParser(text, name).parse();
}

}  // namespace floatframe

#include "floatframe/decks/unv/unv_content.hpp"

#include <algorithm>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::array unv_passed_over{55,   56,   57,   58,   151,  773,  776,  1703,
                                     1710, 2400, 2414, 2429, 2430, 2432, 2437, 2417};

class UnvParser {
 public:
  explicit UnvParser(TextSource& in) : in_(in) {}

  UnvContent read() {
    std::string_view line;
    while (in_.next(line)) {
      if (trimmed(line).empty()) continue;
      if (!is_unv_delimiter(line))
        in_.stop(ErrorCode::wrong_value, "a dataset begins with a line -1, found {}", shown(line));
      const FeSource begin = in_.here();
      if (!in_.next(line))
        in_.stop(ErrorCode::damaged, begin, "the file ends where the number of a dataset follows");
      const auto number = parse_label(trimmed(line));
      if (!number)
        in_.stop(ErrorCode::not_a_number, "the number of a dataset is expected, found {}",
                 shown(trimmed(line)));
      dataset(*number);
    }
    return std::move(c_);
  }

 private:
  /// Those that are read, by their numbers.
  static const std::map<int, void (UnvParser::*)()> datasets;

  /// The next line of the dataset; false at its end.
  bool record(std::string_view& line) {
    if (!in_.next(line))
      in_.stop(ErrorCode::damaged, "the file ends within dataset {}: a line -1 is expected",
               dataset_);
    return !is_unv_delimiter(line);
  }
  void skip() {
    std::string_view line;
    while (record(line)) {
    }
  }
  std::string_view needed(const char* what) {
    std::string_view line;
    if (!record(line))
      in_.stop(ErrorCode::damaged, "dataset {} ends where {} expected", dataset_, what);
    return line;
  }

  /// Whole numbers of fields of ten characters, with or without blanks between them.
  void integers(std::string_view line, std::size_t least, const char* what) {
    split_blanks(line, words_);
    const bool filled = std::any_of(words_.begin(), words_.end(),
                                    [](std::string_view word) { return word.size() > 10; });
    if (filled) {
      words_.clear();
      for (std::size_t k = 0; k < line.size(); k += 10)
        words_.push_back(trimmed(line.substr(k, 10)));
    }
    numbers_.clear();
    for (const std::string_view word : words_) {
      const auto value = parse_integer(word);
      if (!value) in_.stop(ErrorCode::not_a_number, "{}: {}", what, not_an_integer(word));
      numbers_.push_back(*value);
    }
    if (numbers_.size() < least)
      in_.stop(ErrorCode::wrong_count, "{} has {} numbers, at least {} are expected", what,
               numbers_.size(), least);
  }

  Vec3 point(std::size_t first, const char* what) {
    if (words_.size() != first + 3)
      in_.stop(ErrorCode::wrong_count, "{} has {} coordinates, 3 are expected", what,
               words_.size() - std::min(first, words_.size()));
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const auto value = parse_real(words_[first + k]);
      if (!value) in_.stop(ErrorCode::not_a_number, "{}: {}", what, not_a_real(words_[first + k]));
      p[k] = *value;
    }
    return p;
  }

  void dataset(int number) {
    dataset_ = number;
    if (const auto known = datasets.find(number); known != datasets.end())
      return (this->*known->second)();
    if (std::find(unv_passed_over.begin(), unv_passed_over.end(), number) == unv_passed_over.end())
      in_.stop(ErrorCode::unknown_key,
               "dataset {} is not known: whether it changes stiffness or mass is not clear; remove "
               "it from the file if it does not",
               number);
    if (number != 151) c_.passed_over.insert(number);
    skip();
  }

  void read_nodes() {
    std::string_view line;
    while (record(line)) {
      const FeSource at = in_.here();
      Vec3 p;
      if (dataset_ == 15) {
        split_blanks(line, words_);
        p = point(4, "the node");
        numbers_.clear();
        for (int k = 0; k < 2; ++k) numbers_.push_back(parse_integer(words_[k]).value_or(-1));
      } else {
        integers(line, 4, "the node");
        split_blanks(needed("the coordinates of a node are"), words_);
        p = point(0, "the node");
      }
      const int id = numbers_[0], system = numbers_[1];
      if (id < 1)
        in_.stop(ErrorCode::out_of_range, at, "a node has the number {}, expected is 1 or more",
                 id);
      const auto [it, fresh] = c_.node_index.try_emplace(id, c_.model.nodes());
      if (!fresh)
        in_.error(ErrorCode::duplicate, at, "node {} is in the file twice, first in line {}", id,
                  c_.model.node_sources[it->second].line);
      c_.systems_used.try_emplace(system, std::pair{id, at});
      c_.model.positions.push_back(p);
      c_.model.node_ids.push_back(id);
      c_.model.node_sources.push_back(at);
    }
  }

  void read_elements() {
    std::string_view line;
    const bool old = dataset_ == 780;
    while (record(line)) {
      UnvElement e;
      e.at = in_.here();
      integers(line, old ? 8 : 6, "the element");
      e.id = numbers_[0];
      e.material = numbers_[old ? 5 : 3];
      e.nodes = numbers_[old ? 7 : 5];
      e.type = unv_type(numbers_[1]);
      if (e.id < 1)
        in_.stop(ErrorCode::out_of_range, e.at,
                 "an element has the number {}, expected is 1 or more", e.id);
      if (e.type == nullptr)
        in_.stop(ErrorCode::unsupported, e.at,
                 "element {} has the descriptor {}, which is not supported; supported are solid "
                 "elements 111 to 113, 115, 116, 118, rigid ones 121, 122, and shells, beams and "
                 "rods as skins",
                 e.id, numbers_[1]);
      const int most = e.type->use == UnvUse::rigid ? 1'000'000 : 20;
      if (e.nodes < 1 || e.nodes > most || (e.type->nodes > 0 && e.nodes != e.type->nodes))
        in_.stop(ErrorCode::wrong_count, e.at, "element {} ({}) has {} nodes, {} are expected",
                 e.id, e.type->name, e.nodes,
                 e.type->nodes > 0 ? std::to_string(e.type->nodes) : fmt::format("1 to {}", most));
      if (e.type->beam) static_cast<void>(needed("the orientation of a beam is"));
      e.first = c_.element_nodes.size();
      while (c_.element_nodes.size() < e.first + e.nodes) {
        integers(needed("the nodes of an element are"), 1, "the list of nodes");
        c_.element_nodes.insert(c_.element_nodes.end(), numbers_.begin(), numbers_.end());
      }
      if (c_.element_nodes.size() != e.first + e.nodes)
        in_.stop(ErrorCode::wrong_count, "element {} ({}) has {} nodes listed, {} are expected",
                 e.id, e.type->name, c_.element_nodes.size() - e.first, e.nodes);
      const auto [it, fresh] = c_.element_index.try_emplace(e.id, c_.elements.size());
      if (!fresh)
        in_.error(ErrorCode::duplicate, e.at, "element {} is in the file twice, first in line {}",
                  e.id, c_.elements[it->second].at.line);
      c_.elements.push_back(e);
    }
  }

  void read_groups() {
    std::string_view line;
    while (record(line)) {
      UnvGroup group;
      group.at = in_.here();
      integers(line, 8, "the group");
      const int number = numbers_[0], count = numbers_[7];
      if (count < 0)
        in_.stop(ErrorCode::out_of_range, group.at,
                 "group {} has {} members, expected is 0 or more", number, count);
      group.name = std::string(trimmed(needed("the name of a group is")));
      if (group.name.empty()) group.name = fmt::format("group {}", number);
      while (group.members.size() < static_cast<std::size_t>(count)) {
        integers(needed("the members of a group are"), 4, "the list of members");
        for (std::size_t k = 0; k + 3 < numbers_.size(); k += 4)
          group.members.emplace_back(numbers_[k], numbers_[k + 1]);
        if (numbers_.size() % 4 != 0 || group.members.size() > static_cast<std::size_t>(count))
          in_.stop(
              ErrorCode::wrong_count,
              "group '{}' has {} members in its first line, and another number of them is listed",
              group.name, count);
      }
      c_.groups.push_back(std::move(group));
    }
  }

  /// Only systems aligned with the global one are supported.
  void read_systems() {
    static_cast<void>(needed("the number of a part is"));
    static_cast<void>(needed("the name of a part is"));
    std::string_view line;
    while (record(line)) {
      integers(line, 2, "the coordinate system");
      const int label = numbers_[0], kind = numbers_[1];
      static_cast<void>(needed("the name of a coordinate system is"));
      bool plain = kind == 0;
      for (int row = 0; row < 4; ++row) {
        split_blanks(needed("the axes of a coordinate system are"), words_);
        const Vec3 axis = point(0, "the coordinate system");
        const Vec3 own = row < 3 ? Vec3(Vec3::Unit(row)) : Vec3(Vec3::Zero());
        plain = plain && (axis - own).cwiseAbs().maxCoeff() == 0.0;
      }
      c_.systems[label] = plain;
    }
  }

  void read_units() {
    const std::string text(trimmed(needed("the units are")));
    in_.note(c_.model, in_.here(),
             "the file declares units {}; the units given with the file are used", shown(text));
    skip();
  }

  TextSource& in_;
  UnvContent c_;
  std::vector<std::string_view> words_;
  std::vector<int> numbers_;
  int dataset_ = 0;
};

const std::map<int, void (UnvParser::*)()> UnvParser::datasets = {
    {15, &UnvParser::read_nodes},      {781, &UnvParser::read_nodes},
    {2411, &UnvParser::read_nodes},    {780, &UnvParser::read_elements},
    {2412, &UnvParser::read_elements}, {2435, &UnvParser::read_groups},
    {2452, &UnvParser::read_groups},   {2467, &UnvParser::read_groups},
    {2477, &UnvParser::read_groups},   {2420, &UnvParser::read_systems},
    {164, &UnvParser::read_units},
};

using U = FeElementType;

constexpr std::array<int, 20> as_in_unv = {0, 1, 2, 3, 4, 5, 6, 7};

constexpr std::array<int, 20> parabolic_triangle = {0, 2, 4, 1, 3, 5};
constexpr std::array<int, 20> parabolic_quadrilateral = {0, 2, 4, 6, 1, 3, 5, 7};

/// Parabolic elements go round each ring from corner to middle to corner.
const UnvType unv_types[] = {
    {11, "rod", 2, true, {}, {}},
    {21, "linear beam", 2, true, {}, {}},
    {22, "tapered beam", 0, true, {}, {}},
    {23, "curved beam", 0, true, {}, {}},
    {24, "parabolic beam", 3, true, {}, {}},
    {41, "plane stress triangle", 3, false, U::tri3, as_in_unv},
    {42, "parabolic plane stress triangle", 6, false, U::tri6, parabolic_triangle},
    {44, "plane stress quadrilateral", 4, false, U::quad4, as_in_unv},
    {45, "parabolic plane stress quadrilateral", 8, false, U::quad8, parabolic_quadrilateral},
    {51, "plane strain triangle", 3, false, {}, {}},
    {52, "parabolic plane strain triangle", 6, false, {}, {}},
    {54, "plane strain quadrilateral", 4, false, {}, {}},
    {55, "parabolic plane strain quadrilateral", 8, false, {}, {}},
    {61, "plate triangle", 3, false, U::tri3, as_in_unv},
    {62, "parabolic plate triangle", 6, false, U::tri6, parabolic_triangle},
    {64, "plate quadrilateral", 4, false, U::quad4, as_in_unv},
    {65, "parabolic plate quadrilateral", 8, false, U::quad8, parabolic_quadrilateral},
    {91, "thin shell triangle", 3, false, U::tri3, as_in_unv},
    {92, "parabolic thin shell triangle", 6, false, U::tri6, parabolic_triangle},
    {94, "thin shell quadrilateral", 4, false, U::quad4, as_in_unv},
    {95, "parabolic thin shell quadrilateral", 8, false, U::quad8, parabolic_quadrilateral},
    {111, "solid linear tetrahedron", 4, false, U::tet4, as_in_unv},
    {112, "solid linear wedge", 6, false, U::wedge6, as_in_unv},
    {113,
     "solid parabolic wedge",
     15,
     false,
     U::wedge15,
     {0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8}},
    {115, "solid linear brick", 8, false, U::hex8, as_in_unv},
    {116, "solid parabolic brick", 20, false, U::hex20, {0, 2, 4,  6,  12, 14, 16, 18, 1,  3,
                                                         5, 7, 13, 15, 17, 19, 8,  9,  10, 11}},
    {118, "solid parabolic tetrahedron", 10, false, U::tet10, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}},
    {121, "rigid bar", 2, false, {}, {}, UnvUse::rigid},
    {122, "rigid element", 0, false, {}, {}, UnvUse::rigid},
    {136, "translational spring", 2, false, {}, {}, UnvUse::refused},
    {137, "rotational spring", 2, false, {}, {}, UnvUse::refused},
    {138, "translational spring to the ground", 1, false, {}, {}, UnvUse::refused},
    {139, "rotational spring to the ground", 1, false, {}, {}, UnvUse::refused},
    {141, "damper", 2, false, {}, {}, UnvUse::left},
    {142, "damper to the ground", 1, false, {}, {}, UnvUse::left},
    {161, "lumped mass", 1, false, {}, {}, UnvUse::refused},
};

}  // namespace

bool is_unv_delimiter(std::string_view line) { return trimmed(line) == "-1"; }

UnvContent read_unv_content(TextSource& in) { return UnvParser(in).read(); }

bool UnvType::solid() const noexcept {
  return element && element_kernel(*element).family == ElementFamily::solid;
}

const UnvType* unv_type(int number) noexcept {
  const auto* it = std::find_if(std::begin(unv_types), std::end(unv_types),
                                [number](const UnvType& t) { return t.number == number; });
  return it == std::end(unv_types) ? nullptr : it;
}

}  // namespace floatframe

// A deck of CalculiX: nodes, elements, sets and surfaces; a step of free vibration if all masses
// are known. Sections and constraints are in separate sources.
// Source: CalculiX CrunchiX User's Manual 2.20, "Input deck format".
#include <algorithm>
#include <numeric>

#include "floatframe/decks/calculix/calculix_text.hpp"
#include "floatframe/fe/free_turns.hpp"

namespace floatframe {
namespace {

std::string calculix_type(FeElementType type) {
  using Type = FeElementType;
  static const std::map<Type, const char*> names = {
      {Type::beam2, "B31"},      {Type::beam3, "B32"},        {Type::rod2, "T3D2"},
      {Type::tri3, "S3"},        {Type::tri6, "S6"},          {Type::quad4, "S4"},
      {Type::quad8, "S8"},       {Type::membrane3, "M3D3"},   {Type::membrane4, "M3D4"},
      {Type::membrane6, "M3D6"}, {Type::membrane4s, "M3D4R"}, {Type::membrane8, "M3D8"},
      {Type::tet4, "C3D4"},      {Type::membrane8r, "M3D8R"}, {Type::tet10, "C3D10"},
      {Type::hex8, "C3D8"},      {Type::hex8i, "C3D8I"},      {Type::hex8r, "C3D8R"},
      {Type::hex20, "C3D20"},    {Type::hex20r, "C3D20R"},    {Type::wedge6, "C3D6"},
      {Type::wedge15, "C3D15"},  {Type::pyramid5, "C3D8"},    {Type::pyramid13, "C3D20"},
      {Type::shear4, "S4"}};  // the last is rejected earlier
  return names.at(type);
}

bool is_pyramid(FeElementType type) {
  return type == FeElementType::pyramid5 || type == FeElementType::pyramid13;
}

/// Nodes as written: pyramids are bricks whose upper face is one node.
std::vector<int> deck_nodes(const CalculixText& deck, const FeElement& e) {
  std::vector<int> order;
  if (e.type == FeElementType::pyramid5) {
    order = {0, 1, 2, 3, 4, 4, 4, 4};
  } else if (e.type == FeElementType::pyramid13) {
    order = {0, 1, 2, 3, 4, 4, 4, 4, 5, 6, 7, 8, 4, 4, 4, 4, 9, 10, 11, 12};
  } else {
    order.resize(nodes_of_element(e).size());
    std::iota(order.begin(), order.end(), 0);
  }
  for (int& k : order) k = deck.node(e.nodes[k]);
  return order;
}

void add_nodes(CalculixText& deck) {
  deck.text += "*NODE, NSET=NALL\n";
  for (int n = 0; n < deck.model.nodes(); ++n) {
    if (deck.beside != nullptr && deck.beside->left_out[n] != 0) continue;
    deck.text += calculix_node(deck.node(n), deck.model.positions[n]);
  }
  deck.names.insert("NALL");
}

void add_elements(CalculixText& deck) {
  const std::vector<FeElement>& elements = deck.model.elements;
  std::string last;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    // CalculiX has pipes in B32R only.
    const auto s = static_cast<std::size_t>(elements[e].section);
    const bool pipe = elements[e].type == FeElementType::beam3 && s < deck.model.sections.size() &&
                      deck.model.sections[s].bore > 0.0;
    const std::string type = pipe ? "B32R" : calculix_type(elements[e].type);
    if (type != last) deck.add("*ELEMENT, TYPE={}\n", type);
    last = type;
    std::vector<int> numbers = deck_nodes(deck, elements[e]);
    numbers.insert(numbers.begin(), deck.element(e));
    add_calculix_numbers(deck.text, numbers, true);
  }
}

/// Kinds of elements, and their treatment by CalculiX.
void note_habits(CalculixText& deck) {
  static constexpr std::pair<bool (*)(const FeElement&), const char*> habits[] = {
      {[](const FeElement& e) { return is_pyramid(e.type); },
       "of 5 or 13 nodes: CalculiX has no pyramids, written as bricks with one upper node"},
      {[](const FeElement& e) { return e.mass_form != MassForm::consistent; },
       "of lumped mass: CalculiX takes consistent mass"},
      {[](const FeElement& e) {
         return is_beam(e.type) || is_shell(e.type) || is_rod(e.type) || is_membrane(e.type);
       },
       "are beams, rods, shells or membranes: CalculiX makes solid elements of them, with all "
       "integration points (B32, S8, not B32R, S8R), its frequencies differ"},
      {[](const FeElement& e) { return is_rod(e.type); },
       "are rods: what CalculiX makes of them bends by itself, with low frequencies of its own, "
       "and is clamped to beams at their nodes"},
      {[](const FeElement& e) { return e.type == FeElementType::hex8i; },
       "of 8 nodes with incompatible modes: CalculiX (C3D8I) gives these modes mass, its "
       "frequencies are lower, by some percent where the mesh is coarse"}};
  const std::vector<FeElement>& elements = deck.model.elements;
  for (const auto& [is_of_kind, what] : habits)
    if (const long count = std::count_if(elements.begin(), elements.end(), is_of_kind); count > 0)
      deck.note("{} {}", plural(count, "element"), what);
}

/// 1 for each node of a beam.
std::vector<char> nodes_of_beams(const FeModel& model) {
  return nodes_of_elements(model, [](const FeElement& e) { return is_beam(e.type); });
}

/// CalculiX 2.20 joins the expansions of rods and beams in all directions only if
/// the element with the smallest number at their node is a beam; else some become detached. Such
/// rods get numbers above all others.
void number_rods_after_beams(CalculixText& deck) {
  const std::vector<FeElement>& elements = deck.model.elements;
  const std::vector<char> bends = nodes_of_beams(deck.model);
  const auto any_node = [&](const FeElement& e) {
    const std::span<const int> nodes = nodes_of_element(e);
    return std::any_of(nodes.begin(), nodes.end(), [&](int n) { return bends[n] != 0; });
  };
  int largest = 0;  // of the beams
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (is_beam(elements[i].type)) largest = std::max(largest, deck.element(i));
  long renumbered = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!is_rod(elements[i].type) || deck.element(i) > largest || !any_node(elements[i])) continue;
    deck.numbers.element[i] = ++deck.numbers.last_element;
    ++renumbered;
  }
  if (renumbered > 0)
    deck.note(
        "{} numbered anew, after the beams that they meet: CalculiX 2.20 joins them only in some "
        "directions otherwise",
        plural(renumbered, "rod is", "rods are"));
}

/// CalculiX expands a shell node to nodes on its normal, about which they rotate freely.
void note_beams_on_shells(CalculixText& deck) {
  const std::vector<char> beams = nodes_of_beams(deck.model);
  std::vector<char> both =
      nodes_of_elements(deck.model, [](const FeElement& e) { return is_shell(e.type); });
  for (std::size_t n = 0; n < both.size(); ++n) both[n] &= beams[n];
  const auto first = std::find(both.begin(), both.end(), 1);
  if (first == both.end()) return;
  deck.note(
      "beams and shells share {}: a shell of CalculiX does not resist that a beam turns there "
      "about the normal of the shell, which is a frequency of zero where nothing else does; first: "
      "{}",
      plural(std::count(both.begin(), both.end(), 1), "node"),
      deck.model.node_label(static_cast<int>(first - both.begin())));
}

template <class Number>
void add_sets_of(CalculixText& deck, const char* keyword,
                 const std::map<std::string, std::vector<int>>& sets, Number number_of) {
  for (const auto& [name, members] : sets) {
    if (members.empty()) continue;
    std::vector<int> numbers;
    for (const int member : members) numbers.push_back(number_of(member));
    deck.add("*{0}, {0}={1}\n", keyword, deck.name_of(name));
    add_calculix_numbers(deck.text, numbers, false);
  }
}

void add_sets(CalculixText& deck) {
  add_sets_of(deck, "NSET", deck.model.node_sets, [&](int n) { return deck.node(n); });
  add_sets_of(deck, "ELSET", deck.model.element_sets, [&](int e) { return deck.element(e); });
  long skins = 0;
  for (const auto& [name, faces] : deck.model.surfaces) {
    std::string lines;
    for (const ElementFace& f : faces) {
      const FeElementType type = deck.model.elements[f.element].type;
      if (element_kernel(type).family == ElementFamily::solid && !is_pyramid(type))
        lines += fmt::format("{}, S{}\n", deck.element(f.element), f.face + 1);
      else
        ++skins;
    }
    if (!lines.empty()) deck.add("*SURFACE, NAME={}\n{}", deck.name_of(name), lines);
  }
  if (skins > 0)
    deck.note("{} of surfaces left out: they are not faces of solids", plural(skins, "face"));
}

/// Supports of the part in its own deck are not active here either: comments.
void add_supports(CalculixText& deck) {
  if (deck.model.supports.empty()) return;
  deck.text += "** Supports of the model; without the stars they are in force:\n** *BOUNDARY\n";
  for (const Support& s : deck.model.supports)
    for (int axis = 0; axis < 6; ++axis)
      if ((s.mask >> static_cast<unsigned>(axis) & 1u) != 0u)
        deck.add("** {}, {}, {}\n", deck.node(s.node), axis + 1, axis + 1);
}

void add_step(CalculixText& deck, int modes) {
  if (modes <= 0) return;
  if (!deck.model.without_density.empty())
    return deck.note(
        "no step of vibration: the density of a material is not known (--density RHO)");
  // Its Lanczos vectors, five times the modes, must not be more than its degrees of freedom.
  if (const int most = static_cast<int>(std::max(1L, deck.dofs / 5)); modes > most) {
    modes = most;
    deck.note(
        "the step requests {}, a fifth of the {} of the deck: if more are requested than exist, "
        "CalculiX prints zeros",
        plural(most, "mode"), plural(deck.dofs, "degree of freedom", "degrees of freedom"));
  }
  deck.add("*STEP\n*FREQUENCY\n{}\n*NODE FILE\nU\n*END STEP\n", modes);
}

/// Turns of beams: CalculiX loses equations whose dependent term is the rotation of a beam.
std::size_t leave_out_beams(const FeModel& model, std::vector<FreeTurn>& turns) {
  const std::vector<char> bends = nodes_of_beams(model);
  return std::erase_if(turns, [&](const FreeTurn& turn) {
    return std::any_of(turn.group.begin(), turn.group.end(), [&](int k) { return bends[k] != 0; });
  });
}

}  // namespace

std::string calculix_number(double value) { return fmt::format("{:.13g}", value); }

std::string calculix_vector(const Vec3& v) {
  return fmt::format("{:.13g}, {:.13g}, {:.13g}", v(0), v(1), v(2));
}

std::string calculix_node(int number, const Vec3& p) {
  return fmt::format("{}, {}\n", number, calculix_vector(p));
}

void add_calculix_numbers(std::string& text, const std::vector<int>& numbers, bool goes_on) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const bool end = k + 1 == numbers.size();
    text += std::to_string(numbers[k]);
    if (!end && (k % 16 != 15 || goes_on)) text += ',';
    if (end || k % 16 == 15)
      text += '\n';
    else
      text += ' ';
  }
}

WrittenMesh calculix_deck(const FeModel& model, const MeshWriteOptions& options) {
  if (model.elements.empty())
    throw InputError(ErrorCode::missing,
                     "the model has no elements, expected a mesh (matrices make no deck)");
  const std::optional<OffsetBeams> beside = offset_beams(model);
  const FeModel& given = beside ? beside->model : model;
  FeModel tied;  // only if needed: directions without stiffness are singular there too
  std::vector<FreeTurn> turns = free_turns(given);
  const std::size_t bars = leave_out_beams(given, turns);
  if (!turns.empty()) {
    tied = given;
    tie_free_turns(tied, turns);
  }
  CalculixText deck(turns.empty() ? given : tied);
  if (beside) deck.beside = &*beside;
  if (!turns.empty()) deck.notes.push_back(tied.notes.back());
  if (bars > 0)
    deck.note(
        "{} of beams can turn about the line that holds them: nodes without rotations; that is a "
        "frequency of zero of each in CalculiX",
        plural(static_cast<long>(bars), "straight group"));
  deck.text = "*HEADING\nWritten by Floatframe\n";
  number_rods_after_beams(deck);
  add_nodes(deck);
  add_elements(deck);
  note_habits(deck);
  note_beams_on_shells(deck);
  add_sets(deck);
  add_calculix_sections(deck);
  add_calculix_constraints(deck);
  add_supports(deck);
  deck.renamed.note(deck.notes);
  add_step(deck, options.modes);
  deck.errors.throw_if_any();
  return {std::move(deck.text), std::move(deck.notes)};
}

}  // namespace floatframe

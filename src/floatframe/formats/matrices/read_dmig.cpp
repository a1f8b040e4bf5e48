#include "floatframe/formats/matrices/read_dmig.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"

namespace floatframe {
namespace {

using Row = std::pair<int, int>;  // node, component from 1; scalar point, 0

/// Nodes, their axes and lists of degrees of freedom, which are read as nodes or follow from the
/// matrices.
constexpr std::string_view without_effect[] = {
    "GRID",    "CORD1R",  "CORD2R",   "CORD1C", "CORD2C",  "CORD1S", "CORD2S", "SPOINT", "EXTRN",
    "ASET",    "ASET1",   "QSET",     "QSET1",  "BSET",    "BSET1",  "CSET",   "CSET1",  "BNDFIX",
    "BNDFREE", "BNDFIX1", "BNDFREE1", "BEGIN",  "ENDDATA", "PARAM",  "DTI"};

struct DmigEntry {
  Row row, column;
  double value = 0.0;
  FeSource at;
};

/// The matrices of one file. Stiffness, mass and viscous damping are read, others only listed.
class DmigFile {
 public:
  explicit DmigFile(TextSource& source) : source_(source) {
    NastranCards cards(source, false, NastranBegin::any);
    NastranCard card;
    while (cards.next(card)) {
      if (card.name != "DMIG") {
        if (std::ranges::find(without_effect, card.name) == std::end(without_effect))
          ++ignored_[card.name];
        continue;
      }
      NastranFields fields(source, card);
      const std::string name = upper_case(card.field(0));
      if (card.field(1) == "0")
        header(name, fields);
      else if (wanted(name))
        column(name, fields, card);
    }
    source.throw_if_any();
  }

  /// The entries of the matrix KAAX (MAAX, BAAX), else of the only one whose name begins with this
  /// letter; an error if there are none or several.
  const std::vector<DmigEntry>& matrix(char letter, const std::string& what, const char* advice) {
    const auto of_letter = [&](const auto& m) { return m.first[0] == letter; };
    std::vector<std::string> found;
    for (const auto& [name, entries] : matrices_)
      if (name[0] == letter) found.push_back(name);
    if (matrices_.contains(letter + std::string("AAX"))) found = {letter + std::string("AAX")};
    const auto other = std::find_if(unfit_.begin(), unfit_.end(), of_letter);
    if (found.empty() && other != unfit_.end())
      source_.stop(ErrorCode::wrong_value, other->second.first, other->second.second);
    if (found.size() != 1)
      source_.stop(
          ErrorCode::wrong_value, {0, 0},
          "the file has {} {} matrix (its matrices: {}); expected one whose name begins with {}{}",
          found.empty() ? "no" : "more than one", what,
          names_.empty() ? "none" : fmt::format("{}", fmt::join(names_, ", ")), letter, advice);
    name_ = found[0];
    used_.insert(name_);
    return matrices_[name_];
  }
  /// Has it a matrix whose name begins with a letter?
  bool has(char letter) const {
    return std::any_of(matrices_.begin(), matrices_.end(),
                       [&](const auto& m) { return m.first[0] == letter; });
  }
  const std::string& name() const { return name_; }
  /// "CONM2 (1), SPC1 (2)": cards that a reader of matrices does not use.
  std::string ignored_cards() const {
    std::string text;
    for (const auto& [name, count] : ignored_)
      text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", name, count);
    return text;
  }
  /// Matrices that `matrix` has not returned.
  std::vector<std::string> others() const {
    std::vector<std::string> names;
    std::set_difference(names_.begin(), names_.end(), used_.begin(), used_.end(),
                        std::back_inserter(names));
    return names;
  }

 private:
  /// K4AAX is structural damping.
  static bool wanted(const std::string& name) {
    return (name.starts_with('K') && !name.starts_with("K4")) || name.starts_with('M') ||
           name.starts_with('B');
  }

  void header(const std::string& name, NastranFields& f) {
    const int form = f.integer(2, "the form IFO", 0), type = f.integer(3, "the type TIN", 0);
    if (!names_.insert(name).second)
      f.error(ErrorCode::duplicate, "the matrix has a second header");
    if (!wanted(name)) return;
    if (form != 1 && form != 6)
      unfit_[name] = {
          f.at(), fmt::format("{}: IFO is {}, expected 1 (square) or 6 (symmetric)", name, form)};
    else if (type != 1 && type != 2)
      unfit_[name] = {f.at(), fmt::format("{}: TIN is {}, expected 1 or 2 (real)", name, type)};
    else
      matrices_[name];
  }

  void column(const std::string& name, NastranFields& f, const NastranCard& card) {
    if (unfit_.contains(name)) return;
    const auto it = matrices_.find(name);
    if (it == matrices_.end()) {
      f.error(ErrorCode::missing, "the matrix has no header before its first column");
      matrices_[name];
      names_.insert(name);
      return;
    }
    const Row column = row(f, 1);
    for (std::size_t i = 4; i < f.size(); i += 4) {
      if (f.blank(i)) continue;
      const Row r = row(f, i);
      it->second.push_back({r, column, f.real(i + 2, "an entry"), card.place(i)});
    }
  }

  static Row row(NastranFields& f, std::size_t i) {
    const int node = f.label(i, "a node");
    const int component = f.integer(i + 1, "a component", 0);
    if (component < 0 || component > 6)
      f.error(ErrorCode::out_of_range,
              "component {} of node {}, expected 1 to 6, or 0 of a scalar point", component, node);
    return {node, component};
  }

  TextSource& source_;
  std::map<std::string, std::vector<DmigEntry>> matrices_;
  std::map<std::string, std::pair<FeSource, std::string>> unfit_;  ///< why they are not read
  std::set<std::string> names_, used_;
  std::map<std::string, int> ignored_;
  std::string name_;
};

}  // namespace

bool looks_like_dmig(std::string_view beginning) {
  while (!beginning.empty())
    if (same_word(card_name(next_line(beginning)), "DMIG")) return true;
  return false;
}

FeModel read_dmig(TextSource& stiffness, TextSource* mass, FeModel nodes, TextSource* damping) {
  DmigFile first(stiffness);
  std::map<Row, int> rows;
  std::vector<DofLabel> labels;
  std::vector<std::string> names;
  std::string K_name;
  const auto read = [&](TextSource& source, const std::string& what) {
    std::optional<DmigFile> other;
    if (&source != &stiffness) other.emplace(source);
    DmigFile& file = other ? *other : first;
    const bool stiff = what == "stiffness", heavy = what == "mass";
    const std::vector<DmigEntry>& entries =
        file.matrix(stiff   ? 'K'
                    : heavy ? 'M'
                            : 'B',
                    what, heavy ? "; or give the mass file" : "");
    if (stiff) {
      K_name = file.name();
      std::map<Row, FeSource> first_at;
      for (const DmigEntry& e : entries)
        for (const Row& row : {e.row, e.column}) {
          rows.emplace(row, 0);
          first_at.emplace(row, e.at);
        }
      if (rows.empty())
        source.stop(ErrorCode::missing, {0, 0}, "matrix {} has no entries, expected a stiffness",
                    K_name);
      for (auto& [row, index] : rows) {
        index = static_cast<int>(labels.size());
        labels.push_back({row.first, row.second, first_at.at(row)});
      }
      names = dof_names(labels);
    }
    SymmetricEntries matrix(source, what);
    for (const DmigEntry& e : entries) {
      for (const Row& row : {e.row, e.column})
        if (!rows.contains(row))
          source.stop(ErrorCode::not_found, e.at, "degree of freedom {}.{} of {} is not in {}",
                      row.first, row.second, file.name(), K_name);
      matrix.add(rows.at(e.row), rows.at(e.column), e.value, e.at);
    }
    if (stiff) return matrix.finish(static_cast<int>(rows.size()), names, true);
    // Where one modal amplitude has mass, all have.
    std::vector<int> amplitudes;
    const auto modal = [](const DmigEntry& e) { return e.row == e.column && e.row.second == 0; };
    if (heavy && std::ranges::any_of(entries, modal))
      for (const auto& [row, index] : rows)
        if (row.second == 0) amplitudes.push_back(index);
    return matrix.finish(static_cast<int>(rows.size()), names, amplitudes);
  };
  if (damping == nullptr && first.has('B')) damping = &stiffness;
  FeModel model =
      matrix_model_of({stiffness, mass == nullptr ? stiffness : *mass, damping, stiffness},
                      std::move(nodes), labels, read);
  std::vector<std::string> others = first.others();
  std::erase_if(others, [&](const std::string& name) {  // replaced by those of another file
    return (mass != nullptr && name.starts_with('M')) ||
           (damping != nullptr && damping != &stiffness && name.starts_with('B'));
  });
  note_other_matrices(model, stiffness.files().front(), others);
  if (const std::string cards = first.ignored_cards(); !cards.empty())
    model.notes.push_back(
        fmt::format("{}: only matrices and nodes are read; cards that are ignored: {}",
                    stiffness.files().front(), cards));
  return model;
}

FeModel read_dmig(const std::filesystem::path& file, const FeReadOptions& options) {
  std::filesystem::path nodes = options.nodes;
  if (nodes.empty()) {
    TextSource cards(file);
    NastranCards reader(cards, false, NastranBegin::any);
    NastranCard card;
    while (nodes.empty() && reader.next(card))
      if (card.name == "GRID") nodes = file;
  }
  nodes = nodes_beside(file, nodes, {".bdf", ".dat", ".nas", ".fem", "_nodes.csv"});
  TextSource stiffness(file);
  std::optional<TextSource> mass, damping;
  if (!options.mass.empty()) mass.emplace(options.mass);
  if (!options.damping_matrix.empty()) damping.emplace(options.damping_matrix);
  return read_dmig(stiffness, mass ? &*mass : nullptr, read_nodes(nodes),
                   damping ? &*damping : nullptr);
}

}  // namespace floatframe

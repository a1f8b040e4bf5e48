#include "floatframe/formats/matrices/matrix_model.hpp"

#include <algorithm>
#include <numeric>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/formats/deck_component.hpp"
#include "floatframe/formats/matrices/read_dmig.hpp"

namespace floatframe {
namespace {

constexpr const char* row_words[] = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};

/// A first line of words, like "node,x,y,z".
bool is_heading(std::string_view line) {
  std::vector<std::string_view> fields;
  split_blanks(line, fields);
  return !fields.empty() && std::none_of(fields.begin(), fields.end(), [](std::string_view f) {
    return f.find_first_of("0123456789") != std::string_view::npos;
  });
}

/// Calls `use` for each line that is neither empty nor a comment nor a heading.
template <typename Use>
void each_row(TextSource& source, Use use) {
  bool first = true;
  each_line(source, "#", [&](std::string_view line) {
    if (!std::exchange(first, false) || !is_heading(line)) use(line);
  });
}

void add_file(FeModel& model, const std::string& file) {
  if (std::find(model.files.begin(), model.files.end(), file) == model.files.end())
    model.files.push_back(file);
}

/// Elements have no effect if there are matrices: their sets become node sets.
void keep_nodes(FeModel& model) {
  std::vector<int> list_of(model.positions.size(), 0);  // the last list that got the node
  int list = 0;
  for (const auto& [name, elements] : model.element_sets) {
    std::vector<int> nodes;
    ++list;
    for (const int e : elements) {
      const FeElement& element = model.elements[e];
      for (int k = 0; k < element_nodes(element.type); ++k) {
        const int node = element.nodes[k];
        int& last = list_of[node];
        if (last != list) nodes.push_back(node);
        last = list;
      }
    }
    model.node_sets.emplace(name, std::move(nodes));
  }
  model.element_sets.clear();
  model.surfaces.clear();
  model.elements.clear();
  model.masses.clear();
  model.materials.clear();
  model.material_names.clear();
  model.sections.clear();
  model.shells.clear();
}

/// Removes nodes: indices of the others move up; sets without nodes are removed.
void remove_nodes(FeModel& model, const std::vector<char>& gone, std::vector<Dof>& dofs) {
  std::vector<int> index(gone.size(), -1);
  int kept = 0;
  for (std::size_t k = 0; k < gone.size(); ++k)
    if (gone[k] == 0) index[k] = kept++;
  const auto keep = [&gone](auto& of_nodes) {
    std::erase_if(of_nodes, [&](const auto& x) { return gone[&x - of_nodes.data()] != 0; });
  };
  keep(model.positions);
  keep(model.node_ids);
  keep(model.node_sources);
  keep(model.node_names);
  const auto renumber = [&index](std::vector<int>& nodes) {
    std::erase_if(nodes, [&](int node) { return index[node] < 0; });
    for (int& node : nodes) node = index[node];
  };
  for (auto& [name, nodes] : model.node_sets) renumber(nodes);
  std::erase_if(model.node_sets, [](const auto& set) { return set.second.empty(); });
  renumber(model.generated_nodes);
  std::erase_if(model.supports, [&](const Support& s) { return index[s.node] < 0; });
  for (Support& s : model.supports) s.node = index[s.node];
  for (Dof& d : dofs) d.node = index[d.node];
}

/// Spiders of the deck are in the matrices: the nodes that follow them have no rows, nor
/// have the rotation nodes. Notes report this.
void remove_spiders(FeModel& model, std::vector<Dof>& dofs) {
  std::vector<char> with_row(model.positions.size(), 0), gone(model.positions.size(), 0);
  for (const Dof& d : dofs) with_row[d.node] = 1;
  for (const Spider& s : model.spiders) {
    std::vector<int> nodes = s.nodes;
    if (s.rotation_node >= 0) nodes.push_back(s.rotation_node);
    int without = 0;
    for (const int node : nodes) {
      if (with_row[node] != 0) continue;
      gone[node] = 1;
      if (node != s.rotation_node) ++without;
    }
    const SourceMark mark = model.mark(s.source);
    model.notes.push_back(
        fmt::format("{}:{}: {} is in the matrices already: its {} nodes have no rows{}", mark.file,
                    mark.line, s.name.empty() ? "the spider" : "spider " + shown(s.name), without,
                    with_row[s.reference] != 0
                        ? fmt::format(", its reference is node {}", model.node_ids[s.reference])
                        : ""));
  }
  model.spiders.clear();
  model.equations.clear();
  remove_nodes(model, gone, dofs);
}

/// A node for each scalar point, at an arbitrary position; returns their numbers.
std::vector<int> add_scalars(FeModel& model, const std::vector<DofLabel>& labels,
                             TextSource& source) {
  std::vector<int> numbers;
  for (const DofLabel& label : labels) {
    if (label.direction != 0) continue;
    if (std::find(model.node_ids.begin(), model.node_ids.end(), label.node) != model.node_ids.end())
      source.stop(ErrorCode::out_of_range, label.at,
                  "node {} has a row without a component, expected 1 to 6", label.node);
    numbers.push_back(label.node);
  }
  const Vec3 place = model.positions.empty() ? Vec3::Zero().eval() : model.positions.front();
  for (const int number : numbers) {
    model.generated_nodes.push_back(model.nodes());
    model.positions.push_back(place);
    model.node_ids.push_back(number);
    if (!model.node_sources.empty()) model.node_sources.emplace_back();
    if (!model.node_names.empty()) model.node_names.emplace_back();
  }
  return numbers;
}

/// A matrix of rows, some with separate axes u = T u_row, in the model's axes: T A T^T.
SparseMatrix in_model_axes(SparseMatrix A, const FeModel& model, const TextSource& source) {
  if (model.axes_of_rows.empty()) return A;
  const std::vector<Dof>& dofs = model.matrices->dofs;
  std::map<std::pair<int, int>, int> row_of;
  for (int i = 0; i < std::ssize(dofs); ++i) row_of[{dofs[i].node, dofs[i].axis}] = i;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < std::ssize(dofs); ++i) {
    const auto turned = model.axes_of_rows.find(dofs[i].node);
    if (turned == model.axes_of_rows.end()) {
      entries.emplace_back(i, i, 1.0);
      continue;
    }
    const int first = dofs[i].axis - dofs[i].axis % 3;
    for (int k = 0; k < 3; ++k) {
      const auto other = row_of.find({dofs[i].node, first + k});
      if (other == row_of.end())
        throw InputError(
            ErrorCode::incomplete, {source.files().front()},
            fmt::format("{} has a system of its own (CD): give all three of its {}",
                        model.node_label(dofs[i].node), first == 0 ? "translations" : "rotations"));
      entries.emplace_back(other->second, i, turned->second(k, dofs[i].axis % 3));
    }
  }
  SparseMatrix T(A.rows(), A.rows());
  T.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix back = T.transpose();
  return T * SparseMatrix(A * back);
}

}  // namespace

std::vector<DofLabel> read_dof_labels(TextSource& source) {
  std::vector<DofLabel> labels;
  std::vector<std::string_view> fields;
  each_row(source, [&](std::string_view line) {
    split_blanks(line, fields);
    if (fields.size() == 1) {
      const std::size_t dot = line.find('.');
      fields = {line.substr(0, dot),
                dot == std::string_view::npos ? std::string_view{} : line.substr(dot + 1)};
    }
    // For ANSYS: number of the row, node, UX to ROTZ.
    if (fields.size() == 3 && parse_label(fields[0]) == static_cast<int>(labels.size()) + 1) {
      const auto* axis = std::find_if(std::begin(row_words), std::end(row_words),
                                      [&](const char* word) { return same_word(word, fields[2]); });
      const std::optional<int> node = parse_label(fields[1]);
      if (node && axis != std::end(row_words)) {
        labels.push_back({*node, static_cast<int>(axis - row_words) + 1, source.here()});
        return;
      }
    }
    fields.resize(std::max<std::size_t>(fields.size(), 2));  // a line of commas alone has none
    const std::optional<int> node = parse_label(fields[0]), direction = parse_integer(fields[1]);
    if (!node || !direction || fields.size() != 2 || *direction < 0 || *direction > 6)
      return source.error(
          ErrorCode::wrong_value,
          "{} is no degree of freedom, expected node and direction 1 to 6, or 0 of a scalar point",
          shown(line));
    labels.push_back({*node, *direction, source.here()});
  });
  if (labels.empty() && source.errors() == 0)
    source.error(ErrorCode::missing, FeSource{0, 0}, "there are no degrees of freedom in the file");
  return labels;
}

std::vector<std::string> dof_names(const std::vector<DofLabel>& labels) {
  std::vector<std::string> names;
  names.reserve(labels.size());
  for (const DofLabel& d : labels) names.push_back(fmt::format("{}.{}", d.node, d.direction));
  return names;
}

FeModel read_node_table(TextSource& source) {
  FeModel model;
  std::unordered_map<int, int> lines;
  std::vector<std::string_view> fields;
  each_row(source, [&](std::string_view line) {
    split_blanks(line, fields);
    if (fields.size() != 4)
      return source.error(ErrorCode::wrong_count, "the line has {} fields, expected node, x, y, z",
                          fields.size());
    const std::optional<int> id = parse_label(fields[0]);
    if (!id)
      return source.error(ErrorCode::not_a_number, "node number: " + not_an_integer(fields[0]));
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::optional<double> value = parse_real(fields[k + 1]);
      if (!value)
        return source.error(ErrorCode::not_a_number, "coordinate {} of node {}: {}", k + 1, *id,
                            not_a_real(fields[k + 1]));
      p(k) = *value;
    }
    const auto [it, added] = lines.emplace(*id, source.here().line);
    if (!added)
      return source.error(ErrorCode::duplicate, "node {} is there already (line {})", *id,
                          it->second);
    model.positions.push_back(p);
    model.node_ids.push_back(*id);
    model.node_sources.push_back(source.here());
  });
  if (model.positions.empty() && source.errors() == 0)
    source.error(ErrorCode::missing, FeSource{0, 0}, "there are no nodes in the file");
  source.throw_if_any();
  model.files = source.files();
  return model;
}

FeModel read_nodes(const std::filesystem::path& file) {
  std::string name = lower_case(file.filename().string());
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  if (name.ends_with(".csv")) {
    TextSource source(file);
    return read_node_table(source);
  }
  const std::string beginning = read_beginning(file, std::size_t{1} << 20);
  const std::string_view cards = looks_like_dmig(beginning) ? "nastran" : "";
  for (const FeFormat& f : fe_formats())
    if (f.read_nodes && (f.recognise(beginning) || f.name == cards)) return f.read_nodes(file);
  if (deck_component().readers.empty() && !name.ends_with(".msh"))
    throw InputError(
        ErrorCode::missing, {file.string()},
        std::string("expected nodes as a table (.csv) or a mesh") + deck_component_missing());
  FeModel model = read_fe_file(file);
  keep_nodes(model);
  return model;
}

FeModel matrix_model(FeModel model, const std::vector<DofLabel>& labels, SparseMatrix K,
                     SparseMatrix M, TextSource& labels_source,
                     const std::vector<std::string>& matrix_files) {
  const std::vector<int> scalars = add_scalars(model, labels, labels_source);
  std::unordered_map<int, int> index_of_id;
  for (int k = 0; k < std::ssize(model.node_ids); ++k) index_of_id.emplace(model.node_ids[k], k);
  std::unordered_map<int, int> reference_of_rotation;
  for (const Spider& s : model.spiders)
    if (s.rotation_node >= 0) reference_of_rotation.emplace(s.rotation_node, s.reference);
  FeMatrices matrices;
  std::map<std::pair<int, int>, FeSource> seen;
  for (const DofLabel& label : labels) {
    const auto node = index_of_id.find(label.node);
    if (node == index_of_id.end()) {
      labels_source.error(ErrorCode::not_found, label.at, "node {} is not among the nodes of {}",
                          label.node, model.files.empty() ? "the model" : model.files.front());
      continue;
    }
    Dof dof{node->second, label.direction == 0 ? 3 : label.direction - 1};
    const auto reference = reference_of_rotation.find(node->second);
    if (reference != reference_of_rotation.end() && dof.axis < 3)
      dof = {reference->second, dof.axis + 3};
    const auto [first, added] = seen.emplace(std::pair(dof.node, dof.axis), label.at);
    if (!added)
      labels_source.stop(ErrorCode::unsupported, label.at,
                         "degree of freedom {}.{} is there already (line {}); matrices in which "
                         "beams and shells are expanded to solids cannot be read: read the deck",
                         label.node, label.direction, first->second.line);
    matrices.dofs.push_back(dof);
  }
  labels_source.throw_if_any();
  if (K.nonZeros() == 0) labels_source.stop(ErrorCode::missing, {0, 0}, "the stiffness is zero");
  remove_spiders(model, matrices.dofs);
  matrices.scalars.resize(scalars.size());  // the last nodes
  std::iota(matrices.scalars.rbegin(), matrices.scalars.rend(), 0);
  for (int& scalar : matrices.scalars) scalar = model.nodes() - 1 - scalar;
  model.matrices = std::move(matrices);
  model.matrices->K = in_model_axes(std::move(K), model, labels_source);
  model.matrices->M = in_model_axes(std::move(M), model, labels_source);
  // Those of the nodes come first, to which the places of nodes point.
  model.files.insert(model.files.end(), labels_source.files().begin(), labels_source.files().end());
  for (const std::string& file : matrix_files) add_file(model, file);
  return model;
}

FeModel matrix_model_of(const MatrixTexts& texts, FeModel nodes,
                        const std::vector<DofLabel>& labels, const MatrixReader& read) {
  const auto checked = [&read](TextSource& source, const char* what) {
    SparseMatrix matrix = read(source, what);
    source.throw_if_any();
    return matrix;
  };
  SparseMatrix K = checked(texts.stiffness, "stiffness"), M = checked(texts.mass, "mass");
  FeModel model = matrix_model(std::move(nodes), labels, std::move(K), std::move(M), texts.rows,
                               {texts.stiffness.files().front(), texts.mass.files().front()});
  if (texts.damping != nullptr)
    add_matrix_damping(model, checked(*texts.damping, "damping"), *texts.damping);
  return model;
}

void note_other_matrices(FeModel& model, const std::string& file,
                         const std::vector<std::string>& names) {
  if (names.empty()) return;
  model.notes.push_back(fmt::format(
      "{}: matrices that are neither stiffness, mass nor viscous damping are ignored: {}", file,
      fmt::join(names, ", ")));
}

void add_matrix_damping(FeModel& model, SparseMatrix C, const TextSource& source) {
  model.matrices->C = in_model_axes(std::move(C), model, source);
  add_file(model, source.files().front());
}

}  // namespace floatframe

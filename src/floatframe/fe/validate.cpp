#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/limited_errors.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {
namespace {

bool in_range(int i, std::size_t size) { return i >= 0 && static_cast<std::size_t>(i) < size; }

void check_nodes(const FeModel& model, LimitedErrors& errors) {
  if (model.nodes() == 0)
    errors.add(ErrorCode::missing, "nodes", {}, "the finite-element model has no nodes");
  const auto lengths = [&](std::size_t size, const char* what) {
    if (size == 0 || size == model.positions.size()) return;
    errors.add(ErrorCode::wrong_count, "lists", {},
               "the finite-element model has {} {} for {} nodes", size, what, model.nodes());
  };
  lengths(model.node_names.size(), "node names");
  lengths(model.node_ids.size(), "node numbers");
  lengths(model.node_sources.size(), "places of nodes");
  for (int k = 0; k < model.nodes(); ++k) {
    const std::size_t i = k;
    if (model.positions[i].allFinite()) continue;
    const bool known = i < model.node_sources.size();
    errors.add(ErrorCode::not_finite, "nodes",
               known ? model.mark(model.node_sources[i]) : SourceMark{},
               model.node_label(k) + " has a position that is not finite");
  }
}

void check_materials(const FeModel& model, LimitedErrors& errors) {
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const Material& m = model.materials[i];
    const bool named = i < model.material_names.size() && !model.material_names[i].empty();
    const std::string label =
        named ? "material '" + model.material_names[i] + "'" : "material " + std::to_string(i);
    if (m.elasticity) {
      const std::string error = elasticity_error(*m.elasticity, m.plane, elasticity_name);
      if (!error.empty()) errors.add(ErrorCode::wrong_value, "materials", {}, label + ": " + error);
    } else if (!(m.young > 0.0) || !std::isfinite(m.young)) {
      errors.add(ErrorCode::out_of_range, "materials", {},
                 "{}: found Young's modulus {:g}, expected a positive number", label, m.young);
    }
    if (!(m.density >= 0.0) || !std::isfinite(m.density)) {
      errors.add(ErrorCode::out_of_range, "materials", {},
                 "{}: found the density {:g}, expected no negative number", label, m.density);
    }
    if (!m.elasticity && !(m.poisson > -1.0 && m.poisson < 0.5)) {
      errors.add(ErrorCode::out_of_range, "materials", {},
                 "{}: found Poisson's ratio {:g}, expected a number between -1 and 0.5", label,
                 m.poisson);
    }
  }
  std::set<std::pair<std::string, int>> said;  // with several nonstructural masses it is several
  for (const auto& [material, missing] : model.without_density)
    if (said.emplace(model.material_names.at(material), missing.source.line).second)
      errors.add(ErrorCode::missing, "materials", model.mark(missing.source),
                 "material '{}' has no density: give one in the file or as an option (--density, "
                 "key `density`; 0 if all mass is in point masses)",
                 model.material_names.at(material));
  if (model.materials.empty() && !model.elements.empty())
    errors.add(ErrorCode::missing, "materials", {},
               "the model has no material: give one (Young's modulus, Poisson's ratio, density)");
}

void check_layers(const FeModel& model, LimitedErrors& errors) {
  const auto check = [&](const auto& all, auto error_of, const char* kind, const char* one) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const std::string error = error_of(all[i], model.materials); !error.empty())
        errors.add(ErrorCode::wrong_value, kind, {}, "{} {} {}", one, i, error);
  };
  check(model.shells, section_error, "shell sections", "shell section");
  check(model.layups, layup_error, "layups of solids", "layup");
}

/// Errors in the combination of an element with its material; empty if there is none.
std::string material_misfit(const FeModel& model, const FeElement& element) {
  if (!in_range(element.orientation + 1, model.orientations.size() + 1))
    return fmt::format(": there is no orientation {}", element.orientation);
  const Material& material = model.materials[element.material];
  if (!in_range(element.layup + 1, model.layups.size() + 1))
    return fmt::format(": there is no layup {}", element.layup);
  if (element.layup >= 0 && element_kernel(element.type).nodal_ply == nullptr)
    return " cannot have plies: only hex8, hex8i, hex20, hex20r, wedge6 and wedge15 can";
  const ElementFamily family = element_kernel(element.type).family;
  const char* const isotropic = family == ElementFamily::beam    ? "a beam"
                                : family == ElementFamily::rod   ? "a rod"
                                : family == ElementFamily::panel ? "a shear panel"
                                                                 : nullptr;
  if (isotropic != nullptr && material.elasticity)
    return fmt::format(" is {}, whose material must be isotropic", isotropic);
  if (family == ElementFamily::solid && material.plane)
    return " is a solid, but its material is one of plane stress, for shells only";
  return {};
}

/// The code below looks up kernels by the type.
void check_types(const FeModel& model, LimitedErrors& errors) {
  for (int e = 0; e < static_cast<int>(model.elements.size()); ++e)
    if (index_of(model.elements[e].type) >= std::size(fe_element_types))
      errors.add(ErrorCode::not_found, "elements", model.mark(model.elements[e].source),
                 "element {} has a type that is not in the list of elements", e + 1);
  errors.throw_if_any();
}

void check_elements(const FeModel& model, LimitedErrors& errors) {
  const bool valid_so_far = errors.empty();
  for (int e = 0; e < static_cast<int>(model.elements.size()); ++e) {
    const FeElement& element = model.elements[e];
    const ElementKernel& kernel = element_kernel(element.type);
    const auto add = [&](ErrorCode code, const char* kind, const std::string& text) {
      errors.add(code, kind, model.mark(element.source), model.element_label(e) + text);
    };
    bool valid = valid_so_far;
    for (int a = 0; a < kernel.nodes; ++a) {
      const int node = element.nodes[a];
      if (!in_range(node, model.positions.size())) {
        add(ErrorCode::out_of_range, "node indices",
            fmt::format(": node index {} is out of range 0..{}", node, model.nodes() - 1));
        valid = false;
      }
    }
    if (!model.materials.empty() && !in_range(element.material, model.materials.size())) {
      add(ErrorCode::missing, "elements without material",
          element.material < 0 ? " has no material"
                               : fmt::format(": there is no material {}", element.material));
      valid = false;
    }
    const bool line = is_beam(element.type) || is_rod(element.type);
    const std::size_t sections = line ? model.sections.size() : model.shells.size();
    const bool surface = has_shell_section(element.type);
    if ((line || surface) && !in_range(element.section, sections)) {
      add(ErrorCode::missing, "elements without section",
          element.section < 0 ? " has no section"
                              : fmt::format(": there is no {} {}",
                                            line ? "section" : "shell section", element.section));
      valid = false;
    }
    if (!valid) continue;
    bool twice = false;
    for (int a = 0; a < kernel.nodes && !twice; ++a) {
      for (int b = 0; b < a && !twice; ++b) {
        const int node = element.nodes[a];
        twice = node == element.nodes[b];
        if (twice)
          add(ErrorCode::duplicate, "elements with a repeated node",
              " names " + model.node_label(node) + " twice");
      }
    }
    if (twice) continue;
    if (const std::string misfit = material_misfit(model, element); !misfit.empty()) {
      add(ErrorCode::geometry, "elements that do not fit their material", misfit);
      continue;
    }
    const std::string error = kernel.error(gather(model, element));
    if (!error.empty()) add(ErrorCode::geometry, "badly formed elements", " " + error);
  }
}

/// Nodes with meaningful rotations.
std::vector<char> nodes_with_rotations(const FeModel& model) {
  std::vector<char> with(model.positions.size(), 0);
  const auto mark = [&](int node) {
    if (in_range(node, with.size())) with[node] = 1;
  };
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    for (int a = 0; a < kernel.nodes && kernel.dofs_per_node == 6; ++a) mark(e.nodes[a]);
  }
  for (const Spider& s : model.spiders) {
    mark(s.reference);
    if (s.kind == Spider::Kind::rigid && (s.mask & 56u) == 56u)
      for (const int node : s.nodes) mark(node);
  }
  for (const Spring& s : model.springs)
    for (int end = 0; end < 2; ++end)
      if (!s.directions[end].tail<3>().isZero(0.0)) mark(s.nodes[end]);
  for (const LinearEquation& e : model.equations)
    for (const LinearEquation::Term& t : e.terms)
      if (t.axis >= 3) mark(t.node);
  if (model.matrices)
    for (const Dof& d : model.matrices->dofs)
      if (d.axis >= 3) mark(d.node);
  return with;
}

void check_masses(const FeModel& model, LimitedErrors& errors) {
  const std::vector<char> rotations = nodes_with_rotations(model);
  for (std::size_t i = 0; i < model.masses.size(); ++i) {
    const PointMass& m = model.masses[i];
    const std::string label = m.name.empty() ? "point mass " + std::to_string(i) : m.name;
    const auto add = [&](ErrorCode code, const std::string& text) {
      errors.add(code, "point masses", model.mark(m.source), label + text);
    };
    if (!in_range(m.node, model.positions.size())) {
      add(ErrorCode::out_of_range, ": node index " + std::to_string(m.node) + " is out of range");
      continue;
    }
    const std::string at = " on " + model.node_label(m.node);
    if (!(m.mass >= 0.0) || !std::isfinite(m.mass))
      add(ErrorCode::not_finite,
          at + fmt::format(": the mass is {:g}, expected a finite number from 0", m.mass));
    if (!m.J.allFinite() ||
        (m.J - m.J.transpose()).cwiseAbs().maxCoeff() > 1e-12 * m.J.cwiseAbs().maxCoeff()) {
      add(ErrorCode::not_finite, at + ": the inertia must be finite and symmetric");
      continue;
    }
    const Mat3 P = 0.5 * m.J.trace() * Mat3::Identity() - m.J;
    const double least =
        Eigen::SelfAdjointEigenSolver<Mat3>(P, Eigen::EigenvaluesOnly).eigenvalues()(0);
    if (least < -1e-12 * m.J.trace())
      add(ErrorCode::out_of_range,
          at + ": the principal moments of inertia break the triangle inequality");
    if (m.J.cwiseAbs().maxCoeff() > 0.0 && rotations[m.node] == 0)
      add(ErrorCode::contradiction,
          at + " has rotary inertia, but the nodes of solid elements have no rotations");
  }
}

void check_springs(const FeModel& model, LimitedErrors& errors) {
  for (const SpringError& e : spring_errors(model))
    errors.add(e.code, e.kind, model.mark(e.at), e.text);
}

void check_spiders(const FeModel& model, LimitedErrors& errors) {
  for (std::size_t i = 0; i < model.spiders.size(); ++i) {
    const Spider& s = model.spiders[i];
    const std::string label =
        s.name.empty() ? "spider " + std::to_string(i) : "spider '" + s.name + "'";
    const auto add = [&](ErrorCode code, const std::string& text) {
      errors.add(code, "spiders", model.mark(s.source), label + text);
    };
    if (!in_range(s.reference, model.positions.size())) {
      add(ErrorCode::missing, " has no reference node");
      continue;
    }
    if (s.nodes.empty()) add(ErrorCode::missing, " has no nodes");
    std::set<int> seen;
    for (const int node : s.nodes) {
      if (!in_range(node, model.positions.size())) {
        add(ErrorCode::out_of_range,
            fmt::format(": node index {} is out of range 0..{}", node, model.nodes() - 1));
        break;
      }
      if (seen.insert(node).second) continue;
      add(ErrorCode::duplicate, " names " + model.node_label(node) + " twice");
      break;
    }
    if (!s.weights.empty() && s.weights.size() != s.nodes.size())
      add(ErrorCode::wrong_count,
          fmt::format(" has {} weights for {} nodes", s.weights.size(), s.nodes.size()));
    if (std::any_of(s.weights.begin(), s.weights.end(),
                    [](double w) { return !(w > 0.0) || !std::isfinite(w); }))
      add(ErrorCode::out_of_range, " has a weight that is not positive");
  }
}

void check_equations(const FeModel& model, LimitedErrors& errors) {
  for (std::size_t i = 0; i < model.equations.size(); ++i) {
    const LinearEquation& equation = model.equations[i];
    const auto add = [&](ErrorCode code, const std::string& text) {
      errors.add(code, "equations", model.mark(equation.source),
                 "equation " + std::to_string(i + 1) + text);
    };
    if (equation.terms.empty()) {
      add(ErrorCode::missing, " has no terms");
      continue;
    }
    bool valid = true;
    for (const LinearEquation::Term& t : equation.terms) {
      valid = valid && in_range(t.node, model.positions.size()) && t.axis >= 0 && t.axis < 6 &&
              std::isfinite(t.factor);
    }
    if (!valid)
      add(ErrorCode::missing, " has a term without a node, a direction 1 to 6 or a finite factor");
    if (equation.terms.front().factor == 0.0)
      add(ErrorCode::out_of_range, ": the factor of its first term must not be zero");
  }
}

void check_sets(const FeModel& model, LimitedErrors& errors) {
  const auto check = [&](const auto& sets, const char* set, const char* member, auto exists) {
    for (const auto& [name, members] : sets)
      if (!std::all_of(members.begin(), members.end(), exists))
        errors.add(ErrorCode::not_found, "sets", {}, "{} '{}' holds {} that does not exist", set,
                   name, member);
  };
  check(model.node_sets, "node set", "a node",
        [&](int k) { return in_range(k, model.positions.size()); });
  check(model.element_sets, "element set", "an element",
        [&](int e) { return in_range(e, model.elements.size()); });
  check(model.surfaces, "surface", "a face", [&](const ElementFace& f) {
    return in_range(f.element, model.elements.size()) &&
           in_range(f.face, element_faces(model.elements[f.element].type).size());
  });
}

double asymmetry(const SparseMatrix& A) {
  const SparseMatrix D = A - SparseMatrix(A.transpose());
  double largest = 0.0, error = 0.0;
  for (int k = 0; k < A.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
      if (!std::isfinite(it.value())) return INFINITY;
      largest = std::max(largest, std::abs(it.value()));
    }
    for (SparseMatrix::InnerIterator it(D, k); it; ++it)
      error = std::max(error, std::abs(it.value()));
  }
  return largest > 0.0 ? error / largest : 0.0;
}

void check_matrices(const FeModel& model, LimitedErrors& errors) {
  if (!model.matrices) return;
  const FeMatrices& m = *model.matrices;
  const auto add = [&](ErrorCode code, const std::string& text) {
    errors.add(code, "matrices", {}, text);
  };
  if (!model.elements.empty())
    add(ErrorCode::exclusive, "the model has matrices and elements; it can have only one of both");
  const Eigen::Index n = static_cast<Eigen::Index>(m.dofs.size());
  if (m.K.rows() != n || m.K.cols() != n || m.M.rows() != n || m.M.cols() != n) {
    add(ErrorCode::contradiction,
        fmt::format("K is {} x {} and M is {} x {}, but there are {} degrees of freedom",
                    m.K.rows(), m.K.cols(), m.M.rows(), m.M.cols(), n));
    return;
  }
  if (m.C.size() > 0 && (m.C.rows() != n || m.C.cols() != n)) {
    add(ErrorCode::contradiction, fmt::format("C is {} x {}, but there are {} degrees of freedom",
                                              m.C.rows(), m.C.cols(), n));
    return;
  }
  std::set<std::pair<int, int>> seen;
  for (const Dof& d : m.dofs) {
    if (!in_range(d.node, model.positions.size()) || d.axis < 0 || d.axis > 5) {
      add(ErrorCode::missing, "a row of the matrices belongs to no node of the model");
      return;
    }
    if (seen.insert({d.node, d.axis}).second) continue;
    add(ErrorCode::duplicate, fmt::format("two rows of the matrices belong to direction {} of {}",
                                          d.axis + 1, model.node_label(d.node)));
  }
  for (const auto& [name, A] :
       {std::pair<const char*, const SparseMatrix&>{"K", m.K}, {"M", m.M}, {"C", m.C}}) {
    const double error = asymmetry(A);
    if (!std::isfinite(error))
      add(ErrorCode::not_finite, fmt::format("{} has an entry that is not finite", name));
    else if (error > 1e-9)
      add(ErrorCode::contradiction,
          fmt::format("{} is not symmetric: entries differ by {:.1e} of the largest", name, error));
  }
}

}  // namespace

void validate(const FeModel& model) {
  LimitedErrors errors;
  check_types(model, errors);
  check_nodes(model, errors);
  check_materials(model, errors);
  check_layers(model, errors);
  check_elements(model, errors);
  check_masses(model, errors);
  check_springs(model, errors);
  check_spiders(model, errors);
  check_equations(model, errors);
  check_sets(model, errors);
  check_matrices(model, errors);
  errors.throw_if_any();
}

}  // namespace floatframe

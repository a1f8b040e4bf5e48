#include "floatframe/fe/fe_model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

BeamSection BeamSection::solid_round(double d) { return hollow_round(d, 0.0); }

BeamSection BeamSection::hollow_round(double outer, double inner) {
  BeamSection s;
  s.A = std::numbers::pi / 4.0 * (outer * outer - inner * inner);
  s.Iy = s.Iz = std::numbers::pi / 64.0 * (std::pow(outer, 4) - std::pow(inner, 4));
  s.J = 2.0 * s.Iy;
  return s;
}

BeamSection BeamSection::rectangle(double width, double height) {
  BeamSection s;
  s.A = width * height;
  s.Iy = width * height * height * height / 12.0;
  s.Iz = height * width * width * width / 12.0;
  const double a = std::max(width, height), b = std::min(width, height);
  const double ratio = a > 0.0 ? b / a : 0.0;
  s.J = a * b * b * b * (1.0 / 3.0 - 0.21 * ratio * (1.0 - std::pow(ratio, 4) / 12.0));
  return s;
}

bool FeModel::has_beams() const noexcept {
  return std::any_of(elements.begin(), elements.end(),
                     [](const Element& e) { return e.type == ElementType::beam2; });
}

int FeModel::find_node(const std::string& name) const noexcept {
  const auto it = std::find(node_names.begin(), node_names.end(), name);
  return it == node_names.end() ? -1 : static_cast<int>(it - node_names.begin());
}

std::string FeModel::node_label(int node) const {
  const std::size_t k = static_cast<std::size_t>(node);
  if (k < node_names.size() && !node_names[k].empty()) return "node '" + node_names[k] + "'";
  return "node " + std::to_string(k < node_ids.size() ? node_ids[k] : node);
}

std::string FeModel::element_label(int element) const {
  const Element& e = elements[static_cast<std::size_t>(element)];
  if (!e.name.empty()) return e.name;
  return "element " + std::to_string(e.id > 0 ? e.id : element) + " (" +
         element_kernel(e.type).name + ")";
}

SourceMark FeModel::mark(const FeSource& source) const {
  if (source.file < 0 || static_cast<std::size_t>(source.file) >= files.size()) return {};
  return {files[static_cast<std::size_t>(source.file)], source.line, 0};
}

void validate(const FeModel& model) {
  Faults faults;
  const auto add = [&](const std::string& text) { faults.add({}, text); };
  if (model.nodes() == 0) add("the finite-element model has no nodes");
  if (!model.node_names.empty() && model.node_names.size() != model.positions.size()) {
    add("the finite-element model has " + std::to_string(model.node_names.size()) +
        " node names for " + std::to_string(model.positions.size()) + " nodes");
  }
  for (int k = 0; k < model.nodes(); ++k) {
    if (!model.positions[static_cast<std::size_t>(k)].allFinite()) {
      add(model.node_label(k) + " has a position that is not finite");
    }
  }
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const Material& m = model.materials[i];
    const std::string label = "material " + std::to_string(i);
    if (!(m.young > 0.0) || !std::isfinite(m.young))
      add(label + ": Young's modulus must be positive");
    if (!(m.density >= 0.0) || !std::isfinite(m.density))
      add(label + ": the density must not be negative");
    if (!(m.poisson > -1.0 && m.poisson < 0.5)) {
      add(label + ": Poisson's ratio must lie between -1 and 0.5");
    }
  }
  const auto in_range = [](int i, std::size_t size) {
    return i >= 0 && static_cast<std::size_t>(i) < size;
  };
  const bool sound_so_far = faults.empty();
  for (int e = 0; e < static_cast<int>(model.elements.size()); ++e) {
    const Element& element = model.elements[static_cast<std::size_t>(e)];
    const ElementKernel& kernel = element_kernel(element.type);
    bool sound = sound_so_far;
    for (int a = 0; a < kernel.nodes; ++a) {
      const int node = element.nodes[static_cast<std::size_t>(a)];
      if (!in_range(node, model.positions.size())) {
        add(model.element_label(e) + ": node index " + std::to_string(node) +
            " is out of range 0.." + std::to_string(model.nodes() - 1));
        sound = false;
      }
    }
    if (!in_range(element.material, model.materials.size())) {
      add(model.element_label(e) + ": there is no material " + std::to_string(element.material));
      sound = false;
    }
    if (element.type == ElementType::beam2 && !in_range(element.section, model.sections.size())) {
      add(model.element_label(e) + ": there is no section " + std::to_string(element.section));
      sound = false;
    }
    if (!sound) continue;
    const std::string fault = kernel.fault(gather(model, element));
    if (!fault.empty()) add(model.element_label(e) + " " + fault);
  }
  for (std::size_t i = 0; i < model.masses.size(); ++i) {
    const PointMass& m = model.masses[i];
    const std::string label = "point mass " + std::to_string(i);
    if (!in_range(m.node, model.positions.size())) {
      add(label + ": node index " + std::to_string(m.node) + " is out of range");
      continue;
    }
    if (!(m.mass >= 0.0) || !std::isfinite(m.mass)) {
      add(label + " on " + model.node_label(m.node) + ": the mass must not be negative");
    }
    if (!m.J.allFinite() ||
        (m.J - m.J.transpose()).cwiseAbs().maxCoeff() > 1e-12 * m.J.cwiseAbs().maxCoeff()) {
      add(label + " on " + model.node_label(m.node) + ": the inertia must be finite and symmetric");
      continue;
    }
    const Mat3 P = 0.5 * m.J.trace() * Mat3::Identity() - m.J;
    const double least =
        Eigen::SelfAdjointEigenSolver<Mat3>(P, Eigen::EigenvaluesOnly).eigenvalues()(0);
    if (least < -1e-12 * m.J.trace()) {
      add(label + " on " + model.node_label(m.node) +
          ": the principal moments of inertia break the triangle inequality");
    }
    if (m.J.cwiseAbs().maxCoeff() > 0.0 && !model.has_beams()) {
      add(label + " on " + model.node_label(m.node) +
          " has rotary inertia, but the nodes of solid elements have no rotations");
    }
  }
  faults.throw_if_any();
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void scatter(const Element& element, const ElementKernel& kernel, int dofs_per_node,
             const MatX& matrix, Triplets& triplets) {
  const int d = kernel.dofs_per_node;
  const auto row = [&](int i) {
    return element.nodes[static_cast<std::size_t>(i / d)] * dofs_per_node + i % d;
  };
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < matrix.cols(); ++j) {
      if (matrix(i, j) != 0.0) triplets.emplace_back(row(i), row(j), matrix(i, j));
    }
  }
}

}  // namespace

SparseMatrix assemble_stiffness(const FeModel& model) {
  const int d = model.dofs_per_node();
  Triplets triplets;
  MatX matrix;
  for (const Element& element : model.elements) {
    const ElementKernel& kernel = element_kernel(element.type);
    kernel.stiffness(gather(model, element), matrix);
    scatter(element, kernel, d, matrix, triplets);
  }
  SparseMatrix K(d * model.nodes(), d * model.nodes());
  K.setFromTriplets(triplets.begin(), triplets.end());
  return K;
}

SparseMatrix assemble_mass(const FeModel& model, bool section_inertia, int d) {
  Triplets triplets;
  MatX matrix;
  for (const Element& element : model.elements) {
    const ElementKernel& kernel = element_kernel(element.type);
    kernel.mass(gather(model, element), section_inertia, matrix);
    scatter(element, kernel, d, matrix, triplets);
  }
  for (const PointMass& p : model.masses) {
    for (int i = 0; i < 3; ++i) {
      triplets.emplace_back(d * p.node + i, d * p.node + i, p.mass);
      for (int j = 0; j < 3 && d == 6; ++j) {
        if (p.J(i, j) != 0.0)
          triplets.emplace_back(d * p.node + 3 + i, d * p.node + 3 + j, p.J(i, j));
      }
    }
  }
  SparseMatrix M(d * model.nodes(), d * model.nodes());
  M.setFromTriplets(triplets.begin(), triplets.end());
  return M;
}

SparseRows assemble_scalar_mass(const FeModel& model) {
  Triplets triplets;
  MatX matrix;
  for (const Element& element : model.elements) {
    const ElementKernel& kernel = element_kernel(element.type);
    kernel.scalar_mass(gather(model, element), matrix);
    for (int i = 0; i < kernel.nodes; ++i) {
      for (int j = 0; j < kernel.nodes; ++j) {
        triplets.emplace_back(element.nodes[static_cast<std::size_t>(i)],
                              element.nodes[static_cast<std::size_t>(j)], matrix(i, j));
      }
    }
  }
  for (const PointMass& p : model.masses) triplets.emplace_back(p.node, p.node, p.mass);
  SparseRows M(model.nodes(), model.nodes());
  M.setFromTriplets(triplets.begin(), triplets.end());
  return M;
}

}  // namespace floatframe

#include "floatframe/fe/fe_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/lumped_mass.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {

BeamSection BeamSection::solid_round(double d) { return hollow_round(d, 0.0); }

BeamSection BeamSection::hollow_round(double outer, double inner) {
  BeamSection s;
  s.A = std::numbers::pi / 4.0 * (outer * outer - inner * inner);
  s.Iy = s.Iz = std::numbers::pi / 64.0 * (std::pow(outer, 4) - std::pow(inner, 4));
  s.J = 2.0 * s.Iy;
  s.outline = BeamSection::Outline::round;
  s.width = s.height = outer;
  s.bore = inner;
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
  s.outline = BeamSection::Outline::rectangle;
  s.width = width;
  s.height = height;
  return s;
}

bool FeMatrices::is_scalar(int node) const {
  return std::binary_search(scalars.begin(), scalars.end(), node);
}

int FeModel::places() const noexcept {
  return nodes() - (matrices ? static_cast<int>(matrices->scalars.size()) : 0);
}

bool FeModel::has_beams() const noexcept {
  return std::any_of(elements.begin(), elements.end(),
                     [](const FeElement& e) { return element_kernel(e.type).dofs_per_node == 6; });
}

int FeModel::find_node(const std::string& name) const noexcept {
  const auto it = std::find(node_names.begin(), node_names.end(), name);
  return it == node_names.end() ? -1 : static_cast<int>(it - node_names.begin());
}

std::string FeModel::node_label(int node) const {
  const std::size_t k = node;
  if (k < node_names.size() && !node_names[k].empty()) return "node '" + node_names[k] + "'";
  return "node " + std::to_string(k < node_ids.size() ? node_ids[k] : node);
}

std::string FeModel::element_label(int element) const {
  const FeElement& e = elements[element];
  if (!e.name.empty()) return e.name;
  return "element " + std::to_string(e.id > 0 ? e.id : element) + " (" + fe_element_name(e.type) +
         ")";
}

std::string FeModel::spring_label(int spring) const {
  const std::string& name = springs[spring].name;
  return name.empty() ? "spring " + std::to_string(spring) : name;
}

SourceMark FeModel::mark(const FeSource& source) const {
  if (source.file < 0 || static_cast<std::size_t>(source.file) >= files.size()) return {};
  return {files[source.file], source.line, 0};
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void scatter(const FeElement& element, const ElementKernel& kernel, int dofs_per_node,
             const MatX& matrix, Triplets& triplets) {
  const int d = kernel.dofs_per_node;
  const auto row = [&](int i) { return element.nodes[i / d] * dofs_per_node + i % d; };
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
  for (const FeElement& element : model.elements) {
    const ElementKernel& kernel = element_kernel(element.type);
    kernel.stiffness(gather(model, element), matrix);
    scatter(element, kernel, d, matrix, triplets);
  }
  if (!model.springs.empty()) {
    for (const SpringBlock& block : spring_system(model, dof_table(model)).blocks)
      for (std::size_t i = 0; i < block.dofs.size(); ++i)
        for (std::size_t j = 0; j < block.dofs.size(); ++j)
          triplets.emplace_back(
              d * block.dofs[i].node + block.dofs[i].axis,
              d * block.dofs[j].node + block.dofs[j].axis,
              block.K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }
  SparseMatrix K(d * model.nodes(), d * model.nodes());
  K.setFromTriplets(triplets.begin(), triplets.end());
  return K;
}

SparseMatrix assemble_mass(const FeModel& model, bool section_inertia, int d) {
  Triplets triplets;
  MatX matrix;
  for (const FeElement& element : model.elements) {
    const ElementKernel& kernel = element_kernel(element.type);
    mass_matrix(kernel, gather(model, element), section_inertia, matrix);
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
  for (const FeElement& element : model.elements) {
    const ElementKernel& kernel = element_kernel(element.type);
    scalar_mass_matrix(kernel, gather(model, element), matrix);
    for (int i = 0; i < kernel.nodes; ++i) {
      for (int j = 0; j < kernel.nodes; ++j) {
        triplets.emplace_back(element.nodes[i], element.nodes[j], matrix(i, j));
      }
    }
  }
  for (const PointMass& p : model.masses) triplets.emplace_back(p.node, p.node, p.mass);
  SparseRows M(model.nodes(), model.nodes());
  M.setFromTriplets(triplets.begin(), triplets.end());
  return M;
}

}  // namespace floatframe

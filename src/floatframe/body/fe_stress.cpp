#include "floatframe/body/fe_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/section_points.hpp"

namespace floatframe {
namespace {

/// Shells with a larger angle at a node form an edge, where a mean would be meaningless.
const double least_cosine = std::cos(20.0 * std::numbers::pi / 180.0);

Vec3 shell_normal(const ElementInput& in, int nodes) {
  const bool triangle = nodes % 3 == 0;
  const Vec3 first = in.p[triangle ? 1 : 2] - in.p[0];
  return first.cross(in.p[triangle ? 2 : 3] - in.p[triangle ? 0 : 1]).normalized();
}

/// Axes at one end of a beam.
Mat3 end_axes(ElementInput in, int nodes, int end) {
  if (end == 1) {
    in.p[0] = in.p[nodes - 2];
    in.p[1] = in.p[nodes - 1];
  }
  return beam_axes(in);
}

/// sigma_xx, tau_xy, tau_xz of local axes T as xx yy zz xy yz zx of the body.
Eigen::Matrix<double, 6, 3> from_beam_axes(const Mat3& T) {
  constexpr int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  Eigen::Matrix<double, 6, 3> turn;
  for (int c = 0; c < 6; ++c) {
    const int i = at[c][0], j = at[c][1];
    turn(c, 0) = T(i, 0) * T(j, 0);
    for (int k = 1; k < 3; ++k) turn(c, k) = T(i, 0) * T(j, k) + T(j, 0) * T(i, k);
  }
  return turn;
}

}  // namespace

StressRecovery::StressRecovery(const FeModel& model, const std::vector<int>& surface,
                               ElementMass mass)
    : model_(model),
      mass_(mass),
      shares_(model.elements.size()),
      first_section_(model.elements.size(), -1),
      sides_(surface.size()),
      solids_(surface.size()) {
  std::vector<int> point_of(model.positions.size(), -1);
  for (std::size_t i = 0; i < surface.size(); ++i) point_of[surface[i]] = static_cast<int>(i);
  const auto count = static_cast<int>(model.elements.size());
  for (int e = 0; e < count; ++e) {
    switch (element_kernel(model.elements[e].type).family) {
      case ElementFamily::solid:
        add_solid(e, point_of);
        break;
      case ElementFamily::shell:
      case ElementFamily::membrane:
        add_shell(e, point_of);
        break;
      case ElementFamily::beam:
        add_beam(e);
        break;
      case ElementFamily::rod:
      case ElementFamily::panel:
        break;
    }
  }
  if (!layout_.sections.empty())
    layout_.first_place.push_back(static_cast<int>(layout_.places.size()));
}

int StressRecovery::number_of(int node) const {
  return model_.node_ids.empty() ? node + 1 : model_.node_ids[node];
}

int StressRecovery::group_of(const FeElement& element, int ply) {
  const ElementFamily family = element_kernel(element.type).family;
  const int material =
      ply < 0 ? element.material : model_.layups[element.layup].plies[ply].material;
  const int section = family == ElementFamily::solid ? element.layup : element.section;
  const std::array<int, 4> key{material, static_cast<int>(family), section, ply};
  const auto it = std::find(group_keys_.begin(), group_keys_.end(), key);
  if (it != group_keys_.end()) return static_cast<int>(it - group_keys_.begin());
  group_keys_.push_back(key);
  const Material& m = model_.materials[material];
  const auto named = static_cast<std::size_t>(material) < model_.material_names.size();
  const bool isotropic = family == ElementFamily::shell || family == ElementFamily::membrane
                             ? is_plain(model_.shells[element.section], m)
                             : !m.elasticity;
  layout_.groups.push_back({named ? model_.material_names[material] : std::string(),
                            isotropic ? m.young : 0.0, isotropic ? m.poisson : 0.0});
  return static_cast<int>(group_keys_.size()) - 1;
}

void StressRecovery::add_solid(int e, const std::vector<int>& point_of) {
  const FeElement& element = model_.elements[e];
  const ElementKernel& kernel = element_kernel(element.type);
  ElementInput in;  // of an element of plies
  int group = -1;
  for (int a = 0; a < kernel.nodes; ++a) {
    const int point = point_of[element.nodes[a]];
    if (point < 0) continue;
    if (element.layup >= 0) {
      if (in.plies.empty()) in = gather(model_, element);
      group = group_of(element, kernel.nodal_ply(in, a).ply);
    } else if (group < 0) {
      group = group_of(element);
    }
    std::vector<int>& known = solids_[point];
    auto it = std::find_if(known.begin(), known.end(),
                           [&](int place) { return layout_.places[place].group == group; });
    if (it == known.end()) {
      it = known.insert(known.end(), static_cast<int>(layout_.places.size()));
      layout_.places.push_back({.layer = StressPlace::Layer::solid,
                                .point = point,
                                .node = element.nodes[a],
                                .number = number_of(element.nodes[a]),
                                .group = group,
                                .p = model_.positions[element.nodes[a]]});
      elements_at_.push_back(0);
    }
    ++elements_at_[*it];
    shares_[e].push_back({a, *it, -1});
  }
}

void StressRecovery::add_shell(int e, const std::vector<int>& point_of) {
  const FeElement& element = model_.elements[e];
  const int nodes = element_kernel(element.type).nodes;
  const int group = group_of(element);
  const Vec3 normal = shell_normal(gather(model_, element), nodes);
  for (int a = 0; a < nodes; ++a) {
    const int point = point_of[element.nodes[a]];
    if (point < 0) continue;
    auto& known = sides_[point];
    auto it = std::find_if(known.begin(), known.end(), [&](const auto& side) {
      return side.first == group && std::abs(side.second.normal.dot(normal)) > least_cosine;
    });
    if (it == known.end()) {
      const int place = static_cast<int>(layout_.places.size());
      it = known.insert(known.end(), {group, {place, normal}});
      const ShellSection& section = model_.shells[element.section];
      const Vec3 half = 0.5 * section.thickness * normal, middle = section.offset * normal;
      for (const double side : {1.0, -1.0}) {
        layout_.places.push_back(
            {.layer = side > 0.0 ? StressPlace::Layer::top : StressPlace::Layer::bottom,
             .point = point,
             .node = element.nodes[a],
             .number = number_of(element.nodes[a]),
             .group = group,
             .p = model_.positions[element.nodes[a]] + middle + side * half});
        elements_at_.push_back(0);
      }
    }
    const bool same = it->second.normal.dot(normal) > 0.0;
    const int top = it->second.place + (same ? 0 : 1), bottom = it->second.place + (same ? 1 : 0);
    ++elements_at_[top];
    ++elements_at_[bottom];
    shares_[e].push_back({a, top, bottom});
  }
}

void StressRecovery::add_beam(int e) {
  const FeElement& element = model_.elements[e];
  const int nodes = element_kernel(element.type).nodes;
  const int group = group_of(element);
  const ElementInput in = gather(model_, element);
  const std::vector<SectionPoint> points = section_points(in.section);
  first_section_[e] = static_cast<int>(layout_.sections.size());
  for (int end = 0; end < 2; ++end) {
    const int node = element.nodes[end == 0 ? 0 : nodes - 1];
    layout_.sections.push_back(
        {e, node, number_of(node), end, model_.positions[node], model_.element_label(e)});
    layout_.first_place.push_back(static_cast<int>(layout_.places.size()));
    const Mat3 T = end_axes(in, nodes, end);
    for (const SectionPoint& p : points) {
      layout_.places.push_back({.layer = StressPlace::Layer::section,
                                .node = node,
                                .number = number_of(node),
                                .group = group,
                                .p = model_.positions[node] + T * Vec3(0.0, p.y, p.z)});
      elements_at_.push_back(1);
    }
  }
}

void StressRecovery::recover_surface(int e, const StressFields& fields, MatX& sum) const {
  const FeElement& element = model_.elements[e];
  const ElementKernel& kernel = element_kernel(element.type);
  const ElementInput in = gather(model_, element);
  MatX B, q;
  element_displacements(element, kernel, fields.displacements, q);
  const auto add = [&](int place, const Eigen::Matrix<double, 6, Eigen::Dynamic>& S) {
    // Fields as rows, so that the data of a place are contiguous.
    sum.middleCols<6>(6 * static_cast<Eigen::Index>(place)).noalias() +=
        (q.transpose() * S.transpose()) / elements_at_[place];
  };
  if (kernel.layer_stresses) {
    kernel.layer_stresses(in, B);
    for (const Share& s : shares_[e]) {
      add(s.place, B.middleRows<6>(12 * s.local));
      add(s.other, B.middleRows<6>(12 * s.local + 6));
    }
  } else {
    kernel.nodal_strains(in, B);
    for (const Share& s : shares_[e]) {
      const Mat6 D =
          in.plies.empty() ? elasticity_at(in, in.p[s.local]) : kernel.nodal_ply(in, s.local).D;
      add(s.place, D * B.middleRows<6>(6 * s.local));
    }
  }
}

void StressRecovery::recover_beam(int e, const StressFields& fields, Recovered& out) const {
  const FeElement& element = model_.elements[e];
  const ElementKernel& kernel = element_kernel(element.type);
  const ElementInput in = gather(model_, element);
  MatX K, M, q, a;
  element_displacements(element, kernel, fields.displacements, q);
  kernel.stiffness(in, K);
  MatX f = K * q;
  if (fields.linear > 0 || fields.density.U.cols() > 0) {
    element_mass(kernel, in, mass_, M);
    if (fields.linear > 0) {
      linear_fields(in, kernel.nodes, 6, true, a);
      f.leftCols(fields.linear) -= M * a;
    }
    if (fields.density.U.cols() > 0) {
      element_displacements(element, kernel, fields.density, a);
      f.middleCols(fields.linear, a.cols()) -= M * a;
    }
  }
  for (int end = 0; end < 2; ++end) {
    const int s = first_section_[e] + end;
    const Mat3 T = end_axes(in, kernel.nodes, end);
    const double sign = end == 0 ? -1.0 : 1.0;
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(end == 0 ? 0 : kernel.nodes - 1);
    MatX forces(6, f.cols());
    forces.topRows<3>() = sign * T.transpose() * f.middleRows<3>(row);
    forces.bottomRows<3>() = sign * T.transpose() * f.middleRows<3>(row + 3);
    out.sections.middleRows<6>(6 * static_cast<Eigen::Index>(s)) = forces;
    const Eigen::Matrix<double, 6, 3> turn = from_beam_axes(T);
    Eigen::Index place = layout_.first_place[s];
    for (const SectionPoint& p : section_points(in.section))
      out.places.middleRows<6>(6 * place++) = turn * p.S * forces;
  }
}

StressRecovery::Recovered StressRecovery::recover(const StressFields& fields) const {
  const Eigen::Index columns = fields.displacements.U.cols();
  const auto places = static_cast<Eigen::Index>(layout_.places.size());
  MatX sum = MatX::Zero(columns, 6 * places);
  const auto count = static_cast<int>(model_.elements.size());
  for (int e = 0; e < count; ++e)
    if (!shares_[e].empty()) recover_surface(e, fields, sum);
  Recovered out;
  out.places = sum.transpose();
  out.sections = MatX::Zero(6 * static_cast<Eigen::Index>(layout_.sections.size()), columns);
  for (int e = 0; e < count; ++e)
    if (first_section_[e] >= 0) recover_beam(e, fields, out);
  return out;
}

}  // namespace floatframe

#include "floatframe/reduction/part_stress.hpp"

#include "floatframe/body/fe_stress.hpp"
#include "floatframe/fe/body_loads.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

static_assert(body_load_cases == linear_load_cases);

/// Nodes held by a rigid spider or a single interface node, and nodes that share an element with
/// them: the stress there is that of a support that the real part does not have. For mean spiders
/// only the nodes.
std::vector<char> doubtful_nodes(const FeModel& model) {
  std::vector<char> held(model.positions.size(), 0), out(model.positions.size(), 0);
  for (const Spider& s : model.spiders) {
    std::vector<char>& marked = s.kind == Spider::Kind::rigid ? held : out;
    for (const int k : s.nodes) marked[k] = 1;
    marked[s.reference] = 1;
  }
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    if (kernel.family == ElementFamily::beam || kernel.family == ElementFamily::rod) continue;
    bool near = false;
    for (int a = 0; a < kernel.nodes; ++a) near = near || held[e.nodes[a]] != 0;
    for (int a = 0; near && a < kernel.nodes; ++a) out[e.nodes[a]] = 1;
  }
  return out;
}

}  // namespace

MatX body_load_response(const FeModel& model, const FeSystem& system, const MatX& X,
                        const std::optional<FixedInterface>& fixed,
                        const std::optional<FreeStructure>& structure, const Eigenpairs& elastic,
                        Integration integration) {
  MatX F(system.size(), body_load_cases + X.cols());
  {
    const NodalShapes loads = linear_loads(model, ElementMass::section_inertia, integration);
    F.leftCols<body_load_cases>() = system.T.transpose() * loads.U;
    F.leftCols<body_load_cases>() += system.T_theta.transpose() * loads.Theta;
  }
  F.rightCols(X.cols()) = system.M * X;
  return fixed ? fixed->inner_response(F) : structure->relieved_response(F, elastic);
}

std::shared_ptr<const BodyStress> part_stress(const FeModel& model, const FeSystem& system,
                                              const std::vector<int>& surface, const MatX& X,
                                              const MatX& K_y, MatX response) {
  const StressRecovery recovery(model, surface);
  auto out = std::make_shared<BodyStress>(recovery.layout());
  if (out->places.empty() && out->sections.empty()) return nullptr;
  const std::vector<char> doubtful = doubtful_nodes(model);
  for (StressPlace& place : out->places)
    place.doubtful = place.layer != StressPlace::Layer::section && doubtful[place.node] != 0;
  StressFields modes;
  modes.displacements = {system.T * X, system.T_theta * X};
  StressRecovery::Recovered found = recovery.recover(modes);
  out->modes = std::move(found.places);
  out->section_modes = std::move(found.sections);
  if (response.size() == 0) return out;
  response -= X * ldlt_solve(K_y, X.transpose() * (system.K * response));
  StressFields loads;
  loads.displacements = {system.T * response, system.T_theta * response};
  loads.linear = body_load_cases;
  loads.density = std::move(modes.displacements);
  found = recovery.recover(loads);
  out->loads = std::move(found.places);
  out->section_loads = std::move(found.sections);
  return out;
}

}  // namespace floatframe

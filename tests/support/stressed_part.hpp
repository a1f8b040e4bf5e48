#pragma once
// A reduced part together with all that a direct solution of its finite elements needs.
#include <initializer_list>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/body/fe_stress.hpp"
#include "floatframe/fe/body_loads.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/reduction/fixed_interface.hpp"
#include "floatframe/reduction/part_places.hpp"

namespace floatframe::test {

struct StressedPart {
  FeModel model;
  FeSystem system;
  std::vector<InterfacePlace> interfaces;
  ReducedPart reduced;
  MatX X;  ///< modes, n x nm
  MatX F;  ///< loads, n x (12 + nm)

  StressedPart(FeModel given, PartOptions options) : model(std::move(given)) {
    options.keep_projection = true;
    options.check_free_modes = false;
    reduced = reduce_part(model, options);
    validate(model);
    interfaces = place_interfaces(model, options);
    system = assemble(model);
    find_rows(model, system, interfaces);
    const MatX& U = reduced.body.projection->X;
    X.resize(system.size(), reduced.body.modes());
    for (int row = 0; row < system.size(); ++row) {
      const Dof dof = system.dofs[row];
      if (dof.axis < 3) {
        X.row(row) = U.row(3 * dof.node + dof.axis);
        continue;
      }
      for (std::size_t k = 0; k < interfaces.size(); ++k)
        if (interfaces[k].node == dof.node)
          X.row(row) = reduced.body.nodes[k].X_theta.row(dof.axis - 3);
    }
    F.resize(system.size(), body_load_cases + X.cols());
    const NodalShapes loads = linear_loads(model);
    F.leftCols<body_load_cases>() =
        system.T.transpose() * loads.U + system.T_theta.transpose() * loads.Theta;
    F.rightCols(X.cols()) = system.M * X;
  }

  const BodyStress& stress() const { return *reduced.body.stress; }

  std::vector<int> rows_of(std::initializer_list<int> which) const {
    std::vector<int> out;
    for (const int k : which)
      out.insert(out.end(), interfaces[k].rows.begin(), interfaces[k].rows.end());
    return out;
  }

  /// Displacements under `f` with some rows held where `place` has them.
  VecX solve(const VecX& f, const std::vector<int>& held, const VecX& place) const {
    VecX u = VecX::Zero(system.size());
    for (const int row : held) u(row) = place(row);
    const SparseMatrix none(system.size(), system.size());
    const FixedInterface full(system.K, none, {}, held, [](int) { return std::string(); });
    return u + full.inner_response(f - system.K * u);
  }
  /// Held at rest; `f` with the reactions afterwards.
  VecX solve(VecX& f, const std::vector<int>& held) const {
    const VecX u = solve(f, held, VecX::Zero(system.size()));
    f = system.K * u;
    return u;
  }

  VecX stress_of(const VecX& u) const {
    StressFields fields;
    fields.displacements = {system.T * u, system.T_theta * u};
    return StressRecovery(model, reduced.surface.nodes).recover(fields).places.col(0);
  }
};

}  // namespace floatframe::test

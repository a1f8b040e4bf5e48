#pragma once
// Stress of a reduced part (body/body_stress.hpp): that of its modes, and that of its own loads.
//
// A load f acts on the part with the forces of its interfaces, and all of them balance: K u = f.
// The modes give the static response X K_y^-1 X^T f. The remainder,
//   r = w - X K_y^-1 X^T K w,   w = (0, K_ii^-1 f_i)
// does not move the interfaces and adds its stress (mode acceleration): constraint modes represent
// forces at interfaces exactly, so that r of w, of the part held there, is that of every static
// response. Modes of the free part represent interfaces by residual flexibility (Craig-Chang); w is
// then the response with inertia relief. Without residual modes the stress near interfaces is that
// of the modes.
//
// Loads: rho e_j, rho r_i e_j (fe/body_loads.hpp) and the mass times each mode.
#include <memory>
#include <optional>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/reduction/fixed_interface.hpp"
#include "floatframe/reduction/free_structure.hpp"
#include "floatframe/reduction/part.hpp"

namespace floatframe {

/// w of all loads, n x (12 + nm). X: the modes in all rows of the system.
MatX body_load_response(const FeModel& model, const FeSystem& system, const MatX& X,
                        const std::optional<FixedInterface>& fixed,
                        const std::optional<FreeStructure>& structure, const Eigenpairs& elastic,
                        Integration integration);

/// `K_y`: modal stiffness. `response`: of body_load_response; empty: no loads.
std::shared_ptr<const BodyStress> part_stress(const FeModel& model, const FeSystem& system,
                                              const std::vector<int>& surface, const MatX& X,
                                              const MatX& K_y, MatX response);

}  // namespace floatframe

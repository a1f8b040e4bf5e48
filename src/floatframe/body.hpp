#pragma once
// Rigid and flexible bodies: the 16 inertia integrals, modal stiffness and damping, nodes, and the
// inertia terms of a moving body by both methods; the integrals of nodes or elements with any
// modes; simple solids for their pictures. Body files belong to part.hpp.
#include "floatframe/body/check_invariants.hpp"
#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/body/modal_damping.hpp"
#include "floatframe/body/solid_shapes.hpp"
#include "floatframe/inertia/inertia_terms.hpp"

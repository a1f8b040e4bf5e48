#pragma once
// Mass of an element by Element::mass_form. Lumped, with the scalar mass M_s = int N N^T dm:
//   m_a = sum_b M_s(a, b)                        elements without nodes on their edges
//   m_a = M_s(a, a) sum(M_s) / trace(M_s)        with them (Hinton, Rock, Zienkiewicz 1976), where
//                                                sums of rows may be negative
// and the rotary inertia of a node m_a times that of a unit mass: for a beam T diag(Iy + Iz, Iy,
// Iz) T^T / A, for a shell that of its thickness. Mass and centre of mass are exact for elements
// whose rows are summed, the total for all; moments of inertia are those of the masses at the
// nodes, larger than those of the body by a part that falls with the square of the elements' size
// (a bar as one element: m L^2/4 about its middle in place of m L^2/12).
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

/// Of all degrees of freedom, in body axes.
void mass_matrix(const ElementKernel& kernel, const ElementInput& in, bool section_inertia,
                 MatX& out);
/// nodes x nodes; without rotary inertia.
void scalar_mass_matrix(const ElementKernel& kernel, const ElementInput& in, MatX& out);

/// Does the element have nodes on its edges?
bool quadratic(FeElementType type) noexcept;

}  // namespace floatframe

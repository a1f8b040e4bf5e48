#pragma once
// All finite elements. One entry is the enumerator of FeElementType, the word of messages and the
// name of the ElementKernel `<name>_kernel` in a source file of fe/elements. Other code iterates
// over this list.
//
// Node order of the solids is that of Abaqus and VTK: corners first, then the mid-side nodes.
#include "floatframe/core/enum_index.hpp"

// clang-format off
#define FLOATFRAME_FE_ELEMENTS(entry)                                                          \
  entry(beam2)    /* 2-node beam, exact for loads at its ends; with shear if its section has */ \
  entry(beam3)    /* 3-node Timoshenko beam: end, middle, end */                            \
  entry(rod2)     /* 2-node rod: axial force only */                                        \
  entry(tri3)     /* 3-node flat shell */                                                   \
  entry(quad4)    /* 4-node flat shell */                                                   \
  entry(tri6)     /* 6-node shell, divided into four of 3 nodes; edges 12 23 31 */          \
  entry(quad8)    /* 8-node shell, divided into triangles; edges 12 23 34 41 */             \
  entry(shear4)   /* 4-node shear panel: shear flow of its edges only */                    \
  entry(membrane3)  /* 3-node membrane: forces in its plane only */                        \
  entry(membrane4)  /* 4-node membrane, full integration */                                \
  entry(membrane4s) /* the same, shear strain of its middle (good in plane bending) */     \
  entry(membrane6)  /* 6-node membrane; edges 12 23 31 */                                  \
  entry(membrane8)  /* 8-node membrane; edges 12 23 34 41 */                               \
  entry(membrane8r) /* the same, 2 x 2 points */                                           \
  entry(tet4)     /* linear tetrahedron */                                                  \
  entry(tet10)    /* quadratic tetrahedron; edges 12 23 13 14 24 34 */                      \
  entry(hex8)     /* trilinear brick, full integration */                                   \
  entry(hex8i)    /* the same with incompatible modes (good in bending) */                  \
  entry(hex8r)    /* the same, one point, with stabilised hourglass modes */                \
  entry(hex20)    /* quadratic brick, 3 x 3 x 3 points; edges as in the file */             \
  entry(hex20r)   /* the same, stiffness with 2 x 2 x 2 points */                           \
  entry(wedge6)   /* linear wedge */                                                        \
  entry(wedge15)  /* quadratic wedge; edges 12 23 31 45 56 64 14 25 36 */                   \
  entry(pyramid5) /* linear pyramid, base and apex */                                       \
  entry(pyramid13) /* quadratic pyramid; edges 12 23 34 41 15 25 35 45 */
// clang-format on

namespace floatframe {

#define FLOATFRAME_ENUMERATOR(name) name,
enum class FeElementType { FLOATFRAME_FE_ELEMENTS(FLOATFRAME_ENUMERATOR) };
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_ENUMERATOR(name) FeElementType::name,
inline constexpr FeElementType fe_element_types[] = {FLOATFRAME_FE_ELEMENTS(FLOATFRAME_ENUMERATOR)};
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_WORD(name) #name,
inline constexpr const char* fe_element_words[] = {FLOATFRAME_FE_ELEMENTS(FLOATFRAME_WORD)};
#undef FLOATFRAME_WORD

constexpr const char* fe_element_name(FeElementType type) noexcept {
  return fe_element_words[index_of(type)];
}

}  // namespace floatframe

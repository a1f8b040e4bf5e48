#pragma once
// Stiffness and mass as matrices of other programs, with a map of degrees of freedom and the nodes.
//   CalculiX       job.sti, job.mas, job.dof of *FREQUENCY, SOLVER=MATRIXSTORAGE
//   Abaqus         job_STIF1.mtx, job_MASS1.mtx of *MATRIX GENERATE: lines "node, direction, node,
//                  direction, value"; or "row column value" with a map; viscous damping
//                  job_DMPV1.mtx
//   Matrix Market  arm_K.mtx, arm_M.mtx with arm_dofs.csv ("node,dir") and arm_nodes.csv
//                  ("node,x,y,z"); viscous damping arm_C.mtx
// FeReadOptions gives the files that are not next to the stiffness under these names. The nodes
// may also come from any finite-element file.
#include <string_view>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

bool looks_like_calculix_matrix(std::string_view beginning);
bool looks_like_abaqus_matrix(std::string_view beginning);
bool looks_like_matrix_market(std::string_view beginning);

FeModel read_calculix_matrices(const std::filesystem::path& file, const FeReadOptions& options);
FeModel read_abaqus_matrices(const std::filesystem::path& file, const FeReadOptions& options);
FeModel read_matrix_market(const std::filesystem::path& file, const FeReadOptions& options);

/// The same from texts. `dofs` may be null for Abaqus matrices with labels, `damping` always.
FeModel read_calculix_matrices(TextSource& stiffness, TextSource& mass, TextSource& dofs,
                               FeModel nodes, TextSource* damping = nullptr);
FeModel read_abaqus_matrices(TextSource& stiffness, TextSource& mass, TextSource* dofs,
                             FeModel nodes, TextSource* damping = nullptr);
FeModel read_matrix_market(TextSource& stiffness, TextSource& mass, TextSource& dofs, FeModel nodes,
                           TextSource* damping = nullptr);

}  // namespace floatframe

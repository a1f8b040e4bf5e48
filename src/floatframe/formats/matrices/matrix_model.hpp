#pragma once
// What all formats of matrices share: the nodes behind the rows, the map of degrees of freedom, the
// files beside the stiffness, and the model made of them.
#include <filesystem>
#include <string>
#include <vector>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/matrices/matrix_entries.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// One row of the matrices as the file says it: node number, direction 1..6; 0: a scalar point, the
/// amplitude of a mode.
struct DofLabel {
  int node = 0, direction = 0;
  FeSource at;
};

/// "12.3" of CalculiX, "12,3" (CSV), or "1 12 UZ" with the number of the row (mapping of ANSYS);
/// `#` comments and a first line of words are ignored.
std::vector<DofLabel> read_dof_labels(TextSource& source);
/// "12.3", for messages.
std::vector<std::string> dof_names(const std::vector<DofLabel>& labels);

/// Nodes of a CSV "node,x,y,z" (`#` comments, a first line of words is ignored).
FeModel read_node_table(TextSource& source);
/// Nodes, sets and supports of any finite-element file, or of a CSV.
FeModel read_nodes(const std::filesystem::path& file);

/// Stiffness, mass and the nodes they belong to. Rows on the rotation node of a deck's spider are
/// rotations of its reference. Spiders and equations of the deck are in the matrices already: the
/// nodes that follow a spider and have no rows are left out, and so are their sets.
/// `labels_source` for the places of errors and the names of files.
FeModel matrix_model(FeModel nodes, const std::vector<DofLabel>& labels, SparseMatrix K,
                     SparseMatrix M, TextSource& labels_source,
                     const std::vector<std::string>& other_files);

/// The entries of a matrix of n rows; `map` names the file that says n.
using MatrixReader = SymmetricEntries (*)(TextSource& source, const std::string& what, int n,
                                          const std::string& map);
/// The same from texts and a map of the rows. With `mass_diagonal` the mass must have its whole
/// diagonal. `damping` may be null.
FeModel matrix_model_of(TextSource& stiffness, TextSource& mass, TextSource& dofs, FeModel nodes,
                        bool mass_diagonal, MatrixReader read, TextSource* damping);
/// The file of viscous damping: of the options, or beside the stiffness; empty: none.
std::filesystem::path damping_matrix_of(const std::filesystem::path& stiffness,
                                        const FeReadOptions& options);
/// Viscous damping, rows as those of the stiffness, beside stiffness and mass.
void add_matrix_damping(FeModel& model, SparseMatrix C, const TextSource& source);

}  // namespace floatframe

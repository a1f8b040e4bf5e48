#pragma once
// What all formats of matrices share: the nodes behind the rows, the map of degrees of freedom, the
// files beside the stiffness, and the model made of them.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "floatframe/formats/fe_file.hpp"
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
                     const std::vector<std::string>& matrix_files);

/// Texts with stiffness, mass and viscous damping (null: there is none), and the one that names
/// their rows. Several may be one.
struct MatrixTexts {
  TextSource &stiffness, &mass;
  TextSource* damping;
  TextSource& rows;
};
/// The matrix "stiffness", "mass" or "damping" of a text.
using MatrixReader = std::function<SparseMatrix(TextSource& source, const std::string& what)>;
/// The same from texts, which are read in this order; `labels` may be known with the first.
FeModel matrix_model_of(const MatrixTexts& texts, FeModel nodes,
                        const std::vector<DofLabel>& labels, const MatrixReader& read);
/// A note of matrices that are not read.
void note_other_matrices(FeModel& model, const std::string& file,
                         const std::vector<std::string>& names);
/// Viscous damping, rows as those of the stiffness, beside stiffness and mass.
void add_matrix_damping(FeModel& model, SparseMatrix C, const TextSource& source);

}  // namespace floatframe

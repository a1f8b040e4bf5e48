#pragma once
// Common parts of all formats of matrices: the nodes of the rows, the map of degrees of freedom,
// the files next to the stiffness, and the resulting model.
//
// The files next to a stiffness matrix, and the content of the lines of a matrix file.
//
// Entries of a symmetric matrix in the order of a file: one triangle, or both, in any order.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// One row of the matrices as in the file: node number, direction 1..6; 0: a scalar point, the
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
/// rotations of its reference. Spiders and equations of the deck are already in the matrices: the
/// nodes that follow a spider and have no rows are omitted, and so are their sets.
/// `labels_source` for the locations of errors and the names of files.
FeModel matrix_model(FeModel nodes, const std::vector<DofLabel>& labels, SparseMatrix K,
                     SparseMatrix M, TextSource& labels_source,
                     const std::vector<std::string>& matrix_files);

/// Texts with stiffness, mass and viscous damping (null: there is none), and the text with the
/// names of their rows. Several may be identical.
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
/// Viscous damping, rows as those of the stiffness, in addition to stiffness and mass.
void add_matrix_damping(FeModel& model, SparseMatrix C, const TextSource& source);

/// `file` without .gz and without its ending.
std::filesystem::path stem_of(const std::filesystem::path& file);
std::filesystem::path with_ending(const std::filesystem::path& stem, const std::string& ending);
/// The stem of a file with the last `word` (upper case; in the file in any case) replaced; empty if
/// the word is not there.
std::filesystem::path with_word(const std::filesystem::path& file, std::string_view word,
                                std::string_view other);
/// The stem of a file up to the last `word`; empty if the word is not there.
std::filesystem::path before_word(const std::filesystem::path& file, std::string_view word);
/// For a stem arm_K: arm_M (the case is kept); empty if it does not end with _K.
std::filesystem::path with_letter(const std::filesystem::path& stem, char letter);

/// The file with the nodes: the one given in the options, or the first one found next to a file,
/// also with .gz. Throws InputError if there is none.
std::filesystem::path nodes_beside(const std::filesystem::path& file,
                                   const std::filesystem::path& given,
                                   const std::vector<const char*>& endings);

/// Candidates for the files next to a stiffness; empty paths are ignored.
struct MatrixPlaces {
  std::vector<std::filesystem::path> stiffness = {};  ///< empty: it is the file itself
  std::vector<std::filesystem::path> mass = {};
  std::optional<std::vector<std::filesystem::path>> dofs = {};  ///< null: there is no map
  std::vector<std::filesystem::path> nodes = {};
};
/// `dofs` and `damping` may be null.
using ReadMatrices = std::function<FeModel(TextSource& stiffness, TextSource& mass,
                                           TextSource* dofs, FeModel nodes, TextSource* damping)>;
/// Reads those of the options, and the others from these paths. Throws InputError for a missing
/// file: "the mass matrix is missing: ... give the mass file".
FeModel read_matrix_files(const std::filesystem::path& file, const FeReadOptions& options,
                          const MatrixPlaces& places, const ReadMatrices& read);

/// First line that is not empty and does not begin with one of `comments`.
std::string_view first_line(std::string_view text, std::string_view comments);
/// Calls `use` for each line that is neither empty nor begins with one of `comments`.
template <typename Use>
void each_line(TextSource& source, std::string_view comments, Use use) {
  std::string_view line;
  while (source.next(line)) {
    line = trimmed(line);
    if (!line.empty() && comments.find(line.front()) == std::string_view::npos) use(line);
  }
}

/// Collects entries and builds the symmetric matrix with both halves. Errors: duplicate entries,
/// halves that differ, a diagonal that is negative or a penalty.
class SymmetricEntries {
 public:
  /// `what` for messages: "stiffness", "mass".
  SymmetricEntries(TextSource& source, std::string what)
      : source_(source), what_(std::move(what)) {}
  /// Rows and columns count from 0. The place is the last line of the source.
  void add(int row, int column, double value) { add(row, column, value, source_.here()); }
  void add(int row, int column, double value, const FeSource& at);
  std::size_t size() const noexcept { return entries_.size(); }
  /// Largest row or column so far; -1 without entries.
  int last() const noexcept { return last_; }
  /// n x n; `last()` must be less than n. `labels`: of the rows, for messages. With
  /// `whole_diagonal` each row must have its diagonal entry, be it zero.
  SparseMatrix finish(int n, const std::vector<std::string>& labels, bool whole_diagonal);
  /// The same, where these rows alone need a diagonal entry.
  SparseMatrix finish(int n, const std::vector<std::string>& labels,
                      const std::vector<int>& with_diagonal);

 private:
  struct Entry {
    int row, column;  // row <= column
    double value;
    int line;  // negative: of the lower half
  };
  bool check(const std::vector<std::string>& labels);

  TextSource& source_;
  std::string what_;
  std::vector<Entry> entries_;
  int last_ = -1;
  int file_ = 0;
};

}  // namespace floatframe

#pragma once
// Finite-element files of other programs. All readers return the same FeModel, in the units of the
// file. A new format is one file with a reader and one entry in the list of fe_file.cpp or
// deck_list.cpp. Files may be compressed with gzip (.gz). Errors throw InputError with file:line;
// as many as possible are reported at once.
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Program of a `.inp` deck, where the two programs interpret the same keywords differently.
enum class DeckDialect {
  by_content,  ///< by features of only one of them; an error if that is ambiguous and matters
  abaqus,
  calculix
};

/// Shear deformation of 2-node beams.
enum class BeamShear {
  by_format,  ///< as in the file and its program
  none        ///< Euler-Bernoulli
};

/// Transverse shear of shells.
enum class ShellShear {
  by_format,  ///< as in the file and its program
  none,       ///< thin
  all         ///< 5/6 of the thickness
};

/// Mass of the elements: as in the program of the file, or one form for all.
enum class MassChoice { by_format, consistent, lumped };

/// Treatment of contact pairs, which are nonlinear.
enum class DeckContact {
  refuse,  ///< an error
  ignore,  ///< their surfaces are free
  tied     ///< joined where they are within a distance
};

/// Treatment of springs to the ground, to which a floating part cannot be tied.
enum class GroundedSprings {
  refuse,  ///< an error of the part
  ignore   ///< ignored
};

struct FeReadOptions {
  /// Formats without material (Gmsh): the material of all elements, in the units of the file.
  std::optional<Material> material;
  /// For materials without density in the file, by their names, in the units of the file;
  /// by an empty name: of all others.
  std::map<std::string, double> densities;
  /// Formats without sections (Gmsh, UNV): of surface elements, which are shells then, by the names
  /// of their groups, in the units of the file; by an empty name: of all that are no faces of
  /// solids and in none of these groups.
  std::map<std::string, double> thicknesses;
  /// Matrices without coordinates: a deck (any format) or "node,x,y,z" CSV with the nodes.
  std::filesystem::path nodes;
  /// Matrix formats: the mass matrix, the dof map and the matrix of viscous damping, if they are
  /// not next to the stiffness. Damping is optional.
  std::filesystem::path mass, dofs, damping_matrix;
  DeckDialect dialect = DeckDialect::by_content;
  BeamShear beam_shear = BeamShear::by_format;
  ShellShear shell_shear = ShellShear::by_format;
  MassChoice mass_form = MassChoice::by_format;
  DeckContact contact = DeckContact::refuse;
  /// For `tied`, in the units of the file; 0: 2.5 % of the size of the faces.
  double contact_distance = 0.0;
  GroundedSprings grounded_springs = GroundedSprings::refuse;
  /// Temperature for materials that depend on it, in the units of the file.
  std::optional<double> temperature;
};

/// The matrix of viscous damping next to a stiffness, by its name; empty: none.
std::filesystem::path damping_beside(const std::filesystem::path& stiffness);

/// On the command line and in model files: "abaqus", "calculix".
const char* word(DeckDialect dialect) noexcept;

struct FeFormat {
  const char* name;                  ///< "abaqus"
  const char* description;           ///< "Abaqus / CalculiX deck (.inp)"
  std::vector<std::string> endings;  ///< without .gz: {".inp"}
  /// Does the beginning of the file (decompressed) look like this format?
  bool (*recognise)(std::string_view beginning);
  FeModel (*read)(const std::filesystem::path& file, const FeReadOptions& options);
  /// Surfaces are shells only by FeReadOptions::thicknesses.
  bool without_sections = false;
  /// For a deck in addition to matrices: only nodes, sets, spiders and supports; null: unsupported.
  FeModel (*read_nodes)(const std::filesystem::path& file) = nullptr;
  /// The options with files that it reads: "mass", "dofs", "nodes", "damping_matrix".
  std::vector<std::string> more_files = {};
};

std::span<const FeFormat> fe_formats();

/// Format by name, or by ending and content if `format` is empty.
FeModel read_fe_file(const std::filesystem::path& file, const FeReadOptions& options = {},
                     const std::string& format = {});

}  // namespace floatframe

#pragma once
// Surface elements of meshes without sections (Gmsh, UNV). Without a thickness they are skins,
// which only define sets; those to which the user gives one, all or by the names of their groups,
// are shells. Faces of solids stay skins unless their group is given.
#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

class SurfaceThickness {
 public:
  /// By the name of a group, in the units of the file; by an empty name: of all others.
  explicit SurfaceThickness(const std::map<std::string, double>& given);

  bool any() const noexcept { return !sections_.empty(); }
  /// One per thickness.
  const std::vector<ShellSection>& sections() const noexcept { return sections_; }
  /// For all that are in no named group; -1: not given.
  int others() const noexcept { return others_; }

  /// To be called for all solids before the surfaces.
  void add_solid(FeElementType type, std::span<const int> nodes);

  struct Choice {
    int section = -1;   ///< -1: a skin
    std::string error;  ///< if its groups give two thicknesses
  };
  /// For an element with these corners in these groups.
  Choice choose(std::span<const int> corners, const std::vector<std::string>& groups);

  /// A sentence for each thickness that is not used by any surface element.
  std::vector<std::string> not_found(const std::vector<std::string>& groups) const;

 private:
  using Corners = std::array<int, 4>;
  static Corners key(std::span<const int> corners);

  std::vector<ShellSection> sections_;
  int others_ = -1;
  bool others_seen_ = false;
  std::map<std::string, int> groups_;
  std::set<std::string> seen_;
  std::vector<Corners> faces_;  ///< of solids
  bool sorted_ = false;
};

}  // namespace floatframe

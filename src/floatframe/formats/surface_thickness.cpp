#include "floatframe/formats/surface_thickness.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/suggest.hpp"
#include "floatframe/core/utf8_text.hpp"
#include "floatframe/fe/element_faces.hpp"

namespace floatframe {

SurfaceThickness::SurfaceThickness(const std::map<std::string, double>& given) {
  for (const auto& [name, thickness] : given) {
    const int section = static_cast<int>(sections_.size());
    ShellSection s;
    s.thickness = thickness;
    s.shear = 5.0 / 6.0 * thickness;
    sections_.push_back(s);
    if (name.empty())
      others_ = section;
    else
      groups_[utf8_text(name)] = section;
  }
}

SurfaceThickness::Corners SurfaceThickness::key(std::span<const int> corners) {
  Corners out{-1, -1, -1, -1};
  std::copy(corners.begin(), corners.end(), out.begin());
  std::sort(out.begin(), out.end());
  return out;
}

void SurfaceThickness::add_solid(FeElementType type, std::span<const int> nodes) {
  if (others_ < 0) return;
  for (const FaceNodes& face : element_faces(type)) {
    std::array<int, 4> corners{};
    for (int k = 0; k < face.corners; ++k) corners[k] = nodes[face.nodes[k]];
    faces_.push_back(key(std::span(corners).first(face.corners)));
  }
}

SurfaceThickness::Choice SurfaceThickness::choose(std::span<const int> corners,
                                                  const std::vector<std::string>& groups) {
  Choice choice;
  std::string from;
  for (const std::string& raw : groups) {
    const std::string group = utf8_text(raw);
    const auto named = groups_.find(group);
    if (named == groups_.end()) continue;
    seen_.insert(group);
    if (choice.section >= 0 &&
        sections_[choice.section].thickness != sections_[named->second].thickness) {
      choice.error = fmt::format(
          "is in the groups '{}' and '{}', to which different thicknesses "
          "are given ({:g}, {:g})",
          from, group, sections_[choice.section].thickness, sections_[named->second].thickness);
      return choice;
    }
    choice.section = named->second;
    from = group;
  }
  if (choice.section >= 0 || others_ < 0) return choice;
  if (!sorted_) std::sort(faces_.begin(), faces_.end());
  sorted_ = true;
  if (!std::binary_search(faces_.begin(), faces_.end(), key(corners))) choice.section = others_;
  others_seen_ = others_seen_ || choice.section >= 0;
  return choice;
}

std::vector<std::string> SurfaceThickness::not_found(const std::vector<std::string>& groups) const {
  std::vector<std::string> out;
  if (others_ >= 0 && !others_seen_)
    out.emplace_back(
        "a thickness is given, but all surface elements are faces of solids or in "
        "groups with a thickness of their own: leave it out, or name a group");
  for (const auto& group : groups_) {
    const std::string& name = group.first;
    if (!seen_.contains(name)) {
      const bool known = std::any_of(groups.begin(), groups.end(),
                                     [&](const std::string& g) { return utf8_text(g) == name; });
      out.push_back(
          fmt::format("a thickness is given for the group '{}', but no surface element "
                      "is in a group of this name{}",
                      name, known ? "" : did_you_mean(name, groups)));
    }
  }
  return out;
}

}  // namespace floatframe

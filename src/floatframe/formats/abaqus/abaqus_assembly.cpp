// One part and one instance of an Abaqus deck. Numbers and names of the part are those of the
// instance; the assembly has its own.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "floatframe/formats/abaqus/abaqus_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

void read_abaqus_part(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  const std::string name = abaqus_name(lines.required(keyword, "NAME"));
  if (!content.part.empty()) {
    lines.source().stop(keyword.at, fmt::format("*PART {} is a second part; a deck with one part "
                                                "and one instance of it is read",
                                                shown(name)));
  }
  content.part = name.empty() ? "?" : name;
  content.scope = AbaqusScope::part;
  lines.skip_data();
}

void read_abaqus_end_part(AbaqusLines& lines, const AbaqusKeyword&, AbaqusContent& content) {
  content.scope = AbaqusScope::assembly;
  lines.skip_data();
}

void read_abaqus_assembly(AbaqusLines& lines, const AbaqusKeyword&, AbaqusContent& content) {
  content.scope = AbaqusScope::assembly;
  lines.skip_data();
}

void read_abaqus_instance(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  lines.allow_only(keyword, {"NAME", "PART"});
  const std::string name = abaqus_name(lines.required(keyword, "NAME"));
  const std::string part = abaqus_name(lines.required(keyword, "PART"));
  if (!content.instance.empty()) {
    lines.source().stop(keyword.at, fmt::format("*INSTANCE {} is a second instance; a deck with "
                                                "one part and one instance of it is read",
                                                shown(name)));
  }
  if (!part.empty() && part != content.part) {
    lines.error(keyword, fmt::format("is of the part {}, which does not exist", shown(part)));
  }
  content.instance = name.empty() ? "?" : name;
  content.scope = AbaqusScope::part;
  AbaqusPlacement& place = content.placement;
  std::vector<std::string_view> fields;
  const auto vector = [&](std::size_t first, std::string_view what) {
    Vec3 v;
    for (std::size_t k = 0; k < 3; ++k) {
      v[static_cast<Eigen::Index>(k)] = lines.real_or(fields, first + k, 0.0, what);
    }
    return v;
  };
  if (lines.next_fields(fields)) place.t = vector(0, "translation of the instance");
  if (!lines.next_fields(fields)) return;
  place.a = vector(0, "axis of the instance's rotation");
  const Vec3 axis = vector(3, "axis of the instance's rotation") - place.a;
  const double degrees = lines.real_or(fields, 6, 0.0, "angle of the instance's rotation");
  if (!(axis.stableNorm() > 0.0) || !std::isfinite(axis.stableNorm())) {
    lines.source().error("the two points of the axis of the instance's rotation are one");
    return;
  }
  place.R = Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.stableNormalized())
                .toRotationMatrix();
  lines.skip_data();
}

void read_abaqus_end_instance(AbaqusLines& lines, const AbaqusKeyword&, AbaqusContent& content) {
  content.scope = AbaqusScope::assembly;
  lines.skip_data();
}

}  // namespace floatframe

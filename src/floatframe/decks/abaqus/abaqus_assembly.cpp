// Parts and instances of an Abaqus deck. Each instance has the numbers and names of its part, the
// assembly has its own; from there things of an instance are INSTANCE.NAME and INSTANCE.12.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

namespace {

/// A name without an instance is looked for in all of them.
constexpr std::size_t most_instances = 2000;

void open_block(const AbaqusKeyword& keyword, AbaqusContent& content) {
  content.open.push_back({keyword.name, abaqus_name(keyword.value("NAME")), keyword.at});
}

void close_last(AbaqusContent& content, TextSource& source, const std::string& where) {
  const AbaqusOpenBlock block = std::move(content.open.back());
  content.open.pop_back();
  source.error(ErrorCode::missing, block.at, "*{} {} has no end, expected *END {} {}",
               block.keyword, shown(block.name), block.keyword, where);
}

/// Those inside of it that are still open have no end; an error if it has not begun.
void close_block(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  const std::string begin = keyword.name.substr(3);  // "ENDPART"
  const bool begun = std::any_of(content.open.begin(), content.open.end(),
                                 [&](const AbaqusOpenBlock& b) { return b.keyword == begin; });
  if (!begun)
    return lines.error(ErrorCode::incomplete, keyword, "ends no *{}, expected one before it",
                       begin);
  while (content.open.back().keyword != begin)
    close_last(content, lines.source(), "before " + keyword.shown);
  content.open.pop_back();
}

AbaqusScope new_scope(AbaqusContent& content) { return static_cast<AbaqusScope>(content.scopes++); }

void read_placement(AbaqusLines& lines, AbaqusPlacement& place) {
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
  if (fields.size() < 7 || fields[6].empty())
    return lines.source().error(ErrorCode::wrong_count,
                                "the rotation of the instance has {} numbers, expected seven: two "
                                "points of the axis and the angle",
                                std::min<std::size_t>(fields.size(), 6));
  place.a = vector(0, "axis of the instance's rotation");
  const Vec3 axis = vector(3, "axis of the instance's rotation") - place.a;
  const double degrees = lines.real_or(fields, 6, 0.0, "angle of the instance's rotation");
  if (lines.misread()) return;
  if (!(axis.stableNorm() > 0.0) || !std::isfinite(axis.stableNorm())) {
    lines.source().error(ErrorCode::geometry,
                         "the two points of the axis of the instance's rotation are one");
    return;
  }
  place.R = Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.stableNormalized())
                .toRotationMatrix();
  lines.skip_data();
}

}  // namespace

void close_abaqus_blocks(AbaqusContent& content, TextSource& source, const std::string& where) {
  while (!content.open.empty()) close_last(content, source, where);
}

void read_abaqus_part(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  close_abaqus_blocks(content, lines.source(), "before the next *PART");
  open_block(keyword, content);
  const std::string name = abaqus_name(lines.required(keyword, "NAME"));
  content.system.reset();
  AbaqusPart part;
  part.at = keyword.at;
  part.scope = content.parts.empty() ? AbaqusScope::part : new_scope(content);
  part.begin = part.end = abaqus_sizes(content);
  content.part = name.empty() ? "?" : name;
  const auto [it, fresh] = content.parts.emplace(content.part, part);
  if (!fresh) {
    const SourceMark first = lines.source().mark(it->second.at);
    lines.source().stop(ErrorCode::duplicate, keyword.at, "*PART {} is there already ({}:{})",
                        shown(name), first.file, first.line);
  }
  content.scope = part.scope;
  lines.skip_data();
}

void read_abaqus_end_part(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  close_block(lines, keyword, content);
  if (const auto it = content.parts.find(content.part); it != content.parts.end()) {
    it->second.end = abaqus_sizes(content);
  }
  content.scope = AbaqusScope::assembly;
  content.system.reset();
  lines.skip_data();
}

void read_abaqus_assembly(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  close_abaqus_blocks(content, lines.source(), "before *ASSEMBLY");
  open_block(keyword, content);
  content.scope = AbaqusScope::assembly;
  content.system.reset();
  lines.skip_data();
}

void read_abaqus_end_assembly(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  close_block(lines, keyword, content);
  content.scope = AbaqusScope::assembly;
  content.system.reset();
  lines.skip_data();
}

void read_abaqus_instance(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  lines.allow_only(keyword, {"NAME", "PART"});
  while (!content.open.empty() && content.open.back().keyword != "ASSEMBLY")
    close_last(content, lines.source(), "before the next *INSTANCE");
  open_block(keyword, content);
  const std::string name = abaqus_name(lines.required(keyword, "NAME"));
  const std::string part = abaqus_name(lines.required(keyword, "PART"));
  const auto it = content.parts.find(part);
  if (it == content.parts.end()) {
    std::vector<std::string> known;
    for (const auto& [k, p] : content.parts) known.push_back(k);
    lines.source().stop(ErrorCode::not_found, keyword.at,
                        "*INSTANCE {} is of the part {}, which does not exist{}", shown(name),
                        shown(part), did_you_mean(part, known));
  }
  if (content.scope_of_instance.contains(name))
    lines.source().stop(ErrorCode::duplicate, keyword.at, "*INSTANCE {} is there already",
                        shown(name));
  AbaqusPart& of = it->second;
  const bool meshed = of.end[0] > of.begin[0] || of.end[1] > of.begin[1];
  if (content.instances.size() == most_instances)
    lines.source().stop(ErrorCode::too_large, keyword.at, "the deck has more than {} instances",
                        most_instances);
  if (of.used && of.grown && meshed)
    lines.source().stop(ErrorCode::unsupported, keyword.at,
                        "*INSTANCE {} is a second one of the part {}, whose first one has nodes or "
                        "elements of its own; give each a part",
                        shown(name), shown(part));
  const AbaqusScope scope = of.used ? new_scope(content) : of.scope;
  if (of.used && meshed) copy_abaqus_part(content, of, scope, lines.source());
  of.used = true;
  AbaqusInstance instance;
  instance.name = name.empty() ? "?" : name;
  instance.part = part;
  read_placement(lines, instance.place);
  instance.begin = abaqus_sizes(content);
  content.scope_of_instance.emplace(instance.name, scope);
  content.instances.emplace(scope, std::move(instance));
  content.scope = scope;
}

void read_abaqus_end_instance(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  close_block(lines, keyword, content);
  if (const auto it = content.instances.find(content.scope); it != content.instances.end()) {
    AbaqusPart& part = content.parts.at(it->second.part);
    part.grown = part.grown || it->second.begin[0] < content.nodes.size() ||
                 it->second.begin[1] < content.elements.size();
  }
  content.scope = AbaqusScope::assembly;
  content.system.reset();
  lines.skip_data();
}

void finish_abaqus_assembly(AbaqusContent& content, TextSource& source) {
  close_abaqus_blocks(content, source, "before the end of the deck");
  if (content.parts.size() > 1 && content.instances.empty())
    source.error(ErrorCode::missing, std::next(content.parts.begin())->second.at,
                 "the deck has {} parts and no instance of any (*INSTANCE)", content.parts.size());
  if (content.instances.empty()) return;
  std::set<AbaqusScope> unused;
  for (const auto& [name, part] : content.parts) {
    if (part.used) continue;
    const SourceMark mark = source.mark(part.at);
    content.note(mark, fmt::format("part {} has no instance and is left out", shown(name)));
    unused.insert(part.scope);
  }
  if (!unused.empty()) remove_abaqus_scopes(content, unused);
}

}  // namespace floatframe

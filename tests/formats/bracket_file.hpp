#pragma once
// A body file of a small bracket, and what is done to its bytes.
#include <string>
#include <vector>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/error_of.hpp"

namespace floatframe {

/// A bracket of three steel bars with everything that a body file can hold.
inline BodyFile bracket(MassModel mass_model = MassModel::isoparametric) {
  BarFrame frame;
  frame.material = {2.1e11, 0.3, 7850.0};
  frame.points = {{"foot", {0, 0, 0}}, {"knee", {0.3, 0, 0.1}}, {"eye", {0.3, 0.2, 0.25}}};
  for (const auto& [from, to] : {std::pair{"foot", "knee"}, {"knee", "eye"}}) {
    Bar bar;
    bar.name = from;
    bar.from = from;
    bar.to = to;
    bar.elements = 2;
    bar.section = BeamSection::solid_round(0.02);
    frame.bars.push_back(bar);
  }
  ReductionOptions options;
  options.clamped = {{"foot", all_dofs}};
  options.interfaces = {{"eye", 7u}};
  options.normal_modes = 2;
  options.mass_model = mass_model;
  options.damping = 0.01;
  BodyFile out;
  ReducedPart& part = out.part;
  const FeModel model = build_bar_frame(frame);
  part.body = reduce(model, options);
  part.surface.nodes = {0, 1, 2};
  part.surface.triangles = {{0, 1, 2}};
  part.surface.lines = {{0, 1}, {1, 2}};
  part.surface_positions = Mat3X::Random(3, 3);
  part.surface_modes = MatX::Random(9, part.body.modes());
  auto second = std::make_shared<SecondOrder>(*part.body.second_order);
  std::erase_if(second->nodes,
                [&](const SecondOrderNode& n) { return part.body.nodes[n.node].name.empty(); });
  std::erase_if(part.body.nodes, [](const ModalNode& n) { return n.name.empty(); });
  for (std::size_t k = 0; k < second->nodes.size(); ++k)
    second->nodes[k].node = static_cast<int>(k);
  part.body.second_order = second;
  part.body.interfaces = {{0, 63u}, {2, 7u}};
  part.body.equal_left_out = 1;

  HealthReport& h = part.health;
  h.nodes = model.nodes();
  h.elements = 4;
  h.dofs = 30;
  h.modes = part.body.modes();
  const InertiaInvariants& v = part.body.invariants;
  h.from_elements = {v.m, {0.1, 0.2, 0.3}, Mat3::Identity()};
  h.from_invariants = {v.m, v.centre_of_mass(), v.inertia_about_origin()};
  h.volume = 2e-4;
  h.volume_times_density = 1.57;
  h.rigid_eigenvalues = Vec6::LinSpaced(6, -1e-12, 1e-12);
  h.rigid_residual = 3e-16;
  h.rotary_inertia = false;
  h.normal_modes = {{"normal 1", 100.0, Vec6::Constant(0.25), true}};
  h.free_frequencies = {{100.0, 100.25}};
  h.damping = own_damping(part.body);
  h.interfaces = {{"eye", 7, {0.3, 0.2, 0.25}, "rigid", 3.5, 1e-9}};
  h.static_support = "foot";
  h.solver = "test";
  h.seconds = {{"read", 0.5}};
  h.notes = {"a note"};
  h.warnings = {"the interface 'eye' has few nodes"};
  out.provenance = {"bracket.inp",
                    "0123",
                    "mm-t-s",
                    {{"modes", "2"}, {"method", "cb"}},
                    "2026-01-02T03:04:05Z",
                    "0.1.0-test",
                    {{"bracket.inp", "4567"}}};
  return out;
}

/// The file with one member replaced (or removed, if `content` is empty).
inline std::string with_member(const std::string& bytes, const std::string& name,
                               const std::string& content) {
  std::vector<ZipMember> members = read_zip(bytes, "x");
  std::erase_if(members, [&](const ZipMember& m) { return m.name == name && content.empty(); });
  for (ZipMember& m : members)
    if (m.name == name) m.content = content;
  return zip_archive(members);
}

inline std::string member(const std::string& bytes, const std::string& name) {
  for (const ZipMember& m : read_zip(bytes, "x"))
    if (m.name == name) return std::string(m.content);
  return "";
}

inline std::string error_of_bytes(const std::string& bytes) {
  return test::error_of([&] { read_body_bytes(bytes, "arm.ffb"); });
}

}  // namespace floatframe

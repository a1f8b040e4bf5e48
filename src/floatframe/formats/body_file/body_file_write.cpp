#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/formats/body_file/body_members.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

std::string header_of(const BodyFile& content) {
  const FlexibleBody& body = content.part.body;
  const HealthReport& health = content.part.health;
  const Provenance& from = content.provenance;
  Json modes = Json::array(), markers = Json::array(), options = Json::array(),
       files = Json::array();
  const auto finite = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  const VecX frequencies = mode_frequencies(body);
  for (int k = 0; k < body.modes(); ++k) {
    const auto name = static_cast<std::size_t>(k) < body.mode_names.size()
                          ? body.mode_names[k]
                          : fmt::format("mode {}", k + 1);
    modes.push_back({{"name", name}, {"frequency_Hz", finite(frequencies[k])}});
  }
  for (const ModalNode& node : body.nodes) {
    const auto it = std::find_if(health.interfaces.begin(), health.interfaces.end(),
                                 [&](const InterfaceHealth& h) { return h.name == node.name; });
    const bool interface = it != health.interfaces.end();
    markers.push_back({{"name", node.name},
                       {"interface", interface},
                       {"kind", interface ? Json(it->kind) : Json()}});
    const auto index = static_cast<int>(&node - body.nodes.data());
    for (const InterfaceDofs& at : body.interfaces)
      if (at.node == index) {
        Json directions = Json::array();
        for (unsigned k = 0; k < 6; ++k)
          if ((at.mask >> k) & 1u) directions.push_back(interface_directions[k]);
        markers.back()["dofs"] = directions;
      }
    const std::vector<int> points = surface_points_that_follow(content.part, node);
    if (!points.empty()) markers.back()["moves_with"] = points;
  }
  for (const auto& [key, value] : from.options) options.push_back({key, value});
  for (const auto& [file, hash] : from.files) files.push_back({{"file", file}, {"hash", hash}});
  Json stress = nullptr;
  if (body.stress && body.modes() > 0) {
    Json groups = Json::array(), beams = Json::array();
    for (const StressGroup& group : body.stress->groups) groups.push_back(group.name);
    for (const BeamSectionPlace& section : body.stress->sections) beams.push_back(section.name);
    stress = {{"groups", groups}, {"beams", beams}};
  }
  const Json header = {{"format", "floatframe body"},
                       {"format_version", body_file_version},
                       {"floatframe", from.version},
                       {"units", body_file_units},
                       {"mass_model", body_mass_models[index_of(body.mass_model)]},
                       {"modes", modes},
                       {"equal_modes_left_out", body.equal_left_out},
                       {"markers", markers},
                       {"stress", stress},
                       {"provenance",
                        {{"source", from.source},
                         {"source_hash", from.source_hash},
                         {"units", from.units},
                         {"options", options},
                         {"files", files},
                         {"date", from.date}}},
                       {"health", Json::parse(health_json(health))}};
  return header.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

template <class Sparse>
void add_sparse(const Sparse& m, const std::string& name, ArrayWriter& out) {
  std::vector<double> values;
  std::vector<std::int32_t> columns;
  std::vector<std::int64_t> starts{0};
  for (Eigen::Index r = 0; r < m.outerSize(); ++r) {
    for (typename Sparse::InnerIterator it(m, r); it; ++it) {
      values.push_back(it.value());
      columns.push_back(static_cast<std::int32_t>(it.col()));
    }
    starts.push_back(static_cast<std::int64_t>(values.size()));
  }
  const std::size_t n = values.size(), rows = starts.size();
  out.add(name + "_data", {{n}, std::move(values)});
  out.add(name + "_indices", {{n}, std::move(columns)});
  out.add(name + "_indptr", {{rows}, std::move(starts)});
}

}  // namespace

double distance_from_rigid(const ReducedPart& part, const ModalNode& node, int point) {
  const Eigen::Index k = point;
  const Vec3 r = part.surface_positions.col(k) - node.p;
  const Mat3X rigid = node.X - skew(r) * node.X_theta;
  return (part.surface_modes.middleRows<3>(3 * k) - rigid).cwiseAbs().maxCoeff();
}

std::vector<int> surface_points_that_follow(const ReducedPart& part, const ModalNode& node) {
  std::vector<int> all;
  const Eigen::Index n = part.surface_positions.cols(), nm = part.body.modes();
  if (nm == 0 || n == 0 || part.surface_modes.rows() != 3 * n || part.surface_modes.cols() != nm)
    return all;
  const double limit = 1e-9 * part.surface_modes.cwiseAbs().maxCoeff();
  for (int k = 0; k < n; ++k)
    if (distance_from_rigid(part, node, k) <= limit) all.push_back(k);
  if (all.size() > 3) all = {all.front(), all[all.size() / 2], all.back()};
  return all;
}

VecX mode_frequencies(const FlexibleBody& body) {
  const MatX M = modal_mass(body.invariants);
  VecX out(body.modes());
  for (Eigen::Index k = 0; k < out.size(); ++k)
    out[k] = hertz(std::sqrt(std::max(0.0, body.K(k, k)) / M(k, k)));
  return out;
}

std::string body_file_bytes(const BodyFile& content) {
  const ReducedPart& part = content.part;
  const FlexibleBody& body = part.body;
  const Eigen::Index nm = body.modes();
  NamedBytes arrays;
  ArrayWriter out(arrays);
  body_matrices(out, body, nm);
  marker_matrices(out, body.nodes, nm);
  const Surface& surface = part.surface;
  out.integers("surface_nodes", surface.nodes);
  out.integers("surface_triangles", surface.triangles);
  out.integers("surface_lines", surface.lines);
  out.points("surface_positions", part.surface_positions, part.surface_positions.cols());
  // Without modes it has rows all the same; a file without a surface has none.
  const auto n = static_cast<Eigen::Index>(surface.nodes.size());
  const bool given = part.surface_modes.rows() == 3 * n && part.surface_modes.cols() == nm;
  out.grouped("surface_modes", given ? part.surface_modes : MatX(), n, 3, nm);
  if (body.projection) {
    const ProjectionData& data = *body.projection;
    projection_matrices(out, data, data.p.cols(), nm);
    if (data.six_dof())
      add_sparse(data.M_6, "projection_M_6", out);
    else
      add_sparse(data.M_s, "projection_M_s", out);
  }
  add_second_order(body, out);
  add_stress(body, out);
  const std::string header = header_of(content);
  std::vector<ZipMember> members{{"header.json", header}};
  for (const auto& [name, bytes] : arrays) members.push_back({name + ".npy", bytes});
  return zip_archive(members);
}

void write_body_file(const std::filesystem::path& file, const BodyFile& content) {
  write_file(file.string(), body_file_bytes(content));
}

}  // namespace floatframe

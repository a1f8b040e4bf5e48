#pragma once
// Reads the reference bodies of tests/data/inertia: finite-element input, modes, state, integrals,
// M and Qv.
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe::test {

using Json = nlohmann::json;

inline Json read_json(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return Json::parse(file);
}

inline Json reference_body(const std::string& name) {
  return read_json(std::string(FLOATFRAME_TEST_DATA) + "/inertia/" + name + ".json");
}

inline const std::vector<std::string>& reference_bodies() {
  static const std::vector<std::string> names = {"aarm_eb_section",
                                                 "aarm_eb_section_random",
                                                 "aarm_iso_random",
                                                 "beam_eb_line",
                                                 "beam_iso",
                                                 "hex8",
                                                 "tet4"};
  return names;
}

inline VecX to_vector(const Json& j) {
  VecX v(static_cast<Eigen::Index>(j.size()));
  for (std::size_t i = 0; i < j.size(); ++i) v(static_cast<Eigen::Index>(i)) = j[i].get<double>();
  return v;
}

inline MatX to_matrix(const Json& j) {
  const std::size_t columns = j.empty() ? 0 : j[0].size();
  MatX m(static_cast<Eigen::Index>(j.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t r = 0; r < j.size(); ++r) {
    m.row(static_cast<Eigen::Index>(r)) = to_vector(j[r]).transpose();
  }
  return m;
}

inline Vec3 to_vec3(const Json& j) { return Vec3(j[0], j[1], j[2]); }

inline InertiaInvariants to_invariants(const Json& j) {
  InertiaInvariants v;
  v.m = j["m"];
  v.m_u = to_vec3(j["m_bar_u"]);
  v.P_u = to_matrix(j["P_bar_u"]);
  v.S = to_matrix(j["S"]);
  for (std::size_t i = 0; i < 3; ++i) {
    v.Si[i] = to_matrix(j["S_i"][i]);
    for (std::size_t k = 0; k < 3; ++k) v.Sij[i][k] = to_matrix(j["S_ij"][i][k]);
  }
  return v;
}

/// The finite-element input; beams named beam2, ebbeam and ebbeamS are the same element.
inline FeModel to_model(const Json& j) {
  FeModel model;
  for (const Json& p : j["nodes"]) model.positions.push_back(to_vec3(p));
  model.node_names.resize(model.positions.size());
  model.materials.push_back({j["E"], j["nu"], j["rho"]});
  for (const Json& e : j["elements"]) {
    FeElement element;
    const std::string type = e["type"];
    element.type = type == "tet4"   ? FeElementType::tet4
                   : type == "hex8" ? FeElementType::hex8
                                    : FeElementType::beam2;
    for (std::size_t k = 0; k < e["nodes"].size(); ++k) element.nodes[k] = e["nodes"][k];
    if (element.type == FeElementType::beam2) {
      element.section = static_cast<int>(model.sections.size());
      element.reference = to_vec3(e["vref"]);
      model.sections.push_back({e["A"], e["Iy"], e["Iz"], e["J"]});
    }
    model.elements.push_back(element);
  }
  return model;
}

inline bool section_inertia(const Json& j) { return j["elements"][0]["type"] == "ebbeamS"; }
inline bool hermite(const Json& j) {
  return j["elements"][0]["type"] == "ebbeamS" || j["elements"][0]["type"] == "ebbeam";
}

/// Largest difference relative to the largest entry of the expected array.
template <class A, class B>
double relative_error(const A& actual, const B& expected) {
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols()) return 1e300;
  if (expected.size() == 0) return 0.0;
  const double scale = expected.cwiseAbs().maxCoeff();
  const double error = (actual - expected).cwiseAbs().maxCoeff();
  return scale > 0.0 ? error / scale : error;
}

inline double relative_error(const InertiaInvariants& a, const InertiaInvariants& e) {
  double worst = std::abs(a.m - e.m) / e.m;
  const auto take = [&](double x) { worst = std::max(worst, x); };
  take(relative_error(a.m_u, e.m_u));
  take(relative_error(a.P_u, e.P_u));
  if (e.modes() == 0) return worst;
  take(relative_error(a.S, e.S));
  double scale_i = 0.0, error_i = 0.0, scale_ij = 0.0, error_ij = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    scale_i = std::max(scale_i, e.Si[i].cwiseAbs().maxCoeff());
    error_i = std::max(error_i, (a.Si[i] - e.Si[i]).cwiseAbs().maxCoeff());
    for (std::size_t k = 0; k < 3; ++k) {
      scale_ij = std::max(scale_ij, e.Sij[i][k].cwiseAbs().maxCoeff());
      error_ij = std::max(error_ij, (a.Sij[i][k] - e.Sij[i][k]).cwiseAbs().maxCoeff());
    }
  }
  take(error_i / scale_i);
  take(error_ij / scale_ij);
  return worst;
}

}  // namespace floatframe::test

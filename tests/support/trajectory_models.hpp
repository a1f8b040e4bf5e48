#pragma once
// The flexible pendulum and slider-crank of tests/data/trajectories as models, with the modes and
// invariants that the reference files hold, so that only the formulations and the integrator are
// compared.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "support/descriptions.hpp"

namespace floatframe::trajectories {

using nlohmann::json;

inline json load_reference(const std::string& name) {
  std::ifstream file(std::string(FLOATFRAME_TEST_DATA) + "/trajectories/" + name + ".json");
  return json::parse(file);
}

inline FlexibleBody reference_body(const json& b,
                                   const std::vector<std::pair<int, double>>& masses = {}) {
  FlexibleBody f;
  const int nm = static_cast<int>(b["K_modal"].size());
  const json& v = b["invariants"];
  f.invariants = InertiaInvariants::zero(nm);
  f.invariants.m = v["m"];
  for (int i = 0; i < 3; ++i) {
    f.invariants.m_u[i] = v["m_bar_u"][i];
    for (int j = 0; j < 3; ++j) f.invariants.P_u(i, j) = v["P_bar_u"][i][j];
    for (int k = 0; k < nm; ++k) {
      f.invariants.S(i, k) = v["S"][i][k];
      for (int j = 0; j < 3; ++j) {
        f.invariants.Si[i](j, k) = v["S_i"][i][j][k];
        for (int l = 0; l < nm; ++l) f.invariants.Sij[i][j](l, k) = v["S_ij"][i][j][l][k];
      }
    }
  }
  f.K = f.D = MatX::Zero(nm, nm);
  for (int i = 0; i < nm; ++i)
    for (int j = 0; j < nm; ++j) f.K(i, j) = b["K_modal"][i][j];
  f.K = (0.5 * (f.K + f.K.transpose())).eval();
  const int n = static_cast<int>(b["nodes"].size());
  for (int k = 0; k < n; ++k) {
    ModalNode m;
    m.name = "n" + std::to_string(k);
    for (int i = 0; i < 3; ++i) m.p[i] = b["nodes"][k][i];
    m.X = m.X_theta = Mat3X::Zero(3, nm);
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < nm; ++c) {
        m.X(i, c) = b["X"][6 * k + i][c];
        m.X_theta(i, c) = b["X"][6 * k + 3 + i][c];
      }
    f.nodes.push_back(m);
  }
  // Isoparametric projection data: linear elements of the same mass.
  auto p = std::make_shared<ProjectionData>();
  p->p = Mat3X::Zero(3, n);
  p->X = MatX::Zero(3 * n, nm);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int k = 0; k < n; ++k) {
    p->p.col(k) = f.nodes[k].p;
    p->X.middleRows<3>(3 * k) = f.nodes[k].X;
  }
  for (const json& e : b["elements"]) {
    const int a = e["nodes"][0], c = e["nodes"][1];
    const double mass =
        b["rho"].get<double>() * e["A"].get<double>() * (p->p.col(a) - p->p.col(c)).norm();
    triplets.emplace_back(a, a, mass / 3.0);
    triplets.emplace_back(c, c, mass / 3.0);
    triplets.emplace_back(a, c, mass / 6.0);
    triplets.emplace_back(c, a, mass / 6.0);
  }
  for (const auto& [node, mass] : masses) {
    triplets.emplace_back(node, node, mass);
    const ModalNode& m = f.nodes[node];
    InertiaInvariants& w = f.invariants;
    w.m += mass;
    w.m_u += mass * m.p;
    w.P_u += mass * m.p * m.p.transpose();
    w.S += mass * m.X;
    for (int i = 0; i < 3; ++i) {
      w.Si[i] += mass * m.p[i] * m.X;
      for (int j = 0; j < 3; ++j) w.Sij[i][j] += mass * m.X.row(i).transpose() * m.X.row(j);
    }
  }
  p->M_s.resize(n, n);
  p->M_s.setFromTriplets(triplets.begin(), triplets.end());
  f.projection = p;
  return f;
}

/// One point to compare: output columns and reference columns by name.
struct TrajectoryCase {
  ModelDescription description;
  std::vector<std::string> columns;  ///< of the reference csv, in the order of the outputs
};

inline void add_point(ModelDescription& d, TrajectoryCase& c, const std::string& body,
                      const std::string& node, const std::string& label, const std::string& axes) {
  for (const char axis : axes) {
    d.outputs.push_back(
        test::make_output(label + "_" + axis, {body, Vec3::Zero(), node, {}}, axis - 'x'));
    c.columns.push_back(label + "_" + axis);
  }
}

inline TrajectoryCase pendulum(const std::string& variant) {
  const json j = load_reference("pendulum_" + variant);
  TrajectoryCase c;
  ModelDescription& d = c.description;
  d.name = "pendulum_" + variant;
  d.gravity = Vec3(0, -9.81, 0);
  d.bodies = {test::make_body("beam", reference_body(j["bodies"][0]))};
  d.joints = {test::make_joint("hinge", JointType::revolute, "ground", "beam")};
  VecX y(6);
  for (int i = 0; i < 6; ++i) y[i] = j["initial"]["z"][1 + i];
  d.amplitudes["beam"] = y;
  add_point(d, c, "beam", "n10", "tip", "xyz");
  add_point(d, c, "beam", "n5", "mid", "xyz");
  d.simulation.tolerance = 1e-11;
  return c;
}

/// The slider is the reference's point mass on the last node of the rod; the guide is a massless
/// body on a slide.
inline TrajectoryCase slider_crank(const std::string& variant) {
  const json j = load_reference("slider_crank_" + variant);
  TrajectoryCase c;
  ModelDescription& d = c.description;
  d.name = "slider_crank_" + variant;
  d.gravity = Vec3(0, -9.81, 0);
  const Vec3 pin_at(0.15, 0, 0), slider_at(0.45, 0, 0);
  d.bodies = {test::make_body("crank", reference_body(j["bodies"][0])),
              test::make_body("rod", reference_body(j["bodies"][1], {{8, 0.02}}), pin_at),
              test::make_body("guide", RigidDescription{}, slider_at)};
  // Planar: the guide holds only the height of the slider, so it is joined by a point on the line
  // of motion.
  d.joints = {
      test::make_joint("hinge", JointType::revolute, "ground", "crank"),
      test::make_joint("pin", JointType::revolute, "crank", "rod", pin_at),
      test::make_joint("slide", JointType::prismatic, "ground", "guide", slider_at, Vec3::UnitX()),
      test::make_joint("ball", JointType::revolute, "guide", "rod", slider_at)};
  d.joints[0].position = {j["initial"]["z"][0]};
  d.joints[0].velocity = {j["initial"]["zdot"][0]};
  add_point(d, c, "rod", "n8", "slider", "x");
  add_point(d, c, "crank", "n4", "crank_tip", "xy");
  add_point(d, c, "rod", "n4", "rod_mid", "xy");
  d.simulation.tolerance = 1e-12;
  return c;
}

struct Csv {
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;
  std::size_t column(const std::string& name) const {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (header[i] == name) return i;
    return header.size();
  }
};

inline Csv read_csv(const std::string& path) {
  Csv c;
  std::ifstream file(path);
  std::string line, cell;
  std::getline(file, line);
  for (std::stringstream s(line); std::getline(s, cell, ',');) c.header.push_back(cell);
  while (std::getline(file, line)) {
    c.rows.emplace_back();
    for (std::stringstream s(line); std::getline(s, cell, ',');)
      c.rows.back().push_back(std::stod(cell));
  }
  return c;
}

}  // namespace floatframe::trajectories

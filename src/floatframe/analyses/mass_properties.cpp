#include "floatframe/analyses/mass_properties.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/inertia/inertia_terms.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/results/json_values.hpp"
#include "floatframe/results/notes_text.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/stepping/simulation_options.hpp"

namespace floatframe {
namespace {

/// J = tr(P) I - P, (2); and back, P = tr(J)/2 I - J.
Mat3 inertia_of_planar(const Mat3& P) { return P.trace() * Mat3::Identity() - P; }
Mat3 planar_of_inertia(const Mat3& J) { return 0.5 * J.trace() * Mat3::Identity() - J; }

/// One body whose frame is at p_WB, R_WB.
BodyMass mass_of_body(const Body& body, InertiaMethod method, const Vec3& p_WB, const Mat3& R_WB,
                      const VecX& y) {
  BodyMotion motion;  // about the origin of its frame
  motion.A = R_WB;
  motion.y = y;
  const bool projected = method == InertiaMethod::projection && body.modes() > 0;
  const MatX M = projected ? relative_projection(*body.data, motion).M
                           : relative_preprocessing(*body.data, motion).M;
  const Mat3 coupling = M.block<3, 3>(3, 0);  // skew(s), (3)
  const Vec3 s = 0.5 * Vec3(coupling(2, 1) - coupling(1, 2), coupling(0, 2) - coupling(2, 0),
                            coupling(1, 0) - coupling(0, 1));
  BodyMass b;
  b.name = body.name;
  b.mass = M(0, 0);
  const Vec3 p_BC = b.mass > 0.0 ? Vec3(s / b.mass) : Vec3::Zero().eval();
  b.centre = p_WB + p_BC;
  const Mat3 P = planar_of_inertia(M.block<3, 3>(3, 3)) - b.mass * p_BC * p_BC.transpose();
  b.inertia = inertia_of_planar(P);
  return b;
}

/// (1), (2)
void add_up(ModelMass& whole) {
  Vec3 moment = Vec3::Zero();
  for (const BodyMass& b : whole.bodies) {
    whole.mass += b.mass;
    moment += b.mass * b.centre;
  }
  if (!(whole.mass > 0.0))
    throw InputError(ErrorCode::singular, "found bodies without mass, expected one with mass");
  whole.centre = moment / whole.mass;
  Mat3 P = Mat3::Zero();
  for (const BodyMass& b : whole.bodies) {
    const Vec3 d = b.centre - whole.centre;
    P += planar_of_inertia(b.inertia) + b.mass * d * d.transpose();
  }
  whole.inertia = inertia_of_planar(P);
  const SymmetricEigen principal = symmetric_eigen(whole.inertia);
  whole.principal_moments = principal.values;
  Mat3& A = whole.principal_axes;
  A = principal.vectors;
  for (int i = 0; i < 2; ++i)
    if (A.col(i).maxCoeff() < -A.col(i).minCoeff()) A.col(i) *= -1.0;
  A.col(2) = A.col(0).cross(A.col(1));
}

/// Values that round to zero relative to `scale` are zero.
std::string mass_number(double value, double scale) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-12 * scale ? 0.0 : value);
}

std::string mass_text(const Model& model, const ModelMass& p) {
  const double size = p.centre.norm() + std::sqrt(p.principal_moments[2] / p.mass);  // [m]
  const auto vector = [](const Vec3& v, double scale) {
    return std::vector<std::string>{mass_number(v.x(), scale), mass_number(v.y(), scale),
                                    mass_number(v.z(), scale)};
  };
  const auto row = [](std::string name, const std::vector<std::string>& values) {
    std::vector<std::string> cells{std::move(name)};
    cells.insert(cells.end(), values.begin(), values.end());
    return cells;
  };
  TextTable whole({"", "x", "y", "z"}), bodies({"body", "mass [kg]", "x [m]", "y [m]", "z [m]"});
  whole.add(row("centre of mass [m]", vector(p.centre, size)));
  const char* axes[] = {"inertia tensor [kg m2]  x", "                        y",
                        "                        z"};
  for (int i = 0; i < 3; ++i)
    whole.add(row(axes[i], vector(p.inertia.row(i), p.principal_moments[2])));
  TextTable principal({"principal moment [kg m2]", "axis x", "y", "z"});
  for (int i = 0; i < 3; ++i)
    principal.add(row(mass_number(p.principal_moments[i], p.principal_moments[2]),
                      vector(p.principal_axes.col(i), 1.0)));
  for (const BodyMass& b : p.bodies) {
    std::vector<std::string> cells = vector(b.centre, size);
    cells.insert(cells.begin(), mass_number(b.mass, p.mass));
    bodies.add(row(b.name, cells));
  }
  return fmt::format("{}: mass {:.6g} kg, t = {:g} s\n\n", model.name, p.mass, p.time) +
         whole.text(2) + '\n' + principal.text(2) + '\n' + bodies.text(2) +
         "\nWorld axes. The inertia tensor is that about the centre of mass, with negative "
         "products off the diagonal;\nx, y, z of a body: its centre of mass.\n" +
         notes_text(p.start.notes);
}

std::string mass_json(const Model& model, const ModelMass& p) {
  using Json = nlohmann::ordered_json;
  Json bodies = Json::array();
  for (const BodyMass& b : p.bodies)
    bodies.push_back({{"name", b.name},
                      {"mass_kg", b.mass},
                      {"centre_of_mass_m", json_array(b.centre)},
                      {"inertia_kg_m2", json_rows(b.inertia)}});
  return json_document({{"model", model.name},
                        {"time_s", p.time},
                        {"mass_kg", p.mass},
                        {"centre_of_mass_m", json_array(p.centre)},
                        {"inertia_kg_m2", json_rows(p.inertia)},
                        {"principal_moments_kg_m2", json_array(p.principal_moments)},
                        {"principal_axes", json_rows(p.principal_axes.transpose())},
                        {"bodies", bodies},
                        {"start", start_json(p.start)}});
}

}  // namespace

ModelMass mass_properties(const Model& model, const SimulationOptions& options) {
  const SimulationDescription d = described(built(model), options);
  const std::optional<Model> changed = started_model(model, d);
  const Model& started = changed ? *changed : model;
  RelativeFormulation f(started, d.inertia);
  ModelMass whole;
  const State state = start_state(f, d, &whole.start);
  kinematics_at(f, state);
  whole.time = state.t;
  const SystemMotion& motion = f.motion();
  for (std::size_t i = 0; i < started.bodies.size(); ++i) {
    const BodyKinematics& b = motion.bodies[i];
    whole.bodies.push_back(mass_of_body(started.bodies[i], d.inertia, b.p_WB, b.R_WB, b.y));
  }
  add_up(whole);
  return whole;
}

Analysis mass_properties_analysis() {
  return {.name = "mass",
          .help =
              "Show the mass [kg], its centre [m] and the inertia tensor [kg m2] of all bodies "
              "together",
          .json_help = "JSON on standard output (kg, m, kg m2)",
          .footer =
              "Where a run of the model starts, with flexible bodies deformed as they are there.\n"
              "Exit codes: 0 done, 1 the start cannot be found, 2 bad input.",
          .run = [](const Model& model) {
            const ModelMass p = mass_properties(model);
            return AnalysisReport{.text = mass_text(model, p), .json = mass_json(model, p)};
          }};
}

}  // namespace floatframe

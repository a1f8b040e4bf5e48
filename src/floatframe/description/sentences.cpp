#include "floatframe/description/sentences.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/math/rigid_motion.hpp"

namespace floatframe::sentences {

namespace {

/// "[1, 2, 3]", to a nanometre.
std::string point_text(const Vec3& p) {
  std::string text;
  for (const double x : p)
    text += (text.empty() ? "[" : ", ") + number_text(std::round(x * 1e9) / 1e9);
  return text + ']';
}

}  // namespace

Complaint inertia(const Mat3& J) {
  const Vec3 p = Eigen::SelfAdjointEigenSolver<Mat3>(J, Eigen::EigenvaluesOnly).eigenvalues();
  const double slack = 1e-9 * p.cwiseAbs().maxCoeff();
  const auto shown = [&](int i) { return number_text(std::round(p[i] * 1e9) / 1e9); };
  if (p[0] < -slack)
    return "found the principal moment " + shown(0) + ", expected none below 0 [kg m2]";
  if (p[0] + p[1] < p[2] - slack)
    return "found the principal moments " + shown(0) + ", " + shown(1) + " and " + shown(2) +
           ", expected none larger than the sum of the other two [kg m2]";
  return std::nullopt;
}

Complaint tube(double outer, double inner) {
  if (inner < outer) return std::nullopt;
  return "found the inner diameter " + number_text(inner) + ", expected less than the outer one, " +
         number_text(outer) + " [m]";
}

Complaint bar_length(double length) {
  if (length > 1e-9) return std::nullopt;
  return "found length " + number_text(length) + ", expected a bar of positive length [m]";
}

bool parallel_to_bar(const Vec3& axis, const Vec3& direction) {
  return direction.cross(axis).norm() <= 1e-3 * direction.norm() * axis.norm();
}

Complaint bar_reference(const Vec3& axis, const Vec3& reference) {
  if (!parallel_to_bar(axis, reference)) return std::nullopt;
  return "found a direction parallel to the bar, expected another";
}

Complaint section_inertia(bool section_inertia, bool isoparametric) {
  if (!section_inertia || !isoparametric) return std::nullopt;
  return "found true with the isoparametric mass model, expected mass_model six_dof or hermite";
}

Complaint analytic_shapes(std::size_t bars, std::size_t masses) {
  if (bars <= 1 && masses == 0) return std::nullopt;
  return "analytic shapes need one straight bar without masses, found " + std::to_string(bars) +
         " bars and " + std::to_string(masses) + " masses";
}

Complaint more_modes_than_dofs(int modes, std::size_t nodes, bool isoparametric) {
  const auto rows = static_cast<long>(nodes) * (isoparametric ? 3 : 6);
  if (modes <= rows) return std::nullopt;
  return "found " + std::to_string(modes) + " modes, expected at most " + std::to_string(rows) +
         ", the number of degrees of freedom with mass";
}

std::string dof_twice(const std::string& node, unsigned dof) {
  return std::string("the direction ") + node_dof_words[dof] + " of '" + node +
         "' is named twice in clamped and static_modes, expected once";
}

std::string no_modes() {
  return "found no modes, expected static_modes, normal_modes, analytic or basis";
}

std::string no_bars() { return "found no bars, expected at least one"; }

std::string unknown_bar(const std::string& name, const std::string& hint) {
  return "unknown bar '" + name + "'" + hint + " (a bar must be defined before it is used)";
}

std::string no_end_point(const std::string& name) {
  return "found '" + name + "', expected an end point of a bar of this body";
}

std::string bar_not_connected(const std::string& first_bar) {
  return "the bar is not connected to '" + first_bar +
         "', expected all bars of a body to be connected";
}

Complaint body_reference(const std::vector<std::pair<Vec3, unsigned>>& clamped) {
  // Rows of the rigid motions at these degrees of freedom, about their middle, in units of their
  // extent, must have rank 6.
  Vec3 centre = Vec3::Zero();
  double size = 0.0;
  for (const auto& [p, dof] : clamped) centre += p / static_cast<double>(clamped.size());
  for (const auto& [p, dof] : clamped) size = std::max(size, (p - centre).norm());
  if (!(size > 0.0)) size = 1.0;
  MatX rows(static_cast<Eigen::Index>(clamped.size()), 6);
  for (std::size_t i = 0; i < clamped.size(); ++i) {
    const Vec3 p = (clamped[i].first - centre) / size;
    rows.row(static_cast<Eigen::Index>(i)) = rigid_motion_at(p).row(clamped[i].second);
  }
  const Eigen::Index rank = pivoted_rank(rows, 1e-9);
  if (rank >= 6) return std::nullopt;
  return "these degrees of freedom leave " + std::to_string(6 - rank) +
         (rank == 5 ? " rigid motion" : " rigid motions") + " of the body free, expected none";
}

std::string ground_is_no_body() { return "found ground, expected a body"; }
std::string node_on_ground() { return "found a node on the ground, expected a flexible body"; }

std::string node_on_rigid_body(const std::string& body) {
  return "found a node on the rigid body '" + body + "', expected a flexible body";
}

std::string no_node_named(const std::string& body, bool flexible, const std::string& node) {
  return std::string("the ") + (flexible ? "flexible body" : "body") + " '" + body +
         "' has no node '" + node + "'";
}

std::string no_node_at(const Vec3& point, const std::string& body, const Vec3* nearest) {
  return "found the point " + point_text(point) + " on the flexible body '" + body +
         "', expected " +
         (nearest ? "one of its nodes; the nearest is at " + point_text(*nearest)
                  : "the origin of its frame, because it has no nodes");
}

std::string rigid_body_has_no_modes(bool switched) {
  return switched ? "found a body that is switched to rigid (flexible: false) and has no modal "
                    "amplitudes, expected a flexible one"
                  : "found a rigid body, expected a flexible one";
}

Complaint direction(const Vec3& v) {
  if (v.stableNorm() > 0.0) return std::nullopt;
  return "found a vector of length zero, expected a direction";
}

Complaint second_axis(const Vec3& axis, const Vec3& axis_2) {
  if (!(axis.stableNormalized().cross(axis_2.stableNormalized()).norm() < 1e-6))
    return std::nullopt;
  return "found a direction parallel to 'axis', expected another";
}

std::string ground_as_child() {
  return "found ground, expected a body (the ground may be the parent)";
}
std::string child_is_parent() { return "found the same body as the parent, expected another"; }

std::string road_with_width(const std::string& road, const std::string& type) {
  return "found '" + road + "', a road with width, expected one of a profile alone for '" + type +
         "', or another type of tyre";
}

std::string patch_range(double low, double high) {
  return "found " + number_text(low) + " to " + number_text(high) +
         ", expected two ascending numbers [from, to] [m]";
}

std::string element_of_another_list(const std::string& type) {
  return "found " + type +
         ", expected rods, constraints, couplings and controllers in the lists of these, motions "
         "in "
         "joints, and all others in that of forces";
}
std::string both_ends_on(const std::string& body) {
  return "found both ends on '" + body + "', expected two bodies";
}

Complaint rod_ends(const Vec3& a, const Vec3& b) {
  if ((a - b).norm() > 1e-9) return std::nullopt;
  return "found length 0, expected two points apart";
}

Complaint spring_ends(const Vec3& a, const Vec3& b) {
  if ((a - b).norm() > 1e-9) return std::nullopt;
  return "found both ends at the same point, expected two points apart";
}

std::string no_law(const std::vector<const char*>& laws) {
  return "found no law, expected " + alternatives(laws);
}

std::string force_matrix_rows(std::size_t rows) {
  return "found " + std::to_string(rows) + " rows, expected 6 rows of 6 numbers, or 2 rows of 2";
}

Complaint force_matrix(const MatX& M) {
  if (M.rows() != M.cols() || (M.rows() != 6 && M.rows() != 2))
    return "found " + std::to_string(M.rows()) + " x " + std::to_string(M.cols()) +
           " numbers, expected 6 x 6 or 2 x 2";
  if (!M.allFinite()) return "found numbers that are not finite, expected finite ones";
  return std::nullopt;
}

Complaint speed_table(const MatX& rows) {
  if (rows.rows() < 1 || rows.cols() != 9)
    return "found " + std::to_string(rows.rows()) + " x " + std::to_string(rows.cols()) +
           " numbers, expected rows of 9: a speed, four stiffnesses, four dampings";
  if (!rows.allFinite()) return "found numbers that are not finite, expected finite ones";
  for (Eigen::Index i = 0; i + 1 < rows.rows(); ++i)
    if (!(rows(i, 0) < rows(i + 1, 0)))
      return "found the speed " + number_text(rows(i + 1, 0)) + " after " +
             number_text(rows(i, 0)) + ", expected ascending speeds [rad/s]";
  return std::nullopt;
}

std::string table_rows(Eigen::Index rows, Eigen::Index columns,
                       std::span<const char* const> words) {
  std::string listed;
  for (const char* word : words) listed += (listed.empty() ? "" : ", ") + std::string(word);
  return "found " + std::to_string(rows) + " x " + std::to_string(columns) +
         " numbers, expected rows of " + std::to_string(words.size()) + ": " + listed;
}

Complaint kinetic_friction(double kinetic, double breakaway) {
  if (kinetic <= breakaway) return std::nullopt;
  return "found " + number_text(kinetic) + ", expected at most the breakaway friction, " +
         number_text(breakaway);
}

Complaint normal_force(const SignalDescription& normal) {
  const std::vector<PiecewisePolynomial::Piece>& pieces = normal.pieces.pieces();
  const bool constant = normal.input.empty() && normal.source == SignalSource::none &&
                        normal.sines.empty() && !normal.formula && pieces.size() == 1 &&
                        pieces[0].coefficients.size() == 1;
  if (!constant || !(pieces[0].coefficients[0] < 0.0)) return std::nullopt;
  return "found " + number_text(pieces[0].coefficients[0]) + ", expected a number >= 0";
}

std::string is_for(const std::string& use) { return "is for " + use + "; remove this key"; }

std::string reaction_of(const std::string& type) {
  return "found a " + type + " joint, expected one that moves along or about its axis only";
}

Complaint bearing_stiffness(const MatX& K) {
  if (K.rows() < 6 || (K.row(5).isZero(0.0) && K.col(5).isZero(0.0))) return std::nullopt;
  return "found numbers in the sixth row or column, expected zeros: a bearing lets the shaft turn "
         "about its axis (use a bushing or a joint_spring to hold it)";
}

std::string function_in_file(const std::string& found) {
  return "found " + found +
         ", expected {formula: ...}, or a function that a program gives (C++, Python)";
}

std::string law_on_what() {
  return "found neither from and to nor a joint, or both: expected one of them, for the law to act "
         "on";
}

std::string target_without_law() {
  return "found without spring and damper, expected a law that pulls to the target";
}

std::string stop_with_target() {
  return "found with a target, of which the spring is a law; remove this key, and write the stop "
         "as "
         "another force";
}

std::string motion_and_start_value() {
  return "found with a prescribed motion, which decides it; remove this key";
}

std::string length_of_driven_rod() {
  return "found with a motion, which decides it; remove one of them";
}

std::string no_path(const std::string& constraint) {
  return "constraint '" + constraint +
         "' has no path, expected one of type 'slide_along', or 'point_on_curve' with points";
}

std::string rod_motion(double length) {
  return "found a motion with the length " + number_text(length) +
         " m at t = 0, expected a positive one";
}

std::string driven_twice(const std::string& coordinate) {
  return "found two motions of the " + coordinate + ", expected one";
}

std::string undrivable_coordinate(const std::string& type) {
  return "the rotation vector of a " + type +
         " joint has no coordinates that a motion can prescribe: expected revolute joints in a "
         "row, or a universal joint";
}

std::string coordinate_of_rotation_vector(const std::string& type) {
  return "found the rotation vector of a " + type +
         " joint, expected a displacement, or an angle about an axis: revolute joints in a row, or "
         "a universal joint";
}

std::string joint_without_coordinates(const std::string& type) {
  return "found a " + type + " joint, expected one with a coordinate";
}

std::string no_stop() { return "found neither 'lower' nor 'upper', expected at least one of them"; }

std::string stops_ascend(double lower, double upper) {
  return "found " + number_text(upper) + ", expected more than 'lower', " + number_text(lower);
}

std::string keep_without_start_value() {
  return "found without 'position' and 'velocity', expected one of them to keep";
}

std::string weld_has_no_coordinates() { return "a weld has no coordinates; remove this key"; }

std::string not_used_by_joint(const std::string& type) {
  return "is not used by a " + type + " joint; remove this key";
}

Complaint unit(const std::string& unit) {
  const bool plain = std::all_of(unit.begin(), unit.end(), [](unsigned char c) {
    return c >= ' ' && c != '"' && c != ',' && c != '[' && c != ']' && c != 127;
  });
  if (plain && unit.size() <= 20) return std::nullopt;
  return "expected a unit of at most 20 characters without commas, quotes and brackets";
}

Complaint clamp_without_limits(bool clamp, const std::optional<double>& low,
                               const std::optional<double>& high) {
  if (!clamp || low || high) return std::nullopt;
  return "found true without limits, expected min, max or both";
}

Complaint input_limits(const std::optional<double>& low, const std::optional<double>& high) {
  if (!low || !high || *low < *high) return std::nullopt;
  return "found " + number_text(*high) + ", expected a number above min, " + number_text(*low);
}

Complaint input_initial(double initial, const std::optional<double>& low,
                        const std::optional<double>& high) {
  if (!((low && initial < *low) || (high && initial > *high))) return std::nullopt;
  return "found " + number_text(initial) + ", expected a number " +
         (low && initial < *low ? "not below min, " + number_text(*low)
                                : "not above max, " + number_text(*high));
}

std::string tyre_of_two_wheels(const std::string& tyre) {
  return "found '" + tyre + "', which another wheel has, expected a tyre for each wheel";
}

std::string no_axle() { return "found no axle, expected one or more, from the front to the rear"; }

std::string ratio_of_zero() { return "found 0, expected another number: the input does nothing"; }

Complaint model_name(const std::string& name) {
  if (name.size() > 100) return "expected a name of at most 100 characters";  // it names a folder
  if (name.starts_with(' ') || name.ends_with(' '))
    return "expected a name without blanks at its ends";
  if (name.find_first_of("/\\") == std::string::npos && printable(name) == name && name != "." &&
      name != "..")
    return std::nullopt;
  return "expected a name without slashes and control characters";
}

Complaint min_step(double min_step, double step) {
  if (!(min_step > step)) return std::nullopt;
  return "found " + number_text(min_step) + ", expected at most the step, " + number_text(step) +
         " [s]";
}

std::string offset_alone() {
  return "found without 'equilibrium: true' or 'state', expected where to start from";
}

Complaint steps(double duration, double step) {
  if (!(duration > rules::most_steps * step)) return std::nullopt;
  return "a duration of " + number_text(duration) + " s with a step of " + number_text(step) +
         " s takes more than " + number_text(rules::most_steps) + " steps";
}

}  // namespace floatframe::sentences

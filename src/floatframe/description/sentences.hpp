#pragma once
// Rules of descriptions beyond single numbers, each with its one sentence. The reader of model
// files and `validate` prepend the path and the position. nullopt: valid.
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/description/attachment.hpp"
#include "floatframe/math/piecewise_polynomial.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe::sentences {

using Complaint = std::optional<std::string>;

// Bodies.
/// Principal moments below zero, or one larger than the sum of the others.
Complaint inertia(const Mat3& J);
Complaint tube(double outer, double inner);
Complaint bar_length(double length);
/// For a bar along `axis`.
Complaint bar_reference(const Vec3& axis, const Vec3& reference);
bool parallel_to_bar(const Vec3& axis, const Vec3& direction);
Complaint section_inertia(bool section_inertia, bool isoparametric);
Complaint analytic_shapes(std::size_t bars, std::size_t masses);
Complaint more_modes_than_dofs(int modes, std::size_t nodes, bool isoparametric);
std::string dof_twice(const std::string& node, unsigned dof);
std::string no_modes();
std::string no_bars();
/// `hint`: ", did you mean ...?" or nothing.
std::string unknown_bar(const std::string& name, const std::string& hint);
std::string no_end_point(const std::string& name);
std::string bar_not_connected(const std::string& first_bar);
/// Positions of the clamped degrees of freedom, each with its direction 0..5 = x y z rx ry rz.
Complaint body_reference(const std::vector<std::pair<Vec3, unsigned>>& clamped);

// Points on bodies, and requirements on bodies without modes.
std::string ground_is_no_body();
std::string node_on_ground();
std::string node_on_rigid_body(const std::string& body);
/// No node of that name, on a flexible body or one that is switched to rigid.
std::string no_node_named(const std::string& body, bool flexible, const std::string& node);
/// `nearest`: nullptr if the body has no nodes.
std::string no_node_at(const Vec3& point, const std::string& body, const Vec3* nearest);
std::string rigid_body_has_no_modes(bool switched);

// Joints, forces, roads.
Complaint direction(const Vec3& v);
Complaint second_axis(const Vec3& axis, const Vec3& axis_2);
std::string ground_as_child();
std::string child_is_parent();
std::string both_ends_on(const std::string& body);
/// An element that feels a profile alone, on a road with heights over x and y.
std::string road_with_width(const std::string& road, const std::string& type);
std::string patch_range(double low, double high);
std::string element_of_another_list(const std::string& type);
/// A signal names a second element; `first`: the key of the other one.
std::string one_source(SignalSource first);
/// A signal of an element that has no such result, for example the length of a load.
std::string element_without(const std::string& type, SignalSource source);
/// Elements whose forces depend on each other at once, in order.
std::string missing_formula();
/// A motion has another reference than the time.
std::string formula_not_of_time(const Formula& formula);
/// A motion by a formula jumps there.
std::string formula_jumps(double by, double at);
std::string formula_and_source(SignalSource source);
/// What a formula refers to is not there; a suggestion follows.
std::string formula_name(const std::string& name);
std::string formula_function(const std::string& name);
std::string no_such_entity(const std::string& function, const char* kind, const std::string& name);
/// `rate` of a joint and a force of one name.
std::string rate_of_two(const std::string& name);
/// Outputs of more than one place or component.
std::string named_measures_only(const std::string& function);
std::string formula_component(const std::string& function, const std::string& found,
                              std::span<const char* const> words);
std::string one_argument(const std::string& function);
std::string formula_coordinate(const std::string& joint, const std::string& found, int count);
/// A measure about the origin, in a subsystem with a mirror elsewhere.
std::string off_the_mirror(const std::string& name);
/// An output with a formula cannot be one of its references.
std::string formula_of_a_formula(const std::string& name);
/// Of a force law: another reference than x, v and t.
std::string formula_of_law(const std::string& name);
/// Of a formula of one variable: another reference.
Complaint formula_of_one(const Formula& f, const std::string& variable);
std::string ring_of_signals(const std::vector<std::string>& elements);
Complaint rod_ends(const Vec3& a, const Vec3& b);
Complaint spring_ends(const Vec3& a, const Vec3& b);
/// `laws`: the keys, one of which is needed.
std::string no_law(const std::vector<const char*>& laws);
/// 6 x 6 or 2 x 2, finite.
Complaint force_matrix(const MatX& M);
std::string force_matrix_rows(std::size_t rows);
/// Rows of a speed and eight coefficients.
Complaint speed_table(const MatX& rows);
std::string table_rows(Eigen::Index rows, Eigen::Index columns, std::span<const char* const> words);
Complaint kinetic_friction(double kinetic, double breakaway);
/// `key` is missing because of `why`.
std::string controller_needs(const std::string& key, const std::string& why);
std::string controller_without_gain();
std::string filter_and_rate();
std::string controller_limits(double lower, double upper);
std::string initial_beyond_limits(double initial);
std::string not_whole(double number);
/// Of a delay that would need more than `most` numbers of its past.
std::string long_delay(double time, double step, double count, double most);
/// Of a key that is used with others only.
std::string unused_without(const std::string& others);
std::string excludes(const std::string& key);
/// One of these keys is needed.
std::string none_given(const std::vector<const char*>& keys);
/// An empty list of signals.
std::string no_signals();
/// Of a controller.
std::string no_such_value(const std::string& found, const std::vector<std::string>& names);
std::string signals_of_file(std::size_t found, const std::vector<std::string>& inputs);
std::string too_many_states(Eigen::Index states, Eigen::Index most);
std::string names_of_values(std::size_t names, Eigen::Index rows);
std::string matrix_size(Eigen::Index rows, Eigen::Index columns, Eigen::Index expected_rows,
                        Eigen::Index expected_columns);
/// Of a transfer function: a matrix, or too many; the first one; degrees.
std::string coefficients(Eigen::Index rows, Eigen::Index columns, Eigen::Index most);
std::string leading_coefficient();
std::string improper(Eigen::Index numerator, Eigen::Index denominator);
/// Of sampled controllers: values that linear systems hold; steps that do not fit; too many values
/// that wait.
std::string held_samples(const std::vector<std::string>& names);
std::string sample_off_step(const std::string& key, double value, double step);
std::string step_over_samples(const std::string& element, double period, double step, double most);
std::string long_delay(double delay, double period, int most);
/// A constant that is negative.
Complaint normal_force(const SignalDescription& normal);
/// Of a key that others do not use.
std::string is_for(const std::string& use);
/// Of friction from the reaction of a joint of a type that has none for it.
std::string reaction_of(const std::string& type);
/// For a bearing, 6 x 6 or 2 x 2: nothing constrains the spin.
Complaint bearing_stiffness(const MatX& K);
/// Of a model file, where a function is expected.
std::string function_in_file(const std::string& found);
std::string law_on_what();
std::string target_without_law();
std::string stop_with_target();
std::string motion_and_start_value();
std::string length_of_driven_rod();
std::string no_path(const std::string& constraint);
std::string rod_motion(double length);
std::string driven_twice(const std::string& coordinate);
/// Components of rotation vectors.
std::string undrivable_coordinate(const std::string& type);
/// An element on a component of one.
std::string coordinate_of_rotation_vector(const std::string& type);
std::string joint_without_coordinates(const std::string& type);
std::string no_stop();
std::string stops_ascend(double lower, double upper);
std::string keep_without_start_value();
std::string weld_has_no_coordinates();
std::string not_used_by_joint(const std::string& type);
/// Of a function of time, which has one.
Complaint period(const TimeFunction& f, bool may_jump);
/// The piece at whose beginning the law jumps, and the sentence.
std::optional<std::pair<std::size_t, std::string>> jump(const PiecewisePolynomial& f);

// Inputs, outputs, the run.
Complaint unit(const std::string& unit);
Complaint clamp_without_limits(bool clamp, const std::optional<double>& low,
                               const std::optional<double>& high);
Complaint input_limits(const std::optional<double>& low, const std::optional<double>& high);
Complaint input_initial(double initial, const std::optional<double>& low,
                        const std::optional<double>& high);
/// The section `vehicle`.
std::string tyre_of_two_wheels(const std::string& tyre);
std::string no_axle();
std::string ratio_of_zero();

/// A component, counted from 0, that is not one of the `n`; a model file counts them from 1.
std::string number_of(const char* what, int component, int n, bool from_file);
std::string weld_does_not_move();
/// For the force or torque of a motor.
std::string joint_without_motion();
std::string without_mass(bool whole);
std::string without_axes(const std::string& quantity);
std::string without_reference(const std::string& quantity);
std::string rod_has_no_axes();
std::string force_without_point();
/// A prescribed force or torque has no length and no rate, and most elements no state.
std::string load_without(const std::string& type, const std::string& quantity);
Complaint column_name(const std::string& name);
/// For the whole name of a column: it already exists (`exists`), or is that of the time.
Complaint column_taken(const std::string& name, bool exists);
Complaint model_name(const std::string& name);
Complaint min_step(double min_step, double step);
std::string offset_alone();
/// More steps than a run can count and store.
Complaint steps(double duration, double step);

}  // namespace floatframe::sentences

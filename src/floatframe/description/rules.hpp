#pragma once
// Valid ranges of the numbers and words of a description, with their units. Used by the reader of
// model files and by `validate`.
#include "floatframe/core/number_rule.hpp"

namespace floatframe::rules {

// Enumerators by their words, in the order of the enumeration.
inline constexpr const char* tyre_laws[] = {"vertical", "radial"};
inline constexpr const char* mass_models[] = {"isoparametric", "six_dof", "hermite"};
inline constexpr const char* coordinates[] = {"relative", "absolute"};
inline constexpr const char* inertia_methods[] = {"preprocessing", "projection"};
inline constexpr const char* input_uses[] = {"held", "ramp"};
inline constexpr const char* axes[] = {"x", "y", "z"};
inline constexpr const char* reaction_axes[] = {"world", "parent", "child", "place"};
inline constexpr const char* shell_layers[] = {"top", "bottom"};
inline constexpr const char* quaternion[] = {"w", "x", "y", "z"};
inline constexpr const char* crossing_directions[] = {"any", "rising", "falling"};
inline constexpr const char* angles[] = {"roll", "pitch", "yaw"};

// Bodies.
inline constexpr NumberRule mass = non_negative_number("kg");
inline constexpr NumberRule young = positive_number("Pa");
inline constexpr NumberRule poisson{"a number above -1 and below 0.5", "", -1.0, 0.5, true, true};
inline constexpr NumberRule density = positive_number("kg/m3");
inline constexpr NumberRule damping_ratio{"a fraction of critical damping from 0 to 1", "", 0.0,
                                          1.0};
inline constexpr NumberRule section_length = positive_number("m");
inline constexpr NumberRule section_area = positive_number("m2");
inline constexpr NumberRule section_moment = positive_number("m4");
inline constexpr NumberRule fraction{"a number from 0 to 1", "", 0.0, 1.0};
inline constexpr NumberRule mode_frequency = positive_number("Hz");
inline constexpr WholeNumberRule elements{"a number of elements", 1, 100000};
inline constexpr WholeNumberRule normal_modes{"a number of modes, or {below: frequency},", 0,
                                              10000};
inline constexpr WholeNumberRule analytic_shapes{"a number of shapes", 0, 50};

/// A point of a flexible body within this distance of a node denotes the node [m].
inline constexpr double node_tolerance = 1e-6;

// Axes and points of joints that are corrected.
inline constexpr NumberRule snap_angle{"an angle from 0 to 0.1", "rad", 0.0, 0.1};
inline constexpr NumberRule snap_distance{"a part of the size of the loops from 0 to 0.1", "", 0.0,
                                          0.1};

// Forces and roads.
inline constexpr NumberRule sine_frequency = positive_number("Hz");
inline constexpr NumberRule chirp_frequency = non_negative_number("Hz");
inline constexpr NumberRule chirp_duration = positive_number("s");
inline constexpr NumberRule period = positive_number("s");
inline constexpr NumberRule rod_length = positive_number("m");
inline constexpr NumberRule tyre_radius = positive_number("m");
inline constexpr NumberRule tyre_stiffness = positive_number("N/m");
inline constexpr NumberRule tyre_damping = non_negative_number("N s/m");
inline constexpr NumberRule bump_length = positive_number("m");
inline constexpr NumberRule random_road_length = {"a length between 1 and 10000", "m", 1.0,
                                                  10000.0};
inline constexpr NumberRule track_width = positive_number("m");
inline constexpr NumberRule track_decay = non_negative_number("");
inline constexpr NumberRule road_friction = non_negative_number("");
inline constexpr std::size_t most_coefficients = 20;
inline constexpr const char* coefficients = "a list of 1 to 20 coefficients [c0, c1, ...]";

// The run.
inline constexpr NumberRule step = positive_number("s");
inline constexpr NumberRule duration = non_negative_number("s");
inline constexpr NumberRule output_interval = non_negative_number("s");
inline constexpr NumberRule min_step = non_negative_number("s");
inline constexpr NumberRule spectral_radius{"a number from 0 to 1", "", 0.0, 1.0};
// Smaller tolerances are below the rounding of coordinates of size 1: no step would converge. With
// larger ones (m, rad; m/s) no iteration takes place and loops stay open.
inline constexpr NumberRule tolerance{"a number from 1e-15 to 1", "", 1e-15, 1.0};
inline constexpr NumberRule penalty = non_negative_number("");
inline constexpr NumberRule position_tolerance{"a number from 1e-15 to 1", "m", 1e-15, 1.0};
inline constexpr NumberRule velocity_tolerance{"a number from 1e-15 to 1", "m/s", 1e-15, 1.0};
inline constexpr const char* recorded[] = {"none", "states"};
inline constexpr WholeNumberRule every{"a number of instants", 1, 1000000000};
inline constexpr WholeNumberRule max_iterations{"a number of iterations", 1, 1000};
inline constexpr double most_steps = 1e9;
inline constexpr std::size_t column_length = 200;

}  // namespace floatframe::rules

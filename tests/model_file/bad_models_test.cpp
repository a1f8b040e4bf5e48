// Every faulty model file of tests/data/bad_models with the sentences it must give, places
// included.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/model_file/model_reader.hpp"

namespace floatframe {
namespace {

const std::string folder = FLOATFRAME_TEST_DATA "/bad_models/";

std::string without_folder(std::string text) {
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
    text.erase(at, folder.size());
  return text;
}

std::string faults_of(const std::string& path,
                      const std::vector<ParameterOverride>& overrides = {}) {
  try {
    read_model(path, overrides);
  } catch (const InputError& error) {
    return without_folder(error.what());
  }
  return "no fault";
}

struct Case {
  const char* file;
  std::string expected;
};

const Case cases[] = {
    {"alias_and_merge.yaml",
     "alias_and_merge.yaml:2:20: anchors (&name) are not allowed, use parameters"
     "\n"
     "alias_and_merge.yaml:5:5: merge keys (<<) are not allowed, use parameters or subsystems"
     "\n"
     "alias_and_merge.yaml:5:9: aliases (*name) are not allowed, use parameters"},
    {"align_away.yaml",
     "align_away.yaml:6:19: bodies.arm.align.foot: the marker stays 0.009623105 m away from its "
     "point, expected at most 1e-06 m (align_tolerance)"
     "\n"
     "align_away.yaml:6:28: bodies.arm.align.knee: the marker stays 0.012830561 m away from its "
     "point, expected at most 1e-06 m (align_tolerance)"
     "\n"
     "align_away.yaml:6:36: bodies.arm.align.eye: the marker stays 0.022340765 m away from its "
     "point, expected at most 1e-06 m (align_tolerance)"},
    {"align_bars.yaml",
     "align_bars.yaml:10:12: bodies.arm.align: found with bars, which are in place already, "
     "expected a part from a file"},
    {"align_few.yaml",
     "align_few.yaml:6:12: bodies.arm.align: found 2 markers, expected at least three that do not "
     "lie on a line"},
    {"align_line.yaml",
     "align_line.yaml:6:12: bodies.arm.align: found points on a line, expected at least three that "
     "do not lie on a line"},
    {"align_rigid.yaml",
     "align_rigid.yaml:6:12: bodies.arm.align: found on a rigid body, expected a part with "
     "markers"},
    {"align_unknown.yaml",
     "align_unknown.yaml:7:12: bodies.arm.align: found with 'position', expected one of them"
     "\n"
     "align_unknown.yaml:7:22: bodies.arm.align.kne: the part has no marker 'kne', did you mean "
     "'knee'?"
     "\n"
     "align_unknown.yaml:7:35: bodies.arm.align.eye: unknown point 'f'"},
    {"amplitudes.yaml",
     "amplitudes.yaml:12:21: initial.amplitudes.arm: found a list of 2, expected a list of 1 "
     "amplitudes, one per mode"},
    {"analytic_frame.yaml",
     "analytic_frame.yaml:10:17: bodies.arm.flexible.analytic: analytic shapes need one straight "
     "bar without masses, found 2 bars and 0 masses"},
    {"anchor.yaml", "anchor.yaml:4:12: anchors (&name) are not allowed, use parameters"},
    {"bad_indentation.yaml", "bad_indentation.yaml:5:4: YAML syntax: end of map not found"},
    {"binary.yaml", "binary.yaml:2:7: this is not a text file (UTF-8)"},
    {"branch_without_node.yaml",
     "branch_without_node.yaml:9:36: bodies.arm.flexible.bars.two.from.at: found 0.3, but bar "
     "'one' has 4 elements and no node there; the nearest are at 1/4 = 0.25 and 2/4 = 0.5"},
    {"comment_only.yaml", "comment_only.yaml:1:1: the file is empty"},
    {"deep_nesting.yaml",
     "deep_nesting.yaml:2:58: lists and maps are nested too deeply, at most 50 levels are allowed"},
    {"division_by_zero.yaml",
     "division_by_zero.yaml:5:19: bodies.block.rigid.mass: in ${1 / zero}: division by zero"},
    {"dof_twice.yaml",
     "dof_twice.yaml:10:22: bodies.arm.flexible.static_modes[1]: the direction y of 'a' is named "
     "twice in clamped and static_modes, expected once"},
    {"duplicate_body.yaml", "duplicate_body.yaml:5:3: duplicate key 'block', first used in line 3"},
    {"duplicate_key.yaml", "duplicate_key.yaml:4:22: duplicate key 'mass', first used in line 4"},
    {"empty.yaml", "empty.yaml:1:1: the file is empty"},
    {"expression_syntax.yaml",
     "expression_syntax.yaml:4:19: bodies.block.rigid.mass: in ${2 * (3 + 1}: a ')' is missing"},
    {"expression_value.yaml",
     "expression_value.yaml:5:19: bodies.block.rigid.mass: found ${m - 5} = -2, expected a number "
     ">= 0 [kg]"},
    {"fraction_of_elements.yaml",
     "fraction_of_elements.yaml:8:41: bodies.arm.flexible.bars.one.elements: found 4.5, expected a "
     "number of elements (a whole number from 1 to 100000)"},
    {"future_version.yaml",
     "future_version.yaml:1:13: floatframe: found version 2, this program reads version 1"},
    {"ground_as_child.yaml",
     "ground_as_child.yaml:8:47: joints.pin.child: found ground, expected a body (the ground may "
     "be the parent)"},
    {"inertia_indefinite.yaml",
     "inertia_indefinite.yaml:4:58: bodies.block.rigid.inertia: found the principal moment -1, "
     "expected none below 0 [kg m2]"},
    {"inertia_triangle.yaml",
     "inertia_triangle.yaml:4:58: bodies.block.rigid.inertia: found the principal moments 1, 1 and "
     "3, expected none larger than the sum of the other two [kg m2]"},
    {"infinite_mass.yaml",
     "infinite_mass.yaml:4:19: bodies.block.rigid.mass: found 1e999, expected a number >= 0 [kg] "
     "(numbers must be finite)"},
    {"input_limits.yaml",
     "input_limits.yaml:6:27: inputs.one.initial: found 7, expected a number not above max, 5"
     "\n"
     "input_limits.yaml:7:22: inputs.two.max: found 3, expected a number above min, 3"
     "\n"
     "input_limits.yaml:8:3: inputs.three: initial: found 0, expected a number not below min, 1"
     "\n"
     "input_limits.yaml:9:10: inputs.four: unknown key 'inital', did you mean 'initial'?"
     "\n"
     "input_limits.yaml:10:16: inputs.five.unit: found 'N, m', expected a unit of at most 20 "
     "characters without commas, quotes and brackets"
     "\n"
     "input_limits.yaml:11:25: inputs.six.clamp: found true without limits, expected min, max or "
     "both beside it"},
    {"input_uses.yaml",
     "input_uses.yaml:11:66: forces.a.magnitude.input: unknown input 'torqe', did you mean "
     "'torque'?"
     "\n"
     "input_uses.yaml:12:57: forces.b.actuator.input: the input 'spare' is switched off by its "
     "'when'"
     "\n"
     "input_uses.yaml:13:74: forces.c.target: found without spring and damper, expected a law that "
     "pulls to the target"
     "\n"
     "input_uses.yaml:14:48: forces.d.magnitude: found 0 laws, expected a number or a map with "
     "input or one of polynomial, piecewise, table, and sine"
     "\n"
     "input_uses.yaml:15:74: forces.e.target: unknown key 'gain'"},
    {"joint_spring_on_ball.yaml",
     "joint_spring_on_ball.yaml:10:34: forces.k.joint: found 'ball', expected a revolute or "
     "prismatic joint"},
    {"joint_type.yaml",
     "joint_type.yaml:8:15: joints.pin.type: found 'hinge', expected " + alternatives(joint_words)},
    {"keep_alone.yaml",
     "keep_alone.yaml:6:69: joints.pin.keep: found without 'position' and 'velocity', expected one "
     "of them to keep"
     "\n"
     "keep_alone.yaml:7:84: joints.lid.keep: found 0.5, expected true or false"},
    {"key_is_a_list.yaml", "key_is_a_list.yaml:2:3: a key must be a name"},
    {"key_of_another_group.yaml",
     "key_of_another_group.yaml:5:5: bodies.block: unknown key 'mas', did you mean 'rigid.mass'?"
     "\n"
     "key_of_another_group.yaml:6:5: bodies.block.rigid: missing key 'mass'"
     "\n"
     "key_of_another_group.yaml:6:13: bodies.block.rigid: unknown key 'mas', did you mean 'mass'?"
     "\n"
     "key_of_another_group.yaml:8:5: bodies.bar: unknown key 'mass_modle', did you mean "
     "'flexible.mass_model'?"
     "\n"
     "key_of_another_group.yaml:10:7: bodies.bar.flexible: unknown key 'mas', did you mean "
     "'masses'?"},
    {"latin1.yaml", "latin1.yaml:2:10: this is not a text file (UTF-8)"},
    {"law_jumps.yaml",
     "law_jumps.yaml:14:11: forces.spring.spring.piecewise[1]: the law jumps from 100 to 200 at 1, "
     "expected pieces that meet within 1e-6 of the range of the law"},
    {"loose_bar.yaml",
     "loose_bar.yaml:9:9: bodies.arm.flexible.bars.two: the bar is not connected to 'one', "
     "expected all bars of a body to hang together"},
    {"many.yaml",
     "many.yaml:2:10: gravity: found a list of 2, expected a list of three numbers [x, y, z] [m/s2]"
     "\n"
     "many.yaml:5:19: bodies.block.rigid.mass: found -1, expected a number >= 0 [kg]"
     "\n"
     "many.yaml:5:70: bodies.block.rigid: unknown key 'colour'"
     "\n"
     "many.yaml:7:33: joints.pin.parent: unknown body 'nobody'"
     "\n"
     "many.yaml:7:76: joints.pin.axis: found a vector of length zero, expected a direction"
     "\n"
     "many.yaml:9:9: simulation.step: found 'fast', expected a positive number [s]"},
    {"map_for_number.yaml",
     "map_for_number.yaml:4:19: bodies.block.rigid.mass: found a map, expected a number >= 0 [kg]"},
    {"mass_model.yaml",
     "mass_model.yaml:11:19: bodies.arm.flexible.mass_model: found 'hermit', expected "
     "isoparametric, six_dof or hermite, did you mean 'hermite'?"},
    {"misplaced_key.yaml",
     "misplaced_key.yaml:8:62: joints.ball.axis: is not used by a spherical joint, expected no "
     "such key"},
    {"missing_group.yaml",
     "missing_group.yaml:3:3: bodies.block: missing key 'rigid' or 'flexible'"},
    {"missing_mass.yaml", "missing_mass.yaml:4:5: bodies.block.rigid: missing key 'mass'"},
    {"motion_and_position.yaml",
     "motion_and_position.yaml:8:73: joints.pin.position: found with a prescribed motion, which "
     "decides it, expected no such key"},
    {"named_node.yaml",
     "named_node.yaml:12:37: outputs.tip.position.node: the flexible body 'arm' has no node 'bb', "
     "did you mean 'b'?"},
    {"nan_mass.yaml",
     "nan_mass.yaml:4:19: bodies.block.rigid.mass: found .nan, expected a number >= 0 [kg] "
     "(numbers must be finite)"},
    {"negative_mass.yaml",
     "negative_mass.yaml:4:19: bodies.block.rigid.mass: found -3, expected a number >= 0 [kg]"},
    {"no_law.yaml",
     "no_law.yaml:8:3: forces.spring: found no law, expected spring, damper, bump_stop, "
     "rebound_stop or actuator"},
    {"no_modes.yaml",
     "no_modes.yaml:5:5: bodies.arm.flexible: found no modes, expected static_modes, normal_modes, "
     "analytic or basis"},
    {"no_version.yaml", "no_version.yaml:1:1: missing key 'floatframe'"},
    {"not_at_a_node.yaml",
     "not_at_a_node.yaml:12:41: joints.pin.at: found the point [0.3, 0, 0] on the flexible body "
     "'arm', expected one of its nodes; the nearest is at [0.25, 0, 0]"},
    {"nothing.yaml",
     "nothing.yaml:4:19: bodies.block.rigid.mass: found nothing, expected a number >= 0 [kg]"},
    {"number_for_name.yaml",
     "number_for_name.yaml:8:33: joints.pin.parent: found 3, expected the name of a body"},
    {"number_in_quotes.yaml",
     "number_in_quotes.yaml:4:19: bodies.block.rigid.mass: found '1', expected a number >= 0 [kg]"},
    {"octal.yaml",
     "octal.yaml:4:19: bodies.block.rigid.mass: found 010, expected a number >= 0 [kg] (a number "
     "must not start with 0)"},
    {"on_parameter.yaml",
     "on_parameter.yaml:3:13: parameters.flexible: found on, expected a number, a text, true or "
     "false (write true, or put a text in quotes)"},
    {"output_coordinate.yaml",
     "output_coordinate.yaml:10:40: outputs.a.coordinate: found 2, expected the number of a "
     "coordinate (a whole number from 1 to 1)"},
    {"output_distance.yaml",
     "output_distance.yaml:5:17: outputs.a.distance: found 'block', expected two places, for "
     "example {from: body, to: body}\n"
     "output_distance.yaml:6:7: outputs.b.distance: missing key 'to'\n"
     "output_distance.yaml:7:35: outputs.c.distance.to: unknown body 'blocks', did you mean "
     "'block'?\n"
     "output_distance.yaml:8:54: outputs.d.distance.to.at: found a list of 2, expected a list of "
     "three numbers [x, y, z] [m]\n"
     "output_distance.yaml:8:64: outputs.d: unknown key 'axis'"},
    {"output_twice.yaml", "output_twice.yaml:7:3: outputs: the column 'block.x' exists already"},
    {"output_without_quantity.yaml",
     "output_without_quantity.yaml:6:3: outputs.z: found 0 quantities, expected one of " +
         alternatives(output_words) +
         "\n"
         "output_without_quantity.yaml:6:7: outputs.z: unknown key 'body'"},
    {"parallel_axes.yaml",
     "parallel_axes.yaml:8:72: joints.pin.axis_2: found a direction parallel to 'axis', expected "
     "another"},
    {"parameter_name.yaml",
     "parameter_name.yaml:2:14: parameters.sqrt: the name is used by the expression language"},
    {"part_damaged.yaml",
     "part_damaged.yaml:3:19: bodies.arm.flexible: parts/not_a_body.ffb: this is not a zip archive "
     "(it does not begin with PK)"
     "\n"
     "part_damaged.yaml:4:19: bodies.leg.flexible: nowhere.ffb: the file does not exist"},
    {"part_interfaces.yaml",
     "part_interfaces.yaml:8:9: bodies.arm.flexible.interfaces.a: found 2 ways to choose nodes, "
     "expected one of set, node, nearest, plane, cylinder, sphere"
     "\n"
     "part_interfaces.yaml:9:9: bodies.arm.flexible.interfaces.b: found 0 ways to choose nodes, "
     "expected one of set, node, nearest, plane, cylinder, sphere"
     "\n"
     "part_interfaces.yaml:10:48: bodies.arm.flexible.interfaces.c.cylinder.axis: found a vector "
     "of length zero, expected a direction"
     "\n"
     "part_interfaces.yaml:10:67: bodies.arm.flexible.interfaces.c.cylinder.radius: found -1, "
     "expected a positive number"
     "\n"
     "part_interfaces.yaml:11:27: bodies.arm.flexible.interfaces.d.type: found 'stiff', expected "
     "rigid or mean"
     "\n"
     "part_interfaces.yaml:11:40: bodies.arm.flexible.interfaces.d.dofs: found 'xyz', expected all "
     "or a list of x, y, z, rx, ry, rz"
     "\n"
     "part_interfaces.yaml:12:13: bodies.arm.flexible.interfaces.e.sphere: missing key 'radius'"
     "\n"
     "part_interfaces.yaml:12:29: bodies.arm.flexible.interfaces.e.sphere.point: found a list of "
     "2, expected a list of three numbers [x, y, z]"
     "\n"
     "part_interfaces.yaml:14:12: bodies.arm.flexible.markers.a: found the name twice in "
     "interfaces and markers, expected once"},
    {"part_not_at_a_marker.yaml",
     "part_not_at_a_marker.yaml:6:42: joints.pin.at: found the point [0.6, 0, 0.2] on the flexible "
     "body 'arm', expected one of its nodes; the nearest is at [0.3, 0, 0.1]"},
    {"part_options.yaml",
     "part_options.yaml:7:15: bodies.arm.flexible.method: found 'craig', expected craig_bampton, "
     "free_free or craig_chang, did you mean 'craig_chang'?"
     "\n"
     "part_options.yaml:8:20: bodies.arm.flexible.integration: found 'gauss', expected exact or ccx"
     "\n"
     "part_options.yaml:9:25: bodies.arm.flexible.reference.node: unknown interface 'BAL', did you "
     "mean 'BALL'?"
     "\n"
     "part_options.yaml:10:16: bodies.arm.flexible.damping: found 2, expected a fraction of "
     "critical damping from 0 to 1"
     "\n"
     "part_options.yaml:11:23: bodies.arm.flexible.effective_mass: found 1.5, expected a number "
     "above 0 and up to 1"
     "\n"
     "part_options.yaml:12:14: bodies.arm.flexible.modes: found -1, expected a number of modes (a "
     "whole number from 0 to 10000)"
     "\n"
     "part_options.yaml:13:7: bodies.arm.flexible: unknown key 'fmx', did you mean 'fmax'?"},
    {"part_rigid_uses.yaml",
     "part_rigid_uses.yaml:5:24: initial.amplitudes.arm: found a body that is switched to rigid "
     "(flexible: false) and has no modal amplitudes, expected a flexible one"
     "\n"
     "part_rigid_uses.yaml:7:27: outputs.bend.modal_amplitude: found a body that is switched to "
     "rigid (flexible: false) and has no modal amplitudes, expected a flexible one"
     "\n"
     "part_rigid_uses.yaml:8:37: outputs.tip.position.node: the body 'arm' has no node 'eyes', did "
     "you mean 'eye'?"},
    {"part_switch_alone.yaml",
     "part_switch_alone.yaml:4:19: bodies.arm.flexible: found ${flex} = false without 'part', "
     "expected a part: bars, a finite-element file or the name of a body file"},
    {"part_twice.yaml",
     "part_twice.yaml:5:15: bodies.arm.flexible: found '../body_files/bracket_v1.ffb' beside "
     "'part', expected true or false (or one of the two keys)"
     "\n"
     "part_twice.yaml:8:15: bodies.leg.flexible: found a list of 1 beside 'part', expected true or "
     "false (or one of the two keys)"},
    {"part_units.yaml",
     "part_units.yaml:3:9: bodies.arm.flexible: missing key 'units'"
     "\n"
     "part_units.yaml:4:48: bodies.leg.flexible.units: unknown unit system 'mm-t-ss', did you mean "
     "'mm-t-s'?; known are m-kg-s, si, mm-t-s, mm-kg-ms, mm-kg-s, mm-g-ms, cm-g-s, in-lbf-s, "
     "ft-slug-s, or any <length>-<mass>-<time>"},
    {"poisson.yaml",
     "poisson.yaml:6:40: bodies.arm.flexible.material.poisson: found 0.5, expected a number above "
     "-1 and below 0.5"},
    {"position_size.yaml",
     "position_size.yaml:8:85: joints.pin.position: found a list of 1, expected a list of 2 "
     "numbers for a universal joint"},
    {"quaternion.yaml",
     "quaternion.yaml:4:18: bodies.block.orientation: found a quaternion of length 1.414214, "
     "expected length 1"},
    {"reference_along_bar.yaml",
     "reference_along_bar.yaml:8:55: bodies.arm.flexible.bars.one.reference: found a direction "
     "parallel to the bar, expected another"},
    {"reference_too_weak.yaml",
     "reference_too_weak.yaml:9:16: bodies.arm.flexible.clamped: these degrees of freedom leave 3 "
     "rigid motions of the body free, expected none"},
    {"road_backwards.yaml",
     "road_backwards.yaml:8:36: roads.hill.profile[3]: found x = 1 after 2, expected x that does "
     "not decrease [m]"},
    {"rod_on_one_body.yaml",
     "rod_on_one_body.yaml:8:3: rods.bar: found both ends on 'block', expected two bodies"},
    {"same_body.yaml",
     "same_body.yaml:8:47: joints.pin.child: found the same body as the parent, expected another"},
    {"short_vector.yaml",
     "short_vector.yaml:4:38: bodies.block.rigid.centre_of_mass: found a list of 2, expected a "
     "list of three numbers [x, y, z] [m]"},
    {"simulation_values.yaml",
     "simulation_values.yaml:5:20: simulation.step: found 0, expected a positive number [s]"
     "\n"
     "simulation_values.yaml:5:33: simulation.duration: found -1, expected a number >= 0 [s]"
     "\n"
     "simulation_values.yaml:5:54: simulation.spectral_radius: found 1.5, expected a number from 0 "
     "to 1"
     "\n"
     "simulation_values.yaml:5:72: simulation.coordinates: found 'relativ', expected relative or "
     "absolute, did you mean 'relative'?"},
    {"subsystem_alone.yaml",
     "subsystem_alone.yaml:2:1: external: this file is a subsystem, expected it to be used by a "
     "model file that connects its external names"},
    {"subsystem_connect.yaml",
     "subsystem_connect.yaml:6:50: subsystems.left.connect.frame: unknown name 'blok', did you "
     "mean 'block'?"
     "\n"
     "subsystem_connect.yaml:6:56: subsystems.left.connect.fram: 'parts/part.yaml' has no external "
     "name 'fram', did you mean 'frame'?"},
    {"subsystem_fault.yaml",
     "parts/bad_part.yaml:5:23: bodies.arm.rigid.mass: found -1, expected a number >= 0 [kg]"},
    {"subsystem_loop.yaml",
     "parts/loop.yaml:3:17: subsystems.again.file: 'parts/loop.yaml' includes itself"},
    {"subsystem_mirror.yaml",
     "subsystem_mirror.yaml:6:76: subsystems.left.mirror[1].normal: found a list of 3, expected x, "
     "y or z"},
    {"subsystem_missing.yaml",
     "subsystem_missing.yaml:6:16: subsystems.left.file: 'nowhere.yaml': the file does not exist"},
    {"subsystem_parameter.yaml",
     "subsystem_parameter.yaml:6:71: subsystems.left.parameters: unknown parameter 'lenght', did "
     "you mean 'length'?"
     "\n"
     "subsystem_parameter.yaml:6:82: subsystems.left.parameters.length: found 'long', expected a "
     "number"},
    {"subsystem_unconnected.yaml",
     "subsystem_unconnected.yaml:6:3: subsystems.left: 'parts/part.yaml' needs frame, expected it "
     "in 'connect'"},
    {"switched_off.yaml",
     "switched_off.yaml:9:33: joints.pin.parent: the body 'other' is switched off by its 'when'"},
    {"start_both.yaml",
     "start_both.yaml:5:37: simulation.start.state: found with 'equilibrium', expected one of the "
     "two"},
    {"start_offset.yaml",
     "start_offset.yaml:5:19: simulation.start.offset: found without 'equilibrium: true' or "
     "'state', expected where to start from"
     "\n"
     "start_offset.yaml:5:20: simulation.start.offset.blok: unknown body 'blok', did you mean "
     "'block'?"
     "\n"
     "start_offset.yaml:5:44: simulation.start.offset.block: found a list of 2, expected [x, y, z] "
     "[m], or [x, y, z, rx, ry, rz] with a rotation vector [m, rad]"
     "\n"
     "start_offset.yaml:5:52: simulation.start.offset.ground: found ground, expected a body"
     "\n"
     "start_offset.yaml:5:72: simulation.start: unknown key 'ofset'"},
    {"start_state.yaml",
     "start_state.yaml:5:18: simulation.start.state: parts/damaged_state.json: this is not a state "
     "file (damaged, or not JSON)"},
    {"start_state_missing.yaml",
     "start_state_missing.yaml:5:18: simulation.start.state: nowhere.json: the file does not "
     "exist"},
    {"tab.yaml", "tab.yaml:3:1: a tab in the indentation, use spaces"},
    {"table_order.yaml",
     "table_order.yaml:12:38: forces.spring.spring.table[3]: found x = 1 after 2, expected "
     "ascending x [m]"},
    {"table_steep.yaml",
     "table_steep.yaml:6:91: joints.slide.motion.table[2]: found the step from 0 to 1 over 1e-200 "
     "[s], expected a slope that is a finite number"},
    {"tag.yaml", "tag.yaml:4:19: tags (!name) are not allowed"},
    {"tolerances.yaml",
     "tolerances.yaml:5:25: simulation.tolerance: found 1e-300, expected a number from 1e-15 to 1"
     "\n"
     "tolerances.yaml:5:53: simulation.position_tolerance: found 1e-16, expected a number from "
     "1e-15 to 1 [m]"
     "\n"
     "tolerances.yaml:5:80: simulation.velocity_tolerance: found 0, expected a number from "
     "1e-15 to 1 [m/s]"},
    {"top_is_a_list.yaml",
     "top_is_a_list.yaml:1:1: found a list of 2, expected a map of keys such as 'bodies'"},
    {"tube.yaml",
     "tube.yaml:8:60: bodies.arm.flexible.bars.one.section.tube: found the inner diameter 0.03, "
     "expected less than the outer one, 0.02 [m]"},
    {"two_documents.yaml",
     "two_documents.yaml:6:1: a second document starts here, a model file holds one"},
    {"two_laws.yaml",
     "two_laws.yaml:12:5: forces.spring.spring: found 2 laws, expected a number [N/m] or a map "
     "with one of linear, polynomial, piecewise, table"},
    {"unclosed_list.yaml", "unclosed_list.yaml:4:46: YAML syntax: illegal flow end"},
    {"unknown_body.yaml",
     "unknown_body.yaml:8:33: joints.pin.parent: unknown body 'othr', did you mean 'other'?"},
    {"unknown_joint_key.yaml", "unknown_joint_key.yaml:8:66: joints.slide: unknown key 'stifness'"},
    {"unknown_key.yaml",
     "unknown_key.yaml:5:5: bodies.arm.flexible: missing key 'clamped'"
     "\n"
     "unknown_key.yaml:9:7: bodies.arm.flexible: unknown key 'clampd', did you mean 'clamped'?"},
    {"unknown_parameter.yaml",
     "unknown_parameter.yaml:5:19: bodies.block.rigid.mass: in ${mas}: unknown parameter 'mas', "
     "did you mean 'mass'?"},
    {"unknown_point.yaml", "unknown_point.yaml:12:41: joints.pin.at: unknown point 'd'"},
    {"unknown_road.yaml",
     "unknown_road.yaml:10:70: forces.tyre.road: unknown road 'hil', did you mean 'hill'?"},
    {"unknown_top_key.yaml",
     "unknown_top_key.yaml:5:1: unknown key 'simulaton', did you mean 'simulation'?"},
    {"use.yaml", "use.yaml:4:10: bodies.block.use: found flexible, but the body has no such group"},
    {"word_in_vector.yaml",
     "word_in_vector.yaml:4:42: bodies.block.rigid.centre_of_mass[2]: found 'zero', expected a "
     "number [m]"},
    {"yes.yaml",
     "yes.yaml:11:20: bodies.arm.flexible.orthonormal: found yes, expected true or false (write "
     "true, or put a text in quotes)"},
    {"zero_axis.yaml",
     "zero_axis.yaml:8:60: joints.pin.axis: found a vector of length zero, expected a direction"},
    {"zero_length_bar.yaml",
     "zero_length_bar.yaml:5:5: bodies.arm.flexible: found no modes, expected static_modes, "
     "normal_modes, analytic or basis"
     "\n"
     "zero_length_bar.yaml:8:9: bodies.arm.flexible.bars.one: found length 0, expected a bar of "
     "positive length [m]"},
    {"zero_length_spring.yaml",
     "zero_length_spring.yaml:8:3: forces.spring: found both ends at the same point, expected two "
     "points apart"},
};

TEST(BadModels, GiveTheirSentences) {
  for (const Case& c : cases) EXPECT_EQ(faults_of(folder + c.file), c.expected) << c.file;
}

TEST(BadModels, AreAllInTheTable) {
  std::set<std::string> listed;
  for (const Case& c : cases) listed.insert(c.file);
  EXPECT_GE(listed.size(), 40u);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(entry.is_directory() || listed.count(name) == 1) << name;
  }
}

TEST(BadModels, FilesThatCannotBeRead) {
  EXPECT_EQ(faults_of(folder + "nowhere.yaml"), "nowhere.yaml: the file does not exist");
  EXPECT_EQ(faults_of(folder + "parts"), "parts: this is a folder, not a file");
  EXPECT_EQ(faults_of("/dev/null"), "/dev/null: this is not a regular file");
}

TEST(BadModels, Overrides) {
  const std::string iltis = FLOATFRAME_EXAMPLES "/iltis/iltis.yaml";
  const auto tail = [&](const std::vector<ParameterOverride>& o) {
    const std::string text = faults_of(iltis, o);
    return text.compare(0, iltis.size(), iltis) == 0 ? text.substr(iltis.size()) : text;
  };
  EXPECT_EQ(tail({{"spead", "3"}}), ": --set: unknown parameter 'spead', did you mean 'speed'?");
  EXPECT_EQ(tail({{"speed", "fast"}}), ": --set.speed: found 'fast', expected a number");
  EXPECT_EQ(tail({{"flexible", "yes"}}), ": --set flexible=yes: found yes (write true)");
  EXPECT_EQ(tail({{"speed", "${1/0}"}}), ": --set speed=${1/0}: division by zero");
}

TEST(BadModels, SameFaultsEveryTime) {
  const std::string first = faults_of(folder + "many.yaml");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(faults_of(folder + "many.yaml"), first);
}

}  // namespace
}  // namespace floatframe

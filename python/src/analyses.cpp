// Analyses of a model in one call: counts, equilibrium, mass, advice on modes, rotors.
#include <array>

#include "results.hpp"

namespace floatframe::python {
namespace {

void bind_start(nb::module_& m) {
  nb::class_<StartReport> start(m, "StartReport", "Report on the start values of a model.");
  value(start, "notes", &StartReport::notes, "The report in sentences.");
  start.def_prop_ro(
      "redundant", [](const StartReport& s) { return redundancy_text(s.redundant); },
      "Directions constrained more than once by joints; empty if there are none.");
}

void bind_check(nb::module_& m) {
  nb::class_<CoordinateCounts> counts(m, "CoordinateCounts", "Counts of one formulation.");
  value(counts, "rigid", &CoordinateCounts::rigid, "Coordinates of bodies or joints.");
  value(counts, "elastic", &CoordinateCounts::elastic, "Modal amplitudes.");
  value(counts, "total", &CoordinateCounts::total, "Both.");
  value(counts, "constraints", &CoordinateCounts::constraints, "Constraint equations.");
  nb::class_<ModelCounts> c(m, "ModelCounts", "Counts of a model.");
  value(c, "bodies", &ModelCounts::bodies, "");
  value(c, "flexible_bodies", &ModelCounts::flexible_bodies, "");
  value(c, "joints", &ModelCounts::joints, "");
  value(c, "cut_joints", &ModelCounts::cut_joints, "Loop joints, in relative coordinates.");
  value(c, "relative", &ModelCounts::relative, "");
  value(c, "absolute", &ModelCounts::absolute, "");
  value(c, "degrees_of_freedom", &ModelCounts::degrees_of_freedom, "");
  value(c, "redundant_constraints", &ModelCounts::redundant_constraints, "");
  value(c, "cut_joint_names", &ModelCounts::cut_joint_names, "");
  value(c, "start", &ModelCounts::start, "");
  m.def("check", [](const Model& model) {
    Unlocked released;
    return check(model);
  });
}

void bind_statics(nb::module_& m) {
  nb::class_<StaticsForce> force(m, "StaticsForce", "A force element in equilibrium.");
  value(force, "name", &StaticsForce::name, "");
  value(force, "type", &StaticsForce::type, "");
  value(force, "force", &StaticsForce::force, "Tension positive [N]; torque [N m] about axes.");
  value(force, "length", &StaticsForce::length, "Length [m], deflection or angle [rad].");
  value(force, "unique", &StaticsForce::unique, "False: not unique, of minimum norm.");
  nb::class_<StaticsJoint> joint(m, "StaticsJoint", "The reaction of a joint in equilibrium.");
  value(joint, "name", &StaticsJoint::name, "");
  value(joint, "type", &StaticsJoint::type, "");
  array(joint, "force", &StaticsJoint::force, "On the child, world axes, shape (3,) [N].");
  array(joint, "torque", &StaticsJoint::torque, "About the joint point, shape (3,) [N m].");
  joint.def_prop_ro("unique", &StaticsJoint::unique, "False: not unique, of minimum norm.");
  nb::class_<StaticsBody> body(m, "StaticsBody", "A body in equilibrium.");
  value(body, "name", &StaticsBody::name, "");
  array(body, "position", &StaticsBody::position, "Of its frame, world, shape (3,) [m].");
  array(body, "roll_pitch_yaw", &StaticsBody::roll_pitch_yaw,
        "Relative to the design pose, shape (3,) [rad].");
  array(body, "amplitudes", &StaticsBody::amplitudes, "Shape (modes,).");
  nb::class_<StaticsResult> c(m, "StaticsResult", "The static equilibrium of a model.");
  value(c, "iterations", &StaticsResult::iterations, "");
  value(c, "residual", &StaticsResult::residual, "Largest unbalanced generalised force.");
  value(c, "forces", &StaticsResult::forces, "Of all force elements.");
  value(c, "joints", &StaticsResult::joints, "Reactions of all joints.");
  value(c, "bodies", &StaticsResult::bodies, "");
  value(c, "notes", &StaticsResult::notes, "Remarks, e.g. that it is unstable.");
  c.def_prop_ro(
      "state", [](const StaticsResult& s) { return SystemState(*s.state); },
      "The equilibrium, at rest: a start for runs.");
  m.def("statics", [](const Model& model) {
    Unlocked released;
    return statics(model);
  });
}

void bind_mass(nb::module_& m) {
  nb::class_<BodyMass> body(m, "BodyMass", "Mass properties of a body at the start.");
  value(body, "name", &BodyMass::name, "");
  value(body, "mass", &BodyMass::mass, "[kg]");
  array(body, "centre", &BodyMass::centre, "Centre of mass, world, shape (3,) [m].");
  array(body, "inertia", &BodyMass::inertia, "About it, world axes, shape (3, 3) [kg m2].");
  nb::class_<ModelMass> c(m, "ModelMass", "Mass properties of a whole model at the start.");
  value(c, "time", &ModelMass::time, "Time of the configuration [s].");
  value(c, "mass", &ModelMass::mass, "[kg]");
  array(c, "centre", &ModelMass::centre, "Centre of mass, world, shape (3,) [m].");
  array(c, "inertia", &ModelMass::inertia, "About it, world axes, shape (3, 3) [kg m2].");
  array(c, "principal_moments", &ModelMass::principal_moments, "Ascending, shape (3,) [kg m2].");
  array(c, "principal_axes", &ModelMass::principal_axes, "One per column, shape (3, 3).");
  value(c, "bodies", &ModelMass::bodies, "In the order of the model.");
  value(c, "start", &ModelMass::start, "");
  m.def("mass_properties", [](const Model& model, const Keywords& given) {
    const SimulationOptions options = options_of(given);
    Unlocked released;
    return mass_properties(model, options);
  });
}

void bind_differences(nb::module_& m) {
  nb::class_<OutputDifference> d(m, "OutputDifference", "Change of an output due to fewer modes.");
  value(d, "name", &OutputDifference::name, "");
  value(d, "unit", &OutputDifference::unit, "");
  value(d, "range", &OutputDifference::range, "Largest minus smallest sample.");
  value(d, "rms", &OutputDifference::rms, "Root mean square of the difference.");
  value(d, "largest", &OutputDifference::largest, "Largest difference.");
  value(d, "peaks", &OutputDifference::peaks, "Difference of the peaks.");
  value(d, "relative", &OutputDifference::relative, "The criterion, as a fraction of the range.");
}

void bind_advice(nb::module_& m) {
  nb::class_<ModeAdvice> mode(m, "ModeAdvice", "Whether a mode of a body is needed.");
  value(mode, "mode", &ModeAdvice::mode, "From 0.");
  value(mode, "name", &ModeAdvice::name, "");
  value(mode, "frequency", &ModeAdvice::frequency, "With the body frame fixed [Hz].");
  value(mode, "free_frequency", &ModeAdvice::free_frequency, "With the body free [Hz].");
  value(mode, "step_phase", &ModeAdvice::step_phase, "omega times the step [rad].");
  value(mode, "static_share", &ModeAdvice::static_share, "Of the compliance.");
  value(mode, "dynamic_share", &ModeAdvice::dynamic_share, "Of the strain energy of the run.");
  value(mode, "kinetic_ratio", &ModeAdvice::kinetic_ratio, "");
  value(mode, "rms", &ModeAdvice::rms, "Of the amplitude in the run.");
  value(mode, "peak", &ModeAdvice::peak, "");
  value(mode, "retained", &ModeAdvice::retained, "Small, but needed by the verification.");
  mode.def_prop_ro(
      "action", [](const ModeAdvice& a) { return std::string(word(a.action)); },
      "'keep', 'quasi-static' or 'drop'.");
  nb::class_<BodyAdvice> body(m, "BodyAdvice", "Advice on the modes of one body.");
  value(body, "name", &BodyAdvice::name, "");
  value(body, "modes", &BodyAdvice::modes, "");
  array(body, "free_frequencies", &BodyAdvice::free_frequencies,
        "Of the reduced body, free in space, ascending [Hz].");
  nb::class_<ModeAdviceReport> c(m, "ModeAdviceReport", "Advice on all modes, verified by a run.");
  value(c, "bodies", &ModeAdviceReport::bodies, "");
  value(c, "modes", &ModeAdviceReport::modes, "");
  value(c, "dropped", &ModeAdviceReport::dropped, "");
  value(c, "quasi_static", &ModeAdviceReport::quasi_static, "");
  value(c, "trials", &ModeAdviceReport::trials, "Reduced models that were run.");
  value(c, "differences", &ModeAdviceReport::differences, "The largest first.");
  value(c, "refused_by", &ModeAdviceReport::refused_by, "");
  m.def("advise", [](const Model& model, const Keywords& given, double drop_share,
                     double static_ratio, double tolerance, int repeat) {
    const SimulationDescription simulation = described(model, options_of(given));
    Unlocked released;
    return advise(model, simulation, {drop_share, static_ratio, tolerance, repeat});
  });
}

void bind_order(nb::module_& m) {
  nb::class_<BodyOrder> body(m, "BodyOrder", "Modes of a body needed for a frequency range.");
  value(body, "name", &BodyOrder::name, "");
  value(body, "needed", &BodyOrder::needed, "Modes from 0, ascending.");
  numbers(body, "estimates", &BodyOrder::estimates, "Change of a frequency without each mode.");
  value(body, "own", &BodyOrder::own, "Highest normal mode frequency [Hz]; 0: none.");
  nb::class_<ModelOrder> c(m, "ModelOrder", "Number of modes needed below a frequency.");
  value(c, "bodies", &ModelOrder::bodies, "The flexible ones.");
  value(c, "modes", &ModelOrder::modes, "");
  value(c, "needed", &ModelOrder::needed, "");
  value(c, "trials", &ModelOrder::trials, "Linear systems of reduced models.");
  numbers(c, "full", &ModelOrder::full, "Undamped frequencies of the range [Hz].");
  numbers(c, "reduced", &ModelOrder::reduced, "With the modes needed [Hz].");
  value(c, "change", &ModelOrder::change, "The largest relative change.");
  value(c, "differences", &ModelOrder::differences, "Of the runs, the largest first.");
  value(c, "warnings", &ModelOrder::warnings, "");
  m.def("model_order", [](const Model& model, double below, double tolerance) {
    Unlocked released;
    return model_order(model, {below, tolerance});
  });
}

CampbellDiagram campbell_of(const Model& model, const std::string& joint, double from, double to,
                            double step, const std::optional<std::array<double, 3>>& axis,
                            const std::vector<double>& orders, int modes) {
  Unlocked released;
  CampbellOptions options{joint, from, to, step, std::nullopt, orders, modes};
  if (axis) options.axis = Vec3((*axis)[0], (*axis)[1], (*axis)[2]);
  return campbell(model, options);
}

/// Eigenvalues of a line over the speeds.
ComplexArray eigenvalues(const CampbellLine& line) {
  Eigen::VectorXcd values(static_cast<Eigen::Index>(line.points.size()));
  for (std::size_t k = 0; k < line.points.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = line.points[k].lambda;
  return array_of(values);
}

void bind_campbell(nb::module_& m) {
  nb::class_<CampbellLine> line(m, "CampbellLine", "One mode over the speed.");
  value(line, "kind", &CampbellLine::kind,
        "'forward', 'backward', 'planar', 'axial or torsion', 'bending' or 'other bodies', by most "
        "of "
        "its points.");
  line.def_prop_ro("eigenvalues", eigenvalues,
                   "At each speed, Im >= 0, NaN where the line is unknown, shape (speeds,) [1/s].");
  nb::class_<CriticalSpeed> critical(m, "CriticalSpeed", "Where a frequency crosses an order.");
  value(critical, "line", &CriticalSpeed::line, "From 0.");
  value(critical, "order", &CriticalSpeed::order, "");
  value(critical, "speed", &CriticalSpeed::speed, "[rad/s]");
  value(critical, "frequency", &CriticalSpeed::frequency, "[rad/s]");
  value(critical, "whirl", &CriticalSpeed::whirl, "");
  nb::class_<InstabilityOnset> onset(m, "InstabilityOnset", "Where damping becomes negative.");
  value(onset, "line", &InstabilityOnset::line, "Line from 0; -1: none.");
  value(onset, "speed", &InstabilityOnset::speed, "[rad/s]");
  value(onset, "frequency", &InstabilityOnset::frequency, "[rad/s]");
  nb::class_<CampbellDiagram> c(m, "CampbellDiagram", "Vibrations of a rotor over its speed.");
  numbers(c, "speeds", &CampbellDiagram::speeds, "[rad/s]");
  value(c, "lines", &CampbellDiagram::lines, "Ascending by the frequency at the first speed.");
  value(c, "critical", &CampbellDiagram::critical, "");
  value(c, "crossings", &CampbellDiagram::crossings, "Of order 1, not excited by unbalance.");
  value(c, "unstable", &CampbellDiagram::unstable, "");
  value(c, "rigid", &CampbellDiagram::rigid, "Modes of frequency zero at the first speed.");
  value(c, "overdamped", &CampbellDiagram::overdamped, "Modes that do not oscillate at any speed.");
  value(c, "notes", &CampbellDiagram::notes, "");
  m.def("campbell", campbell_of);
}

}  // namespace

void bind_analyses(nb::module_& m) {
  bind_start(m);
  bind_check(m);
  bind_statics(m);
  bind_mass(m);
  bind_differences(m);
  bind_advice(m);
  bind_order(m);
  bind_campbell(m);
}

}  // namespace floatframe::python

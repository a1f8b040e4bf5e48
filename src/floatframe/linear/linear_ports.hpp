#pragma once
// The linear system of a model between inputs and outputs. Inputs u are
//   the model's own     by their values
//   prescribed motions  of joints: by value, rate and second derivative [m, rad]
//   roads               the height under the wheels, all together or each by itself, lifted without
//                       a slope: by height and rate, since tyres damp [m]
// and outputs y those of the model, with accelerations and reactions that satisfy the equations of
// motion:
//   zdot = A z + B0 u + B1 u' + B2 u'',   y = y0 + C z + D0 u + D1 u' + D2 u''                 (1)
//   G(s) = C (s I - A)^-1 (B0 + s B1 + s^2 B2) + D0 + s D1 + s^2 D2
// A motion due to an input at constant z is in the dependent coordinates; z itself varies with
// u.
#include <memory>
#include <string>
#include <vector>

#include "floatframe/description/state_name.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/run/result_table.hpp"

namespace floatframe {

/// An input of a linear system.
struct LinearInput {
  enum class Kind { signal, motion, road };
  std::string name;  ///< "damper", "motion of crank", "road", "road at front.tyre"
  std::string unit;
  Kind kind = Kind::signal;
  int index = -1;           ///< of the model's input, or of the joint
  std::vector<int> wheels;  ///< of a road: the force elements above it
  double place = 0.0;       ///< x of the centre of its wheel, if it is one, in a LinearModel [m]
  /// Number of derivatives that enter: 0, 2 of motions, 1 of roads.
  int order() const noexcept { return kind == Kind::motion ? 2 : kind == Kind::road ? 1 : 0; }
};

/// All inputs of a model: its own, its prescribed motions, "road" and, for several wheels, each.
std::vector<LinearInput> linear_inputs(const Model& model);

/// Names; none: all.
struct LinearPorts {
  std::vector<std::string> inputs = {}, outputs = {};
};

struct LinearModel {
  LinearSystem system;
  std::vector<LinearInput> inputs;
  std::vector<Column> outputs;
  MatX B[3], C, D[3];                        ///< (1)
  double time = 0.0;                         ///< of the linearisation [s]
  VecX input_values, output_values;          ///< there; heights of roads are relative to it
  std::vector<StateName> names;              ///< of the states z
  std::shared_ptr<const SystemState> state;  ///< there
};

/// At the start state given by the options, as `linear_system`, with the same exceptions. Throws
/// InputError for a name that does not exist in the model.
LinearModel linear_model(const Model& model, const LinearPorts& ports = {},
                         const SimulationOptions& options = {});

/// At the present state of a simulation, with its inputs as they are, in relative coordinates.
LinearModel linear_model(const Simulation& simulation, const LinearPorts& ports = {});

/// zdot = A z + B u, y = C z + D u, in changes from the point of linearisation. An input that
/// enters by derivatives is represented by the highest of them, with its value and rate as states:
/// "rate of road", "acceleration of motion of crank".
struct StateSpace {
  MatX A, B, C, D;
  std::vector<std::string> states;
  std::vector<StateName> names;  ///< the same as names
  std::vector<Column> inputs, outputs;
};
StateSpace state_space(const LinearModel& linear);

}  // namespace floatframe

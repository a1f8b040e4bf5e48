#pragma once
// Result quantities of an element, their units, and the category of its energy.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// "N", "rad/s", ...; empty if elements of its type have no such quantity.
const char* element_output_unit(const Element& element, ElementQuantity quantity) noexcept;
/// Prescribed loads have no length and no rate.
bool element_has(ElementType type, ElementQuantity quantity) noexcept;

/// Category of the energy that an element exchanges (run/energy_balance.hpp).
enum class EnergyCategory {
  springs,  ///< it keeps Efforts::energy (zero if it only damps); Efforts::damping is of
            ///< dampers, the rest of actuators and targets
  tyres,    ///< the same, but its energy may jump
  loads     ///< it stores no energy
};
EnergyCategory energy_category(ElementType type) noexcept;

/// A law of the element is one of a rotation vector, which jumps at half a turn.
bool ends_at_half_turn(const Element& element) noexcept;

/// One signal of an element, for messages and for what looks for corners in time.
struct ElementSignal {
  const Signal* signal;
  std::string what;  ///< "actuator", "target rate", ...: the name of its key
  bool target;       ///< it is followed; else it is a force
  const char* unit;
};
/// Those that are given.
std::vector<ElementSignal> signals_of(const Element& element);
/// What a source of a signal is of its element.
ElementQuantity quantity_of(SignalSource source) noexcept;

/// A value of an element that has several.
struct ElementValue {
  std::string name;
  const char* unit;  ///< of SI, as in the headers of columns; "-": it has none
};
/// The values of an element that has several, else empty; the first one is its force.
std::vector<ElementValue> values_of_element(const ElementKeys& keys);
/// The unit of one of its values, counted from 0.
const char* value_unit(const Element& element, int value);
/// The names of the values of an element that has several, "1", "2", ... without names.
std::vector<std::string> value_names(const ElementKeys& keys);
/// The place of a name or number from 1 among them, 0 for an empty one; -1: there is none.
int value_index(const std::vector<std::string>& names, const std::string& word) noexcept;

/// How an element is drawn. Axes and anchors are those of its markers.
struct Picture {
  enum class Symbol {
    none,
    bar,      ///< a straight line between two anchors
    spring,   ///< a coil about a telescope between two anchors
    ring,     ///< an elastic connection at one place, about its axis
    wheel,    ///< a cylinder about its axis, and an arrow of its force upwards
    force,    ///< an arrow along its axis
    torque,   ///< an arrow with two heads
    bearing,  ///< rings with balls between them about its axis
    bushing,  ///< rubber between two tubes about its axis
    coupling  ///< a toothed wheel about its axis
  } symbol = Symbol::none;
  int a = -1, b = -1;                ///< markers of the anchors; -1: there is no second
  Vec3 axis = Vec3::Zero();          ///< in the axes of marker `axis_of`; zero: none
  int axis_of = -1;                  ///< -1: the world
  double radius = 0.0, width = 0.0;  ///< of a wheel; radius of a bearing [m]
};
const char* symbol_name(Picture::Symbol symbol) noexcept;
Picture picture_of(const Element& element);
/// A line that is drawn on a body: a pitch circle, a strand of a belt, a guide.
struct Stroke {
  int marker = -1;           ///< what it is fixed to
  std::vector<Vec3> points;  ///< in the axes of the marker, from its point [m]; joined by straights
};
/// The lines of an element, in the design configuration. Load time.
std::vector<Stroke> strokes_of(const Model& model, const Element& element);
/// It is drawn as a wheel on this body.
bool is_wheel_of(const Model& model, const Element& element, int body);

/// What stands under the element and can be moved, as an input of linear systems: "road"; empty if
/// nothing. `lift` moves it.
const char* lifted_by(ElementType type) noexcept;
/// Lifts it by a function of time [m].
void lift(Element& element, const TimeFunction& height);

/// Its law is a function of a program, which may throw.
bool calls_program(ElementType type) noexcept;

/// It keeps an axis, z of its markers, about which one side may turn without end.
bool is_bearing(ElementType type) noexcept;

}  // namespace floatframe

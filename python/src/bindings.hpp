#pragma once
// Declarations shared by the sources of the module. Each binds one subject: `bind_<subject>`.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/complex.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <floatframe/floatframe.hpp>

namespace nb = nanobind;

namespace floatframe::python {

/// A loaded model, as a Python object.
struct LoadedModel : Model {
  ModelSource source;
};

void bind_errors(nb::module_& m);
void bind_version(nb::module_& m);
void bind_model(nb::module_& m);
void bind_states(nb::module_& m);
void bind_run(nb::module_& m);
void bind_simulation(nb::module_& m);
void bind_analyses(nb::module_& m);
void bind_linear(nb::module_& m);
void bind_body(nb::module_& m);
void bind_mesh(nb::module_& m);
void bind_part(nb::module_& m);
void bind_road(nb::module_& m);
void bind_fmu(nb::module_& m);
void bind_scene(nb::module_& m);

inline bool is_array(PyObject* object) { return nb::ndarray_check(nb::handle(object)); }
/// Python objects, named by their type in stubs.
struct RealArray : nb::object {
  NB_OBJECT_DEFAULT(RealArray, nb::object, "numpy.typing.NDArray[numpy.float64]", is_array)
};
struct ComplexArray : nb::object {
  NB_OBJECT_DEFAULT(ComplexArray, nb::object, "numpy.typing.NDArray[numpy.complex128]", is_array)
};
inline bool is_list(PyObject* object) { return PyList_Check(object); }
struct StateNames : nb::object {
  NB_OBJECT_DEFAULT(StateNames, nb::object, "list[tuple[str, str, int, bool]]", is_list)
};
using Keywords = nb::typed<nb::dict, nb::str, nb::object>;
using Numbers = nb::typed<nb::dict, nb::str, double>;
using Arrays = nb::typed<nb::dict, nb::str, RealArray>;
using ArraysByName = nb::typed<nb::dict, nb::str, Arrays>;

/// A copy as an independent numpy array.
RealArray array_of(const VecX& v);
RealArray array_of(const MatX& a);
RealArray array_of(const std::vector<double>& v);
ComplexArray array_of(const Eigen::VectorXcd& v);
ComplexArray array_of(const Eigen::MatrixXcd& a);

/// An unknown name: also KeyError in Python.
struct UnknownName : InputError {
  using InputError::InputError;
};

/// The argument `name`, one of `words`. Throws InputError with found and expected values.
template <class T>
T word_of(const char* name, const std::string& found,
          std::initializer_list<std::pair<const char*, T>> words) {
  std::string expected;
  for (const auto& [word, value] : words) {
    if (found == word) return value;
    expected += (expected.empty() ? "'" : ", '") + std::string(word) + "'";
  }
  throw InputError(ErrorCode::wrong_value,
                   std::string(name) + ": found '" + found + "', expected one of " + expected);
}

Coordinates coordinates_of(const std::string& word);
InertiaMethod inertia_of(const std::string& word);
/// Python arguments of the given type: InputError contains the found and the expected type.
double number(const std::string& name, nb::handle value);
int whole(const std::string& name, nb::handle value);
bool flag(const std::string& name, nb::handle value);
std::string text(const std::string& name, nb::handle value);
/// Name of the type of an object.
std::string type_of(nb::handle value);
/// A file or folder: a text or an object accepted by `os.fspath`.
std::string path(const std::string& name, nb::handle value);
/// From keyword arguments; None is the same as not given. Throws TypeError for other names.
SimulationOptions options_of(const Keywords& given);

/// A Python function of x, v and t as the law of a force. It counts in saved states by its
/// attribute `label`, if it has one.
ForceFunction law_of(const nb::object& function);
/// Sets the Python exception in `thrown`, if there is one, as the cause of `error`. Throws it
/// instead if it is none for programs to catch (KeyboardInterrupt).
void set_cause(const nb::object& error, const std::exception_ptr& thrown);

/// Releases the lock of the interpreter until the end of the scope. At its end the interpreter
/// stops threads that request its lock, by an exception that must not pass through C++: they wait
/// here instead until the process ends (`bind_threads`).
class Unlocked {
 public:
  Unlocked();
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};
/// Acquires the lock, in threads that do not hold it.
class Locked {
 public:
  Locked();
  ~Locked();
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};
/// Registers the handling of C++ threads at the end of the interpreter.
void bind_threads();

/// Calls `run` in another thread; the calling one, of Python, checks for signals (Ctrl-C) and calls
/// `watch` with the lock held. An exception of either ends both: sets `stop` and waits.
void interruptible(std::atomic<bool>& stop, const std::function<void()>& run,
                   const std::function<void()>& watch);

}  // namespace floatframe::python

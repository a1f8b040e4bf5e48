#pragma once
// What the sources of the module share. Each binds one subject: `bind_<subject>`.
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

/// As Python has it.
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

inline bool is_array(PyObject* object) { return nb::ndarray_check(nb::handle(object)); }
/// Objects by what stubs are to call them.
struct RealArray : nb::object {
  NB_OBJECT_DEFAULT(RealArray, nb::object, "numpy.typing.NDArray[numpy.float64]", is_array)
};
struct ComplexArray : nb::object {
  NB_OBJECT_DEFAULT(ComplexArray, nb::object, "numpy.typing.NDArray[numpy.complex128]", is_array)
};
using Keywords = nb::typed<nb::dict, nb::str, nb::object>;
using Numbers = nb::typed<nb::dict, nb::str, double>;
using Arrays = nb::typed<nb::dict, nb::str, RealArray>;
using ArraysByName = nb::typed<nb::dict, nb::str, Arrays>;

/// A copy as a numpy array of its own.
RealArray array_of(const VecX& v);
RealArray array_of(const MatX& a);
RealArray array_of(const std::vector<double>& v);
ComplexArray array_of(const Eigen::VectorXcd& v);
ComplexArray array_of(const Eigen::MatrixXcd& a);

/// A name that nothing has: also KeyError in Python.
struct UnknownName : InputError {
  using InputError::InputError;
};

/// The argument `name`, one of `words`. Throws InputError with what was found and expected.
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
/// Arguments of Python as they are: InputError says what was found and what was expected.
double number(const std::string& name, nb::handle value);
int whole(const std::string& name, nb::handle value);
bool flag(const std::string& name, nb::handle value);
std::string text(const std::string& name, nb::handle value);
/// Name of the type of something.
std::string type_of(nb::handle value);
/// A file or folder: a text or what `os.fspath` takes.
std::string path(const std::string& name, nb::handle value);
/// Of keyword arguments; None is as if it was not given. Throws TypeError for other names.
SimulationOptions options_of(const Keywords& given);

/// The lock of the interpreter given away, and taken back at the end of the scope. When the
/// interpreter ends it stops the threads that ask for its lock, by an exception that C++ cannot
/// hold: they wait here instead, for the end of the process (`bind_threads`).
class Unlocked {
 public:
  Unlocked();
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};
/// The lock taken, in threads that do not hold it.
class Locked {
 public:
  Locked();
  ~Locked();
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};
/// Registers what happens to threads in C++ when the interpreter ends.
void bind_threads();

/// `run` in a thread of its own; this one, of Python, looks for signals meanwhile (Ctrl-C) and
/// calls `watch` with the lock held. What either throws ends both: `stop` is set and waited for.
void interruptible(std::atomic<bool>& stop, const std::function<void()>& run,
                   const std::function<void()>& watch);

}  // namespace floatframe::python

// Python functions as laws of forces, called in any thread with the lock of the interpreter.
#include "bindings.hpp"

namespace floatframe::python {
namespace {

/// An object that any thread may release.
template <class T>
std::shared_ptr<T> shared(T&& object) {
  return {new T(std::move(object)), [](T* p) {
            if (!nb::is_alive()) return;
            Locked lock;
            delete p;
          }};
}

/// "ZeroDivisionError: division by zero", with the exception of Python.
struct PythonThrown : std::runtime_error {
  PythonThrown(const std::string& text, nb::python_error&& e)
      : std::runtime_error(text), error(shared(std::move(e))) {}
  std::shared_ptr<nb::python_error> error;
};

std::string text_of(const nb::python_error& error) {
  const std::string type = type_of(error.value());
  const std::string words = nb::cast<std::string>(nb::str(error.value()));
  return words.empty() ? type : type + ": " + words;
}

[[noreturn]] void refuse(const nb::handle value) {
  throw std::runtime_error("found " + type_of(value) +
                           ", expected a number, or three: F, dF/dx, dF/dv");
}

double number_of(const nb::handle value) {
  double x = 0.0;
  if (PyFloat_CheckExact(value.ptr())) return PyFloat_AS_DOUBLE(value.ptr());
  if (!nb::try_cast(value, x)) refuse(value);
  return x;
}

ForceLawValue value_of(const nb::object& value) {
  if (!PyTuple_Check(value.ptr())) return number_of(value);
  const nb::tuple all = nb::borrow<nb::tuple>(value);
  if (all.size() != 3) refuse(value);
  return {number_of(all[0]), number_of(all[1]), number_of(all[2])};
}

}  // namespace

ForceFunction law_of(const nb::object& function) {
  const nb::object label = nb::getattr(function, "label", nb::str(""));
  return {[kept = shared(nb::object(function))](double x, double v, double t) -> ForceLawValue {
            Locked lock;
            try {
              return value_of((*kept)(x, v, t));
            } catch (nb::python_error& error) {
              throw PythonThrown(text_of(error), std::move(error));
            }
          },
          text("label", label)};
}

void set_cause(const nb::object& error, const std::exception_ptr& thrown) {
  if (!thrown) return;
  try {
    std::rethrow_exception(thrown);
  } catch (const PythonThrown& p) {
    const nb::handle value = p.error->value();
    if (!p.error->matches(PyExc_Exception)) {
      PyErr_SetObject(p.error->type().ptr(), value.ptr());
      throw nb::python_error();
    }
    PyException_SetCause(error.ptr(), value.inc_ref().ptr());
  } catch (const std::exception&) {
  }
}

}  // namespace floatframe::python

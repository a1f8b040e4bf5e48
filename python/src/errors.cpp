// Exceptions: converts those of C++ to those of floatframe.errors, with every error of an input and
// its location.
#include <exception>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

nb::object class_named(const char* name) {
  return nb::module_::import_("floatframe.errors").attr(name);
}

nb::object entries_of(const InputError& error) {
  const nb::object worded = class_named("entry_of");
  nb::list list;
  for (const ErrorEntry& e : error.errors())
    list.append(worded(e.mark.file, e.mark.line, e.mark.column, e.message, error_code_name(e.code),
                       e.path));
  return list;
}

template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const nb::object type = class_named(name);
  const nb::object error = type(arguments...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(const std::exception_ptr& p, void*) {
  try {
    std::rethrow_exception(p);
  } catch (const UnknownName& error) {
    raise("UnknownNameError", entries_of(error));
  } catch (const InputError& error) {
    raise("InputError", entries_of(error));
  } catch (const RunError& error) {
    const nb::object type = class_named("RunError");
    const nb::object e = type(error.what(), error_code_name(error.code()));
    set_cause(e, error.cause());
    PyErr_SetObject(type.ptr(), e.ptr());
  } catch (const OutputError& error) {
    raise("OutputError", error.what());
  }
}

}  // namespace

void bind_errors(nb::module_&) { nb::register_exception_translator(translate); }

}  // namespace floatframe::python

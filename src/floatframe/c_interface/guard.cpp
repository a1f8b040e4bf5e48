#include "floatframe/c_interface/guard.hpp"

#include <exception>
#include <new>
#include <stdexcept>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/loops/run_error.hpp"

namespace floatframe {

floatframe_status status_of_exception(BoundedText& message) noexcept {
  try {
    throw;
  } catch (const WrongOrder& error) {
    message.set(error.what());
    return FLOATFRAME_WRONG_ORDER;
  } catch (const InputError& error) {
    message.set(error.what());
    return FLOATFRAME_INVALID;
  } catch (const RunError& error) {
    message.set(error.what());
    return FLOATFRAME_NO_START;
  } catch (const std::bad_alloc&) {
    message.set("there is not enough memory");
    return FLOATFRAME_OUT_OF_MEMORY;
  } catch (const std::length_error&) {
    message.set("there is not enough memory");
    return FLOATFRAME_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    message.set(error.what());
    return FLOATFRAME_INTERNAL;
  } catch (...) {
    message.set("an error without a text");
    return FLOATFRAME_INTERNAL;
  }
}

}  // namespace floatframe

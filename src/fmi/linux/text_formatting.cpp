// The functions of fmt that the objects of the library call, compiled into the FMU: its library is
// not on every machine. All inline functions of this file are kept (cmake/FmuRuntime.cmake), and
// the linker drops those that nothing calls.
#define FMT_HEADER_ONLY
#include <fmt/format.h>

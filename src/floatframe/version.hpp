#pragma once
// Version of the headers (FLOATFRAME_VERSION) and of the library (`version()`), and how it was
// built.
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/version.hpp"

#pragma once
// The functions of floatframe.h that an FMU calls: those of one instruction set, chosen once when
// the library is loaded (choose_functions.cpp), or those of a test.
#include "floatframe/c_interface/function_table.hpp"

namespace floatframe::fmi {

/// Never changes after the first call.
const floatframe_functions& functions() noexcept;

}  // namespace floatframe::fmi

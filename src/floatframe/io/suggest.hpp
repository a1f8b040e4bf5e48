#pragma once
// Where `did_you_mean` was before every room needed it.
#include "floatframe/core/suggest.hpp"

#pragma once
// Vectors, matrices and poses; laws of springs, tables and motions.
#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/math/piecewise_polynomial.hpp"
#include "floatframe/math/pose.hpp"
#include "floatframe/math/types.hpp"

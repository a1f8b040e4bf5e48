// Compiled by hand, without the settings that the CMake package gives.
#include <floatframe/model.hpp>

int main() { return static_cast<int>(floatframe::ModelDescription().bodies.size()); }

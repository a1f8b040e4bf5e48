#pragma once
// Values of every option of a part, as the command line and as a model file write them.
#include <string>
#include <vector>

#include "floatframe/parts/part_options.hpp"

namespace floatframe::test {

struct PartExample {
  const PartOption* option;
  std::string text;  ///< on the command line and in the provenance
  std::string yaml;  ///< behind the key in a model file
};

/// Of every option at least one value that is not its default.
std::vector<PartExample> part_examples();

}  // namespace floatframe::test

#pragma once
// The options of parts on the command line, generated from parts/part_options.hpp.
#include <string>
#include <vector>

#include "floatframe/core/options.hpp"
#include "floatframe/parts/part_options.hpp"

namespace floatframe {

/// Values of the options on the command line. The table of options points into it.
class PartArguments {
 public:
  PartArguments();
  PartArguments(const PartArguments&) = delete;
  PartArguments& operator=(const PartArguments&) = delete;

  /// `reading`: only those that affect how a file is read.
  std::vector<Option> table(bool reading);
  /// Job from the options given. Throws InputError.
  PartJob job() const;

 private:
  struct Given {
    const PartOption* option;
    std::string text;
    std::vector<std::string> texts;  // of repeated options
    bool flag = false;
  };
  std::vector<Given> given_;
};

}  // namespace floatframe

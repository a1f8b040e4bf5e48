#pragma once
// A motion in a file of another program: it takes the instants one after the other and is written
// when it is complete.
#include <string>
#include <vector>

#include "floatframe/model/output_view.hpp"

namespace floatframe {

/// What is exported: bodies of the model, ascending, at so many instants.
struct ExportBodies {
  const Model* model = nullptr;
  std::vector<int> bodies;
  std::size_t instants = 0;  ///< how many will be added
};

class ExportFile {
 public:
  virtual ~ExportFile() = default;
  /// The next instant. Throws OutputError if what is written meanwhile cannot be.
  virtual void add(const OutputView& view) = 0;
  /// Writes the file; what was written, in a few words. Throws OutputError, or InputError if it
  /// would be larger than its format allows.
  virtual std::string finish() = 0;
};

}  // namespace floatframe

#pragma once
// Model files: a model file, the file of a subsystem and a table, divided by lines "====". They are
// written into a folder of their own, because models are read by their path.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "readers.hpp"

namespace floatframe::fuzz {

class ModelFolder {
 public:
  ModelFolder() {
    setenv("FLOATFRAME_CACHE", "off", 1);
    std::string name = (std::filesystem::temp_directory_path() / "floatframe-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for model files");
    path_ = name;
  }
  ~ModelFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string write(const char* name, std::string_view content) const {
    const std::string path = (path_ / name).string();
    std::ofstream(path, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
    return path;
  }

 private:
  std::filesystem::path path_;
};

/// Whether a model is small enough to be built in a moment.
inline bool small(const ModelDescription& description) {
  int elements = 0;
  for (const BodyDescription& body : description.bodies)
    if (const auto* flexible = std::get_if<FlexibleDescription>(&body.kind)) {
      if (flexible->normal_modes > 20) return false;
      for (const BarDescription& bar : flexible->bars) {
        if (bar.elements > 20) return false;
        elements += bar.elements;
      }
    }
  return elements <= 60 && description.bodies.size() <= 40;
}

/// What is read, and built if it is small, or refused with an InputError.
inline void model(std::string_view bytes) {
  static const ModelFolder folder;
  const std::vector<std::string> parts = parts_of(bytes, 3);
  folder.write("sub.yaml", parts[1]);
  folder.write("table.csv", parts[2]);
  const ModelDescription description = read_model(folder.write("model.yaml", parts[0]));
  if (small(description)) build_model(description);
}

inline constexpr Reader model_reader = {"model", model};

}  // namespace floatframe::fuzz

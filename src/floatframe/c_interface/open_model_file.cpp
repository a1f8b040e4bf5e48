// Opening a file by its name. The room has no other source that needs the readers of model files.
#include "floatframe/c_interface/guard.hpp"
#include "floatframe/c_interface/opened_model.hpp"
#include "floatframe/c_interface/simulation_handle.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/model_file/load_model.hpp"

namespace floatframe {

OpenedModel opened_file(const std::string& path) {
  std::string beginning;
  const std::string error = read_regular_beginning(path, 64, beginning);
  if (error.empty() && is_packed_model(std::as_bytes(std::span<const char>(beginning)))) {
    OpenedModel opened{.packed = read_packed_model(path), .model = {}};
    opened.model = opened.packed->build();
    return opened;
  }
  return {.packed = std::nullopt, .model = load_model(path)};
}

}  // namespace floatframe

floatframe_simulation* floatframe_open(const char* path, char* message, size_t size) noexcept {
  return floatframe::open_guarded(message, size, [path] {
    if (path == nullptr)
      throw floatframe::InputError(floatframe::ErrorCode::missing,
                                   "found no path, expected the name of a model file");
    return floatframe::opened_file(path);
  });
}

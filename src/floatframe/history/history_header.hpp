#pragma once
// The header of a result file: the content of its rows, the model, and the inputs of the run.
// docs/result-file.md has its keys.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

/// The inputs of a run.
struct HistoryOrigin {
  std::string program;                       ///< version
  std::string library;                       ///< its version, build, fingerprint of its file
  std::string model_file;                    ///< as given
  std::string from_here;                     ///< relative to the folder of the result file
  std::vector<std::string> settings;         ///< "name=value"
  std::map<std::string, std::string> files;  ///< files read, and their fingerprints
  std::string text;                          ///< text of the model files with parameter values
};

struct HistoryGroup {
  std::string name;
  std::size_t first = 0, count = 0;  ///< columns
};

struct HistoryBody {
  std::string name;
  double mass = 0.0;                           ///< [kg]
  std::vector<std::string> modes;              ///< names
  std::vector<double> frequencies;             ///< of each mode alone [Hz]; -1: not finite
  int pose = -1, amplitudes = -1, rates = -1;  ///< first columns; -1: not recorded
  int shape = -1;                              ///< index; equal bodies share one
};

/// A column of the group "health".
struct HistoryHealth {
  std::string name, unit, group;
  std::string body;   ///< empty: of the system
  double size = 0.0;  ///< of the body [m]
};

/// The names of the nodes of a shape, and its colour; its arrays are "shapes/0/...".
struct HistoryShape {
  std::vector<std::string> nodes;
  std::string color = {};  ///< "#rrggbb" or empty
};

struct HistoryArray {
  std::string name, type;  ///< f32, f64 or u32
  std::vector<std::uint64_t> shape;
};

struct HistoryHeader {
  HistoryOrigin origin;
  std::string model, model_hash;  ///< name, and fingerprint of everything that affects the motion
  std::string coordinates, inertia;
  double step = 0.0, duration = 0.0, output_interval = 0.0;  ///< [s]
  std::size_t columns = 0;
  std::vector<HistoryGroup> groups;
  int configurations = 0, velocities = 0;  ///< coordinates of the model
  std::vector<int> q, v;                   ///< recorded coordinates, ascending
  std::vector<std::string> owners;         ///< of each recorded velocity
  std::vector<HistoryBody> bodies;
  std::vector<HistoryHealth> health;  ///< empty: the run had no range checks
  std::vector<HistoryShape> shapes;
  std::vector<HistoryArray> arrays;

  /// nullptr if there is none of that name.
  const HistoryGroup* find(std::string_view name) const noexcept;
  bool complete() const noexcept {
    return static_cast<int>(q.size()) == configurations && static_cast<int>(v.size()) == velocities;
  }
};

/// Bytes of an array; 0 if there are more than 2^62.
std::uint64_t array_bytes(const HistoryArray& array) noexcept;

std::string header_json(const HistoryHeader& header);
/// Throws InputError with the error, without a location.
HistoryHeader header_from_json(std::string_view text);

}  // namespace floatframe

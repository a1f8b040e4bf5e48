#pragma once
// Cache of parsed model files and of random roads, for studies: files with unchanged text are not
// parsed again, and equal roads not summed again.
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/yaml/yaml_tree.hpp"

namespace floatframe {

class ParsedFiles {
 public:
  /// The document of `text`, parsed now if it is not cached. One with errors is not cached.
  std::shared_ptr<const YamlDocument> get(const std::string& file, const std::string& text,
                                          ReadErrors& errors);
  /// `random_road`, of which the last ones are kept.
  PiecewisePolynomial road(const RoadSpectrum& spectrum);

 private:
  struct Parsed {
    std::string text;
    std::shared_ptr<const YamlDocument> document;
  };
  std::mutex mutex_;
  std::map<std::string, Parsed> files_;
  std::deque<std::pair<RoadSpectrum, PiecewisePolynomial>> roads_;
};

}  // namespace floatframe

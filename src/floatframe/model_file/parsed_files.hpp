#pragma once
// Model files that were parsed before, for studies: as long as their text is the same they are not
// parsed again.
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "floatframe/yaml/yaml_tree.hpp"

namespace floatframe {

class ParsedFiles {
 public:
  /// The document of `text`, parsed now if it is not known. One with errors is not kept.
  std::shared_ptr<const YamlDocument> get(const std::string& file, const std::string& text,
                                          ReadErrors& errors);

 private:
  struct Parsed {
    std::string text;
    std::shared_ptr<const YamlDocument> document;
  };
  std::mutex mutex_;
  std::map<std::string, Parsed> files_;
};

}  // namespace floatframe

#pragma once
// Cache of parsed model files, for studies: files with unchanged text are not parsed again.
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "floatframe/yaml/yaml_tree.hpp"

namespace floatframe {

class ParsedFiles {
 public:
  /// The document of `text`, parsed now if it is not cached. One with errors is not cached.
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

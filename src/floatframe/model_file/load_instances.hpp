#pragma once
// From the model file to the tree of its instances: the files of subsystems, their parameters,
// points, names and connections.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/model_file/model_instance.hpp"
#include "floatframe/model_file/parsed_files.hpp"

namespace floatframe {

/// Files already parsed, once each.
class ModelFiles {
 public:
  /// `parsed`: files kept from earlier readings, optional.
  explicit ModelFiles(ReadErrors& errors, ParsedFiles* parsed = nullptr)
      : errors_(errors), parsed_(parsed) {}
  /// Supplies a text to be used instead of a file.
  void give(const std::string& file, const std::string& text);
  /// nullptr and an error if the file cannot be read. `where`, `subject`: location of the reference
  /// to the file.
  const YamlDocument* load(const std::string& file, const SourceMark& where,
                           const std::string& subject);
  /// Position of the file in the order of loading (for sorting errors).
  std::size_t order(const std::string& file) const;

  CsvFiles tables;  ///< by the readers of tables

 private:
  const YamlDocument* parse(const std::string& file, const std::string& text);

  ReadErrors& errors_;
  ParsedFiles* parsed_;
  std::vector<std::pair<std::string, std::shared_ptr<const YamlDocument>>> documents_;
};

/// Reads the file and, recursively, its subsystems: parameters, points and the names of all
/// entities. nullptr if the model file itself cannot be read.
std::unique_ptr<ModelInstance> load_instances(const std::string& path,
                                              const std::vector<ParameterOverride>& overrides,
                                              ModelFiles& files, ReadErrors& errors);

}  // namespace floatframe

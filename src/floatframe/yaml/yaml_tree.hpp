#pragma once
// A YAML document as a tree with source locations. Only the subset used by model files is accepted:
// maps, lists and scalars. Duplicate keys, anchors, aliases, merge keys, tags, several documents,
// tabs in the indentation, very deep nesting, control characters and invalid UTF-8 are errors, so
// that no file is read differently from its appearance.
#include <map>
#include <string>
#include <vector>

#include "floatframe/yaml/read_errors.hpp"

namespace floatframe {

struct YamlEntry;

struct YamlNode {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  int line = 0, column = 0;        ///< from 1
  std::string text;                ///< scalar
  bool quoted = false;             ///< scalar in quotes or a block scalar: always a text
  bool refused = false;            ///< already reported: suppresses further errors
  std::vector<YamlNode> items;     ///< sequence
  std::vector<YamlEntry> entries;  ///< map, in the order of the file, keys unique
};

struct YamlEntry {
  std::string key;
  int line = 0, column = 0;  ///< of the key
  YamlNode value;
};

struct YamlDocument {
  std::string file;  ///< as given by the user
  YamlNode root;
  std::size_t values = 0;  ///< number of maps, lists and scalars, keys included
};

/// Parses `text`; errors go to `errors`. A document with errors contains the parts that could be
/// parsed.
YamlDocument parse_yaml(const std::string& file, const std::string& text, ReadErrors& errors);

/// Reads a regular file of at most 16 MB; a file that cannot be read gives an error marked `where`
/// (or the file itself if `where` is empty) and false.
bool read_text_file(const std::string& file, std::string& text, ErrorList& errors,
                    const SourceMark& where, const std::string& subject);
bool read_text_file(const std::string& file, std::string& text, ReadErrors& errors,
                    const SourceMark& where, const std::string& subject);

/// Records a file read by other means, with the fingerprint of its content (see FilesRead).
void note_file_read(const std::string& file, const std::string& hash);

/// In its scope, records every file that is read on this thread, with the fingerprint of its
/// content.
class FilesRead {
 public:
  explicit FilesRead(std::map<std::string, std::string>& hashes);
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

 private:
  std::map<std::string, std::string>* before_;
};

}  // namespace floatframe

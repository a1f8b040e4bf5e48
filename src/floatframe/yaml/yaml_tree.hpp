#pragma once
// A YAML document as a tree that remembers where everything was written. Only the subset that model
// files use is accepted: maps, lists and scalars. Duplicate keys, anchors, aliases, merge keys,
// tags, several documents, tabs in the indentation, very deep nesting, control characters and
// anything that is not UTF-8 text are errors, so that no file is read differently from what it
// looks like.
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
  bool refused = false;            ///< an error already: nothing more is said about it
  std::vector<YamlNode> items;     ///< sequence
  std::vector<YamlEntry> entries;  ///< map, in the order of the file, keys unique
};

struct YamlEntry {
  std::string key;
  int line = 0, column = 0;  ///< of the key
  YamlNode value;
};

struct YamlDocument {
  std::string file;  ///< as the user gave it
  YamlNode root;
  std::size_t values = 0;  ///< number of maps, lists and scalars, keys included
};

/// Parses `text`; errors go to `errors`. A document with errors is returned as far as it was
/// understood.
YamlDocument parse_yaml(const std::string& file, const std::string& text, ReadErrors& errors);

/// Reads a regular file of at most 16 MB; a file that cannot be read gives an error marked `where`
/// (or the file itself if `where` is empty) and false.
bool read_text_file(const std::string& file, std::string& text, ErrorList& errors,
                    const SourceMark& where, const std::string& subject);
bool read_text_file(const std::string& file, std::string& text, ReadErrors& errors,
                    const SourceMark& where, const std::string& subject);

/// Notes a file that was read in another way, with the fingerprint of its content (see FilesRead).
void note_file_read(const std::string& file, const std::string& hash);

/// While it lives, notes every file that is read on this thread, with the fingerprint of its
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

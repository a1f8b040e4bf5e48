#pragma once
// The options of a reduction, once each: their names, values and members of a job.
//   model file            command line             provenance
//   effective_mass: 0.9   --effective-mass 0.9     effective-mass = 0.9
// The reader of model files, `floatframe reduce`, the provenance of a body and the key of the cache
// iterate over this list, so that a new option of a known kind is one entry in part_options.cpp.
// That file does not compile while a member of PartJob, FeReadOptions or PartOptions has no entry.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/parts/part_job.hpp"

namespace floatframe {

struct PartOption {
  /// A number; 0 if not given.
  struct Number {
    NumberRule rule;
    double PartOptions::*at;
  };
  /// A whole number. `written`: the text in the provenance.
  struct Count {
    WholeNumberRule rule;
    std::optional<int> PartOptions::*at;
    std::optional<int> (*written)(const PartOptions&);
  };
  /// An enumerator by its word.
  struct Word {
    std::vector<const char*> words;  ///< of `first` and the enumerators that follow it
    int first;
    int (*get)(const PartJob&);
    void (*set)(PartJob&, int);
    std::optional<int> unwritten{};  ///< the enumerator omitted in the provenance
  };
  /// On the command line a flag.
  struct Switch {
    bool PartOptions::*at;
    bool flag;    ///< value set by the flag of the command line
    bool absent;  ///< value if the key of the model file is absent
  };
  /// An additional file of the model.
  struct File {
    std::filesystem::path FeReadOptions::*at;
  };
  /// Values of a special form: each has a reader in model_file/read_part_job.cpp.
  struct Special {
    enum class What {
      units,
      format,
      material,
      densities,
      thicknesses,
      contact,
      temperature,
      damping,
      interfaces,
      markers,
      reference
    } what;
    std::vector<std::string> (*texts)(const PartJob&);
    /// Parses one value of the command line. Throws InputError.
    void (*parse)(PartJob&, const std::string& text);
    bool repeated = false;
  };

  const char* key;    ///< key in model files
  const char* name;   ///< on the command line, after --, and in the provenance
  const char* value;  ///< as shown in the help, "HZ"; "" for switches
  const char* help;
  std::variant<Number, Count, Word, Switch, File, Special> kind;
  bool reading = false;  ///< affects reading: `floatframe info` has it too
};

std::span<const PartOption> part_options();

/// Texts of an option in the provenance: none if it is not given, several if it is repeated.
std::vector<std::string> option_texts(const PartOption& option, const PartJob& job);

/// The files of a job in addition to the first.
std::vector<std::filesystem::path> other_files(const PartJob& job);

}  // namespace floatframe

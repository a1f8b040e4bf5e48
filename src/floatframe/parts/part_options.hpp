#pragma once
// The options of a reduction, each once: its names, what its values are and where a job keeps it.
//   model file            command line             provenance
//   effective_mass: 0.9   --effective-mass 0.9     effective-mass = 0.9
// The reader of model files, `floatframe reduce`, the provenance of a body and the key of the cache
// run over this list, so that a new option of a known kind is one entry in part_options.cpp. That
// file does not compile while a member of PartJob, FeReadOptions or PartOptions has none.
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
  /// A whole number. `written`: what the provenance shows.
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
    std::optional<int> unwritten{};  ///< the enumerator that the provenance does not show
  };
  /// On the command line a flag that is there or not.
  struct Switch {
    bool PartOptions::*at;
    bool flag;    ///< what the flag of the command line makes it
    bool absent;  ///< without the key of the model file
  };
  /// A further file of the model.
  struct File {
    std::filesystem::path FeReadOptions::*at;
  };
  /// Values of a form of their own: each has a reader in model_file/read_part_job.cpp.
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
    /// One value of the command line. Throws InputError.
    void (*parse)(PartJob&, const std::string& text);
    bool repeated = false;
  };

  const char* key;    ///< of model files
  const char* name;   ///< on the command line, behind --, and in the provenance
  const char* value;  ///< as the help shows it, "HZ"; "" of switches
  const char* help;
  std::variant<Number, Count, Word, Switch, File, Special> kind;
  bool reading = false;  ///< decides how the file is read: `floatframe info` takes it too
};

std::span<const PartOption> part_options();

/// What the provenance shows of an option: nothing if it is not given, several if it is repeated.
std::vector<std::string> option_texts(const PartOption& option, const PartJob& job);

/// The files that a job names besides the first.
std::vector<std::filesystem::path> other_files(const PartJob& job);

}  // namespace floatframe

#pragma once
// The options of a command as a table, used by the parser (targets) and the help (texts).
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace floatframe {

/// One option, flag or position; made by the functions below.
struct Option {
  /// Where the value goes; vectors take several, a bool is a flag.
  using Target = std::variant<bool*, int*, double*, std::string*, std::vector<std::string>*,
                              std::vector<int>*, std::vector<double>*>;

  std::string name;  ///< "--step", "-o,--out", or "MODEL": a position
  std::string type;  ///< "SECONDS", as the help shows it
  std::string help;
  Target target;
  std::vector<std::string> words{};  ///< the values allowed; empty: any
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();  ///< of numbers, both included
  bool commas = false;    ///< vectors: 1,2,3; otherwise one value per occurrence
  bool required = false;  ///< a position that must be given and not empty
};

/// The target's value is the default and is kept if the option is not given.
Option flag(std::string name, bool& target, std::string help);
Option text_option(std::string name, std::string& target, std::string type, std::string help);
/// One of `words`.
Option word_option(std::string name, std::string& target, std::vector<std::string> words,
                   std::string help);
/// Whole numbers of `low` to `high`, `words` or numbers separated by commas.
Option whole_option(std::string name, int& target, int low, int high, std::string help,
                    std::string type = "N");
Option whole_list(std::string name, std::vector<int>& target, int low, int high, std::string help);
Option word_list(std::string name, std::vector<std::string>& target, std::vector<std::string> words,
                 std::string help);
/// `option` with these values only.
Option one_of(std::vector<std::string> words, Option option);
/// Numbers of `low` to `high`, one or several separated by commas. `type`: for the help, "HERTZ".
Option number_option(std::string name, double& target, double low, double high, std::string type,
                     std::string help);
Option number_list(std::string name, std::vector<double>& target, double low, double high,
                   std::string type, std::string help);
/// A number from 0 to 1.
Option fraction_option(std::string name, double& target, std::string help);
/// May be repeated, one value each time.
Option repeated_option(std::string name, std::vector<std::string>& target, std::string type,
                       std::string help);
/// The main input file of a command.
Option file_position(std::string name, std::string& target, std::string help);
/// An optional text.
Option text_position(std::string name, std::string& target, std::string help);

}  // namespace floatframe

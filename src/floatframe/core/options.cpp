#include "floatframe/core/options.hpp"

#include <utility>

namespace floatframe {

Option flag(std::string name, bool& target, std::string help) {
  return {.name = std::move(name), .type = "", .help = std::move(help), .target = &target};
}

Option text_option(std::string name, std::string& target, std::string type, std::string help) {
  return {
      .name = std::move(name), .type = std::move(type), .help = std::move(help), .target = &target};
}

Option word_option(std::string name, std::string& target, std::vector<std::string> words,
                   std::string help) {
  return one_of(std::move(words), text_option(std::move(name), target, "WORD", std::move(help)));
}

Option whole_option(std::string name, int& target, int low, int high, std::string help,
                    std::string type) {
  Option option{
      .name = std::move(name), .type = std::move(type), .help = std::move(help), .target = &target};
  option.low = low;
  option.high = high;
  return option;
}

Option whole_list(std::string name, std::vector<int>& target, int low, int high, std::string help) {
  Option option{
      .name = std::move(name), .type = "LIST", .help = std::move(help), .target = &target};
  option.low = low;
  option.high = high;
  option.commas = true;
  return option;
}

Option word_list(std::string name, std::vector<std::string>& target, std::vector<std::string> words,
                 std::string help) {
  Option option =
      one_of(std::move(words), repeated_option(std::move(name), target, "LIST", std::move(help)));
  option.commas = true;
  return option;
}

Option one_of(std::vector<std::string> words, Option option) {
  option.words = std::move(words);
  return option;
}

Option number_option(std::string name, double& target, double low, double high, std::string type,
                     std::string help) {
  Option option{
      .name = std::move(name), .type = std::move(type), .help = std::move(help), .target = &target};
  option.low = low;
  option.high = high;
  return option;
}

Option number_list(std::string name, std::vector<double>& target, double low, double high,
                   std::string type, std::string help) {
  Option option{
      .name = std::move(name), .type = std::move(type), .help = std::move(help), .target = &target};
  option.low = low;
  option.high = high;
  option.commas = true;
  return option;
}

Option fraction_option(std::string name, double& target, std::string help) {
  return number_option(std::move(name), target, 0.0, 1.0, "FRACTION", std::move(help));
}

Option repeated_option(std::string name, std::vector<std::string>& target, std::string type,
                       std::string help) {
  return {
      .name = std::move(name), .type = std::move(type), .help = std::move(help), .target = &target};
}

Option file_position(std::string name, std::string& target, std::string help) {
  Option option = text_position(std::move(name), target, std::move(help));
  option.required = true;
  return option;
}

Option text_position(std::string name, std::string& target, std::string help) {
  return text_option(std::move(name), target, "", std::move(help));
}

}  // namespace floatframe

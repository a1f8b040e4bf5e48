// Sentences about controllers and signals.
#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/description/sentences.hpp"

namespace floatframe::sentences {

std::string controller_needs(const std::string& key, const std::string& why) {
  return "missing key '" + key + "', which " + why + " needs";
}

std::string controller_without_gain() {
  return "found no gain, expected proportional, integral or derivative";
}

std::string filter_and_rate() {
  return "excludes 'rate', which needs no filter; remove one of them";
}

std::string controller_limits(double lower, double upper) {
  return "found " + number_text(lower) + ", expected less than 'upper', " + number_text(upper);
}

std::string initial_beyond_limits(double initial) {
  return "found the start value " + number_text(initial) + ", expected one within the limits";
}

std::string not_whole(double number) {
  return "found " + number_text(number) + ", expected a whole number";
}

std::string long_delay(double time, double step, double count, double most) {
  return "found a delay of " + number_text(time) + " s, which keeps " + number_text(count) +
         " numbers at steps of " + number_text(step) + " s, expected at most " + number_text(most);
}

std::string unused_without(const std::string& others) {
  return "is not used without " + others + "; remove it, or give that too";
}

std::string excludes(const std::string& key) {
  return "excludes '" + key + "'; remove one of them";
}

std::string none_given(const std::vector<const char*>& keys) {
  return "found none of its keys, expected " + alternatives(keys);
}

std::string no_signals() { return "found an empty list, expected signals"; }

std::string no_such_value(const std::string& found, const std::vector<std::string>& names) {
  if (names.empty()) return "found the output '" + found + "' of an element with one value";
  std::vector<const char*> words;
  for (std::size_t k = 0; k < std::min<std::size_t>(names.size(), 20); ++k)
    words.push_back(names[k].c_str());
  return "found the output '" + found + "', expected " + alternatives(words) +
         (names.size() > 20 ? " or another one" : "") + did_you_mean(found, names);
}

std::string signals_of_file(std::size_t found, const std::vector<std::string>& inputs) {
  std::string names;
  for (std::size_t k = 0; k < std::min<std::size_t>(inputs.size(), 20); ++k)
    names += (k == 0 ? "" : ", ") + inputs[k];
  return "found " + std::to_string(found) + (found == 1 ? " signal" : " signals") + ", expected " +
         std::to_string(inputs.size()) + " for the inputs of the file: " + names;
}

std::string too_many_states(Eigen::Index states, Eigen::Index most) {
  return "found " + std::to_string(states) + " states, expected at most " + std::to_string(most);
}

std::string names_of_values(std::size_t names, Eigen::Index rows) {
  return "found " + std::to_string(names) + " names, expected " + std::to_string(rows) +
         ", one for each row of C";
}

std::string matrix_size(Eigen::Index rows, Eigen::Index columns, Eigen::Index expected_rows,
                        Eigen::Index expected_columns) {
  const auto size = [](Eigen::Index m, Eigen::Index n) {
    return std::to_string(m) + " x " + std::to_string(n);
  };
  return "found " + size(rows, columns) + " numbers, expected " +
         size(expected_rows, expected_columns);
}

std::string coefficients(Eigen::Index rows, Eigen::Index columns, Eigen::Index most) {
  return "found " + std::to_string(rows) + " x " + std::to_string(columns) +
         " numbers, expected a list of at most " + std::to_string(most) + " coefficients";
}

std::string leading_coefficient() {
  return "expected at least two coefficients, of descending powers of s, the first one not 0";
}

std::string improper(Eigen::Index numerator, Eigen::Index denominator) {
  return "found the degree " + std::to_string(numerator) +
         ", expected at most that of the denominator, " + std::to_string(denominator);
}

std::string held_samples(const std::vector<std::string>& names) {
  return named_text("sampled controller", "sampled controllers", names) +
         (names.size() == 1 ? " is held at its value" : " are held at their values") +
         ": what follows from the next samples is left out";
}

std::string sample_off_step(const std::string& key, double value, double step) {
  return "found the " + key + " " + number_text(value) + " s, expected a multiple of the step, " +
         number_text(step) + " s, which is not divided in real time";
}

std::string step_over_samples(const std::string& element, double period, double step, double most) {
  return element + ": found the period " + number_text(period) + " s, expected at least " +
         number_text(most) + " of the step, " + number_text(step) + " s";
}

std::string long_delay(double delay, double period, int most) {
  return "found " + number_text(delay) + " s, expected at most " + std::to_string(most) +
         " periods of " + number_text(period) + " s";
}

std::string one_source(SignalSource first) {
  return excludes(signal_source_words[index_of(first)]);
}

std::string element_without(const std::string& type, SignalSource source) {
  return "found a " + type + ", expected an element with a " +
         signal_source_words[index_of(source)];
}

std::string ring_of_signals(const std::vector<std::string>& elements) {
  std::string ring;
  for (const std::string& element : elements) ring += element + " -> ";
  return "found a ring of signals without a state, " + ring + elements.front() +
         ": expected a state in it, for example a controller with 'integral'";
}

}  // namespace floatframe::sentences

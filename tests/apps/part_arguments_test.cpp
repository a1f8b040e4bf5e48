// The options of a part on the command line: each is in the table, and its values reach the job.
#include "floatframe/apps/part_arguments.hpp"

#include <gtest/gtest.h>

#include "support/part_examples.hpp"

namespace floatframe {
namespace {

/// What the parser does with "--name text".
PartJob job_with(const std::string& name, const std::string& text) {
  PartArguments arguments;
  int found = 0;
  for (const Option& option : arguments.table(false)) {
    if (option.name != "--" + name) continue;
    ++found;
    if (auto* const* one = std::get_if<std::string*>(&option.target))
      **one = text;
    else if (auto* const* several = std::get_if<std::vector<std::string>*>(&option.target))
      (*several)->push_back(text);
    else
      **std::get_if<bool*>(&option.target) = true;
  }
  EXPECT_EQ(found, 1) << name;
  return arguments.job();
}

std::vector<std::string> texts_of(const PartJob& job, const std::string& name) {
  std::vector<std::string> out;
  for (const auto& [option, text] : option_list(job))
    if (option == name) out.push_back(text);
  return out;
}

TEST(PartArguments, WhatTheCommandLineGivesIsWhatTheProvenanceShows) {
  const PartJob nothing = PartArguments().job();
  for (const test::PartExample& e : test::part_examples()) {
    const PartJob job = job_with(e.option->name, e.text);
    EXPECT_EQ(texts_of(job, e.option->name), std::vector<std::string>{e.text}) << e.option->name;
    EXPECT_NE(texts_of(nothing, e.option->name), std::vector<std::string>{e.text})
        << e.option->name;
  }
}

TEST(PartArguments, OptionsOfReadingAreThoseOfInfo) {
  PartArguments arguments;
  std::vector<std::string> names;
  for (const Option& option : arguments.table(true)) names.push_back(option.name);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "--format", "--dialect", "--beam-shear", "--shell-shear", "--mass-form",
                       "--material", "--density", "--thickness", "--contact", "--temperature",
                       "--grounded-springs", "--nodes", "--mass", "--dofs", "--damping-matrix"}));
}

TEST(PartArguments, RepeatedOptionsKeepTheirOrder) {
  PartArguments arguments;
  for (const Option& option : arguments.table(false))
    if (option.name == "--interface")
      *std::get<std::vector<std::string>*>(option.target) = {"B=node:2", "A=node:1"};
  EXPECT_EQ(texts_of(arguments.job(), "interface"),
            (std::vector<std::string>{"B=node:2", "A=node:1"}));
}

}  // namespace
}  // namespace floatframe

// The options of a part in a model file: every key reaches the job, and every value has a place of
// its own in the cache.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "floatframe/model_file/load_instances.hpp"
#include "floatframe/model_file/part_cache.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/yaml/read_errors.hpp"
#include "support/part_examples.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

/// The job of a group with one value of one option beside what every part needs.
PartJob job_with(const std::string& key, const std::string& yaml) {
  std::map<std::string, std::string> keys{
      {"file", "part.inp"}, {"units", "m-kg-s"}, {"interfaces", "{A: {node: 1}}"}};
  if (!key.empty()) keys[key] = yaml;
  std::string text = "floatframe: 1\nbodies:\n  arm:\n    part:\n";
  for (const auto& [name, value] : keys) text += "      " + name + ": " + value + "\n";
  const test::TemporaryFolder folder;
  ReadErrors errors;
  ModelFiles files(errors);
  const auto root = load_instances(folder.write("model.yaml", text), {}, files, errors);
  const auto job = read_part_job(
      *root, *root->root->get("bodies")->section()->get("arm")->section()->get("part")->section());
  for (const ErrorEntry& e : errors.take())
    ADD_FAILURE() << folder.without(e.text()) << "\n" << text;
  return job.value_or(PartJob());
}

using Given = std::vector<std::pair<std::string, std::string>>;

/// The list without one option, and the texts of that one.
std::pair<Given, std::vector<std::string>> apart(const PartJob& job, const std::string& name) {
  std::pair<Given, std::vector<std::string>> out;
  for (const auto& [option, text] : option_list(job))
    if (option == name)
      out.second.push_back(text);
    else
      out.first.emplace_back(option, text);
  return out;
}

TEST(PartOptions, EveryKeyOfAModelFileReachesItsOptionAndNoOther) {
  const PartJob base = job_with("", "");
  for (const test::PartExample& e : test::part_examples()) {
    const PartJob job = job_with(e.option->key, e.yaml);
    const auto [others, texts] = apart(job, e.option->name);
    EXPECT_NE(apart(base, e.option->name).second, texts) << e.option->key;
    EXPECT_EQ(texts, std::vector<std::string>{e.text}) << e.option->key;
    auto expected = apart(base, e.option->name).first;
    // Modes that are limited in another way are not limited to 20.
    if (others.size() < expected.size())
      std::erase(expected, std::pair<std::string, std::string>{"modes", "20"});
    EXPECT_EQ(others, expected) << e.option->key;
  }
}

TEST(PartOptions, EveryChangeOfAnOptionChangesThePlaceInTheCache) {
  std::map<std::filesystem::path, std::string> seen;
  const auto add = [&](const PartJob& job, const std::string& what) {
    const auto [it, fresh] = seen.emplace(part_cache_file(job, "cache"), what);
    EXPECT_TRUE(fresh) << what << " and " << it->second;
  };
  add(job_with("", ""), "nothing");
  std::map<std::string, int> values;
  for (const test::PartExample& e : test::part_examples()) {
    ++values[e.option->key];
    add(job_with(e.option->key, e.yaml), std::string(e.option->key) + ": " + e.yaml);
  }
  for (const PartOption& option : part_options()) EXPECT_GT(values[option.key], 0) << option.key;
}

TEST(PartOptions, TheContentOfAFileChangesThePlaceInTheCache) {
  const test::TemporaryFolder folder;
  for (const PartOption& option : part_options()) {
    const auto* file = std::get_if<PartOption::File>(&option.kind);
    if (!file) continue;
    PartJob job;
    job.file = folder.write("part.mtx", "same");
    job.read.*file->at = folder.write("other.txt", "one");
    const auto one = part_cache_file(job, "cache");
    EXPECT_EQ(part_cache_file(job, "cache"), one);
    folder.write("other.txt", "two");
    EXPECT_NE(part_cache_file(job, "cache"), one) << option.key;
  }
}

TEST(PartOptions, ADampingMatrixThatAppearsChangesThePlaceInTheCache) {
  const test::TemporaryFolder folder;
  PartJob job;
  job.file = folder.write("arm_K.mtx", "same");
  const auto without = part_cache_file(job, "cache");
  folder.write("arm_C.mtx", "dashpots");
  EXPECT_NE(part_cache_file(job, "cache"), without);
}

std::string document(const std::string& name) {
  std::ifstream file(FLOATFRAME_EXAMPLES "/../docs/" + name);
  EXPECT_TRUE(file) << name;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(PartOptions, EveryOneIsInTheDocuments) {
  const std::string keys = document("model-file.md"), command = document("parts.md");
  for (const PartOption& option : part_options()) {
    EXPECT_NE(keys.find("`" + std::string(option.key) + "`"), std::string::npos) << option.key;
    EXPECT_NE(command.find("--" + std::string(option.name)), std::string::npos) << option.name;
  }
}

}  // namespace
}  // namespace floatframe

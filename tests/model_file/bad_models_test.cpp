// Every invalid model file of tests/data/bad_models gives the errors that stand beside it: place,
// path and code.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"

namespace floatframe {
namespace {

const std::string folder = FLOATFRAME_TEST_DATA "/bad_models/";

std::string without_folder(std::string text) {
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
    text.erase(at, folder.size());
  return text;
}

std::string errors_of(const std::string& path,
                      const std::vector<ParameterOverride>& overrides = {}) {
  return without_folder(test::error_of([&] { read_model(path, overrides); }));
}

/// The errors a model must give stand beside it, in NAME.txt for NAME.yaml.
std::string expected_of(const std::filesystem::path& model) {
  std::ifstream file(std::filesystem::path(model).replace_extension(".txt"));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

TEST(BadModels, GiveTheExpectedErrors) {
  int models = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_directory() || entry.path().extension() == ".txt") continue;
    const std::string expected = expected_of(entry.path());
    EXPECT_FALSE(expected.empty()) << entry.path() << " has no file of its errors";
    EXPECT_EQ(errors_of(entry.path().string()), expected) << entry.path();
    ++models;
  }
  EXPECT_GE(models, 40);
}

TEST(BadModels, FilesThatCannotBeRead) {
  EXPECT_EQ(errors_of(folder + "nowhere.yaml"), "nowhere.yaml: unreadable");
  EXPECT_EQ(errors_of(folder + "parts"), "parts: unreadable");
  EXPECT_EQ(errors_of("/dev/null"), "/dev/null: unreadable");
}

TEST(BadModels, Overrides) {
  const std::string iltis = FLOATFRAME_EXAMPLES "/iltis/iltis.yaml";
  const auto tail = [&](const std::vector<ParameterOverride>& o) {
    const std::string text = errors_of(iltis, o);
    return text.compare(0, iltis.size(), iltis) == 0 ? text.substr(iltis.size()) : text;
  };
  EXPECT_EQ(tail({{"spead", "3"}}), ": unknown_key");
  EXPECT_EQ(tail({{"speed", "fast"}}), ": wrong_value");
  EXPECT_EQ(tail({{"flexible", "yes"}}), ": out_of_range");
  EXPECT_EQ(tail({{"speed", "${1/0}"}}), ": wrong_value");
}

TEST(BadModels, SameErrorsEveryTime) {
  const std::string first = errors_of(folder + "many.yaml");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(errors_of(folder + "many.yaml"), first);
}

}  // namespace
}  // namespace floatframe

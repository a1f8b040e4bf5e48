// Every input that the fuzzers start from or once broke a reader: a model or an InputError, nothing
// else. `make fuzz` looks for more.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "../../fuzz/packed.hpp"

namespace floatframe {
namespace {

const std::filesystem::path corpus = FLOATFRAME_TEST_DATA "/../../fuzz/corpus";

std::vector<fuzz::Reader> all_readers() {
  std::vector<fuzz::Reader> all(std::begin(fuzz::readers), std::end(fuzz::readers));
  all.insert(all.end(), std::begin(fuzz::model_readers), std::end(fuzz::model_readers));
  return all;
}

TEST(FuzzCorpus, NoReaderBreaks) {
  for (const fuzz::Reader& reader : all_readers()) {
    int inputs = 0, models = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus / reader.name)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      ++inputs;
      try {
        reader.read(bytes);
        ++models;
      } catch (const InputError& error) {
        EXPECT_FALSE(error.errors().empty()) << entry.path();
        EXPECT_FALSE(error.errors().front().message.empty()) << entry.path();
      } catch (const std::exception& error) {
        ADD_FAILURE() << entry.path() << ": " << error.what();
      }
    }
    EXPECT_GT(inputs, 0) << reader.name;
    EXPECT_GT(models, 0) << "no seed of " << reader.name << " is valid";
  }
}

TEST(FuzzCorpus, EveryFolderHasAReader) {
  std::set<std::string> names;
  for (const fuzz::Reader& reader : all_readers()) names.insert(reader.name);
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    EXPECT_TRUE(names.contains(entry.path().filename().string())) << entry.path();
  }
}

}  // namespace
}  // namespace floatframe

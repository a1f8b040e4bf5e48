// Writers of results: CSV round trip, JSON keys and words, files that are written atomically.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/results/results_csv.hpp"
#include "floatframe/results/summary_json.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

namespace fs = std::filesystem;

TEST(ResultsCsv, HasOneHeaderLineWithUnits) {
  const ResultTable table{{{"time", "s"}, {"chassis.z", "m"}, {"ratio", ""}}, {0, 0.5, 1}};
  EXPECT_EQ(results_csv(table), "time [s],chassis.z [m],ratio\n0,0.5,1\n");
}

TEST(ResultsCsv, NumbersReadBackToTheSameBits) {
  const std::vector<double> values{0.1,    1.0 / 3.0, -0.0,        5e-324,
                                   1e300,  M_PI,      std::exp(1), 123456789.123456789,
                                   -1e-17, 1.0,       0.1 + 0.2,   std::nextafter(1.0, 2.0)};
  ResultTable table{{{"time", "s"}, {"a", "m"}}, {}};
  table.data = values;
  std::istringstream lines(results_csv(table));
  std::string line;
  std::getline(lines, line);
  std::size_t i = 0;
  while (std::getline(lines, line)) {
    const std::size_t comma = line.find(',');
    for (const std::string& field : {line.substr(0, comma), line.substr(comma + 1)}) {
      const double read = std::strtod(field.c_str(), nullptr);
      EXPECT_EQ(read, values[i]);
      EXPECT_EQ(std::signbit(read), std::signbit(values[i]));
      ++i;
    }
  }
  EXPECT_EQ(i, values.size());
}

TEST(ResultsCsv, QuotesNamesWithSeparatorsAndKeepsOneHeaderLine) {
  const ResultTable table{{{"time", "s"}, {"a,b", "m"}, {"say \"x\"", ""}, {"two\nlines", ""}}, {}};
  EXPECT_EQ(results_csv(table), "time [s],\"a,b [m]\",\"say \"\"x\"\"\",\"two lines\"\n");
}

TEST(ResultsCsv, OfNothingIsEmpty) { EXPECT_EQ(results_csv({}), ""); }

TEST(SummaryJson, HasTheDocumentedKeysInOrder) {
  RunSummary summary;
  summary.model = "iltis";
  summary.coordinates = "relative";
  summary.inertia = "preprocessing";
  summary.step = 0.01;
  summary.energy.total_end = 2.5;
  const auto json = nlohmann::ordered_json::parse(summary_json(summary));
  std::string keys;
  for (const auto& [key, value] : json.items()) keys += key + ' ';
  EXPECT_EQ(keys,
            "model coordinates inertia step_s duration_s steps substeps iterations "
            "factorizations edges corners cpu_s real_time_factor step_times "
            "max_position_violation max_velocity_violation energy warnings start status message ");
  EXPECT_EQ(json["coordinates"], "relative");
  EXPECT_EQ(json["step_s"], 0.01);
  EXPECT_EQ(json["energy"]["end"]["total_J"], 2.5);
  EXPECT_TRUE(json["energy"]["balance"].is_null());
  EXPECT_TRUE(json["warnings"].empty());
  EXPECT_EQ(json["status"], "completed");
  EXPECT_TRUE(json["edges"].is_null()) << "not looked for";
  summary.locates_edges = true;
  summary.edges = 40;
  summary.edges_passed = 1;
  summary.corners = 3;
  const auto located = nlohmann::json::parse(summary_json(summary));
  EXPECT_EQ(located["edges"]["located"], 40);
  EXPECT_EQ(located["edges"]["steps_with_too_many"], 1);
  EXPECT_EQ(located["corners"], 3);
}

TEST(SummaryJson, NotFiniteIsNullAndBrokenTextIsReplaced) {
  RunSummary summary;
  summary.cpu = std::numeric_limits<double>::quiet_NaN();
  summary.message = "bad \xFF byte";
  const auto json = nlohmann::json::parse(summary_json(summary));
  EXPECT_TRUE(json["cpu_s"].is_null());
  EXPECT_EQ(json["message"], "bad \xEF\xBF\xBD byte");
}

TEST(SummaryJson, UnmeasuredValuesAreAbsent) {
  const auto keys = [](const RunSummary& summary) {
    std::vector<std::string> names;
    const auto json = nlohmann::ordered_json::parse(summary_json(summary));
    for (const auto& [key, value] : json.items()) names.push_back(key);
    return names;
  };
  RunSummary lost;  // a run of a study that was stopped
  lost.status = "failed";
  lost.message = "longer than 2 s";
  lost.settings = {"a=1"};
  EXPECT_EQ(keys(lost), (std::vector<std::string>{"status", "message"}));
  RunSummary never = lost;  // a start that cannot be
  never.model = "m";
  never.step = 0.01;
  EXPECT_EQ(keys(never), (std::vector<std::string>{"model", "coordinates", "inertia", "step_s",
                                                   "status", "message"}));
  RunSummary ended = never;  // in its first step
  ended.cpu = 1e-6;
  EXPECT_EQ(keys(ended).size(), 21u);
}

TEST(SummaryJson, ReportsTheStartValues) {
  RunSummary summary;
  summary.start.changes.push_back({"joint 'crank'", "angle", false, "rad", 0.3, 0.076});
  summary.start.redundant.push_back({"joint 'pin'", "rotation about x"});
  summary.start.notes = {"one", "two"};
  const auto start = nlohmann::json::parse(summary_json(summary))["start"];
  EXPECT_EQ(start["changes"][0]["owner"], "joint 'crank'");
  EXPECT_EQ(start["changes"][0]["given"], 0.3);
  EXPECT_EQ(start["changes"][0]["used"], 0.076);
  EXPECT_EQ(start["changes"][0]["rate"], false);
  EXPECT_EQ(start["redundant"][0]["direction"], "rotation about x");
  EXPECT_EQ(start["notes"].size(), 2u);
}

TEST(AtomicFile, ReplacesTheFileAndLeavesNothingElse) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("results.csv");
  write_file(path, "first");
  write_file(path, "second");
  EXPECT_EQ(folder.read("results.csv"), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(AtomicFile, FolderIsMadeWithThoseAboveItAndLeftEmpty) {
  const test::TemporaryFolder folder;
  const fs::path deep = folder / "a" / "b";
  make_output_folder(deep.string());
  EXPECT_TRUE(fs::is_directory(deep));
  EXPECT_TRUE(fs::is_empty(deep));
}

TEST(AtomicFile, ReportsFilesThatCannotBeWritten) {
  const test::TemporaryFolder folder;
  const std::string file = folder.file("file");
  write_file(file, "x");
  const auto message_of = [](auto&& action) -> std::string {
    try {
      action();
    } catch (const OutputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message_of([&] { make_output_folder(file + "/out"); }),
            "the output folder '" + file + "/out' cannot be written: Not a directory");
  EXPECT_EQ(message_of([&] { write_file(file + "/x", ""); }),
            "the file '" + file + "/x' cannot be written: Not a directory");
  EXPECT_EQ(message_of([&] { check_writable(folder.path().string()); }),
            "the file '" + folder.path().string() + "' cannot be written: Is a directory");
}

TEST(AtomicFile, FullDeviceIsAnErrorAndStaysADevice) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THROW(write_file("/dev/full", "x"), OutputError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, CheckLeavesAnExistingFileAlone) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("bench.json");
  write_file(path, "kept");
  check_writable(path);
  EXPECT_EQ(folder.read("bench.json"), "kept");
}

TEST(AtomicFile, FileNamesFromUserText) {
  EXPECT_EQ(file_name_from("iltis"), "iltis");
  EXPECT_EQ(file_name_from("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(file_name_from(".."), "_.");
  EXPECT_EQ(file_name_from("my model"), "my_model");
  EXPECT_EQ(file_name_from(""), "model");
}

}  // namespace
}  // namespace floatframe

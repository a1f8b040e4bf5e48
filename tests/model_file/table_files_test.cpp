// Tables from CSV files: motions, laws and roads equal those of the same numbers in the model file;
// errors have the place in the CSV file; sweeps and caches know that it was read.
#include <gtest/gtest.h>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

class TableFiles : public testing::Test {
 protected:
  ModelDescription read(const std::string& motion, const std::string& spring,
                        const std::string& road, ModelFingerprint* used = nullptr) {
    folder_.write(
        "model.yaml",
        "floatframe: 1\n"
        "bodies: {a: {rigid: {mass: 1, inertia: [1, 1, 1]}, position: [0, 0, 0]}}\n"
        "joints: {j: {type: prismatic, child: a, at: [0, 0, 0], axis: z, motion: {table: " +
            motion +
            "}}}\n"
            "forces:\n  s: {type: spring_damper, from: {body: ground, at: [0, 0, 1]}, to: {body: "
            "a}, spring: {table: " +
            spring + ", interpolation: cubic}}\nroads: {r: {profile: " + road + "}}\n");
    return read_model(folder_.file("model.yaml"), {}, used);
  }
  std::string errors(const std::string& table) {
    folder_.write("t.csv", table);
    return error_of_motion("t.csv");
  }
  std::string error_of_motion(const std::string& name) {
    return folder_.without(test::error_of([&] { read(name, "[[0, 0], [1, 1]]", "[[0, 0]]"); }));
  }

  test::TemporaryFolder folder_;
};

TEST_F(TableFiles, GiveWhatTheSameNumbersInTheModelFileGive) {
  folder_.write("data/motion.csv",
                "\xEF\xBB\xBF# a ramp\ntime [s],z [m]\n0,0\n0.5, 0.25 # half\n\n1,1e0\r\n2,-1\n");
  folder_.write("data/spring.csv", "0.5;-100\n1;0\n1.5;200\n");
  folder_.write("data/road.csv", "x z\n0 0\n 1\t0\n1   0.1\n4 0.1");
  const ModelDescription from_files = read("data/motion.csv", "data/spring.csv", "data/road.csv");
  const ModelDescription written =
      read("[[0, 0], [0.5, 0.25], [1, 1], [2, -1]]", "[[0.5, -100], [1, 0], [1.5, 200]]",
           "[[0, 0], [1, 0], [1, 0.1], [4, 0.1]]");
  const auto& a = std::get<SpringDamper>(from_files.forces[0].kind).spring;
  const auto& b = std::get<SpringDamper>(written.forces[0].kind).spring;
  for (double x = -1.0; x < 5.0; x += 0.0625) {
    EXPECT_EQ(from_files.joints[0].motion->pieces(x).f, written.joints[0].motion->pieces(x).f) << x;
    EXPECT_EQ(a(x).f, b(x).f) << x;
    EXPECT_EQ(from_files.roads[0].pieces(x).f, written.roads[0].pieces(x).f) << x;
  }
  EXPECT_EQ(a(1.5).f, 200.0);
  EXPECT_EQ(from_files.roads[0].pieces(2.0).f, 0.1);
}

TEST_F(TableFiles, AreAmongTheFilesOfTheFingerprint) {
  folder_.write("t.csv", "0,0\n1,1\n");
  ModelFingerprint before, after;
  read("t.csv", "t.csv", "t.csv", &before);
  EXPECT_EQ(before.files.at(folder_.file("t.csv")), content_hash("0,0\n1,1\n"));
  folder_.write("t.csv", "0,0\n1,2\n");
  read("t.csv", "t.csv", "t.csv", &after);
  EXPECT_NE(before.files.at(folder_.file("t.csv")), after.files.at(folder_.file("t.csv")));
}

TEST_F(TableFiles, ErrorsHaveAPlace) {
  EXPECT_EQ(errors("t,f\n0,0\n1,x\n"), "t.csv:3:1: out_of_range");
  EXPECT_EQ(errors("t,f\nu,v\nw,x\n0,0\n1,1\n"), "t.csv:3:1: out_of_range");
  EXPECT_EQ(errors("0,0\n1,nan\n"), "t.csv:2:1: out_of_range");
  EXPECT_EQ(errors("0,0,0\n1,1,1\n"), "model.yaml:3:81: joints.j.motion.table: wrong_count");
  EXPECT_EQ(errors("t,1\n1,1\n2,2\n"), "t.csv:1:1: out_of_range");
  EXPECT_EQ(errors("0,0\n2,1\n\n1,1\n"), "t.csv:4:1: wrong_value");
  EXPECT_EQ(errors("# nothing\nt,f\n0,0\n"), "model.yaml:3:81: joints.j.motion.table: wrong_count");
  EXPECT_EQ(errors(""), "model.yaml:3:81: joints.j.motion.table: wrong_count");
}

TEST_F(TableFiles, OnlyFilesThatAreThereAndRegular) {
  std::filesystem::create_directory(folder_ / "data");
  EXPECT_EQ(error_of_motion("missing.csv"), "model.yaml:3:81: unreadable");
  EXPECT_EQ(error_of_motion("data"), "model.yaml:3:81: unreadable");
  EXPECT_EQ(error_of_motion("/dev/zero"), "model.yaml:3:81: unreadable");
  EXPECT_EQ(error_of_motion("3"), "model.yaml:3:81: joints.j.motion.table: wrong_value");
  EXPECT_EQ(error_of_motion("{a: 1}"),
            "model.yaml:3:74: joints.j.motion.table: missing\nmodel.yaml:3:82: "
            "joints.j.motion.table.a: unknown_key");
}

TEST_F(TableFiles, BelongToTheFolderOfTheSubsystem) {
  folder_.write("data/t.csv", "0,0\n1,1\n");
  folder_.write("data/part.yaml",
                "floatframe: 1\nparameters: {file: t}\n"
                "bodies: {a: {rigid: {mass: 1, inertia: [1, 1, 1]}, position: [0, 0, 0]}}\n"
                "joints: {j: {type: prismatic, child: a, at: [0, 0, 0], axis: z, motion: {table: "
                "\"${file}.csv\"}}}\n");
  folder_.write("model.yaml", "floatframe: 1\nsubsystems: {s: {file: data/part.yaml}}\n");
  const ModelDescription d = read_model(folder_.file("model.yaml"));
  EXPECT_EQ(d.joints[0].motion->pieces(0.5).f, 0.5);
}

}  // namespace
}  // namespace floatframe

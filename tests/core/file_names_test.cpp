// Names of files: folders of models, temporary files, places behind links.
#include <gtest/gtest.h>

#include <filesystem>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/growing_file.hpp"
#include "floatframe/core/output_place.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

TEST(FileName, LettersOfAnyScriptStay) {
  for (const char* name : {"車両", "мост", "Fahrgestell_ä", "τροχός", "a.b-c"})
    EXPECT_EQ(file_name_from(name), name);
  EXPECT_EQ(file_name_from("a b/c:d"), "a_b_c_d");
  EXPECT_EQ(file_name_from(""), "model");
  EXPECT_EQ(file_name_from("..x"), "_.x");
}

TEST(FileName, InvisibleOrBinaryNamesAreRefused) {
  // No-break space, zero width space, right-to-left override, byte order mark, private use.
  for (const char* hidden : {"\u00a0", "\u200b", "\u202e", "\ufeff", "\ue000", "\u3000"})
    EXPECT_EQ(file_name_from("a" + std::string(hidden) + "b"), "a_b");
  EXPECT_EQ(file_name_from("a\xff\x80z"), "a__z");
  EXPECT_EQ(file_name_from("a\x01\x7f"), "a__");
}

TEST(TemporaryName, IsOneOfTheProgramsOwn) {
  for (const char* name : {"results.csv.part-12-0", "x.part-1-2"})
    EXPECT_TRUE(is_temporary_name(name)) << name;
  for (const char* name : {"results.csv.part-mine", "x.part-", "x.part-1", "x.part-1-", "x.part--1",
                           "x.part-1-2-3", "x.part-1-2.bak", "results.csv"})
    EXPECT_FALSE(is_temporary_name(name)) << name;
}

TEST(OutputPlace, IsBehindAllLinks) {
  const TemporaryFolder folder;
  const std::filesystem::path at = folder.path();
  std::filesystem::create_directory(at / "far");
  std::filesystem::create_symlink("far/file", at / "near");
  std::filesystem::create_symlink(at / "near", at / "nearer");
  const OutputPlace place = output_place((at / "nearer").string());
  EXPECT_EQ(std::filesystem::path(place.path).lexically_normal(), at / "far/file");
  EXPECT_FALSE(place.is_open);
  write_file((at / "nearer").string(), "content");
  EXPECT_TRUE(std::filesystem::is_symlink(at / "near"));
  EXPECT_EQ(std::filesystem::file_size(at / "far/file"), 7u);
  {
    GrowingFile grown((at / "near").string());
    grown.append("line\n");
  }
  EXPECT_TRUE(std::filesystem::is_symlink(at / "near"));
  EXPECT_EQ(std::filesystem::file_size(at / "far/file"), 5u);
  remove_file((at / "nearer").string());
  EXPECT_TRUE(std::filesystem::is_symlink(at / "nearer"));
  EXPECT_FALSE(std::filesystem::exists(at / "far/file"));
  std::filesystem::create_symlink("round", at / "round");
  EXPECT_THROW(output_place((at / "round").string()), OutputError);
}

TEST(OutputPlace, OpenFilesAreNotReplaced) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/stdout", folder.path() / "link");
  for (const std::string& name :
       {std::string("/dev/stdout"), std::string("/dev/fd/1"), std::string("/proc/self/fd/1"),
        (folder.path() / "link").string()}) {
    const OutputPlace place = output_place(name);
    EXPECT_TRUE(place.is_open) << name;
    EXPECT_EQ(place.descriptor, 1) << name;
    EXPECT_FALSE(is_replaceable(name)) << name;
  }
  EXPECT_EQ(output_place("/dev/stderr").descriptor, 2);
  EXPECT_FALSE(is_replaceable("/dev/null"));
  EXPECT_TRUE(is_replaceable((folder.path() / "new").string()));
  EXPECT_THROW(GrowingFile((folder.path() / "link").string()), OutputError);
}

}  // namespace
}  // namespace floatframe::test

// A file that grows by whole lines, and the lock of a folder.
#include "floatframe/core/growing_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "floatframe/core/folder_lock.hpp"
#include "floatframe/core/output_error.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

TEST(GrowingFile, ReplacesAndGrows) {
  const TemporaryFolder folder;
  const std::string path = folder.write("x.csv", "earlier\n");
  std::filesystem::create_hard_link(path, folder / "kept.csv");
  GrowingFile file(path);
  EXPECT_EQ(folder.read("x.csv"), "");
  file.append("a\n");
  EXPECT_EQ(folder.read("x.csv"), "a\n");
  file.append("b\nc\n");
  file.to_disk();
  EXPECT_EQ(folder.read("x.csv"), "a\nb\nc\n");
  EXPECT_EQ(file.bytes(), 6u);
  EXPECT_EQ(folder.read("kept.csv"), "earlier\n") << "whoever has the earlier file keeps it";
}

TEST(GrowingFile, IsContinuedFromAPosition) {
  const TemporaryFolder folder;
  const std::string path = folder.file("x.csv");
  GrowingFile::Position position;
  {
    GrowingFile file(path, true);
    file.append("first\n");
    file.append("second\n");
    position = file.position();
    file.append("third\n");
  }
  {
    GrowingFile file(path, position);
    EXPECT_EQ(folder.read("x.csv"), "first\nsecond\n");
    file.append("other\n");
    position = file.position();
  }
  EXPECT_EQ(folder.read("x.csv"), "first\nsecond\nother\n");
  const auto refused = [&] {
    return folder.without(error_of([&] { GrowingFile(path, position); }));
  };
  EXPECT_EQ(refused(), "no error");
  const auto looked_at = [&] {
    return folder.without(error_of([&] { GrowingFile::require(path, position); }));
  };
  folder.write("x.csv", "first\nsecond\nother\nmore\n");
  EXPECT_EQ(looked_at(), "no error");
  EXPECT_EQ(folder.read("x.csv"), "first\nsecond\nother\nmore\n") << "it is only looked at";
  folder.write("x.csv", "first\nsecond\n");
  EXPECT_EQ(looked_at(), refused());
  EXPECT_EQ(refused(), "damaged");
  folder.write("x.csv", "first\nSecond\nother\n");
  EXPECT_EQ(refused(), "damaged");
  EXPECT_EQ(folder.read("x.csv"), "first\nSecond\nother\n") << "nothing is cut off";
  std::filesystem::remove(path);
  EXPECT_EQ(refused(), "unreadable");
}

TEST(GrowingFile, AtALimitABlockIsKeptWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string path = folder.file("x.bin");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 10;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  {
    GrowingFile file(path);
    file.append_whole("abc\n");
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(file.append_whole("de\nfghi\nj\n"), OutputError);
    EXPECT_EQ(file.bytes(), 4u);
    file.append_whole("defghi");
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(folder.read("x.bin"), "abc\ndefghi");
}

TEST(GrowingFile, AtALimitWholeLinesAreKept) {
  const TemporaryFolder folder;
  const std::string path = folder.file("x.csv");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 10;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  {
    GrowingFile file(path);
    file.append("abc\n");
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string error;
    try {
      file.append("de\nfghi\nj\n");
    } catch (const OutputError& e) {
      error = e.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(folder.without(error), "the file 'x.csv' cannot be written: File too large");
    EXPECT_EQ(file.bytes(), 7u);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(folder.read("x.csv"), "abc\nde\n");
}

TEST(FolderLock, IsHeldByOneAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto refused = [&] {
    return folder.without(error_of([&] { FolderLock(folder.path().string()); }));
  };
  {
    const FolderLock lock(folder.path().string());
    EXPECT_EQ(refused(), "in_use") << refused();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_EQ(refused(), "no error");
  // What a process that was killed has left means nothing.
  folder.write(FolderLock::file_name, "1\n");
  EXPECT_EQ(refused(), "no error");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// A link, or a file of somebody else, keeps what it holds.
TEST(FolderLock, WritesIntoNothingButItsOwnFiles) {
  const TemporaryFolder folder, other;
  other.write("letter.txt", "dear reader\n");
  const auto letter = other.path() / "letter.txt", lock = folder.path() / FolderLock::file_name;
  const auto refused = [&] {
    return error_of([&] { FolderLock(folder.path().string()); }) == "exists";
  };
  std::filesystem::create_symlink(letter, lock);
  EXPECT_TRUE(refused());
  std::filesystem::remove(lock);
  std::filesystem::create_hard_link(letter, lock);
  EXPECT_TRUE(refused());
  std::filesystem::remove(lock);
  std::filesystem::copy(letter, lock);
  EXPECT_TRUE(refused());
  EXPECT_EQ(folder.read(FolderLock::file_name), "dear reader\n");
  EXPECT_EQ(other.read("letter.txt"), "dear reader\n");
  std::filesystem::remove(lock);
  std::filesystem::create_directory(lock);
  EXPECT_THROW(FolderLock(folder.path().string()), OutputError);
}

}  // namespace
}  // namespace floatframe::test

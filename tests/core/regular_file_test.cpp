// Only regular files below a stated size are read: a pipe would hang, a device fill the memory.
#include "floatframe/core/regular_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

class RegularFile : public ::testing::Test {
 protected:
  static std::string why(const std::filesystem::path& path, std::uint64_t largest = 1000) {
    std::string content = "old";
    const std::string reason = read_regular_file(path, largest, content);
    EXPECT_TRUE(reason.empty() || content.empty());
    return reason;
  }
  test::TemporaryFolder folder_;
};

TEST_F(RegularFile, WholeAndBeginning) {
  const std::string text(
      "one\0two\r\n\xff"
      "three",
      15);
  std::string long_text;
  for (int k = 0; k < 300000; ++k) long_text += std::to_string(k);
  EXPECT_EQ(regular_file(folder_.write("a", text)), text);
  EXPECT_EQ(regular_file(folder_.write("empty", "")), "");
  EXPECT_EQ(regular_file(folder_.write("long", long_text)), long_text);
  std::string content;
  EXPECT_EQ(read_regular_beginning(folder_ / "long", 7, content), "");
  EXPECT_EQ(content, "0123456");
  EXPECT_EQ(read_regular_beginning(folder_ / "a", 4000, content), "");
  EXPECT_EQ(content, text);
  // No size of their own, but regular.
  EXPECT_TRUE(test::contains(regular_file("/proc/self/status"), "Name:"));
}

TEST_F(RegularFile, OtherKindsOfFilesAreRefused) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(why(pipe), "this is not a regular file");
  std::filesystem::create_symlink(pipe, folder_ / "link");
  EXPECT_EQ(why(folder_ / "link"), "this is not a regular file");
  EXPECT_EQ(why("/dev/zero"), "this is not a regular file");
  EXPECT_EQ(why("/dev/null"), "this is not a regular file");
  EXPECT_EQ(why(folder_.path()), "this is a folder, not a file");
  EXPECT_EQ(why(folder_ / "nowhere"), "the file does not exist");
  EXPECT_EQ(why(folder_ / "nowhere" / "file"), "the file does not exist");
  EXPECT_EQ(why(folder_.write("a", "x") + "/b"), "the file does not exist");
  std::filesystem::create_symlink("loop", folder_ / "loop");
  EXPECT_TRUE(test::contains(why(folder_ / "loop"), "the file cannot be opened ("));
  EXPECT_EQ(why((folder_ / "a").string() + std::string("\0b", 2)),
            "the name of the file holds a NUL");
  std::string content;
  EXPECT_EQ(read_regular_beginning(pipe, 2, content), "this is not a regular file");
  EXPECT_EQ(test::error_of([&] { regular_file(pipe); }), pipe.string() + ": unreadable");
}

TEST_F(RegularFile, Size) {
  EXPECT_EQ(why(folder_.write("at", std::string(1000, 'x'))), "");
  EXPECT_EQ(why(folder_.write("above", std::string(1001, 'x'))),
            "the file is larger than 1000 bytes, which is not read");
  // Holes take no space on the disk; nothing of it may be read.
  std::filesystem::resize_file(folder_.write("holes", ""), std::uintmax_t{1} << 43);
  EXPECT_EQ(why(folder_ / "holes", 16 << 20), "the file is larger than 16 MiB, which is not read");
  EXPECT_EQ(why(folder_ / "holes", largest_file_read),
            "the file is larger than 4 GiB, which is not read");
  // A file of /proc tells no size, so it is found while reading.
  EXPECT_EQ(why("/proc/self/status", 10), "the file is larger than 10 bytes, which is not read");
}

}  // namespace
}  // namespace floatframe

#pragma once
// The only way in for the files of a user: regular files below a stated size, so that a pipe does
// not hang the program and a device does not fill the memory. The file is opened before it is
// looked at; what a name stands for may change between two calls.
#include <cstdint>
#include <filesystem>
#include <string>

namespace floatframe {

/// No file is read that is larger; formats with less to hold have lower limits of their own.
inline constexpr std::uint64_t largest_file_read = std::uint64_t{4} << 30;  ///< [byte]

/// Reads the whole file into `content`. Empty if that went well, else the reason in words that
/// follow the name of the file: "the file does not exist", "this is a folder, not a file", "this is
/// not a regular file", "the file is larger than 16 MiB, which is not read", ...; `content` is then
/// empty.
std::string read_regular_file(const std::filesystem::path& file, std::uint64_t largest,
                              std::string& content);

/// The same for the first `bytes` at most, of a file of any size.
std::string read_regular_beginning(const std::filesystem::path& file, std::size_t bytes,
                                   std::string& content);

/// The whole file; throws InputError that names it.
std::string regular_file(const std::filesystem::path& file,
                         std::uint64_t largest = largest_file_read);

}  // namespace floatframe

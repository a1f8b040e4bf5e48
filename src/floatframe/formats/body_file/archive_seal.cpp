#include "floatframe/formats/body_file/archive_seal.hpp"

#include "floatframe/core/content_hash.hpp"

namespace floatframe {
namespace {

// The end of an archive: the length of its comment as two bytes, then the comment.
constexpr std::string_view plain_comment = "Written by Floatframe";
constexpr std::string_view seal_begin = "Sealed ";
constexpr std::size_t seal_hash_size = 32, length_size = 2;
constexpr std::size_t sealed_size = seal_begin.size() + seal_hash_size + 1 + plain_comment.size();

std::string seal_of(std::string_view content) {
  std::string comment(seal_begin);
  comment += content_hash(content);
  comment += ' ';
  comment += plain_comment;
  std::string end{static_cast<char>(sealed_size), '\0'};
  return end + comment;
}

}  // namespace

std::string sealed_archive(std::string archive) {
  if (!archive.ends_with(plain_comment)) return archive;
  archive.resize(archive.size() - plain_comment.size() - length_size);
  return archive + seal_of(archive);
}

bool is_sealed_archive(std::string_view archive) {
  constexpr std::size_t end = length_size + sealed_size;
  if (archive.size() < end) return false;
  const std::string_view content = archive.substr(0, archive.size() - end);
  return archive.substr(content.size()) == seal_of(content);
}

}  // namespace floatframe

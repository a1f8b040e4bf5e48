// Layout (all numbers little-endian): for each member a local header, its name and its bytes; then
// the directory with one entry per member; then the end record with the offset of the directory.
#include "floatframe/formats/body_file/zip_store.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <set>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/body_file/archive_seal.hpp"

namespace floatframe {
namespace {

/// Identifies a file of this program.
constexpr std::string_view archive_comment = "Written by Floatframe";
constexpr std::uint32_t local_mark = 0x04034b50, entry_mark = 0x02014b50, end_mark = 0x06054b50;
constexpr std::size_t local_size = 30, entry_size = 46, end_size = 22;
constexpr std::uint16_t needed_version = 20, first_january_1980 = 0x21, utf8_names = 0x0800;
constexpr std::size_t largest = std::numeric_limits<std::uint32_t>::max();

/// A number in so many bytes.
struct ZipField {
  int bytes;
  std::size_t value;
};
void put(std::string& out, std::initializer_list<ZipField> fields) {
  for (const auto& [bytes, value] : fields)
    for (int k = 0; k < bytes; ++k) out += static_cast<char>((value >> 8 * k) & 0xff);
}

std::uint32_t crc_of(std::string_view bytes) {
  uLong crc = crc32(0L, Z_NULL, 0);
  while (!bytes.empty()) {  // zlib counts in 32 bits
    const std::size_t piece = std::min(bytes.size(), std::size_t{1} << 30);
    crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(piece));
    bytes.remove_prefix(piece);
  }
  return static_cast<std::uint32_t>(crc);
}

/// The content by Deflate without the frame of zlib; empty if that is not smaller.
std::string deflated(std::string_view content) {
  // zlib counts in 32 bits, and a bound may be a little larger than the content.
  if (content.empty() || content.size() > largest / 2) return "";
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    return "";
  std::string out(deflateBound(&stream, content.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const bool done = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  out.resize(done && stream.total_out < content.size() ? stream.total_out : 0);
  deflateEnd(&stream);
  return out;
}

/// The common part of the local header and the directory entry: version to checksum, sizes, name.
/// `packed`: the compressed content, or empty.
void put_common(std::string& out, const ZipMember& m, const std::string& packed,
                std::uint32_t crc) {
  constexpr std::size_t midnight = 0, extra_field = 0;
  put(out, {{2, needed_version},
            {2, utf8_names},
            {2, packed.empty() ? std::size_t{0} : std::size_t{Z_DEFLATED}},
            {2, midnight},
            {2, first_january_1980},
            {4, crc},
            {4, packed.empty() ? m.content.size() : packed.size()},
            {4, m.content.size()},
            {2, m.name.size()},
            {2, extra_field}});
}

class ArchiveReader {
 public:
  ArchiveReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  std::vector<ZipMember> read() {
    if (bytes_.size() < 4 || (u32(0) != local_mark && u32(0) != end_mark))
      fail(ErrorCode::wrong_file, "this is not a zip archive (it does not begin with PK)");
    const std::size_t end = find_end();
    const std::size_t count = u16(end + 10), size = u32(end + 12), start = u32(end + 16);
    if (u16(end + 4) != 0 || u16(end + 8) != count)
      fail(ErrorCode::unsupported, "the archive has several volumes, expected one file");
    if (count == 0xffff || start == largest || size == largest)
      fail(ErrorCode::unsupported,
           "the archive is a zip64 archive, expected less than 4 GB and 65535 members");
    if (start > end || size > end - start || start + size != end)
      fail(ErrorCode::damaged,
           "the directory of the archive is damaged: found {} bytes at {} of it, expected them to "
           "end at {}",
           size, start, end);
    std::vector<ZipMember> out;
    std::set<std::string> names;
    std::size_t at = start;
    for (std::size_t k = 0; k < count; ++k) {
      out.push_back(member(at, end));
      if (!names.insert(out.back().name).second)
        fail(ErrorCode::duplicate, "member '{}': found twice, expected once", out.back().name);
    }
    if (at != end)
      fail(ErrorCode::contradiction,
           "the directory of the archive is longer than its number of members");
    return out;
  }

 private:
  template <class... Args>
  [[noreturn]] void fail(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(code, SourceMark{file_, 0, 0}, fmt::format(text, std::forward<Args>(args)...));
  }
  std::size_t u16(std::size_t at) const {
    return static_cast<unsigned char>(bytes_[at]) |
           static_cast<std::size_t>(static_cast<unsigned char>(bytes_[at + 1])) << 8;
  }
  std::size_t u32(std::size_t at) const { return u16(at) | u16(at + 2) << 16; }

  /// The last end record whose comment reaches to the end of the file.
  std::size_t find_end() const {
    if (bytes_.size() >= end_size) {
      const std::size_t last = bytes_.size() - end_size;
      const std::size_t first = last > 0xffff ? last - 0xffff : 0;
      for (std::size_t at = last + 1; at-- > first;)
        if (u32(at) == end_mark && at + end_size + u16(at + 20) == bytes_.size()) return at;
    }
    fail(ErrorCode::damaged, "the archive has no directory at its end: it is truncated or damaged");
  }

  /// The member whose directory entry is at `at`, which moves to the next one.
  ZipMember member(std::size_t& at, std::size_t end) const {
    if (end - at < entry_size || u32(at) != entry_mark)
      fail(ErrorCode::damaged,
           "the directory of the archive is damaged: an entry is missing or cut off");
    const std::size_t flags = u16(at + 8), method = u16(at + 10), crc = u32(at + 16);
    const std::size_t packed = u32(at + 20), size = u32(at + 24), name_size = u16(at + 28);
    const std::size_t rest = name_size + u16(at + 30) + u16(at + 32), local = u32(at + 42);
    if (end - at - entry_size < rest)
      fail(ErrorCode::damaged,
           "the directory of the archive is damaged: the name of a member is cut off");
    ZipMember m;
    m.name = std::string(bytes_.substr(at + entry_size, name_size));
    at += entry_size + rest;
    const std::string who = "member '" + m.name + "': ";
    if (flags & 1u) fail(ErrorCode::unsupported, "{}is encrypted, expected plain bytes", who);
    if (method != 0)
      fail(ErrorCode::unsupported, "{}is compressed (method {}), expected a stored member", who,
           method);
    if (packed != size)
      fail(ErrorCode::damaged, "{}found {} stored bytes for a size of {}, expected as many", who,
           packed, size);
    if (local > end || end - local < local_size || u32(local) != local_mark)
      fail(ErrorCode::damaged, "{}found no header at byte {}, expected one", who, local);
    const std::size_t data = local + local_size + u16(local + 26) + u16(local + 28);
    if (u16(local + 26) != name_size || bytes_.substr(local + local_size, name_size) != m.name)
      fail(ErrorCode::damaged, "{}found another name in its own header, expected the same", who);
    if (data > end || size > end - data)
      fail(ErrorCode::damaged, "{}found {} bytes of {}: it is truncated", who,
           data > end ? 0 : end - data, size);
    m.content = bytes_.substr(data, size);
    const std::uint32_t found = crc_of(m.content);
    if (found != crc)
      fail(ErrorCode::damaged,
           "{}found the checksum {:08x}, expected {:08x}: its bytes were changed", who, found, crc);
    return m;
  }

  std::string_view bytes_;
  const std::string& file_;
};

// The end of a sealed archive: the length of its comment as two bytes, then the comment.
constexpr std::string_view seal_begin = "Sealed ";
constexpr std::size_t seal_hash_size = 32, length_size = 2;
constexpr std::size_t sealed_size = seal_begin.size() + seal_hash_size + 1 + archive_comment.size();

std::string seal_of(std::string_view content) {
  std::string comment(seal_begin);
  comment += content_hash(content);
  comment += ' ';
  comment += archive_comment;
  std::string end{static_cast<char>(sealed_size), '\0'};
  return end + comment;
}

}  // namespace

std::string zip_archive(const std::vector<ZipMember>& members) {
  std::string out, directory;
  std::size_t total = end_size + archive_comment.size();
  for (const ZipMember& m : members)
    total += local_size + entry_size + 2 * m.name.size() + m.content.size();
  if (total > largest || members.size() >= 0xffff)
    throw InputError(ErrorCode::too_large,
                     fmt::format("the archive would have {} bytes, expected less than 4 GB: keep "
                                 "fewer modes, or leave the projection data out",
                                 total));
  out.reserve(total);
  for (const ZipMember& m : members) {
    const std::uint32_t crc = crc_of(m.content);
    const std::string packed = m.compressed ? deflated(m.content) : "";
    const std::size_t place = out.size();
    put(out, {{4, local_mark}});
    put_common(out, m, packed, crc);
    out += m.name;
    out += packed.empty() ? m.content : packed;
    put(directory, {{4, entry_mark}, {2, needed_version}});
    put_common(directory, m, packed, crc);
    // No comment, the first volume, no attributes.
    put(directory, {{2, 0}, {2, 0}, {2, 0}, {4, 0}, {4, place}});
    directory += m.name;
  }
  const std::size_t start = out.size();
  out += directory;
  put(out, {{4, end_mark},
            {2, 0},
            {2, 0},
            {2, members.size()},
            {2, members.size()},
            {4, directory.size()},
            {4, start},
            {2, archive_comment.size()}});
  out += archive_comment;
  return out;
}

std::vector<ZipMember> read_zip(std::string_view bytes, const std::string& file) {
  return ArchiveReader(bytes, file).read();
}

std::string sealed_archive(std::string archive) {
  if (!archive.ends_with(archive_comment)) return archive;
  archive.resize(archive.size() - archive_comment.size() - length_size);
  return archive + seal_of(archive);
}

bool is_sealed_archive(std::string_view archive) {
  constexpr std::size_t end = length_size + sealed_size;
  if (archive.size() < end) return false;
  const std::string_view content = archive.substr(0, archive.size() - end);
  return archive.substr(content.size()) == seal_of(content);
}

}  // namespace floatframe

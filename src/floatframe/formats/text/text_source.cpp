#include "floatframe/formats/text/text_source.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <system_error>

#include "floatframe/core/regular_file.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::size_t deepest_include = 32;
constexpr std::size_t most_includes = 10000;  // a file that includes another ten times, and so on
constexpr std::uint64_t compression_matters_from = std::uint64_t{64} << 20;

bool is_gzip(std::string_view bytes) noexcept {
  return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

/// An inflating stream that is closed in any case.
struct Inflater {
  z_stream stream{};
  Inflater() {
    // 16: gzip with header and checksum.
    if (inflateInit2(&stream, 15 + 16) != Z_OK)
      throw InputError(ErrorCode::unavailable, "zlib cannot be started");
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

/// The first `most` bytes of gzip data (all its members). With `whole` the data must be complete
/// and may not hold more than that.
std::string inflate_bytes(std::string_view bytes, const std::string& name, std::uint64_t most,
                          bool whole) {
  Inflater inflater;
  z_stream& z = inflater.stream;
  std::string text;
  if (whole && bytes.size() >= 4) {
    // The last four bytes give the size, which need not be true.
    std::uint64_t size = 0;
    for (std::size_t i = 1; i <= 4; ++i)
      size = size << 8 | static_cast<unsigned char>(bytes[bytes.size() - i]);
    text.reserve(std::min({size + 1, most, std::uint64_t{20} * bytes.size() + 4096}));
  }
  std::string chunk(std::size_t{1} << 18, '\0');
  std::size_t taken = 0;
  for (;;) {
    if (z.avail_in == 0) {
      const std::size_t size = std::min<std::size_t>(bytes.size() - taken, std::size_t{1} << 28);
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
      z.avail_in = static_cast<uInt>(size);
      taken += size;
    }
    z.next_out = reinterpret_cast<Bytef*>(chunk.data());
    z.avail_out = static_cast<uInt>(chunk.size());
    const int status = inflate(&z, Z_NO_FLUSH);
    text.append(chunk.data(), chunk.size() - z.avail_out);
    if (!whole && text.size() >= most) return text.substr(0, most);
    if (text.size() > most)
      throw InputError(
          ErrorCode::unsupported, {name},
          fmt::format("the compressed file holds more than {} GiB, which is not read", most >> 30));
    if (text.size() > compression_matters_from &&
        text.size() / largest_compression > bytes.size()) {
      throw InputError(ErrorCode::unsupported, {name},
                       fmt::format("the file of {} bytes is compressed more than {} times, which "
                                   "no deck is: it is not read",
                                   bytes.size(), largest_compression));
    }
    if (status == Z_STREAM_END) {
      const std::string_view rest = bytes.substr(taken - z.avail_in);  // another member, or filling
      if (!is_gzip(rest)) return text;
      inflateReset(&z);
      continue;
    }
    if (status == Z_BUF_ERROR || (status == Z_OK && z.avail_in == 0 && taken == bytes.size() &&
                                  z.avail_out == chunk.size())) {
      if (!whole) return text;
      throw InputError(ErrorCode::damaged, {name},
                       "the gzip data end too early: the file is truncated");
    }
    if (status != Z_OK) {
      if (!whole) return text;
      throw InputError(ErrorCode::damaged, {name},
                       fmt::format("the gzip data are damaged ({})",
                                   z.msg != nullptr ? z.msg : "no reason given"));
    }
  }
}

int line_of(std::string_view text, std::size_t position) {
  return 1 + static_cast<int>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

}  // namespace

std::string decompressed(std::string bytes, const std::string& name) {
  if (!is_gzip(bytes)) return bytes;
  return inflate_bytes(bytes, name, largest_text, true);
}

std::string read_whole_file(const std::filesystem::path& file) {
  return decompressed(regular_file(file, largest_text), file.string());
}

std::string read_beginning(const std::filesystem::path& file, std::size_t bytes) {
  std::string beginning;
  const std::string why = read_regular_beginning(file, bytes, beginning);
  if (!why.empty()) throw InputError(ErrorCode::unreadable, {file.string()}, why);
  if (!is_gzip(beginning)) return beginning;
  return inflate_bytes(beginning, file.string(), bytes, false);
}

std::string not_text(std::string_view bytes) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    return "the file is text of 16 bits per character (UTF-16); save it as ASCII or UTF-8";
  const std::size_t zero = bytes.find('\0');
  if (zero != std::string_view::npos)
    return fmt::format("the file is binary, not text: byte 0x00 in line {}", line_of(bytes, zero));
  if (bytes.find('\n') == std::string_view::npos && bytes.find('\r') != std::string_view::npos)
    return "its lines end with a carriage return alone, expected a line feed (LF or CRLF)";
  // Control characters that no text has, and few of them are already too many.
  const std::string_view head = bytes.substr(0, 65536);
  const auto control = [](char c) {
    return static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\r' && c != '\t' && c != '\f' &&
           c != '\v' && c != '\x1a';
  };
  const std::ptrdiff_t count = std::count_if(head.begin(), head.end(), control);
  if (count == 0 || static_cast<std::size_t>(count) * 200 < head.size()) return {};
  const auto first = std::find_if(head.begin(), head.end(), control);
  return fmt::format("the file is binary, not text: byte 0x{:02x} in line {}",
                     static_cast<unsigned>(static_cast<unsigned char>(*first)),
                     line_of(head, first - head.begin()));
}

TextSource::TextSource(const std::filesystem::path& file)
    : TextSource(read_whole_file(file), file.string(), read_whole_file) {
  std::error_code error;
  const auto canonical = std::filesystem::weakly_canonical(file, error);
  if (!error) keys_.front() = canonical.string();
}

TextSource::TextSource(std::string text, std::string name, FileLoader loader)
    : loader_(std::move(loader)) {
  const int file = add_file(std::move(name), std::move(text));
  open(file);
}

int TextSource::add_file(std::string name, std::string text) {
  const std::string error = not_text(text);
  if (!error.empty()) throw InputError(ErrorCode::unreadable, {name}, error);
  keys_.push_back(name);
  names_.push_back(std::move(name));
  texts_.push_back(std::make_unique<const std::string>(std::move(text)));
  return static_cast<int>(names_.size()) - 1;
}

void TextSource::open(int file) {
  const std::string& text = *texts_[file];
  const std::size_t mark_of_utf8 = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  stack_.push_back({file, text.data() + mark_of_utf8, 0});
  expanded_ += text.size() + 1;
}

bool TextSource::next(std::string_view& line) {
  if (again_) {
    again_ = false;
    std::swap(here_, before_);
    line = line_;
    return true;
  }
  while (!stack_.empty()) {
    Open& top = stack_.back();
    const std::string& text = *texts_[top.file];
    const char* const end = text.data() + text.size();
    if (top.at == end) {
      if (stack_.size() == 1) return false;  // the place stays on the last line
      stack_.pop_back();
      continue;
    }
    const void* const found = std::memchr(top.at, '\n', end - top.at);
    const char* const stop = found != nullptr ? static_cast<const char*>(found) : end;
    line_ = std::string_view(top.at, stop - top.at);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    top.at = found != nullptr ? stop + 1 : end;
    if (top.line < std::numeric_limits<int>::max()) ++top.line;
    before_ = here_;
    here_ = {top.file, top.line};
    line = line_;
    return true;
  }
  return false;
}

void TextSource::include(std::string_view path, const FeSource& at) {
  include_file(path, at, true);
}

bool TextSource::include_if_there(std::string_view path, const FeSource& at) {
  return include_file(path, at, false);
}

bool TextSource::include_file(std::string_view path, const FeSource& at, bool required) {
  path = trimmed(path);
  if (path.size() >= 2 && (path.front() == '"' || path.front() == '\'') &&
      path.back() == path.front()) {
    path = path.substr(1, path.size() - 2);
  }
  if (path.empty()) stop(ErrorCode::missing, at, "the include names no file");
  std::string target(path);
  std::replace(target.begin(), target.end(), '\\', '/');
  if (!loader_)
    stop(ErrorCode::unreadable, at, "the include file {} cannot be read here", shown(target));

  const auto folder_of = [this](int file) {
    return std::filesystem::path(names_[file]).parent_path();
  };
  std::filesystem::path file;
  bool exists = false;
  for (const std::filesystem::path& folder : {folder_of(at.file), folder_of(0)}) {
    for (const char* ending : {"", ".gz"}) {
      if (exists) continue;
      const std::filesystem::path candidate = (folder / (target + ending)).lexically_normal();
      std::error_code error;
      if (std::filesystem::exists(candidate, error) && !error) {
        exists = true;
        file = candidate;
      }
    }
  }
  if (!exists && !required) return false;
  if (!exists) {
    const std::string where = folder_of(at.file).string();
    stop(ErrorCode::not_found, at, "the include file {} does not exist in {}", shown(target),
         where.empty() ? "the folder of this file" : shown(where));
  }
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(file, error);
  const std::string key = error ? file.string() : canonical.string();
  for (std::size_t k = 0; k < stack_.size(); ++k) {
    if (keys_[stack_[k].file] != key) continue;
    std::string chain;
    for (std::size_t i = k; i < stack_.size(); ++i) chain += names_[stack_[i].file] + " -> ";
    stop(ErrorCode::cycle, at, "circular include: " + chain + names_[stack_[k].file]);
  }
  if (++includes_ > most_includes)
    stop(ErrorCode::too_large, at, "the files include each other more than {} times",
         most_includes);
  if (stack_.size() >= deepest_include)
    stop(ErrorCode::too_large, at, "includes are nested deeper than {}: {} -> ... -> {} -> {}",
         deepest_include, names_.front(), names_[stack_.back().file], file.string());
  const auto known = index_of_key_.find(key);
  int index = 0;
  if (known != index_of_key_.end()) {
    index = known->second;
  } else {
    try {
      index = add_file(file.string(), loader_(file));
    } catch (const InputError& e) {
      stop(ErrorCode::unreadable, at, "the include file {} cannot be read: {}", shown(target),
           e.errors().front().message);
    }
    keys_.back() = key;
    index_of_key_.emplace(key, index);
  }
  open(index);
  // A file that includes another twice, which includes another twice, ...
  if (expanded_ > largest_text)
    stop(ErrorCode::too_large, at, "the includes hold more than {} GiB in all", largest_text >> 30);
  return true;
}

SourceMark TextSource::mark(const FeSource& source) const {
  if (source.file < 0 || static_cast<std::size_t>(source.file) >= names_.size()) return {};
  return {names_[source.file], source.line, 0};
}

void TextSource::error(ErrorCode code, const FeSource& at, const std::string& message) {
  errors_.add(code, mark(at), message_text(message));
  if (errors_.size() < most_errors) return;
  errors_.add(ErrorCode::too_large, {}, fmt::format("reading ends after {} errors", most_errors),
              0);
  errors_.throw_if_any();
}

void TextSource::make(std::int64_t count) {
  if (count > 0) made_ += std::min(count, may_make_ + 1);
  if (made_ > may_make_)
    stop(ErrorCode::too_large, here_,
         "the lines that generate, copy or repeat make more than {} nodes, elements and cards; "
         "write the deck with its nodes and elements",
         may_make_);
}

void TextSource::stop(ErrorCode code, const FeSource& at, const std::string& message) {
  errors_.add(code, mark(at), message_text(message));
  errors_.throw_if_any();
  std::abort();  // not reached: there is an error
}

}  // namespace floatframe

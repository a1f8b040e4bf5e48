#include "floatframe/sweep/sweep_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/json_text.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return content_hash(text).substr(0, 16) + ' ' + text;
}

/// Discarded JSON if the line is incomplete.
Json json_of(const std::string& line) {
  Json nothing(Json::value_t::discarded);
  if (line.size() < 18 || line[16] != ' ') return nothing;
  const std::string text = line.substr(17);
  if (content_hash(text).compare(0, 16, line, 0, 16) != 0) return nothing;
  std::string why;
  return read_json(text, why);
}

Json header_of(const SweepIdentity& identity, std::size_t runs, const SweepJournal::Files& files) {
  Json header = {{"floatframe_sweep", 1}, {"runs", runs}};
  Json same = Json::array();
  for (const auto& [what, value] : identity) same.push_back({what, value});
  header["identity"] = same;
  header["files"] = files;
  return header;
}

/// Difference between the study of this first line and the present one; empty if there is none.
std::string difference(const Json& found, const SweepIdentity& identity, std::size_t runs) {
  const Json wanted = header_of(identity, runs, {});
  const Json same = found.contains("identity") ? found.at("identity") : Json::array();
  for (std::size_t k = 0; k < identity.size(); ++k)
    if (!same.is_array() || k >= same.size() || same[k] != wanted["identity"][k])
      return identity[k].first;
  const bool equal = found.contains("runs") && found.at("runs") == wanted["runs"] &&
                     found.at("floatframe_sweep") == wanted["floatframe_sweep"] &&
                     same.size() == identity.size();
  return equal ? "" : "the runs differ";
}

OutputError cannot(const std::string& path, int error) {
  return OutputError(
      fmt::format("the file '{}' cannot be written: {}", path, std::strerror(error)));
}

/// Adds the files listed in a line.
void add_files(const Json& json, SweepJournal::Files& files) {
  if (!json.contains("files") || !json.at("files").is_object()) return;
  for (const auto& [file, hash] : json.at("files").items())
    if (hash.is_string()) files.emplace(file, hash.get<std::string>());
}

/// False if it is not a row.
RangeLimit limit_of(const std::string& name) {
  for (std::size_t k = 0; k < range_limit_names.size(); ++k)
    if (name == range_limit_names[k]) return static_cast<RangeLimit>(k);
  throw Json::other_error::create(0, "unknown limit", nullptr);
}

bool row_of(const Json& json, std::size_t& run, SweepRow& row) {
  if (json.is_discarded() || !json.is_object() || !json.contains("run")) return false;
  try {
    if (!json.at("run").is_number_unsigned()) return false;
    const auto number = json.at("run").get<std::size_t>();
    if (number == 0) return false;
    run = number - 1;
    row = {json.at("status"), json.at("message"), {}};
    for (const Json& field : json.at("fields")) row.fields.emplace_back(field.at(0), field.at(1));
    if (json.contains("warnings"))
      for (const Json& w : json.at("warnings"))
        row.warnings.push_back({limit_of(w.at(0).get<std::string>()), w.at(1)});
  } catch (const Json::exception&) {
    return false;
  }
  return true;
}

InputError another_study(ErrorCode code, const std::string& path, const std::string& difference) {
  return InputError(
      code,
      fmt::format(
          "'{}' holds another study ({}); give another --out to keep it, or --fresh to replace it",
          path, difference));
}

}  // namespace

std::string encode_row(std::size_t run, const SweepRow& row) {
  Json fields = Json::array();
  for (const auto& [title, value] : row.fields) fields.push_back({title, value});
  Json line = {{"run", run + 1},
               {"status", row.status},
               {"message", row.message},
               {"fields", std::move(fields)}};
  for (const RangeWarning& w : row.warnings)
    line["warnings"].push_back({range_limit_names[index_of(w.limit)], w.sentence});
  return line_of(line);
}

bool decode_row(const std::string& text, std::size_t& run, SweepRow& row) {
  return row_of(json_of(text), run, row);
}

SweepJournal::SweepJournal(const std::string& path, const SweepIdentity& identity, std::size_t runs,
                           bool fresh, const Files& files)
    : path_(path), flushed_(std::chrono::steady_clock::now()) {
  const std::string header = line_of(header_of(identity, runs, files));
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) throw cannot(path, errno);
  try {
    // Opening a pipe would block, a device would be read forever.
    struct stat status {};
    if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode))
      throw InputError(ErrorCode::unreadable,
                       fmt::format("'{}' is not a regular file; give another --out", path));
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw InputError(ErrorCode::in_use,
                       fmt::format("'{}' is in use: this study is running already", path));
    if (fresh) create(header);
    load(header, identity, runs);
    agree_on_files(files);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

SweepJournal::~SweepJournal() {
  if (unflushed_) ::fsync(file_);
  ::close(file_);
}

void SweepJournal::create(const std::string& header) {
  if (::ftruncate(file_, 0) != 0) throw cannot(path_, errno);
  write(header);
  flush();
}

void SweepJournal::load(const std::string& header, const SweepIdentity& identity,
                        std::size_t runs) {
  std::string text;
  {
    std::ifstream in(path_, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::size_t end_of_header = text.find('\n');
  if (end_of_header == std::string::npos) {
    // Empty, or a first line cut short by a crash: no run can have been lost. A file with any other
    // beginning belongs to another program.
    if (header.compare(0, text.size(), text) != 0 && json_of(text).is_discarded() &&
        text.size() > 17)
      throw InputError(ErrorCode::mismatch,
                       fmt::format("'{}' is not the journal of a study", path_));
    create(header);
    return add_files(json_of(header), files_);
  }
  const Json found = json_of(text.substr(0, end_of_header));
  if (found.is_discarded() || !found.is_object() || !found.contains("floatframe_sweep"))
    throw InputError(
        ErrorCode::mismatch,
        fmt::format("'{}' is not the journal of a study; give another --out, or --fresh", path_));
  const std::string other = difference(found, identity, runs);
  if (!other.empty()) throw another_study(ErrorCode::mismatch, path_, other);
  add_files(found, files_);
  // Lines: the last one may be incomplete; text after the last line break is dropped.
  const std::size_t whole = text.rfind('\n') + 1;
  for (std::size_t from = end_of_header + 1; from < whole;) {
    const std::size_t to = text.find('\n', from);
    load_line(text.substr(from, to - from), runs);
    from = to + 1;
  }
  if (whole < text.size() && ::ftruncate(file_, static_cast<off_t>(whole)) != 0)
    throw cannot(path_, errno);
}

void SweepJournal::load_line(const std::string& line, std::size_t runs) {
  const Json json = json_of(line);
  if (!json.is_object()) return;
  std::size_t run = 0;
  SweepRow row;
  if (row_of(json, run, row) && run < runs) finished_.insert_or_assign(run, std::move(row));
  add_files(json, files_);
}

void SweepJournal::agree_on_files(const Files& files) {
  Json more = Json::object();
  for (const auto& [file, hash] : files) {
    const auto known = files_.find(file);
    if (known == files_.end())
      more[file] = hash;
    else if (known->second != hash)
      throw another_study(ErrorCode::mismatch, path_,
                          fmt::format("the file '{}' has changed", file));
  }
  if (more.empty()) return;
  write(line_of({{"files", std::move(more)}}));
  flush();
}

void SweepJournal::forget_failed() {
  std::erase_if(finished_, [](const auto& run) { return run.second.status != "completed"; });
}

void SweepJournal::write(const std::string& line) {
  const std::string text = line + '\n';
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file_, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw cannot(path_, errno);
    done += n;
  }
  unflushed_ = true;
}

void SweepJournal::add(const std::string& line) {
  std::size_t run = 0;
  SweepRow row;
  if (!decode_row(line, run, row)) throw OutputError("a finished run arrived incomplete");
  write(line);
  finished_.insert_or_assign(run, std::move(row));
  if (std::chrono::steady_clock::now() - flushed_ > std::chrono::milliseconds(500)) flush();
}

void SweepJournal::flush() {
  if (!unflushed_) return;
  if (::fsync(file_) != 0 && errno != EINVAL) throw cannot(path_, errno);
  unflushed_ = false;
  flushed_ = std::chrono::steady_clock::now();
}

}  // namespace floatframe

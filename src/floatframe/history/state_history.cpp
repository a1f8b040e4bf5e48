#include "floatframe/history/state_history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/history/history_blocks.hpp"

namespace floatframe {

/// The file, its header, and the locations of its rows.
struct StateHistory::Data {
  struct Rows {
    std::uint64_t at = 0, rows = 0, before = 0;  ///< offset, number of rows, rows in earlier blocks
  };
  std::string name, bytes;  ///< `bytes`: of a file in memory
  int file = -1;
  std::uint64_t size = 0;
  HistoryHeader header;
  std::vector<std::uint64_t> arrays;  ///< offsets
  std::vector<Rows> blocks;
  std::uint64_t instants = 0;
  std::string status = "running", message;
  std::vector<std::string> notes;

  Data() = default;
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() {
    if (file >= 0) ::close(file);
  }

  [[noreturn]] void refuse(ErrorCode code, const std::string& what) const {
    throw InputError(code, SourceMark{name, 0, 0}, what);
  }
  void open();
  void read(std::uint64_t at, char* out, std::size_t n) const;
  std::string text(const HistoryBlock& block) const;
  void index();
  void add(const HistoryBlock& block);
  void add_end(const HistoryBlock& block);
  std::uint64_t longest() const;
};

void StateHistory::Data::open() {
  file = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file < 0) refuse(ErrorCode::unreadable, std::strerror(errno));
  struct stat status_of_file {};
  if (::fstat(file, &status_of_file) != 0 || !S_ISREG(status_of_file.st_mode))
    refuse(ErrorCode::wrong_file,
           "this is not a regular file, expected the result file of a run (states.ffr)");
  size = static_cast<std::uint64_t>(status_of_file.st_size);
}

void StateHistory::Data::read(std::uint64_t at, char* out, std::size_t n) const {
  if (file < 0) {
    std::memcpy(out, bytes.data() + at, n);
    return;
  }
  while (n > 0) {
    const ssize_t got = ::pread(file, out, n, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      refuse(ErrorCode::unreadable, std::string("it cannot be read: ") + std::strerror(errno));
    if (got == 0) refuse(ErrorCode::mismatch, "it has become shorter while it was read");
    out += got;
    at += static_cast<std::uint64_t>(got);
    n -= static_cast<std::size_t>(got);
  }
}

std::string StateHistory::Data::text(const HistoryBlock& block) const {
  std::string out(static_cast<std::size_t>(block.length), '\0');
  read(block.at, out.data(), out.size());
  return out;
}

/// Maximum size of the content of the next block.
std::uint64_t StateHistory::Data::longest() const {
  if (arrays.size() < header.arrays.size()) return array_bytes(header.arrays[arrays.size()]);
  return std::max<std::uint64_t>(largest_rows_block, 8 * header.columns);
}

void StateHistory::Data::index() {
  HistoryWalk walk([this](std::uint64_t at, char* out, std::size_t n) { read(at, out, n); }, size,
                   name);
  const auto cut = [&] {
    refuse(ErrorCode::damaged, "it ends within its header: the run was ended at its start");
  };
  HistoryBlock block;
  if (!walk.next(block, largest_history_head)) cut();
  if (block.kind != HistoryBlockKind::head)
    refuse(ErrorCode::damaged, "it does not begin with a header");
  try {
    header = header_from_json(text(block));
  } catch (const InputError& error) {
    refuse(error.errors().front().code, error.errors().front().message);
  }
  while (walk.next(block, longest())) {
    if (status != "running") refuse(ErrorCode::damaged, "there is data after its end");
    add(block);
  }
  if (arrays.size() < header.arrays.size()) cut();
  if (!walk.dropped().empty()) notes.push_back(walk.dropped());
}

void StateHistory::Data::add(const HistoryBlock& block) {
  if (arrays.size() < header.arrays.size()) {
    const HistoryArray& array = header.arrays[arrays.size()];
    if (block.kind != HistoryBlockKind::data || block.length != array_bytes(array))
      refuse(ErrorCode::damaged,
             fmt::format("found a block of {} bytes, expected the array '{}' of {} bytes",
                         block.length, excerpt(array.name), array_bytes(array)));
    arrays.push_back(block.at);
    return;
  }
  if (block.kind == HistoryBlockKind::done) return add_end(block);
  const std::uint64_t row = 8 * header.columns;
  if (block.kind != HistoryBlockKind::rows || block.length == 0 || block.length % row != 0)
    refuse(ErrorCode::wrong_count,
           fmt::format("found a block of {} bytes, expected rows of {} bytes each", block.length,
                       row));
  blocks.push_back({block.at, block.length / row, instants});
  instants += block.length / row;
}

void StateHistory::Data::add_end(const HistoryBlock& block) {
  std::string why;
  const auto end = read_json(text(block), why);
  if (!end.is_object() || !end.contains("status") || !end["status"].is_string() ||
      !end.contains("message") || !end["message"].is_string())
    refuse(ErrorCode::damaged, "its end is not one of a result file");
  status = end["status"].get<std::string>();
  message = end["message"].get<std::string>();
  if (status != "completed" && status != "failed" && status != "interrupted")
    refuse(ErrorCode::wrong_value,
           fmt::format("its end has the status '{}', expected completed, failed or interrupted",
                       excerpt(status)));
}

StateHistory::StateHistory(const std::string& path) : data_(std::make_unique<Data>()) {
  data_->name = path;
  data_->open();
  data_->index();
}

StateHistory::StateHistory(std::unique_ptr<Data> data) : data_(std::move(data)) {}
StateHistory::~StateHistory() = default;
StateHistory::StateHistory(StateHistory&&) noexcept = default;
StateHistory& StateHistory::operator=(StateHistory&&) noexcept = default;

StateHistory StateHistory::of_bytes(std::string bytes, const std::string& name) {
  auto data = std::make_unique<Data>();
  data->name = name;
  data->bytes = std::move(bytes);
  data->size = data->bytes.size();
  data->index();
  return StateHistory(std::move(data));
}

const std::string& StateHistory::name() const noexcept { return data_->name; }
const HistoryHeader& StateHistory::header() const noexcept { return data_->header; }
std::size_t StateHistory::instants() const noexcept { return data_->instants; }
const std::string& StateHistory::status() const noexcept { return data_->status; }
const std::string& StateHistory::message() const noexcept { return data_->message; }
const std::vector<std::string>& StateHistory::notes() const noexcept { return data_->notes; }

void StateHistory::instant(std::size_t k, std::span<double> row) const {
  const std::size_t columns = data_->header.columns;
  if (k >= data_->instants || row.size() != columns)
    data_->refuse(ErrorCode::not_found,
                  fmt::format("found no instant {} with {} numbers, expected one below {} with {}",
                              k, row.size(), data_->instants, columns));
  const auto after =
      std::upper_bound(data_->blocks.begin(), data_->blocks.end(), k,
                       [](std::size_t wanted, const Data::Rows& b) { return wanted < b.before; });
  const Data::Rows& block = *(after - 1);
  data_->read(block.at + 8 * columns * (k - block.before), reinterpret_cast<char*>(row.data()),
              8 * columns);
  for (const double x : row)
    if (!std::isfinite(x))
      data_->refuse(ErrorCode::not_finite,
                    fmt::format("instant {} holds numbers that are not finite", k));
}

std::vector<double> StateHistory::numbers(std::size_t array) const {
  if (array >= data_->arrays.size())
    data_->refuse(ErrorCode::not_found, fmt::format("found no array {}, expected one below {}",
                                                    array, data_->arrays.size()));
  const HistoryArray& a = data_->header.arrays[array];
  const std::string bytes =
      data_->text({HistoryBlockKind::data, data_->arrays[array], array_bytes(a)});
  const std::size_t size = a.type == "f64" ? 8 : 4;
  std::vector<double> out(bytes.size() / size);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const char* at = bytes.data() + i * size;
    const auto as = [&](auto x) {
      std::memcpy(&x, at, sizeof x);
      return static_cast<double>(x);
    };
    out[i] = a.type == "f64" ? as(0.0) : a.type == "f32" ? as(0.0f) : as(std::uint32_t{0});
    if (!std::isfinite(out[i]))
      data_->refuse(
          ErrorCode::not_finite,
          fmt::format("the array '{}' holds numbers that are not finite", excerpt(a.name)));
  }
  return out;
}

std::vector<double> StateHistory::numbers(const std::string& array) const {
  const std::vector<HistoryArray>& arrays = data_->header.arrays;
  for (std::size_t k = 0; k < arrays.size(); ++k)
    if (arrays[k].name == array) return numbers(k);
  return {};
}

}  // namespace floatframe

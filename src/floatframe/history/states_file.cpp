#include "floatframe/history/states_file.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "floatframe/core/build_info.hpp"
#include "floatframe/history/history_blocks.hpp"

namespace floatframe {
namespace {

constexpr std::size_t longest_message = 10'000;

/// Calls `write` with each block before the rows.
template <class Write>
void write_opening(const HistoryContent& content, Write write) {
  write(history_beginning() + history_block(HistoryBlockKind::head, header_json(content.header)));
  for (const std::string& array : content.arrays)
    write(history_block(HistoryBlockKind::data, array));
}

/// The same for whole rows.
template <class Write>
void write_rows(std::span<const double> numbers, std::size_t columns, Write write) {
  const std::size_t rows = std::max<std::size_t>(1, largest_rows_block / (8 * columns));
  while (!numbers.empty()) {
    const auto block = numbers.first(std::min(numbers.size(), rows * columns));
    write(history_block(HistoryBlockKind::rows, {reinterpret_cast<const char*>(block.data()),
                                                 block.size() * sizeof(double)}));
    numbers = numbers.subspan(block.size());
  }
}

std::string ending(const std::string& status, const std::string& message) {
  nlohmann::ordered_json end{{"status", status}, {"message", message.substr(0, longest_message)}};
  return history_block(HistoryBlockKind::done,
                       end.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace

HistoryOrigin history_origin(const std::string& model_file, const std::string& folder) {
  HistoryOrigin o;
  o.program = version();
  o.library = build_description();
  o.model_file = model_file;
  if (model_file.empty()) return o;
  std::error_code ignored;
  o.from_here = std::filesystem::weakly_canonical(model_file, ignored)
                    .lexically_relative(std::filesystem::weakly_canonical(folder, ignored))
                    .string();
  return o;
}

StatesFile::StatesFile(const std::string& path, const HistoryContent& content, bool continuable)
    : columns_(content.header.columns), file_(path, continuable) {
  write_opening(content, [this](const std::string& block) { file_.append_whole(block); });
}

void StatesFile::append(std::span<const double> numbers) {
  write_rows(numbers, columns_, [this](const std::string& block) { file_.append_whole(block); });
}

void StatesFile::finish(const std::string& status, const std::string& message) {
  file_.append_whole(ending(status, message));
}

std::string states_bytes(const HistoryContent& content, std::span<const double> rows,
                         const std::string& status, const std::string& message) {
  std::string bytes;
  const auto write = [&bytes](const std::string& block) { bytes += block; };
  write_opening(content, write);
  write_rows(rows, content.header.columns, write);
  return bytes + ending(status, message);
}

}  // namespace floatframe

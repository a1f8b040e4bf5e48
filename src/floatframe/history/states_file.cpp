#include "floatframe/history/states_file.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "floatframe/core/build_info.hpp"
#include "floatframe/history/history_blocks.hpp"

namespace floatframe {
namespace {

constexpr std::size_t longest_message = 10'000;

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
  file_.append_whole(history_beginning() +
                     history_block(HistoryBlockKind::head, header_json(content.header)));
  for (const std::string& array : content.arrays)
    file_.append_whole(history_block(HistoryBlockKind::data, array));
}

void StatesFile::append(std::span<const double> numbers) {
  const std::size_t rows = std::max<std::size_t>(1, largest_rows_block / (8 * columns_));
  while (!numbers.empty()) {
    const auto block = numbers.first(std::min(numbers.size(), rows * columns_));
    file_.append_whole(history_block(
        HistoryBlockKind::rows,
        {reinterpret_cast<const char*>(block.data()), block.size() * sizeof(double)}));
    numbers = numbers.subspan(block.size());
  }
}

void StatesFile::finish(const std::string& status, const std::string& message) {
  nlohmann::ordered_json end{{"status", status}, {"message", message.substr(0, longest_message)}};
  file_.append_whole(
      history_block(HistoryBlockKind::done,
                    end.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
}

}  // namespace floatframe

#include "floatframe/history/states_file.hpp"

#include <nlohmann/json.hpp>

#include "floatframe/history/history_blocks.hpp"

namespace floatframe {
namespace {

constexpr std::size_t longest_message = 10'000;

}  // namespace

StatesFile::StatesFile(const std::string& path, const HistoryContent& content, bool continuable)
    : file_(path, continuable) {
  file_.append_whole(history_beginning() +
                     history_block(HistoryBlockKind::head, header_json(content.header)));
  for (const std::string& array : content.arrays)
    file_.append_whole(history_block(HistoryBlockKind::data, array));
}

void StatesFile::append(std::span<const double> numbers) {
  if (numbers.empty()) return;
  file_.append_whole(history_block(
      HistoryBlockKind::rows,
      {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)}));
}

void StatesFile::finish(const std::string& status, const std::string& message) {
  nlohmann::ordered_json end{{"status", status}, {"message", message.substr(0, longest_message)}};
  file_.append_whole(
      history_block(HistoryBlockKind::done,
                    end.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
}

}  // namespace floatframe

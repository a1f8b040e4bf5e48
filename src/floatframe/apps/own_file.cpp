#include "floatframe/apps/own_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string_view>

#include "floatframe/core/output_place.hpp"
#include "floatframe/core/regular_file.hpp"

namespace floatframe {
namespace {

constexpr std::size_t own_beginning = 16384;  ///< inspected beginning of a file [byte]
constexpr std::string_view own_mark = "ritten by Floatframe";

bool holds(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

bool holds_all(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::all_of(words.begin(), words.end(),
                     [&](std::string_view w) { return holds(text, w); });
}

/// Recognises a JSON object by its first keys.
bool is_own_json(std::string_view text) {
  return text.starts_with("{") &&
         // A run of a study that could not start.
         (text.starts_with("{\n  \"status\": \"failed\",\n  \"message\": \"") ||
          holds_all(text, {"\"floatframe_state\""}) ||
          holds_all(text, {"\"model\"", "\"coordinates\"", "\"inertia\"", "\"step_s\""}) ||
          holds_all(text, {"\"nodes\"", "\"elements\"", "\"degrees_of_freedom\"", "\"modes\""}) ||
          holds_all(text, {"\"rows\"", "\"coordinates\"", "\"inertia\""}) ||
          holds_all(text, {"\"rows\"", "\"allowed_s\""}) ||
          holds_all(text, {"\"rows\"", "\"us_per_"}));
}

/// Recognises a table by its first titles.
bool is_own_table(std::string_view text) {
  constexpr std::array beginnings{"time [s],",
                                  "run,",
                                  "of,",
                                  "frequency [Hz],",
                                  "speed [rad/s],",
                                  "range [",
                                  "range,",
                                  "range from",
                                  "channel,unit,turning points,",
                                  "body,place,node,",
                                  "body,element,end,node,"};
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const char* b) { return text.starts_with(b); });
}

bool is_journal(std::string_view text) {
  return text.size() > 17 && text.substr(17).starts_with("{\"floatframe_sweep\"");
}

bool is_page(std::string_view text) {
  return (text.starts_with("<!doctype html>") || text.starts_with("<!DOCTYPE html>")) &&
         holds(text.substr(0, 1024), "Floatframe");
}

bool is_picture(std::string_view text) {
  return text.starts_with("<svg") &&
         (holds(text, "aria-label=\"Campbell diagram\"") || holds(text, "class=\"sheet\""));
}

/// Grids and series for ParaView, as this program's writer begins them.
bool is_grid(std::string_view text) {
  return text.starts_with("<?xml version=\"1.0\"?>\n<VTKFile") &&
         (holds(text,
                "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
                "NumberOfTuples=\"1\" format=\"ascii\">") ||
          holds(text, "file=\"motion_0"));
}

/// `ending` of the name: a page is never a table, whatever its content.
bool is_own_text(std::string_view text, const std::string& ending) {
  // A model file contains the program name too.
  if (text.starts_with("floatframe:") || holds(text, "\nfloatframe:")) return false;
  if (ending == ".csv") return is_own_table(text);
  if (ending == ".html") return is_page(text);
  if (text.starts_with("{") || ending == ".json") return is_own_json(text);
  if (ending == ".ffr" || ending == ".checkpoint" || ending == ".ffb" || ending == ".npz" ||
      ending == ".glb" || ending == ".mat" || ending == ".ffm")
    return false;
  return is_own_table(text) || is_journal(text) || is_page(text) || is_picture(text) ||
         is_grid(text) || holds(text, own_mark) || holds(text, " by Floatframe ");
}

bool has_own_comment(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string end(own_mark.size(), '\0');
  in.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  in.read(end.data(), static_cast<std::streamsize>(end.size()));
  return in.good() && end == own_mark;
}

bool is_own_binary(const std::string& path, std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04"))
    return holds(bytes.substr(0, 256), "floatframe body") || has_own_comment(path);
  return bytes.starts_with("floatfr\n") || bytes.starts_with("ffcheck\n") ||
         bytes.starts_with("floatframe-model") ||
         bytes.starts_with("MATLAB 5.0 MAT-file, written by Floatframe") ||
         (bytes.starts_with("glTF") && holds(bytes, "\"generator\":\"Floatframe"));
}

}  // namespace

bool is_own_file(const std::string& path) {
  if (!is_replaceable(path)) return true;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return true;
  std::string beginning;
  if (!read_regular_beginning(path, own_beginning, beginning).empty()) return false;
  return beginning.empty() || is_own_binary(path, beginning) ||
         is_own_text(beginning, std::filesystem::path(path).extension().string());
}

bool is_own_results(const std::string& path) {
  if (!is_own_file(path)) return false;
  std::error_code error;
  if (!std::filesystem::exists(path, error) || !is_replaceable(path)) return true;
  if (std::filesystem::file_size(path, error) == 0) return true;
  for (const char* name : {"summary.json", "states.ffr"}) {
    const std::string sibling = (std::filesystem::path(path).parent_path() / name).string();
    if (std::filesystem::exists(sibling, error) && is_own_file(sibling)) return true;
  }
  // A run of a study that was killed before its summary was written: STUDY/runs/N.
  const std::filesystem::path study =
      std::filesystem::absolute(path, error).parent_path().parent_path().parent_path();
  const std::string journal = (study / "sweep.journal").string();
  return std::filesystem::exists(journal, error) && is_own_file(journal);
}

}  // namespace floatframe

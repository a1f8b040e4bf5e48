#include "floatframe/parts/file_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "floatframe/formats/sid/sid_file.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/parts/body_info.hpp"
#include "floatframe/parts/fe_info.hpp"

namespace floatframe {
namespace {

/// A SID file starts with a number and the block `part`.
bool is_sid(const std::string& file) {
  const std::string text = read_beginning(file, 4096);
  return text.find("part") != std::string::npos && text.find("new modal") != std::string::npos;
}

std::string info(const PartJob& job, bool json) {
  const std::string file = job.file.string();
  std::error_code error;
  if (!std::filesystem::exists(job.file, error))
    throw InputError(ErrorCode::not_found, {file, 0, 0}, "the file does not exist");
  if (!std::filesystem::is_regular_file(job.file, error))
    throw InputError(ErrorCode::wrong_file, {file, 0, 0}, "this is not a regular file");
  if (job.format.empty() && is_body_file(job.file)) {
    const BodyFile content = read_body_file(job.file);
    return json ? body_info_json(file, content) : body_info_text(file, content);
  }
  if (job.format.empty() && is_sid(file)) {
    const SidBody sid = read_sid(job.file);
    return json ? sid_info_json(file, sid.body, sid.notes)
                : sid_info_text(file, sid.body, sid.notes);
  }
  const FeModel model = read_fe_file(job.file, job.read, job.format);
  return json ? fe_info_json(job, model) : fe_info_text(job, model);
}

}  // namespace

std::string file_info_text(const PartJob& job) { return info(job, false); }
std::string file_info_json(const PartJob& job) { return info(job, true); }

std::string hint_of_units(const PartJob& job) {
  std::vector<std::string> likely;
  try {
    likely = likely_units(read_fe_file(job.file, job.read, job.format));
  } catch (const InputError&) {  // its errors are reported once units are given
  }
  return likely.empty() ? ""
                        : fmt::format(" (the material looks like {})", fmt::join(likely, " or "));
}

}  // namespace floatframe

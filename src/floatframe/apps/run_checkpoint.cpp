#include "floatframe/apps/run_checkpoint.hpp"

#include <fmt/format.h>

#include <cstring>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/stepping/state_bytes.hpp"

namespace floatframe {
namespace {

constexpr std::string_view checkpoint_magic = "ffcheck\n";
constexpr std::uint64_t checkpoint_version = 3;
constexpr std::size_t checkpoint_sum_size = 32;

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string list_text(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& s : settings) text += (text.empty() ? "--set " : " --set ") + s;
  return text.empty() ? "none" : "'" + text + "'";
}

template <class Stream, class Checkpoint>
void serialize_file(Stream& s, Checkpoint& c) {
  s(c.origin.program);
  s(c.every);
  s(c.results.file.bytes);
  s(c.results.file.content);
  s(c.results.rows);
  s(c.results.last_time);
  s(c.states.bytes);
  s(c.states.content);
  s(c.run.time);
}

}  // namespace

std::string origin_difference(const RunOrigin& found, const RunOrigin& own) {
  if (found.program != own.program)
    return fmt::format("was made by another copy of the program (found {}, this is {})",
                       found.program, own.program);
  if (found.settings != own.settings)
    return fmt::format("was made with other parameters: found {}, this run has {}",
                       list_text(found.settings), list_text(own.settings));
  for (const auto& [file, hash] : own.files) {
    const auto at = found.files.find(file);
    if (at == found.files.end())
      return fmt::format("was made of another model, which does not read '{}'", file);
    if (at->second != hash) return fmt::format("was made before '{}' was changed", file);
  }
  for (const auto& [file, hash] : found.files)
    if (!own.files.contains(file))
      return fmt::format("was made of another model, which reads '{}'", file);
  return {};
}

std::string checkpoint_bytes(const CheckpointFile& c) {
  StateWriter out;
  out.raw(checkpoint_magic);
  out(checkpoint_version);
  serialize_file(out, c);
  out(static_cast<std::uint64_t>(c.origin.files.size()));
  for (const auto& [file, hash] : c.origin.files) {
    out(file);
    out(hash);
  }
  out(static_cast<std::uint64_t>(c.origin.settings.size()));
  for (const std::string& setting : c.origin.settings) out(setting);
  out(std::string(text_of(c.run.bytes)));
  out.raw(content_hash(text_of(out.bytes)));
  return std::string(text_of(out.bytes));
}

CheckpointFile read_checkpoint(const std::string& path) {
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    throw InputError(code, fmt::format("the checkpoint '{}' {}", path, what));
  };
  std::string text;
  if (const std::string why = read_regular_file(path, largest_file_read, text); !why.empty())
    throw InputError(ErrorCode::mismatch,
                     fmt::format("--resume: '{}': {}; expected a checkpoint of this run, as "
                                 "--checkpoint-every writes it",
                                 path, why));
  const std::size_t head = checkpoint_magic.size() + 8;
  if (!text.starts_with(checkpoint_magic))
    refuse(ErrorCode::mismatch, "is not the checkpoint of a run");
  if (text.size() < head + checkpoint_sum_size)
    refuse(ErrorCode::damaged, "is damaged: it ends too early");
  const std::size_t end = text.size() - checkpoint_sum_size;
  const auto bytes = std::as_bytes(std::span(text));
  std::uint64_t version = 0;
  StateReader(bytes.subspan(checkpoint_magic.size()), "the checkpoint")(version);
  if (version != checkpoint_version)
    refuse(ErrorCode::mismatch, fmt::format("has version {}, this program reads version {}",
                                            version, checkpoint_version));
  if (content_hash(std::string_view(text).substr(0, end)) != text.substr(end))
    refuse(ErrorCode::damaged, "is damaged: its checksum does not fit its content");
  StateReader in(bytes.subspan(head, end - head), "the checkpoint");
  CheckpointFile c;
  serialize_file(in, c);
  std::uint64_t n = 0;
  std::string name, value;
  for (in(n); n > 0; --n) {
    in(name);
    in(value);
    c.origin.files[name] = value;
  }
  for (in(n); n > 0; --n) {
    in(value);
    c.origin.settings.push_back(value);
  }
  in(value);
  const auto run = std::as_bytes(std::span(value));
  c.run.bytes.assign(run.begin(), run.end());
  if (!in.at_end()) refuse(ErrorCode::damaged, "is damaged: there is data after its end");
  return c;
}

}  // namespace floatframe

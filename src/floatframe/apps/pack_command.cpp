// floatframe pack: a model in one file.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/packing.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model_file/pack_model.hpp"

namespace floatframe {
namespace {

struct PackArguments {
  ModelArguments model;
  std::string out, outputs;
  bool small = false, overwrite = false, quiet = false;
};

int pack_file(const PackArguments& a) {
  const std::string out =
      a.out.empty() ? std::filesystem::path(a.model.path).stem().string() + ".ffm" : a.out;
  require_writable({{"-o", out}}, {a.model.path}, a.overwrite);
  std::vector<std::string> fixed;
  const auto contents = a.small ? PackOptions::Contents::steps : PackOptions::Contents::all;
  const PackedModel model = packed_of(a.model, a.outputs, contents, fixed);
  const std::vector<std::byte> bytes = model.to_bytes();
  std::string content(bytes.size(), '\0');
  std::transform(bytes.begin(), bytes.end(), content.begin(),
                 [](std::byte b) { return static_cast<char>(b); });
  write_file(out, content);
  if (a.quiet) return exit_code::done;
  std::vector<std::string> parameters;
  for (const PackedParameter& p : model.parameters()) parameters.push_back(p.name);
  print(fmt::format("{}: {} bytes, fingerprint {}\n  parameters  {}\n", out, bytes.size(),
                    model.fingerprint(),
                    parameters.empty() ? "none" : fmt::format("{}", fmt::join(parameters, ", "))));
  for (const std::string& sentence : fixed) say("note: " + sentence);
  return exit_code::done;
}

}  // namespace

Command pack_command() {
  const auto a = std::make_shared<PackArguments>();
  return {.name = "pack",
          .help = "Write a model, built, as one file that is loaded in milliseconds",
          .options = joined(
              model_options(a->model),
              {text_option("-o,--out", a->out, "FILE",
                           "File to write; default: MODEL.ffm in this folder"),
               text_option("--outputs", a->outputs, "LIST",
                           "Outputs to keep, names with commas between them, 'chassis' for all of "
                           "chassis.x, chassis.y, ...; default: all"),
               flag("--small", a->small,
                    "Leave out what steps and outputs do not use: shapes, stress, nodes"),
               overwrite_option(a->overwrite), flag("--quiet", a->quiet, "No summary, no notes")}),
          .footer =
              "All commands that read a model file read a packed one too, and step it with the "
              "same bits.\nParameters that take a new value without a build may still be --set; "
              "notes say why others\nare not. docs/packed-model.md explains all.\n"
              "Example: floatframe pack examples/iltis/iltis.yaml -o iltis.ffm && floatframe run "
              "iltis.ffm\n"
              "Exit codes: 0 done, 1 the disk is full, 2 bad input; files are written atomically.",
          .run = [a] { return pack_file(*a); }};
}

}  // namespace floatframe

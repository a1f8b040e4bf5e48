// floatframe convert: a finite-element model as a file of another program.

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/part_arguments.hpp"
#include "floatframe/parts/mesh_file.hpp"

namespace floatframe {
namespace {

struct ConvertArguments {
  PartArguments options;
  std::string from, to;
  int modes = 20;
  bool overwrite = false;
};

int convert(const ConvertArguments& a) {
  PartJob job = a.options.job();
  job.file = a.from;
  require_writable({{"OUT", a.to}}, {a.from}, a.overwrite);
  print(save_converted_mesh(job, a.to, a.modes));
  return 0;
}

}  // namespace

Command convert_command() {
  const auto a = std::make_shared<ConvertArguments>();
  return {
      .name = "convert",
      .help = "Write a finite-element model as a CalculiX deck, a Gmsh mesh or a VTU file",
      .options =
          joined({file_position("PART", a->from, "Finite-element file (also .gz)"),
                  file_position("OUT", a->to,
                                "File to write; its ending gives the format: .inp, .msh, .vtu"),
                  whole_option("--modes", a->modes, 0, 100000,
                               "Modes of the vibration step of a deck; 0: no step; default 20"),
                  overwrite_option(a->overwrite)},
                 a->options.table(true)),
      .footer =
          "Mesh, sets, materials, sections, connections and point masses as read, in the units "
          "of the\n"
          "file. Data that the other format does not support is reported; data whose loss would "
          "change\n"
          "the model is an error. Supports are written to a deck as comments.\n"
          "Example: floatframe convert arm.bdf arm.inp && ccx arm\n"
          "Exit codes: 0 done, 2 bad input; files are written atomically.",
      .run = [a] { return convert(*a); }};
}

}  // namespace floatframe

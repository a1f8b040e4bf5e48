#include "floatframe/parts/part_options.hpp"

#include <fmt/format.h>

#include "floatframe/core/text_pieces.hpp"
#include "floatframe/parts/damping_text.hpp"
#include "floatframe/parts/part_text.hpp"
#include "floatframe/reduction/mode_selection.hpp"

namespace floatframe {
namespace {

using O = PartOption;
using Special = O::Special;
using Texts = std::vector<std::string>;

/// An enumerator in a member of the job's options or reading options.
template <auto group, auto member>
O::Word enumerator(std::vector<const char*> words, std::optional<int> unwritten = {},
                   int first = 0) {
  return {std::move(words), first,
          [](const PartJob& job) { return static_cast<int>(job.*group.*member); },
          [](PartJob& job, int k) {
            auto& value = job.*group.*member;
            value = static_cast<std::remove_reference_t<decltype(value)>>(k);
          },
          unwritten};
}

/// An enumerator of the reading options; the default is not shown.
template <auto member>
O::Word reading_word(std::vector<const char*> words) {
  return enumerator<&PartJob::read, member>(std::move(words), 0);
}

O::Word dialect() {
  return enumerator<&PartJob::read, &FeReadOptions::dialect>(
      {word(DeckDialect::abaqus), word(DeckDialect::calculix)},
      static_cast<int>(DeckDialect::by_content), static_cast<int>(DeckDialect::abaqus));
}

/// "ignore", "tied", "tied:DISTANCE"
Special contact() {
  return {
      Special::What::contact,
      [](const PartJob& job) {
        const FeReadOptions& r = job.read;
        if (r.contact == DeckContact::refuse) return Texts();
        if (r.contact == DeckContact::ignore) return Texts{"ignore"};
        return Texts{r.contact_distance > 0.0 ? fmt::format("tied:{}", r.contact_distance)
                                              : "tied"};
      },
      [](PartJob& job, const std::string& text) {
        job.read.contact = text == "ignore" ? DeckContact::ignore : DeckContact::tied;
        if (text == "ignore" || text == "tied") return;
        const auto distance =
            text.starts_with("tied:") ? finite_number(text.substr(5)) : std::nullopt;
        if (!distance || !(*distance > 0.0))
          throw InputError(
              ErrorCode::wrong_value,
              fmt::format("--contact: found '{}', expected ignore, tied or tied:DISTANCE", text));
        job.read.contact_distance = *distance;
      }};
}

Special temperature() {
  return {Special::What::temperature,
          [](const PartJob& job) {
            return job.read.temperature ? Texts{fmt::format("{}", *job.read.temperature)} : Texts();
          },
          [](PartJob& job, const std::string& text) {
            const auto T = finite_number(text);
            if (!T)
              throw InputError(ErrorCode::out_of_range,
                               fmt::format("--temperature: found '{}', expected a number", text));
            job.read.temperature = *T;
          }};
}

Special damping() {
  return {
      Special::What::damping,
      [](const PartJob& job) {
        const std::string text = damping_text(job.options.damping);
        return text.empty() ? Texts() : Texts{text};
      },
      [](PartJob& job, const std::string& text) { job.options.damping = damping_argument(text); }};
}

Special units() {
  return {Special::What::units, [](const PartJob& job) { return Texts{job.units}; },
          [](PartJob& job, const std::string& text) {
            unit_system(text);
            job.units = text;
          }};
}

Special format() {
  return {Special::What::format,
          [](const PartJob& job) { return job.format.empty() ? Texts() : Texts{job.format}; },
          [](PartJob& job, const std::string& text) { job.format = text; }};
}

Special material() {
  return {
      Special::What::material,
      [](const PartJob& job) {
        return job.read.material ? Texts{material_text(*job.read.material)} : Texts();
      },
      [](PartJob& job, const std::string& text) { job.read.material = material_argument(text); }};
}

template <auto member>
Texts named_numbers(const PartJob& job) {
  Texts out;
  for (const auto& [name, number] : job.read.*member)
    out.push_back(named_number_text(name, number));
  return out;
}

void add_once(std::map<std::string, double>& numbers, const std::pair<std::string, double>& given,
              const char* twice, const char* all, const char* kind) {
  if (!numbers.insert(given).second)
    throw InputError(
        ErrorCode::duplicate,
        fmt::format("{} for {}", twice,
                    given.first.empty() ? std::string(all)
                                        : fmt::format("the {} '{}'", kind, given.first)));
}

Special densities() {
  return {Special::What::densities, named_numbers<&FeReadOptions::densities>,
          [](PartJob& job, const std::string& text) {
            add_once(job.read.densities, density_argument(text), "--density: two densities",
                     "all materials", "material");
          },
          true};
}

Special thicknesses() {
  return {Special::What::thicknesses, named_numbers<&FeReadOptions::thicknesses>,
          [](PartJob& job, const std::string& text) {
            add_once(job.read.thicknesses, thickness_argument(text), "--thickness: two thicknesses",
                     "all shells", "group");
          },
          true};
}

Special interfaces() {
  return {Special::What::interfaces,
          [](const PartJob& job) {
            Texts out;
            for (const InterfaceDescription& i : job.options.interfaces)
              out.push_back(interface_text(i));
            return out;
          },
          [](PartJob& job, const std::string& text) {
            job.options.interfaces.push_back(interface_argument(text));
          },
          true};
}

Special markers() {
  return {Special::What::markers,
          [](const PartJob& job) {
            Texts out;
            for (const MarkerDescription& m : job.options.markers) out.push_back(marker_text(m));
            return out;
          },
          [](PartJob& job, const std::string& text) {
            job.options.markers.push_back(marker_argument(text));
          },
          true};
}

Special reference() {
  return {Special::What::reference,
          [](const PartJob& job) { return Texts{reference_text(job.options.reference)}; },
          [](PartJob& job, const std::string& text) {
            job.options.reference = reference_argument(text);
          }};
}

constexpr NumberRule effective_mass{"a number above 0 and up to 1", "", 0.0, 1.0, true};
constexpr WholeNumberRule modes{"a number of modes", 0, 10000};

std::vector<PartOption> list() {
  using P = PartOptions;
  using R = FeReadOptions;
  const int automatic = static_cast<int>(SparseSolver::automatic);
  return {
      {"units", "units", "UNITS", "Unit system of PART: mm-t-s, m-kg-s (si), ...; required",
       units()},
      {"format", "format", "NAME", "Format of the file; default: by its content", format(), true},
      {"dialect", "dialect", "WORD",
       "Dialect of the deck: abaqus or calculix; default: by its content", dialect(), true},
      {"beam_shear", "beam-shear", "WORD",
       "Shear deformation of 2-node beams: by_format (default) or none",
       reading_word<&R::beam_shear>({"by_format", "none"}), true},
      {"shell_shear", "shell-shear", "WORD",
       "Transverse shear of shells: by_format (default), none or all",
       reading_word<&R::shell_shear>({"by_format", "none", "all"}), true},
      {"mass_form", "mass-form", "WORD",
       "Mass of the elements: by_format (default, as the program of the file), consistent or "
       "lumped",
       reading_word<&R::mass_form>({"by_format", "consistent", "lumped"}), true},
      {"material", "material", "E,NU,RHO",
       "young,poisson,density in the units of the file, if it has none", material(), true},
      {"density", "density", "RHO or NAME=RHO",
       "Density of materials without one, of all or by name, in the units of the file; repeatable",
       densities(), true},
      {"thickness", "thickness", "T or GROUP=T",
       "Thickness of surface elements of files without one (Gmsh, UNV), which are shells then, of "
       "all or by group, in the units of the file; repeatable",
       thicknesses(), true},
      {"contact", "contact", "WORD",
       "Contact pairs of the deck: ignore leaves them free, tied joins them (tied:DISTANCE); "
       "default: they are refused",
       contact(), true},
      {"temperature", "temperature", "T",
       "Temperature at which materials that depend on it are taken, in the units of the file",
       temperature(), true},
      {"grounded_springs", "grounded-springs", "WORD",
       "Springs to the ground: refuse (default), or ignore: left out",
       reading_word<&R::grounded_springs>({"refuse", "ignore"}), true},
      {"nodes", "nodes", "FILE", "File with the nodes of matrices", O::File{&R::nodes}, true},
      {"mass", "mass", "FILE", "Mass matrix, if in another folder than the stiffness",
       O::File{&R::mass}, true},
      {"dofs", "dofs", "FILE", "Degrees of freedom of the rows, if in another folder",
       O::File{&R::dofs}, true},
      {"damping_matrix", "damping-matrix", "FILE",
       "Matrix of viscous damping, if in another folder", O::File{&R::damping_matrix}, true},
      {"interfaces", "interface", "NAME=...", "Where the part is held or driven; repeatable",
       interfaces()},
      {"markers", "marker", "NAME=...",
       "Where loads act (residual) or outputs are taken; repeatable", markers()},
      {"method", "method", "WORD", "craig_bampton (default), free_free or craig_chang",
       enumerator<&PartJob::options, &P::method>({"craig_bampton", "free_free", "craig_chang"})},
      {"modes", "modes", "N", "Number of normal modes; default 20 if nothing selects them",
       O::Count{modes, &P::modes, most_normal_modes}},
      {"fmax", "fmax", "HZ", "All normal modes below this frequency [Hz]",
       O::Number{positive_number("Hz"), &P::max_frequency}},
      {"effective_mass", "effective-mass", "FRACTION",
       "Normal modes until this fraction of the effective mass is reached",
       O::Number{effective_mass, &P::effective_mass}},
      {"reference", "reference", "WORD",
       "Body frame: mean_axis (default), buckens or node:NAME of an interface", reference()},
      {"integration", "integration", "WORD", "exact (default), or ccx: as CalculiX",
       enumerator<&PartJob::options, &P::integration>({"exact", "ccx"})},
      {"damping", "damping", "LAW",
       "Modal damping: a fraction of critical, a list of them, bands:usual, bands:HZ=FRACTION,..., "
       "rayleigh:ALPHA,BETA; behind it ,reference=free or mounted; default 0",
       damping()},
      // The solvers differ in rounding, and an explicit choice must take effect.
      {"solver", "solver", "WORD", "auto (default), mumps or eigen",
       enumerator<&PartJob::options, &P::solver>({"auto", "mumps", "eigen"}, automatic)},
      {"free_check", "no-free-check", "",
       "No free modes of the full model in the report (saves a factorisation)",
       O::Switch{&P::check_free_modes, false, true}},
      {"stresses", "no-stress", "", "No stress in the body file",
       O::Switch{&P::stresses, false, true}},
      {"projection", "projection", "",
       "Nodes and mass matrix in the body file, for inertia terms by projection",
       O::Switch{&P::keep_projection, true, false}}};
}

/// Does not compile after a new member is added until it is named here and has an entry above.
[[maybe_unused]] void every_member_has_an_entry(const PartJob& job) {
  // The content of the file is part of every key.
  [[maybe_unused]] const auto& [file, format, units, read, options] = job;
  [[maybe_unused]] const auto& [material, densities, thicknesses, nodes, mass, dofs, damping_matrix,
                                dialect, beam_shear, shell_shear, mass_form, contact,
                                contact_distance, grounded_springs, temperature] = read;
  // `progress` has no effect on the result.
  [[maybe_unused]] const auto& [interfaces, markers, method, modes, max_frequency, effective_mass,
                                reference, integration, damping, check_free_modes, stresses,
                                keep_projection, solver, progress] = options;
}

struct Written {
  const PartJob& job;

  Texts operator()(const O::Number& o) const {
    const double x = job.options.*o.at;
    return x != 0.0 ? Texts{fmt::format("{}", x)} : Texts();
  }
  Texts operator()(const O::Count& o) const {
    const std::optional<int> n = o.written(job.options);
    return n ? Texts{std::to_string(*n)} : Texts();
  }
  Texts operator()(const O::Word& o) const {
    const int k = o.get(job);
    return k != o.unwritten ? Texts{o.words.at(k - o.first)} : Texts();
  }
  Texts operator()(const O::Switch& o) const {
    return job.options.*o.at == o.flag ? Texts{"true"} : Texts();
  }
  Texts operator()(const O::File& o) const {
    const std::filesystem::path& file = job.read.*o.at;
    return file.empty() ? Texts() : Texts{file.filename().string()};
  }
  Texts operator()(const Special& o) const { return o.texts(job); }
};

}  // namespace

std::span<const PartOption> part_options() {
  static const std::vector<PartOption> options = list();
  return options;
}

std::vector<std::string> option_texts(const PartOption& option, const PartJob& job) {
  return std::visit(Written{job}, option.kind);
}

std::vector<std::filesystem::path> other_files(const PartJob& job) {
  std::vector<std::filesystem::path> out;
  for (const PartOption& option : part_options())
    if (const auto* file = std::get_if<O::File>(&option.kind))
      if (const auto& path = job.read.*file->at; !path.empty()) out.push_back(path);
  return out;
}

}  // namespace floatframe

#include "floatframe/formats/fe_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "floatframe/core/suggest.hpp"
#include "floatframe/core/utf8_text.hpp"
#include "floatframe/fe/springs.hpp"
#include "floatframe/formats/deck_component.hpp"
#include "floatframe/formats/equation_checks.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "floatframe/formats/matrices/op4_file.hpp"
#include "floatframe/formats/matrices/read_dmig.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_notes = 500;

const std::vector<std::string> every_file{"mass", "dofs", "nodes", "damping_matrix"};

/// Formats of this folder. A reader is one file and one entry here; decks are in deck_list.cpp.
const FeFormat own_formats[] = {
    {"gmsh", "Gmsh mesh (.msh)", {".msh"}, looks_like_gmsh, read_gmsh, true},
    {"dmig",
     "Nastran matrices (DMIG, .pch)",
     {".pch"},
     looks_like_dmig,
     read_dmig,
     false,
     nullptr,
     {"mass", "nodes", "damping_matrix"}},
    {"op4",
     "Nastran matrices (OUTPUT4, .op4)",
     {".op4"},
     looks_like_op4,
     read_op4,
     false,
     nullptr,
     {"dofs", "nodes"}},
    {"calculix_matrices",
     "CalculiX matrices (.sti, .mas, .dof)",
     {".sti", ".mas"},
     looks_like_calculix_matrix,
     read_calculix_matrices,
     false,
     nullptr,
     every_file},
    {"abaqus_matrices",
     "Abaqus matrices (.mtx)",
     {".mtx"},
     looks_like_abaqus_matrix,
     read_abaqus_matrices,
     false,
     nullptr,
     every_file},
    {"matrix_market",
     "Matrix Market matrices (.mtx)",
     {".mtx", ".mm"},
     looks_like_matrix_market,
     read_matrix_market,
     false,
     nullptr,
     every_file}};

const std::vector<FeFormat>& formats() {
  static const std::vector<FeFormat> list = [] {
    std::vector<FeFormat> all = deck_component().readers;
    all.insert(all.end(), std::begin(own_formats), std::end(own_formats));
    return all;
  }();
  return list;
}

/// "Abaqus / CalculiX deck (.inp), ...".
std::string known_formats() {
  std::string text;
  for (const FeFormat& f : formats())
    text += fmt::format("{}{} '{}'", text.empty() ? "" : ", ", f.description, f.name);
  return text + deck_component_missing();
}

bool has_ending(const FeFormat& format, std::string name) {
  name = lower_case(name);
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  return std::any_of(format.endings.begin(), format.endings.end(),
                     [&](const std::string& ending) { return name.ends_with(ending); });
}

const FeFormat& by_name(const std::filesystem::path& file, const std::string& name) {
  std::vector<std::string> names;
  for (const FeFormat& f : formats()) {
    if (same_word(f.name, name)) return f;
    names.emplace_back(f.name);
  }
  throw InputError(ErrorCode::not_found, {file.string()},
                   fmt::format("there is no format '{}'{}; known are {}", name,
                               did_you_mean(name, names), known_formats()));
}

/// The format whose ending and content fit; else the only one whose content fits; else the only
/// one whose ending fits, whose reader then reports the errors.
const FeFormat& recognised(const std::filesystem::path& file) {
  const std::string beginning = read_beginning(file, std::size_t{1} << 16);
  if (beginning.empty() && read_whole_file(file).empty())  // or a damaged gzip file: that throws
    throw InputError(ErrorCode::missing, {file.string()}, "the file is empty");
  std::vector<const FeFormat*> by_ending, by_content, by_both;
  for (const FeFormat& f : formats()) {
    const bool ending = has_ending(f, file.filename().string()), content = f.recognise(beginning);
    if (ending) by_ending.push_back(&f);
    if (content) by_content.push_back(&f);
    if (ending && content) by_both.push_back(&f);
  }
  for (const auto* found : {&by_both, &by_content, &by_ending}) {
    if (found->size() == 1) return *found->front();
    if (found->size() > 1 && found != &by_ending) {
      std::string names;
      for (const FeFormat* f : *found)
        names += fmt::format("{}'{}'", names.empty() ? "" : " or ", f->name);
      throw InputError(ErrorCode::wrong_file, {file.string()},
                       "the format is not clear: name it, " + names);
    }
  }
  throw InputError(
      ErrorCode::wrong_file, {file.string()},
      fmt::format("neither the ending nor the content of the file is known; known are {}",
                  known_formats()));
}

void choose(const FeReadOptions& options, FeModel& model) {
  if (options.beam_shear == BeamShear::none)
    for (BeamSection& s : model.sections) s.shear_y = s.shear_z = s.slenderness = 0.0;
  if (options.shell_shear != ShellShear::by_format)
    for (ShellSection& s : model.shells)
      s.shear = options.shell_shear == ShellShear::all ? 5.0 / 6.0 * s.thickness : 0.0;
  if (options.mass_form != MassChoice::by_format)
    for (FeElement& e : model.elements)
      e.mass_form =
          options.mass_form == MassChoice::lumped ? MassForm::lumped : MassForm::consistent;
  if (options.grounded_springs == GroundedSprings::ignore)
    if (const int count = remove_grounded_springs(model); count > 0)
      model.notes.push_back(fmt::format("{} springs to the ground are left out", count));
}

template <class Map>
void names_as_utf8(Map& map) {
  Map named;
  for (auto& [name, value] : map) {
    const bool fresh = named.try_emplace(utf8_text(name), std::move(value)).second;
    if (!fresh) named.try_emplace(name, std::move(value));  // the name is taken: its bytes stay
  }
  map = std::move(named);
}

/// Converts Latin-1 names of a file for JSON, pages and terminals.
void names_as_utf8(FeModel& model) {
  names_as_utf8(model.node_sets);
  names_as_utf8(model.element_sets);
  names_as_utf8(model.surfaces);
  for (std::string& name : model.material_names) name = utf8_text(name);
  for (std::string& name : model.node_names) name = utf8_text(name);
  for (std::string& note : model.notes) note = utf8_text(note);
  for (Spider& spider : model.spiders) spider.name = utf8_text(spider.name);
  for (Spring& spring : model.springs) spring.name = utf8_text(spring.name);
  for (FeElement& element : model.elements)
    if (!element.name.empty()) element.name = utf8_text(element.name);
}

/// Sets the density of materials without one from the options.
void fill_densities(const std::filesystem::path& file, const FeReadOptions& options,
                    FeModel& model) {
  std::vector<std::string> missing;
  for (const auto& [material, where] : model.without_density)
    missing.push_back(model.material_names[material]);
  const auto is = [&](const std::string& name) {
    return [&](const std::string& other) { return same_word(name, other); };
  };
  for (const auto& [name, density] : options.densities) {
    if (missing.empty())
      throw InputError(ErrorCode::exclusive, {file.string()},
                       "a density is given, but every material of the file has one: leave it out");
    if (!name.empty() && std::none_of(missing.begin(), missing.end(), is(utf8_text(name))))
      throw InputError(ErrorCode::not_found, {file.string()},
                       fmt::format("a density is given for the material '{}', but no material "
                                   "without a density has this name{}",
                                   name, did_you_mean(name, missing)));
  }
  std::set<std::string> said;  // a material with several nonstructural masses is several
  for (auto it = model.without_density.begin(); it != model.without_density.end();) {
    const std::string& name = model.material_names[it->first];
    const auto& given = options.densities;
    auto found = std::find_if(given.begin(), given.end(),
                              [&](const auto& d) { return same_word(utf8_text(d.first), name); });
    if (found == given.end()) found = given.find("");
    if (found == given.end()) {
      ++it;
      continue;
    }
    model.materials[it->first].density += found->second * it->second.factor;
    const SourceMark mark = model.mark(it->second.source);
    std::string note =
        fmt::format("{}:{}: material '{}' has no density: {:g} is taken, as the options say",
                    mark.file, mark.line, name, found->second);
    if (said.insert(note).second) model.notes.push_back(std::move(note));
    it = model.without_density.erase(it);
  }
}

/// Refuses options with files that the format does not read.
void check_more_files(const std::filesystem::path& file, const FeReadOptions& options,
                      const FeFormat& format) {
  const std::pair<const char*, const std::filesystem::path*> given[] = {
      {"mass", &options.mass},
      {"dofs", &options.dofs},
      {"nodes", &options.nodes},
      {"damping_matrix", &options.damping_matrix}};
  for (const auto& [name, path] : given)
    if (!path->empty() && std::ranges::find(format.more_files, name) == format.more_files.end())
      throw InputError(
          ErrorCode::exclusive, {file.string()},
          fmt::format("{} '{}' is given, but the format '{}' reads no such file: leave it out",
                      name, path->string(), format.name));
}

}  // namespace

std::span<const FeFormat> fe_formats() { return formats(); }

const char* word(DeckDialect dialect) noexcept {
  switch (dialect) {
    case DeckDialect::abaqus:
      return "abaqus";
    case DeckDialect::calculix:
      return "calculix";
    case DeckDialect::by_content:
      break;
  }
  return "";
}

FeModel read_fe_file(const std::filesystem::path& file, const FeReadOptions& options,
                     const std::string& format) {
  const FeFormat& chosen = format.empty() ? recognised(file) : by_name(file, format);
  if (options.dialect != DeckDialect::by_content && std::string_view(chosen.name) != "abaqus")
    throw InputError(ErrorCode::unsupported, {file.string()},
                     fmt::format("the dialect '{}' is given, but the file is no deck of Abaqus or "
                                 "CalculiX: it is read as '{}'",
                                 word(options.dialect), chosen.name));
  if (!options.thicknesses.empty() && !chosen.without_sections)
    throw InputError(ErrorCode::exclusive, {file.string()},
                     fmt::format("a thickness is given, but shells of the format '{}' have that of "
                                 "the file: leave it out",
                                 chosen.name));
  check_more_files(file, options, chosen);
  FeModel model = chosen.read(file, options);
  names_as_utf8(model);
  fill_densities(file, options, model);
  choose(options, model);
  check_equations(model);
  if (model.notes.size() > most_notes) {
    const std::size_t more = model.notes.size() - most_notes;
    model.notes.resize(most_notes);
    model.notes.push_back(fmt::format("and {} more notes", more));
  }
  return model;
}

}  // namespace floatframe

#include "floatframe/decks/ansys/ansys_build.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/core/plural.hpp"
#include "floatframe/decks/ansys/read_ansys.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Words that no other format of this folder begins a line with.
constexpr std::array<std::string_view, 8> ansys_signs = {
    "NBLOCK,", "EBLOCK,", "/PREP7", "/COM,ANSYS", "ETBLOCK,", "RLBLOCK,", "ET,", "NUMOFF,"};

void note_passed_over(AnsysBuild& build) {
  std::string list;
  for (const auto& [word, at] : build.content.ignored)
    list += fmt::format("{}{}", list.empty() ? "" : ", ", word);
  if (!list.empty()) build.file_note("ignored, of loads and analyses: {}", list);
}

}  // namespace

Mat3 ansys_rotation(const Vec3& angles) {
  return (Eigen::AngleAxisd(ansys_degree * angles(0), Vec3::UnitZ()) *
          Eigen::AngleAxisd(ansys_degree * angles(1), Vec3::UnitX()) *
          Eigen::AngleAxisd(ansys_degree * angles(2), Vec3::UnitY()))
      .toRotationMatrix();
}

int AnsysBuild::node(int id, const FeSource& at, const std::string& who) {
  const auto it = content.node_index.find(id);
  if (it != content.node_index.end()) return it->second;
  source.error(ErrorCode::not_found, at, "{} has node {}, which is not in the file", who, id);
  return -1;
}

bool AnsysBuild::nodes_of(const AnsysElement& e, std::vector<int>& nodes) {
  nodes.clear();
  for (int k = 0; k < e.nodes; ++k) {
    const int id = content.element_nodes[e.first + k];
    nodes.push_back(id == 0 ? -1 : node(id, e.at, label(e)));
    if (id != 0 && nodes.back() < 0) return false;
  }
  return true;
}

std::string AnsysBuild::label(const AnsysElement& e) const {
  const auto* const library = known(e).second;
  return library == nullptr ? fmt::format("element {}", e.id)
                            : fmt::format("element {} ({})", e.id, library->name);
}

std::pair<const AnsysType*, const AnsysLibraryElement*> AnsysBuild::known(
    const AnsysElement& e) const {
  const auto it = content.types.find(e.type);
  if (it == content.types.end()) return {};
  return {&it->second, ansys_library_element(it->second.number)};
}

const AnsysType* AnsysBuild::type(const AnsysElement& e) {
  const auto [type, library] = known(e);
  if (library != nullptr) return type;
  if (std::find(said.begin(), said.end(), e.type) != said.end()) return nullptr;
  said.push_back(e.type);
  if (type == nullptr)
    source.error(ErrorCode::not_found, e.at, "element {} is of type {}, which no ET gives", e.id,
                 e.type);
  else if (type->number == 179)
    source.error(ErrorCode::unsupported, type->at,
                 "type {} is PRETS179: the mesh is cut there, and what holds it together is the "
                 "preload of an analysis; write the mesh without the cut",
                 e.type);
  else
    source.error(ErrorCode::unsupported, type->at,
                 "type {} is element {}, which is not read; read are SOLID45, 92, 95, 185, 186, "
                 "187, 285, SOLSH190, SHELL63, 93, 181, 281, BEAM4, 188, 189, PIPE288, 289, LINK8, "
                 "180, COMBIN14, MATRIX27, MASS21 and MPC184",
                 e.type, type->number);
  return nullptr;
}

const AnsysReal* AnsysBuild::real(const AnsysElement& e) const {
  const auto it = content.reals.find(e.real);
  return it == content.reals.end() ? nullptr : &it->second;
}

const AnsysReal* AnsysBuild::needed_real(const AnsysElement& e) {
  const AnsysReal* const found = real(e);
  if (found == nullptr)
    shared_error(ErrorCode::not_found, e, "its real constants {} are not in the file", e.real);
  return found;
}

const AnsysSection* AnsysBuild::section(const AnsysElement& e, const char* kind) const {
  const auto it = content.sections.find(e.section);
  return it != content.sections.end() && it->second.kind == kind ? &it->second : nullptr;
}

const AnsysMaterial::Values::mapped_type* AnsysMaterial::find(const std::string& label) const {
  for (const Values* of : {&tables, &values})
    if (const auto it = of->find(label); it != of->end() && !it->second.empty()) return &it->second;
  return nullptr;
}

int AnsysBuild::material(int id, const AnsysElement& e, double more_density) {
  const auto [it, fresh] =
      materials.try_emplace({id, more_density}, static_cast<int>(model.materials.size()));
  if (!fresh) return it->second;
  const auto found = content.materials.find(id);
  Material m;
  const bool own = found != content.materials.end();
  if (own)
    m = ansys_material(found->second, id, options.temperature, content, source);
  else if (content.materials.empty() && options.material)
    m = *options.material;
  else if (!content.materials.empty())
    error(ErrorCode::not_found, e, "it has material {}, which is not in the file", id);
  if (const std::string huge = huge_constant(m); own && !huge.empty())
    source.error(ErrorCode::not_finite, found->second.at, "material {}: {}", id, huge);
  if (own && found->second.find("DENS") == nullptr)
    model.without_density[it->second] = {found->second.at, 1.0};
  m.density += more_density;
  if (!std::isfinite(m.density))
    error(ErrorCode::not_finite, e,
          "the density of its material {} and its added mass make {:g}, expected a finite number",
          id, m.density);
  model.materials.push_back(std::move(m));
  model.material_names.push_back(fmt::format("{}", id));
  return it->second;
}

std::optional<int> AnsysBuild::layer_material(double number, const AnsysElement& e,
                                              const FeSource& at) {
  if (!(number >= 0.0 && number < 1e9) || number != std::floor(number)) {
    error_once(ErrorCode::not_a_number, at,
               "section {}: a layer is of material {:g}, which is no number of a material",
               e.section, number);
    return std::nullopt;
  }
  const int id = static_cast<int>(number);
  return material(id == 0 ? e.material : id, e);
}

std::optional<Orientation> AnsysBuild::system(int id, const FeSource& at, const std::string& who) {
  if (id == 0) return std::nullopt;
  Orientation o;
  int kind = id;
  if (id > 10) {
    const auto it = content.systems.find(id);
    if (it == content.systems.end()) {
      source.error(ErrorCode::not_found, at,
                   "{} has coordinate system {}, which is not in the file", who, id);
      return std::nullopt;
    }
    const AnsysSystem& s = it->second;
    if (!s.round) {
      source.error(ErrorCode::unsupported, s.at,
                   "coordinate system {} is elliptical, expected a round one", id);
      return std::nullopt;
    }
    kind = s.kind;
    o.axes = ansys_rotation(s.angles);
    o.origin = s.origin;
  }
  if (kind > 2) {
    source.error(
        ErrorCode::unsupported, at,
        "{} has coordinate system {}: toroidal ones and those of numbers 3 to 10 are not read", who,
        id);
    return std::nullopt;
  }
  if (kind == 1) o.kind = Orientation::Kind::cylindrical;
  if (kind == 2) {  // radial, around, towards the pole
    o.kind = Orientation::Kind::spherical;
    o.turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  }
  return o;
}

int AnsysBuild::orientation(int id, const FeSource& at, const std::string& who) {
  if (id == 0) return -1;
  const auto [it, fresh] = orientations.try_emplace(id, -1);
  if (!fresh) return it->second;
  if (const auto o = system(id, at, who)) {
    it->second = static_cast<int>(model.orientations.size());
    model.orientations.push_back(*o);
  }
  return it->second;
}

Mat3 AnsysBuild::nodal_axes(int node) const {
  const auto it = content.node_angles.find(node);
  return it == content.node_angles.end() ? Mat3::Identity() : ansys_rotation(it->second);
}

void AnsysBuild::report_shared() {
  for (const auto& [key, s] : shared) {
    std::string text = key.second;
    if (s.others > 0) text += "; the same holds for " + plural(s.others, "other element");
    error(s.code, s.first, "{}", text);
  }
  shared.clear();
}

bool looks_like_ansys(std::string_view beginning) {
  while (!beginning.empty()) {
    const std::string_view line = trimmed(next_line(beginning));
    for (const std::string_view sign : ansys_signs)
      if (begins_with(line, sign)) return true;
  }
  return false;
}

FeModel read_ansys(TextSource& source, const FeReadOptions& options) {
  AnsysContent content = read_ansys_content(source);
  AnsysBuild build{source, content, options, content.model};
  build_ansys_elements(build);
  build_ansys_springs(build);
  build_ansys_rigid(build);
  build_ansys_contact(build);
  build.arms.tie(build.model);
  build_ansys_masses(build);
  build.report_shared();
  build_ansys_equations(build);
  build_ansys_supports(build);
  build_ansys_components(build);
  note_passed_over(build);
  source.throw_if_any();
  content.model.files = source.files();
  return std::move(content.model);
}

FeModel read_ansys_nodes(TextSource& source) {
  AnsysContent content = read_ansys_content(source);
  const FeReadOptions options;
  AnsysBuild build{source, content, options, content.model};
  build.index.assign(content.elements.size(), -1);
  build_ansys_supports(build);
  build_ansys_components(build);
  source.throw_if_any();
  content.model.files = source.files();
  return std::move(content.model);
}

FeModel read_ansys(const std::filesystem::path& file, const FeReadOptions& options) {
  TextSource source(file);
  return read_ansys(source, options);
}

}  // namespace floatframe

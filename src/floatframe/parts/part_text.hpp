#pragma once
// Text form of the description of a part, on the command line and in the provenance of a body. The
// grammar of a place:
//   NAME=WAY:VALUE[,KEY=VALUE ...]     BALL=set:BALL   EYE=cylinder:0,0,0,axis=z,radius=12,at=0,0,5
// A piece between commas without '=' belongs to the value before it, so that vectors need no
// brackets and nothing needs quotes in a shell. Lengths are in the units of the file.
#include <optional>
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

/// How an interface is connected to its nodes: the words of Spider::Kind.
inline constexpr const char* tie_words[] = {"rigid", "mean"};
/// Body references except `node`: the words of BodyReference::Kind.
inline constexpr const char* reference_words[] = {"mean_axis", "buckens"};

/// Directions "all", or pieces such as xyz, x+z or xyz+rz, as a mask: bit 0..5 = ux..rz; nullopt
/// for any other text.
std::optional<unsigned> dofs_of(const std::string& text);

std::string interface_text(const InterfaceDescription& interface);
std::string marker_text(const MarkerDescription& marker);
std::string material_text(const Material& material);
/// A density or thickness: "number" or "NAME=number".
std::string named_number_text(const std::string& name, double number);
std::string reference_text(const BodyReference& reference);
/// Parsers of the texts. Each throws InputError with one sentence that names the option and the
/// expected form.
InterfaceDescription interface_argument(const std::string& text);
MarkerDescription marker_argument(const std::string& text);
/// "young,poisson,density" in the units of the file.
Material material_argument(const std::string& text);
/// "density" or "NAME=density": the name of a material, empty for all.
std::pair<std::string, double> density_argument(const std::string& text);
/// "thickness" or "NAME=thickness": the name of a group, empty for all.
std::pair<std::string, double> thickness_argument(const std::string& text);
/// "mean_axis", "buckens" or "node:NAME"
BodyReference reference_argument(const std::string& text);

}  // namespace floatframe

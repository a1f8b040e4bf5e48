#pragma once
// Handlers of keywords of Abaqus and CalculiX decks, one for each, and what they share.
#include <set>
#include <string_view>
#include <vector>

#include "floatframe/decks/abaqus/abaqus_content.hpp"

namespace floatframe {

/// A keyword's handler: reads its data lines into the content.
using AbaqusHandler = void (*)(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);

// abaqus_mesh.cpp
void read_abaqus_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_elements(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_node_set(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_element_set(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_surface(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_coordinates.cpp
void read_abaqus_system(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_generate.cpp
void read_abaqus_generated_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_filled_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_copied_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_generated_elements(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_copied_elements(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_assembly.cpp
void read_abaqus_part(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_end_part(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_assembly(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_end_assembly(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_instance(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_end_instance(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
/// An error for each part, assembly and instance that has not ended; `where`: "before *STEP".
void close_abaqus_blocks(AbaqusContent& content, TextSource& source, const std::string& where);
/// At the end of the deck: parts without an instance go.
void finish_abaqus_assembly(AbaqusContent& content, TextSource& source);
// abaqus_instances.cpp
AbaqusSizes abaqus_sizes(const AbaqusContent& content);
/// What a part has once more, for an instance of it. Throws if instances make too much.
void copy_abaqus_part(AbaqusContent& content, const AbaqusPart& part, AbaqusScope to,
                      TextSource& source);
void remove_abaqus_scopes(AbaqusContent& content, const std::set<AbaqusScope>& scopes);
// abaqus_properties.cpp
void read_abaqus_material(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_elastic(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_density(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_solid_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_surface_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_mass(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_rotary_inertia(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
/// What all sections have; false if the section cannot be used.
bool begin_abaqus_section(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                          AbaqusType::Family family, AbaqusSection& section);
/// The value; one error at the last line if it is no positive number.
double positive_real(AbaqusLines& lines, std::string_view field, std::string_view what);
// abaqus_shell_section.cpp
void read_abaqus_shell_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_membrane_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_nodal_thickness.cpp
void read_abaqus_nodal_thickness(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_nonstructural_mass.cpp
void read_abaqus_nonstructural_mass(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_anisotropic.cpp
void read_abaqus_orientation(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
/// Is it a type of *ELASTIC that is read but not isotropic?
bool is_abaqus_anisotropic(std::string_view type);
void read_abaqus_anisotropic(AbaqusLines& lines, const AbaqusKeyword& keyword,
                             AbaqusContent& content, AbaqusMaterial* material);
// abaqus_temperatures.cpp
void read_abaqus_initial_conditions(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
/// Of a table the values at the temperature that the user says, with a note. Without one they wait
/// for the initial temperature of the deck. `material` gets a modulus in any case.
void take_abaqus_constants(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                           AbaqusMaterial& material, std::vector<TemperatureRow> rows,
                           AbaqusPendingConstants::Use use);
/// At the end of the deck: what waits for a temperature.
void finish_abaqus_constants(AbaqusLines& lines, AbaqusContent& content);
// abaqus_beam_section.cpp
void read_abaqus_beam_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_beam_section_offset(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_centroid(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_shear_center(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_constraints.cpp
void read_abaqus_rigid_body(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_coupling(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_kinematic_coupling(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_distributing_coupling(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_equation(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_boundary(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_mpc.cpp
void read_abaqus_mpc(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_ties.cpp
void read_abaqus_tie(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_contact_pair(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_general_contact(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_springs.cpp
void read_abaqus_spring(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_gap(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_transforms.cpp
void read_abaqus_transform(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);

/// Degrees of freedom "first, last" (1..6; `last` may be missing) of the fields from `index` on, as
/// a mask; 0 and an error if they are none.
unsigned abaqus_dofs(AbaqusLines& lines, const std::vector<std::string_view>& fields,
                     std::size_t index, std::string_view what);

}  // namespace floatframe

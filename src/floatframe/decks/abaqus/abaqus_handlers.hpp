#pragma once
// Handlers of keywords of Abaqus and CalculiX decks, and what they share. `abaqus_readers` in
// read_abaqus.cpp says which keyword has which.
#include "floatframe/decks/abaqus/abaqus_card.hpp"

namespace floatframe {

/// Reads the data lines of a keyword into the content.
using AbaqusHandler = void(AbaqusCard& card);

// abaqus_mesh.cpp
AbaqusHandler read_abaqus_nodes, read_abaqus_elements, read_abaqus_set, read_abaqus_surface;
// abaqus_coordinates.cpp
AbaqusHandler read_abaqus_system, read_abaqus_transform, read_abaqus_orientation;
// abaqus_generate.cpp
AbaqusHandler read_abaqus_generated_nodes, read_abaqus_filled_nodes, read_abaqus_copied_nodes;
AbaqusHandler read_abaqus_generated_elements, read_abaqus_copied_elements;
// abaqus_assembly.cpp
AbaqusHandler read_abaqus_part, read_abaqus_assembly, read_abaqus_instance, read_abaqus_end;
/// An error for each part, assembly and instance that has not ended; `where`: "before *STEP".
void close_abaqus_blocks(AbaqusContent& content, TextSource& source, const std::string& where);
/// At the end of the deck: parts without an instance go.
void finish_abaqus_assembly(AbaqusContent& content, TextSource& source);
// abaqus_materials.cpp
AbaqusHandler read_abaqus_material, read_abaqus_elastic, read_abaqus_density;
AbaqusHandler read_abaqus_initial_conditions;
/// At the end of the deck: constants that wait for a temperature.
void finish_abaqus_constants(AbaqusLines& lines, AbaqusContent& content);
// abaqus_sections.cpp
AbaqusHandler read_abaqus_solid_section, read_abaqus_shell_section, read_abaqus_membrane_section;
AbaqusHandler read_abaqus_nodal_thickness, read_abaqus_surface_section;
AbaqusHandler read_abaqus_mass, read_abaqus_rotary_inertia;
/// What all sections have; false if the section cannot be used.
bool begin_abaqus_section(AbaqusCard& card, AbaqusType::Family family, AbaqusSection& section);
// abaqus_nonstructural_mass.cpp
AbaqusHandler read_abaqus_nonstructural_mass;
// abaqus_beam_section.cpp
AbaqusHandler read_abaqus_beam_section, read_abaqus_place_in_section;
// abaqus_constraints.cpp
AbaqusHandler read_abaqus_rigid_body, read_abaqus_coupling;
AbaqusHandler read_abaqus_kinematic_coupling, read_abaqus_distributing_coupling;
AbaqusHandler read_abaqus_equation, read_abaqus_boundary, read_abaqus_mpc;
// abaqus_ties.cpp
AbaqusHandler read_abaqus_tie, read_abaqus_contact_pair, read_abaqus_contact;
AbaqusHandler read_abaqus_gap, read_abaqus_pre_tension;
// abaqus_springs.cpp
AbaqusHandler read_abaqus_spring;

}  // namespace floatframe

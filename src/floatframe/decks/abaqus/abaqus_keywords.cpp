#include "floatframe/decks/abaqus/abaqus_keywords.hpp"

#include <unordered_map>
#include <unordered_set>

#include "floatframe/decks/abaqus/abaqus_lines.hpp"

namespace floatframe {
namespace {

using Use = AbaqusKeywordRule::Use;

struct Refused {
  const char* advice;
  std::initializer_list<const char*> names;
};

const Refused refused[] = {
    {"join the nodes in the mesher or use *RIGID BODY or *COUPLING",
     {"EMBEDDED ELEMENT", "SHELL TO SOLID COUPLING", "FASTENER", "FASTENER PROPERTY",
      "COHESIVE SECTION", "GASKET SECTION", "BOND"}},
    {"use *RIGID BODY, *COUPLING or *EQUATION", {"NETWORK MPC"}},
    {"put springs, dampers and connectors into the multibody model",
     {"JOINT", "EPJOINT", "BUSHING", "ITS", "FOUNDATION"}},
    {"cut the deck there: each body is a part of its own, and the joint is one of the model",
     {"CONNECTOR SECTION", "CONNECTOR BEHAVIOR", "CONNECTOR ELASTICITY"}},
    {"give the end of the beam a node of its own and tie it in the other directions by *EQUATION",
     {"RELEASE"}},
    {"contact has no place in a linear part", {"CLEARANCE", "SLIDE LINE", "RIGID SURFACE"}},
    {"write directions of beams in *BEAM SECTION; those of shells follow from their nodes",
     {"NORMAL"}},
    {"write the deck with all nodes and elements",
     {"NMAP", "SYMMETRIC MODEL GENERATION", "IMPERFECTION", "IMPORT", "MODEL CHANGE", "ADJUST"}},
    {"write the deck with numbers", {"PARAMETER"}},
    {"only linear elasticity (*ELASTIC) is read",
     {"HYPERELASTIC", "HYPERFOAM", "HYPOELASTIC", "USER MATERIAL", "VISCOELASTIC", "LAMINATE",
      "LOW DENSITY FOAM", "MULLINS EFFECT", "NO COMPRESSION", "NO TENSION"}},
    {"use *BEAM SECTION", {"FRAME SECTION", "BEAM SECTION GENERATE", "SECTION ORIGIN"}},
    {"the stiffness in shear follows from the section",
     {"TRANSVERSE SHEAR STIFFNESS", "TRANSVERSE SHEAR"}},
    {"use elements of their own", {"REBAR", "REBAR LAYER", "PINNED REBAR"}},
    {"use *MASS", {"MASS ADJUST", "C ADDED MASS", "D ADDED MASS"}},
    {"use *MASS and *ROTARY INERTIA", {"BEAM ADDED INERTIA", "BEAM FLUID INERTIA"}},
    {"it scales the mass", {"FIXED MASS SCALING", "VARIABLE MASS SCALING"}},
    {"give the matrix files instead of the deck", {"MATRIX INPUT", "MATRIX ASSEMBLE"}},
    {"give the matrices of the part as files",
     {"USER ELEMENT", "UEL PROPERTY", "SUBSTRUCTURE PROPERTY", "SUBSTRUCTURE PATH",
      "SUBSTRUCTURE COPY", "FLEXIBLE BODY"}},
    {"it belongs behind *COUPLING", {"KINEMATIC", "DISTRIBUTING"}},
};

/// What a step holds; some of it is also written before the first step.
const std::initializer_list<const char*> of_steps = {
    // procedures and their controls
    "STATIC", "DYNAMIC", "FREQUENCY", "BUCKLE", "VISCO", "GEOSTATIC", "SOILS", "ANNEAL",
    "DIRECT CYCLIC", "MODAL DYNAMIC", "STEADY STATE DYNAMICS", "COMPLEX FREQUENCY",
    "RANDOM RESPONSE", "RESPONSE SPECTRUM", "HEAT TRANSFER", "COUPLED TEMPERATURE-DISPLACEMENT",
    "UNCOUPLED TEMPERATURE-DISPLACEMENT", "DYNAMIC TEMPERATURE-DISPLACEMENT",
    "COUPLED THERMAL-ELECTRICAL", "ELECTROMAGNETIC", "ELECTROMAGNETICS", "MASS DIFFUSION", "GREEN",
    "SENSITIVITY", "CRACK PROPAGATION", "SUBSTRUCTURE GENERATE", "SUBSTRUCTURE MATRIX OUTPUT",
    "SUBSTRUCTURE LOAD CASE", "RETAINED NODAL DOFS", "MATRIX GENERATE", "MATRIX OUTPUT",
    "MATRIX CHECK", "ELEMENT MATRIX OUTPUT", "ELEMENT OPERATOR OUTPUT", "SELECT EIGENMODES",
    "SELECT CYCLIC SYMMETRY MODES", "CONTROLS", "SOLVER CONTROLS", "SOLUTION TECHNIQUE",
    "BULK VISCOSITY", "EXTREME VALUE", "EXTREME ELEMENT VALUE", "EXTREME NODE VALUE", "DIAGNOSTICS",
    "MODAL DAMPING", "GLOBAL DAMPING", "DAMPING CONTROLS", "COMPOSITE MODAL DAMPING", "END STEP",
    "LOAD CASE", "END LOAD CASE", "CHANGE FRICTION", "CHANGE PLASTIC", "CHANGE MATERIAL",
    "OBJECTIVE", "CONSTRAINT", "GEOMETRIC CONSTRAINT", "DESIGN VARIABLES", "DESIGN PARAMETER",
    "DESIGN RESPONSE", "DESIGN GRADIENT", "DSA CONTROLS", "FEASIBLE DIRECTION", "ROBUST DESIGN",
    "RANDOM FIELD", "CORRELATION LENGTH", "SUBCYCLING",
    // loads
    "CLOAD", "DLOAD", "DSLOAD", "TEMPERATURE", "FIELD", "FILM", "SFILM", "CFILM", "RADIATE",
    "SRADIATE", "CRADIATE", "CFLUX", "DFLUX", "DSFLUX", "CFLOW", "DFLOW", "DSFLOW", "SFLOW",
    "CECHARGE", "DECHARGE", "CECURRENT", "DECURRENT", "MASS FLOW", "MASS FLOW RATE", "BASE MOTION",
    "BASELINE CORRECTION", "MOTION", "INERTIA RELIEF", "CONNECTOR LOAD", "CONNECTOR MOTION",
    "INCIDENT WAVE", "PRESSURE STRESS", "PRESSURE PENETRATION", "CONTACT INTERFERENCE", "SLOAD",
    "PSD-DEFINITION", "SPECTRUM", "CORRELATION", "SUBMODEL", "PREDEFINED FIELD",
    // results
    "OUTPUT", "NODE OUTPUT", "ELEMENT OUTPUT", "CONTACT OUTPUT", "ENERGY OUTPUT", "MODAL OUTPUT",
    "SURFACE OUTPUT", "INCREMENTATION OUTPUT", "INTEGRATED OUTPUT", "INTEGRATED OUTPUT SECTION",
    "RADIATION OUTPUT", "NODE FILE", "EL FILE", "ELEMENT FILE", "CONTACT FILE", "ENERGY FILE",
    "MODAL FILE", "SECTION FILE", "RADIATION FILE", "NODE PRINT", "EL PRINT", "ELEMENT PRINT",
    "FACE PRINT", "CONTACT PRINT", "ENERGY PRINT", "MODAL PRINT", "SECTION PRINT", "TORQUE PRINT",
    "RADIATION PRINT", "FILE OUTPUT", "FILE FORMAT", "PRINT", "MONITOR", "NODE RESPONSE",
    "ELEMENT RESPONSE", "CONTACT RESPONSE", "POST OUTPUT", "USER OUTPUT VARIABLES", "TORQUE",
    "CONTOUR INTEGRAL", "VIEWFACTOR OUTPUT", "VIEWFACTOR", "SUBSTRUCTURE OUTPUT"};

/// Definitions that a linear part does not need.
const std::initializer_list<const char*> definitions = {
    "PREPRINT", "RESTART", "AMPLITUDE", "TIME POINTS", "FILTER", "PHYSICAL CONSTANTS",
    "VALUES AT INFINITY", "DISTRIBUTION", "DISTRIBUTION TABLE", "USER DEFINED FIELD", "DEPVAR",
    "SECTION CONTROLS", "SECTION POINTS", "DISPLAY BODY", "CONSTRAINT CONTROLS", "IMPORT CONTROLS",
    "CAVITY DEFINITION", "SURFACE PROPERTY", "FILM PROPERTY", "EMISSIVITY", "CO-SIMULATION",
    "CO-SIMULATION REGION", "CO-SIMULATION CONTROLS",
    // of *CONTACT and *CONTACT PAIR, which are refused
    "CYCLIC SYMMETRY MODEL", "SURFACE INTERACTION", "SURFACE BEHAVIOR", "FRICTION",
    "COHESIVE BEHAVIOR", "CONTACT DAMPING", "CONTACT CONTROLS", "CONTACT CONTROLS ASSIGNMENT",
    "CONTACT INCLUSIONS", "CONTACT EXCLUSIONS", "CONTACT PROPERTY ASSIGNMENT",
    "CONTACT FORMULATION", "CONTACT INITIALIZATION DATA", "CONTACT INITIALIZATION ASSIGNMENT",
    "CONTACT CLEARANCE", "CONTACT CLEARANCE ASSIGNMENT", "CONTACT STABILIZATION",
    "CONTACT PERMEABILITY", "SURFACE PROPERTY ASSIGNMENT", "GAP CONDUCTANCE", "GAP HEAT GENERATION",
    "GAP RADIATION", "GAP ELECTRICAL CONDUCTANCE", "FRACTURE CRITERION",
    // properties of materials beside linear elasticity
    "DASHPOT", "EXPANSION", "CONDUCTIVITY", "SPECIFIC HEAT", "LATENT HEAT",
    "ELECTRICAL CONDUCTIVITY", "MAGNETIC PERMEABILITY", "DIELECTRIC", "DIFFUSIVITY", "SOLUBILITY",
    "PERMEABILITY", "SORPTION", "POROUS BULK MODULI", "SWELLING", "FLUID CONSTANTS",
    "SPECIFIC GAS CONSTANT", "VISCOSITY", "INELASTIC HEAT FRACTION", "JOULE HEAT FRACTION",
    "HEAT GENERATION", "DAMPING", "PLASTIC", "DEFORMATION PLASTICITY", "CYCLIC HARDENING",
    "CYCLED PLASTIC", "RATE DEPENDENT", "POTENTIAL", "ORNL", "CREEP", "ANNEAL TEMPERATURE",
    "DAMAGE INITIATION", "DAMAGE EVOLUTION", "DAMAGE STABILIZATION", "SHEAR FAILURE",
    "TENSILE FAILURE", "FAIL STRESS", "FAIL STRAIN", "FAILURE RATIOS", "TENSION STIFFENING",
    "TENSION CUTOFF", "SHEAR RETENTION", "DRUCKER PRAGER", "DRUCKER PRAGER HARDENING",
    "DRUCKER PRAGER CREEP", "MOHR COULOMB", "MOHR COULOMB HARDENING", "CAP PLASTICITY",
    "CAP HARDENING", "CAP CREEP", "CAST IRON PLASTICITY", "CAST IRON TENSION HARDENING",
    "CAST IRON COMPRESSION HARDENING", "CLAY PLASTICITY", "CLAY HARDENING", "CONCRETE",
    "CONCRETE DAMAGED PLASTICITY", "CONCRETE TENSION STIFFENING", "CONCRETE TENSION DAMAGE",
    "CONCRETE COMPRESSION HARDENING", "CONCRETE COMPRESSION DAMAGE", "BRITTLE CRACKING",
    "BRITTLE SHEAR", "BRITTLE FAILURE", "CRUSHABLE FOAM", "CRUSHABLE FOAM HARDENING",
    "POROUS METAL PLASTICITY", "POROUS FAILURE CRITERIA", "VOID NUCLEATION", "ACOUSTIC MEDIUM"};

/// What describes the part itself and stands before the first step. *MODEL CHANGE and
/// *CHANGE SOLID SECTION belong into a step and change it.
const std::initializer_list<const char*> of_the_part = {"NODE",
                                                        "NGEN",
                                                        "SYSTEM",
                                                        "NFILL",
                                                        "NCOPY",
                                                        "ELGEN",
                                                        "ELCOPY",
                                                        "ELEMENT",
                                                        "MATERIAL",
                                                        "ELASTIC",
                                                        "DENSITY",
                                                        "SOLID SECTION",
                                                        "SHELL SECTION",
                                                        "SHELL GENERAL SECTION",
                                                        "MEMBRANE SECTION",
                                                        "BEAM SECTION",
                                                        "BEAM GENERAL SECTION",
                                                        "NODAL THICKNESS",
                                                        "MASS",
                                                        "NONSTRUCTURAL MASS",
                                                        "ROTARY INERTIA",
                                                        "RIGID BODY",
                                                        "COUPLING",
                                                        "KINEMATIC COUPLING",
                                                        "DISTRIBUTING COUPLING",
                                                        "EQUATION",
                                                        "PART",
                                                        "INSTANCE",
                                                        "ASSEMBLY",
                                                        "TIE",
                                                        "MPC",
                                                        "SPRING",
                                                        "CHANGE SOLID SECTION",
                                                        "MATRIX INPUT",
                                                        "MATRIX ASSEMBLE"};

std::unordered_map<std::string, AbaqusKeywordRule> rules() {
  std::unordered_map<std::string, AbaqusKeywordRule> map;
  for (const Refused& group : refused) {
    for (const char* name : group.names) map[abaqus_name(name)] = {Use::refused, group.advice};
  }
  for (const auto& list : {of_steps, definitions}) {
    for (const char* name : list)
      map.try_emplace(abaqus_name(name), AbaqusKeywordRule{Use::harmless});
  }
  return map;
}

}  // namespace

AbaqusKeywordRule abaqus_keyword_rule(const std::string& name) {
  static const std::unordered_map<std::string, AbaqusKeywordRule> map = rules();
  const auto it = map.find(name);
  if (it != map.end()) return it->second;
  if (name.starts_with("CONNECTOR")) return map.at("CONNECTORSECTION");
  return {};
}

bool changes_part_in_step(const std::string& name) {
  static const std::unordered_set<std::string> names = [] {
    std::unordered_set<std::string> set;
    for (const char* n : of_the_part) set.insert(abaqus_name(n));
    return set;
  }();
  return names.contains(name);
}

}  // namespace floatframe

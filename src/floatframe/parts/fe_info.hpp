#pragma once
// What is in a finite-element file, before anything is computed with it: for people and as JSON.
// Numbers are in the units of the file, which nothing in it states.
#include <string>
#include <utility>
#include <vector>

#include "floatframe/parts/part_job.hpp"
#include "floatframe/parts/reduce_proposal.hpp"

namespace floatframe {

struct FeFacts {
  int nodes = 0;
  std::vector<std::pair<std::string, int>> elements;  ///< number of each type
  int point_masses = 0, springs = 0, grounded_springs = 0, equations = 0, supports = 0;
  int matrix_rows = 0;                           ///< of matrices from another program
  bool matrix_damping = false;                   ///< viscous damping is among them
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box
  double volume = 0.0;                           ///< of solids, shells and beams that are valid
  double mass = 0.0;                             ///< of all, known as far as densities are
  std::vector<double> material_masses;           ///< of each material
  double point_mass = 0.0, other_mass = 0.0;     ///< and that of sections per length or area
  std::vector<std::string> bad_elements;         ///< labels of invalid elements
  std::string bad_reason;                        ///< of the first of them
  SourceMark bad_mark;                           ///< where the first of them stands
  struct Set {
    std::string name, kind;  ///< "nodes", "elements", "surface"
    int size = 0;            ///< nodes, elements, faces
    int nodes = 0;
  };
  std::vector<Set> sets;
  struct SpiderFacts {
    std::string name, kind, reference;
    int nodes = 0;
  };
  std::vector<SpiderFacts> spiders;  ///< but for `beam_arms`
  int arms = 0;                      ///< nodes with ends of bars beside them
  /// Unit systems in which all materials look like those of real parts.
  std::vector<std::string> likely_units;
  ReduceProposal proposal;
};

/// Of the job the file and how it was read.
FeFacts fe_facts(const PartJob& job, const FeModel& model);

/// Unit systems in which every material has 1e8 Pa < E < 2e12 Pa, 50 kg/m3 < density < 25000 kg/m3
/// and the part measures 1 mm to 50 m.
std::vector<std::string> likely_units(const FeModel& model);

std::string fe_info_text(const PartJob& job, const FeModel& model);
std::string fe_info_json(const PartJob& job, const FeModel& model);

}  // namespace floatframe

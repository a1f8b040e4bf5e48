#pragma once
// Summary of a finite-element file, before any computation: for people and as JSON. Numbers are in
// the units of the file, which are not stated in it.
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
  int matrix_rows = 0;                           ///< size of matrices from another program
  bool matrix_damping = false;                   ///< including viscous damping
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box
  double volume = 0.0;                           ///< of solids, shells and beams that are valid
  double mass = 0.0;                             ///< total, as far as densities are known
  std::vector<double> material_masses;           ///< of each material
  double point_mass = 0.0, other_mass = 0.0;     ///< and nonstructural mass of sections
  std::vector<std::string> bad_elements;         ///< labels of invalid elements
  std::string bad_reason;                        ///< of the first of them
  SourceMark bad_mark;                           ///< location of the first of them
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
  std::vector<SpiderFacts> spiders;  ///< except `beam_arms`
  int arms = 0;                      ///< nodes with offset bar ends
  /// Unit systems in which all materials have realistic values.
  std::vector<std::string> likely_units;
  ReduceProposal proposal;
};

/// Uses the file and the reading options of the job.
FeFacts fe_facts(const PartJob& job, const FeModel& model);

/// Unit systems in which every material has 1e8 Pa < E < 2e12 Pa, 50 kg/m3 < density < 25000 kg/m3
/// and the part measures 1 mm to 50 m.
std::vector<std::string> likely_units(const FeModel& model);

std::string fe_info_text(const PartJob& job, const FeModel& model);
std::string fe_info_json(const PartJob& job, const FeModel& model);

}  // namespace floatframe

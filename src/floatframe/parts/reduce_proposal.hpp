#pragma once
// Proposal of `floatframe info` for a finite-element file: interfaces that a reduction accepts
// together, and the command for it.
#include <string>
#include <vector>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

struct ReduceProposal {
  /// At the references of spiders (except those for ends of bars, `beam_arms`), then at node sets
  /// and surfaces, small ones first; at element sets only if there are no others. Each is added to
  /// a copy of the model as in a reduction, so that no node belongs to two interfaces, none is
  /// duplicated and no direction of one is dependent or unrestrained. Sets of more than half of the
  /// nodes are excluded. At most 24.
  std::vector<InterfaceDescription> interfaces;
  /// "floatframe reduce FILE --units ... --interface NAME=set:NAME": a line to paste into a shell,
  /// with the reading options of the job, and the first of the likely units. Values that the file
  /// does not give are capitals: UNITS, RHO, E,NU,RHO. Free modes if there is no interface.
  std::string command;
  /// Error of the mesh itself that would prevent a reduction: disconnected pieces, a mechanism; or
  /// empty. Models of up to 600 nodes are reduced for a test; larger ones are only checked for
  /// disconnected pieces.
  std::string obstacle;
};

/// Uses the file and the reading options of the job.
ReduceProposal propose_reduction(const PartJob& job, const FeModel& model,
                                 const std::vector<std::string>& likely_units);

}  // namespace floatframe

#pragma once
// What `floatframe info` proposes of a finite-element file: interfaces that a reduction accepts
// together, and the command that makes it.
#include <string>
#include <vector>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

struct ReduceProposal {
  /// At the references of spiders (but not of those for ends of bars, `beam_arms`), then at node
  /// sets and surfaces, small ones first; at element sets only if there are no others. Each was
  /// added to a copy of the model as a reduction does, so that no node belongs to two, none is
  /// given twice and no direction of one depends on others or is held by nothing. Sets of more than
  /// half of the nodes are none. At most 24.
  std::vector<InterfaceDescription> interfaces;
  /// "floatframe reduce FILE --units ... --interface NAME=set:NAME": a line to paste into a shell,
  /// with the options of reading that the job has, and the first of the likely units. What the
  /// file does not say stands there in capitals: UNITS, RHO, E,NU,RHO. Free modes if there is no
  /// interface.
  std::string command;
  /// Why it would be refused for the mesh itself: pieces that nothing joins, a mechanism; empty if
  /// it is not. The reduction of models of up to 600 nodes is tried; of larger ones is only looked
  /// whether the pieces are joined.
  std::string obstacle;
};

/// Of the job the file and how the model was read from it.
ReduceProposal propose_reduction(const PartJob& job, const FeModel& model,
                                 const std::vector<std::string>& likely_units);

}  // namespace floatframe

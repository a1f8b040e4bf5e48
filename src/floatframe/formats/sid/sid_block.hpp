#pragma once
// A block of a SID_FEM file: "name", order, nrow, ncol, nq, nqn, structure, entries m0(r,c) and
// m1(r,q,c), "end name".
#include <string>

#include "floatframe/formats/sid/sid_content.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// Reads the block whose name was the last line. `block` comes with the size that it must have;
/// memory is taken for that and for the number of modes, never for what the block claims.
void read_sid_block(TextSource& source, const std::string& name, int modes, SidTaylor& block);

}  // namespace floatframe

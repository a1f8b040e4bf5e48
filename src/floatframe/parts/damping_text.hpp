#pragma once
// Text form of a damping, on the command line and in the provenance of a body:
//   0.02    0.02,reference=mounted    0.01,0.02,0.05    bands:usual    bands:100=0.01,1000=0.1,1
//   rayleigh:0.5,1e-5
// each with reference=frame, free or mounted, and of mounted with frequency=HZ.
#include <string>

#include "floatframe/body/modal_damping.hpp"

namespace floatframe {

/// Empty if there is none.
std::string damping_text(const ModalDamping& damping);
/// Parses the text. Throws InputError with one sentence that names the option and the expected
/// form.
ModalDamping damping_argument(const std::string& text);

}  // namespace floatframe

#include "floatframe/apps/selection_arguments.hpp"

#include "floatframe/apps/command.hpp"
#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

std::vector<Option> SelectionArguments::table() {
  return {
      text_option("--from", from, "SECONDS", "First instant [s]; default: the first"),
      text_option("--to", to, "SECONDS", "Last instant [s]; default: the last"),
      whole_option("--every", taken.every, 1, 1'000'000'000, "Of the recorded instants every N-th"),
      repeated_option("--body", taken.bodies, "NAME", "Only this body; may be repeated")};
}

ExportSelection SelectionArguments::selection() const {
  ExportSelection out = taken;
  const NumberRule any = any_number("s");
  if (!from.empty()) out.from = option_number("--from", from, any);
  if (!to.empty()) out.to = option_number("--to", to, any);
  if (out.from > out.to)
    throw InputError(ErrorCode::contradiction,
                     "found --from " + from + " after --to " + to + ", expected an earlier time");
  return out;
}

}  // namespace floatframe

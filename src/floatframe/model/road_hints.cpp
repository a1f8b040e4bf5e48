// What of the files of roads has no effect.
#include "floatframe/model/hint_list.hpp"

namespace floatframe {

void hint_at_roads(const Model& model, HintList& out) {
  for (const Road& road : model.roads)
    if (road.surface && road.surface->crg)
      for (const std::string& note : road.surface->crg->notes) out.add("road", road.name, note);
}

}  // namespace floatframe

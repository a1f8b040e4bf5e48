#include "floatframe/run/result_table.hpp"

#include <fmt/format.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/suggest.hpp"

namespace floatframe {

std::size_t ResultTable::column(std::string_view name) const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].name == name) return k;
    names.push_back(columns[k].name);
  }
  throw InputError(ErrorCode::not_found,
                   fmt::format("unknown column '{}'{}", excerpt(name), did_you_mean(name, names)));
}

}  // namespace floatframe

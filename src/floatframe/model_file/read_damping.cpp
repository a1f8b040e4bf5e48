// The key `damping` of bars and parts: a fraction, or a map with one of fraction, fractions, bands
// and rayleigh.
#include "floatframe/body/modal_damping.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

constexpr const char* damping_list = "a list of fractions of critical damping";
constexpr const char* band_list = "usual, or a list [[100, 0.01], [1000, 0.1], 1.0]";

std::vector<double> damping_fractions(const YamlValue& value) {
  std::vector<double> out;
  const auto items = value.list(damping_list);
  if (value.is_list() && items.empty()) value.unexpected(damping_list);
  for (const YamlValue& item : items)
    out.push_back(item.number(rules::damping_ratio).value_or(0.0));
  return out;
}

std::vector<DampingBand> damping_bands(const YamlValue& value) {
  if (!value.is_list()) {
    const auto word = value.text(band_list);
    if (word && *word == "usual") return usual_damping_bands();
    if (word) value.unexpected(band_list);
    return {};
  }
  std::vector<DampingBand> out;
  for (const YamlValue& item : value.list(band_list)) {
    DampingBand& band = out.emplace_back();
    if (!item.is_list()) {
      band.fraction = item.number(rules::damping_ratio).value_or(0.0);
      continue;
    }
    const auto pair = item.list();
    if (pair.size() != 2) {
      item.unexpected("[frequency limit, fraction]");
      continue;
    }
    band.below = pair[0].number(rules::mode_frequency).value_or(1.0);
    band.fraction = pair[1].number(rules::damping_ratio).value_or(0.0);
  }
  if (out.empty()) value.unexpected(band_list);
  return out;
}

}  // namespace

ModalDamping read_damping(const YamlValue& value) {
  if (!value.is_map()) return value.number(rules::damping_ratio).value_or(0.0);
  ModalDamping out;
  auto s = value.section();
  const std::size_t before = value.context().errors->size();
  if (const auto v = s->get("fraction"))
    out.fractions = {v->number(rules::damping_ratio).value_or(0.0)};
  if (const auto v = s->get("fractions")) out.fractions = damping_fractions(*v);
  if (const auto v = s->get("bands")) out.bands = damping_bands(*v);
  if (const auto v = s->get("rayleigh")) {
    const auto factors =
        v->numbers(2, 2, non_negative_number(""), "Rayleigh's factors [alpha, beta] [1/s, s]");
    if (factors) {
      out.alpha = (*factors)[0];
      out.beta = (*factors)[1];
    }
  }
  constexpr const char* references[] = {"frame", "free", "mounted"};
  s->word("reference", references, out.reference);
  out.interface_frequency = s->number("frequency", rules::mode_frequency, 0.0);
  s->finish();
  const int ways = s->has("fraction") + s->has("fractions") + s->has("bands") + s->has("rayleigh");
  if (ways != 1)
    value.error(ErrorCode::exclusive,
                "found " + std::to_string(ways) +
                    " of fraction, fractions, bands and rayleigh, expected one of them");
  else if (value.context().errors->size() == before)
    value.complain(ErrorCode::out_of_range, damping_complaint(out));
  return out;
}

}  // namespace floatframe

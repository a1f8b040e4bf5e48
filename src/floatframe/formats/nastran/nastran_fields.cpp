#include "floatframe/formats/nastran/nastran_fields.hpp"

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

std::string NastranFields::card_label() const {
  const std::string_view id = card_.field(0);
  return parse_label(id) ? fmt::format("{} {}", card_.name, id) : card_.name;
}

void NastranFields::error_at(ErrorCode code, const FeSource& at, const std::string& message) {
  source_.error(code, at, "{}: {}", card_label(), message);
}

int NastranFields::label(std::size_t i, const char* what) {
  const auto value = parse_label(card_.field(i));
  if (!value)
    error_in(blank(i) ? ErrorCode::missing : ErrorCode::not_a_number, i, "{}",
             blank(i) ? fmt::format("{} is missing", what)
                      : fmt::format("{} is {}, expected a whole number from 1", what,
                                    shown(card_.field(i))));
  return value.value_or(0);
}

std::pair<int, int> NastranFields::range(std::size_t& i, const char* what) {
  const int first = label(i, what);
  if (!same_word(text(i + 1), "THRU")) return {first, first};
  i += 2;
  const int last = label(i, "the last number after THRU");
  if (last == 0 || first <= last) return {first, last};
  error_in(ErrorCode::out_of_range, i,
           "found {} THRU {}, expected the first to be at most the last", first, last);
  return {0, 0};
}

int NastranFields::integer(std::size_t i, const char* what, int otherwise) {
  if (blank(i)) return otherwise;
  const auto value = parse_integer(card_.field(i));
  if (!value) error_in(ErrorCode::not_a_number, i, "{}: {}", what, not_an_integer(card_.field(i)));
  return value.value_or(otherwise);
}

double NastranFields::real(std::size_t i, const char* what, std::optional<double> otherwise,
                           NastranRange range) {
  if (blank(i) && !otherwise) error_in(ErrorCode::missing, i, "{} is missing", what);
  double value = otherwise.value_or(1.0);
  if (!blank(i)) {
    const auto given = parse_real(card_.field(i));
    if (!given) error_in(ErrorCode::not_a_number, i, "{}: {}", what, not_a_real(card_.field(i)));
    if (given && whole_ != nullptr && parse_integer(card_.field(i)) && whole_->count++ == 0) {
      whole_->first = fmt::format("{}: {} is {}", card_label(), what, shown(card_.field(i)));
      whole_->at = card_.place(i);
    }
    value = given.value_or(value);
  }
  if (range == NastranRange::positive && !(value > 0.0))
    error(ErrorCode::out_of_range, "{} is {:g}, expected more than 0", what, value);
  if (range == NastranRange::not_negative && value < 0.0)
    error(ErrorCode::out_of_range, "{} is {:g}, expected no negative number", what, value);
  return value;
}

Vec3 NastranFields::vector(std::size_t i, const char* what) {
  const double x = real(i, what, 0.0), y = real(i + 1, what, 0.0), z = real(i + 2, what, 0.0);
  return {x, y, z};
}

unsigned NastranFields::components(std::size_t i, const char* what) {
  unsigned mask = 0;
  for (const char c : card_.field(i)) {
    if (c == '0' || c == ' ') continue;
    const unsigned bit = c >= '1' && c <= '6' ? 1u << (c - '1') : 0u;
    if (bit == 0 || (mask & bit) != 0) {
      error_in(ErrorCode::wrong_value, i, "{} are {}, expected some of the digits 1 to 6", what,
               shown(card_.field(i)));
      return 0;
    }
    mask |= bit;
  }
  return mask;
}

int NastranFields::component(std::size_t i, bool needed) {
  const unsigned mask = components(i, "the component");
  if (mask == 0 && !needed) return -1;
  int component = 0;
  while (component < 6 && mask != (1u << component)) ++component;
  if (component == 6)
    error(ErrorCode::out_of_range, "the component is {}, expected one of 1 to 6",
          shown(card_.field(i)));
  return component;
}

void NastranFields::must_be_zero(std::size_t i, const char* what) {
  if (real(i, what, 0.0) != 0.0)
    error_in(ErrorCode::unsupported, i, "{} is {}, which is not supported", what,
             shown(card_.field(i)));
}

}  // namespace floatframe

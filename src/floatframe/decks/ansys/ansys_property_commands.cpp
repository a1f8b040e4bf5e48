// Element types, real constants and sections.

#include <algorithm>

#include "floatframe/decks/ansys/ansys_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int highest_key_option = 18;
/// Rows of a section and real constants beyond this are no section.
constexpr std::size_t most_rows = 100'000;

/// "SOLID185" or "185".
int element_number(AnsysFields& f, std::size_t k) {
  std::string_view word = f.text(k);
  if (f.number(k)) return f.label(k, "the element");
  const std::size_t digit = word.find_first_of("0123456789");
  if (digit != std::string_view::npos)
    if (const auto number = parse_label(word.substr(digit))) return *number;
  f.stop(ErrorCode::wrong_value, "ET: expected an element as 185 or SOLID185, found {}",
         shown(word));
}

AnsysSection& open_section(AnsysFields& f, AnsysContent& c) {
  const auto it = c.sections.find(c.section_set);
  if (it == c.sections.end())
    f.stop(ErrorCode::missing, "{}: there is no SECTYPE before", f.command());
  return it->second;
}

void read_ansys_type(AnsysFields& f, AnsysContent& c) {
  AnsysType type;
  type.id = f.label(1, "the number of the type");
  type.number = element_number(f, 2);
  for (int k = 1; k <= 6; ++k) type.keyopt[k] = f.integer(2 + k, "KEYOPT");
  type.at = f.at();
  c.types[type.id] = type;
}

void read_ansys_type_block(AnsysFields& f, AnsysContent& c) {
  const FortranColumns format = f.columns();
  while (f.row(format)) {
    AnsysType type;
    type.id = f.cell_integer(0, "the number of the type");
    type.number = f.cell_integer(1, "the element");
    for (int k = 1; k <= highest_key_option; ++k) type.keyopt[k] = f.cell_integer(1 + k, "KEYOPT");
    type.at = f.source().here();
    if (type.id < 1 || type.number < 1)
      f.source().stop(ErrorCode::out_of_range, type.at,
                      "ETBLOCK: type {} is element {}, expected numbers of 1 or more", type.id,
                      type.number);
    c.types[type.id] = type;
  }
}

void read_ansys_key_option(AnsysFields& f, AnsysContent& c) {
  const int id = f.label(1, "the number of the type");
  const auto it = c.types.find(id);
  if (it == c.types.end())
    f.stop(ErrorCode::missing, "KEYOPT: there is no type {} (ET) before", id);
  const int number = f.label(2, "the number of the option");
  if (number > highest_key_option)
    f.stop(ErrorCode::out_of_range, "KEYOPT: option {}, expected 1 to {}", number,
           highest_key_option);
  it->second.keyopt[number] = f.integer(3, "the option");
}

/// R,number,V1,...,V6; R,R5.0,LOC,number,start,V1,V2,V3.
void read_ansys_real(AnsysFields& f, AnsysContent& c) {
  if (ansys_written(f)) {
    AnsysReal& real = c.reals[f.label(3, "the number of the set")];
    real.at = f.at();
    const std::size_t start = f.label(4, "the place");
    if (start > most_rows)
      f.stop(ErrorCode::out_of_range, "R: place {}, expected a smaller one", start);
    for (std::size_t k = 5; k < f.size(); ++k) {
      if (f.blank(k)) continue;
      real.values.resize(std::max(real.values.size(), start + k - 5), 0.0);
      real.values[start + k - 6] = f.real(k, "the constant");
    }
    return;
  }
  c.real_set = f.label(1, "the number of the set");
  c.reals[c.real_set] = {f.reals(2, "the constant"), f.at()};
}

void read_ansys_real_more(AnsysFields& f, AnsysContent& c) {
  const auto it = c.reals.find(c.real_set);
  if (it == c.reals.end()) f.stop(ErrorCode::missing, "RMORE: there is no R before");
  std::vector<double>& values = it->second.values;
  values.resize((values.size() + 5) / 6 * 6, 0.0);  // six fields a line
  if (values.size() > most_rows)
    f.stop(ErrorCode::wrong_count, "RMORE: a set has too many real constants");
  for (std::size_t k = 1; k <= 6; ++k) values.push_back(f.real(k, "the constant"));
}

/// A first line of each set: number, count, constants; more lines in the second format.
void read_ansys_real_block(AnsysFields& f, AnsysContent& c) {
  const FortranColumns first = f.columns(), more = f.columns();
  if (first.integers() != 2 || more.integers() != 0)
    f.stop(ErrorCode::wrong_value,
           "RLBLOCK: its formats are not two whole numbers with reals, and reals");
  while (f.row(first)) {
    const FeSource at = f.source().here();
    const int id = f.cell_integer(0, "the number of the set");
    const int count = f.cell_integer(1, "the number of constants");
    if (id < 1 || count < 0 || count > static_cast<int>(most_rows))
      f.source().stop(ErrorCode::wrong_count, at, "RLBLOCK: set {} has {} real constants", id,
                      count);
    const std::size_t wanted = count;
    std::vector<double> values;
    const auto append = [&](std::size_t from, std::size_t end) {  // missing cells are 0
      for (std::size_t k = from; k < end && values.size() < wanted; ++k)
        values.push_back(f.cell_real(k, "the constant"));
    };
    append(2, first.columns.size());
    while (values.size() < wanted) {
      if (!f.row(more))
        f.source().stop(ErrorCode::wrong_count, at,
                        "RLBLOCK: set {} has {} real constants, but {} are listed", id, count,
                        values.size());
      append(0, more.columns.size());
    }
    c.reals[id] = {std::move(values), at};
  }
}

void read_ansys_section(AnsysFields& f, AnsysContent& c) {
  c.section_set = f.label(1, "the number of the section");
  AnsysSection& s = c.sections[c.section_set] = {};
  s.at = f.at();
  s.kind = f.word(2).substr(0, 4);
  s.shape = f.word(3);
}

void read_ansys_section_data(AnsysFields& f, AnsysContent& c) {
  AnsysSection& s = open_section(f, c);
  std::vector<double> row = f.reals(1, "the value");
  if (s.rows.size() > most_rows)
    f.stop(ErrorCode::wrong_count, "SECDATA: a section has too many lines");
  s.rows.push_back(std::move(row));
}

void read_ansys_section_block(AnsysFields& f, AnsysContent& c) {
  AnsysSection& s = open_section(f, c);
  const int count = f.integer(1, "the number of lines");
  for (int k = 0; k < count; ++k) {
    if (!f.loose_row())
      f.stop(ErrorCode::wrong_count,
             "SECBLOCK: section {} has {} lines in its first line, but {} are there", c.section_set,
             count, k);
    f.append_cells(0, "the value", s.rows.emplace_back());
  }
}

/// SECOFFSET,Location,OFFSET1,OFFSET2,CG-Y,CG-Z,SH-Y,SH-Z; of pipes two numbers.
void read_ansys_section_offset(AnsysFields& f, AnsysContent& c) {
  AnsysSection& s = open_section(f, c);
  const bool pipe = s.kind == "PIPE" && (f.blank(1) || f.number(1));
  s.offset = pipe ? "USER" : f.word(1).substr(0, 4);
  s.offsets = f.reals(pipe ? 1 : 2, "the offset");
}

void read_ansys_section_control(AnsysFields& f, AnsysContent& c) {
  open_section(f, c).control = f.reals(1, "the value");
}

constexpr AnsysCommand property_commands[] = {
    {"ET", read_ansys_type},
    {"ETBLOCK", read_ansys_type_block},
    {"KEYOPT", read_ansys_key_option},
    {"R", read_ansys_real},
    {"RMORE", read_ansys_real_more},
    {"RLBLOCK", read_ansys_real_block},
    {"SECTYPE", read_ansys_section},
    {"SECDATA", read_ansys_section_data},
    {"SECBLOCK", read_ansys_section_block},
    {"SECOFFSET", read_ansys_section_offset},
    {"SECCONTROL", read_ansys_section_control},
};

}  // namespace

std::span<const AnsysCommand> ansys_property_commands() { return property_commands; }

}  // namespace floatframe

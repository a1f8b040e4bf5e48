// The table of outputs in docs/model-file.md is what the list of outputs says.
#include <gtest/gtest.h>

#include "floatframe/model/output_kind.hpp"
#include "model/table_in_document.hpp"

namespace floatframe {
namespace {

std::string of(OutputOf what) {
  static const char* const words[] = {"point",
                                      "two points",
                                      "body",
                                      "body or `model`",
                                      "point of a body",
                                      "joint",
                                      "flexible body",
                                      "force element",
                                      "joint, `{rod: name}` or `{constraint: name}`",
                                      "rod",
                                      "joint with a motion",
                                      "[coupling](#couplings)",
                                      "[constraint](#constraints) with a path",
                                      "[controller](#controllers)",
                                      "force element or controller",
                                      "[formula](#formulas)",
                                      "[formula](#formulas)",
                                      "[gauge](#gauges)"};
  static_assert(std::size(words) == index_of(OutputOf::gauge) + 1);
  return words[index_of(what)];
}

std::string component(OutputType type, const OutputKind& kind) {
  if (kind.of == OutputOf::joint) return "`coordinate`: 1, 2, ... (needed if there are several)";
  if (kind.of == OutputOf::mode) return "`mode`: 1, 2, ... (required)";
  if (kind.of == OutputOf::state) return "`number`: 1, 2, ... (default 1)";
  if (kind.one_of_values && kind.of == OutputOf::force)
    return "`output`: a name or number, of an element with several values";
  if (kind.of == OutputOf::controller) return "`output`: a name or number (default 1)";
  if (type == OutputType::strain) return "`direction` (required)";
  if (!kind.components.key) return "";
  std::string words;
  for (const char* word : kind.components.words)
    words += std::string(words.empty() ? "" : ", ") + word;
  const bool about = kind.about_point;
  const bool in = kind.of == OutputOf::reaction || kind.frames != OutputFrames::none;
  const char* const more = kind.frames == OutputFrames::relative_to_and_in
                               ? "; `relative_to`, `in` (below)"
                           : about ? "; `about`, `in` (below)"
                           : in    ? "; `in` (below)"
                                   : "";
  return "`" + std::string(kind.components.key) + "`: " + words + more;
}

std::string output_row(OutputType type) {
  const OutputKind& kind = output_kind(type);
  std::string row = "|";
  for (const std::string& cell :
       {"`" + std::string(output_type_name(type)) + "`", of(kind.of), std::string(kind.about),
        component(type, kind), std::string(kind.unit)})
    row += (cell.empty() ? "" : " " + cell) + " |";
  return row + "\n";
}

TEST(OutputTable, OfTheDocumentationIsThatOfTheList) {
  const std::string head =
      "| quantity | of | what | component | unit |\n"
      "|---|---|---|---|---|\n";
  std::string table = head;
  for (const OutputType type : output_types) table += output_row(type);
  EXPECT_EQ(test::table_in_document(head), table);
}

TEST(OutputTable, EveryUnitIsOneThatTheTableNames) {
  for (const OutputType type : output_types) {
    const OutputKind& kind = output_kind(type);
    EXPECT_EQ(kind.unit_of != nullptr, std::string(kind.unit).find(" or ") != std::string::npos)
        << output_type_name(type);
  }
}

}  // namespace
}  // namespace floatframe

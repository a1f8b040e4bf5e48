// The table of joints in docs/model-file.md is what the list of joints says.
#include <gtest/gtest.h>

#include <set>

#include "floatframe/model/joint_kind.hpp"
#include "model/table_in_document.hpp"

namespace floatframe {
namespace {

std::string row(JointType type) {
  const JointKind& kind = joint_kind(type);
  const char* keys[] = {"", "`axis`", "`axis`, `axis_2`"};
  std::string coordinates;
  int k = 0;
  for (const JointCoordinate& c : kind.coordinates.all())
    coordinates += std::string(coordinates.empty() ? "" : ", ") + c.name + " [" +
                   joint_unit_name(type, k++) + "]";
  return std::string("| `") + joint_type_name(type) + "` | " + keys[static_cast<int>(kind.axes)] +
         " | " + kind.about + " | " + (coordinates.empty() ? "none" : coordinates) + " |\n";
}

TEST(JointTable, OfTheDocumentationIsThatOfTheList) {
  const std::string head =
      "| type | axes | the child, seen from the parent | coordinates, in this order |\n"
      "|---|---|---|---|\n";
  std::string table = head;
  for (const JointType type : joint_types) table += row(type);
  EXPECT_EQ(test::table_in_document(head), table);
}

TEST(JointTable, EveryJointIsComplete) {
  std::set<std::string> words;
  for (const JointType type : joint_types) {
    const JointKind& kind = joint_kind(type);
    EXPECT_TRUE(words.insert(joint_type_name(type)).second);
    EXPECT_TRUE(kind.parts && kind.mirror && kind.reverse) << joint_type_name(type);
    const auto units = kind.coordinates.all();
    const int first = kind.rotation_vector;
    if (first < 0) continue;
    ASSERT_LE(first + 3, kind.coordinates.count()) << joint_type_name(type);
    for (int k = first; k < first + 3; ++k) EXPECT_EQ(units[k].unit, JointUnit::rad);
  }
}

}  // namespace
}  // namespace floatframe

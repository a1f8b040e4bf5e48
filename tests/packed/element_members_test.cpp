// No member of the struct of an element is forgotten: each lies under a key, and what is read back
// from bytes acts as before.
#include <gtest/gtest.h>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/packed/description_bytes.hpp"
#include "support/element_motion.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

/// Bytes of the struct in the variant that no key covers: runs of them, each its beginning and
/// length. A run shorter than eight bytes may be padding.
std::vector<std::pair<std::size_t, std::size_t>> uncovered(const ElementDescription& e) {
  const std::span<const std::byte> all =
      std::visit([](const auto& keys) { return std::as_bytes(std::span(&keys, 1)); }, e.kind);
  std::vector<bool> covered(all.size(), false);
  const auto cover = [&](const KeyMember& member) {
    if (!member.bytes) return;
    const auto part = member.bytes(e);
    for (std::size_t k = 0; k < part.size(); ++k) covered[part.data() - all.data() + k] = true;
  };
  for (const ElementKey& key : element_keys(e.type())) {
    cover(key.member);
    if (key.content) cover(key.content->member);
  }
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t k = 0; k < covered.size();) {
    std::size_t end = k;
    while (end < covered.size() && !covered[end]) ++end;
    if (end - k >= 8) runs.emplace_back(k, end - k);
    k = std::max(end, k + 1);
  }
  return runs;
}

TEST(PackedElements, EveryMemberHasAKey) {
  for (const ElementType type : element_types) {
    if (element_kind(type).list == ElementList::motions) continue;  // described with their joints
    const ElementDescription blank{"x", element_kind(type).blank(), {}};
    for (const auto& [at, size] : uncovered(blank))
      ADD_FAILURE() << element_type_name(type) << ": " << size << " bytes from " << at
                    << " on have no key";
  }
}

ModelDescription with_element(const ElementKeys& keys) {
  ModelDescription d;
  d.forces = {{"x", keys, {}}};
  return d;
}

TEST(PackedElements, ActAsBefore) {
  ExampleNumbers numbers(7);
  for (const ElementType type : element_types)
    for (std::size_t regime = 0; regime < element_kind(type).regimes.size(); ++regime) {
      ElementExample x = element_example(type, regime, numbers);
      const std::string name =
          std::string(element_type_name(type)) + " " + element_kind(type).regimes[regime].name;
      const auto* law = std::get_if<ForceLaw>(&*x.element.keys);
      if (law && law->law && !law->law.formula()) continue;  // a function of a program
      const Efforts before = efforts(x);
      const DescriptionBytes bytes = description_bytes(with_element(*x.element.keys));
      const ModelDescription read = floatframe::description_of(bytes.bytes);
      EXPECT_EQ(description_bytes(read).bytes, bytes.bytes) << name;
      x.element.keys = std::make_shared<const ElementKeys>(read.forces.at(0).kind);
      const Efforts after = efforts(x);
      EXPECT_EQ(before.force, after.force) << name;
      for (std::size_t i = 0; i < x.markers.size(); ++i) {
        EXPECT_EQ(before.wrench[i].F, after.wrench[i].F) << name;
        EXPECT_EQ(before.wrench[i].T, after.wrench[i].T) << name;
      }
    }
}

TEST(PackedElements, FunctionsOfProgramsAreRefused) {
  ForceLaw law;
  law.joint = "hinge";
  law.law = ForceFunction([](double x, double, double) { return -x; }, "spring");
  EXPECT_EQ(error_of([&] { description_bytes(with_element(law)); }), "unsupported");
}

}  // namespace
}  // namespace floatframe::test

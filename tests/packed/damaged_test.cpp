// Packed models from hostile hands: any byte changed, left out or added gives an InputError, or a
// model that builds or is refused. The checksum alone would hide what is behind it: it is made to
// fit again.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "floatframe/packed/pack.hpp"
#include "floatframe/packed/pass_formula.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

std::vector<std::byte> valid_bytes() {
  ModelDescription d = valid_description();
  auto surface = std::make_shared<RoadSurface>();
  surface->height = formula("0.1*sin(x) + max(y, 0)");
  surface->friction = 0.8;
  surface->patches = {{0.0, 1.0, 0.0, 1.0, 0.3}};
  d.roads.emplace_back();
  d.roads.back().name = "wide";
  d.roads.back().surface = surface;
  const Model model = build_model(d);
  PackedModel out = packed(d, model);
  out.tune({{"a", "N", "a number", 1.0}}, {formula("2*a")},
           {{0, out.content().doubles.front(), 1.0}});
  return out.to_bytes();
}

/// Everything but an InputError is a fault of the reader.
std::string what_becomes_of(const std::vector<std::byte>& bytes) {
  return error_of([&] {
    const PackedModel model = PackedModel::from_bytes(bytes);
    model.build();
    std::vector<double> values(model.parameters().size(), 0.5);
    if (!values.empty()) model.build(values);
  });
}

TEST(DamagedModel, EveryChangedByteIsSeen) {
  const std::vector<std::byte> valid = valid_bytes();
  EXPECT_EQ(what_becomes_of(valid), "no error");
  for (std::size_t k = 0; k < valid.size(); ++k) {
    std::vector<std::byte> bytes = valid;
    bytes[k] ^= std::byte(1u << (k % 8));
    EXPECT_EQ(error_of([&] { PackedModel::from_bytes(bytes); }), k < 16   ? "wrong_file"
                                                                 : k < 24 ? "mismatch"
                                                                          : "damaged")
        << k;
  }
}

TEST(DamagedModel, ChangedBytesBehindTheChecksumAreRefusedOrBuild) {
  const std::vector<std::byte> valid = valid_bytes();
  std::mt19937 random(3);
  for (std::size_t k = 40; k < valid.size(); k += 5)
    for (int how = 0; how < 2; ++how) {
      std::vector<std::byte> bytes = valid;
      bytes[k] ^= how == 0 ? std::byte(1u << (k % 8)) : std::byte(1 + random() % 255);
      seal_packed_model(bytes);
      what_becomes_of(bytes);
    }
}

TEST(DamagedModel, CutOrLengthened) {
  const std::vector<std::byte> valid = valid_bytes();
  for (std::size_t n = 0; n < valid.size(); n += n < 200 ? 1 : 37) {
    std::vector<std::byte> bytes(valid.begin(), valid.begin() + std::ptrdiff_t(n));
    EXPECT_EQ(error_of([&] { PackedModel::from_bytes(bytes); }), n < 16 ? "wrong_file" : "damaged");
    seal_packed_model(bytes);
    EXPECT_EQ(what_becomes_of(bytes), n < 16 ? "wrong_file" : "damaged") << n;
  }
  for (const std::size_t more : {1, 8, 1000}) {
    std::vector<std::byte> bytes = valid;
    bytes.resize(bytes.size() + more);
    seal_packed_model(bytes);
    EXPECT_EQ(what_becomes_of(bytes), "damaged");
  }
}

/// Pieces are exchanged, doubled, left out within the file.
TEST(DamagedModel, PiecesInOtherPlaces) {
  const std::vector<std::byte> valid = valid_bytes();
  std::mt19937 random(5);
  const auto place = [&] { return 48 + random() % (valid.size() - 100); };
  for (int k = 0; k < 2000; ++k) {
    std::vector<std::byte> bytes = valid;
    const std::size_t from = place(), to = place(), n = 1 + random() % 50;
    std::copy_n(valid.begin() + std::ptrdiff_t(from), n, bytes.begin() + std::ptrdiff_t(to));
    seal_packed_model(bytes);
    what_becomes_of(bytes);
  }
}

TEST(DamagedModel, FormulasOfUnknownOriginAreChecked) {
  const auto damaged = [](auto change) {
    Formula f = *formula("clip(x, 0, 1) + if(y > 2, x^2, sqrt(y))");
    change(f);
    return formula_damage(f) != nullptr;
  };
  EXPECT_FALSE(damaged([](Formula&) {}));
  EXPECT_TRUE(damaged([](Formula& f) { f.steps.pop_back(), f.sources.pop_back(); }));
  EXPECT_TRUE(damaged([](Formula& f) { f.references.pop_back(); }));
  EXPECT_TRUE(damaged([](Formula& f) { f.switches = 0; }));
  EXPECT_TRUE(damaged([](Formula& f) { f.steps.clear(), f.sources.clear(); }));
  EXPECT_TRUE(damaged([](Formula& f) {
    f.steps.insert(f.steps.begin(), 40, f.steps[0]), f.sources.insert(f.sources.begin(), 40, "");
  }));
  EXPECT_TRUE(damaged([](Formula& f) {
    for (FormulaStep& s : f.steps)
      if (s.op == FormulaOp::jump || s.op == FormulaOp::jump_unless) s.index = 0;
  }));
  EXPECT_TRUE(damaged([](Formula& f) {
    for (FormulaStep& s : f.steps)
      if (s.op == FormulaOp::small_power) s.number = 1e300;
  }));
  EXPECT_TRUE(damaged([](Formula& f) {
    for (FormulaStep& s : f.steps) s.function = nullptr;
  }));
}

}  // namespace
}  // namespace floatframe::test

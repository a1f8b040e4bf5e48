// Materials whose density the file does not give: read, filled in by the options, or asked for.
#include <gtest/gtest.h>

#include <algorithm>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const char* const two_materials_deck =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n5, 0., 0., -1.\n"
    "*ELEMENT, TYPE=C3D4, ELSET=UP\n1, 1, 2, 3, 4\n"
    "*ELEMENT, TYPE=C3D4, ELSET=DOWN\n2, 2, 1, 3, 5\n"
    "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n"
    "*MATERIAL, NAME=FOAM\n*ELASTIC\n100., 0.2\n"
    "*SOLID SECTION, ELSET=UP, MATERIAL=STEEL\n*SOLID SECTION, ELSET=DOWN, MATERIAL=FOAM\n";

FeModel read(const TemporaryFolder& folder, const std::map<std::string, double>& densities) {
  FeReadOptions options;
  options.densities = densities;
  return read_fe_file(folder / "two.inp", options);
}

TEST(Density, MissingDensityIsRequired) {
  TemporaryFolder folder;
  folder.write("two.inp", two_materials_deck);
  const FeModel model = read(folder, {});
  ASSERT_EQ(model.without_density.size(), 2u);
  const std::string text = error_of([&] { validate(model); });
  EXPECT_EQ(test::without_folders(text), "two.inp:11: missing\ntwo.inp:14: missing") << text;
}

TEST(Density, OneForAllOrByName) {
  TemporaryFolder folder;
  folder.write("two.inp", two_materials_deck);
  const FeModel all = read(folder, {{"", 5.0}});
  EXPECT_TRUE(all.without_density.empty());
  EXPECT_EQ(all.materials.at(0).density, 5.0);
  EXPECT_EQ(all.materials.at(1).density, 5.0);
  const FeModel named = read(folder, {{"", 5.0}, {"foam", 0.25}});
  EXPECT_EQ(named.materials.at(0).density, 5.0);
  EXPECT_EQ(named.materials.at(1).density, 0.25);
  const auto says = [&](const std::string& note) {
    return note.find("two.inp:14: material 'FOAM' has no density: 0.25 is taken") !=
           std::string::npos;
  };
  EXPECT_EQ(std::count_if(named.notes.begin(), named.notes.end(), says), 1);
  const FeModel one = read(folder, {{"STEEL", 7.0}});
  ASSERT_EQ(one.without_density.size(), 1u);
  EXPECT_EQ(one.without_density.begin()->first, 1);
}

TEST(Density, UnusedDensityIsRejected) {
  TemporaryFolder folder;
  folder.write("two.inp", two_materials_deck);
  EXPECT_EQ(test::without_folders(error_of([&] {
              read(folder, {{"STEAL", 7.0}});
            })),
            "two.inp: not_found");
  std::string deck = two_materials_deck;
  for (const char* elastic : {"210000., 0.3\n", "100., 0.2\n"})
    deck.insert(deck.find(elastic) + std::string(elastic).size(), "*DENSITY\n7.85e-9\n");
  folder.write("two.inp", deck);
  EXPECT_EQ(test::without_folders(error_of([&] {
              read(folder, {{"", 7.0}});
            })),
            "two.inp: exclusive");
}

TEST(Density, OfNastranIsThatOfTheFile) {
  TemporaryFolder folder;
  folder.write("arm.bdf",
               "BEGIN BULK\nPARAM,WTMASS,0.5\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
               "GRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\nPSOLID,1,1\n"
               "MAT1,1,2.+11,,.3\nENDDATA\n");
  FeReadOptions options;
  EXPECT_EQ(read_fe_file(folder / "arm.bdf", options).without_density.size(), 1u);
  options.densities[""] = 8000.0;
  EXPECT_EQ(read_fe_file(folder / "arm.bdf", options).materials.at(0).density, 4000.0);
}

}  // namespace
}  // namespace floatframe::test

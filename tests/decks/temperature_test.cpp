// Materials that depend on the temperature: linear between the lines of a table, constant beyond.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"
#include "floatframe/decks/temperature_table.hpp"

namespace floatframe::test {
namespace {

TEST(Temperature, LinearBetweenTheLinesAndConstantBeyond) {
  const std::vector<TemperatureRow> rows = {{20, {200, 3}}, {120, {180, 5}}, {220, {100, 5}}};
  const auto at = [&](double T) { return at_temperature(rows, T); };
  EXPECT_EQ(at(-300).values, (std::vector<double>{200, 3}));
  EXPECT_EQ(at(20).values, (std::vector<double>{200, 3}));
  EXPECT_EQ(at(70).values, (std::vector<double>{190, 4}));
  EXPECT_EQ(at(120).values, (std::vector<double>{180, 5}));
  EXPECT_EQ(at(195).values, (std::vector<double>{120, 5}));
  EXPECT_EQ(at(900).values, (std::vector<double>{100, 5}));
  EXPECT_TRUE(at(70).chosen);
  EXPECT_FALSE(at_temperature(rows, {}).error.empty());
  const AtTemperature constant = at_temperature({{20, {7}}, {20, {7}}}, {});
  EXPECT_EQ(constant.values, std::vector<double>{7});
  EXPECT_FALSE(constant.chosen);
}

FeModel warm(const std::string& material, std::optional<double> T) {
  FeReadOptions options;
  options.temperature = T;
  return read_inp(
      "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n"
      "*ELEMENT, TYPE=C3D4, ELSET=ALL\n1, 1, 2, 3, 4\n*MATERIAL, NAME=STEEL\n" +
          material + "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n",
      options, "a.inp");
}

TEST(Temperature, TablesOfDecks) {
  const FeModel m =
      warm("*ELASTIC\n2.1e5, .3, 20.\n1.9e5, .32, 220.\n*DENSITY\n8e-9, 20.\n7e-9, 220.\n", 70);
  EXPECT_NEAR(m.materials[0].young, 2.05e5, 1e-9);
  EXPECT_NEAR(m.materials[0].poisson, 0.305, 1e-15);
  EXPECT_NEAR(m.materials[0].density, 7.75e-9, 1e-23);
  ASSERT_EQ(m.notes.size(), 3u);  // and that of the mass
  EXPECT_EQ(m.notes[0],
            "a.inp:9: *ELASTIC of material 'STEEL' is taken at the temperature 70 (its table goes "
            "from 20 to 220)");
  // Lines that say the same need no temperature.
  EXPECT_EQ(
      warm("*ELASTIC\n2.1e5, .3, 20.\n2.1e5, .3, 220.\n*DENSITY\n8e-9\n", {}).materials[0].young,
      2.1e5);
}

/// Nine constants in two lines, the temperature behind the last one.
TEST(Temperature, TablesOfOrthotropicMaterials) {
  const std::string cold = "12000, 900, 600, .4, .35, .3, 700, 650\n80, 0\n",
                    hot = "10000, 700, 500, .4, .35, .3, 500, 450\n60, 100\n",
                    middle = "11000, 800, 550, .4, .35, .3, 600, 550\n70\n",
                    head = "*DENSITY\n5e-10\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n";
  const Mat6 D = *warm(head + middle, {}).materials[0].elasticity;
  EXPECT_LE((*warm(head + cold + hot, 50).materials[0].elasticity - D).norm(), 1e-13 * D.norm());
}

const std::string table_of_steel =
    "*ELASTIC\n2.1e5, .3, 20.\n1.9e5, .32, 220.\n*DENSITY\n8e-9, 20.\n7e-9, 220.\n";  // 9 to 14

/// The sections stand behind the initial temperatures.
FeModel initially(const std::string& conditions, std::optional<double> T = {}) {
  return warm(table_of_steel + conditions, T);
}

TEST(Temperature, InitialTemperaturesOfTheDeck) {
  const FeModel m = initially(
      "*NSET, NSET=NALL\n1, 2, 3, 4\n"
      "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 70.\n2, 70., 0.\n");
  EXPECT_NEAR(m.materials[0].young, 2.05e5, 1e-9);
  EXPECT_NEAR(m.materials[0].density, 7.75e-9, 1e-23);
  ASSERT_EQ(m.notes.size(), 4u);  // and that of the mass
  EXPECT_EQ(m.notes[0],
            "a.inp:18: materials are taken at 70, the initial temperature of the deck "
            "(--temperature, key `temperature`, is another one)");
  EXPECT_EQ(m.notes[1],
            "a.inp:9: *ELASTIC of material 'STEEL' is taken at the temperature 70 (its table goes "
            "from 20 to 220)");
  // What the user says counts.
  const FeModel hot = initially("*INITIAL CONDITIONS, TYPE=TEMPERATURE\n1, 70.\n", 220.0);
  EXPECT_EQ(hot.materials[0].young, 1.9e5);
  EXPECT_EQ(hot.notes.at(hot.notes.size() - 2),
            "a.inp:16: *INITIAL CONDITIONS, TYPE=TEMPERATURE is ignored");
  // Constants that do not depend on it need none.
  EXPECT_EQ(warm("*ELASTIC\n2.1e5, .3\n*DENSITY\n8e-9\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\n"
                 "1, 70.\n2, 80.\n",
                 {})
                .materials[0]
                .young,
            2.1e5);
}

TEST(Temperature, InitialTemperaturesWithoutAValue) {
  const auto error = [](const std::string& conditions) {
    const std::string text = error_of([&] { initially(conditions); });
    return text.substr(0, text.find('\n'));
  };
  const std::string depends = "a.inp:9: incomplete";
  const std::string begin = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n";
  EXPECT_EQ(error(""), depends);
  EXPECT_EQ(error("*INITIAL CONDITIONS, TYPE=VELOCITY\n1, 1, 70.\n"), depends);
  EXPECT_EQ(error(begin + "1, 70.\n2, 80.\n"), depends);
  EXPECT_EQ(error(begin + "1, 70.\n2, 70.\n4, 70.\n"), depends);
  EXPECT_EQ(error(begin + "1, 70.\n2, 70., 5.\n"), depends);
}

}  // namespace
}  // namespace floatframe::test

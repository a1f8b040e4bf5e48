// The reader of tyre property files.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "floatframe/tyres/magic_check.hpp"
#include "support/error_of.hpp"
#include "tyres/tyre_table.hpp"

namespace floatframe::test {
namespace {

/// A file as small as can be.
const std::string small_tir =
    "[UNITS]\n"
    "LENGTH = 'm'\n"
    "[MODEL]\n"
    "FITTYP = 61\n"
    "TYRESIDE = 'LEFT'\n"
    "[DIMENSION]\n"
    "UNLOADED_RADIUS = 0.3\n"
    "[VERTICAL]\n"
    "FNOMIN = 4000\n"
    "VERTICAL_STIFFNESS = 2e5\n"
    "[COEFFICIENTS]\n"
    "PCX1 = 1.6\n"
    "PDX1 = 1.1\n"
    "PKX1 = 20\n"
    "PCY1 = 1.3\n"
    "PDY1 = 1.0\n"
    "PKY1 = -15\n"
    "PKY2 = 1.7\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(TirFile, DefaultsOfWhatIsMissing) {
  const TirFile file = parse_tir(small_tir, "small.tir");
  EXPECT_TRUE(file.notes.empty());
  EXPECT_EQ(file.number("LMUY"), 1.0);
  EXPECT_EQ(file.number("PKY4"), 2.0);
  EXPECT_EQ(file.number("QSY7"), 1.0);
  EXPECT_EQ(file.number("PPY1"), 0.0);
  const MagicTyre tyre = magic_tyre(file);
  EXPECT_EQ(tyre.fixed_sigma, 0.3);
  EXPECT_NEAR(magic_effective_radius(tyre, 3000.0, 0.0), 0.3 - 3000.0 / 2e5 / 3.0, 1e-15);
}

TEST(TirFile, UnitsBecomeSI) {
  const TirFile file = parse_tir(
      "[units]\nLENGTH = 'mm'\nFORCE = 'lbf'\nANGLE = 'DEG'\nMASS = 'pound_mass'\nTIME = 'second'\n"
      "[MODEL]\nFITTYP = 6\nLONGVL = 16600\n[DIMENSION]\nUNLOADED_RADIUS = 300 $mm\n"
      "[VERTICAL]\nFNOMIN = 1000 ! lbf\nVERTICAL_STIFFNESS = +4.0D+01\nVERTICAL_DAMPING = 0.1\n"
      "[SLIP_ANGLE_RANGE]\nALPMIN = -90\nALPMAX = 90\n[INERTIA]\nMASS = 20\nIXX = 1e6\n"
      "[OPERATING_CONDITIONS]\nINFLPRES = 0.05\n",
      "units.tir");
  const double lbf = 4.4482216152605;
  EXPECT_NEAR(file.number("UNLOADED_RADIUS"), 0.3, 1e-15);
  EXPECT_NEAR(file.number("LONGVL"), 16.6, 1e-13);
  EXPECT_NEAR(file.number("FNOMIN"), 1000.0 * lbf, 1e-9);
  EXPECT_NEAR(file.number("VERTICAL_STIFFNESS"), 40.0 * lbf / 1e-3, 1e-7);
  EXPECT_NEAR(file.number("VERTICAL_DAMPING"), 0.1 * lbf / 1e-3, 1e-9);
  EXPECT_NEAR(file.number("ALPMAX"), 0.5 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(file.number("MASS"), 20.0 * 0.45359237, 1e-12);
  EXPECT_NEAR(file.number("IXX"), 0.45359237, 1e-12);
  EXPECT_NEAR(file.number("INFLPRES"), 0.05 * lbf / 1e-6, 1e-6);
}

TEST(TirFile, ForcesDoNotDependOnTheUnits) {
  const std::string other = replaced(
      replaced(replaced(replaced(small_tir, "'m'", "'mm'"), "= 0.3", "= 300"), "2e5", "200"),
      "FITTYP", "LONGVL = 16700\nFITTYP");
  const MagicInput<double> in{3000.0, 0.05, 0.05, 0.01, 20.0, 21.0, 1.0};
  EXPECT_NEAR(magic_forces(magic_tyre(parse_tir(small_tir, "m")), in).Mz,
              magic_forces(magic_tyre(parse_tir(other, "mm")), in).Mz, 1e-9);
}

TEST(TirFile, NotesWhatItIgnores) {
  const TirFile file = parse_tir(
      replaced(small_tir, "[VERTICAL]\n",
               "[SHAPE]\n{radial width}\n1.0 0.0\n0.9 1.0\n[VERTICAL]\nPKY11 = 3\nFNOMIN = 4e3\n"
               "[MODEL]\n"),
      "notes.tir");
  EXPECT_EQ(file.notes.size(), 4U);  // the table, the keyword, [MODEL] again, FNOMIN twice
  EXPECT_EQ(file.number("FNOMIN"), 4000.0);
}

TEST(TirFile, ScalesOfTheModelGoBeforeThoseOfTheFile) {
  const TirFile file = parse_tir(small_tir + "LMUX = 0.5\nLMUY = 0.5\n", "scaled.tir");
  MagicInput<double> in{4000.0, 0.0, 10.0, 0.0, 20.0, 20.0, 1.0};
  const MagicForces<double> half = magic_forces(magic_tyre(file), in);
  const MagicForces<double> full = magic_forces(magic_tyre(file, {.scales = {{"LMUY", 1.0}}}), in);
  EXPECT_NEAR(half.muy, 0.5, 1e-14);
  EXPECT_NEAR(full.muy, 1.0, 1e-14);
  in.friction = 0.5;
  EXPECT_NEAR(magic_forces(magic_tyre(file, {.scales = {{"LMUY", 1.0}}}), in).Fy, half.Fy, 1e-9);
}

struct DamagedFile {
  const char* from;
  const char* to;
  const char* error;
};

/// One sentence each.
TEST(TirFile, DamagedFiles) {
  const DamagedFile all[] = {
      {"[MODEL]", "[MODEL", "d.tir:3:1: wrong_value"},
      {"[MODEL]", "[MODEL] x", "d.tir:3:8: wrong_value"},
      {"[MODEL]", "[]", "d.tir:3:1: missing"},
      {"[MODEL]", "[MODELL]", "d.tir: wrong_file"},
      {"[UNITS]\n", "", "d.tir:1:1: wrong_file"},
      {"'m'", "'furlong'", "d.tir:2:10: wrong_value"},
      {"'m'", "'m", "d.tir:2:10: wrong_value"},
      {"'m'", "'m' x", "d.tir:2:10: wrong_value"},
      {"'m'", "3", "d.tir:2:10: wrong_value"},
      {"FITTYP = 61", "FITTYP = 99", "d.tir:4:10: unsupported"},
      {"FITTYP = 61", "", "d.tir: missing"},
      {"FITTYP = 61", "FITTYP 61", "d.tir:4:1: wrong_value"},
      {"FITTYP = 61", "= 61", "d.tir:4:1: wrong_value"},
      {"'LEFT'", "'MIDDLE'", "d.tir:5:12: wrong_value"},
      {"'LEFT'", "1", "d.tir:5:12: wrong_value"},
      {"0.3", "0.3.1", "d.tir:7:19: not_a_number"},
      {"0.3", "1e999", "d.tir:7:19: not_finite"},
      {"0.3", "nan", "d.tir:7:19: not_finite"},
      {"0.3", "0", "d.tir:7:19: out_of_range"},
      {"0.3", "", "d.tir:7:18: missing"},
      {"0.3", "0.3 0.4", "d.tir:7:19: not_a_number"},
      {"PCX1 = 1.6", "PCX1 = 1.6\nPCX1 = 1.7", "d.tir:13:8: duplicate"},
      {"PKY1 = -15", "PKY1 = 15", "d.tir:17:8: out_of_range"},
      {"PKY2 = 1.7", "", "d.tir: missing"},
      {"PCX1 = 1.6", "FZMIN = 9\nFZMAX = 1\nPCX1 = 1.6", "d.tir:13:9: contradiction"},
      {"PCX1 = 1.6", "Q_FZ2 = 400\nPCX1 = 1.6", "d.tir:12:9: contradiction"},
      {"PCX1 = 1.6", "LMUY = 0\nPCX1 = 1.6", "d.tir:12:8: out_of_range"},
      {"PCX1 = 1.6", "LMUX = -1\nPCX1 = 1.6", "d.tir:12:8: out_of_range"},
      {"PCX1 = 1.6", "LKX = -1\nPCX1 = 1.6", "d.tir:12:7: out_of_range"},
      {"PCX1 = 1.6", "LKY = 0\nPCX1 = 1.6", "d.tir:12:7: out_of_range"},
      {"PCX1 = 1.6", "LTR = -1\nPCX1 = 1.6", "d.tir:12:7: out_of_range"},
      {"PCX1 = 1.6", "VERTICAL_DAMPING = -50\nPCX1 = 1.6", "d.tir:12:20: out_of_range"},
      {"PCX1 = 1.6", "LATERAL_STIFFNESS = -5\nPCX1 = 1.6", "d.tir:12:21: out_of_range"},
      {"PCX1 = 1.6", "BREFF = -8\nPCX1 = 1.6", "d.tir:12:9: out_of_range"},
      {"PCX1 = 1.6", "Q_FZ2 = -500\nPCX1 = 1.6", "d.tir:12:9: out_of_range"},
      {"PCX1 = 1.6", "Q_RE0 = 0\nPCX1 = 1.6", "d.tir:12:9: out_of_range"},
      {"PCX1 = 1.6", "KPUMIN = 0.1\nPCX1 = 1.6", "d.tir:12:10: out_of_range"},
      {"PCX1 = 1.6", "INFLPRES = -1\nPCX1 = 1.6", "d.tir:12:12: out_of_range"},
      {"PCX1 = 1.6", "INFLPRES = 9e9\nNOMPRES = 2e5\nPPY1 = -0.6\nPCX1 = 1.6",
       "d.tir:12:12: out_of_range"},
  };
  for (const DamagedFile& d : all) {
    const std::string text = replaced(small_tir, d.from, d.to);
    EXPECT_EQ(error_of([&] { magic_tyre(parse_tir(text, "d.tir")); }), d.error)
        << d.from << " -> " << d.to;
  }
  EXPECT_EQ(error_of([&] { parse_tir(std::string("[MODEL]\n\0x", 10), "d.tir"); }),
            "d.tir: wrong_file");
  EXPECT_TRUE(error_of([&] { read_tir(tyre_data("none.tir")); }).ends_with("none.tir: unreadable"));
}

/// Scale factors of the model multiply those of the file, which have to make sense first.
TEST(TirFile, ScalesOfTheModelDoNotHideThoseOfTheFile) {
  const std::string text = replaced(small_tir, "PCX1 = 1.6", "LKX = -1\nPCX1 = 1.6");
  EXPECT_EQ(error_of([&] {
              magic_tyre(parse_tir(text, "d.tir"), {.scales = {{"LKX", -1.0}}});
            }),
            "d.tir:12:7: out_of_range");
}

TEST(TirFile, NotesWhatIsBeyondItsOwnLimits) {
  const auto notes_of = [](const std::string& more, double pressure) {
    const TirFile file = parse_tir(small_tir + more, "n.tir");
    const MagicOptions options{.pressure = pressure};
    return magic_notes(file, magic_tyre(file, options), options);
  };
  const std::string whole =
      "LONGITUDINAL_STIFFNESS = 3e5\nLATERAL_STIFFNESS = 1e5\nNOMPRES = 2e5\nPRESMAX = 3e5\n";
  EXPECT_TRUE(notes_of(whole, 0.0).empty());
  EXPECT_EQ(notes_of(whole + "INFLPRES = 4e5\n", 0.0).at(0),
            "line 23: INFLPRES 400000 Pa is beyond PRESMAX, 300000 Pa");
  EXPECT_EQ(notes_of(whole, 4e5).at(0), "line 22: pressure 400000 Pa is beyond PRESMAX, 300000 Pa");
  EXPECT_EQ(notes_of(whole + "FZMAX = 3000\n", 0.0).at(0),
            "line 9: FNOMIN 4000 N is beyond FZMAX, 3000 N");
  EXPECT_EQ(notes_of(whole + "FREFF = -2\n", 0.0).size(), 1U);
  EXPECT_EQ(notes_of("", 0.0).size(), 1U);  // relaxation lengths
}

/// Every beginning of a file ends in a tyre or in a sentence.
TEST(TirFile, CutFiles) {
  std::ifstream file(tyre_data("b_mf62.tir"));
  std::stringstream text;
  text << file.rdbuf();
  const std::string whole = text.str();
  for (std::size_t n = 0; n < whole.size(); n += 13) {
    try {
      magic_tyre(parse_tir(whole.substr(0, n), "cut.tir"));
    } catch (const InputError& error) {
      EXPECT_FALSE(error.errors().empty());
    }
  }
}

}  // namespace
}  // namespace floatframe::test

// Notes about the corners and jumps of formulas: which steps can be divided at.
#include <gtest/gtest.h>

#include "floatframe/model/model_hints.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// The notes about a force by this signal, with or without `locate_edges`.
std::string notes_about(const std::string& force, bool located) {
  ModelDescription d = description_of(R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: z}}
tables:
  bent: {table: [[0, 0], [1, 1], [2, 4]]}
  smooth: {table: [[0, 0], [1, 1], [2, 4]], interpolation: cubic}
forces: {n: )" + force + R"(}
simulation: {step: 0.001, duration: 0.1}
)");
  d.simulation.locate_edges = located;
  std::string all;
  for (const std::string& note : model_hints(d, build_model(d)).notes) all += note + "\n";
  return all;
}
std::string notes_of(const std::string& formula, bool located) {
  return notes_about("{type: joint_spring, joint: z, actuator: {formula: '" + formula + "'}}",
                     located);
}

TEST(FormulaHints, AdviseTheKeyWhereItHelps) {
  for (const char* formula :
       {"max(0, -angle(z))", "if(angle(z) < 0, 1, 0)", "clip(rate(z), -1, 1)",
        "-sign(rate(z)) * rate(z) ^ 2", "if(rate(z) > 0.1, rate(z) - 0.1, 0)", "sign(angle(z))"}) {
    EXPECT_NE(notes_of(formula, false).find("locate_edges: true divides steps there"),
              std::string::npos)
        << formula;
    EXPECT_EQ(notes_of(formula, true), "") << formula;
  }
  EXPECT_EQ(notes_of("max(1, 2) * angle(z)", false), "");
}

TEST(FormulaHints, DoNotWhereFrictionSticks) {
  for (const char* formula :
       {"-5 * sign(rate(z))", "if(rate(z) > 0, -5, 5)", "-sign(velocity(b, z)) - angle(z)"})
    for (const bool located : {false, true}) {
      const std::string notes = notes_of(formula, located);
      EXPECT_NE(notes.find("jumps with a rate, as friction does"), std::string::npos) << formula;
      EXPECT_EQ(notes.find("divides steps"), std::string::npos) << formula;
    }
}

TEST(FormulaHints, LawsAreNotedToo) {
  const auto of_law = [](const std::string& law, bool located) {
    return notes_about("{type: force_law, joint: z, law: {formula: '" + law + "'}}", located);
  };
  EXPECT_NE(of_law("if(x < 0, -100, 0)", false).find("locate_edges: true divides steps there"),
            std::string::npos);
  EXPECT_EQ(of_law("if(x < 0, -100, 0)", true), "");
  EXPECT_NE(of_law("5 * sign(v)", true).find("jumps with a rate"), std::string::npos);
}

TEST(FormulaHints, FormulasOfTheTimeAreDividedAt) {
  EXPECT_EQ(notes_of("if(t < 0.3, 1, -1) + floor(t)", false), "");
  EXPECT_NE(notes_of("if(t == 0.3, 1, -1) + table(bent, t)", false)
                .find("corners or jumps of '==' and 'table' that steps cross"),
            std::string::npos);
}

TEST(FormulaHints, NameWhatIsNotLocated) {
  for (const bool located : {false, true}) {
    EXPECT_NE(notes_of("floor(angle(z)) + round(angle(z)) + floor(rate(z))", located)
                  .find("corners or jumps of 'floor' and 'round' that steps cross, also with"),
              std::string::npos);
    EXPECT_NE(notes_of("if(angle(z) == 1, 2, 3)", located).find("of '=='"), std::string::npos);
    EXPECT_NE(notes_of("table(bent, angle(z))", located).find("of 'table'"), std::string::npos);
    EXPECT_EQ(notes_of("table(smooth, angle(z))", located), "");
  }
}

}  // namespace
}  // namespace floatframe::test

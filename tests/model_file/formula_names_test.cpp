// Parameters that would hide the time, an input or a variable of a law in a formula.
#include <gtest/gtest.h>

#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::string named(const std::string& parameter, const std::string& force) {
  return R"(
parameters: {)" +
         parameter + R"(: 2, k: 40}
inputs: {u: {initial: 1}}
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: z}}
forces: {f: {joint: z, )" +
         force + R"(}}
simulation: {step: 0.001, duration: 0.1}
)";
}
const std::string actuator = "type: joint_spring, actuator: {formula: 'k * t + u'}",
                  law = "type: force_law, law: {formula: 'k * x + v'}";

TEST(FormulaNames, ParametersDoNotHideWhatFormulasRead) {
  for (const char* const name : {"t", "u"})
    EXPECT_TRUE(contains(error_of([&] { model_of(named(name, actuator)); }), ": wrong_value"))
        << name;
  for (const char* const name : {"x", "v"})
    EXPECT_TRUE(contains(error_of([&] { model_of(named(name, law)); }), ": wrong_value")) << name;
  EXPECT_TRUE(contains(sentences_of([&] { model_of(named("u", actuator)); }), "also an input"));
  // Where they are not read.
  for (const char* const name : {"x", "v"}) EXPECT_NO_THROW(model_of(named(name, actuator)));
  for (const char* const name : {"t", "u"}) EXPECT_NO_THROW(model_of(named(name, law)));
}

}  // namespace
}  // namespace floatframe::test

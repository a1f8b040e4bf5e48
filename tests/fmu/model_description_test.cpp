// The XML of FMUs. What the schemas say is checked in python/tests/test_fmu.py by FMPy.
#include "floatframe/fmu/model_description.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "floatframe/fmu/fmu_page.hpp"
#include "support/contains.hpp"

namespace floatframe {
namespace {

using test::contains;

Output named_output(const char* name, const char* unit) {
  Output out;
  out.name = name;
  out.unit = unit;
  return out;
}

/// Without bodies: inputs, outputs and parameters are all that the XML says.
Model bare_model() {
  Model model;
  model.name = "small car";
  model.inputs = {{.name = "throttle", .unit = "%", .initial = 10.0, .low = 0.0, .high = 100.0},
                  {.name = "rack", .unit = "mm"}};
  model.outputs = {named_output("chassis.z", "m"), named_output("wheel z", "deg"),
                   named_output("speed", "furlong")};
  model.simulation.step = 0.002;
  model.simulation.duration = 8.0;
  return model;
}

FmuContent bare_content() {
  const std::vector<PackedParameter> parameters{{"mass", "kg", "of the driver", 80.0},
                                                {"speed", "m/s", "", 5.5}};
  return fmu_content(bare_model(), parameters, "0123456789abcdef");
}

TEST(FmuContent, VariablesHaveReferencesByKind) {
  const FmuContent c = bare_content();
  EXPECT_EQ(c.identifier, "small_car");
  ASSERT_EQ(c.inputs.size(), 2u);
  EXPECT_EQ(c.inputs[1].reference, 0x10001u);
  EXPECT_EQ(c.inputs[0].high, 100.0);
  EXPECT_FALSE(c.inputs[1].high);
  ASSERT_EQ(c.outputs.size(), 3u);
  EXPECT_EQ(c.outputs[2].reference, 0x20002u);
  EXPECT_EQ(c.parameters[1].reference, 0x30001u);
  EXPECT_EQ(c.figures[4].reference, 0x40004u);
}

TEST(FmuContent, ANameThatIsTakenIsChangedAndNoted) {
  const FmuContent c = bare_content();
  EXPECT_EQ(c.outputs[2].name, "speed");
  EXPECT_EQ(c.parameters[1].name, "parameters.speed");
  EXPECT_EQ(c.parameters[1].about, "in the model: speed");
  ASSERT_EQ(c.notes.size(), 1u);
  EXPECT_TRUE(contains(c.notes[0], "parameter 'speed' is called parameters.speed")) << c.notes[0];
}

TEST(FmuContent, TheTimeHasANameOfItsOwn) {
  Model model = bare_model();
  EXPECT_EQ(fmu_content(model, {}, "").time, "time");
  model.outputs[0].name = "time";
  EXPECT_EQ(fmu_content(model, {}, "").time, "independent.time");
  model.inputs[0].name = "run.steps";
  EXPECT_EQ(fmu_content(model, {}, "").figures[0].name, "figures.run.steps");
}

TEST(ModelDescription, Fmi2) {
  const std::string xml = fmi2_model_description(bare_content());
  for (const char* part :
       {"fmiVersion=\"2.0\" modelName=\"small car\" guid=\"0123456789abcdef\"",
        "modelIdentifier=\"small_car\"", "canGetAndSetFMUstate=\"true\"",
        "canInterpolateInputs=\"false\"", "startTime=\"0\" stopTime=\"8\" stepSize=\"0.002\"",
        "<Unit name=\"%\"><BaseUnit factor=\"0.01\"/></Unit>",
        "<Unit name=\"mm\"><BaseUnit m=\"1\" factor=\"0.001\"/></Unit>", "<Unit name=\"furlong\"/>",
        "<Unit name=\"kg\"><BaseUnit kg=\"1\"/></Unit>",
        "name=\"&#39;wheel z&#39;\" valueReference=\"131073\"",
        "<Real unit=\"%\" min=\"0\" max=\"100\" start=\"10\"/>",
        "causality=\"input\" variability=\"continuous\"><Real",
        "causality=\"output\" variability=\"continuous\" initial=\"calculated\"><Real unit=\"m\"/>",
        "causality=\"parameter\" variability=\"tunable\" initial=\"exact\"><Real unit=\"kg\" "
        "start=\"80\"/>",
        // Outputs are variables 3 to 5 and depend on no input within an instant.
        "<Outputs>\n      <Unknown index=\"3\" dependencies=\"\"/>",
        "<InitialUnknowns>\n      <Unknown index=\"3\"/>", "<Unknown index=\"5\"/>"})
    EXPECT_TRUE(contains(xml, part)) << part << "\n" << xml;
}

TEST(ModelDescription, AParameterOfAWholeRunIsFixed) {
  FmuContent content = bare_content();
  content.parameters[1].fixed = true;
  for (const std::string& xml :
       {fmi2_model_description(content), fmi3_model_description(content)}) {
    EXPECT_TRUE(contains(xml, "causality=\"parameter\" variability=\"tunable\""));
    EXPECT_TRUE(contains(xml, "causality=\"parameter\" variability=\"fixed\""));
  }
  EXPECT_TRUE(contains(fmu_page(content, 2, {}, {"linux64"}), "<td>to be set"));
}

TEST(ModelDescription, Fmi3) {
  const std::string xml = fmi3_model_description(bare_content());
  for (const char* part :
       {"fmiVersion=\"3.0\" modelName=\"small car\" instantiationToken=\"0123456789abcdef\"",
        "fixedInternalStepSize=\"0.002\"", "providesIntermediateUpdate=\"true\"",
        "canReturnEarlyAfterIntermediateUpdate=\"true\"", "hasEventMode=\"false\"",
        "name=\"time\" valueReference=\"0\"", "causality=\"independent\"",
        "initial=\"calculated\" intermediateUpdate=\"true\" unit=\"m\"/>",
        "<Output valueReference=\"131072\" dependencies=\"\"/>",
        "<InitialUnknown valueReference=\"131074\"/>"})
    EXPECT_TRUE(contains(xml, part)) << part << "\n" << xml;
}

TEST(ModelDescription, TerminalsHoldInputsAndOutputs) {
  const std::string xml = fmi3_terminals(bare_content());
  EXPECT_TRUE(contains(xml, "<Terminal name=\"inputs\" matchingRule=\"bus\""));
  EXPECT_TRUE(contains(xml, "variableName=\"&#39;wheel z&#39;\""));
  Model model = bare_model();
  model.inputs.clear();
  const std::string outputs = fmi3_terminals(fmu_content(model, {}, ""));
  EXPECT_FALSE(contains(outputs, "name=\"inputs\""));
  model.outputs.clear();
  const FmuContent nothing = fmu_content(model, {}, "");
  EXPECT_FALSE(contains(fmi3_terminals(nothing), "<Terminals>"));
  EXPECT_FALSE(contains(fmi2_model_description(nothing), "<Outputs>"));
}

TEST(ModelDescription, TextsOfTheUserAreEscaped) {
  EXPECT_EQ(xml_text("a<b>&\"c'\n\t"), "a&lt;b&gt;&amp;&quot;c&#39;  ");
  EXPECT_EQ(xml_text("\x01\xff\xef\xbf\xbf"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  Model model = bare_model();
  model.name = "</fmiModelDescription><x a='\"\n\x02";
  model.inputs[0].name = "</Real><!--";
  model.inputs[0].unit = "]]>&amp;";
  model.outputs[0].name = "\"/><script>alert(1)</script>";
  const std::vector<PackedParameter> parameters{{"p", "<", "\"><b>", 1.0}};
  const FmuContent c = fmu_content(model, parameters, "t");
  for (const std::string& text : {fmi2_model_description(c), fmi3_model_description(c),
                                  fmi3_terminals(c), fmu_page(c, 3, {"<i>"}, {"linux64"})}) {
    for (const char* part : {"<script", "<x a", "<b>", "<i>", "<!--", "\x02"})
      EXPECT_FALSE(contains(text, part)) << part << "\n" << text;
  }
}

TEST(FmuPage, NamesAllVariablesAndStandsAlone) {
  const std::string page = fmu_page(bare_content(), 2, {"gravity is not tunable"}, {"linux64"});
  for (const char* part : {"throttle", "&#39;wheel z&#39;", "parameters.speed", "run.overruns",
                           "gravity is not tunable", "linux64", "Eigen", "FMI 2.0"})
    EXPECT_TRUE(contains(page, part)) << part;
  for (const char* part : {"<script", "<link", "src=", "href="}) EXPECT_FALSE(contains(page, part));
}

TEST(FmuPage, LicencesNameWhatIsInside) {
  const std::string text = fmu_licences();
  for (const char* part : {"BSD 3-Clause", "Mozilla Public License 2.0", "fmt", "ZPL 2.1"})
    EXPECT_TRUE(contains(text, part)) << part;
}

}  // namespace
}  // namespace floatframe

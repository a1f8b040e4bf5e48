// Model files that are large or odd on purpose: each is refused with a few errors after work in
// proportion to its length.
#include <gtest/gtest.h>

#include <string>

#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

const std::string body = "bodies:\n  a: {rigid: {mass: 1}, position: [0, 0, 0]}\n";

class Hostile : public testing::Test {
 protected:
  /// The errors of model.yaml with `text`, without the folder.
  std::vector<std::string> errors(const std::string& text) {
    const std::string file = folder_.write("model.yaml", "floatframe: 1\n" + text);
    std::vector<std::string> out;
    try {
      read_model(file);
    } catch (const InputError& error) {
      for (const ErrorEntry& f : error.errors()) out.push_back(folder_.without(test::code_of(f)));
    }
    return out;
  }
  /// "prefix 0 suffix", "prefix 1 suffix", ...
  static std::string many(int n, const std::string& prefix, const std::string& suffix) {
    std::string text;
    for (int k = 0; k < n; ++k) text += prefix + std::to_string(k) + suffix;
    return text;
  }

  test::TemporaryFolder folder_;
};

using Errors = std::vector<std::string>;

TEST_F(Hostile, ParametersThatDouble) {
  std::string text = "parameters:\n  a0: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\n";
  for (int k = 1; k <= 40; ++k) {
    const std::string before = "${a" + std::to_string(k - 1) + "}";
    text += "  a" + std::to_string(k) + ": " + before + before + "\n";
  }
  const Errors found = errors(text + body);
  ASSERT_EQ(found.size(), 3u);  // what follows from the first begins with a short text again
  EXPECT_EQ(found[0], "model.yaml:13:8: parameters.a10: wrong_value");
}

TEST_F(Hostile, ManyLongParameters) {
  const std::string text = "parameters:\n  long: " + std::string(8000, 'x') + "\n" +
                           many(100000, "  a", ": ${long}${long}\n");
  EXPECT_EQ(errors(text + body), Errors{"model.yaml:253:9: too_large"});
}

TEST_F(Hostile, LongTextsAndNames) {
  EXPECT_EQ(errors("name: " + std::string(20000, 'x') + "\n" + body),
            Errors{"model.yaml:2:7: out_of_range"});
  EXPECT_EQ(errors("points: {" + std::string(101, 'p') + ": [0, 0, 0]}\n" + body),
            Errors{"model.yaml:2:10: too_large"});
}

TEST_F(Hostile, UnknownKeysAreCounted) {
  for (const int n : {21, 200000}) {
    const Errors found = errors(body + many(n, "key", ": 1\n"));
    ASSERT_EQ(found.size(), 21u) << n;
    EXPECT_EQ(found[0], "model.yaml:4:1: key0: unknown_key");
    EXPECT_EQ(found[19], "model.yaml:23:1: key19: unknown_key");
    EXPECT_EQ(found[20], "model.yaml:24:1: unknown_key" +
                             (n == 21 ? "" : " (" + std::to_string(n - 20) + ")"));
  }
  const Errors inside = errors("bodies:\n  a:\n    rigid: {mass: 1}\n    position: [0, 0, 0]\n" +
                               many(100000, "    mas", ": 1\n"));
  ASSERT_EQ(inside.size(), 21u);
  EXPECT_EQ(inside[0], "model.yaml:6:5: bodies.a.mas0: unknown_key");
  EXPECT_EQ(inside[20], "model.yaml:26:5: bodies.a: unknown_key (99980)");
}

TEST_F(Hostile, UnknownReferencesAreCounted) {
  std::string text = body + "joints:\n";
  for (int k = 0; k < 15000; ++k)
    text += "  j" + std::to_string(k) + ": {type: spherical, child: b" + std::to_string(k) +
            ", at: [0, 0, 0]}\n";
  const Errors found = errors(text);
  ASSERT_EQ(found.size(), 21u);
  EXPECT_EQ(found[0], "model.yaml:5:32: joints.j0.child: not_found");
  EXPECT_EQ(found[20], "model.yaml:25:33: not_found (14980)");
}

TEST_F(Hostile, UnknownBodiesOfStartValuesAreCounted) {
  const std::string bodies =
      "bodies:\n" + many(15000, "  body", ": {rigid: {mass: 1}, position: [0, 0, 0]}\n");
  for (const bool offset : {true, false}) {
    const Errors found = errors(
        bodies +
        (offset ? "simulation: {start: {equilibrium: true, offset: {" : "initial: {amplitudes: {") +
        many(100000, "\n  bady", offset ? ": [0, 0, 0]," : ": [0],") + "}}" +
        (offset ? "}\n" : "\n"));
    ASSERT_EQ(found.size(), 21u);
    EXPECT_EQ(found[0], std::string("model.yaml:15004:3: ") +
                            (offset ? "simulation.start.offset" : "initial.amplitudes") +
                            ".bady0: not_found");
    EXPECT_EQ(found[20], "model.yaml:15024:3: not_found (99980)");
  }
}

TEST_F(Hostile, UnknownParametersAreCounted) {
  const Errors found = errors("parameters:\n" + many(30000, "  known", ": 1\n") + body +
                              "points:\n" + many(30000, "  p", ": [0, 0, \"${other}\"]\n"));
  ASSERT_EQ(found.size(), 21u);
  EXPECT_EQ(found[20], "model.yaml:30026:15: wrong_value (29980)");
}

TEST_F(Hostile, DuplicatesAreCounted) {
  std::string text = body + "points:\n";
  for (int k = 0; k < 50000; ++k) text += "  p: [0, 0, 0]\n";
  const Errors found = errors(text);
  ASSERT_EQ(found.size(), 21u);
  EXPECT_EQ(found[0], "model.yaml:6:3: duplicate");
  EXPECT_EQ(found[20], "model.yaml:26:3: duplicate (49979)");
}

TEST_F(Hostile, ManyKindsOfErrors) {
  std::string text = "bodies:\n";
  for (int k = 0; k < 2000; ++k)
    text += "  b" + std::to_string(k) + ": {rigid: {mass: x" + std::string(1 + k % 97, 'y') +
            std::string(1 + k % 89, 'z') + "}, position: [0, 0, 0], when: ${" +
            std::string(1 + k % 13, 'q') + "}}\n";
  const Errors found = errors(text);
  EXPECT_LE(found.size(), 502u);
  EXPECT_GE(found.size(), 20u);
}

TEST_F(Hostile, NestingAndBrackets) {
  const Errors deep{"model.yaml:2:53: too_large"};
  EXPECT_EQ(errors("a: " + std::string(4000000, '[') + "\n"), deep);
  EXPECT_EQ(errors("a: " + std::string(4000000, '{') + "\n"), deep);
  std::string dollars = "a: ";
  for (int k = 0; k < 200000; ++k) dollars += "$ ${x";
  dollars += "\n";
  EXPECT_FALSE(errors(dollars + body).empty());
  EXPECT_FALSE(errors("parameters: {a: \"${" + std::string(8000, '(') + "1" +
                      std::string(8000, ')') + "}\"}\n" + body)
                   .empty());
}

TEST_F(Hostile, ManyValues) {
  std::string list = "points: {p: [";
  for (int k = 0; k < 1000001; ++k) list += "0,";
  EXPECT_EQ(errors(body + list + "0]}\n"), Errors{"model.yaml:4:1999974: too_large"});
}

TEST_F(Hostile, ManyEntities) {
  const Errors found =
      errors("bodies:\n" + many(20001, "  b", ": {rigid: {mass: 1}, position: [0, 0, 0]}\n"));
  EXPECT_EQ(found, Errors{"model.yaml:20003:3: too_large"});
}

TEST_F(Hostile, ManyColumnsAndElements) {
  const Errors columns = errors(body + "outputs:\n" + many(7000, "  o", ": {position: a}\n"));
  EXPECT_EQ(columns, Errors{"model.yaml:6671:3: too_large"});
  std::string text = "points: {p: [0, 0, 0], q: [1, 0, 0]}\nbodies:\n";
  for (int k = 0; k < 500; ++k)
    text += "  b" + std::to_string(k) +
            ": {flexible: {material: {young: 1, poisson: 0, density: 1}, clamped: [p], "
            "normal_modes: 1, bars: {b: {from: p, to: q, elements: 10000, section: {round: "
            "0.1}}}}}\n";
  const Errors elements = errors(text);
  ASSERT_FALSE(elements.empty());
  EXPECT_EQ(elements[0], "model.yaml:104:135: too_large") << elements[0];
  EXPECT_LE(elements.size(), 25u);
}

TEST_F(Hostile, SubsystemsThatMultiply) {
  for (int k = 1; k <= 30; ++k) {
    const std::string next = "sub" + std::to_string(k + 1) + ".yaml";
    folder_.write("sub" + std::to_string(k) + ".yaml", "floatframe: 1\nsubsystems: {l: {file: " +
                                                           next + "}, r: {file: " + next + "}}\n");
  }
  folder_.write("sub31.yaml", "floatframe: 1\n" + body);
  const Errors found = errors("subsystems: {l: {file: sub1.yaml}, r: {file: sub1.yaml}}\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "sub29.yaml:2:24: subsystems.l.file: too_large");
}

TEST_F(Hostile, LargeSubsystemsUsedOften) {
  folder_.write("part.yaml",
                "floatframe: 1\npoints:\n" + many(20000, "  p", ": [0, 0, 0]\n") + body);
  const Errors found = errors("subsystems:\n" + many(900, "  s", ": {file: part.yaml}\n"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "part.yaml:1:1: too_large");
}

TEST_F(Hostile, ControlCharactersAreRefusedAndWrittenOut) {
  const Errors found = errors(body +
                              "outputs:\n"
                              "  \"a\\0b\": {position: a}\n"
                              "  \"c\\e[31m\": {position: a}\n"
                              "\"\\x01\": 1\n"
                              "\"\\x85\": 2\n");
  EXPECT_EQ(
      found,
      (Errors{"model.yaml:5:3: wrong_value", "model.yaml:5:3: outputs.a\\x00b: wrong_value",
              "model.yaml:6:3: wrong_value", "model.yaml:6:3: outputs.c\\x1b[31m: wrong_value",
              "model.yaml:7:1: wrong_value", "model.yaml:7:1: \\x01: unknown_key",
              "model.yaml:8:1: wrong_value", "model.yaml:8:1: \\xc2\\x85: unknown_key"}));
  const std::string said = test::sentences_of([&] { read_model(folder_.file("model.yaml")); });
  for (const char c : said)
    EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20u) << said;
  for (const char* shown : {"'a\\x00b'", "'c\\x1b[31m'", "'\\x01'", "'\\xc2\\x85'"})
    EXPECT_TRUE(test::contains(said, shown)) << shown << " in " << said;
}

TEST_F(Hostile, AColumnMayNotBeCalledTime) {
  EXPECT_EQ(errors(body + "outputs:\n  time: {position: a, axis: x}\n"),
            Errors{"model.yaml:5:3: duplicate"});
}

TEST_F(Hostile, OverrideTexts) {
  const std::string file =
      folder_.write("model.yaml", "floatframe: 1\nparameters: {road: bump}\n" + body);
  for (const std::string& value :
       {std::string("a\x1b[31m"), std::string("\xff\xfe"), std::string(20000, 'x')}) {
    const std::string said = test::sentences_of([&] { read_model(file, {{"road", value}}); });
    EXPECT_NE(said, "no error") << value.substr(0, 20);
    EXPECT_EQ(said.find('\x1b'), std::string::npos);
  }
}

}  // namespace
}  // namespace floatframe

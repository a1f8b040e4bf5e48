// Mistakes of every sort, each in a small model that is right otherwise: one sentence with its
// place, and none that only follows from the mistake.
#include <gtest/gtest.h>

#include <string>

#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

using std::string_literals::operator""s;

const std::string good_model =
    "floatframe: 1\n"
    "points: {o: [0, 0, 0], a: [1, 0, 0]}\n"
    "bodies:\n"
    "  arm: {rigid: {mass: 1, inertia: [0, 1, 1]}, position: a}\n"
    "joints:\n"
    "  pin: {type: revolute, child: arm, at: o, axis: y}\n"
    "simulation: {step: 0.001, duration: 0.01}\n";

/// What is said of a model, without the folder.
std::string said(const std::string& text) {
  const test::TemporaryFolder folder;
  return folder.without(test::error_of([&] { read_model(folder.write("m", text)); }));
}

std::string with(const std::string& before, const std::string& after) {
  std::string text = good_model;
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

TEST(OneSentence, WhatIsRight) {
  EXPECT_EQ(said(good_model), "no error");
  EXPECT_EQ(said("\xEF\xBB\xBF" + good_model), "no error");
  std::string crlf;
  for (const char c : good_model) crlf += c == '\n' ? "\r\n"s : std::string(1, c);
  EXPECT_EQ(said(crlf), "no error");
  EXPECT_EQ(said(with("mass: 1", "mass:\t1")), "no error");
  EXPECT_EQ(said(good_model + "name: \"it's \\\"quoted\\\"\"\n"), "no error");
  EXPECT_EQ(said(good_model + "name: 'it''s quoted'"), "no error");
  EXPECT_EQ(said(good_model + "name: |-\n  a block\n"), "no error");
}

TEST(OneSentence, Files) {
  EXPECT_EQ(said(""), "m:1:1: the file is empty");
  EXPECT_EQ(said("\xEF\xBB\xBF"), "m:1:1: the file is empty");
  EXPECT_EQ(said("# nothing\n"), "m:1:1: the file is empty");
  EXPECT_EQ(said("hello\n"), "m:1:1: found 'hello', expected a map of keys such as 'bodies'");
  EXPECT_EQ(said(with("pin", "p\0n"s)), "m:6:4: this is not a text file (UTF-8)");
  EXPECT_EQ(said(with("pin", "p\xe9n")), "m:6:4: this is not a text file (UTF-8)");
  EXPECT_EQ(said(with("  arm:", "\tarm:")), "m:4:1: a tab in the indentation, use spaces");
  std::string cr;
  for (const char c : good_model) cr += c == '\n' ? '\r' : c;
  EXPECT_EQ(said(cr),
            "m:1:14: a carriage return without a line feed, expected lines that end with LF or "
            "CRLF");
  for (const std::string text : {"\"abc", "'abc''", "\"abc\\\"", "\"abc\nsecond line"}) {
    EXPECT_EQ(said(good_model + "name: " + text + "\n"),
              "m:8:7: the text in quotes that begins here is not closed");
    const std::string end = said(good_model + "name: " + text);
    EXPECT_TRUE(end.starts_with("m:") && end.ends_with(": a text in quotes is not closed")) << end;
  }
}

TEST(OneSentence, Scalars) {
  const auto mass = [](const std::string& text) { return said(with("mass: 1", "mass: " + text)); };
  const std::string path = "m:4:23: bodies.arm.rigid.mass: found ",
                    expected = ", expected a number >= 0 [kg]";
  EXPECT_EQ(mass("nan"), path + "nan" + expected + " (numbers must be finite)");
  EXPECT_EQ(mass("1e999"), path + "1e999" + expected + " (numbers must be finite)");
  EXPECT_EQ(mass("1 kg"), path + "'1 kg'" + expected);
  EXPECT_EQ(mass("\u22121"), path + "'\u22121'" + expected) << "a minus sign of typography";
  EXPECT_EQ(mass("\uff11"), path + "'\uff11'" + expected) << "a wide digit";
  EXPECT_EQ(mass("[1, 2]"), path + "a list of 2" + expected);
  EXPECT_EQ(mass("{a: 1}"), path + "a map" + expected);
  EXPECT_EQ(mass("true"), path + "true" + expected);
  EXPECT_EQ(mass("${1/0}"), "m:4:23: bodies.arm.rigid.mass: in ${1/0}: division by zero");
  EXPECT_EQ(said(with("revolute", "\"\\e[31mred\"")),
            "m:6:15: found the text '\\x1b[31mred', expected no control characters");
  EXPECT_EQ(said(good_model + "name: \"a\\x07\"\n"),
            "m:8:7: found the text 'a\\x07', expected no control characters");
}

TEST(OneSentence, Names) {
  std::string other = good_model;
  for (std::size_t at = other.find("arm"); at != std::string::npos; at = other.find("arm"))
    other.replace(at, 3, "\u00e4rm");
  EXPECT_EQ(said(other),
            "m:4:3: bodies: found the name '\u00e4rm', expected letters, digits, _ and -, with a "
            "letter first");
  EXPECT_EQ(said(with("child: arm", "child: amr")),
            "m:6:32: joints.pin.child: unknown body 'amr', did you mean 'arm'?");
  EXPECT_EQ(said(good_model + "bodies: {}\n"),
            "m:8:1: duplicate key 'bodies', first used in line 3");
  EXPECT_EQ(said(good_model + "outputs: {time: {position: arm, axis: x}}\n"),
            "m:8:11: outputs: found the column 'time', the name of the first column, expected "
            "another");
}

TEST(OneSentence, Groups) {
  const auto body = [](const std::string& text) {
    return said(with("rigid: {mass: 1, inertia: [0, 1, 1]}", text));
  };
  for (const char* group : {"{}", "{mesh: a.inp}"})
    EXPECT_EQ(body(std::string("flexible: ") + group),
              "m:4:9: bodies.arm.flexible: found neither 'bars' nor 'file', expected one of them");
  EXPECT_EQ(body("part: none.ffb"), "m:4:15: bodies.arm.part: none.ffb: the file does not exist");
  const auto start = [](const std::string& text) {
    return said(with("duration: 0.01", "start: " + text));
  };
  EXPECT_EQ(start("{}"),
            "m:7:34: simulation.start: found a map, expected given, equilibrium, or a map with "
            "equilibrium or state");
  EXPECT_EQ(start("{equilibrium: true, offset: {amr: [1, 2, 3]}}"),
            "m:7:63: simulation.start.offset.amr: unknown body 'amr', did you mean 'arm'?");
  EXPECT_EQ(start("{equilibrium: true, offset: {ground: [1, 2, 3]}}"),
            "m:7:63: simulation.start.offset.ground: found ground, expected a body");
}

}  // namespace
}  // namespace floatframe

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

TEST(OneError, ValidModelsHaveNone) {
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

TEST(OneError, Files) {
  EXPECT_EQ(said(""), "m:1:1: missing");
  EXPECT_EQ(said("\xEF\xBB\xBF"), "m:1:1: missing");
  EXPECT_EQ(said("# nothing\n"), "m:1:1: missing");
  EXPECT_EQ(said("hello\n"), "m:1:1: wrong_value");
  EXPECT_EQ(said(with("pin", "p\0n"s)), "m:6:4: wrong_file");
  EXPECT_EQ(said(with("pin", "p\xe9n")), "m:6:4: wrong_file");
  EXPECT_EQ(said(with("  arm:", "\tarm:")), "m:4:1: wrong_file");
  std::string cr;
  for (const char c : good_model) cr += c == '\n' ? '\r' : c;
  EXPECT_EQ(said(cr), "m:1:14: wrong_file");
  for (const std::string text : {"\"abc", "'abc''", "\"abc\\\"", "\"abc\nsecond line"}) {
    EXPECT_EQ(said(good_model + "name: " + text + "\n"), "m:8:7: wrong_file");
    const std::string end = said(good_model + "name: " + text);
    EXPECT_TRUE(end.starts_with("m:") && end.ends_with(": wrong_file")) << end;
  }
}

TEST(OneError, Scalars) {
  const auto mass = [](const std::string& text) { return said(with("mass: 1", "mass: " + text)); };
  const std::string at = "m:4:23: bodies.arm.rigid.mass: ";
  EXPECT_EQ(mass("nan"), at + "not_a_number");
  EXPECT_EQ(mass("1e999"), at + "not_a_number");
  EXPECT_EQ(mass("1 kg"), at + "not_a_number");
  EXPECT_EQ(mass("\u22121"), at + "not_a_number") << "a minus sign of typography";
  EXPECT_EQ(mass("\uff11"), at + "not_a_number") << "a wide digit";
  EXPECT_EQ(mass("[1, 2]"), at + "wrong_value");
  EXPECT_EQ(mass("{a: 1}"), at + "wrong_value");
  EXPECT_EQ(mass("true"), at + "not_a_number");
  EXPECT_EQ(mass("${1/0}"), "m:4:23: bodies.arm.rigid.mass: wrong_value");
  EXPECT_EQ(said(with("revolute", "\"\\e[31mred\"")), "m:6:15: wrong_value");
  EXPECT_EQ(said(good_model + "name: \"a\\x07\"\n"), "m:8:7: wrong_value");
}

TEST(OneError, Names) {
  std::string other = good_model;
  for (std::size_t at = other.find("arm"); at != std::string::npos; at = other.find("arm"))
    other.replace(at, 3, "\u00e4rm");
  EXPECT_EQ(said(other), "m:4:3: wrong_value");
  EXPECT_EQ(said(with("child: arm", "child: amr")), "m:6:32: joints.pin.child: not_found");
  EXPECT_EQ(said(good_model + "bodies: {}\n"), "m:8:1: duplicate");
  EXPECT_EQ(said(good_model + "outputs: {time: {position: arm, axis: x}}\n"), "m:8:11: duplicate");
}

TEST(OneError, Groups) {
  const auto body = [](const std::string& text) {
    return said(with("rigid: {mass: 1, inertia: [0, 1, 1]}", text));
  };
  for (const char* group : {"{}", "{mesh: a.inp}"})
    EXPECT_EQ(body(std::string("flexible: ") + group), "m:4:9: bodies.arm.flexible: missing");
  EXPECT_EQ(body("part: none.ffb"), "m:4:15: bodies.arm.part: unreadable");
  const auto start = [](const std::string& text) {
    return said(with("duration: 0.01", "start: " + text));
  };
  EXPECT_EQ(start("{}"), "m:7:34: simulation.start: wrong_value");
  EXPECT_EQ(start("{equilibrium: true, offset: {amr: [1, 2, 3]}}"),
            "m:7:63: simulation.start.offset.amr: not_found");
  EXPECT_EQ(start("{equilibrium: true, offset: {ground: [1, 2, 3]}}"),
            "m:7:63: simulation.start.offset.ground: wrong_value");
}

}  // namespace
}  // namespace floatframe

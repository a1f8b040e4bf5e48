// What a program may do wrong with a simulation ends in an InputError or a status that says what
// was expected, and leaves the simulation as it was: it goes on with the same bits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/run/run.hpp"
#include "support/coordinates.hpp"
#include "support/error_of.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::ptrdiff_t least = std::numeric_limits<std::ptrdiff_t>::min();
constexpr std::ptrdiff_t most = std::numeric_limits<std::ptrdiff_t>::max();

const Model& machine_model() {
  static const Model m = model_of(stepped_machine);
  return m;
}

/// The code of the InputError; nothing may have changed.
struct Misuse {
  std::function<void(Simulation&)> action;
  std::string expected;
};

void expect_refused(const std::vector<Misuse>& cases) {
  Simulation s(machine_model()), other(machine_model());
  trace(s, 0, 3);
  trace(other, 0, 3);
  int number = 0;
  for (const Misuse& m : cases) {
    EXPECT_EQ(error_of([&] { m.action(s); }), m.expected) << "case " << number;
    ++number;
  }
  EXPECT_TRUE(equal_bits(trace(s, 3, 6), trace(other, 3, 6)));
}

TEST(SteppingMisuse, Inputs) {
  std::vector<Misuse> cases;
  const auto add = [&](auto which, double value, const std::string& expected) {
    cases.push_back({[=](Simulation& s) { s.set_input(which, value); }, expected});
  };
  for (const double x : {not_a_number, infinite, -infinite, 50.000001, -51.0, 1e308}) {
    add(0, x, "out_of_range");
    add("push", x, "out_of_range");
  }
  for (const double x : {not_a_number, infinite, -infinite}) {
    add("aim", x, "out_of_range");
    add("shove", x, "out_of_range");
  }
  for (const std::ptrdiff_t k : {std::ptrdiff_t{-1}, std::ptrdiff_t{3}, std::ptrdiff_t{4}, least,
                                 most, std::ptrdiff_t{1} << 32, -(std::ptrdiff_t{1} << 32)})
    add(k, 0.0, "out_of_range");
  for (const char* name : {"", "PUSHES", "push ", "spin", "push\n", "pull.push", "0"})
    add(name, 0.0, "not_found");
  add("psuh", 0.0, "not_found");
  add(std::string(100000, 'x'), 0.0, "not_found");
  add(std::string("push\0", 5), 0.0, "not_found");
  EXPECT_GE(cases.size(), 30u);
  expect_refused(cases);
}

TEST(SteppingMisuse, Outputs) {
  std::vector<Misuse> cases;
  const auto n = static_cast<std::ptrdiff_t>(machine_model().outputs.size());
  for (const std::ptrdiff_t k :
       {std::ptrdiff_t{-1}, n, n + 1, least, most, std::ptrdiff_t{1} << 32})
    cases.push_back({[=](Simulation& s) { s.output(k); }, "out_of_range"});
  for (const char* name : {"", "time", "push", "spin ", "Spin_", "tip."})
    cases.push_back({[=](Simulation& s) { s.output(name); }, "not_found"});
  cases.push_back({[](Simulation& s) { s.output("psin"); }, "not_found"});
  expect_refused(cases);
}

TEST(SteppingMisuse, ModelsWithoutInputsAndOutputs) {
  Model m = machine_model();
  m.outputs.clear();
  Simulation s(m);
  EXPECT_EQ(error_of([&] { s.output(0); }), "missing");
  EXPECT_EQ(error_of([&] { s.output("spin"); }), "not_found");
  EXPECT_TRUE(s.outputs().empty());
  EXPECT_TRUE(s.step());
}

TEST(SteppingMisuse, SizesOfSteps) {
  Simulation s(machine_model()), other(machine_model());
  const double tiny = std::numeric_limits<double>::denorm_min();
  trace(s, 0, 3);
  trace(other, 0, 3);
  for (const double h :
       {not_a_number, infinite, -infinite, 0.0, -0.0, -1e-3, -1e308, tiny, 1e-30}) {
    const StepReport r = s.step(h);
    EXPECT_EQ(r.status, StepStatus::invalid_step) << h;
    EXPECT_EQ(r.time, s.time());
    EXPECT_EQ(s.failure().substr(0, 13), "found a step ") << h;
  }
  EXPECT_TRUE(equal_bits(trace(s, 3, 6), trace(other, 3, 6)));
  EXPECT_EQ(s.failure(), "");
  const StepReport r = s.step(1e300);  // a number, but no step
  EXPECT_FALSE(r);
  EXPECT_NE(s.failure(), "");
  EXPECT_EQ(s.step().status, StepStatus::failed_before);
}

TEST(SteppingMisuse, Options) {
  struct Case {
    std::string key;
    std::function<void(SimulationOptions&, double)> set;
    std::vector<double> values;
  };
  const double n = not_a_number, i = infinite;
  const std::vector<Case> cases = {
      {"step", [](auto& o, double x) { o.step = x; }, {n, i, -i, 0.0, -1e-3}},
      {"tolerance", [](auto& o, double x) { o.tolerance = x; }, {n, i, 0.0, -1.0, 2.0, 1e-16}},
      {"spectral_radius", [](auto& o, double x) { o.spectral_radius = x; }, {n, i, -0.1, 1.1}},
      {"min_step", [](auto& o, double x) { o.min_step = x; }, {n, i, -1.0, 1.0}},
      {"penalty", [](auto& o, double x) { o.penalty = x; }, {n, i, -1.0}},
      {"position_tolerance",
       [](auto& o, double x) { o.position_tolerance = x; },
       {n, i, 0.0, -1.0}},
      {"velocity_tolerance",
       [](auto& o, double x) { o.velocity_tolerance = x; },
       {n, i, 0.0, -1.0}},
      {"max_iterations",
       [](auto& o, double x) { o.max_iterations = static_cast<int>(x); },
       {0.0, -1.0, 1001.0}},
      {"coordinates",
       [](auto& o, double x) { o.coordinates = static_cast<Coordinates>(static_cast<int>(x)); },
       {-1.0, 2.0, 1000.0}},
      {"inertia",
       [](auto& o, double x) { o.inertia = static_cast<InertiaMethod>(static_cast<int>(x)); },
       {-1.0, 2.0, 1000.0}},
      {"start",
       [](auto& o, double x) { o.start = static_cast<Start>(static_cast<int>(x)); },
       {-1.0, 2.0, 3.0}}};  // 2: no state
  for (const Case& c : cases)
    for (const double x : c.values) {
      SimulationOptions o;
      c.set(o, x);
      const std::string text = error_of([&] { Simulation(machine_model(), o); });
      EXPECT_TRUE(text.starts_with("simulation." + c.key + ": ")) << text << " for " << x;
    }
  SimulationOptions o;
  o.state = std::make_shared<SystemState>();  // of no model
  EXPECT_EQ(error_of([&] { Simulation(machine_model(), o); }), "duplicate");
}

TEST(SteppingMisuse, Callbacks) {
  Simulation s(machine_model()), other(machine_model());
  trace(s, 0, 3);
  trace(other, 0, 3);
  const auto expect = [&](StepStatus status, const Simulation::ForceCallback& f,
                          const std::string& text) {
    s.on_force(f);
    const StepReport r = s.step();
    EXPECT_EQ(r.status, status) << step_status_name(r.status);
    EXPECT_EQ(s.failure().substr(0, text.size()), text);
    return r;
  };
  for (const double x : {not_a_number, infinite, -infinite, 51.0}) {
    const StepReport r = expect(
        StepStatus::invalid_input, [x](double, auto, std::span<double> u) { u[0] = x; },
        "input 'push': the force callback gave " + fmt::format("{:g}", x) + " at t = 0.006 s");
    EXPECT_EQ(r.where, "input 'push'");
  }
  expect(
      StepStatus::callback_failed, [](double, auto, auto) { throw std::runtime_error("no more"); },
      "the force callback threw an exception at t = 0.006 s: no more");
  expect(
      StepStatus::callback_failed, [](double, auto, auto) { throw 7; },
      "the force callback threw an exception at t = 0.006 s: of an unknown type");
  std::vector<std::string> inside;
  const SimulationState saved = s.save();
  s.on_force([&](double, auto, auto) {
    inside.push_back(step_status_name(s.step().status));
    inside.push_back(step_status_name(s.step(1e-3).status));
    for (const std::function<void()>& f : std::vector<std::function<void()>>{
             [&] { s.set_input(0, 1.0); }, [&] { s.set_input("push", 1.0); }, [&] { s.save(); },
             [&] { s.restore(saved); }, [&] { s.state(); }, [&] { s.on_force(nullptr); }})
      inside.push_back(error_of(f));
  });
  drive_inputs(s, 3);
  drive_inputs(other, 3);
  EXPECT_TRUE(s.step());
  EXPECT_TRUE(other.step());
  EXPECT_EQ(inside, (std::vector<std::string>{"busy", "busy", "in_use", "in_use", "in_use",
                                              "in_use", "in_use", "in_use"}));
  s.on_force(nullptr);
  EXPECT_TRUE(equal_bits(trace(s, 4, 7), trace(other, 4, 7)));
}

TEST(SteppingMisuse, StatesOfOtherSimulations) {
  std::vector<Misuse> cases;
  const auto add = [&](const Model& m, const SimulationOptions& o) {
    const SimulationState state = Simulation(m, o).save();
    cases.push_back({[state](Simulation& s) { s.restore(state); }, "mismatch"});
  };
  cases.push_back({[](Simulation& s) { s.restore({}); }, "missing"});
  cases.push_back({[](Simulation&) { SimulationState().to_bytes(); }, "missing"});
  const std::vector<std::function<void(Model&)>> changes = {
      [](Model& m) { m.gravity.z() = -9.82; },
      [](Model& m) { m.elements[0].name = "other"; },
      [](Model& m) { m.elements[0].laws[0] = PiecewisePolynomial::linear(3.0000001, 0.0); },
      [](Model& m) { m.inputs[0].high = 51.0; },
      [](Model& m) { m.outputs.pop_back(); },
      [](Model& m) {
        m.elements[m.joints[0].motion].signals[0].function.sines.emplace_back().phase = 0.1;
      },
      [](Model& m) { m.bodies[0].length *= 2.0; },
      [](Model& m) { m.markers[0].X_NM.p.x() += 1e-9; }};
  for (const auto& change : changes) {
    Model m = machine_model();
    change(m);
    add(m, {});
  }
  const auto option = [&](const std::function<void(SimulationOptions&)>& change) {
    SimulationOptions o;
    change(o);
    add(machine_model(), o);
  };
  option([](auto& o) { o.step = 0.0021; });
  option([](auto& o) { o.coordinates = Coordinates::absolute; });
  option([](auto& o) { o.inertia = InertiaMethod::projection; });
  option([](auto& o) { o.tolerance = 1e-8; });
  option([](auto& o) { o.spectral_radius = 0.9; });
  option([](auto& o) { o.max_iterations = 21; });
  option([](auto& o) { o.min_step = 1e-4; });
  option([](auto& o) { o.penalty = 1e12; });
  option([](auto& o) { o.position_tolerance = 2e-9; });
  option([](auto& o) { o.velocity_tolerance = 2e-8; });
  option([](auto& o) { o.locate_edges = true; });
  option([](auto& o) { o.input = InputUse::ramp; });
  expect_refused(cases);
  // The values a run starts from are no part of the model's motion.
  Model m = machine_model();
  m.joints[4].position = {0.5};
  Simulation elsewhere(m), s(machine_model());
  s.restore(elsewhere.save());
  EXPECT_TRUE(equal_bits(trace(s, 0, 3), trace(elsewhere, 0, 3)));
}

/// The bytes with a checksum that fits.
std::vector<std::byte> sealed(std::vector<std::byte> bytes) {
  const std::size_t n = bytes.size() - 32;
  const std::string sum = content_hash({reinterpret_cast<const char*>(bytes.data()), n});
  for (std::size_t k = 0; k < 32; ++k) bytes[n + k] = static_cast<std::byte>(sum[k]);
  return bytes;
}

TEST(SteppingMisuse, DamagedBytes) {
  Simulation s(machine_model());
  trace(s, 0, 3);
  const std::vector<std::byte> bytes = s.save().to_bytes();
  const auto refused = [](std::vector<std::byte> b) {
    return error_of([&] { SimulationState::from_bytes(b); });
  };
  EXPECT_EQ(refused(bytes), "no error");
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    auto part = bytes;
    part.resize(n);
    EXPECT_NE(refused(part), "no error") << n;
    if (n > 48) {
      EXPECT_NE(refused(sealed(part)), "no error") << n;
    }
    auto flipped = bytes;
    flipped[n] ^= std::byte{0x10};
    EXPECT_NE(refused(flipped), "no error") << n;
  }
  auto more = bytes;
  more.insert(more.end() - 32, 8, std::byte{});
  EXPECT_EQ(refused(sealed(more)), "damaged");
  auto newer = bytes;
  newer[8] = std::byte{6};
  EXPECT_EQ(refused(sealed(newer)), "mismatch");
  EXPECT_EQ(refused({}).substr(0, 43), "wrong_file");
}

/// Every word of a state replaced by one that cannot be, with a checksum that fits: refused, or the
/// next steps end with a status.
TEST(SteppingMisuse, ForgedBytes) {
  for (const Coordinates c : both_coordinates) {
    SimulationOptions o;
    o.coordinates = c;
    o.min_step = 5e-4;  // steps that cannot be are given up soon
    Simulation s(machine_model(), o);
    trace(s, 0, 3);
    const SimulationState saved = s.save();
    const std::vector<double> expected = trace(s, 3, 5);
    const std::vector<std::byte> bytes = saved.to_bytes();
    const std::uint64_t words[] = {0x7ff8000000000000u,
                                   0x7ff0000000000000u,
                                   0xffffffffffffffffu,
                                   0x7fe1ccf385ebc8a0u,
                                   0x7fffffffffffffffu,
                                   0u,
                                   1u};
    int errors = 0, stepped = 0;
    for (std::size_t at = 16; at + 8 <= bytes.size() - 32; at += 8)
      for (const std::uint64_t word : words) {
        auto forged = bytes;
        for (std::size_t k = 0; k < 8; ++k)
          forged[at + k] = static_cast<std::byte>(word >> (8 * k));
        try {
          s.restore(SimulationState::from_bytes(sealed(forged)));
          s.step();
          s.failure();
          ++stepped;
        } catch (const InputError&) {
          ++errors;
        }
      }
    EXPECT_GT(errors, 300);
    EXPECT_GT(stepped, 100);
    s.restore(saved);
    EXPECT_TRUE(equal_bits(trace(s, 3, 5), expected));
  }
}

}  // namespace
}  // namespace floatframe::test

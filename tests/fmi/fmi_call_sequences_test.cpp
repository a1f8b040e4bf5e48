// Random sequences of calls against the state machines of FMI 2.0 and 3.0: each call has the
// status that a model of the state machine expects, which knows nothing of the code it judges. It
// is the table of the standards in letters: I instantiated, N initialization mode, S step mode, T
// terminated, E error (FMI 3: T).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "fmi/versions.hpp"

namespace floatframe::testing {
namespace {

template <class Fmi>
class CallSequence {
 public:
  explicit CallSequence(unsigned seed) : random_(seed) {}
  ~CallSequence() { Fmi::free(c_); }

  void run(int calls) {
    make();
    for (int k = 0; k < calls && !::testing::Test::HasFailure(); ++k) call();
  }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  struct Expected {
    char state = 'I';
    double time = 0.0, stop = INFINITY;
    bool started = false;   // outputs have values
    bool no_start = false;  // input 1 has the value from which none is found
  };
  struct Kept {
    void* state = nullptr;
    Expected expected;
  };

  unsigned below(unsigned n) { return unsigned(random_() % n); }
  bool in(const char* states) const {
    return std::string(states).find(now_.state) != std::string::npos;
  }

  void make() {
    Fmi::free(c_);
    c_ = Fmi::make(heard_, below(2) == 0);
    ASSERT_NE(c_, nullptr);
    now_ = {};
    kept_.assign(3, {});
  }

  /// The judgement: `good` is expected if the call is allowed and its arguments are right.
  bool judge(const char* what, int status, bool is_right, int good = ok) {
    EXPECT_EQ(status, is_right ? good : error)
        << what << " in state " << now_.state << " at " << now_.time;
    if (!is_right) now_.state = Fmi::version == 2 ? 'E' : 'T';
    return is_right;
  }

  /// Half of the calls go on as importers do: without them a sequence is soon over.
  void call() {
    is_sane_ = below(2) == 0;
    if (is_sane_) {
      if (in("I")) return begin();
      if (in("N")) return exit();
      if (in("S")) return step();
      if (judge("reset", Fmi::reset(c_), true)) now_ = {};
      return;
    }
    switch (below(14)) {
      case 0:
        return logging();
      case 1:
      case 2:
        return begin();
      case 3:
      case 4:
        return exit();
      case 5:
        return below(4) == 0 ? end() : step();
      case 6:
        return get();
      case 7:
        return set();
      case 8:
        return keep();
      case 9:
        return bytes();
      case 10:
        return below(4) == 0 ? strange() : step();
      default:
        return step();
    }
  }

  void logging() {
    const char* const names[] = {"logStatusError", "logOverrun", nullptr, "logFun"};
    const bool on = below(2) == 0;
    const unsigned n = below(5);
    judge("log", Fmi::log(c_, on, n, names), true, on && n > 2 ? warning : ok);
  }

  void begin() {
    static constexpr double starts[] = {0.0, 0.0, 0.0, 2.5, nan};
    const double start = starts[below(is_sane_ ? 3 : 5)];
    const bool has_stop = !is_sane_ && below(3) == 0;
    const double stop = below(3) == 0 ? start - 1.0 : start + 0.2;
    const bool right = in("I") && std::isfinite(start) && !(has_stop && !(stop >= start));
    const int good = start == 0.0 ? ok : warning;
    const auto note = [&] {
      now_.time = start;
      now_.stop = has_stop ? stop : INFINITY;
    };
    if constexpr (Fmi::version == 2) {
      if (!is_sane_ && below(2) == 0) {
        if (judge("set up", Fmi::set_up(c_, start, has_stop, stop), right, good)) note();
        return;
      }
      if (judge("enter", Fmi::enter(c_), in("I"))) now_.state = 'N';
    } else if (judge("enter", Fmi::enter(c_, start, has_stop, stop), right, good)) {
      note();
      now_.state = 'N';
    }
  }

  void exit() {
    if (!judge("exit", Fmi::exit(c_), in("N") && (now_.started || !now_.no_start))) return;
    now_.state = 'S';
    now_.started = true;
  }

  void end() {
    if (below(2) == 0) {
      if (judge("terminate", Fmi::terminate(c_), in("S"))) now_.state = 'T';
    } else if (judge("reset", Fmi::reset(c_), true)) {
      now_ = {};
    }
  }

  void get() {
    static constexpr std::uint32_t all[] = {
        0, input0 + 1, output0, output0 + 2, parameter0 + 2, figure0 + 4, output0 + 3, 7, 0x50000};
    const unsigned which = below(9);
    double value = 0.0;
    const unsigned count = below(4) == 0 ? 0 : 1;
    const bool null = below(10) == 0;
    if (below(8) == 0) {  // integers: there are none
      judge("get other", Fmi::get_other(c_, &all[which], count), count == 0);
      return;
    }
    const bool is_output = which == 2 || which == 3;
    const bool can_start = now_.state == 'N' && !now_.no_start;
    const bool right =
        count == 0 || (!null && which < 6 && !(is_output && !now_.started && !can_start));
    if (judge("get", Fmi::get(c_, &all[which], count, null ? nullptr : &value), right) &&
        count > 0) {
      if (is_output) now_.started = true;
      if (which == 0) {
        EXPECT_NEAR(value, now_.time, 1e-12);
      }
      if (is_output) {
        EXPECT_TRUE(std::isfinite(value));
      }
    }
  }

  void set() {
    static constexpr std::uint32_t all[] = {input0,  input0 + 1, parameter0, parameter0 + 1,
                                            output0, 0,          input0 + 2};
    static constexpr double values[] = {5.0, 200.0, 666.0, nan, 5000.0};
    const unsigned which = below(7), v = below(5);
    const bool outside = which == 1 && v == 4;
    const bool null = below(10) == 0;
    const bool right = in("INS") && !null && which < 4 && v != 3;
    const int good = outside ? discard : which == 0 && v != 0 ? warning : ok;  // clamped
    if (!judge("set", Fmi::set(c_, &all[which], 1, null ? nullptr : &values[v]), right, good))
      return;
    if (outside) return;
    if (now_.state != 'S') now_.started = false;
    if (which == 1) now_.no_start = v == 2;
  }

  void keep() {
    Kept& slot = kept_[below(3)];
    int foreign = 0;
    void* unknown = &foreign;
    switch (below(4)) {
      case 0:
        if (judge("get state", Fmi::get_state(c_, &slot.state), true)) slot.expected = now_;
        return;
      case 1:
        if (judge("set state", Fmi::set_state(c_, slot.state), slot.state != nullptr))
          now_ = slot.expected;
        return;
      case 2:
        judge("free state", Fmi::free_state(c_, &slot.state), true);
        EXPECT_EQ(slot.state, nullptr);
        return;
      default:
        switch (below(4)) {
          case 0:
            judge("get into unknown", Fmi::get_state(c_, &unknown), false);
            return;
          case 1:
            judge("set unknown", Fmi::set_state(c_, unknown), false);
            return;
          case 2:
            judge("free unknown", Fmi::free_state(c_, &unknown), false);
            return;
          default:
            judge("get into NULL", Fmi::get_state(c_, nullptr), false);
            return;
        }
    }
  }

  void bytes() {
    Kept& slot = kept_[below(3)];
    std::size_t size = 0;
    const bool known = slot.state != nullptr;
    if (!judge("size", Fmi::size(c_, slot.state, &size), known)) return;
    std::vector<std::uint8_t> text(size + 1);
    const std::size_t room = size + (below(4) == 0 ? 1 : 0);
    if (!judge("write", Fmi::write(c_, slot.state, text.data(), room), room == size)) return;
    const bool damaged = below(3) == 0;
    if (damaged) text[below(unsigned(size))] ^= 0x10;
    Kept& other = kept_[below(3)];
    if (!judge("read", Fmi::read(c_, text.data(), size, &other.state), !damaged)) return;
    other.expected = slot.expected;
  }

  void step() {
    static constexpr double sizes[] = {0.01, 0.05, 0.013, 0.004, 0.0, -0.01, nan, INFINITY};
    const double h = sizes[below(!is_sane_ && below(4) == 0 ? 8 : 4)];
    const double at = now_.time + (!is_sane_ && below(4) == 0 ? 0.3 : 0.0);
    const bool right =
        in("S") && at == now_.time && h > 0.0 && h < 1.0 && at + h <= now_.stop + 1e-5;
    if (judge("step", Fmi::step(c_, at, h), right)) now_.time = at + h;
  }

  void strange() {
    if (below(4) == 0) return make();
    if (below(2) == 0) {
      judge("never", Fmi::never(c_, below(Fmi::never_count)), false);
      return;
    }
    double value = 0.0;
    EXPECT_EQ(Fmi::get(nullptr, nullptr, 1, &value), error);
    EXPECT_EQ(Fmi::step(nullptr, 0.0, 0.1), error);
    EXPECT_EQ(Fmi::reset(nullptr), error);
    EXPECT_EQ(Fmi::never(nullptr, below(Fmi::never_count)), error);
    Fmi::free(nullptr);
  }

  bool is_sane_ = false;
  std::mt19937 random_;
  Heard heard_;
  void* c_ = nullptr;
  Expected now_;
  std::vector<Kept> kept_;
};

template <class Fmi>
void run_sequences() {
  const char* const text = std::getenv("FLOATFRAME_RANDOM");
  const int count = text != nullptr ? std::atoi(text) : 1000;
  for (int seed = 0; seed < count && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    CallSequence<Fmi>(unsigned(seed)).run(60);
  }
  EXPECT_EQ(open_fakes(), 0);
  EXPECT_GT(fake_steps(), 10 * count);  // not only refusals
}

TEST(FmiCallSequences, OfFmi2HaveTheStatusOfItsStateMachine) { run_sequences<Fmi2>(); }
TEST(FmiCallSequences, OfFmi3HaveTheStatusOfItsStateMachine) { run_sequences<Fmi3>(); }

}  // namespace
}  // namespace floatframe::testing

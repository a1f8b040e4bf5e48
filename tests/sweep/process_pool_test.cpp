// Worker processes: what a request may do to its worker, and what is said about it.
#include "floatframe/sweep/process_pool.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

#include "floatframe/run/run.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

const std::atomic<bool> go_on{false};

/// Counts in memory that all processes see.
class Shared {
 public:
  Shared()
      : count_(new (::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE,
                           MAP_SHARED | MAP_ANONYMOUS, -1, 0)) std::atomic<int>{0}) {}
  std::atomic<int>& count() const { return *count_; }

 private:
  std::atomic<int>* count_;
};

int requests_here = 0;  // in each worker its own

void fill_memory() {
  for (std::vector<std::unique_ptr<char[]>> blocks;;) {
    constexpr std::size_t size = 1 << 20;
    blocks.push_back(std::make_unique<char[]>(size));
    for (std::size_t k = 0; k < size; k += 1024) blocks.back()[k] = 'x';
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

// Not for the compiler to see through.
void take_memory_that_is_not_there() {
  volatile std::size_t size = std::size_t{1} << 62;
  std::vector<char> block(size);
  (void)block;
}
void take_it_where_nothing_may_be_thrown() noexcept { take_memory_that_is_not_there(); }

std::string work(const std::string& request, WorkerState& state, const SharedFlags& flags) {
  ++requests_here;
  state.progress.store(0.5);
  if (request == "pid") return std::to_string(::getpid());
  if (request == "count") return std::to_string(requests_here);
  if (request == "segv") std::raise(SIGSEGV);
  if (request == "kill") ::kill(::getpid(), SIGKILL);
  if (request == "abort") std::abort();
  if (request == "exit") std::_Exit(3);
  if (request == "throw") throw std::runtime_error("a reason");
  if (request == "throw a number") throw 3;
  if (request == "too much") take_memory_that_is_not_there();
  if (request == "too much, noexcept") take_it_where_nothing_may_be_thrown();
  if (request == "fill") fill_memory();
  if (request == "crash unless new" && requests_here > 1) std::raise(SIGSEGV);
  if (request == "for ever")
    while (true) ::pause();
  if (request == "until given up")
    while (!flags.give_up.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return "done " + request;
}

std::string lost(ProcessPool& pool, const std::string& request) {
  const auto answer = pool.ask(0, request, go_on);
  return answer->lost.empty() ? "answered " + answer->text : answer->lost;
}

TEST(ProcessPool, AnswersOfAnySizeFromAllWorkers) {
  ProcessPool pool(3, {}, [](const std::string& request, WorkerState&, const SharedFlags&) {
    return std::string(std::stoul(request), '\0') + std::to_string(::getpid());
  });
  std::set<std::string> processes;
  for (const std::string size : {"0", "4000", "3000000"}) {
    for (int k = 0; k < 3; ++k) pool.give(k, size);
    for (int left = 3; left > 0;)
      for (const ProcessPool::Answer& answer : pool.answers(std::chrono::milliseconds(1000))) {
        EXPECT_EQ(answer.request, size);
        EXPECT_EQ(answer.text.find_first_not_of('\0'), std::stoul(size));
        processes.insert(answer.text.substr(std::stoul(size)));
        --left;
      }
    EXPECT_TRUE(pool.all_idle());
  }
  EXPECT_EQ(processes.size(), 3u);
  EXPECT_FALSE(processes.contains(std::to_string(::getpid())));
}

TEST(ProcessPool, WhateverARequestDoesTheNextIsAnswered) {
  ProcessPool pool(1, {}, work);
  for (const auto& [request, reason] : std::vector<std::pair<std::string, std::string>>{
           {"segv", "crashed with signal SEGV (segmentation fault)"},
           {"kill",
            "crashed with signal KILL (killed from outside, by the system if memory ran out)"},
           {"abort", "crashed with signal ABRT (aborted)"},
           {"exit", "ended the process with exit code 3"},
           {"throw", "ended by an exception: a reason"},
           {"throw a number", "ended by an exception: an exception of an unknown kind"}}) {
    EXPECT_EQ(lost(pool, request), reason);
    EXPECT_EQ(lost(pool, "x"), "answered done x");
  }
}

TEST(ProcessPool, AnExceptionLeavesTheWorkerACrashDoesNot) {
  ProcessPool pool(1, {}, work);
  const std::string first = lost(pool, "pid");
  lost(pool, "throw");
  EXPECT_EQ(lost(pool, "pid"), first);
  lost(pool, "segv");
  EXPECT_NE(lost(pool, "pid"), first);
}

// What an earlier request has done to the process is not held against a later one.
TEST(ProcessPool, ACrashCountsOnlyInANewProcess) {
  ProcessPool pool(1, {}, work);
  EXPECT_EQ(lost(pool, "count"), "answered 1");
  EXPECT_EQ(lost(pool, "count"), "answered 2");
  EXPECT_EQ(lost(pool, "crash unless new"), "answered done crash unless new");
  EXPECT_EQ(lost(pool, "count"), "answered 2");
}

TEST(ProcessPool, ARequestIsTriedTwiceAtMost) {
  const Shared shared;
  ProcessPool pool(1, {}, [&](const std::string&, WorkerState&, const SharedFlags&) {
    ++shared.count();
    std::raise(SIGSEGV);
    return std::string();
  });
  EXPECT_EQ(lost(pool, "x"), "crashed with signal SEGV (segmentation fault)");
  EXPECT_EQ(shared.count(), 2);
}

TEST(ProcessPool, TimeIsLimited) {
  const Shared shared;
  ProcessPool pool(1, {0.3, 0.0},
                   [&](const std::string& request, WorkerState& s, const SharedFlags& f) {
                     ++shared.count();
                     return work(request, s, f);
                   });
  EXPECT_EQ(lost(pool, "for ever"), "stopped after 0.3 s (--case-timeout)");
  EXPECT_EQ(shared.count(), 1);
  EXPECT_EQ(lost(pool, "x"), "answered done x");
}

TEST(ProcessPool, MemoryIsLimited) {
  // Address sanitizers take some for themselves.
  ProcessPool pool(1, {0.0, 400.0}, work);
  EXPECT_EQ(lost(pool, "fill"), "needed more than 400 MB (--case-memory)");
  EXPECT_EQ(lost(pool, "x"), "answered done x");
}

TEST(ProcessPool, MemoryThatTheSystemRefuses) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer ends the process itself";
#endif
  ProcessPool pool(1, {}, work);
  for (const std::string request : {"too much", "too much, noexcept"}) {
    EXPECT_EQ(lost(pool, request), "needed more memory than was available");
    EXPECT_EQ(lost(pool, "x"), "answered done x");
  }
}

// A peak that no look from outside has met.
TEST(ProcessPool, AShortPeakOfMemoryIsFound) {
  ProcessPool pool(1, {0.0, 400.0},
                   [](const std::string& request, WorkerState&, const SharedFlags&) {
                     const std::size_t size = std::stoul(request) * 1000000;
                     void* const block = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                                                MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
                     ::munmap(block, size);
                     return std::string("done");
                   });
  EXPECT_EQ(lost(pool, "50"), "answered done");
  EXPECT_EQ(lost(pool, "500"), "needed more than 400 MB (--case-memory)");
  EXPECT_EQ(lost(pool, "50"), "answered done");
}

TEST(ProcessPool, AWorkerTakenAwayWhileItWasIdleIsReplaced) {
  ProcessPool pool(1, {}, work);
  const std::string text = lost(pool, "pid");
  const pid_t worker = std::stoi(text.substr(text.rfind(' ')));
  ::kill(worker, SIGKILL);
  EXPECT_EQ(lost(pool, "x"), "answered done x");
  EXPECT_EQ(lost(pool, "count"), "answered 2");
}

TEST(ProcessPool, WithoutTheWatchingProcessTheStudyEnds) {
  ProcessPool pool(1, {}, [](const std::string&, WorkerState&, const SharedFlags&) {
    ::kill(::getppid(), SIGKILL);
    while (true) ::pause();
    return std::string();
  });
  EXPECT_THROW(lost(pool, "x"), RunError);
  EXPECT_THROW(pool.give(0, "x"), RunError);
}

TEST(ProcessPool, WorkCanBeGivenUp) {
  ProcessPool pool(2, {}, work);
  pool.give(0, "until given up");
  pool.give(1, "until given up");
  EXPECT_TRUE(pool.answers(std::chrono::milliseconds(20)).empty());
  EXPECT_LE(pool.in_work(), 1.0);
  pool.give_up();
  std::size_t answers = 0;
  while (answers < 2) answers += pool.answers(std::chrono::milliseconds(1000)).size();
  EXPECT_TRUE(pool.all_idle());
  EXPECT_EQ(pool.in_work(), 0.0);
}

/// Everything that the orphans of a test leave comes to the test itself.
bool all_descendants_end() {
  while (true) {
    if (::waitpid(-1, nullptr, 0) < 0) return errno == ECHILD;
  }
}

// A request that never ends, and a program that goes: at its end, or killed.
TEST(ProcessPool, NoProcessOutlivesTheProgram) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  {
    ProcessPool pool(2, {}, work);
    pool.give(0, "for ever");
    pool.answers(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(all_descendants_end());
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t program = ::fork();
  if (program == 0) {
    ProcessPool pool(2, {}, work);
    pool.ask(0, "x", go_on);
    pool.give(0, "for ever");
    pool.give(1, "for ever");
    pool.answers(std::chrono::milliseconds(20));
    [[maybe_unused]] const ssize_t n = ::write(ready[1], "x", 1);
    while (true) ::pause();
  }
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
  ::kill(program, SIGKILL);
  EXPECT_TRUE(all_descendants_end());
  ::close(ready[0]);
  ::close(ready[1]);
}

// A lock of a file is held by all processes that have inherited it.
TEST(ProcessPool, WorkersHoldNoFilesOfTheProgram) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("lock");
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_EQ(::flock(file, LOCK_EX), 0);
  ProcessPool pool(1, {}, work);
  EXPECT_EQ(lost(pool, "x"), "answered done x");
  ::close(file);
  const int again = ::open(path.c_str(), O_RDWR);
  EXPECT_EQ(::flock(again, LOCK_EX | LOCK_NB), 0);
  ::close(again);
}

// Ctrl-C goes to all processes of the terminal: what becomes of the runs is for the program to say.
TEST(ProcessPool, SignalsOfTheTerminalAreNotForWorkers) {
  ProcessPool pool(1, {}, [](const std::string&, WorkerState&, const SharedFlags&) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::raise(signal);
    return std::string("alive");
  });
  EXPECT_EQ(lost(pool, "x"), "answered alive");
}

TEST(MessagePipe, AnInvalidMessageClosesIt) {
  int one = -1, other = -1;
  ASSERT_EQ(open_pipe(one, other), 0);
  const std::string rubbish(20, '\xff');
  ASSERT_EQ(::write(one, rubbish.data(), rubbish.size()), 20);
  MessageReader reader;
  PipeMessage message;
  EXPECT_FALSE(reader.wait(other, message));
  ::close(one);
  EXPECT_FALSE(send_message(other, request_kind, "x"));
  ::close(other);
}

}  // namespace
}  // namespace floatframe

#include "floatframe/apps/ample_stack.hpp"

#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <ucontext.h>

#include <cstddef>

namespace floatframe {
namespace {

constexpr std::size_t ample_stack = std::size_t{8} << 20;

struct Call {
  const std::function<int()>* act = nullptr;
  int result = 0;
};

/// Global because makecontext passes no pointers; the program is called once.
Call* present_call = nullptr;

void make_call() { present_call->result = (*present_call->act)(); }

bool stack_is_small() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
         limit.rlim_cur < ample_stack;
}

void enlarge_later_threads() {
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return;
  ::pthread_attr_setstacksize(&attributes, ample_stack);
  ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
}

}  // namespace

int on_ample_stack(const std::function<int()>& act) {
  if (!stack_is_small()) return act();
  // Pages are allocated on first access; the lowest one stays unmapped, as below any stack.
  constexpr std::size_t guard = 4096;
  void* const stack = ::mmap(nullptr, guard + ample_stack, PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK | MAP_NORESERVE, -1, 0);
  if (stack == MAP_FAILED) return act();
  ::mprotect(stack, guard, PROT_NONE);
  enlarge_later_threads();
  Call call{&act};
  present_call = &call;
  static ucontext_t before, own;
  ::getcontext(&own);
  own.uc_stack.ss_sp = static_cast<char*>(stack) + guard;
  own.uc_stack.ss_size = ample_stack;
  own.uc_link = &before;
  ::makecontext(&own, make_call, 0);
  ::swapcontext(&before, &own);
  return call.result;
}

}  // namespace floatframe

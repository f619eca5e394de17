#include "tests/unit/stepping.h"

#include <algorithm>
#include <csignal>
#include <cstdint>

#include <ucontext.h>

namespace pintle {

#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

// While the processor's trap flag is set it interrupts itself after each instruction.
long count = 0;
const std::vector<const void*>* watched_now = nullptr;
std::vector<long>* entered_now = nullptr;

void after_an_instruction(int, siginfo_t*, void* context) {
  ++count;
  const auto at = static_cast<std::uintptr_t>(static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
  for (std::size_t i = 0; i < watched_now->size(); ++i)
    if (at == reinterpret_cast<std::uintptr_t>((*watched_now)[i])) ++(*entered_now)[i];
}

// 128 bytes below the stack's end are the compiler's own.
inline void set_trap_flag() {
  asm volatile("lea -128(%%rsp), %%rsp\n pushfq\n orq $0x100, (%%rsp)\n popfq\n lea 128(%%rsp), %%rsp" ::: "cc", "memory");
}
inline void clear_trap_flag() {
  asm volatile("lea -128(%%rsp), %%rsp\n pushfq\n andq $~0x100, (%%rsp)\n popfq\n lea 128(%%rsp), %%rsp" ::: "cc", "memory");
}

Stepped trapped(const std::function<void()>& work, const std::vector<const void*>& watched) {
  Stepped out;
  out.entered.assign(watched.size(), 0);
  count = 0, watched_now = &watched, entered_now = &out.entered;
  struct sigaction ours {
  }, before{};
  ours.sa_sigaction = after_an_instruction;
  ours.sa_flags = SA_SIGINFO;
  sigaction(SIGTRAP, &ours, &before);
  set_trap_flag();
  work();
  clear_trap_flag();
  sigaction(SIGTRAP, &before, nullptr);
  out.instructions = count;
  return out;
}

}  // namespace

std::optional<Stepped> stepped(const std::function<void()>& work, const std::vector<const void*>& watched) {
  static const long nothing = trapped([] {}, {}).instructions;
  if (nothing < 1) return std::nullopt;  // nobody hears the processor
  Stepped out = trapped(work, watched);
  out.instructions -= nothing;
  return out;
}

#else

std::optional<Stepped> stepped(const std::function<void()>&, const std::vector<const void*>&) { return std::nullopt; }

#endif

}  // namespace pintle

#include "tests/unit/heap.h"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "tests/unit/sanitized.h"

namespace {
std::atomic<long> allocations{0}, in_use{0};
[[maybe_unused]] void take(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  in_use.fetch_add(static_cast<long>(size), std::memory_order_relaxed);
}
[[maybe_unused]] void give(std::size_t size) { in_use.fetch_sub(static_cast<long>(size), std::memory_order_relaxed); }
}  // namespace

#if defined(PINTLE_SANITIZED)  // owns malloc, and offers a hook
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, std::size_t), void (*)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void*);
[[maybe_unused]] const int hooked = __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t size) { take(size); },
                                                                              [](const volatile void* p) {
                                                                                if (p) give(__sanitizer_get_allocated_size(p));
                                                                              });
constexpr bool knows_sizes = true;
#elif defined(__GLIBC__)
#include <malloc.h>
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
void* malloc(std::size_t size) noexcept {
  void* p = __libc_malloc(size);
  take(malloc_usable_size(p));
  return p;
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  void* p = __libc_calloc(count, size);
  take(malloc_usable_size(p));
  return p;
}
void* realloc(void* old, std::size_t size) noexcept {
  const std::size_t before = malloc_usable_size(old);
  void* p = __libc_realloc(old, size);
  if (p || size == 0) give(before);
  take(malloc_usable_size(p));
  return p;
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  void* p = __libc_memalign(alignment, size);
  take(malloc_usable_size(p));
  return p;
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
  *p = memalign(alignment, size);
  return *p ? 0 : ENOMEM;
}
void free(void* p) noexcept {
  give(malloc_usable_size(p));
  __libc_free(p);
}
}
constexpr bool knows_sizes = true;
#else  // no malloc to stand in for; operator new sees most
void* operator new(std::size_t size) {
  take(0);
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
constexpr bool knows_sizes = false;
#endif

namespace pintle {

long heap_allocations() { return allocations; }
long heap_in_use() { return knows_sizes ? in_use.load() : -1; }

}  // namespace pintle

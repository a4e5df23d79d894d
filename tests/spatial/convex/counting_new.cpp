// The program's operator new, replaced by one that counts. Programs under sanitizers, which have their own, are linked
// without it.
#include <atomic>
#include <cstdlib>
#include <new>

namespace dymsum::test {
extern std::atomic<std::size_t> allocations;
}

// GCC 12 sees the `free` of one replaced function beside the `new` of another and takes them for a mismatch.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void* operator new(std::size_t size) {
  ++dymsum::test::allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

// operator new and delete of the program. In a browser the page has limits of its own, and the sanitizers want theirs.
#include "counted_new.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#if !defined(__EMSCRIPTEN__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DYMSUM_COUNTS_NEW
#include <malloc.h>
#endif

namespace dymsum::cli {
namespace {

std::atomic<bool> counts{false};
std::atomic<std::uint64_t> most{0}, refused{0};

}  // namespace

// What is given back goes back to the system, where glibc would keep some of it for every thread.
void count_memory(std::uint64_t limit) {
#if defined(DYMSUM_COUNTS_NEW) && defined(__GLIBC__)
  if (limit != 0) {
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_MMAP_THRESHOLD, 128 << 10);
    mallopt(M_TRIM_THRESHOLD, 256 << 10);
  }
#endif
  if (limit != 0) most = limit;
  counts = limit != 0;
}

CountedMemory counted_memory() { return {most, refused}; }

#ifdef DYMSUM_COUNTS_NEW
namespace {

std::atomic<std::int64_t> held{0};  // since it counts; what was there before may be given back

// Counts memory before it is taken.
void take(std::size_t bytes) {
  const std::int64_t all = held.fetch_add(static_cast<std::int64_t>(bytes)) + static_cast<std::int64_t>(bytes);
  if (all <= static_cast<std::int64_t>(most.load(std::memory_order_relaxed))) return;
  held.fetch_sub(static_cast<std::int64_t>(bytes));
  refused = static_cast<std::uint64_t>(all);
  throw std::bad_alloc();
}

void* taken(std::size_t bytes, std::size_t alignment) {
  const bool counted = counts.load(std::memory_order_relaxed);
  if (counted) take(bytes);
  void* const at = alignment == 0 ? std::malloc(bytes == 0 ? 1 : bytes)
                                  : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (at == nullptr) throw std::bad_alloc();
  // Blocks are somewhat larger.
  if (counted) held.fetch_add(static_cast<std::int64_t>(malloc_usable_size(at)) - static_cast<std::int64_t>(bytes));
  return at;
}

void give(void* at) noexcept {
  if (at != nullptr && counts.load(std::memory_order_relaxed))
    held.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(at)));
  std::free(at);
}

}  // namespace
#endif

}  // namespace dymsum::cli

#ifdef DYMSUM_COUNTS_NEW
void* operator new(std::size_t bytes) { return dymsum::cli::taken(bytes, 0); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return dymsum::cli::taken(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* at) noexcept { dymsum::cli::give(at); }
void operator delete(void* at, std::size_t) noexcept { dymsum::cli::give(at); }
void operator delete(void* at, std::align_val_t) noexcept { dymsum::cli::give(at); }
void operator delete(void* at, std::size_t, std::align_val_t) noexcept { dymsum::cli::give(at); }
#endif

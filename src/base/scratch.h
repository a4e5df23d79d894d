// Memory for the arrays of one computation: small ones lie in a buffer on the stack, large ones in blocks that the next computation
// of the same thread uses again. Fresh pages cost more than the arithmetic of a middling sum.
#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>
#include <vector>

namespace dymsum {

template <class T>
using Array = std::pmr::vector<T>;

/// Not thread-safe; at most 16 MB of blocks outlive it, until the thread ends.
class Scratch final : public std::pmr::memory_resource {
 public:
  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// The most bytes that were handed out at one time.
  std::size_t peak_bytes() const { return peak_; }

 private:
  // Arrays that grow leave gaps in the buffer, so only small ones go there.
  static constexpr std::size_t kBuffer = 48 << 10, kSmall = 8 << 10;

  void count(std::size_t bytes) {
    held_ += bytes;
    if (held_ > peak_) peak_ = held_;
  }
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* pointer, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }

  alignas(std::max_align_t) std::byte buffer_[kBuffer];
  std::size_t used_ = 0;
  std::size_t held_ = 0, peak_ = 0;  // bytes handed out, now and at most
};

}  // namespace dymsum

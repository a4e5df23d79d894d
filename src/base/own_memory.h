// Memory of a value with many arrays that are made together and die together: one block instead of an allocation for each.
#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <utility>

namespace dymsum {

/// To be the first member, so that the arrays behind it die before their memory does. A copy has arrays of its own on the heap, and what is
/// assigned is copied into the arrays that are there, as std::pmr containers do: so neither changes whose memory it is.
class OwnMemory {
 public:
  OwnMemory() = default;
  explicit OwnMemory(std::size_t bytes) : block_(std::make_unique<std::pmr::monotonic_buffer_resource>(bytes)) {}
  OwnMemory(const OwnMemory&) noexcept {}
  OwnMemory(OwnMemory&& other) noexcept : block_(std::move(other.block_)) {}
  OwnMemory& operator=(const OwnMemory&) noexcept { return *this; }
  OwnMemory& operator=(OwnMemory&&) noexcept { return *this; }

  std::pmr::memory_resource* resource() const {
    return block_ != nullptr ? static_cast<std::pmr::memory_resource*>(block_.get()) : std::pmr::get_default_resource();
  }

 private:
  std::unique_ptr<std::pmr::monotonic_buffer_resource> block_;
};

}  // namespace dymsum

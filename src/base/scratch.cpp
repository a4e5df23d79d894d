#include "base/scratch.h"

#include <array>
#include <bit>
#include <new>
#include <vector>

namespace dymsum {

#ifdef __SANITIZE_ADDRESS__

const std::size_t Scratch::kUsedAtFirst = kBuffer + 1;

namespace {

std::size_t size_of_block(std::size_t bytes) { return bytes; }
void* block_of(std::size_t bytes) { return ::operator new(bytes); }
void give_back(void* pointer, std::size_t) { ::operator delete(pointer); }

}  // namespace

#else
namespace {

// Freed blocks by size class, the powers of two and the midpoints between them.
class Blocks {
 public:
  ~Blocks() {
    for (auto& list : lists_)
      for (void* block : list) ::operator delete(block);
  }
  /// What take() takes for so many bytes.
  static std::size_t size(std::size_t bytes) {
    const std::size_t c = size_class(bytes);
    return c < kClasses ? class_size(c) : bytes;
  }
  void* take(std::size_t bytes) {
    const std::size_t c = size_class(bytes);
    if (c >= kClasses || lists_[c].empty()) return ::operator new(c < kClasses ? class_size(c) : bytes);
    void* block = lists_[c].back();
    lists_[c].pop_back();
    kept_ -= class_size(c);
    return block;
  }
  void give(void* block, std::size_t bytes) {
    const std::size_t c = size_class(bytes);
    if (c >= kClasses || kept_ + class_size(c) > kMost) return ::operator delete(block);
    lists_[c].push_back(block);
    kept_ += class_size(c);
  }

 private:
  static constexpr std::size_t kMost = 16 << 20, kClasses = 48;

  // Class 2 k holds 2^k bytes, class 2 k + 1 holds 3 * 2^(k - 1).
  static constexpr std::size_t class_size(std::size_t c) {
    return c % 2 == 0 ? std::size_t{1} << c / 2 : std::size_t{3} << (c / 2 - 1);
  }
  static std::size_t size_class(std::size_t bytes) {
    const std::size_t c = 2 * static_cast<std::size_t>(std::bit_width(bytes - 1));
    return class_size(c - 1) >= bytes ? c - 1 : c;
  }

  std::array<std::vector<void*>, kClasses> lists_;
  std::size_t kept_ = 0;
};

thread_local Blocks blocks;

std::size_t size_of_block(std::size_t bytes) { return Blocks::size(bytes < 64 ? 64 : bytes); }
void* block_of(std::size_t bytes) { return blocks.take(bytes < 64 ? 64 : bytes); }
void give_back(void* pointer, std::size_t bytes) { blocks.give(pointer, bytes < 64 ? 64 : bytes); }

}  // namespace

const std::size_t Scratch::kUsedAtFirst = 0;

#endif

void* Scratch::take_block(std::size_t bytes) {
  if (budget_ == nullptr) return block_of(bytes);
  budget_->take(size_of_block(bytes));
  try {
    return block_of(bytes);
  } catch (...) {
    budget_->give(size_of_block(bytes));
    throw;
  }
}

void Scratch::give_block(void* pointer, std::size_t bytes) {
  give_back(pointer, bytes);
  if (budget_ != nullptr) budget_->give(size_of_block(bytes));
}

}  // namespace dymsum

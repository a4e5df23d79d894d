// A sequence of structures, each a list of words that differs little from the one before: some are stored whole, the
// others as differences.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dymsum::spatial {

/// A structure is stored whole when the differences since the last whole one take as much memory as it: memory is at
/// most twice that of the differences (and one structure), and reading one costs no more than reading two whole ones.
class StructureStore {
 public:
  void push(const std::vector<std::uint32_t>& words);
  /// Structure i, 0 for the first one pushed. Words that it had not yet are kAbsent.
  void read(std::size_t i, std::vector<std::uint32_t>& words) const;

  static constexpr std::uint32_t kAbsent = ~std::uint32_t{0};
  std::size_t size() const { return start_.size(); }
  std::size_t key_bytes() const;
  std::size_t difference_bytes() const { return changes_.size() * sizeof(Change) + start_.size() * sizeof(start_[0]); }
  std::size_t full_bytes() const { return full_words_ * sizeof(std::uint32_t); }
  void shrink();

 private:
  struct Change {
    std::uint32_t index, word;
  };
  struct Key {
    std::size_t at;  // the index of its structure
    std::vector<std::uint32_t> words;
  };
  std::vector<Key> keys_;
  std::vector<Change> changes_;
  std::vector<std::size_t> start_;   // of each structure's changes from the one before
  std::vector<std::uint32_t> last_;  // scratch while pushing
  std::size_t since_key_ = 0, full_words_ = 0;
};

}  // namespace dymsum::spatial

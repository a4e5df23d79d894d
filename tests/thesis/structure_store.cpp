#include "thesis/structure_store.h"

#include <algorithm>
#include <iterator>

namespace dymsum::spatial {

void StructureStore::push(const std::vector<std::uint32_t>& words) {
  const std::size_t begin = changes_.size();
  start_.push_back(begin);
  full_words_ += words.size();
  if (last_.size() < words.size()) last_.resize(words.size(), kAbsent);
  for (std::uint32_t k = 0; k < last_.size(); ++k) {
    const std::uint32_t word = k < words.size() ? words[k] : kAbsent;
    if (word == last_[k]) continue;
    changes_.push_back({k, word});
    last_[k] = word;
  }
  since_key_ += changes_.size() - begin;
  if (!keys_.empty() && since_key_ * sizeof(Change) < words.size() * sizeof(words[0])) return;
  changes_.resize(begin);
  since_key_ = 0;
  keys_.push_back({start_.size() - 1, words});
}

void StructureStore::read(std::size_t i, std::vector<std::uint32_t>& words) const {
  const Key& key =
      *std::prev(std::upper_bound(keys_.begin(), keys_.end(), i, [](std::size_t n, const Key& k) { return n < k.at; }));
  words = key.words;
  const std::size_t from = key.at + 1 < start_.size() ? start_[key.at + 1] : changes_.size(),
                    to = i + 1 < start_.size() ? start_[i + 1] : changes_.size();
  for (std::size_t k = from; k < to; ++k) {
    const Change& c = changes_[k];
    if (c.index >= words.size()) words.resize(c.index + 1, kAbsent);
    words[c.index] = c.word;
  }
}

std::size_t StructureStore::key_bytes() const {
  std::size_t bytes = keys_.size() * sizeof(Key);
  for (const Key& k : keys_) bytes += k.words.size() * sizeof(k.words[0]);
  return bytes;
}

void StructureStore::shrink() {
  keys_.shrink_to_fit();
  changes_.shrink_to_fit();
  start_.shrink_to_fit();
  last_ = {};
}

}  // namespace dymsum::spatial

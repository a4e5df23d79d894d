#include "planar/rotation/box_pairs.h"

#include <bit>
#include <cstring>
#include <limits>

namespace dymsum::planar {
namespace {

// Eight numbers; comparing gives -1 or 0 in each.
using Lanes = std::int16_t __attribute__((vector_size(16)));
constexpr std::uint32_t kLanes = 8;

Lanes load(const std::int16_t* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

}  // namespace

// Where the extent is minute or huge the factor is not a number of use: then all boxes meet.
BoxPairs::BoxPairs(double extent) {
  const double factor = (kQuanta - 1) / extent;
  per_unit_ = factor <= std::numeric_limits<double>::max() ? factor : 0;
}

// By buckets first where they are many, then by insertion.
void BoxPairs::sort_by_left() {
  const std::size_t n = boxes_.size();
  order_.resize(n);
  for (std::size_t i = 0; i < n; ++i) order_[i] = static_cast<std::uint64_t>(boxes_[i].x0) << 32 | i;
  if (n > 24) {
    const int shift = 32 + 15 - std::min(11, static_cast<int>(std::bit_width(n)));
    std::vector<std::uint32_t> start((std::uint64_t{kQuanta} << 32 >> shift) + 2, 0);
    for (const std::uint64_t o : order_) ++start[(o >> shift) + 1];
    for (std::size_t b = 1; b < start.size(); ++b) start[b] += start[b - 1];
    std::vector<std::uint64_t> sorted(n);
    for (const std::uint64_t o : order_) sorted[start[o >> shift]++] = o;
    order_.swap(sorted);
  }
  for (std::size_t k = 1; k < n; ++k) {
    const std::uint64_t o = order_[k];
    std::size_t at = k;
    for (; at > 0 && order_[at - 1] > o; --at) order_[at] = order_[at - 1];
    order_[at] = o;
  }
}

// Behind the last box lie some that start to the right of everything and meet nothing. Which of eight boxes meet cannot be predicted: all
// are listed and the place moves on for those that do.
std::vector<std::array<std::uint32_t, 2>> BoxPairs::find() {
  sort_by_left();
  const std::size_t n = boxes_.size(), padded = n + 2 * kLanes;
  std::vector<std::int16_t> sides(3 * padded);
  std::int16_t *x0 = sides.data(), *y0 = x0 + padded, *y1 = y0 + padded;
  for (std::size_t k = 0; k < padded; ++k) {
    constexpr std::int16_t kLast = std::numeric_limits<std::int16_t>::max();
    const Box b = k < n ? boxes_[static_cast<std::uint32_t>(order_[k])] : Box{kLast, kLast, kLast, -1};
    x0[k] = b.x0;
    y0[k] = b.y0;
    y1[k] = b.y1;
  }
  order_.resize(padded);
  std::vector<std::array<std::uint32_t, 2>> pairs(4 * padded);
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto s = static_cast<std::uint32_t>(order_[i]);
    const std::int16_t right = boxes_[s].x1;
    const Lanes low = Lanes{} + y0[i], high = Lanes{} + y1[i], far = Lanes{} + right;
    for (std::size_t j = i + 1; x0[j] <= right; j += kLanes) {
      const Lanes meets = (load(y0 + j) <= high) & (load(y1 + j) >= low) & (load(x0 + j) <= far);
      std::array<std::int16_t, kLanes> hits;
      std::array<std::uint64_t, 2> halves;
      std::memcpy(&hits, &meets, sizeof hits);
      std::memcpy(&halves, &meets, sizeof halves);
      if ((halves[0] | halves[1]) == 0) continue;
      if (count + kLanes > pairs.size()) pairs.resize(2 * pairs.size());
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        const auto t = static_cast<std::uint32_t>(order_[j + k]);
        pairs[count] = {std::min(s, t), std::max(s, t)};
        count -= static_cast<std::size_t>(static_cast<std::ptrdiff_t>(hits[k]));
      }
    }
  }
  pairs.resize(count);
  return pairs;
}

}  // namespace dymsum::planar

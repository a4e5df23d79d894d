#include "planar/window/box_pairs.h"

#include <cstring>
#include <limits>

namespace dymsum::planar {
// Where the extent is minute or huge the factor is not a number of use: then all boxes meet.
BoxPairs::BoxPairs(double extent, Scratch* memory) : memory_(memory), boxes_(memory), pairs_(memory), sides_(memory) {
  const double factor = (kBoxQuanta - 1) / extent;
  per_unit_ = factor <= std::numeric_limits<double>::max() ? factor : 0;
}

// There are as many strips that boxes mostly lie in one, and that each holds enough of them to fill the lanes.
int BoxPairs::strips() const {
  constexpr std::size_t kBoxes = 96, kMost = 32;
  constexpr long kHeights = 4;
  if (boxes_.size() < 2 * kBoxes) return 1;
  long heights = 0;
  for (const Box& b : boxes_) heights += b.y1 - b.y0 + 1;
  const long mean = heights / static_cast<long>(boxes_.size()) + 1;
  return static_cast<int>(
      std::clamp<long>(kBoxQuanta / (kHeights * mean), 1, static_cast<long>(std::min(kMost, boxes_.size() / kBoxes))));
}

Array<BoxPairs::Pair> BoxPairs::find(std::size_t most, const base::StopToken& stop) {
  const int n = strips(), height = kBoxQuanta / n + 1;
  std::vector<Array<std::uint64_t>> of(static_cast<std::size_t>(n), Array<std::uint64_t>(memory_));
  for (std::uint32_t i = 0; i < boxes_.size(); ++i)
    for (int k = boxes_[i].y0 / height, last = boxes_[i].y1 / height; k <= last; ++k)
      of[static_cast<std::size_t>(k)].push_back(left_order(boxes_[i].x0, i));
  pairs_.resize(4 * boxes_.size() + 4 * kLanes);
  count_ = 0;
  for (int k = 0; k < n && count_ <= most && !stop.stop_requested(); ++k)
    sweep(of[static_cast<std::size_t>(k)], static_cast<std::int16_t>(k * height), most);
  pairs_.resize(count_);
  return std::move(pairs_);
}

// Lists the pairs of a strip whose common part begins in it: it begins in one of the strips. After the last box lie
// some that start to the right of everything and meet nothing. Which of eight boxes meet cannot be predicted: all are
// listed and the position moves on for those that do.
void BoxPairs::sweep(Array<std::uint64_t>& order, std::int16_t strip, std::size_t most) {
  sort_by_left(order);
  const std::size_t n = order.size(), padded = n + 2 * kLanes;
  sides_.resize(3 * padded);
  std::int16_t *x0 = sides_.data(), *y0 = x0 + padded, *y1 = y0 + padded;
  for (std::size_t k = 0; k < padded; ++k) {
    constexpr std::int16_t kLast = std::numeric_limits<std::int16_t>::max();
    const Box b = k < n ? boxes_[static_cast<std::uint32_t>(order[k])] : Box{kLast, kLast, kLast, -1};
    x0[k] = b.x0;
    y0[k] = b.y0;
    y1[k] = b.y1;
  }
  order.resize(padded);
  for (std::size_t i = 0; i < n && count_ <= most; ++i) {
    const auto s = static_cast<std::uint32_t>(order[i]);
    const std::int16_t right = boxes_[s].x1, least = y0[i] >= strip ? std::int16_t{0} : strip;
    const Lanes low = Lanes{} + y0[i], high = Lanes{} + y1[i], far = Lanes{} + right, first = Lanes{} + least;
    for (std::size_t j = i + 1; x0[j] <= right; j += kLanes) {
      const Lanes begins = load_lanes(y0 + j);
      const Lanes meets =
          (begins <= high) & (begins >= first) & (load_lanes(y1 + j) >= low) & (load_lanes(x0 + j) <= far);
      std::array<std::int16_t, kLanes> hits;
      std::array<std::uint64_t, 2> halves;
      std::memcpy(&hits, &meets, sizeof hits);
      std::memcpy(&halves, &meets, sizeof halves);
      if ((halves[0] | halves[1]) == 0) continue;
      if (count_ + kLanes > pairs_.size()) pairs_.resize(2 * pairs_.size());
      Pair* to = pairs_.data() + count_;
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        const auto t = static_cast<std::uint32_t>(order[j + k]);
        *to = {std::min(s, t), std::max(s, t)};
        to -= hits[k];
      }
      count_ = static_cast<std::size_t>(to - pairs_.data());
    }
  }
}

}  // namespace dymsum::planar

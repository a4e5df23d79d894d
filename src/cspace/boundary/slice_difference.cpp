#include "cspace/boundary/slice_difference.h"

namespace dymsum::planar {

SliceEdit slice_difference(const BoundaryGraph& before, const std::vector<SliceLoop>& after,
                           const std::function<bool(std::uint32_t)>& parted) {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> old;
  for (const std::uint32_t n : before.alive()) old[{before[n].id, before[n].left, before[n].right}] = n;
  SliceEdit edit;
  std::uint32_t index = 0;
  for (const SliceLoop& loop : after) {
    SliceEdit::Loop& to = edit.loops.emplace_back();
    to.outer = loop.outer;
    const std::size_t n = loop.segments.size();
    for (std::size_t k = 0; k < n; ++k, ++index) {
      SliceEdit::Position position{loop.segments[k], loop.segments[(k + n - 1) % n], loop.segments[(k + 1) % n],
                                   kNobody};
      const auto it = old.find({position.segment, position.left, position.right});
      if (it != old.end() && parted(it->second)) {
        edit.touching.emplace_back(it->second, index);
      } else if (it != old.end()) {
        position.stays = it->second;
        old.erase(it);
      }
      to.positions.push_back(position);
    }
  }
  for (const auto& [key, n] : old) edit.ended.push_back(n);
  return edit;
}

}  // namespace dymsum::planar

#include "spatial/convex/crossing_slots.h"

#include <algorithm>

namespace dymsum::spatial {

CrossingSlots::Edges CrossingSlots::edges_now(const Overlay& overlay, std::uint32_t id) {
  if (id >= overlay.crossing_indices() || !overlay.is_crossing(id)) return {};
  return {overlay.crossing(id).p, overlay.crossing(id).q};
}

/// The slots of crossings that differ are handed out again, first to those that had one, then to the others.
void CrossingSlots::keep(const Overlay& overlay) {
  for (std::vector<Moved>* list : {&before_, &now_}) list->clear(), list->reserve(slot_.capacity());
  vacant_.clear(), vacant_.reserve(slot_.capacity());
  for (std::uint32_t id = 0; id < slot_.size(); ++id) {
    const Edges now = edges_now(overlay, id), before = seen(id);
    if (now.key() == before.key()) continue;
    before_.push_back({before.key(), slot_[id]});
    now_.push_back({now.key(), id});
  }
  const auto in_order = [](const Moved& a, const Moved& b) { return a.key != b.key ? a.key < b.key : a.at < b.at; };
  std::sort(before_.begin(), before_.end(), in_order);
  std::sort(now_.begin(), now_.end(), in_order);
  auto was = before_.begin();
  std::size_t others = 0;
  for (const Moved& is : now_) {
    for (; was != before_.end() && was->key < is.key; ++was) vacant_.push_back(was->at);
    if (is.key == Edges().key() || was == before_.end() || was->key != is.key) {
      now_[others++] = is;
      continue;
    }
    slot_[is.at] = was->at;
    ++was;
  }
  for (; was != before_.end(); ++was) vacant_.push_back(was->at);
  // Vacant indices are taken in order, so that most crossings keep theirs.
  std::sort(vacant_.begin(), vacant_.end());
  std::sort(now_.begin(), now_.begin() + static_cast<std::ptrdiff_t>(others),
            [](const Moved& a, const Moved& b) { return a.at < b.at; });
  for (std::size_t k = 0; k < others; ++k) slot_[now_[k].at] = vacant_[k];
}

std::size_t CrossingSlots::bytes() const {
  const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
  return of(slot_, seen_, before_, now_, vacant_);
}

}  // namespace dymsum::spatial

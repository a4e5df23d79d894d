// Overlays written down and taken up again.
#include <algorithm>
#include <stdexcept>

#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

void Overlay::capture(std::vector<std::uint32_t>& words) const {
  words.assign(extreme_[0].begin(), extreme_[0].end());
  words.insert(words.end(), extreme_[1].begin(), extreme_[1].end());
  const std::size_t faces = words.size();
  words.resize(faces + 2 * crossings_.size(), kNoCrossing);
  for (const std::uint32_t head : head_[0])
    for (std::uint32_t id = head; id != kNoCrossing; id = crossings_[id].next[0]) {
      words[faces + 2 * id] = crossings_[id].p;
      words[faces + 2 * id + 1] = crossings_[id].q;
    }
}

void Overlay::restore(const RelativeMap& map, std::span<const std::uint32_t> words) {
  const std::size_t p = extreme_[0].size(), faces = p + extreme_[1].size();
  if (words.size() < faces || (words.size() - faces) % 2 != 0)
    throw std::logic_error("Overlay::restore: not the words of this pair");
  restart();
  signs_.set(map);
  clear_crossings();
  extreme_[0].assign(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(p));
  const auto midpoint = words.begin() + static_cast<std::ptrdiff_t>(p);
  extreme_[1].assign(midpoint, words.begin() + static_cast<std::ptrdiff_t>(faces));
  // Only build may follow, and looks at all faces.
  std::fill(vertex_until_[0].begin(), vertex_until_[0].end(), clock_);
  find_pairs();
  for (std::size_t k = faces; k < words.size(); k += 2) {
    if (words[k] == kNoCrossing) continue;
    const auto id = static_cast<std::uint32_t>(crossings_.size());
    std::uint32_t &of_p = head_[0][words[k]], &of_q = head_[1][words[k + 1] / 2];
    crossings_.push_back({words[k], words[k + 1], {of_p, of_q}});
    crossing_until_.push_back(clock_);
    of_p = of_q = id;
  }
}

std::size_t Overlay::bytes() const {
  const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
  return sizeof(*this) - sizeof(signs_) + signs_.bytes() +
         of(extreme_[0], extreme_[1], head_[0], head_[1], crossings_, free_, visits_[0], visits_[1], vertex_until_[0],
            vertex_until_[1], crossing_until_, chords_, also_chords_, levels_, walks_, found_, across_, walking_,
            joining_, altered_, pairs_, parted_, parallel_[0], parallel_[1], start_[0], start_[1], dropped_, touched_,
            uncrossed_, expired_, broken_, breaks_, spreading_, on_arcs_, is_touched_[0], is_touched_[1],
            changes_.faces[0], changes_.faces[1], changes_.crossings);
}

}  // namespace dymsum::spatial

// Overlays written down and taken up again.
#include <algorithm>
#include <stdexcept>

#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

void Overlay::capture(std::vector<std::uint32_t>& words) const {
  words.assign(extreme_[0].begin(), extreme_[0].end());
  words.insert(words.end(), extreme_[1].begin(), extreme_[1].end());
  const std::size_t faces = words.size();
  words.resize(faces + 2 * arcs_.all.size(), kNoCrossing);
  for (const std::uint32_t head : arcs_.head[0])
    for (std::uint32_t id = head; id != kNoCrossing; id = arcs_[id].next[0]) {
      words[faces + 2 * id] = arcs_[id].p;
      words[faces + 2 * id + 1] = arcs_[id].q;
    }
}

void Overlay::restore(const RelativeMap& map, std::span<const std::uint32_t> words) {
  const std::size_t p = extreme_[0].size(), faces = p + extreme_[1].size();
  if (words.size() < faces || (words.size() - faces) % 2 != 0)
    throw std::logic_error("Overlay::restore: not the words of this pair");
  restart();
  signs_.set(map);
  arcs_.clear();
  extreme_[0].assign(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(p));
  const auto midpoint = words.begin() + static_cast<std::ptrdiff_t>(p);
  extreme_[1].assign(midpoint, words.begin() + static_cast<std::ptrdiff_t>(faces));
  // Only build may follow, and looks at all faces.
  std::fill(vertex_until_[0].begin(), vertex_until_[0].end(), clock_);
  find_pairs();
  for (std::size_t k = faces; k < words.size(); k += 2) {
    if (words[k] == kNoCrossing) continue;
    const auto id = static_cast<std::uint32_t>(arcs_.all.size());
    std::uint32_t &of_p = arcs_.head[0][words[k]], &of_q = arcs_.head[1][words[k + 1] / 2];
    arcs_.all.push_back({words[k], words[k + 1], {of_p, of_q}});
    arcs_.until.push_back(clock_);
    of_p = of_q = id;
  }
}

std::size_t Overlay::bytes() const {
  const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
  return sizeof(*this) - sizeof(signs_) + signs_.bytes() + leap_.bytes() +
         of(extreme_[0], extreme_[1], vertex_until_[0], vertex_until_[1], arcs_.all, arcs_.until, arcs_.free,
            arcs_.head[0], arcs_.head[1], arcs_.touched, arcs_.marked[0], arcs_.marked[1], pairs_.all, pairs_.parted,
            pairs_.parallel[0], pairs_.parallel[1], pairs_.start[0], pairs_.start[1], visits_[0].all, visits_[1].all,
            plan_.levels, plan_.chords, dropped_, uncrossed_, expired_, broken_, breaks_, spreading_, changes_.faces[0],
            changes_.faces[1], changes_.crossings);
}

}  // namespace dymsum::spatial

#include "cspace/planner/path_links.h"

#include <algorithm>

namespace dymsum::planar {
namespace {}  // namespace

PathLinks::PathLinks(const CspaceObstacle& obstacle, PathLevels& levels, const JoinedComponents& joined)
    : obstacle_(obstacle), levels_(levels), joined_(joined) {
  const std::vector<FreeCell>& cells = obstacle.free_cells();
  for (std::uint32_t c = 0; c < cells.size(); ++c)
    for (const std::uint32_t event : {cells[c].begin, cells[c].end})
      if (event != Patch::kNone) at_event_[{event, root(c)}].push_back(c);
}

std::uint32_t PathLinks::root(std::uint32_t cell) const { return joined_.root(obstacle_.free_cells()[cell].component); }

bool PathLinks::may_join(std::uint32_t cell, std::uint32_t next, std::optional<std::uint32_t> event) const {
  if (cell == kUnknown || next == kUnknown || cell == next) return true;
  if (!event || root(cell) != root(next)) return false;
  const std::vector<FreeCell>& cells = obstacle_.free_cells();
  return cells[cell].end == *event || cells[next].begin == *event;
}

bool PathLinks::may_join(std::size_t k, std::uint32_t group, std::uint32_t next_group) {
  const std::size_t next = (k + 1) % levels_.size();
  const std::vector<std::uint32_t>&cells = levels_.cells(k, group), &beyond = levels_.cells(next, next_group);
  // Cracks alone have no cells; they are what is left of a passage.
  if (cells.empty() || beyond.empty()) return true;
  const std::optional<std::uint32_t> event = levels_.event_before_next(k);
  return std::any_of(cells.begin(), cells.end(), [&](std::uint32_t c) {
    return std::any_of(beyond.begin(), beyond.end(), [&](std::uint32_t d) { return may_join(c, d, event); });
  });
}

void PathLinks::aim(std::size_t k, std::uint32_t group) {
  const std::vector<FreeCell>& cells = obstacle_.free_cells();
  steps_.assign(cells.size(), static_cast<std::uint32_t>(cells.size()));
  std::vector<std::uint32_t> open;
  for (const std::uint32_t c : levels_.cells(k, group))
    if (c != kUnknown) {
      steps_[c] = 0;
      open.push_back(c);
    }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> left = at_event_;
  for (std::size_t i = 0; i < open.size(); ++i)
    for (const std::uint32_t event : {cells[open[i]].begin, cells[open[i]].end}) {
      const auto at = left.find({event, root(open[i])});
      if (at == left.end()) continue;
      for (const std::uint32_t c : at->second)
        if (steps_[c] == far()) {
          steps_[c] = steps_[open[i]] + 1;
          open.push_back(c);
        }
      left.erase(at);
    }
}

std::uint32_t PathLinks::steps(std::size_t k, std::uint32_t group) {
  std::uint32_t least = far();
  for (const std::uint32_t c : levels_.cells(k, group))
    if (c != kUnknown) least = std::min(least, steps_[c]);
  return least;
}

}  // namespace dymsum::planar

#include "spatial/boundary/cell_links.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace dymsum::spatial {
namespace {

constexpr std::int8_t kNoWall = 2;  // of a cell's facing: it is looked through

}  // namespace

CellLinks link_cells(const SumSpace& space, const SolidArrangement& arrangement, StageWatch& watch,
                     const ArrangementScope* scope) {
  const std::uint32_t covered = arrangement.cell_count;
  std::vector<std::int8_t> facing;  // 1 where the free side is the normal's, -1 the other one, 0 none
  facing.reserve(covered);
  for (const PlaneGroup& group : arrangement.groups)
    for (const Cell& cell : group.cells.cells)
      facing.push_back(cell.front > 0 ? cell.back > 0 ? 0 : 1 : cell.back > 0 ? -1 : kNoWall);
  for (std::uint32_t c = 0; c < covered && scope != nullptr; ++c)
    if (!scope->cells[c]) facing[c] = kNoWall;

  constexpr std::size_t kPart = 2048;
  const std::size_t edges = arrangement.edge_ends.size();
  std::vector<std::vector<std::array<std::uint32_t, 2>>> joins((edges + kPart - 1) / kPart);
  watch.run(joins.size(), [&](std::size_t part) {
    EdgeWedges wedges(space, arrangement, [&](std::uint32_t cell) { return facing[cell] != kNoWall; });
    // The cell whose free side that is, or what is covered.
    const auto free = [&](CellSide s) { return facing[s.cell] == s.side ? s.cell : covered; };
    for (std::size_t e = part * kPart; e < std::min(edges, (part + 1) * kPart); ++e) {
      if (scope != nullptr && !scope->edges[e]) continue;
      wedges.for_each(static_cast<std::uint32_t>(e), [&](CellSide a, CellSide b) {
        const std::uint32_t x = free(a), y = free(b);
        if (x != y) joins[part].push_back({x, y});
      });
    }
  });

  std::vector<std::uint32_t> parent(covered + 1);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  for (std::uint32_t c = 0; c < covered; ++c)
    if (facing[c] == 0) parent[root(c)] = root(covered);
  for (const auto& part : joins)
    for (const auto& [x, y] : part) parent[root(x)] = root(y);

  CellLinks links;
  links.patch.assign(covered, kNoId);
  std::vector<std::uint32_t> index(parent.size(), kNoId);
  const std::uint32_t buried = root(covered);
  for (std::uint32_t c = 0; c < covered; ++c) {
    const std::uint32_t r = root(c);
    if (r == buried || facing[c] == kNoWall) continue;
    if (index[r] == kNoId) index[r] = links.patches++;
    links.patch[c] = index[r];
  }
  return links;
}

}  // namespace dymsum::spatial

#include "cspace/obstacle/obstacle_shells.h"

#include <algorithm>

namespace dymsum::planar {
namespace {

using ShellNames = std::map<std::uint32_t, std::uint32_t>;  // of the graph's shells, in the state

ShellNames name_shells(const BoundaryGraph& graph, const std::vector<std::uint32_t>& node_of,
                       planar::ObstacleState& state) {
  ShellNames names;
  for (std::size_t p = 0; p < state.patches.size(); ++p) {
    const auto [it, fresh] = names.emplace(graph.shell_of(node_of[p]), static_cast<std::uint32_t>(names.size()));
    if (fresh) {
      state.shells.push_back({});
      state.shells.back().free_component = state.cells[state.patch_cells[p].front().second].component;
    }
    state.patches[p].shell = it->second;
    ++state.shells[it->second].patches;
  }
  return names;
}

// Outer is what borders on a component of free space that reaches infinity somewhere.
void find_outer(planar::ObstacleState& state) {
  std::vector<std::uint8_t> open;
  for (const FreeCell& c : state.cells) {
    if (open.size() <= c.component) open.resize(c.component + 1, 0);
    open[c.component] |= c.unbounded;
  }
  for (Shell& shell : state.shells) shell.outer = open[shell.free_component] != 0;
  for (FreeCell& c : state.cells) c.unbounded = open[c.component] != 0;
}

std::vector<std::uint32_t> shell_of_cells(const BoundaryGraph& graph, const ShellNames& names) {
  std::vector<std::uint32_t> shells(graph.cells().size(), kNobody);
  for (std::uint32_t n = 0; n < graph.nodes().size(); ++n) {
    const std::uint32_t shell = names.at(graph.shell_of(n));
    shells[graph[n].born_cell] = shell;
    for (const auto& [angle, cell] : graph[n].cells) shells[cell] = shell;
  }
  return shells;
}

// Over a range of angles without events a shell is made of tubes, which count nothing. At single events a loop is born
// or vanishes (1) or splits (-1): where a + b tubes end and begin a shell gains 2 - (a + b). Elsewhere limits of the
// boundary decide.
void add_euler(const SweptBoundary& swept, const ShellNames& names, planar::ObstacleState& state) {
  const BoundaryGraph& graph = swept.graph;
  const auto count = static_cast<std::uint32_t>(graph.cells().size());
  // Cell c at its beginning and at its end, 2 c and 2 c + 1, where tubes end and begin together.
  Partition ends(std::size_t{2} * count);
  for (const BoundaryGraph::CellLink& link : graph.cell_links()) ends.join(2 * link.from + 1, 2 * link.to);
  const std::vector<std::uint32_t> shell_of_cell = shell_of_cells(graph, names);
  std::map<std::uint32_t, std::pair<std::int64_t, std::uint32_t>> tubes;  // how many, and their shell
  for (std::uint32_t k = 0; k < 2 * count; ++k) {
    const BoundaryGraph::Cell& cell = graph.cells()[k / 2];
    const std::uint32_t angle = k % 2 == 0 ? cell.begin : cell.end, shell = shell_of_cell[k / 2];
    if (angle == kNobody || shell == kNobody ||
        std::binary_search(swept.limit_angles.begin(), swept.limit_angles.end(), angle))
      continue;
    auto& entry = tubes[ends.find(k)];
    ++entry.first;
    entry.second = shell;
  }
  for (const auto& [at, entry] : tubes) state.shells[entry.second].euler += 2 - entry.first;
  std::vector<std::int64_t> halves(state.shells.size());
  for (const auto& [node, more] : swept.limit_halves) halves[names.at(graph.shell_of(node))] += more;
  for (std::size_t s = 0; s < halves.size(); ++s) state.shells[s].euler += halves[s] / 2;
}

}  // namespace

void add_shells(const SweptBoundary& swept, const std::vector<std::uint32_t>& node_of, planar::ObstacleState& state) {
  const ShellNames names = name_shells(swept.graph, node_of, state);
  find_outer(state);
  add_euler(swept, names, state);
}

}  // namespace dymsum::planar

#include "cspace/obstacle/obstacle_export.h"

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "cspace/boundary/obstacle_state.h"
#include "cspace/events/walked_rings.h"

namespace dymsum::planar {
namespace {

// The patches that are one surface, whether free space beyond it reaches infinity, and Euler numbers.
// docs/design/cspace-obstacle.md, "Euler numbers".

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

/// Adds shells to a state that has patches and cells. `node_of`: of every patch, a node.
void add_shells(const SweptBoundary& swept, const std::vector<std::uint32_t>& node_of, planar::ObstacleState& state) {
  const ShellNames names = name_shells(swept.graph, node_of, state);
  find_outer(state);
  add_euler(swept, names, state);
}

// Patches where rings touch: an edge that is cut there has several walk edges, whose visible sub-edges in line are one
// patch.

/// A patch in the sweep's own indices.
struct CutPatch {
  Patch patch;                                                 ///< without begin, end and shell
  std::uint32_t begin = 0, end = 0;                            ///< angles; kNobody: it is there at every angle
  std::uint32_t node = 0;                                      ///< one of its sub-edges
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cells;  ///< (angle, cell): the cell on its right from there on
};

struct ContactNames {
  std::function<Contact(std::uint32_t)> contact;             ///< of a segment
  std::function<bool(std::uint32_t, std::uint32_t)> corner;  ///< whether one follows the other at an end of both
};

using Key = std::tuple<int, std::uint32_t, std::uint32_t>;

Key key_of(const Contact& c) { return {static_cast<int>(c.kind), c.p, c.q}; }

using PatchKey = std::array<Key, 3>;

class CutPatches {
 public:
  CutPatches(const SweptBoundary& swept, const ContactNames& names)
      : swept_(swept), names_(names), angles_(static_cast<std::uint32_t>(swept.angles.size())) {}

  // Slab s lies after angle s - 1; the one before the first angle is the last one.
  std::vector<CutPatch> run() {
    if (angles_ == 0) {
      add_slab(0);
      for (CutPatch& p : patches_) p.begin = p.end = kNobody;
      return std::move(patches_);
    }
    std::map<PatchKey, std::uint32_t> first;
    for (std::uint32_t s = 1; s <= angles_; ++s) {
      add_slab(s);
      if (s == 1) first = open_;
    }
    join_ends(first);
    return std::move(patches_);
  }

 private:
  bool alive(const BoundaryGraph::Node& n, std::uint32_t slab) const {
    return (n.begin == kNobody || n.begin < slab) && (n.end == kNobody || n.end >= slab);
  }
  std::uint32_t cell(std::uint32_t n, std::uint32_t slab) const {
    const BoundaryGraph::Node& node = swept_.graph.nodes()[n];
    std::uint32_t at = node.born_cell;
    for (const auto& [angle, to] : node.cells)
      if (angle < slab) at = to;
    return at;
  }

  void add_slab(std::uint32_t slab) {
    const auto& nodes = swept_.graph.nodes();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> by_ids;  // (before, own) -> node
    for (std::uint32_t n = 0; n < nodes.size(); ++n)
      if (alive(nodes[n], slab)) by_ids[{nodes[n].left, nodes[n].id}] = n;
    std::map<PatchKey, std::uint32_t> now;
    for (const auto& [ids, n] : by_ids) {
      const Contact own = names_.contact(nodes[n].id), left = names_.contact(nodes[n].left);
      if (left == own) continue;  // not the first of its run
      std::uint32_t last = n;
      while (names_.contact(nodes[last].right) == own) last = by_ids.at({nodes[last].id, nodes[last].right});
      const Contact right = names_.contact(nodes[last].right);
      const PatchKey key{key_of(own), key_of(left), key_of(right)};
      const auto before = open_.find(key);
      // Not where a passage was shut in between.
      const bool goes_on =
          before != open_.end() && swept_.graph.shell_of(patches_[before->second].node) == swept_.graph.shell_of(n);
      const std::uint32_t p = goes_on ? before->second : static_cast<std::uint32_t>(patches_.size());
      if (!goes_on) {
        CutPatch fresh;
        fresh.patch.contact = own;
        fresh.patch.left = left;
        fresh.patch.right = right;
        fresh.patch.left_corner = names_.corner(nodes[n].left, nodes[n].id);
        fresh.patch.right_corner = names_.corner(nodes[last].id, nodes[last].right);
        fresh.begin = slab - 1;
        patches_.push_back(std::move(fresh));
      }
      CutPatch& patch = patches_[p];
      patch.end = slab == angles_ ? 0 : slab;
      patch.node = n;
      if (const std::uint32_t c = cell(n, slab); patch.cells.empty() || patch.cells.back().second != c)
        patch.cells.emplace_back(slab - 1, c);
      now[key] = p;
    }
    open_ = std::move(now);
  }

  // What is there before and after the first angle is one patch.
  void join_ends(const std::map<PatchKey, std::uint32_t>& first) {
    std::vector<bool> gone(patches_.size(), false);
    for (const auto& [key, from] : open_) {
      const auto to = first.find(key);
      if (to == first.end() ||
          swept_.graph.shell_of(patches_[to->second].node) != swept_.graph.shell_of(patches_[from].node))
        continue;
      CutPatch &early = patches_[to->second], &late = patches_[from];
      if (to->second == from) {
        early.begin = early.end = kNobody;
        continue;
      }
      early.begin = late.begin;
      early.cells.insert(early.cells.begin(), late.cells.begin(), late.cells.end());
      gone[from] = true;
    }
    std::size_t kept = 0;
    for (std::size_t p = 0; p < patches_.size(); ++p)
      if (!gone[p]) {
        if (kept != p) patches_[kept] = std::move(patches_[p]);
        ++kept;
      }
    patches_.resize(kept);
  }

  const SweptBoundary& swept_;
  const ContactNames& names_;
  std::uint32_t angles_;
  std::vector<CutPatch> patches_;
  std::map<PatchKey, std::uint32_t> open_;  // in the slab before
};

/// All patches: in every slab sub-edges of one contact that follow each other are put together; what has the same
/// contact and neighbours in the next slab is the same patch. Requires a closed turn. O(slabs s log s), s the size of a
/// slice.
std::vector<CutPatch> cut_patches(const SweptBoundary& swept, const ContactNames& names) {
  return CutPatches(swept, names).run();
}

// The order of angles by theta in (-pi, pi]: the sweep runs from -pi / 2 to 3 pi / 2.
struct AngleOrder {
  std::vector<std::uint32_t> index;  ///< of the sweep's angles
  explicit AngleOrder(const std::vector<ExactAngle>& angles) : index(angles.size()) {
    std::uint32_t after = 0;
    const auto passes_pi = [&](const ExactAngle& a) {
      return a.chart == 1 && exact::compare(a.t, exact::BigRational(0)) > 0;
    };
    for (const ExactAngle& a : angles) after += passes_pi(a);
    std::uint32_t first = after, wrapped = 0;
    for (std::size_t k = 0; k < angles.size(); ++k) index[k] = passes_pi(angles[k]) ? wrapped++ : first++;
  }
  std::uint32_t of(std::uint32_t k) const { return k == kNobody ? kNobody : index[k]; }
};

class Export {
 public:
  Export(const SweptBoundary& swept, const TurningForms& forms, planar::ObstacleState& state)
      : swept_(swept),
        forms_(forms),
        graph_(swept.graph),
        state_(state),
        order_(swept.angles),
        edge_ends_{EdgeEnds(state.obstacle, state.base->operands[0]), EdgeEnds(state.robot, state.base->operands[1])} {}

  void run() {
    base::HeldMemory held;
    held.add(graph_.nodes().size() * kOfNode);
    add_angles();
    if (state_.robot.touching_points().empty() && state_.obstacle.touching_points().empty()) add_patches();
    else add_cut_patches();
    add_cells();
    std::vector<std::uint32_t> last;
    for (const std::vector<std::uint32_t>& nodes : source_) last.push_back(nodes.back());
    add_shells(swept_, last, state_);
    for (ObstacleEvent event : swept_.events) {
      event.angle = order_.of(event.angle);
      state_.events.push_back(event);
    }
    for (TightFeature feature : swept_.tight) {
      feature.angle = order_.of(feature.angle);
      state_.tight.push_back(feature);
    }
    std::stable_sort(state_.tight.begin(), state_.tight.end(),
                     [](const TightFeature& a, const TightFeature& b) { return a.angle < b.angle; });
    std::stable_sort(state_.events.begin(), state_.events.end(),
                     [](const ObstacleEvent& a, const ObstacleEvent& b) { return a.angle < b.angle; });
  }

 private:
  // What patches, cells and shells hold of a node of the graph: its patch, twice while the list of them grows, and
  // three short lists.
  static constexpr std::uint64_t kOfNode = 2 * sizeof(Patch) + 3 * (sizeof(std::vector<int>) + 32);

  void add_angles() {
    state_.angles.resize(swept_.angles.size());
    std::vector<const ExactAngle*> sorted(swept_.angles.size());
    for (std::uint32_t k = 0; k < swept_.angles.size(); ++k) sorted[order_.of(k)] = &swept_.angles[k];
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      state_.exact_angles.push_back(*sorted[k]);
      state_.angles[k] = event_angle(*sorted[k]);
    }
  }

  Contact contact(std::uint32_t id) const {
    const Operand &p = state_.base->operands[0], &q = state_.base->operands[1];
    const WalkSegment s = graph_.segments().segment(id);
    if (s.side == 0) return {Contact::Kind::edge_of_p, p.edge_index[s.edge], q.vertex_index[s.vertex]};
    return {Contact::Kind::edge_of_q, p.vertex_index[s.vertex], q.edge_index[s.edge]};
  }
  // Whether the second segment follows the first one at an end of both. At a cut, which is no vertex of its edge, they
  // cross.
  bool corner(std::uint32_t first, std::uint32_t second) const {
    const WalkSegment a = graph_.segments().segment(first), b = graph_.segments().segment(second);
    return meet_at_ends(forms_, a, b) && edge_ends_[a.side].ends(a.edge) && edge_ends_[b.side].starts(b.edge);
  }

  void add_patches() {
    const auto& nodes = graph_.nodes();
    patch_of_.assign(nodes.size(), kNobody);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      // A node that goes on after the end of the turn belongs to the patch of the one it becomes.
      if (graph_.continued(n) != n) continue;
      if (nodes[n].begin != kNobody && nodes[n].begin == nodes[n].end) continue;  // came and went at one angle
      patch_of_[n] = static_cast<std::uint32_t>(state_.patches.size());
      Patch patch;
      patch.contact = contact(nodes[n].id);
      patch.left = contact(nodes[n].left);
      patch.right = contact(nodes[n].right);
      patch.left_corner = corner(nodes[n].left, nodes[n].id);
      patch.right_corner = corner(nodes[n].id, nodes[n].right);
      patch.begin = order_.of(nodes[n].begin);
      patch.end = order_.of(nodes[n].end);
      state_.patches.push_back(patch);
      state_.patch_cells.push_back({});
      source_.push_back({n});
    }
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const std::uint32_t to = graph_.continued(n);
      if (to == n || to == kNobody) continue;
      patch_of_[n] = patch_of_[to];
      Patch& patch = state_.patches[patch_of_[to]];
      patch.begin = order_.of(nodes[n].begin);
      source_[patch_of_[to]].insert(source_[patch_of_[to]].begin(), n);
      if (nodes[to].end == kNobody && nodes[n].begin == kNobody) patch.begin = patch.end = Patch::kNone;
    }
  }

  void add_cut_patches() {
    const ContactNames names{[this](std::uint32_t id) { return contact(id); },
                             [this](std::uint32_t a, std::uint32_t b) { return corner(a, b); }};
    cut_ = cut_patches(swept_, names);
    for (CutPatch& cut : cut_) {
      cut.patch.begin = order_.of(cut.begin);
      cut.patch.end = order_.of(cut.end);
      state_.patches.push_back(cut.patch);
      state_.patch_cells.push_back({});
      source_.push_back({cut.node});
    }
  }
  // Adds cells in the order of slabs from the patch's beginning, or from slab 0.
  void add_cells_of_cut_patches(const std::vector<std::uint32_t>& index) {
    for (std::size_t p = 0; p < cut_.size(); ++p) {
      auto& cells = state_.patch_cells[p];
      for (const auto& [angle, cell] : cut_[p].cells)
        cells.emplace_back(swept_.angles.empty() ? 0 : order_.of(angle), index[cell]);
      if (cut_[p].begin != kNobody) continue;
      std::sort(cells.begin(), cells.end());
      cells.insert(cells.begin(), {0, cells.back().second});
    }
  }

  // Cells at the end of the turn go on as those at its start.
  void add_cells() {
    const auto& nodes = graph_.nodes();
    std::vector<std::uint32_t> same(graph_.cells().size());
    for (std::uint32_t c = 0; c < same.size(); ++c) same[c] = c;
    for (std::uint32_t n = 0; n < nodes.size(); ++n)
      if (const std::uint32_t to = graph_.continued(n); to != n) {
        const std::uint32_t first = nodes[to].cells.empty() ? nodes[to].cell : nodes[to].born_cell;
        same[nodes[n].cell] = first;
        at_turn_.emplace_back(nodes[n].cell, first);
      }
    std::vector<std::uint32_t> index(same.size(), kNobody);
    for (std::uint32_t c = 0; c < same.size(); ++c) {
      if (same[c] != c) continue;
      index[c] = static_cast<std::uint32_t>(state_.cells.size());
      const BoundaryGraph::Cell& cell = graph_.cells()[c];
      state_.cells.push_back({order_.of(cell.begin), order_.of(cell.end), cell.unbounded, 0});
    }
    for (std::uint32_t c = 0; c < same.size(); ++c)
      if (same[c] != c) {
        index[c] = index[same[c]];
        state_.cells[index[c]].begin = order_.of(graph_.cells()[c].begin);
      }
    name_components(same, index);
    for (const auto& [a, b] : graph_.touching_cells()) state_.touching_cells.emplace_back(index[a], index[b]);
    if (!cut_.empty()) return add_cells_of_cut_patches(index);
    const auto slab = [&](std::uint32_t angle) {
      if (angle != kNobody) return order_.of(angle);
      return swept_.angles.empty() ? 0 : order_.of(static_cast<std::uint32_t>(swept_.angles.size() - 1));
    };
    for (std::size_t p = 0; p < source_.size(); ++p)
      for (const std::uint32_t n : source_[p]) {
        state_.patch_cells[p].emplace_back(slab(nodes[n].begin), index[nodes[n].born_cell]);
        for (const auto& [angle, cell] : nodes[n].cells) state_.patch_cells[p].emplace_back(slab(angle), index[cell]);
      }
  }

  // Joined by the sweep, and by the end of the turn.
  void name_components(const std::vector<std::uint32_t>& same, const std::vector<std::uint32_t>& index) {
    Partition components = graph_.components();
    for (const auto& [a, b] : at_turn_) components.join(a, b);
    std::map<std::uint32_t, std::uint32_t> names;
    for (std::uint32_t c = 0; c < same.size(); ++c)
      state_.cells[index[c]].component =
          names.emplace(components.find(c), static_cast<std::uint32_t>(names.size())).first->second;
  }

  const SweptBoundary& swept_;
  const TurningForms& forms_;
  const BoundaryGraph& graph_;
  planar::ObstacleState& state_;
  AngleOrder order_;
  std::array<EdgeEnds, 2> edge_ends_;
  std::vector<std::uint32_t> patch_of_;
  std::vector<CutPatch> cut_;                                     // where rings touch
  std::vector<std::vector<std::uint32_t>> source_;                // per patch: its nodes in the order of the turn
  std::vector<std::pair<std::uint32_t, std::uint32_t>> at_turn_;  // cells
};

}  // namespace

void export_obstacle(const SweptBoundary& swept, const TurningForms& forms, planar::ObstacleState& state) {
  Export(swept, forms, state).run();
}

}  // namespace dymsum::planar

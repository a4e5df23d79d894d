#include "cspace/obstacle/obstacle_export.h"

#include <algorithm>

#include "base/memory_budget.h"
#include "cspace/events/walk_indices.h"
#include "cspace/obstacle/cut_patches.h"
#include "cspace/obstacle/obstacle_shells.h"

namespace dymsum::planar {
namespace {

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

#include "planar/rotation/path_levels.h"

#include <algorithm>

namespace dymsum::planar {
namespace {

constexpr std::uint32_t kUnknown = SliceMap::kNone;

std::unique_ptr<SliceMap> map_at(const CspaceObstacle& obstacle, const Orientation& theta) {
  return std::make_unique<SliceMap>(std::move(obstacle.slice(theta, Semantics::open)).value());
}

}  // namespace

PathLevels::PathLevels(const CspaceObstacle& obstacle, Touching touching, double frame)
    : obstacle_(obstacle), touching_(touching), frame_(frame), pivot_(obstacle.robot(), obstacle.obstacle()) {}

const SliceMap& PathLevels::map(std::size_t k) {
  PathLevel& level = *levels_[k];
  if (!level.map) {
    level.map = map_at(obstacle_, level.theta);
    ++slices_;
  }
  return *level.map;
}

const SliceGraph& PathLevels::graph(std::size_t k) {
  PathLevel& level = *levels_[k];
  if (!level.graph) level.graph = std::make_unique<SliceGraph>(map(k), touching_ == Touching::allowed, frame_);
  return *level.graph;
}

std::size_t PathLevels::add(const Orientation& theta) {
  auto level = std::make_unique<PathLevel>(PathLevel{theta, exact_angle(theta), nullptr, nullptr});
  const auto at = std::partition_point(levels_.begin(), levels_.end(),
                                       [&](const auto& l) { return compare(l->angle, level->angle) < 0; });
  const auto k = static_cast<std::size_t>(at - levels_.begin());
  if (at == levels_.end() || compare((*at)->angle, level->angle) != 0) levels_.insert(at, std::move(level));
  return k;
}

void PathLevels::add_all() {
  const std::vector<EventAngle>& angles = obstacle_.angles();
  for (std::uint32_t k = 0; k < angles.size(); ++k) {
    add(obstacle_.inside(k));
    if (touching_ == Touching::allowed && angles[k].exact) add(*angles[k].exact);
  }
  for (const auto& [n, d] : {std::pair{0, 1}, {1, 1}, {1, 0}, {-1, 1}})
    if (levels_.size() < 4) add(d == 0 ? Orientation::half_turn() : *Orientation::of(n, d));
}

std::vector<Orientation> PathLevels::between(std::size_t k) const {
  const ExactAngle &a = angle(k), &b = angle((k + 1) % size());
  std::vector<Orientation> more;
  for (const ExactAngle& e : obstacle_.state().exact_angles) {
    // Strictly between: beyond a, and not beyond b, on the way round.
    const int past = compare(e, a), before = compare(e, b);
    if (past == 0 || before == 0) continue;
    if (compare(a, b) < 0 ? past > 0 && before < 0 : past > 0 || before < 0)
      return {orientation_between(a, e), orientation_between(e, b)};
  }
  return {orientation_between(a, b)};
}

// The free cell on the right of an edge of a slice at an orientation of that slab.
std::uint32_t PathLevels::cell_in_slab(std::uint32_t slab, const SliceMap& map, std::uint32_t edge) {
  const auto [at, fresh] = patches_.try_emplace(slab);
  if (fresh)
    for (const auto& loop : obstacle_.loops(slab)) at->second.insert(at->second.end(), loop.begin(), loop.end());
  const SliceMap::Edge& e = map.edges()[edge];
  // A contact may be there twice, with different ones before it; where contacts coincide a slice may name another of
  // them.
  std::vector<std::uint32_t> near;
  for (const std::uint32_t p : at->second) {
    const Patch& patch = obstacle_.patches()[p];
    if (patch.contact != e.contact) continue;
    near.push_back(obstacle_.free_cell(slab, p));
    if (patch.left == e.before) return near.back();
  }
  const bool one = !near.empty() && std::all_of(near.begin(), near.end(), [&](auto c) { return c == near[0]; });
  return one ? near[0] : kUnknown;
}

// At an event angle: at an orientation next to it, up to which a place of the face stays free.
std::uint32_t PathLevels::cell_beside(std::size_t k, std::uint32_t face) {
  const SliceGraph& at = graph(k);
  const auto inside = std::find_if(at.trapezoids().begin(), at.trapezoids().end(),
                                   [&](const auto& t) { return t.face == face; });
  const std::vector<ExactAngle>& angles = obstacle_.state().exact_angles;
  const auto next = std::find_if(angles.begin(), angles.end(), [&](const auto& e) { return compare(e, angle(k)) > 0; });
  const bool alone = compare(angles[0], angle(k)) == 0;
  const ExactAngle limit = next != angles.end() ? *next
                           : alone              ? exact_angle(orientation_between(angle(k), angle(k)))
                                                : angles[0];
  pivot_.stand(inside->centre);
  const Orientation beside = pivot_.beside(theta(k), limit, TurnDirection::counter_clockwise);
  const std::unique_ptr<SliceMap> map = map_at(obstacle_, beside);
  ++slices_;
  const SliceGraph graph(*map, false, frame_);
  const std::vector<std::uint32_t> nodes = graph.nodes_at(SlicePoint(inside->centre));
  const std::optional<std::uint32_t> slab = obstacle_.slab_of(beside);
  if (nodes.empty() || !slab) return kUnknown;
  const std::uint32_t edge = graph.edge_of(graph.trapezoids()[nodes[0]].face);
  return edge == kUnknown ? kUnknown : cell_in_slab(*slab, *map, edge);
}

std::uint32_t PathLevels::cell(std::size_t k, std::uint32_t face) {
  const SliceGraph& at = graph(k);
  auto& known = known_[levels_[k].get()];
  known.resize(at.faces());
  if (known[face]) return *known[face];
  std::uint32_t cell = kUnknown;
  if (const std::optional<std::uint32_t> slab = this->slab(k)) {
    const std::uint32_t edge = at.edge_of(face);
    if (edge != kUnknown) cell = cell_in_slab(*slab, map(k), edge);
  } else {
    cell = cell_beside(k, face);
  }
  known[face] = cell;
  return cell;
}

std::vector<std::uint32_t> PathLevels::cells(std::size_t k, std::uint32_t group) {
  std::vector<std::uint32_t> all;
  const SliceGraph& at = graph(k);
  std::vector<bool> seen(at.faces(), false);
  for (std::uint32_t n = 0; n < at.trapezoids().size(); ++n) {
    const std::uint32_t face = at.trapezoids()[n].face;
    if (at.group_of(n) != group || seen[face]) continue;
    seen[face] = true;
    all.push_back(cell(k, face));
  }
  return all;
}

std::vector<std::uint32_t> PathLevels::components(std::size_t k, std::uint32_t group) {
  std::vector<std::uint32_t> all = cells(k, group);
  for (std::uint32_t& c : all)
    if (c != kUnknown) c = obstacle_.free_cells()[c].component;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace dymsum::planar

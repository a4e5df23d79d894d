#include "cspace/planner/path_levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/double_text.h"
#include "cspace/boundary/obstacle_state.h"
#include "exact/rounding_bound.h"

namespace dymsum::planar {
namespace {

std::unique_ptr<SliceMap> map_at(const CspaceObstacle& obstacle, const Orientation& theta) {
  return std::make_unique<SliceMap>(std::move(obstacle.slice(theta, Semantics::open)).value());
}

}  // namespace

PathLevels::PathLevels(const CspaceObstacle& obstacle, const PlanOptions& options, double frame)
    : obstacle_(obstacle),
      touching_(options.touching),
      most_bytes_(options.memory == 0 ? options.slice_bytes : std::min(options.slice_bytes, options.memory / 4)),
      frame_(frame),
      pivot_(obstacle.robot(), obstacle.obstacle()) {
  for (std::uint32_t k = 0; k < obstacle.patches().size(); ++k)
    patches_[key_of(obstacle.patches()[k].contact)].push_back(k);
}

const SliceMap& PathLevels::map(std::size_t k) {
  PathLevel& level = *levels_[k];
  level.looked_at = ++looks_;
  if (!level.map) {
    level.map = map_at(obstacle_, level.theta);
    hold(level.map->bytes());
    ++slices_;
  }
  return *level.map;
}

const SliceGraph& PathLevels::graph(std::size_t k) {
  PathLevel& level = *levels_[k];
  level.looked_at = ++looks_;
  if (!level.graph) {
    level.graph = std::make_unique<SliceGraph>(map(k), touching_ == Touching::allowed, frame_);
    hold(level.graph->bytes());
  }
  return *level.graph;
}

// A slice is about as large as the arrays of its sum, which counted before they were made.
void PathLevels::hold(std::uint64_t bytes) {
  bytes_ += bytes;
  held_.add(bytes);
}

// Half of them, so that it is done seldom.
void PathLevels::let_go() {
  if (bytes_ <= most_bytes_) return;
  std::vector<PathLevel*> kept;
  for (const std::unique_ptr<PathLevel>& level : levels_)
    if (level->map) kept.push_back(level.get());
  std::sort(kept.begin(), kept.end(), [](const auto* a, const auto* b) { return a->looked_at < b->looked_at; });
  for (auto level = kept.begin(); level != kept.end() && bytes_ > most_bytes_ / 2; ++level) {
    const std::uint64_t bytes = (*level)->map->bytes() + ((*level)->graph ? (*level)->graph->bytes() : 0);
    bytes_ -= bytes;
    held_.give(bytes);
    (*level)->graph.reset();
    (*level)->map.reset();
  }
}

// The absolute error of the difference of two angles in (-pi, pi]: their doubles, and a rounding of at most 2 pi. No
// input shows it where arc tangents are rounded monotonously, as they mostly are: orientations then never are in the
// wrong order.
constexpr double kAngleGap = exact::rounding_bound(2 * 12 + 4, 32);

std::size_t PathLevels::index_of(const PathLevel* level) const {
  const double theta = level->theta.radians();
  const auto at = std::partition_point(levels_.begin(), levels_.end(), [&](const auto& l) {
    const double d = l->theta.radians() - theta;
    return std::abs(d) > kAngleGap ? d < 0 : compare(l->angle, level->angle) < 0;
  });
  return static_cast<std::size_t>(at - levels_.begin());
}

std::size_t PathLevels::add(const Orientation& theta) {
  auto level = std::make_unique<PathLevel>(theta);
  const std::size_t k = index_of(level.get());
  if (k < levels_.size() && compare(levels_[k]->angle, level->angle) == 0) return k;
  level->slab = obstacle_.slab_of(theta);
  level->id = static_cast<std::uint32_t>(levels_.size());
  levels_.insert(levels_.begin() + static_cast<std::ptrdiff_t>(k), std::move(level));
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

std::optional<std::uint32_t> PathLevels::event_before_next(std::size_t k) const {
  const std::vector<ExactAngle>& events = ObstacleInternals::of(obstacle_).exact_angles;
  if (events.empty()) return std::nullopt;
  // Levels of one slab or of neighbouring ones.
  if (events.size() > 1) {
    const std::uint32_t next = slab_after((k + 1) % size());
    return slab_after(k) == next ? std::nullopt : std::optional(next);
  }
  const std::uint32_t first = (slab_after(k) + 1) % static_cast<std::uint32_t>(events.size());
  // The event is past a, and not past b, on the round.
  const ExactAngle &a = angle(k), &b = angle((k + 1) % size()), &e = events[first];
  const bool past = compare(e, a) > 0, before = compare(e, b) <= 0;
  return (compare(a, b) < 0 ? past && before : past || before) ? std::optional(first) : std::nullopt;
}

std::vector<Orientation> PathLevels::between(std::size_t k) const {
  const ExactAngle &a = angle(k), &b = angle((k + 1) % size());
  if (const std::optional<std::uint32_t> event = event_before_next(k)) {
    const ExactAngle& e = ObstacleInternals::of(obstacle_).exact_angles[*event];
    if (compare(e, b) != 0) return {orientation_between(a, e), orientation_between(e, b)};
  }
  return {orientation_between(a, b)};
}

// The free cell on the right of an edge of a slice at an orientation of that slab.
std::uint32_t PathLevels::cell_in_slab(std::uint32_t slab, const SliceMap& map, std::uint32_t edge) {
  const SliceMap::Edge& e = map.edges()[edge];
  const auto at = patches_.find(key_of(e.contact));
  if (at == patches_.end()) return kUnknown;
  // A contact may be there twice, with different ones before it; where contacts coincide a slice may name another of
  // them.
  std::vector<std::uint32_t> near;
  for (const std::uint32_t p : at->second) {
    const Patch& patch = obstacle_.patches()[p];
    if (!is_in_slab(patch, slab, obstacle_.angles().size())) continue;
    near.push_back(obstacle_.free_cell(slab, p));
    if (patch.left == e.before) return near.back();
  }
  const bool one = !near.empty() && std::all_of(near.begin(), near.end(), [&](auto c) { return c == near[0]; });
  return one ? near[0] : kUnknown;
}

// One for each loop: where one edge of it does not decide, another may.
std::vector<std::uint32_t> PathLevels::cells_of(std::uint32_t slab, const SliceMap& map, const SliceGraph& graph,
                                                std::uint32_t face) {
  std::vector<std::uint32_t> all;
  bool new_loop = true;
  std::uint32_t before = 0;
  for (const std::uint32_t edge : graph.edges_of(face)) {
    // The last edge of a ring leads back to its first spot.
    for (; before < edge; ++before) new_loop = new_loop || map.edges()[before].to < map.edges()[before].from;
    if (new_loop) all.push_back(kUnknown);
    new_loop = false;
    if (all.back() == kUnknown) all.back() = cell_in_slab(slab, map, edge);
  }
  return all;
}

std::uint32_t PathLevels::slab_after(std::size_t k) const {
  if (levels_[k]->slab) return *levels_[k]->slab;
  const std::vector<ExactAngle>& angles = ObstacleInternals::of(obstacle_).exact_angles;
  const auto at =
      std::partition_point(angles.begin(), angles.end(), [&](const ExactAngle& e) { return compare(e, angle(k)) < 0; });
  return static_cast<std::uint32_t>(at - angles.begin());
}

// The cells at an event angle: at an orientation next to it, up to which a position of the face stays free.
std::vector<std::uint32_t> PathLevels::cells_beside(std::size_t k, std::uint32_t face) {
  const SliceGraph& at = graph(k);
  const auto inside =
      std::find_if(at.trapezoids().begin(), at.trapezoids().end(), [&](const auto& t) { return t.face == face; });
  const std::vector<ExactAngle>& angles = ObstacleInternals::of(obstacle_).exact_angles;
  const std::size_t next = (slab_after(k) + 1) % angles.size();
  const ExactAngle limit = angles.size() > 1 ? angles[next] : exact_angle(orientation_between(angle(k), angle(k)));
  pivot_.stand(inside->centre);
  const Orientation beside = pivot_.beside(theta(k), limit, TurnDirection::counter_clockwise);
  const std::unique_ptr<SliceMap> map = map_at(obstacle_, beside);
  ++slices_;
  const SliceGraph graph(*map, false, frame_);
  const std::vector<std::uint32_t> nodes = graph.nodes_at(SlicePoint(inside->centre));
  const std::optional<std::uint32_t> slab = obstacle_.slab_of(beside);
  if (nodes.empty() || !slab) return {kUnknown};
  return cells_of(*slab, *map, graph, graph.trapezoids()[nodes[0]].face);
}

const std::vector<std::uint32_t>& PathLevels::cells(std::size_t k, std::uint32_t group) {
  std::vector<std::optional<std::vector<std::uint32_t>>>& known = levels_[k]->cells;
  if (!known.empty() && known[group]) return *known[group];
  const SliceGraph& at = graph(k);
  known.resize(at.groups());
  std::vector<std::uint32_t> all;
  std::vector<bool> seen(at.faces(), false);
  for (std::uint32_t n = 0; n < at.trapezoids().size(); ++n) {
    const std::uint32_t face = at.trapezoids()[n].face;
    if (at.group_of(n) != group || seen[face]) continue;
    seen[face] = true;
    const std::vector<std::uint32_t> more = slab(k) ? cells_of(*slab(k), map(k), at, face) : cells_beside(k, face);
    all.insert(all.end(), more.begin(), more.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return *(known[group] = std::move(all));
}

std::vector<std::uint32_t> PathLevels::components(std::size_t k, std::uint32_t group) {
  std::vector<std::uint32_t> all = cells(k, group);
  for (std::uint32_t& c : all)
    if (c != kUnknown) c = obstacle_.free_cells()[c].component;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

namespace {

std::string degrees_text(double radians, int digits) {
  return base::general_text(radians * 180 / std::numbers::pi, digits);
}

std::uint32_t component_count(const CspaceObstacle& obstacle) {
  std::uint32_t count = 0;
  for (const FreeCell& cell : obstacle.free_cells()) count = std::max(count, cell.component + 1);
  return count;
}

}  // namespace

JoinedComponents::JoinedComponents(const CspaceObstacle& obstacle) : classes_(component_count(obstacle)) {}

SearchStop JoinedComponents::join_touching(const CspaceObstacle& obstacle, PathLevels& levels,
                                           const SearchLimits& limits) {
  constexpr int kAtATime = 64;  // slices after the last look at the clock: few are made in any case
  int looked = 0;
  const std::vector<FreeCell>& cells = obstacle.free_cells();
  for (const auto& [a, b] : ObstacleInternals::of(obstacle).touching_cells)
    classes_.join(cells[a].component, cells[b].component);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (levels.slab(k)) continue;
    const SearchStop stop = limits.query();
    if (stop == SearchStop::cancelled || (stop == SearchStop::out_of_time && ++looked % kAtATime == 0)) return stop;
    levels.let_go();
    const SliceGraph& graph = levels.graph(k);
    if (graph.groups() >= graph.faces() + levels.map(k).cracks().size()) continue;
    for (std::uint32_t g = 0; g < graph.groups(); ++g) {
      const std::vector<std::uint32_t> together = levels.components(k, g);
      for (const std::uint32_t c : together)
        if (c != SliceMap::kNone && together[0] != SliceMap::kNone) classes_.join(together[0], c);
    }
  }
  return SearchStop::none;
}

FreeComponent described(const CspaceObstacle& obstacle, std::uint32_t component) {
  FreeComponent c;
  c.index = component;
  const std::size_t slabs = obstacle.angles().size();
  std::vector<bool> covered(slabs, false);
  for (const FreeCell& cell : obstacle.free_cells()) {
    if (cell.component != component) continue;
    c.unbounded = c.unbounded || cell.unbounded;
    if (cell.begin == Patch::kNone || cell.begin == cell.end) {
      c.all_angles = true;
      continue;
    }
    for (std::size_t k = cell.begin; k != cell.end; k = (k + 1) % slabs) covered[k] = true;
  }
  c.all_angles = c.all_angles || std::find(covered.begin(), covered.end(), false) == covered.end();
  for (std::size_t k = 0; k < slabs && !c.all_angles; ++k) {
    if (covered[k] && !covered[(k + slabs - 1) % slabs]) c.from = obstacle.angles()[k].theta;
    if (!covered[k] && covered[(k + slabs - 1) % slabs]) c.to = obstacle.angles()[k].theta;
  }
  for (std::uint32_t k = 0; k < obstacle.shells().size(); ++k)
    if (obstacle.shells()[k].free_component == component) c.shells.push_back(k);
  return c;
}

std::string text_of(const FreeComponent& c) {
  std::string text =
      "component " + std::to_string(c.index) + (c.unbounded ? ", which reaches infinity" : ", which is enclosed");
  if (!c.all_angles)
    text += " and has angles from " + degrees_text(c.from, 6) + " to " + degrees_text(c.to, 6) + " degrees only";
  if (!c.shells.empty()) text += ", bounded by shell";
  for (const std::uint32_t s : c.shells) text += ' ' + std::to_string(s);
  return text;
}

std::string text_of(const SearchLimit& limit) {
  std::string text = limit.out_of_time
                         ? "the time limit of " + base::general_text(limit.seconds, 6) + " s was reached"
                         : "what joins them is passed along a curve alone, touching all the way, and not by "
                           "translations and rotations in place";
  const auto position = [](const Point& p) {
    return "(" + base::general_text(p.x, 10) + ", " + base::general_text(p.y, 10) + ")";
  };
  if (limit.passage)
    text += ", at the passage between " + degrees_text(limit.passage->from, 10) + " and " +
            degrees_text(limit.passage->to, 10) + " degrees from " + position(limit.passage->reached) + " to " +
            position(limit.passage->beyond);
  return text;
}

}  // namespace dymsum::planar

#include "planar/edit/edit_loops.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planar/boundary/boundary.h"

namespace dymsum::planar {
namespace {

double length_of(const EditArrangement& a, LiveSubEdge at) {
  const Soup& soup = a.soup();
  return (a.end_of(at).t - a.start_of(at).t) * (std::abs(soup.dx(at.segment)) + std::abs(soup.dy(at.segment)));
}

// The covered cell that holds a sub-edge's midpoint, if it provably has one.
std::optional<GridCell> covered_midpoint(const EditArrangement& a, LiveSubEdge at, const CountedCover& cover) {
  const EditArrangement::End from = a.start_of(at), to = a.end_of(at);
  const double t = 0.5 * (from.t + to.t);
  if (!(t - from.t > from.error + kFractionRoundings && to.t - t > to.error + kFractionRoundings)) return std::nullopt;
  const SoupBox& b = a.soup().boxes[at.segment];
  const Grid& grid = cover.grid();
  const Point shift = cover.shift();
  const GridCell cell{grid.row(b.ay + t * b.dy + shift.y), grid.column(b.ax + t * b.dx + shift.x)};
  if (!cover.covered(cell.row, cell.column)) return std::nullopt;
  return cell;
}

// Proofs in the names after an edit; without edges where one of them is gone.
void rename_proof(CoverProof& proof, const std::array<WalkChanges, 2>& walks) {
  if (!proof.edges) return;
  const std::uint32_t e = walks[0].edge_after((*proof.edges)[0]), f = walks[1].edge_after((*proof.edges)[1]);
  if (e == kNone || f == kNone) proof.edges.reset();
  else proof.edges = {e, f};
}

}  // namespace

void EditLoops::rename(const std::array<WalkChanges, 2>& walks) {
  for (auto& [id, cycle] : cycles_) rename_proof(cycle.cover, walks);
  for (auto& [key, candidates] : nodes_)
    for (TightSuspect& candidate : candidates) rename_proof(candidate.cover, walks);
}

void EditLoops::break_cycles(EditArrangement& arrangement) {
  broken_.clear();
  lost_.clear();
  for (const std::uint32_t mark : arrangement.take_broken())
    if (const auto it = cycles_.find(mark); it != cycles_.end()) {
      broken_.insert(std::move(*it));
      cycles_.erase(it);
    }
}

bool EditLoops::still_covered(const CoverProof& proof, const CountedCover& cover) const {
  return proof.edges || (proof.cell && cover.covered(proof.cell->row, proof.cell->column));
}

// Whether a position where nothing overlapped before is covered now.
bool EditLoops::covered_anew(const SegmentPosition& x, const NewOverlap& anew, Collision& collision) {
  return !anew.provably_none(x) && collision.overlaps_right_of(x);
}

// Cycles that are as they were: a proof of cover may be gone, and what bounded the sum may be covered by what is new.
void EditLoops::recheck(EditArrangement& arrangement, const NewOverlap& anew, const CountedCover& cover,
                        Collision& collision) {
  for (auto& [id, cycle] : cycles_) {
    ++work_.kept;
    if (!cycle.kept && still_covered(cycle.cover, cover)) {
      ++work_.witnessed;
      continue;
    }
    if (cycle.kept && connected_ && cycle.winding > 0) continue;  // decided with the others
    const SegmentPosition x = arrangement.sample(arrangement.sub_from(cycle.sample));
    const bool covered = cycle.kept ? covered_anew(x, anew, collision) : collision.overlaps_right_of(x);
    if (!covered) {
      cycle.kept = true;
      cycle.cover = {};
      continue;
    }
    cycle.cover = {collision.crossing_edges(), std::nullopt};
    if (cycle.kept) lose(cycle);
  }
}

// A cycle that bounded the sum does so no longer.
void EditLoops::lose(EditCycle& cycle) {
  cycle.kept = false;
  lost_.push_back(cycle);
  cycle.ring.reset();
  cycle.identity = 0;
}

void EditLoops::walk(EditArrangement& arrangement, LiveSubEdge start) {
  const std::uint32_t id = next_mark_++;
  std::vector<LiveSubEdge> path;
  std::vector<std::uint32_t> marks;
  LiveSubEdge at = start;
  std::uint32_t known_dead = EditArrangement::kNoCycle;
  do {
    const std::uint32_t mark = arrangement.mark(at);
    if (mark >= first_mark_) break;  // a walk of this update passed here
    if (mark >= EditArrangement::kFirstCycle && mark != known_dead) {
      if (alive(mark)) break;
      known_dead = mark;
    }
    marks.push_back(mark);
    path.push_back(at);
    arrangement.set_mark(at, id);
    at = arrangement.next(at);
  } while (at.segment != kNone && !(at == start));
  if (at.segment != kNone && at == start && !path.empty()) close(arrangement, id, path, marks);
}

void EditLoops::close(EditArrangement& arrangement, std::uint32_t id, std::vector<LiveSubEdge>& path,
                      const std::vector<std::uint32_t>& marks) {
  ++work_.traced;
  EditCycle& cycle = cycles_[id];
  Array<Step> steps;
  steps.reserve(path.size());
  for (const LiveSubEdge& at : path) steps.push_back({at.k, at.segment});
  cycle.winding = turning_number(arrangement.soup(), steps);
  Undecided undecided{id, {}, {}};
  double best = -1, best_kept = -1;
  std::uint32_t last_mark = EditArrangement::kNoCycle;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double length = length_of(arrangement, path[i]);
    if (length > best) {
      best = length;
      cycle.sample = arrangement.start_name(path[i]);
    }
    if (const auto node = arrangement.end_node(path[i])) cycle.nodes.push_back(node->key);
    if (marks[i] < EditArrangement::kFirstCycle) continue;
    const auto was = broken_.find(marks[i]);
    if (was == broken_.end()) continue;
    if (was->second.kept && length > best_kept) {
      best_kept = length;
      undecided.was_kept = arrangement.start_name(path[i]);
    }
    if (!was->second.kept && marks[i] != last_mark && was->second.cover.edges)
      undecided.witnesses.push_back(*was->second.cover.edges);
    last_mark = marks[i];
  }
  cycle.steps = std::move(path);
  undecided_.push_back(std::move(undecided));
}

void EditLoops::trace(EditArrangement& arrangement) {
  first_mark_ = next_mark_;
  undecided_.clear();
  for (const std::uint32_t s : arrangement.take_fresh())
    for (std::uint32_t k = 0; k <= arrangement.event_count(s); ++k)
      if (arrangement.mark({s, k}) == EditArrangement::kFresh) walk(arrangement, {s, k});
}

// The outer boundary of before may be covered, where another one has come around it.
void EditLoops::uncover_outer(EditArrangement& arrangement, const NewOverlap& anew, Collision& collision) {
  for (auto& [id, cycle] : cycles_) {
    if (cycle.winding <= 0 || !cycle.kept) continue;
    if (!covered_anew(arrangement.sample(arrangement.sub_from(cycle.sample)), anew, collision)) continue;
    cycle.cover = {collision.crossing_edges(), std::nullopt};
    lose(cycle);
  }
}

void EditLoops::decide(EditArrangement& arrangement, const NewOverlap* anew, const CountedCover& cover,
                       Collision& collision) {
  std::size_t counter_clockwise = 0;
  std::uint32_t outer = 0;
  for (const auto& [id, cycle] : cycles_)
    if (cycle.winding > 0) {
      ++counter_clockwise;
      outer = id;
    }
  const bool only = connected_ && counter_clockwise == 1;
  if (connected_ && !only && anew != nullptr) uncover_outer(arrangement, *anew, collision);
  for (const Undecided& u : undecided_) {
    EditCycle& cycle = cycles_.at(u.cycle);
    if (only && u.cycle == outer) {
      cycle.kept = true;
      continue;
    }
    const bool before = u.was_kept.segment != kNone && anew != nullptr;
    if (before) cycle.sample = u.was_kept;
    const LiveSubEdge at = arrangement.sub_from(cycle.sample);
    if (const auto cell = covered_midpoint(arrangement, at, cover)) {
      cycle.cover.cell = cell;
      continue;
    }
    ++work_.tests;
    const SegmentPosition x = arrangement.sample(at);
    const auto known = std::find_if(u.witnesses.begin(), u.witnesses.end(), [&](const CrossingEdges& edges) {
      return anew != nullptr && anew->provably_cross(x, edges);
    });
    if (known != u.witnesses.end()) {
      cycle.cover.edges = *known;
      continue;
    }
    cycle.kept = before ? !covered_anew(x, *anew, collision) : !collision.overlaps_right_of(x);
    if (!cycle.kept) cycle.cover.edges = collision.crossing_edges();
  }
}

void EditLoops::update_nodes(EditArrangement& arrangement) {
  for (const std::uint64_t key : arrangement.take_old_nodes()) nodes_.erase(key);
  for (const EditNode& node : arrangement.take_new_nodes()) {
    std::vector<TightSuspect>& list = nodes_[node.key];
    list.clear();
    list.push_back(
        {{static_cast<std::uint32_t>(node.key >> 32), static_cast<std::uint32_t>(node.key)}, false, false, {}});
    const LiveNodeLinks links = arrangement.links_of(node);
    for (const LiveSubEdge& crack : links.cracks) list.push_back({arrangement.start_name(crack), true, false, {}});
  }
}

void EditLoops::update(EditArrangement& arrangement, const Changes& changes, const CountedCover& cover,
                       Collision& collision) {
  work_ = {};
  for (auto& [id, cycle] : cycles_) cycle.steps.clear();  // those that no ring was made of
  if (!changes.all_new) rename(changes.walks);
  break_cycles(arrangement);
  const NewOverlap anew(arrangement.soup().lattice, *arrangement.soup().operands[0], *arrangement.soup().operands[1],
                        {changes.walks[0].new_corners(), changes.walks[1].new_corners()});
  recheck(arrangement, anew, cover, collision);
  update_nodes(arrangement);
  trace(arrangement);
  decide(arrangement, changes.all_new ? nullptr : &anew, cover, collision);
  for (auto& [id, cycle] : broken_)
    if (cycle.kept) lost_.push_back(std::move(cycle));
}

// Candidates off the boundary have to be covered, or a tight feature shows.
bool EditLoops::degenerate(EditArrangement& arrangement, const CountedCover& cover, Collision& collision) {
  if (nodes_.empty()) return false;
  std::unordered_map<std::uint64_t, std::uint32_t> visits;
  for (const auto& [id, cycle] : cycles_)
    if (cycle.kept)
      for (const std::uint64_t key : cycle.nodes)
        if (++visits[key] > 1) return true;
  for (auto& [key, candidates] : nodes_)
    for (TightSuspect& candidate : candidates) {
      if (candidate.covered && still_covered(candidate.cover, cover)) continue;
      if (!candidate.crack && visits.count(key) != 0) continue;
      const SegmentPosition x = candidate.crack ? arrangement.sample(arrangement.sub_from(candidate.at))
                                                : arrangement.position_of(candidate.at);
      candidate.covered = collision.overlaps(x);
      if (!candidate.covered) return true;
      candidate.cover.edges = collision.crossing_edges();
    }
  return false;
}

std::vector<LiveSubEdge> EditLoops::steps_of(EditArrangement& arrangement, EditCycle& cycle) const {
  if (!cycle.steps.empty()) return std::exchange(cycle.steps, {});
  std::vector<LiveSubEdge> steps;
  const LiveSubEdge start = arrangement.sub_from(cycle.sample);
  LiveSubEdge at = start;
  do {
    steps.push_back(at);
    at = arrangement.next(at);
  } while (!(at == start));
  return steps;
}

}  // namespace dymsum::planar

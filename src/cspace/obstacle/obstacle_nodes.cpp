#include <algorithm>
#include <set>
#include <stdexcept>

#include "cspace/events/walk_numbers.h"
#include "cspace/obstacle/obstacle_sweep.h"
#include "planar/position/ring_containment.h"
#include "planar/turning/slice.h"

namespace dymsum::planar {

std::uint32_t ObstacleSweep::id(const WalkSegment& s) const {
  const std::uint32_t n0 = forms_.size(0), n1 = forms_.size(1);
  return s.side == 0 ? s.edge * n1 + s.vertex : n0 * n1 + s.edge * n0 + s.vertex;
}

std::uint32_t ObstacleSweep::add_node(const WalkSegment& s, std::uint32_t cell) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  changed_ = true;
  Node node;
  node.segment = s;
  node.id = id(s);
  node.begin = now_;
  node.cell = node.born_cell = cell;
  node.same = first_[node.id];
  if (node.same != kNobody) nodes_[node.same].before = n;
  first_[node.id] = n;
  nodes_.push_back(std::move(node));
  shell_.push_back(n);
  return n;
}

void ObstacleSweep::end_node(std::uint32_t n) {
  Node& node = nodes_[n];
  changed_ = true;
  ended_.push_back(n);
  node.alive = false;
  node.end = now_;
  if (node.before != kNobody) nodes_[node.before].same = node.same;
  else first_[node.id] = node.same;
  if (node.same != kNobody) nodes_[node.same].before = node.before;
}

void ObstacleSweep::link(std::uint32_t from, std::uint32_t to) {
  if (nodes_[from].begin != now_) relinked_.emplace_back(from, nodes_[from].next);
  nodes_[from].next = to;
  nodes_[to].prev = from;
  join(shell_, from, to);
}

std::uint32_t ObstacleSweep::find(const std::vector<std::uint32_t>& parents, std::uint32_t i) {
  while (parents[i] != i) i = parents[i];
  return i;
}

void ObstacleSweep::join(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
  const auto root = [&](std::uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  };
  a = root(a);
  b = root(b);
  if (a != b) parents[std::max(a, b)] = std::min(a, b);
}

std::uint32_t ObstacleSweep::new_cell(bool unbounded) {
  const auto c = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back({now_, kNobody, unbounded});
  component_.push_back(c);
  return c;
}

// The neighbours of changed nodes keep their segment but may have got another neighbour: then they are other patches.
void ObstacleSweep::refresh(std::vector<std::uint32_t> touched) {
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const std::uint32_t n : touched) {
    if (!nodes_[n].alive) continue;
    const std::uint32_t left = nodes_[nodes_[n].prev].id, right = nodes_[nodes_[n].next].id;
    if (nodes_[n].left == left && nodes_[n].right == right) continue;
    if (nodes_[n].begin == now_) {
      nodes_[n].left = left;
      nodes_[n].right = right;
      continue;
    }
    const std::uint32_t prev = nodes_[n].prev, next = nodes_[n].next;
    end_node(n);
    const std::uint32_t m = add_node(nodes_[n].segment, nodes_[n].cell);
    join(shell_, n, m);
    link(prev == n ? m : prev, m);
    link(m, next == n ? m : next);
    nodes_[m].left = left;
    nodes_[m].right = right;
  }
}

// New nodes have the start, or the end, of old ones: their neighbours are those of the old ones, or what has come in
// place of these.
void ObstacleSweep::relink(const std::map<std::uint32_t, std::uint32_t>& starts,
                           const std::map<std::uint32_t, std::uint32_t>& ends, std::vector<std::uint32_t>& touched) {
  for (const auto& [n, to] : starts) {
    const auto moved = ends.find(nodes_[n].prev);
    link(moved == ends.end() ? nodes_[n].prev : moved->second, to);
    touched.push_back(nodes_[to].prev);
  }
  for (const auto& [n, from] : ends) {
    const auto moved = starts.find(nodes_[n].next);
    link(from, moved == starts.end() ? nodes_[n].next : moved->second);
    touched.push_back(nodes_[from].next);
  }
}

// Loops through `touched` after cycles were split, joined, born or lost: a loop keeps its free cell if no other one has
// a claim to it.
void ObstacleSweep::relabel(const std::vector<std::uint32_t>& touched, const std::vector<std::uint32_t>& lost,
                            const std::vector<std::pair<std::uint32_t, std::uint32_t>>& more) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::map<std::uint32_t, std::size_t> loop_of;
  std::vector<std::set<std::uint32_t>> claims;
  std::map<std::uint32_t, std::vector<std::size_t>> holders;
  for (const std::uint32_t cell : lost) holders[cell];
  for (const std::uint32_t first : touched) {
    if (!nodes_[first].alive || loop_of.contains(first)) continue;
    loops.emplace_back();
    claims.emplace_back();
    for (std::uint32_t n = first; loop_of.emplace(n, loops.size() - 1).second; n = nodes_[n].next) {
      loops.back().push_back(n);
      if (nodes_[n].cell != kNobody) claims.back().insert(nodes_[n].cell);
    }
  }
  for (const auto& [n, cell] : more)
    if (const auto l = loop_of.find(n); l != loop_of.end()) claims[l->second].insert(cell);
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const std::uint32_t cell : claims[l]) holders[cell].push_back(l);
  std::set<std::uint32_t> ended;
  for (const auto& [cell, by] : holders)
    if (by.size() != 1 || claims[by[0]].size() != 1) ended.insert(cell);
  for (const std::uint32_t cell : ended) cells_[cell].end = now_;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const bool keeps = claims[l].size() == 1 && !ended.contains(*claims[l].begin());
    std::uint32_t cell = keeps ? *claims[l].begin() : kNobody;
    if (!keeps) {
      cell = new_cell(false);
      born_ += claims[l].empty();
      for (const std::uint32_t c : claims[l]) {
        join(component_, c, cell);
        cell_links_.push_back({c, cell});
      }
    }
    for (const std::uint32_t n : loops[l]) {
      if (nodes_[n].cell == cell) continue;
      if (nodes_[n].begin != now_) nodes_[n].cells.emplace_back(now_, cell);
      else nodes_[n].born_cell = cell;
      nodes_[n].cell = cell;
    }
  }
}

std::vector<WalkSegment> ObstacleSweep::segments_of(const SumRing& ring) const {
  std::vector<WalkSegment> all;
  const std::size_t n = ring.vertices.size();
  for (std::size_t k = 0; k < n; ++k)
    append_run(walk_segment(ring.vertices[k].out), walk_segment(ring.vertices[k + 1 == n ? 0 : k + 1].in), forms_, all);
  return all;
}

WalkSegment ObstacleSweep::walk_segment(const Contact& c) const {
  return c.kind == Contact::Kind::edge_of_p ? WalkSegment{0, walk_edge_[0][c.p], walk_vertex_[1][c.q]}
                                            : WalkSegment{1, walk_edge_[1][c.q], walk_vertex_[0][c.p]};
}

std::uint32_t ObstacleSweep::cell_at(const SumRing& ring) const {
  const std::vector<WalkSegment> segments = segments_of(ring);
  const std::uint32_t left = id(segments.back());
  for (std::uint32_t n = first_[id(segments.front())]; n != kNobody; n = nodes_[n].same)
    if (nodes_[n].left == left) return nodes_[n].cell;
  throw std::logic_error("ObstacleSweep: a ring of the slice is not on the boundary");
}

// Sums of several parts: what lies in a hole, or outside of everything, has several loops. Their free cells are
// connected.
void ObstacleSweep::join_faces(const Orientation& at) {
  SumOptions options;
  options.semantics = Semantics::regular;
  const Result<PlanarSum> sum = sum_at(*base_, at, options);
  if (!sum) throw std::logic_error("ObstacleSweep: a slice failed");
  std::vector<const SumRing*> holes;
  for (const SumPart& part : sum->parts)
    for (const SumRing& hole : part.holes) holes.push_back(&hole);
  std::uint32_t unbounded = kNobody;
  for (const SumPart& part : sum->parts) {
    const std::uint32_t cell = cell_at(part.outer);
    const SumRing* inside = nullptr;
    for (const SumRing* hole : holes)
      if (ring_contains(*hole, part.outer, *exact_source(*sum), sum->at_error) &&
          (inside == nullptr || ring_contains(*inside, *hole, *exact_source(*sum), sum->at_error)))
        inside = hole;
    if (inside != nullptr) {
      join(component_, cell, cell_at(*inside));
      continue;
    }
    cells_[cell].unbounded = true;
    if (unbounded != kNobody) join(component_, cell, unbounded);
    unbounded = cell;
  }
}

}  // namespace dymsum::planar

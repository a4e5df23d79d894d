#include "cspace/boundary/boundary_graph.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace dymsum::planar {

std::vector<std::uint32_t> BoundaryGraph::alive() const {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t n : recently_alive_)
    if (nodes_[n].alive) all.push_back(n);
  return all;
}

void BoundaryGraph::begin_angle() {
  now_ = kNobody;
  changed_ = false;
  ended_.clear();
  relinked_.clear();
  loops_born_ = 0;
}

std::uint32_t BoundaryGraph::add_node(const WalkSegment& s, std::uint32_t cell) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  changed_ = true;
  Node node;
  node.segment = s;
  node.id = segments_.of(s);
  node.begin = now_;
  node.cell = node.born_cell = cell;
  node.next_on_segment = first_on_[node.id];
  if (node.next_on_segment != kNobody) nodes_[node.next_on_segment].prev_on_segment = n;
  first_on_[node.id] = n;
  nodes_.push_back(std::move(node));
  recently_alive_.push_back(n);
  shells_.add();
  return n;
}

void BoundaryGraph::end_node(std::uint32_t n) {
  Node& node = nodes_[n];
  changed_ = true;
  ended_.push_back(n);
  node.alive = false;
  node.end = now_;
  if (++recently_ended_ * 2 > recently_alive_.size()) {
    std::erase_if(recently_alive_, [&](std::uint32_t m) { return !nodes_[m].alive; });
    recently_ended_ = 0;
  }
  if (node.prev_on_segment != kNobody) nodes_[node.prev_on_segment].next_on_segment = node.next_on_segment;
  else first_on_[node.id] = node.next_on_segment;
  if (node.next_on_segment != kNobody) nodes_[node.next_on_segment].prev_on_segment = node.prev_on_segment;
}

void BoundaryGraph::link(std::uint32_t from, std::uint32_t to) {
  if (nodes_[from].begin != now_) relinked_.emplace_back(from, nodes_[from].next);
  nodes_[from].next = to;
  nodes_[to].prev = from;
  shells_.join(from, to);
}

std::uint32_t BoundaryGraph::new_cell(bool unbounded) {
  cells_.push_back({now_, kNobody, unbounded});
  return components_.add();
}

void BoundaryGraph::apply(const BoundaryEdit& edit) {
  Ends starts, ends;
  std::vector<std::uint32_t> fresh, lost;
  std::vector<Claim> claims;
  for (const BoundaryEdit::Run& run : edit.runs) {
    const std::vector<std::uint32_t> nodes = add_run(run);
    fresh.insert(fresh.end(), nodes.begin(), nodes.end());
    starts[run.first] = nodes.front();
    ends[run.last] = nodes.back();
    claims.push_back({nodes.front(), nodes_[run.first].cell});
    claims.push_back({nodes.back(), nodes_[run.last].cell});
  }
  std::vector<std::uint32_t> touched = relink(starts, ends);
  for (const std::uint32_t n : edit.gone) {
    lost.push_back(nodes_[n].cell);
    end_node(n);
  }
  for (const std::vector<WalkSegment>& loop : edit.births) add_loop(loop, fresh);
  touched.insert(touched.end(), fresh.begin(), fresh.end());
  refresh(std::move(touched));
  if (edit.loops_may_change || !edit.births.empty()) share_out(fresh, lost, claims);
}

std::vector<std::uint32_t> BoundaryGraph::add_run(const BoundaryEdit::Run& run) {
  std::vector<std::uint32_t> nodes;
  for (const WalkSegment& s : run.segments) {
    nodes.push_back(add_node(s, nodes_[run.first].cell));
    if (nodes.size() > 1) link(nodes[nodes.size() - 2], nodes.back());
  }
  shells_.join(run.first, nodes.front());
  shells_.join(run.last, nodes.back());
  return nodes;
}

void BoundaryGraph::add_loop(const std::vector<WalkSegment>& segments, std::vector<std::uint32_t>& fresh) {
  const std::size_t first = fresh.size();
  for (const WalkSegment& s : segments) fresh.push_back(add_node(s, kNobody));
  for (std::size_t k = first; k < fresh.size(); ++k) link(fresh[k], fresh[k + 1 == fresh.size() ? first : k + 1]);
}

// The neighbours of new nodes are those of the old ones, or what has come in place of these. Returns the neighbours.
std::vector<std::uint32_t> BoundaryGraph::relink(const Ends& starts, const Ends& ends) {
  std::vector<std::uint32_t> touched;
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
  return touched;
}

// New nodes learn their neighbours. Those of before keep their segment but may have got another neighbour: then they
// are other patches.
void BoundaryGraph::refresh(std::vector<std::uint32_t> touched) {
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const std::uint32_t n : touched) {
    if (!nodes_[n].alive) continue;
    const std::uint32_t left = nodes_[nodes_[n].prev].id, right = nodes_[nodes_[n].next].id;
    if (nodes_[n].left == left && nodes_[n].right == right) continue;
    std::uint32_t m = n;
    if (nodes_[n].begin != now_) {
      const std::uint32_t prev = nodes_[n].prev, next = nodes_[n].next;
      end_node(n);
      m = add_node(nodes_[n].segment, nodes_[n].cell);
      shells_.join(n, m);
      link(prev == n ? m : prev, m);
      link(m, next == n ? m : next);
    }
    nodes_[m].left = left;
    nodes_[m].right = right;
  }
}

void BoundaryGraph::apply(const SliceEdit& edit) {
  std::vector<std::uint32_t> all, lost;
  for (const SliceEdit::Loop& loop : edit.loops)
    for (const SliceEdit::Position& position : loop.positions) {
      if (position.stays != kNobody) {
        all.push_back(position.stays);
        continue;
      }
      all.push_back(add_node(segments_.segment(position.segment), edit.loops_may_change ? kNobody : loop.cell));
      nodes_.back().left = position.left;
      nodes_.back().right = position.right;
    }
  std::vector<Claim> claims;
  for (const auto& [n, position] : edit.continued) {
    shells_.join(n, all[position]);
    claims.push_back({all[position], nodes_[n].cell});
  }
  for (const std::uint32_t n : edit.ended) {
    lost.push_back(nodes_[n].cell);
    end_node(n);
  }
  const bool first = cells_.empty();
  std::size_t begin = 0;
  for (const SliceEdit::Loop& loop : edit.loops) {
    const std::size_t end = begin + loop.positions.size();
    const auto at = [&](const SliceEdit::End& e) { return e.position == kNobody ? e.node : all[e.position]; };
    for (std::size_t k = begin; k + 1 < end; ++k) link(all[k], all[k + 1]);
    link(all[end - 1], loop.open ? at(loop.after) : all[begin]);
    if (loop.open) link(at(loop.before), all[begin]);
    if (first)
      give_cell({all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)},
                new_cell(loop.outer));
    begin = end;
  }
  if (first) {
    at_start_ = static_cast<std::uint32_t>(nodes_.size());
    return;
  }
  if (edit.loops_may_change) share_out(all, lost, claims);
  for (const auto& [n, position] : edit.touching)
    touching_cells_.emplace_back(nodes_[n].cell, nodes_[all[position]].cell);
}

// The cells of loops through `touched` after loops were split, joined, born or lost: a loop keeps its free cell if no
// other one has a claim to it. `lost`: cells of nodes that went.
void BoundaryGraph::share_out(const std::vector<std::uint32_t>& touched, const std::vector<std::uint32_t>& lost,
                              const std::vector<Claim>& more) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::map<std::uint32_t, std::size_t> loop_of;
  std::vector<std::set<std::uint32_t>> claims;
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
  std::map<std::uint32_t, std::vector<std::size_t>> holders;
  for (const std::uint32_t cell : lost) holders[cell];
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const std::uint32_t cell : claims[l]) holders[cell].push_back(l);
  std::set<std::uint32_t> ended;
  for (const auto& [cell, by] : holders)
    if (by.size() != 1 || claims[by[0]].size() != 1) ended.insert(cell);
  for (const std::uint32_t cell : ended) cells_[cell].end = now_;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (claims[l].size() == 1 && !ended.contains(*claims[l].begin())) {
      give_cell(loops[l], *claims[l].begin());
      continue;
    }
    const std::uint32_t cell = new_cell(false);
    loops_born_ += claims[l].empty();
    for (const std::uint32_t c : claims[l]) {
      components_.join(c, cell);
      cell_links_.push_back({c, cell});
    }
    give_cell(loops[l], cell);
  }
}

void BoundaryGraph::give_cell(const std::vector<std::uint32_t>& loop, std::uint32_t cell) {
  for (const std::uint32_t n : loop) {
    if (nodes_[n].cell == cell) continue;
    if (nodes_[n].begin != now_) nodes_[n].cells.emplace_back(now_, cell);
    else nodes_[n].born_cell = cell;
    nodes_[n].cell = cell;
  }
}

bool BoundaryGraph::close() {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> last;
  const std::vector<std::uint32_t> at_end = alive();
  for (const std::uint32_t n : at_end) last[{nodes_[n].id, nodes_[n].left, nodes_[n].right}] = n;
  bool closed = at_end.size() == at_start_ && last.size() == at_end.size();
  continued_.resize(nodes_.size());
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) continued_[n] = n;
  for (std::uint32_t n = 0; n < at_start_; ++n) {
    const auto it = last.find({nodes_[n].id, nodes_[n].left, nodes_[n].right});
    if (it == last.end()) {
      closed = false;
      continue;
    }
    shells_.join(n, it->second);
    continued_[it->second] = n;
  }
  return closed;
}

void BoundaryGraph::check() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(std::string("BoundaryGraph: ") + what);
  };
  std::map<std::uint32_t, std::uint32_t> nodes_of_cell;
  std::size_t listed = 0;
  for (const std::uint32_t n : alive()) {
    const Node& node = nodes_[n];
    require(node.next != kNobody && nodes_[node.next].alive && nodes_[node.next].prev == n, "links are not mutual");
    require(node.left == nodes_[node.prev].id && node.right == nodes_[node.next].id, "a neighbour is not known");
    require(node.cell == nodes_[node.next].cell, "a loop has two cells");
    require(node.cell < cells_.size() && cells_[node.cell].end == kNobody, "a loop has a cell that ended");
    require(node.end == kNobody, "a node that ended is alive");
    ++nodes_of_cell[node.cell];
    ++listed;
  }
  for (const std::uint32_t n : alive()) {
    std::uint32_t count = 0, m = n;
    if (nodes_of_cell.at(nodes_[n].cell) == 0) continue;
    do {
      m = nodes_[m].next;
      ++count;
    } while (m != n);
    require(count == nodes_of_cell.at(nodes_[n].cell), "two loops have one cell");
    nodes_of_cell.at(nodes_[n].cell) = 0;
  }
  for (std::uint32_t s = 0; s < first_on_.size(); ++s)
    for (std::uint32_t n = first_on_[s]; n != kNobody; n = nodes_[n].next_on_segment, --listed)
      require(nodes_[n].alive && nodes_[n].id == s, "a list of a segment has a node of another one");
  require(listed == 0, "a node is in no list");
}

SliceEdit slice_difference(const BoundaryGraph& before, const std::vector<SliceLoop>& after,
                           const std::function<bool(std::uint32_t)>& parted) {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> old;
  for (const std::uint32_t n : before.alive()) old[{before[n].id, before[n].left, before[n].right}] = n;
  SliceEdit edit;
  std::uint32_t index = 0;
  for (const SliceLoop& loop : after) {
    SliceEdit::Loop& to = edit.loops.emplace_back();
    to.outer = loop.outer;
    const std::size_t n = loop.segments.size();
    for (std::size_t k = 0; k < n; ++k, ++index) {
      SliceEdit::Position position{loop.segments[k], loop.segments[(k + n - 1) % n], loop.segments[(k + 1) % n],
                                   kNobody};
      const auto it = old.find({position.segment, position.left, position.right});
      if (it != old.end() && parted(it->second)) {
        edit.touching.emplace_back(it->second, index);
      } else if (it != old.end()) {
        position.stays = it->second;
        old.erase(it);
      }
      to.positions.push_back(position);
    }
  }
  for (const auto& [key, n] : old) edit.ended.push_back(n);
  return edit;
}

}  // namespace dymsum::planar

#include "spatial/gauss/arc_crossings.h"

#include <algorithm>
#include <stdexcept>

namespace dymsum::spatial {

ArcCrossings::ArcCrossings(const Polytope& p, const Polytope& q) {
  for (int op = 0; op < 2; ++op) {
    const std::uint32_t edges = op == 0 ? p.edge_count() : q.edge_count();
    head[op].assign(edges, kNoCrossing);
    marked[op].assign(edges, 0);
  }
}

void ArcCrossings::clear() {
  all.clear();
  until.clear();
  free.clear();
  for (std::vector<std::uint32_t>& heads : head) std::fill(heads.begin(), heads.end(), kNoCrossing);
}

std::uint32_t ArcCrossings::append(std::uint32_t e, HalfEdge q, double until_then, std::uint32_t before) {
  const auto id = static_cast<std::uint32_t>(all.size());
  std::uint32_t& first = head[1][q / 2];
  all.push_back({e, q, {kNoCrossing, first}});
  first = id;
  until.push_back(until_then);
  (before == kNoCrossing ? head[0][e] : all[before].next[0]) = id;
  touch(1, q / 2);
  return id;
}

std::uint32_t ArcCrossings::add(int op, const Crossing& crossing) {
  std::uint32_t id;
  if (free.empty()) {
    id = static_cast<std::uint32_t>(all.size());
    all.emplace_back();
    until.push_back(kBeforeAll);
  } else {
    id = free.back();
    free.pop_back();
  }
  const std::uint32_t e = edge_of(op, crossing);
  all[id] = crossing;
  all[id].next[op] = head[op][e];
  head[op][e] = id;
  touch(op, e);
  return id;
}

void ArcCrossings::remove(int op, std::uint32_t id) {
  const std::uint32_t e = edge_of(op, all[id]);
  std::uint32_t* link = &head[op][e];
  while (*link != id) link = &all[*link].next[op];
  *link = all[id].next[op];
  touch(op, e);
  until[id] = kForever;
  free.push_back(id);
}

std::uint32_t ArcCrossings::order_along(int op, const Polytope& other, std::uint32_t e, std::uint32_t v) {
  for (std::uint32_t* link = &head[op][e]; *link != kNoCrossing; link = &all[*link].next[op]) {
    std::uint32_t* found = link;
    while (*found != kNoCrossing && other.origin[across(op, all[*found])] != v) found = &all[*found].next[op];
    if (*found == kNoCrossing) throw std::logic_error("Overlay: the crossings of an arc do not join");
    if (found != link) {
      const std::uint32_t id = *found;
      *found = all[id].next[op];
      all[id].next[op] = *link;
      *link = id;
    }
    v = other.target(across(op, all[*link]));
  }
  return v;
}

std::pair<std::uint32_t, std::uint32_t> ArcCrossings::ends_along(int op, const Polytope& other, std::uint32_t e) {
  const std::uint32_t first = head[op][e];
  const HalfEdge over = across(op, all[first]);
  std::uint32_t begin = other.origin[over], end = other.target(over);
  // Crossings that follow are joined at either end, those that do not fit yet are tried again.
  std::uint32_t rest = all[first].next[op], last = first, waiting = kNoCrossing;
  all[last].next[op] = kNoCrossing;
  bool joined = false;
  while (rest != kNoCrossing) {
    const std::uint32_t id = std::exchange(rest, all[rest].next[op]);
    const HalfEdge next_over = across(op, all[id]);
    std::uint32_t& next = all[id].next[op];
    if (other.origin[next_over] == end) {
      end = other.target(next_over);
      next = kNoCrossing;
      last = all[last].next[op] = id;
      joined = true;
    } else if (other.target(next_over) == begin) {
      begin = other.origin[next_over];
      next = std::exchange(head[op][e], id);
      joined = true;
    } else {
      next = std::exchange(waiting, id);
    }
    if (rest != kNoCrossing || waiting == kNoCrossing) continue;
    if (!std::exchange(joined, false)) throw std::logic_error("Overlay: the crossings of an arc do not join");
    rest = std::exchange(waiting, kNoCrossing);
  }
  return {begin, end};
}

}  // namespace dymsum::spatial

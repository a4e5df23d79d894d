#include "cspace/planner/slice_graph.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "exact/big.h"
#include "exact/rounding_bound.h"

namespace dymsum::planar {

using exact::BigRational;

namespace {

// The error of the height of an edge over a line between its ends, e being the most that their coordinates and the
// line's err by: with the slope s and ends more than kDistinct e apart, 2 e (1 + |s|) / (1 - 2 / kDistinct) for the
// slope, e for the left end and 2 e |s| for the distance from it, less than kMoved e (1 + |s|).
constexpr double kDistinct = 8, kMoved = 16;
static_assert(2 / (1 - 2 / kDistinct) + 2 <= kMoved / 2);
// The error besides, times the sizes of what is added: two differences, the quotient, another difference, the product,
// the sum.
constexpr double kHeight = exact::rounding_bound(6, 8);
// The error of half a sum. No input shows it: twice what spots err by is more where they err at all, and where they do
// not kHeight grants as much.
constexpr double kMidpoint = exact::rounding_bound(1, 2);
// The error of a difference.
constexpr double kDifference = exact::rounding_bound(1, 2);

// Names the connected pieces of a graph 0, 1, ... in the order of their first nodes; returns how many.
template <class Links>
std::uint32_t name_pieces(const Links& links, std::vector<std::uint32_t>& names) {
  names.assign(links.size(), SliceMap::kNone);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < links.size(); ++first) {
    if (names[first] != SliceMap::kNone) continue;
    names[first] = count;
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      for (const auto& l : links[node])
        if (names[l.to] == SliceMap::kNone) {
          names[l.to] = count;
          open.push_back(l.to);
        }
    }
    ++count;
  }
  return count;
}

}  // namespace

SliceGraph::SliceGraph(const SliceMap& map, bool touching, double frame)
    : map_(map), touching_(touching), frame_(frame) {
  add_lines();
  sweep_lines();
  name_faces();
  if (touching_) join_touching();
  groups_ = name_pieces(links_, group_);
}

std::size_t SliceGraph::bytes() const {
  // A trapezoid has some three links, and perhaps a line; its centre and the line may be long fractions.
  constexpr std::size_t kTrapezoid = sizeof(Trapezoid) + 4 * sizeof(Link) + sizeof(Line) + 256;
  return sizeof(*this) + trapezoids_.size() * kTrapezoid + 8 * map_.edges().size();
}

const SlicePoint& SliceGraph::left(std::uint32_t edge) const {
  const SliceMap::Edge& e = map_.edges()[edge];
  return map_.spots()[rank_[e.from] < rank_[e.to] ? e.from : e.to];
}

const SlicePoint& SliceGraph::right(std::uint32_t edge) const {
  const SliceMap::Edge& e = map_.edges()[edge];
  return map_.spots()[rank_[e.from] < rank_[e.to] ? e.to : e.from];
}

// The distinct abscissas of the ends of edges, and the frame.
void SliceGraph::add_lines() {
  const std::vector<SlicePoint>& spots = map_.spots();
  std::vector<std::uint32_t> order(map_.edges().size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = map_.edges()[k].from;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return compare_x(spots[a], spots[b]) < 0; });
  rank_.assign(spots.size(), SliceMap::kNone);
  lines_.push_back({-frame_, 0, exact::exact_value(-frame_), nullptr});
  for (std::size_t k = 0; k < order.size(); ++k) {
    const SlicePoint& s = spots[order[k]];
    if (k == 0 || compare_x(spots[order[k - 1]], s) != 0) lines_.push_back({s.at().x, s.error(), {}, &s});
    rank_[order[k]] = static_cast<std::uint32_t>(lines_.size() - 1);
  }
  lines_.push_back({frame_, 0, exact::exact_value(frame_), nullptr});
}

std::array<double, 2> SliceGraph::height(std::uint32_t edge, const Line& line) const {
  if (edge == kBottom || edge == kTop) return {edge == kTop ? frame_ : -frame_, 0};
  const SlicePoint &a = left(edge), &b = right(edge);
  const double e = std::max({a.error(), b.error(), line.error}), dx = b.at().x - a.at().x;
  if (!(dx > kDistinct * e)) return {a.at().y, std::numeric_limits<double>::infinity()};
  const double slope = (b.at().y - a.at().y) / dx, y = a.at().y + slope * (line.at - a.at().x);
  return {y,
          kMoved * e * (1 + std::abs(slope)) + kHeight * (std::abs(a.at().y) + std::abs(b.at().y) +
                                                          std::abs(slope) * (std::abs(line.at) + std::abs(a.at().x)))};
}

BigRational SliceGraph::exact_height(std::uint32_t edge, const BigRational& x) const {
  if (edge == kBottom || edge == kTop) return exact::exact_value(edge == kTop ? frame_ : -frame_);
  const Position &a = left(edge).exact(), &b = right(edge).exact();
  return BigRational(a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x));
}

// Compares the heights of two edges over a line; `rank` is that of a line through vertices, else SliceMap::kNone.
int SliceGraph::compare_heights(std::uint32_t e, std::uint32_t f, const Line& line, std::uint32_t rank) const {
  if (e == f) return 0;
  if (e == kBottom || f == kTop) return -1;
  if (f == kBottom || e == kTop) return 1;
  if (rank != SliceMap::kNone) {
    const SliceMap::Edge &a = map_.edges()[e], &b = map_.edges()[f];
    for (const std::uint32_t s : {a.from, a.to})
      if ((s == b.from || s == b.to) && rank_[s] == rank) return 0;
  }
  const auto [y, y_error] = height(e, line);
  const auto [z, z_error] = height(f, line);
  if (std::abs(y - z) > 1.01 * (y_error + z_error)) return y < z ? -1 : 1;
  return exact::compare(exact_height(e, line.exact()), exact_height(f, line.exact()));
}

BigRational SliceGraph::midpoint_of(std::uint32_t low, std::uint32_t high, const Line& line) const {
  const auto [y, y_error] = height(low, line);
  const auto [z, z_error] = height(high, line);
  const double midpoint = 0.5 * (y + z);
  if (z - y > 16 * (y_error + z_error) && y < midpoint && midpoint < z) return exact::exact_value(midpoint);
  return BigRational((exact_height(low, line.exact()) + exact_height(high, line.exact())) / 2);
}

// A line between two lines; a double where one lies provably between them.
SliceGraph::Line SliceGraph::midpoint_between(const Line& from, const Line& to) {
  Line midpoint{0.5 * (from.at + to.at), 0, {}, nullptr};
  if (to.at - from.at > 16 * (from.error + to.error) && from.at < midpoint.at && midpoint.at < to.at) {
    midpoint.x = exact::exact_value(midpoint.at);
    return midpoint;
  }
  midpoint.error = 2 * (from.error + to.error) + std::abs(midpoint.at) * kMidpoint;
  midpoint.x = BigRational((from.exact() + to.exact()) / 2);
  return midpoint;
}

// A trapezoid ends where an edge above or below it does, or where something begins inside.
void SliceGraph::end_at(Trapezoid& t, std::uint32_t line) const {
  t.to = line;
  const Line midpoint = midpoint_between(lines_[t.from], lines_[line]);
  t.centre = {midpoint.x, midpoint_of(t.low, t.high, midpoint)};
  t.near = SlicePoint(t.centre).at();
  t.size = (height(t.high, midpoint)[0] - height(t.low, midpoint)[0]) * (lines_[line].at - lines_[t.from].at);
}

// The edges over a column from below: those that end at its first line leave, and those that begin there come in.
// Edges do not cross, so that the others keep their order.
void SliceGraph::step_into(std::uint32_t column, const std::vector<std::uint32_t>& begin,
                           std::vector<std::uint32_t>& over) const {
  std::erase_if(over, [&](std::uint32_t e) {
    return rank_[map_.edges()[e].from] == column || rank_[map_.edges()[e].to] == column;
  });
  if (begin.empty()) return;
  const Line midpoint = midpoint_between(lines_[column], lines_[column + 1]);
  for (const std::uint32_t e : begin) {
    const auto at = std::partition_point(over.begin(), over.end(), [&](std::uint32_t f) {
      return compare_heights(f, e, midpoint, SliceMap::kNone) <= 0;
    });
    over.insert(at, e);
  }
}

void SliceGraph::sweep_lines() {
  std::vector<std::vector<std::uint32_t>> begin(lines_.size());  // edges, by their left lines
  for (std::uint32_t e = 0; e < map_.edges().size(); ++e) {
    const auto [a, b] = std::minmax(rank_[map_.edges()[e].from], rank_[map_.edges()[e].to]);
    if (a != b) begin[a].push_back(e);
  }
  std::vector<std::uint32_t> over, open, next, ended, begun;  // edges; trapezoids from below
  std::vector<std::uint32_t> above(map_.edges().size() + 1,
                                   SliceMap::kNone);  // the open one above an edge, or the frame
  const auto position = [&](std::uint32_t low) { return low == kBottom ? map_.edges().size() : low; };
  for (std::uint32_t column = 0; column < lines_.size(); ++column) {
    const bool last = column + 1 == lines_.size();
    if (!last) step_into(column, begin[column], over);
    next.clear(), ended.clear(), begun.clear();
    for (std::size_t k = 0; !last && k <= over.size(); k += 2) {
      const std::uint32_t low = k == 0 ? kBottom : over[k - 1], high = k == over.size() ? kTop : over[k];
      std::uint32_t& known = above[position(low)];
      if (known == SliceMap::kNone || trapezoids_[known].high != high) {
        begun.push_back(static_cast<std::uint32_t>(trapezoids_.size()));
        next.push_back(begun.back());
        trapezoids_.push_back({column, column, low, high, {}, {}, 0, 0});
        continue;
      }
      next.push_back(known);
      known = SliceMap::kNone;
    }
    for (const std::uint32_t t : open)
      if (above[position(trapezoids_[t].low)] == t) ended.push_back(t);
    for (const std::uint32_t t : ended)
      end_at(trapezoids_[t], column), above[position(trapezoids_[t].low)] = SliceMap::kNone;
    for (const std::uint32_t t : next) above[position(trapezoids_[t].low)] = t;
    links_.resize(trapezoids_.size());
    join_sides(column, ended, begun);
    open.swap(next);
  }
}

void SliceGraph::link(std::uint32_t a, std::uint32_t b, Link how) {
  how.to = b;
  links_[a].push_back(how);
  how.to = a;
  links_[b].push_back(how);
}

Position SliceGraph::via(const Link& l) const {
  if (l.touch != nullptr) return l.touch->exact();
  return {lines_[l.line].exact(), midpoint_of(l.low, l.high, lines_[l.line])};
}

// Trapezoids on both sides of a line whose sides have more than a point in common; both from below.
void SliceGraph::join_sides(std::uint32_t line, const std::vector<std::uint32_t>& ended,
                            const std::vector<std::uint32_t>& begun) {
  const Line& l = lines_[line];
  for (std::size_t i = 0, j = 0; i < ended.size() && j < begun.size();) {
    const Trapezoid &t = trapezoids_[ended[i]], &u = trapezoids_[begun[j]];
    const std::uint32_t low = compare_heights(t.low, u.low, l, line) < 0 ? u.low : t.low;
    const int higher = compare_heights(t.high, u.high, l, line);
    const std::uint32_t high = higher < 0 ? t.high : u.high;
    if (compare_heights(low, high, l, line) < 0) link(ended[i], begun[j], {0, line, low, high, nullptr});
    if (higher <= 0) ++i;
    if (higher >= 0) ++j;
  }
}

void SliceGraph::name_faces() {
  std::vector<std::uint32_t> names;
  faces_ = name_pieces(links_, names);
  edges_of_face_.assign(faces_, {});
  for (std::size_t k = 0; k < names.size(); ++k) {
    Trapezoid& t = trapezoids_[k];
    t.face = names[k];
    for (const std::uint32_t e : {t.low, t.high})
      if (e != kBottom && e != kTop) edges_of_face_[t.face].push_back(e);
  }
  for (std::vector<std::uint32_t>& edges : edges_of_face_) {
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }
}

std::vector<Position> SliceGraph::positions_of(std::uint32_t node) const {
  if (node < trapezoids_.size()) return {trapezoids_[node].centre};
  const auto [a, b] = map_.cracks()[node - trapezoids_.size()];
  const Position &from = map_.spots()[a].exact(), &to = map_.spots()[b].exact();
  return {from, to};
}

bool SliceGraph::holds(const Trapezoid& t, const SlicePoint& p) const {
  if (t.low != kBottom && side(left(t.low), right(t.low), p) < 0) return false;
  return t.high == kTop || side(left(t.high), right(t.high), p) <= 0;
}

std::vector<std::uint32_t> SliceGraph::nodes_at(const SlicePoint& p) const {
  const auto compare_line = [&](const Line& l) {
    const double d = p.at().x - l.at;
    if (std::abs(d) > 1.01 * (p.error() + l.error) + kDifference * std::abs(d)) return d > 0 ? 1 : -1;
    return exact::compare(p.exact().x, l.exact());
  };
  const auto beyond =
      std::partition_point(lines_.begin(), lines_.end(), [&](const Line& l) { return compare_line(l) > 0; });
  if (beyond == lines_.begin() || beyond == lines_.end()) return {};
  const auto line = static_cast<std::uint32_t>(beyond - lines_.begin());
  return nodes_at(p, line, compare_line(lines_[line]) == 0 && line + 1 < lines_.size());
}

// The same for a position on that line, or left of it and right of the one before.
std::vector<std::uint32_t> SliceGraph::nodes_at(const SlicePoint& p, std::uint32_t line, bool on_line) const {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t k = 0; k < trapezoids_.size() && trapezoids_[k].from < line + on_line; ++k)
    if (trapezoids_[k].to >= line && holds(trapezoids_[k], p)) nodes.push_back(k);
  if (!touching_) return nodes;
  for (std::uint32_t k = 0; k < map_.cracks().size(); ++k) {
    const SlicePoint &a = map_.spots()[map_.cracks()[k][0]], &b = map_.spots()[map_.cracks()[k][1]];
    if (on_segment(a, b, p)) nodes.push_back(static_cast<std::uint32_t>(trapezoids_.size()) + k);
  }
  return nodes;
}

// Joins what has p in common, unless all of it is one face.
void SliceGraph::join_at(const SlicePoint& p, const std::vector<std::uint32_t>& nodes) {
  const auto one_face = [&](std::uint32_t n) {
    return n < trapezoids_.size() && nodes[0] < trapezoids_.size() && trapezoids_[n].face == trapezoids_[nodes[0]].face;
  };
  if (nodes.size() < 2 || std::all_of(nodes.begin(), nodes.end(), one_face)) return;
  for (std::size_t k = 1; k < nodes.size(); ++k) link(nodes[0], nodes[k], {0, 0, kBottom, kTop, &p});
}

void SliceGraph::join_touching() {
  links_.resize(trapezoids_.size() + map_.cracks().size());
  for (std::uint32_t k = 0; k < map_.spots().size(); ++k) {
    const SlicePoint& s = map_.spots()[k];
    join_at(s, rank_[k] != SliceMap::kNone ? nodes_at(s, rank_[k], true) : nodes_at(s));
  }
  // Cracks that cross; meetings at their ends are among the spots.
  for (std::size_t i = 0; i < map_.cracks().size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::vector<SlicePoint>& s = map_.spots();
      const auto [a, b] = map_.cracks()[i];
      const auto [c, d] = map_.cracks()[j];
      if (side(s[a], s[b], s[c]) * side(s[a], s[b], s[d]) >= 0) continue;
      if (side(s[c], s[d], s[a]) * side(s[c], s[d], s[b]) >= 0) continue;
      const Position &p = s[a].exact(), &q = s[b].exact(), &u = s[c].exact(), &v = s[d].exact();
      const BigRational dx = v.x - u.x, dy = v.y - u.y;
      const BigRational fraction = ((u.x - p.x) * dy - (u.y - p.y) * dx) / ((q.x - p.x) * dy - (q.y - p.y) * dx);
      crossings_.emplace_back(along(p, q, fraction));
      join_at(crossings_.back(), nodes_at(crossings_.back()));
    }
}

std::uint32_t SliceGraph::group_at(const SlicePoint& p) const {
  const std::vector<std::uint32_t> nodes = nodes_at(p);
  return nodes.empty() ? SliceMap::kNone : group_[nodes[0]];
}

std::vector<Position> SliceGraph::way(const Position& from, const Position& to) const {
  const SlicePoint start(from), goal(to);
  if (map_.passage(start, goal, touching_).free) return {from, to};
  const std::vector<std::uint32_t> ends = nodes_at(goal);
  std::vector<const Link*> by(links_.size(), nullptr);
  std::vector<std::uint32_t> before(links_.size(), SliceMap::kNone);
  std::deque<std::uint32_t> open;
  for (const std::uint32_t n : nodes_at(start)) {
    before[n] = n;
    open.push_back(n);
  }
  const auto reached = [&](std::uint32_t n) { return before[n] != SliceMap::kNone; };
  while (!open.empty() && std::none_of(ends.begin(), ends.end(), reached)) {
    const std::uint32_t n = open.front();
    open.pop_front();
    for (const Link& l : links_[n])
      if (!reached(l.to)) {
        before[l.to] = n;
        by[l.to] = &l;
        open.push_back(l.to);
      }
  }
  const auto end = std::find_if(ends.begin(), ends.end(), reached);
  if (end == ends.end()) throw std::logic_error("SliceGraph::way: places of different groups");
  std::vector<Position> corners{to};
  for (std::uint32_t n = *end;; n = before[n]) {
    if (n < trapezoids_.size()) corners.push_back(trapezoids_[n].centre);
    if (by[n] == nullptr) break;
    corners.push_back(via(*by[n]));
  }
  corners.push_back(from);
  std::reverse(corners.begin(), corners.end());
  return pulled(corners);
}

// The path leads from every corner straight to the farthest later one that is in sight; inner corners as doubles where
// that is free.
std::vector<Position> SliceGraph::pulled(const std::vector<Position>& corners) const {
  std::vector<Position> few{corners.front()};
  for (std::size_t k = 0; k + 1 < corners.size();) {
    std::size_t next = corners.size() - 1;
    while (next > k + 1 && !map_.passage(SlicePoint(corners[k]), SlicePoint(corners[next]), touching_).free) --next;
    k = next;
    few.push_back(corners[k]);
  }
  for (std::size_t k = 1; k + 1 < few.size(); ++k) {
    const SlicePoint near(Point{SlicePoint(few[k]).at()}), before(few[k - 1]), after(few[k + 1]);
    if (map_.passage(before, near, touching_).free && map_.passage(near, after, touching_).free) few[k] = near.exact();
  }
  return few;
}

}  // namespace dymsum::planar

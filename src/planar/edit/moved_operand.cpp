#include "planar/edit/moved_operand.h"

#include <algorithm>
#include <atomic>

#include "exact/grid.h"
#include "exact/orient.h"
#include "planar/edit/followed_convolution.h"
#include "planar/operand/edges.h"
#include "planar/operand/make_lattice.h"
#include "planar/region/region.h"

namespace dymsum::planar {
namespace {

// Rings are walked as the region has them: with every vertex, nowhere cut, in units of 1.
bool walks_rings(const Operand& o) {
  const PlacedPoints& p = *o.points;
  if (p.fractions != nullptr || p.turned != nullptr || p.unit != 0 || !p.moderate()) return false;
  if (p.factors.x != 1 || p.factors.y != 1) return false;
  if (o.size() != p.input.size() || o.vertex_of_index.size() != p.input.size()) return false;
  for (const Loop& loop : o.loops)
    for (std::uint32_t w = loop.first; w < loop.last; ++w)
      if (o.source[w] != w || o.vertex_index[w] != w || o.next[w] != (w + 1 == loop.last ? loop.first : w + 1))
        return false;
  return true;
}

std::vector<MovedVertex> moved_vertices(const Operand& o, const Region& after, std::span<const std::uint32_t> moved) {
  std::vector<MovedVertex> list;
  auto next = moved.begin();
  std::uint32_t first = 0;
  for_each_chain(after.data(), [&](const std::vector<Point>& chain) {
    for (; next != moved.end() && *next - first < chain.size(); ++next) {
      const Point given = chain[*next - first], p = o.reflected ? Point{0 - given.x, 0 - given.y} : given;
      if (!(o.points->input[*next] == p)) list.push_back({*next, p});
    }
    first += static_cast<std::uint32_t>(chain.size());
  });
  return list;
}

void sort_once(std::vector<std::uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Nothing where a vertex is straight or a spike.
std::optional<OperandMoves> find_moves(const Operand& o, const Region& after, std::span<const std::uint32_t> moved) {
  OperandMoves moves;
  moves.moved = moved_vertices(o, after, moved);
  for (const MovedVertex& m : moves.moved) {
    const std::uint32_t before = o.prev[m.vertex], next = o.next[m.vertex];
    moves.edges.insert(moves.edges.end(), {before, m.vertex});
    moves.corners.insert(moves.corners.end(), {before, m.vertex, next});
  }
  sort_once(moves.edges);
  sort_once(moves.corners);
  const auto at = [&](std::uint32_t v) {
    const auto m = std::lower_bound(moves.moved.begin(), moves.moved.end(), v,
                                    [](const MovedVertex& a, std::uint32_t b) { return a.vertex < b; });
    return m != moves.moved.end() && m->vertex == v ? m->to : o.points->input[v];
  };
  for (const std::uint32_t v : moves.corners) {
    const int sense = exact::orient_sign(at(o.prev[v]), at(v), at(o.next[v]));
    if (sense == 0) return std::nullopt;
    moves.convex.push_back(sense > 0);
  }
  return moves;
}

// What make_operand writes, once more where vertices moved.
class Mover {
 public:
  Mover(Operand& o, const OperandMoves& moves) : o_(o), moves_(moves), points_(const_cast<PlacedPoints&>(*o.points)) {}

  void run() {
    o_.forget_trees();
    move_points();
    const OwnEdges own(points_);
    for (std::size_t k = 0; k < moves_.corners.size(); ++k) o_.convex[moves_.corners[k]] = moves_.convex[k];
    for (const std::uint32_t e : moves_.edges) {
      const Point d = own.vector(e, o_.next[e]);
      o_.ex[e] = d.x;
      o_.ey[e] = d.y;
    }
    if (elsewhere_) {
      for (std::uint32_t w = 0; w < o_.size(); ++w) put_vertex(w);
      for (std::uint32_t w = 0; w < o_.size(); ++w) put_edge(w);
    } else {
      for (const MovedVertex& m : moves_.moved) put_vertex(m.vertex);
      for (const std::uint32_t e : moves_.edges) put_edge(e);
    }
    bool extremes = elsewhere_;
    for (Loop& loop : o_.loops) extremes |= find_extremes(loop);
    for (Component& c : o_.components) describe(c, extremes);
    for (DirectionList& list : o_.directions) sort_again(list, own, o_, moves_.edges);
  }

 private:
  // The exponent is the least of all vertices, the box that of all.
  void move_points() {
    PlacedPoints& p = points_;
    bool rim = false, least = false;
    const Point low = p.offset;
    const auto at_rim = [&](std::uint32_t v) {
      return p.x[v] == 0 || p.y[v] == 0 || p.x[v] == p.width || p.y[v] == p.height;
    };
    std::vector<Point> now;
    for (const MovedVertex& m : moves_.moved) {
      const Point was = p.input[m.vertex];
      rim |= at_rim(m.vertex);
      least |= exact::common_exponent(std::span<const Point>(&was, 1)) <= p.exponent;
      p.input[m.vertex] = m.to;
      p.x[m.vertex] = m.to.x - low.x;
      p.y[m.vertex] = m.to.y - low.y;
      rim |= !(p.x[m.vertex] > 0 && p.y[m.vertex] > 0 && p.x[m.vertex] < p.width && p.y[m.vertex] < p.height);
      now.push_back(m.to);
    }
    const int exponent = exact::common_exponent(now);
    const bool zeros = std::all_of(now.begin(), now.end(), [](Point v) { return v == Point{}; });
    if (exponent < p.exponent || (least && (exponent > p.exponent || zeros)))
      p.exponent = exact::common_exponent(p.input);
    if (rim) find_box();
  }

  void find_box() {
    PlacedPoints& p = points_;
    Point low = p.input[0], high = low;
    for (const Point v : p.input) {
      low = {std::min(low.x, v.x), std::min(low.y, v.y)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y)};
    }
    elsewhere_ = !(low == p.offset);
    p.offset = low;
    p.extent = std::max(high.x - low.x, high.y - low.y);
    p.top = top_of(p.extent);
    if (elsewhere_) position_in_units(p, 0);
    p.width = high.x - low.x;
    p.height = high.y - low.y;
  }

  void put_vertex(std::uint32_t v) {
    o_.x[v] = points_.x[v];
    o_.y[v] = points_.y[v];
  }
  void put_edge(std::uint32_t e) {
    const std::uint32_t to = o_.next[e];
    o_.boxes[e] = {o_.x[e], o_.y[e], o_.x[to], o_.y[to], o_.ex[e], o_.ey[e]};
  }

  // Whether a loop's extreme vertices may be others.
  bool find_extremes(Loop& loop) {
    const std::vector<Point>& v = points_.input;
    const auto begin = std::lower_bound(moves_.moved.begin(), moves_.moved.end(), loop.first,
                                        [](const MovedVertex& m, std::uint32_t first) { return m.vertex < first; });
    bool open = false;
    for (auto m = begin; m != moves_.moved.end() && m->vertex < loop.last; ++m) {
      const std::uint32_t k = m->vertex;
      open |= k == loop.min_x || k == loop.max_x || k == loop.min_y || k == loop.max_y || m->to.x <= v[loop.min_x].x ||
              m->to.x >= v[loop.max_x].x || m->to.y <= v[loop.min_y].y || m->to.y >= v[loop.max_y].y;
    }
    if (!open) return false;
    loop.min_x = loop.max_x = loop.min_y = loop.max_y = loop.first;
    for (std::uint32_t i = loop.first + 1; i < loop.last; ++i) {
      if (v[i].x < v[loop.min_x].x) loop.min_x = i;
      if (v[i].x > v[loop.max_x].x) loop.max_x = i;
      if (v[i].y < v[loop.min_y].y) loop.min_y = i;
      if (v[i].y > v[loop.max_y].y) loop.max_y = i;
    }
    return true;
  }

  void describe(Component& c, bool extremes) const {
    const Operand& o = o_;
    const auto outer = o.convex.begin() + c.first;
    c.convex = std::all_of(outer, outer + (o.loops[c.first_loop].last - c.first), [](auto f) { return f != 0; });
    if (!extremes) return;
    const auto width = [&](std::uint32_t l) { return points_.x[o.loops[l].max_x] - points_.x[o.loops[l].min_x]; };
    const auto height = [&](std::uint32_t l) { return points_.y[o.loops[l].max_y] - points_.y[o.loops[l].min_y]; };
    c.widest_hole = c.tallest_hole = c.first_loop + 1;
    for (std::uint32_t l = c.first_loop + 2; l < c.last_loop; ++l) {
      if (width(l) > width(c.widest_hole)) c.widest_hole = l;
      if (height(l) > height(c.tallest_hole)) c.tallest_hole = l;
    }
  }

  Operand& o_;
  const OperandMoves& moves_;
  PlacedPoints& points_;  // of this operand alone
  bool elsewhere_ = false;
};

std::shared_ptr<Operand> copy_of(const Operand& o) {
  auto copy = std::make_shared<Operand>(o);
  copy->points = std::make_shared<PlacedPoints>(*o.points);
  return copy;
}

}  // namespace

std::shared_ptr<const Operand> OperandSteps::next(const std::shared_ptr<const Operand>& before, const Region& after,
                                                  std::span<const std::uint32_t> moved) {
  made_.reset();
  if (used_ != before) {
    if (!walks_rings(*before)) return nullptr;
    last_.reset();
  }
  std::optional<OperandMoves> moves = find_moves(*before, after, moved);
  if (!moves) return nullptr;
  std::shared_ptr<Operand> next = std::move(last_);
  // Nobody else refers to it, nor to its vertices.
  if (next != nullptr && next.use_count() == 1 && next->points.use_count() == 1) {
    std::atomic_thread_fence(std::memory_order_acquire);
    Mover(*next, lacks_).run();
  } else {
    next = copy_of(*before);
  }
  Mover(*next, *moves).run();
  if (!next->points->moderate()) return nullptr;
  moves_ = *std::move(moves);
  made_ = std::move(next);
  return made_;
}

void OperandSteps::use(const std::shared_ptr<const Operand>& operand) {
  if (operand == used_) return;
  if (operand != nullptr && operand == made_) {
    last_ = std::move(used_);
    used_ = std::move(made_);
    lacks_ = std::move(moves_);
  } else {
    last_.reset();
    used_.reset();
  }
  made_.reset();
}

}  // namespace dymsum::planar

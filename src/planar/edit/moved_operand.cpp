#include "planar/edit/moved_operand.h"

#include <algorithm>

#include "exact/grid.h"
#include "planar/operand/edges.h"
#include "planar/region/region.h"

namespace dymsum::planar {
namespace {

class MovedOperand {
 public:
  MovedOperand(const Operand& before, const Region& after) : before_(before), after_(after) {}

  std::shared_ptr<const Operand> made() {
    if (!applies() || !move_points()) return nullptr;
    made_ = std::make_shared<Operand>(before_);
    made_->points = points_;
    edge_listed_.assign(before_.size(), 0);
    corner_listed_ = edge_listed_;
    for (const std::uint32_t v : moved_) {  // every vertex is its own walk vertex
      add(edges_, edge_listed_, before_.prev[v]);
      add(edges_, edge_listed_, v);
      for (const std::uint32_t w : {before_.prev[v], v, before_.next[v]}) add(turned_, corner_listed_, w);
    }
    const OwnEdges own(*points_);
    for (const std::uint32_t w : turned_) {
      const int sense = own.cross(before_.edge(before_.prev[w]), before_.edge(w));
      if (sense == 0) return nullptr;
      made_->convex[w] = sense > 0;
    }
    move_edges(own);
    for (Loop& loop : made_->loops) find_extremes(loop);
    for (Component& c : made_->components) describe(c);
    for (DirectionList& list : made_->directions) sort_again(list, own);
    return made_;
  }

 private:
  static void add(std::vector<std::uint32_t>& list, std::vector<std::uint8_t>& listed, std::uint32_t k) {
    if (!listed[k]) list.push_back(k);
    listed[k] = 1;
  }

  // Every vertex of the region is one of the walk, in units of 1.
  bool applies() const {
    const PlacedPoints& p = *before_.points;
    if (p.fractions != nullptr || p.turned != nullptr || p.unit != 0 || !p.moderate()) return false;
    if (before_.size() != p.input.size() || before_.vertex_of_index.size() != p.input.size()) return false;
    for (std::uint32_t w = 0; w < before_.size(); ++w)
      if (before_.source[w] != w || before_.vertex_index[w] != w) return false;
    return true;
  }

  // False where the bounding box is another one.
  bool move_points() {
    const PlacedPoints& was = *before_.points;
    const std::vector<Point>& input = was.input;
    Point low = was.offset, high = {was.offset.x, was.offset.y};
    for (const Point p : input) high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    points_ = std::make_shared<PlacedPoints>(was);
    std::uint32_t v = 0;
    bool inside = true;
    for_each_chain(after_.data(), [&](const std::vector<Point>& chain) {
      for (const Point given : chain) {
        const Point p = before_.reflected ? Point{0 - given.x, 0 - given.y} : given;
        if (v < input.size() && !(input[v] == p)) {
          const auto within = [&](Point a) { return a.x > low.x && a.x < high.x && a.y > low.y && a.y < high.y; };
          inside = inside && within(input[v]) && within(p);
          moved_.push_back(v);
          points_->input[v] = p;
          points_->x[v] = p.x - was.offset.x;
          points_->y[v] = p.y - was.offset.y;
        }
        ++v;
      }
    });
    if (!inside || v != input.size() || was.factors.x != 1 || was.factors.y != 1) return false;
    points_->exponent = exact::common_exponent(points_->input);
    return points_->moderate();
  }

  void move_edges(const OwnEdges& own) {
    Operand& o = *made_;
    for (const std::uint32_t v : moved_) {
      o.x[v] = points_->x[v];
      o.y[v] = points_->y[v];
    }
    for (const std::uint32_t e : edges_) {
      const std::uint32_t to = o.next[e];
      const Point d = own.vector(e, to);
      o.ex[e] = d.x;
      o.ey[e] = d.y;
      o.boxes[e] = {o.x[e], o.y[e], o.x[to], o.y[to], d.x, d.y};
    }
  }

  void find_extremes(Loop& loop) const {
    if (std::none_of(moved_.begin(), moved_.end(), [&](std::uint32_t v) { return v >= loop.first && v < loop.last; }))
      return;
    const std::vector<Point>& v = points_->input;
    loop.min_x = loop.max_x = loop.min_y = loop.max_y = loop.first;
    for (std::uint32_t i = loop.first + 1; i < loop.last; ++i) {
      if (v[i].x < v[loop.min_x].x) loop.min_x = i;
      if (v[i].x > v[loop.max_x].x) loop.max_x = i;
      if (v[i].y < v[loop.min_y].y) loop.min_y = i;
      if (v[i].y > v[loop.max_y].y) loop.max_y = i;
    }
  }

  void describe(Component& c) const {
    const Operand& o = *made_;
    const auto outer = o.convex.begin() + c.first;
    c.convex = std::all_of(outer, outer + (o.loops[c.first_loop].last - c.first), [](auto f) { return f != 0; });
    const auto width = [&](std::uint32_t l) { return o.points->x[o.loops[l].max_x] - o.points->x[o.loops[l].min_x]; };
    const auto height = [&](std::uint32_t l) { return o.points->y[o.loops[l].max_y] - o.points->y[o.loops[l].min_y]; };
    c.widest_hole = c.tallest_hole = c.first_loop + 1;
    for (std::uint32_t l = c.first_loop + 2; l < c.last_loop; ++l) {
      if (width(l) > width(c.widest_hole)) c.widest_hole = l;
      if (height(l) > height(c.tallest_hole)) c.tallest_hole = l;
    }
  }

  // The changed edges go to their new positions among the others: sort_by_direction's order.
  void sort_again(DirectionList& list, const OwnEdges& own) {
    struct Item {
      double key;
      std::uint32_t edge;
    };
    std::vector<Item> changed;
    for (const std::uint32_t e : edges_)
      if (e >= list.base && e - list.base < list.rank.size() && list.rank[e - list.base] != kNoRank) {
        const Point d = own.direction(e, made_->next[e]);
        changed.push_back({pseudo_angle(d.x, d.y), e});
      }
    if (changed.empty()) return;
    const Operand& o = *made_;
    const auto before = [&](const Item& a, const Item& b) {
      if (a.key < b.key - kAngleError) return true;
      if (a.key > b.key + kAngleError) return false;
      const int half_a = half_plane(o.ex[a.edge], o.ey[a.edge]), half_b = half_plane(o.ex[b.edge], o.ey[b.edge]);
      if (half_a != half_b) return half_a < half_b;
      const int sense = own.cross(o.edge(a.edge), o.edge(b.edge));
      return sense != 0 ? sense > 0 : a.edge < b.edge;
    };
    std::sort(changed.begin(), changed.end(), before);
    std::vector<Item> others;
    others.reserve(list.edges.size());
    for (std::size_t k = 0; k < list.edges.size(); ++k)
      if (!edge_listed_[list.edges[k]]) others.push_back({list.keys[k], list.edges[k]});
    std::size_t at = 0, k = 0;
    for (const Item& item : changed) {
      const std::size_t stop =
          static_cast<std::size_t>(std::partition_point(others.begin() + static_cast<std::ptrdiff_t>(at), others.end(),
                                                        [&](const Item& other) { return before(other, item); }) -
                                   others.begin());
      for (; at < stop; ++at, ++k) put(list, k, others[at].key, others[at].edge);
      put(list, k++, item.key, item.edge);
    }
    for (; at < others.size(); ++at, ++k) put(list, k, others[at].key, others[at].edge);
    number(list, o);
  }
  static void put(DirectionList& list, std::size_t k, double key, std::uint32_t edge) {
    list.keys[k] = key;
    list.edges[k] = edge;
  }

  const Operand& before_;
  const Region& after_;
  std::shared_ptr<PlacedPoints> points_;
  std::shared_ptr<Operand> made_;
  std::vector<std::uint32_t> moved_, edges_, turned_;
  std::vector<std::uint8_t> edge_listed_, corner_listed_;  // which edges and vertices are in the lists
};

}  // namespace

std::shared_ptr<const Operand> moved_operand(const Operand& before, const Region& after, const VertexOrigins& origins) {
  if (origins.size() != before.size()) return nullptr;
  for (std::uint32_t v = 0; v < origins.size(); ++v)
    if (origins[v] != v) return nullptr;
  return MovedOperand(before, after).made();
}

}  // namespace dymsum::planar

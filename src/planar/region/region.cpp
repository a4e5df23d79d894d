#include "planar/region/region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/doubles.h"
#include "dymsum/region.h"
#include "exact/big.h"
#include "exact/grid.h"
#include "exact/orient.h"
#include "planar/region/region_sweep.h"
#include "planar/region/region_validate.h"

namespace dymsum {

// The one canonical way to write a region.

namespace {

bool less(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

bool less_chain(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
}

// b lies strictly between its neighbours.
bool straight(Point a, Point b, Point c) { return exact::orient_sign(a, b, c) == 0 && exact::dot_sign(a, b, b, c) > 0; }

// Dropping a straight vertex changes no direction at others, so that all can be judged by the given neighbours.
std::vector<Point> without_straight_vertices(const std::vector<Point>& chain, bool closed) {
  std::vector<Point> kept;
  const std::size_t n = chain.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = !closed && (i == 0 || i + 1 == n);
    if (!end && straight(chain[i == 0 ? n - 1 : i - 1], chain[i], chain[i + 1 == n ? 0 : i + 1])) continue;
    kept.push_back({chain[i].x + 0.0, chain[i].y + 0.0});  // no negative zeros
  }
  return kept;
}

// Rotates a cyclic sequence to its lexicographically least rotation, which starts at a smallest vertex. Linear: two
// candidate starts race, and the loser skips all that it shared with the winner.
void rotate_to_least(std::vector<Point>& ring) {
  const std::size_t n = ring.size();
  std::size_t i = 0, j = 1, same = 0;
  while (i < n && j < n && same < n) {
    const Point a = ring[(i + same) % n], b = ring[(j + same) % n];
    if (a == b) {
      ++same;
      continue;
    }
    (less(a, b) ? j : i) += same + 1;
    if (i == j) ++j;
    same = 0;
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)), ring.end());
}

Ring canonical_ring(const Ring& ring) {
  Ring result = without_straight_vertices(ring, true);
  rotate_to_least(result);
  return result;
}

// Open: from the smaller end. Closed: the smaller one of its two directions, each from its least start.
Polyline canonical_polyline(const Polyline& line) {
  if (line.front() != line.back()) {
    Polyline result = without_straight_vertices(line, false);
    if (less(result.back(), result.front())) std::reverse(result.begin(), result.end());
    return result;
  }
  Polyline result = without_straight_vertices(Polyline(line.begin(), line.end() - 1), true);
  Polyline reversed(result.rbegin(), result.rend());
  rotate_to_least(result);
  rotate_to_least(reversed);
  if (less_chain(reversed, result)) result.swap(reversed);
  result.push_back(result.front());
  return result;
}

bool less_part(const Part& a, const Part& b) {
  if (a.outer != b.outer) return less_chain(a.outer, b.outer);
  return std::lexicographical_compare(a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(), less_chain);
}

}  // namespace

Region Region::canonical() const {
  RegionData result;
  for (const Part& part : data_.parts) {
    Part& made = result.parts.emplace_back();
    made.outer = canonical_ring(part.outer);
    for (const Ring& hole : part.holes) made.holes.push_back(canonical_ring(hole));
    std::sort(made.holes.begin(), made.holes.end(), less_chain);
  }
  std::sort(result.parts.begin(), result.parts.end(), less_part);
  for (const Polyline& line : data_.polylines) result.polylines.push_back(canonical_polyline(line));
  std::sort(result.polylines.begin(), result.polylines.end(), less_chain);
  result.polylines.erase(std::unique(result.polylines.begin(), result.polylines.end()), result.polylines.end());
  for (const Point p : data_.points) result.points.push_back({p.x + 0.0, p.y + 0.0});
  std::sort(result.points.begin(), result.points.end(), less);
  result.points.erase(std::unique(result.points.begin(), result.points.end()), result.points.end());
  return planar::trusted_region(std::move(result), touching_points_);
}

bool operator==(const Region& a, const Region& b) {
  return a.data_ == b.data_ || a.canonical().data_ == b.canonical().data_;
}

// Moving regions.

namespace {

// Every vertex through f, in place; with `reverse`, rings run the other way round from the same first vertex.
template <class F>
void map_region(RegionData& data, F f, bool reverse) {
  const auto map_chain = [f](std::vector<Point>& chain) {
    std::transform(chain.begin(), chain.end(), chain.begin(), f);
  };
  const auto map_ring = [map_chain, reverse](Ring& ring) {
    map_chain(ring);
    if (reverse && !ring.empty()) std::reverse(ring.begin() + 1, ring.end());
  };
  for (Part& part : data.parts) {
    map_ring(part.outer);
    for (Ring& hole : part.holes) map_ring(hole);
  }
  for (Polyline& line : data.polylines) map_chain(line);
  map_chain(data.points);
}

}  // namespace

Region negated(const Region& region) {
  RegionData data = region.data();
  // Half a turn keeps orientations. Subtracting from zero leaves no negative zeros.
  map_region(
      data,
      [](Point p) {
        return Point{0 - p.x, 0 - p.y};
      },
      false);
  std::vector<Point> touching(region.touching_points().rbegin(), region.touching_points().rend());
  for (Point& p : touching) p = {0 - p.x, 0 - p.y};
  return planar::trusted_region(std::move(data), std::move(touching));
}

Result<Region> translated(const Region& region, double dx, double dy) {
  RegionData data = region.data();
  map_region(
      data,
      [dx, dy](Point p) {
        return Point{p.x + dx, p.y + dy};
      },
      false);
  return Region::create(std::move(data));
}

Result<Region> scaled(const Region& region, double sx, double sy) {
  if (!std::isfinite(sx) || !std::isfinite(sy) || sx == 0 || sy == 0) {
    return Error{ErrorCode::unsupported_operand, "a scale factor is zero or not finite", {}};
  }
  RegionData data = region.data();
  map_region(
      data,
      [sx, sy](Point p) {
        return Point{p.x * sx, p.y * sy};
      },
      (sx < 0) != (sy < 0));
  return Region::create(std::move(data));
}

using exact::Big;

double radius_of_gyration(const Region& region) {
  std::vector<double> coordinates;
  const auto each_ring = [&](auto visit) {
    for (const Part& part : region.parts()) {
      visit(part.outer);
      for (const Ring& hole : part.holes) visit(hole);
    }
  };
  each_ring([&](const Ring& ring) {
    for (const Point& p : ring) coordinates.insert(coordinates.end(), {p.x, p.y});
  });
  if (coordinates.empty()) return 0;
  const int unit = exact::common_exponent(coordinates);
  // Twice the area, and twelve times the integral of x x + y y.
  Big area, moment;
  each_ring([&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point u = ring[k], v = ring[(k + 1) % ring.size()];
      const Big ax = exact::grid_coordinate<Big>(u.x, unit), ay = exact::grid_coordinate<Big>(u.y, unit);
      const Big bx = exact::grid_coordinate<Big>(v.x, unit), by = exact::grid_coordinate<Big>(v.y, unit);
      const Big twice = ax * by - ay * bx;
      area = area + twice;
      moment = moment + twice * (ax * ax + ay * ay + ax * bx + ay * by + bx * bx + by * by);
    }
  });
  // The mean square in [1/4, 4] times 4^half, so that it stays in the range of doubles.
  exact::BigInteger over = moment.value(), under = 6 * area.value();
  const int half = (static_cast<int>(msb(over)) - static_cast<int>(msb(under))) / 2;
  (half > 0 ? under : over) <<= 2 * std::abs(half);
  return std::ldexp(std::sqrt(exact::round_to_double(exact::BigRational(over, under))), half + unit);
}

// What a region reports about itself.

namespace {

// An exact sum of doubles, as partial sums of increasing size that do not overlap (Shewchuk 1997), rounded once at the
// end.
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (double y : partials_) {
      if (std::abs(x) < std::abs(y)) std::swap(x, y);
      const double high = x + y;
      const double low = y - (high - x);
      if (low != 0) partials_[kept++] = low;
      x = high;
    }
    partials_.resize(kept);
    partials_.push_back(x);
  }

  // The product exactly: its rounding error is a double.
  void add_product(double a, double b) {
    const base::DoublePair product = base::exact_product(a, b);
    add(product.high);
    add(product.low);
  }

  double rounded() const {
    std::size_t n = partials_.size();
    if (n == 0) return 0;
    double high = partials_[--n], low = 0;
    while (n > 0 && low == 0) {
      const double x = high, y = partials_[--n];
      high = x + y;
      low = y - (high - x);
    }
    // Exactly halfway so far: what is left decides.
    if (n > 0 && ((low < 0 && partials_[n - 1] < 0) || (low > 0 && partials_[n - 1] > 0))) {
      const double y = low * 2;
      const double x = high + y;
      if (x - high == y) high = x;
    }
    return high;
  }

 private:
  std::vector<double> partials_;
};

}  // namespace

bool Region::empty() const { return data_.parts.empty() && data_.polylines.empty() && data_.points.empty(); }

std::size_t Region::vertex_count() const {
  std::size_t count = 0;
  planar::for_each_chain(data_, [&count](const std::vector<Point>& chain) { count += chain.size(); });
  return count;
}

std::size_t Region::hole_count() const {
  std::size_t count = 0;
  for (const Part& part : data_.parts) count += part.holes.size();
  return count;
}

std::array<double, 4> bounds(const Region& region) {
  if (region.empty()) return {0, 0, 0, 0};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 4> box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  planar::for_each_chain(region.data(), [&box](const std::vector<Point>& chain) {
    for (const Point p : chain) {
      box = {std::min(box[0], p.x), std::min(box[1], p.y), std::max(box[2], p.x), std::max(box[3], p.y)};
    }
  });
  for (double& side : box) side += 0.0;  // zero has no sign
  return box;
}

double area(const Region& region) {
  const std::array<double, 4> box = bounds(region);
  const double width = std::max(std::abs(box[0]), std::abs(box[2]));
  const double height = std::max(std::abs(box[1]), std::abs(box[3]));
  if (width == 0 || height == 0) return 0;
  // Powers of two per axis keep products within the double range.
  const int x_exponent = std::ilogb(width) + 1, y_exponent = std::ilogb(height) + 1;
  const auto unit = [=](Point p) { return Point{std::scalbn(p.x, -x_exponent), std::scalbn(p.y, -y_exponent)}; };
  ExactSum twice;
  const auto add_ring = [&twice, unit](const Ring& ring) {
    Point a = unit(ring.back());
    for (const Point p : ring) {
      const Point b = unit(p);
      twice.add_product(a.x, b.y);
      twice.add_product(-a.y, b.x);
      a = b;
    }
  };
  for (const Part& part : region.parts()) {
    add_ring(part.outer);
    for (const Ring& hole : part.holes) add_ring(hole);
  }
  return std::scalbn(twice.rounded(), x_exponent + y_exponent - 1);
}

}  // namespace dymsum

namespace dymsum::planar {
namespace {

// A ring vertex that may be a cut inside an edge.
struct Node {
  Point at;
  std::uint32_t vertex_index, edge_index;  // of the vertex here, of the edge that starts here
  std::uint32_t next;
  bool cut;
};

bool inside_edge(Point a, Point b, Point z) {
  if (z.x < std::min(a.x, b.x) || z.x > std::max(a.x, b.x) || z.y < std::min(a.y, b.y) || z.y > std::max(a.y, b.y))
    return false;
  return z != a && z != b && exact::orient_sign(a, b, z) == 0;
}

class Separation {
 public:
  Separation(const RegionData& data, const std::vector<Point>& touching) {
    for (const Part& part : data.parts) {
      add_ring(part.outer, touching);
      for (const Ring& hole : part.holes) add_ring(hole, touching);
    }
    for (const Point& z : touching) pair_at(z);
    result.touching = true;
    collect(data);
  }

  EngineRegion result;

 private:
  void add_ring(const Ring& ring, const std::vector<Point>& touching) {
    const std::uint32_t begin = static_cast<std::uint32_t>(nodes_.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
      add_node(a, index_, false);
      std::vector<Point> cuts;
      for (const Point& z : touching)
        if (inside_edge(a, b, z)) cuts.push_back(z);
      std::sort(cuts.begin(), cuts.end(), [](Point u, Point v) { return u.x != v.x ? u.x < v.x : u.y < v.y; });
      if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::reverse(cuts.begin(), cuts.end());
      for (const Point& z : cuts) add_node(z, index_, true);
      ++index_;
    }
    nodes_.back().next = begin;
  }
  void add_node(Point at, std::uint32_t number, bool cut) {
    nodes_.push_back({at, number, number, static_cast<std::uint32_t>(nodes_.size() + 1), cut});
  }

  // Around z, counter-clockwise, region sectors run from a way out to a way in; afterwards each visit of z has one of
  // them.
  void pair_at(Point z) {
    struct Ray {
      Point to;
      std::uint32_t node;  // the node at z (out) or before z (in)
      bool out;
    };
    std::vector<Ray> rays;
    std::uint32_t vertex = 0;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const Node& n = nodes_[i];
      if (n.at == z) rays.push_back({nodes_[n.next].at, i, true});
      if (nodes_[n.next].at == z) rays.push_back({n.at, i, false});
      // Two edges cannot touch in both their interiors: some strand has a vertex here.
      if (n.at == z && !n.cut) vertex = n.vertex_index;
    }
    const auto half = [&](const Ray& r) { return r.to.y > z.y || (r.to.y == z.y && r.to.x > z.x) ? 0 : 1; };
    std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
      return half(a) != half(b) ? half(a) < half(b) : exact::orient_sign(z, a.to, b.to) > 0;
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!rays[i].out) joined.emplace_back(rays[i].node, rays[(i + rays.size() - 1) % rays.size()].node);
    for (const auto& [in, out] : joined) nodes_[in].next = out;
    for (const Ray& r : rays)
      if (r.out && nodes_[r.node].cut) nodes_[r.node].vertex_index = vertex;
  }

  void collect(const RegionData& data) {
    std::vector<std::vector<std::uint32_t>> rings;
    std::vector<bool> seen(nodes_.size(), false);
    RingList list;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (seen[i]) continue;
      std::vector<std::uint32_t> ring;
      Ring points;
      for (std::uint32_t at = i; !seen[at]; at = nodes_[at].next) {
        seen[at] = true;
        ring.push_back(at);
        points.push_back(nodes_[at].at);
      }
      list.add(points);
      rings.push_back(std::move(ring));
    }
    const RingLayout layout = layout_rings(list);
    const auto points_of = [&](std::size_t r) {
      Ring ring;
      for (const std::uint32_t n : rings[r]) ring.push_back(nodes_[n].at);
      return ring;
    };
    const auto number = [&](std::size_t r) {
      for (const std::uint32_t n : rings[r]) {
        result.vertex_indices.push_back(nodes_[n].vertex_index);
        result.edge_indices.push_back(nodes_[n].edge_index);
      }
    };
    for (std::size_t r = 0; r < rings.size(); ++r) {
      if (!layout.rings[r].counter_clockwise) continue;
      result.own.parts.push_back({points_of(r), {}});
      number(r);
      for (std::size_t h = 0; h < rings.size(); ++h)
        if (layout.rings[h].container == r && !layout.rings[h].counter_clockwise) {
          result.own.parts.back().holes.push_back(points_of(h));
          number(h);
        }
    }
    append_lower(data);
  }
  void append_lower(const RegionData& data) {
    result.own.polylines = data.polylines;
    result.own.points = data.points;
    std::size_t rest = data.points.size();
    for (const Polyline& line : data.polylines) rest += line.size();
    for (std::size_t i = 0; i < rest; ++i, ++index_) {
      result.vertex_indices.push_back(index_);
      result.edge_indices.push_back(index_);
    }
  }

  std::vector<Node> nodes_;
  std::uint32_t index_ = 0;
};

}  // namespace

EngineRegion separate_touching(const RegionData& data, const std::vector<Point>& touching_points) {
  if (!touching_points.empty()) return Separation(data, touching_points).result;
  EngineRegion same;
  same.borrowed = &data;
  return same;
}

}  // namespace dymsum::planar

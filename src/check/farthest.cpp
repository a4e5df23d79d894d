#include "check/farthest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "exact/big.h"

namespace dymsum::check {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double root_above(const Fraction& squared) {
  return std::nextafter(exact::root_to_double(exact::BigRational(squared.num, squared.den)), kInfinity);
}

double root_above(const Interval& squared) {
  return squared.is_whole() ? kInfinity : std::nextafter(std::sqrt(squared.high()), kInfinity);
}

/// Which of its positions a segment is near with: an end, or its inside.
struct Side {
  std::optional<HomogeneousPoint> point;
  Line line;  ///< else; positive at what is near
};

Side side_of(const ExactPoint& p, const Segment& s) {
  const HomogeneousPoint foot = nearest_on(p, s);
  for (const PointRef& end : {s.from, s.to})
    if (foot.x == end->exact.x && foot.y == end->exact.y && foot.w == end->exact.w) return {foot, {}};
  Line line = line_through(s.from->exact, s.to->exact);
  if (line.at(p.exact) < 0) line = {-line.a, -line.b, -line.c};
  return {std::nullopt, line};
}

/// The positions equally far from both.
Line bisector(const HomogeneousPoint& a, const HomogeneousPoint& b) {
  const BigInteger dx = b.x * a.w - a.x * b.w, dy = b.y * a.w - a.y * b.w, w = a.w * b.w;
  return {2 * dx * w, 2 * dy * w, (a.x * a.x + a.y * a.y) * b.w * b.w - (b.x * b.x + b.y * b.y) * a.w * a.w};
}

/// The same of two lines, on the positive side of both: a / |a| - b / |b|. The ratio of their lengths is a fraction
/// where the product of the squares is one, as of lines that are parallel or at right angles; else it is rounded to 64
/// bits and more.
Line bisector(const Line& a, const Line& b) {
  const BigInteger aa = a.a * a.a + a.b * a.b, bb = b.a * b.a + b.b * b.b;
  BigInteger rest, product = aa * bb, root = exact::floor_root(product, rest), unit = 1;
  if (rest != 0) {
    constexpr int kBits = 64;
    root = exact::floor_root(product << (2 * kBits), rest);
    unit = BigInteger(1) << kBits;
  }
  // |b| / |a| = root / (unit aa)
  const BigInteger of_b = unit * aa;
  return {a.a * root - b.a * of_b, a.b * root - b.b * of_b, a.c * root - b.c * of_b};
}

/// The largest bits of a line that is taken as it is.
constexpr int kMostLineBits = 4096;

bool is_short(const Line& line) {
  for (const BigInteger* v : {&line.a, &line.b, &line.c})
    if (*v != 0 && msb(BigInteger(abs(*v))) > kMostLineBits) return false;
  return true;
}

/// A line near z, at right angles to a direction, both rounded: z to a 2^20th of `size`.
std::optional<Line> line_near(const HomogeneousPoint& z, Point normal, double size) {
  const double length = std::hypot(normal.x, normal.y);
  if (!(length > 0) || !std::isfinite(length) || !(size > 0) || !std::isfinite(size)) return std::nullopt;
  constexpr double kSteps = 0x1p24;
  const BigInteger a(std::llround(normal.x / length * kSteps)), b(std::llround(normal.y / length * kSteps));
  const int unit = std::ilogb(size) - 20;
  const auto rounded = [&](const BigInteger& x) {
    return unit < 0 ? BigInteger((x << -unit) / z.w) : BigInteger(x / (z.w << unit));
  };
  const BigInteger c = -(a * rounded(z.x) + b * rounded(z.y));
  return unit < 0 ? Line{a << -unit, b << -unit, c} : Line{a, b, c << unit};
}

/// The normal, at z, of the positions that are as far from one side as from the other.
Point normal_between(const HomogeneousPoint& z, const Side& a, const Side& b) {
  const auto gradient = [&](const Side& side) -> Point {
    Point g;
    if (side.point) {
      g = seen_from(*side.point, z);
    } else {
      const double x = Interval(side.line.a).midpoint(), y = Interval(side.line.b).midpoint();
      const double most = std::max(std::abs(x), std::abs(y));
      g = {x / most, y / most};
    }
    const double most = std::max(std::abs(g.x), std::abs(g.y)), size = std::hypot(g.x / most, g.y / most);
    return {g.x / most / size, g.y / most / size};
  };
  const Point p = gradient(a), q = gradient(b);
  return {p.x - q.x, p.y - q.y};
}

class Search {
 public:
  Search(const EdgeTree& edges, const Poll& poll) : edges_(edges), poll_(poll) {}

  Farthest run(std::vector<ConvexCell> cells) {
    best_.at = cells.front().vertices.front();
    look_at(best_.at);
    for (ConvexCell& cell : cells) add(std::move(cell), 0);
    while (!queue_.empty()) {
      if (const double bound = queue_.begin()->first; bound <= root_below_ && root_below_ > 0) queue_.clear();
      if (queue_.empty() || finished()) break;
      auto top = queue_.extract(queue_.begin());
      Cell& cell = top.mapped();
      if (!cell.refined) refine(std::move(cell));
      else split(cell);
      poll_.at_test(++steps_, kMostSplits);
    }
    best_.exact = queue_.empty();
    best_.at_most = best_.exact ? root_above(best_.squared) : queue_.begin()->first;
    return std::move(best_);
  }

 private:
  static constexpr std::size_t kMostSplits = 100'000;

  struct Cell {
    ConvexCell cell;
    std::uint32_t edge = 0;  ///< that bounds it
    int depth = 0;
    bool refined = false;  ///< its bound is that of exact numbers
  };

  bool finished() const {
    const auto& [bound, cell] = *queue_.begin();
    return splits_ >= kMostSplits || (cell.refined && bound <= root_below_ * (1 + 0x1p-36));
  }

  const EdgeTree::Nearest& nearest(const PointRef& p) {
    const auto [it, added] = known_.try_emplace(p.get());
    if (added) it->second = {edges_.nearest(*p), p};
    return it->second.first;
  }

  /// Takes the position where it is further than all before.
  void look_at(const PointRef& p) {
    const EdgeTree::Nearest& n = nearest(p);
    if (root_below_ >= 0 && !(best_.squared < n.squared)) return;
    best_.at = p;
    best_.squared = n.squared;
    best_.nearest = nearest_on(*p, edges_[n.edge]);
    const double root = exact::root_to_double(exact::BigRational(n.squared.num, n.squared.den));
    root_below_ = std::max(0.0, std::nextafter(root, -kInfinity));
  }

  double bound_of(const ConvexCell& cell, std::uint32_t edge) const {
    double most = 0;
    for (const PointRef& p : cell.vertices)
      most = std::max(most, root_above(squared_distance_bounds(*p, edges_[edge])));
    return most;
  }

  /// The edges that are near the vertices and the centre of a cell.
  std::vector<std::uint32_t> near_edges(const ConvexCell& cell) const {
    std::vector<std::uint32_t> near;
    Point centre{0, 0};
    const auto n = static_cast<double>(cell.vertices.size());
    for (const PointRef& p : cell.vertices) {
      near.push_back(edges_.rough_nearest(p->near));
      centre = {centre.x + p->near.x / n, centre.y + p->near.y / n};
    }
    near.push_back(edges_.rough_nearest(centre));
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    return near;
  }

  void add(ConvexCell cell, int depth) {
    Cell next{std::move(cell), 0, depth, false};
    double bound = kInfinity;
    for (const std::uint32_t edge : near_edges(next.cell))
      if (const double b = bound_of(next.cell, edge); b < bound) bound = b, next.edge = edge;
    if (bound <= root_below_ && root_below_ > 0) return;
    queue_.emplace(bound, std::move(next));
  }

  /// The bound in exact numbers; vertices that are further than all before are taken.
  void refine(Cell cell) {
    std::vector<std::uint32_t> near = near_edges(cell.cell);
    for (const PointRef& p : cell.cell.vertices) {
      if (root_above(squared_distance_bounds(*p, edges_[cell.edge])) <= root_below_ && root_below_ > 0) continue;
      look_at(p);
      near.push_back(nearest(p).edge);
    }
    std::optional<Fraction> bound;
    for (const std::uint32_t edge : near) {
      Fraction most;
      for (const PointRef& p : cell.cell.vertices)
        if (Fraction d = squared_distance(*p, edges_[edge]); most < d) most = std::move(d);
      if (bound && !(most < *bound)) continue;
      bound = std::move(most);
      cell.edge = edge;
    }
    if (!(best_.squared < *bound)) return;
    cell.refined = true;
    queue_.emplace(root_above(*bound), std::move(cell));
  }

  void split(const Cell& cell) {
    ++splits_;
    constexpr int kPlain = 4;  // one in so many cuts makes cells smaller, whatever the edges are
    std::optional<HalvedCell> halves;
    if (cell.depth % kPlain != kPlain - 1) halves = cut(cell.cell, cut_of(cell));
    if (!halves) halves = cut(cell.cell, halving(cell.cell, false));
    if (!halves) halves = cut(cell.cell, halving(cell.cell, true));
    add(std::move(halves->negative), cell.depth + 1);
    add(std::move(halves->positive), cell.depth + 1);
  }

  /// Nothing where all vertices are on one side.
  static std::optional<HalvedCell> cut(const ConvexCell& cell, const std::optional<Line>& line) {
    if (!line) return std::nullopt;
    bool left = false, right = false;
    for (const PointRef& p : cell.vertices) {
      const int sign = line->at(p->exact).sign();
      left |= sign > 0;
      right |= sign < 0;
    }
    if (!left || !right) return std::nullopt;
    return halved(cell, *line);
  }

  /// The two vertices of a cell that are furthest from each other, roughly, and how far.
  struct Diameter {
    const HomogeneousPoint *from = nullptr, *to = nullptr;
    double length = -1;
  };
  static Diameter diameter(const ConvexCell& cell) {
    Diameter longest;
    for (std::size_t i = 0; i < cell.vertices.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const HomogeneousPoint &p = cell.vertices[i]->exact, &q = cell.vertices[j]->exact;
        const Point d = seen_from(p, q);
        if (const double length = std::hypot(d.x, d.y); length > longest.length) longest = {&p, &q, length};
      }
    return longest;
  }

  /// Halfway between these; exactly, where what is rounded misses the cell.
  static std::optional<Line> halving(const ConvexCell& cell, bool exactly) {
    const Diameter d = diameter(cell);
    if (exactly) return bisector(*d.from, *d.to);
    const BigInteger w = 2 * d.from->w * d.to->w;
    const HomogeneousPoint z{d.from->x * d.to->w + d.to->x * d.from->w, d.from->y * d.to->w + d.to->y * d.from->w, w};
    return line_near(z, seen_from(*d.from, *d.to), d.length);
  }

  /// Where the edge that bounds the cell, and the nearest one of the vertex that is furthest from it, are equally far.
  std::optional<Line> cut_of(const Cell& cell) {
    const Segment& bounding = edges_[cell.edge];
    const PointRef* worst = nullptr;
    Fraction most;
    for (const PointRef& p : cell.cell.vertices)
      if (Fraction d = squared_distance(*p, bounding); !worst || most < d) most = std::move(d), worst = &p;
    const Segment& other = edges_[nearest(*worst).edge];
    const auto beyond = [&](const ExactPoint& z) { return squared_distance(z, other) < squared_distance(z, bounding); };
    const PointRef* best = nullptr;
    for (const PointRef& p : cell.cell.vertices)
      if (Fraction d = squared_distance(*p, bounding); d < squared_distance(*p, other) && (!best || d < most))
        most = std::move(d), best = &p;
    if (!best) return std::nullopt;
    const ExactPoint between = change(**best, **worst, beyond);
    const Side a = side_of(between, bounding), b = side_of(between, other);
    if (cell.cell.vertices.size() == 2)
      for (const Side* side : {&a, &b})
        if (const std::optional<Line> line = across(cell.cell, *side)) return line;
    constexpr int kExactly = 6;  // so often, at first
    if (cell.depth < kExactly && a.point.has_value() == b.point.has_value()) {
      Line exact = a.point ? bisector(*a.point, *b.point) : bisector(a.line, b.line);
      if (is_short(exact)) return exact;
    }
    return line_near(between.exact, normal_between(between.exact, a, b), diameter(cell.cell).length);
  }

  /// A position on the segment from p to q, close to one where `beyond` changes from false to true.
  template <class F>
  static ExactPoint change(const ExactPoint& p, const ExactPoint& q, F beyond) {
    constexpr int kHalvings = 24;
    BigInteger at = 0;
    ExactPoint z = p;
    for (int k = 1; k <= kHalvings; ++k) {
      at = 2 * at + 1;
      const BigInteger to = at * p.exact.w, from = ((BigInteger(1) << k) - at) * q.exact.w;
      ExactPoint next(HomogeneousPoint{p.exact.x * from + q.exact.x * to, p.exact.y * from + q.exact.y * to,
                                       (p.exact.w * q.exact.w) << k});
      if (beyond(next)) --at;
      else z = std::move(next);
    }
    return z;
  }

  /// Of a cell that is a segment: across it at a position of its inside.
  static std::optional<Line> across(const ConvexCell& cell, const Side& side) {
    const HomogeneousPoint &p = cell.vertices[0]->exact, &q = cell.vertices[1]->exact;
    if (!side.point || line_through(p, q).at(*side.point) != 0) return std::nullopt;
    const HomogeneousPoint& z = *side.point;
    const BigInteger dx = q.x * p.w - p.x * q.w, dy = q.y * p.w - p.y * q.w;
    const Line line{dx * z.w, dy * z.w, -(dx * z.x + dy * z.y)};
    return cut(cell, line) ? std::optional(line) : std::nullopt;
  }

  const EdgeTree& edges_;
  const Poll& poll_;
  Farthest best_;
  double root_below_ = -1;  // of best_.squared
  std::multimap<double, Cell, std::greater<>> queue_;
  std::map<const ExactPoint*, std::pair<EdgeTree::Nearest, PointRef>> known_;
  std::size_t splits_ = 0, steps_ = 0;
};

}  // namespace

Farthest farthest(std::vector<ConvexCell> cells, const EdgeTree& edges, const Poll& poll) {
  return Search(edges, poll).run(std::move(cells));
}

}  // namespace dymsum::check

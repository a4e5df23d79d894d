#include "planar/sum/contains.h"

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "dymsum/planar_operand.h"
#include "dymsum/sum_locator.h"
#include "planar/boundary/collision.h"
#include "planar/operand/fraction_lattice.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum {

// Whether one point lies in a sum: P meets z - Q, decided on a lattice that also holds z and the origin.

namespace {

using namespace planar;

// P and z - Q on one lattice: z is the sum of vertex `z` of P and vertex `origin` of Q.
struct Query {
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
  Pair z;
};

// The vertices of an operand and a point besides.
std::shared_ptr<const PlacedPoints> points_with(const Operand& operand, Point z) {
  if (const auto& fractions = operand.points->fractions; fractions != nullptr) {
    std::vector<exact::HomogeneousPoint> at = fractions->at;
    at.push_back(exact::homogeneous(z.x, z.y));
    return fractions_as_points(std::move(at));
  }
  std::vector<Point> at = operand.points->input;
  at.push_back(z);
  return place_points(std::move(at));
}

Query make_query(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q, Point z) {
  Query query;
  query.z = {static_cast<std::uint32_t>(p->points->input.size()), static_cast<std::uint32_t>(q->points->input.size())};
  query.lattice = make_lattice(points_with(*p, z), points_with(*q, {0, 0}), 0);
  query.p = std::move(p);
  query.q = std::move(q);
  query.p = placed_on(*query.lattice, std::move(query.p));
  query.q = placed_on(*query.lattice, std::move(query.q));
  return query;
}

// z as a position on some segment, or nothing when both operands are the single points z and 0: then it is their sum.
std::optional<SegmentPosition> position_of(const Query& query) {
  const Lattice& l = *query.lattice;
  SegmentPosition x;
  x.first.pair = query.z;
  x.x = l.points[0]->x[query.z.p] + l.points[1]->x[query.z.q];
  x.y = l.points[0]->y[query.z.p] + l.points[1]->y[query.z.q];
  x.error = l.exact_doubles ? 0 : kSumPoint * l.span;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const std::uint32_t own = op == 0 ? query.z.p : query.z.q, other = op == 0 ? query.z.q : query.z.p;
    for (std::uint32_t v = 0; v < own; ++v)
      if (!l.same(op == 0 ? Pair{v, other} : Pair{other, v}, query.z)) {
        x.on = {{op, own, v}, other};
        return x;
      }
  }
  return std::nullopt;
}

// Whether z lies on the closed segment: the end `vertex` of one set touches the edge of the other.
bool lies_on(const Lattice& l, const Segment& s, Pair z) {
  const Segment back{{s.edge.op, s.edge.to, s.edge.from}, s.vertex};
  return l.side(s, z) == 0 && l.along(s, z) >= 0 && l.along(back, z) >= 0;
}

// Whether edge e of P and the reflected edge f of Q, moved to z, have a common point.
bool edges_meet(const Lattice& l, const Edge& e, const Edge& f, Pair z) {
  const int s1 = l.side({e, f.from}, z), s2 = l.side({e, f.to}, z);
  if (s1 * s2 > 0) return false;
  const int s3 = l.side({f, e.from}, z), s4 = l.side({f, e.to}, z);
  if (s3 * s4 > 0) return false;
  if (s1 * s2 < 0 && s3 * s4 < 0) return true;
  return lies_on(l, {e, f.from}, z) || lies_on(l, {e, f.to}, z) || lies_on(l, {f, e.from}, z) ||
         lies_on(l, {f, e.to}, z);
}

// Whether edge i of P, or point, and edge j of Q, reflected and moved to z, meet; with `regular`, only where that puts
// z into the closure of an open set.
bool pieces_meet(const Query& query, const Component& cp, std::uint32_t i, const Component& cq, std::uint32_t j,
                 bool regular) {
  const Lattice& l = *query.lattice;
  const bool thin = cp.dimension < 2 && cq.dimension < 2;
  const Edge e = query.p->edge(i), f = query.q->edge(j);
  if (cp.dimension == 0 && cq.dimension == 0) return l.same({e.from, f.from}, query.z);
  if (cp.dimension == 0) return lies_on(l, {f, e.from}, query.z);
  if (cq.dimension == 0) return lies_on(l, {e, f.from}, query.z);
  return edges_meet(l, e, f, query.z) && !(regular && thin && l.cross(e, f) == 0);
}

// Whether the boundaries of two components meet, of which only what lies in boxes that do is looked at.
bool boundaries_meet(const Query& query, const SegmentPosition& z, std::size_t p_component, std::size_t q_component,
                     bool regular) {
  using Node = EdgeTree::Node;
  const Component &cp = query.p->components[p_component], &cq = query.q->components[q_component];
  if (regular && cp.dimension < 2 && cq.dimension < 2 && (cp.dimension == 0 || cq.dimension == 0)) return false;
  const std::vector<Node>&tp = query.p->trees()[p_component].nodes, &tq = query.q->trees()[q_component].nodes;
  const double margin = z.error + kSumBox * query.lattice->span;
  const auto apart = [&](const Node& a, const Node& b) {
    return a.x1 < z.x - b.x1 - margin || a.x0 > z.x - b.x0 + margin || a.y1 < z.y - b.y1 - margin ||
           a.y0 > z.y - b.y0 + margin;
  };
  return any_pair_of_leaves(tp, 0, tq, 0, apart, [&](const Node& a, const Node& b) {
    for (std::uint32_t e = a.first; e < a.last; ++e)
      for (std::uint32_t f = b.first; f < b.last; ++f)
        if (pieces_meet(query, cp, e, cq, f, regular)) return true;
    return false;
  });
}

}  // namespace

bool contains(const PlanarOperand& p, const PlanarOperand& q, Point z, Semantics semantics) {
  const std::shared_ptr<const Operand> first = taken_operand(p, 0), second = taken_operand(q, 1);
  if (first->size() == 0 || second->size() == 0 || !std::isfinite(z.x) || !std::isfinite(z.y)) return false;
  for (const auto& o : {first, second})
    if (const std::optional<Error> error = too_large(*o)) throw std::invalid_argument("contains: " + error->message);
  constexpr double kReach = 0x1p1001;  // of all sums
  if (std::abs(z.x) > kReach || std::abs(z.y) > kReach) return false;
  const Query query = make_query(first, second, z);
  const std::optional<SegmentPosition> x = position_of(query);
  if (!x) return semantics == Semantics::closed;
  if (Collision(*query.lattice, *query.p, *query.q, true).overlaps(*x)) return true;
  if (semantics == Semantics::open) return false;
  for (std::size_t i = 0; i < query.p->components.size(); ++i)
    for (std::size_t j = 0; j < query.q->components.size(); ++j)
      if (boundaries_meet(query, *x, i, j, semantics == Semantics::regular)) return true;
  return false;
}

bool contains(const Region& p, const Region& q, Point z, Semantics semantics) {
  return contains(PlanarOperand(p), PlanarOperand(q), z, semantics);
}

// Whether many points lie in a sum: one by one while that is cheaper than the sum, else located in it.

namespace {

using Answers = Result<std::vector<std::uint8_t>>;

std::size_t thin_vertices(const Region& r) {
  std::size_t count = r.points().size();
  for (const Polyline& line : r.polylines()) count += line.size();
  return count;
}

/// Whether `count` points are expected to take longer one by one than the sum does. Weights are about nanoseconds: a
/// point is placed on a lattice with all vertices; the sum and its locator take time for each reduced segment, and what
/// is thin in both operands is compared with all of the sum and with each other.
bool worth_a_sum(const Region& p, const Region& q, std::size_t count, Semantics semantics) {
  constexpr double kOfVertex = 32, kOfSegment = 512, kOfThin = 16;
  const auto vertices = static_cast<double>(p.vertex_count() + q.vertex_count());
  const double alone = static_cast<double>(count) * kOfVertex * vertices;
  if (alone < kOfSegment * vertices) return false;
  const double thin = semantics == Semantics::closed
                          ? static_cast<double>(thin_vertices(p)) * static_cast<double>(thin_vertices(q))
                          : 0;
  const double reduced = static_cast<double>(convolution_sizes(p, q).reduced) + vertices;
  return alone > kOfSegment * reduced + kOfThin * thin * (thin + reduced);
}

Result<SumLocator> locator_of(const Region& p, const Region& q, Semantics semantics, const Progress& progress) {
  SumOptions options;
  options.semantics = semantics;
  options.progress = progress;
  const Result<PlanarSum> sum = minkowski_sum(p, q, options);
  if (!sum) return sum.error();
  return SumLocator(*sum, semantics);
}

Answers one_by_one(const Region& p, const Region& q, std::span<const Point> points, Semantics semantics, int threads,
                   const Progress& progress) {
  return planar::answer_blocks(points.size(), 256, 16, threads, progress,
                               [&](std::size_t k) { return contains(p, q, points[k], semantics); });
}

/// Why no sum of these operands is queried.
std::optional<Error> refusal(const Region& p, const Region& q) {
  for (const auto& operand : {planar::prepared_operand(p, 0), planar::prepared_operand(q, 1)})
    if (std::optional<Error> error = planar::too_large(*operand)) return error;
  return std::nullopt;
}

/// The doubles that all the points are, if they are.
std::optional<std::vector<Point>> doubles_of(std::span<const RationalPoint> points) {
  std::vector<Point> all;
  for (const RationalPoint& z : points) {
    const Point at{z.x.to_double(), z.y.to_double()};
    const Result<Rational> x = Rational::of(at.x), y = Rational::of(at.y);
    if (!x || !y || !(*x == z.x && *y == z.y)) return std::nullopt;
    all.push_back(at);
  }
  return all;
}

}  // namespace

Answers contains_each(const Region& p, const Region& q, std::span<const Point> points, Semantics semantics, int threads,
                      const Progress& progress) {
  if (p.empty() || q.empty()) return std::vector<std::uint8_t>(points.size());
  if (const std::optional<Error> error = refusal(p, q)) return *error;
  if (!worth_a_sum(p, q, points.size(), semantics)) return one_by_one(p, q, points, semantics, threads, progress);
  const Result<SumLocator> sum = locator_of(p, q, semantics, progress);
  if (!sum) return sum.error();
  return sum->contains_each(points, threads, progress);
}

Answers contains_each(const Region& p, const Region& q, std::span<const RationalPoint> points, Semantics semantics,
                      int threads, const Progress& progress) {
  if (p.empty() || q.empty()) return std::vector<std::uint8_t>(points.size());
  if (const auto doubles = doubles_of(points)) return contains_each(p, q, *doubles, semantics, threads, progress);
  const Result<SumLocator> sum = locator_of(p, q, semantics, progress);
  if (!sum) return sum.error();
  return sum->contains_each(points, threads, progress);
}

}  // namespace dymsum

// What the clearances of a part in a container are made of, edge by edge.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "depth/planar_depth.h"
#include "dymsum/robustness.h"
#include "exact/big.h"

namespace dymsum {
namespace {

using depth::PlaneVector;
using exact::BigRational;

/// An edge of a ring and the vertices at its ends.
struct Edge {
  Point a, b;
  std::uint32_t from = 0, to = 0;
};

std::vector<Edge> edges_of(const Region& region) {
  std::vector<Edge> edges;
  std::uint32_t first = 0;
  const auto add = [&](const Ring& ring) {
    const auto count = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t k = 0; k < count; ++k)
      edges.push_back({ring[k], ring[(k + 1) % count], first + k, first + (k + 1) % count});
    first += count;
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return edges;
}

/// The deviations of features, from a tolerance for all or one for each vertex.
class Deviations {
 public:
  Deviations(std::span<const Tolerance> given, const std::vector<Edge>& edges) {
    for (const Edge& e : edges) of_edge_.push_back(given.size() == 1 ? given[0] : given[e.from]);
    of_vertex_ = of_edge_;
    for (const Edge& e : edges) {
      Tolerance& at = of_vertex_[e.to];
      at.upper = std::max(at.upper, of_edge_[e.from].upper);
      at.lower = std::min(at.lower, of_edge_[e.from].lower);
    }
  }
  const Tolerance& of(const PlanarFeature& f) const {
    return (f.kind == PlanarFeature::Kind::edge ? of_edge_ : of_vertex_)[f.index];
  }

 private:
  std::vector<Tolerance> of_edge_, of_vertex_;  // by the vertex that starts the edge
};

double distance_from(Point z, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, size = std::max(std::abs(dx), std::abs(dy));
  const double u = dx / size, w = dy / size;
  const double t = std::clamp(((z.x - a.x) * u + (z.y - a.y) * w) / (u * u + w * w) / size, 0.0, 1.0);
  return std::hypot(a.x + t * dx - z.x, a.y + t * dy - z.y);
}

/// Of edges that do not cross.
double rough_distance(const Edge& e, const Edge& f) {
  return std::min({distance_from(e.a, f.a, f.b), distance_from(e.b, f.a, f.b), distance_from(f.a, e.a, e.b),
                   distance_from(f.b, e.a, e.b)});
}

PlaneVector exact_point(Point p, const RationalPoint& moved_by) {
  return {exact::exact_value(*Rational::of(p.x) + moved_by.x), exact::exact_value(*Rational::of(p.y) + moved_by.y)};
}

struct Foot {
  BigRational squared;
  bool inside = false;  ///< of the edge, off its ends
};
Foot foot_on(const PlaneVector& z, const PlaneVector& a, const PlaneVector& b) {
  const PlaneVector d{b[0] - a[0], b[1] - a[1]}, to{z[0] - a[0], z[1] - a[1]};
  const BigRational along = to[0] * d[0] + to[1] * d[1], all = d[0] * d[0] + d[1] * d[1];
  Foot foot;
  BigRational t = along / all;
  foot.inside = t > 0 && t < 1;
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const BigRational x = to[0] - t * d[0], y = to[1] - t * d[1];
  foot.squared = x * x + y * y;
  return foot;
}

/// The feature of a part's edge that is nearest to an edge of the container, and the square of the distance.
struct Nearest {
  PlanarFeature part;
  BigRational squared;
};
Nearest nearest_features(const Edge& e, const Edge& f, const RationalPoint& at) {
  const PlaneVector a = exact_point(e.a, {}), b = exact_point(e.b, {}), c = exact_point(f.a, at),
                    d = exact_point(f.b, at);
  const Foot of_a = foot_on(a, c, d), of_b = foot_on(b, c, d), of_c = foot_on(c, a, b), of_d = foot_on(d, a, b);
  Nearest nearest;
  nearest.squared = std::min(std::min(of_a.squared, of_b.squared), std::min(of_c.squared, of_d.squared));
  const auto at_foot = [&](const Foot& foot) { return foot.inside && foot.squared == nearest.squared; };
  const bool at_c = of_c.squared == nearest.squared, at_d = of_d.squared == nearest.squared;
  if (at_foot(of_a) || at_foot(of_b) || (at_c && at_d)) nearest.part = {PlanarFeature::Kind::edge, f.from};
  else nearest.part = {PlanarFeature::Kind::vertex, at_c ? f.from : f.to};
  return nearest;
}

/// The row of one edge of the container: of the part's features the one that leaves least.
FitStackRow row_of(const Edge& e, const Tolerance& own, const std::vector<Edge>& part, const Deviations& deviations,
                   const RationalPoint& at) {
  const double x = at.x.to_double(), y = at.y.to_double();
  std::vector<double> rough;
  double least = std::numeric_limits<double>::infinity(), reach = 0;
  for (const Edge& f : part) {
    Edge moved = f;
    for (Point* p : {&moved.a, &moved.b}) {
      *p = {p->x + x, p->y + y};
      reach = std::max({reach, std::abs(p->x), std::abs(p->y)});
    }
    const double upper = std::max(deviations.of({PlanarFeature::Kind::vertex, f.from}).upper,
                                  deviations.of({PlanarFeature::Kind::vertex, f.to}).upper);
    rough.push_back(rough_distance(e, moved) - upper);  // no feature of this edge leaves less
    least = std::min(least, rough_distance(e, moved) - deviations.of({PlanarFeature::Kind::edge, f.from}).upper);
  }
  reach = std::max({reach, std::abs(e.a.x), std::abs(e.a.y), std::abs(e.b.x), std::abs(e.b.y)});
  FitStackRow best;
  best.container = {PlanarFeature::Kind::edge, e.from};
  best.least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (rough[k] > least + reach * 0x1p-40) continue;
    const Nearest nearest = nearest_features(e, part[k], at);
    const double nominal = exact::root_to_double(nearest.squared);
    const Tolerance& other = deviations.of(nearest.part);
    const double left = nominal + own.lower - other.upper;
    const bool better = left < best.least || (left == best.least && nearest.part.kind > best.part.kind);
    if (!better) continue;
    best.part = nearest.part;
    best.squared = exact::to_rational(nearest.squared);
    best.nominal = nominal;
    best.least = left;
    best.most = nominal + own.upper - other.lower;
    best.of_container = own.upper - own.lower;
    best.of_part = other.upper - other.lower;
  }
  return best;
}

std::optional<Error> tolerance_error(std::span<const Tolerance> given, std::size_t vertices, const char* of) {
  if (given.size() != 1 && given.size() != vertices)
    return Error{ErrorCode::out_of_range,
                 "there are " + std::to_string(given.size()) + " tolerances for the " + std::to_string(vertices) +
                     " vertices of the " + of + ": give one, or one for each",
                 {}};
  for (std::size_t k = 0; k < given.size(); ++k)
    if (!(given[k].lower <= given[k].upper) || !std::isfinite(given[k].upper - given[k].lower)) {
      Error error{
          ErrorCode::out_of_range, std::string("a lower deviation of the ") + of + " is larger than the upper one", {}};
      error.evidence.vertex = static_cast<std::int64_t>(k);
      return error;
    }
  return std::nullopt;
}

}  // namespace

Result<FitStack> fit_stack(const Region& container, std::span<const Tolerance> container_tolerances, const Region& part,
                           std::span<const Tolerance> part_tolerances, const RationalPoint& at) {
  if (auto error = tolerance_error(container_tolerances, container.vertex_count(), "container")) return *error;
  if (auto error = tolerance_error(part_tolerances, part.vertex_count(), "part")) return *error;
  const Result<Robustness> robustness = robustness_of_fit(container, part, at);
  if (!robustness) return robustness.error();
  FitStack stack;
  stack.fits = robustness->holds;
  if (!stack.fits) return stack;
  const std::vector<Edge> edges = edges_of(container), part_edges = edges_of(part);
  const Deviations of_container(container_tolerances, edges), of_part(part_tolerances, part_edges);
  for (const Edge& e : edges)
    stack.rows.push_back(row_of(e, of_container.of({PlanarFeature::Kind::edge, e.from}), part_edges, of_part, at));
  std::stable_sort(stack.rows.begin(), stack.rows.end(),
                   [](const FitStackRow& a, const FitStackRow& b) { return a.least < b.least; });
  return stack;
}

}  // namespace dymsum

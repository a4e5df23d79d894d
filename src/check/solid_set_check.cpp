#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "base/poll.h"
#include "check/farthest_in_solid.h"
#include "check/triangle_distance.h"
#include "check/within.h"
#include "dymsum/set_check.h"
#include "dymsum/solid_union.h"
#include "exact/big.h"
#include "spatial/boolean/solid_union.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/sum/exact_set.h"

namespace dymsum {
namespace {

using check::ExactTriangle;
using check::RationalVector;
using exact::BigRational;
using spatial::ExactSet;

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A solid by its triangles, and whether it is known to be convex.
struct CheckedSolid {
  ExactSet set;
  bool convex = false;
};

CheckedSolid checked_solid(const SpatialOperand& operand) {
  const spatial::OperandSet set(operand, Semantics::regular);
  const SpatialSum* sum = spatial::result_of(operand);
  const bool convex =
      (sum != nullptr && sum->is_convex()) || (set.mesh() && !set.mesh()->empty() && !convexity_error(*set.mesh()));
  return {spatial::regular_triangles(set), convex};
}

/// What lies in a and not in b: by winding number, b inside out.
Result<SpatialSum> exact_difference(const ExactSet& a, const ExactSet& b, const SpatialOptions& options) {
  ExactSet all = a;
  spatial::append(all, b, true);
  return spatial::solid_inside(all, {1, false, false}, options);
}

/// The largest coordinate.
double reach_of(std::span<const Point3> vertices) {
  double reach = 0;
  for (const Point3& v : vertices) reach = std::max({reach, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return reach;
}

RationalPoint3 rational_point(const RationalVector& v) {
  return {exact::to_rational(v[0]), exact::to_rational(v[1]), exact::to_rational(v[2])};
}

/// What lies in a and not in b, and how far it is from the boundary of `from`, where `convex` says that this distance
/// is.
Result<SolidExcess> excess_of(const CheckedSolid& a, const CheckedSolid& b, const CheckedSolid& from,
                              const SpatialOptions& options, const Poll& poll) {
  Result<SpatialSum> set = exact_difference(a.set, b.set, options);
  if (!set) return set.error();
  SolidExcess excess;
  excess.set = *std::move(set);
  if (excess.set.faces.empty()) return excess;
  if (from.set.set.faces.empty()) {
    excess.distance = excess.at_most = kFar;
    excess.at = excess.set.exact(0);
    return excess;
  }
  const check::NearTriangles triangles(from.set, reach_of(excess.set.vertices));
  const check::FarthestInSolid farthest = check::farthest_in_solid(excess.set, triangles, from.convex, poll);
  excess.at = rational_point(farthest.at);
  excess.nearest = rational_point(farthest.nearest.at);
  excess.squared = exact::to_rational(farthest.nearest.squared);
  excess.distance = exact::root_to_double(farthest.nearest.squared);
  excess.exact = farthest.exact;
  excess.at_most = farthest.exact ? excess.distance : farthest.at_most;
  return excess;
}

Result<SolidSetCheck> check_solids(const CheckedSolid& right, const CheckedSolid& made, const SpatialOptions& options) {
  try {
    Poll poll(options.progress);
    poll.stage("distances");
    Result<SolidExcess> missing = excess_of(right, made, made, options, poll);
    if (!missing) return missing.error();
    Result<SolidExcess> surplus = excess_of(made, right, right, options, poll);
    if (!surplus) return surplus.error();
    return SolidSetCheck{*std::move(missing), *std::move(surplus)};
  } catch (const Cancelled&) {
    return cancelled();
  }
}

struct SolidGap {
  BigRational squared;
  RationalVector of_a, of_b;
};

/// The nearest positions of two boundaries that do not cross: of a vertex and a triangle, or of two edges.
class NearestPair {
 public:
  NearestPair(const ExactSet& a, const ExactSet& b) : sets_{&a, &b} {
    for (int side = 0; side < 2; ++side) {
      const MeshData& mesh = sets_[side]->set;
      std::vector<spatial::Box> triangles;
      for (const Face& f : mesh.faces) {
        spatial::Box box;
        for (std::size_t k = 0; k < 3; ++k) {
          const Point3& p = mesh.vertices[f[k]];
          box.add(spatial::Vec3{p.x, p.y, p.z});
          reach_ = std::max({reach_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
          if (f[k] < f[(k + 1) % 3]) edges_[side].push_back({f[k], f[(k + 1) % 3]});
        }
        triangles.push_back(box);
      }
      trees_[side] = spatial::BoxTree(std::move(triangles));
    }
  }

  std::optional<SolidGap> run(const Poll& poll) {
    for (const int side : {0, 1}) see_vertices(side);
    if (!best_) return std::nullopt;
    const std::vector<spatial::Box> boxes = edge_boxes(1);
    const spatial::BoxTree tree(boxes);
    for (std::size_t e = 0; e < edges_[0].size(); ++e) {
      poll.at_test(e, edges_[0].size());
      spatial::Box box = box_of(0, edges_[0][e]);
      box.grow(reach());
      tree.for_each(box, [&](std::uint32_t f) { see_edges(edges_[0][e], edges_[1][f]); });
    }
    return best_;
  }

 private:
  using Edge = std::array<std::uint32_t, 2>;

  /// What is further than that is further than the nearest known.
  double reach() const { return exact::root_to_double(best_->squared) * (1 + 0x1p-40) + 0x1p-40 * reach_; }

  spatial::Box box_of(int side, const Edge& edge) const {
    spatial::Box box;
    for (const std::uint32_t v : edge) {
      const Point3& p = sets_[side]->set.vertices[v];
      box.add(spatial::Vec3{p.x, p.y, p.z});
    }
    return box;
  }
  std::vector<spatial::Box> edge_boxes(int side) const {
    std::vector<spatial::Box> boxes;
    for (const Edge& edge : edges_[side]) boxes.push_back(box_of(side, edge));
    return boxes;
  }

  void take(BigRational squared, const RationalVector& of_a, const RationalVector& of_b) {
    if (!best_ || squared < best_->squared) best_ = SolidGap{std::move(squared), of_a, of_b};
  }

  // Of one solid all, from the triangles of the other one that are near enough.
  void see_vertices(int side) {
    const ExactSet &own = *sets_[side], &other = *sets_[1 - side];
    std::vector<bool> used(own.at.size());
    for (const Face& f : own.set.faces)
      for (const std::uint32_t v : f) used[v] = true;
    for (std::uint32_t v = 0; v < own.at.size(); ++v) {
      if (!used[v]) continue;
      const Point3& p = own.set.vertices[v];
      double least = kFar;
      const auto rough = [&](std::uint32_t f) {
        const Face& face = other.set.faces[f];
        return check::rough_distance(
            p, {other.set.vertices[face[0]], other.set.vertices[face[1]], other.set.vertices[face[2]]});
      };
      const auto see = [&](std::uint32_t f) {
        const double d = rough(f);
        if (d > least + check::kRoughDistance * reach_) return;
        least = std::min(least, d);
        const Face& face = other.set.faces[f];
        check::TriangleNearest nearest =
            check::nearest_on(own.at[v], {other.at[face[0]], other.at[face[1]], other.at[face[2]]});
        if (side == 0) take(std::move(nearest.squared), own.at[v], nearest.at);
        else take(std::move(nearest.squared), nearest.at, own.at[v]);
      };
      if (!best_) {
        for (std::uint32_t f = 0; f < other.set.faces.size(); ++f) see(f);
        continue;
      }
      spatial::Box box;
      box.add(spatial::Vec3{p.x, p.y, p.z});
      box.grow(reach());
      trees_[1 - side].for_each(box, see);
    }
  }

  void see_edges(const Edge& e, const Edge& f) {
    const auto &a = sets_[0]->at, &b = sets_[1]->at;
    if (const auto nearest = check::nearest_inside(a[e[0]], a[e[1]], b[f[0]], b[f[1]]))
      take(nearest->squared, nearest->of_a, nearest->of_b);
  }

  std::array<const ExactSet*, 2> sets_;
  std::array<spatial::BoxTree, 2> trees_;
  std::array<std::vector<Edge>, 2> edges_;
  double reach_ = 0;
  std::optional<SolidGap> best_;
};

}  // namespace

CheckVerdict SolidOffsetCheck::at_least(const Rational& r) const {
  const bool holds = beyond.set.faces.empty() && (r.sign() <= 0 || std::isinf(least) || least_squared >= r * r);
  return holds ? CheckVerdict::right : CheckVerdict::wrong;
}
CheckVerdict SolidOffsetCheck::at_most(const Rational& r) const { return check::within(between, r); }

Result<SolidOffsetCheck> check_offset(const SpatialOperand& a, const SpatialOperand& made, DiscSide side,
                                      const SpatialOptions& options) {
  const bool outside = side == DiscSide::outside;
  CheckedSolid operand = checked_solid(a);
  const CheckedSolid set = checked_solid(made);
  try {
    Poll poll(options.progress);
    poll.stage("distances");
    const CheckedSolid &inner = outside ? operand : set, &outer = outside ? set : operand;
    SolidOffsetCheck check;
    Result<SolidExcess> beyond = excess_of(inner, outer, outer, options, poll);
    if (!beyond) return beyond.error();
    check.beyond = *std::move(beyond);
    CheckedSolid from = operand;
    from.convex &= outside;  // from the outside of a convex solid the distance is not convex
    Result<SolidExcess> between = excess_of(outer, inner, from, options, poll);
    if (!between) return between.error();
    check.between = *std::move(between);
    if (!check.beyond.set.faces.empty()) return check;
    if (const std::optional<SolidGap> gap = NearestPair(operand.set, set.set).run(poll)) {
      check.least_squared = exact::to_rational(gap->squared);
      check.least = exact::root_to_double(gap->squared);
      check.least_from = rational_point(gap->of_a);
      check.least_at = rational_point(gap->of_b);
    } else {
      check.least = kFar;
    }
    return check;
  } catch (const Cancelled&) {
    return cancelled();
  }
}

bool SolidSetCheck::contains() const { return missing.set.faces.empty(); }
bool SolidSetCheck::contained() const { return surplus.set.faces.empty(); }
CheckVerdict SolidSetCheck::within(const Rational& tolerance) const {
  return check::both(check::within(missing, tolerance), check::within(surplus, tolerance));
}

Result<SolidSetCheck> check_set(const SpatialOperand& right, const SpatialOperand& made,
                                const SpatialOptions& options) {
  return check_solids(checked_solid(right), checked_solid(made), options);
}

}  // namespace dymsum

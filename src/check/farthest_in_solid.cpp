#include "check/farthest_in_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "check/cell_cuts.h"
#include "check/solid_cell.h"
#include "check/solid_crossing.h"
#include "spatial/sum/exact_locator.h"

namespace dymsum::check {
namespace {

using exact::BigRational;
using spatial::ExactLocator;
using spatial::ExactSet;

class SolidSearch {
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

 public:
  SolidSearch(const SpatialSum& set, const NearTriangles& triangles, const Poll& poll)
      : set_(spatial::exact_set(set)),
        locator_(set),
        triangles_(triangles),
        poll_(poll),
        surface_(set_, planes_),
        cuts_(triangles, planes_) {}

  void see_vertices() {
    std::vector<bool> used(set_.at.size());
    for (const Face& f : set_.set.faces)
      for (const std::uint32_t v : f) used[v] = true;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (used[v]) see(*surface_.vertex(v));
      poll_.at_test(v, used.size());
    }
  }

  void see_cells() {
    const std::size_t most = kMostCuts + kMostCutsOfFace * set_.set.faces.size();
    add({surface_.box(planes_), surface_.all()});
    while (!queue_.empty() && queue_.begin()->first > root_below_) {
      if (cuts_made_ >= most) return leave(queue_.begin()->first);
      poll_.at_test(++cuts_made_, most);
      auto top = queue_.extract(queue_.begin());
      advance(std::move(top.mapped()), top.key());
    }
  }

  FarthestInSolid result() && {
    if (best_.exact) best_.at_most = exact::root_to_double(best_.nearest.squared);
    return std::move(best_);
  }

 private:
  /// A bound may be larger than the distance by this, of the distance.
  static constexpr double kGap = 0x1p-30;
  /// So often such a cell is cut in the hope for a proof that nothing in it is further.
  static constexpr int kMostClose = 3;
  /// Cells that are cut: of any set, and for each of its faces.
  static constexpr std::size_t kMostCuts = 1'000, kMostCutsOfFace = 4;

  struct Cell {
    SolidCell shape;
    std::vector<std::uint32_t> crossing;  ///< faces of the set that may cross its inside
    std::uint32_t triangle = 0;           ///< that bounds its distance
    int depth = 0;
    int close = 0;        ///< how often it was cut within kGap
    bool inside = false;  ///< it is known to lie in the set
  };

  /// Positions may be so far: nothing says that they are not.
  void leave(double bound) {
    best_.at_most = best_.exact ? bound : std::max(best_.at_most, bound);
    best_.exact = false;
  }

  /// Takes the position, which lies in the set, where it is further than all before.
  void see(const SpacePoint& p) {
    if (root_below_ >= 0 && triangles_.distance_above(p.near, triangles_.rough_nearest(p.near)) <= root_below_) return;
    RationalVector at = p.rational();
    NearTriangles::Nearest nearest = triangles_.nearest(at, p.near);
    if (root_below_ >= 0 && exact::compare(nearest.squared, best_.nearest.squared) <= 0) return;
    root_below_ = std::max(0.0, std::nextafter(exact::root_to_double(nearest.squared), -kInfinite));
    best_.at = std::move(at);
    best_.nearest = std::move(nearest);
  }

  std::vector<std::uint32_t> near_triangles(const SolidCell& cell) const {
    std::vector<std::uint32_t> near;
    for (const SpacePointRef& v : cell.vertices) near.push_back(triangles_.rough_nearest(v->near));
    near.push_back(triangles_.rough_nearest(rough_centre(cell)));
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    return near;
  }

  double bound_of(const SolidCell& cell, std::uint32_t triangle) const {
    double most = 0;
    for (const SpacePointRef& v : cell.vertices) most = std::max(most, triangles_.distance_above(v->near, triangle));
    return most;
  }

  void add(Cell cell) {
    double bound = kInfinite;
    for (const std::uint32_t t : near_triangles(cell.shape))
      if (const double b = bound_of(cell.shape, t); b < bound) bound = b, cell.triangle = t;
    if (bound > root_below_) queue_.emplace(bound, std::move(cell));
  }

  /// Whether a triangle proves, in exact numbers, that no position of the cell is further than what is known.
  bool is_proved(const SolidCell& cell) const {
    const auto near_enough = [&](const SpacePointRef& v, std::uint32_t t) {
      if (triangles_.distance_above(v->near, t) <= root_below_) return true;
      return exact::compare(nearest_on(v->rational(), triangles_.exact(t)).squared, best_.nearest.squared) <= 0;
    };
    for (const std::uint32_t t : near_triangles(cell)) {
      if (bound_of(cell, t) > close_to_best()) continue;
      if (std::all_of(cell.vertices.begin(), cell.vertices.end(), [&](const auto& v) { return near_enough(v, t); }))
        return true;
    }
    return false;
  }
  double close_to_best() const { return root_below_ * (1 + 0x1p-40) + 4 * triangles_.slack(); }

  /// Drops the cell, or cuts it in two.
  void advance(Cell cell, double bound) {
    if (bound <= close_to_best() && is_proved(cell.shape)) return;
    if (!cell.crossing.empty())
      if (auto halves = surface_.cut(cell.shape, cell.crossing, worst_of(cell))) return take(cell, *std::move(halves));
    cell.crossing.clear();
    if (!cell.inside) {
      if (!lies_inside(cell.shape)) return;
      cell.inside = true;
    }
    for (const SpacePointRef& v : cell.shape.vertices) see(*v);
    if (bound <= close_to_best() && is_proved(cell.shape)) return;
    if (bound <= root_below_ * (1 + kGap) && cell.close++ >= kMostClose) return leave(bound);
    auto halves = cuts_.cut(cell.shape, cell.triangle, worst_of(cell), cell.depth);
    if (!halves) return leave(bound);
    take(cell, *std::move(halves));
  }

  void take(const Cell& cell, HalvedSolidCell halves) {
    for (SolidCell* half : {&halves.negative, &halves.positive}) {
      Cell next{std::move(*half), {}, 0, cell.depth + (cell.crossing.empty() ? 1 : 0), cell.close, cell.inside};
      next.crossing = surface_.crossing(next.shape, cell.crossing);
      add(std::move(next));
    }
  }

  const SpacePoint& worst_of(const Cell& cell) const {
    const SpacePoint* worst = nullptr;
    double most = -1;
    for (const SpacePointRef& v : cell.shape.vertices)
      if (const double d = triangles_.distance_above(v->near, cell.triangle); d > most) most = d, worst = v.get();
    return *worst;
  }

  /// Of a cell that no face crosses: by a position of its inside, of few digits where there is one.
  bool lies_inside(const SolidCell& cell) {
    for (const int bits : {0, 256}) {
      const SpacePoint centre = centre_near(cell, bits);
      if (std::all_of(cell.facets.begin(), cell.facets.end(), [&](const SolidCell::Facet& facet) {
            return side_of(planes_[facet.plane], centre) == facet.side;
          }))
        if (const std::optional<bool> known = surface_.is_inside(centre)) return *known;
    }
    return locator_.of(centre_of(cell)) == ExactLocator::Where::inside;
  }

  /// Weights of vertices, unequal ones: a mean is seldom above an edge then.
  static unsigned weight(std::size_t vertex) { return 16 + static_cast<unsigned>(5 * vertex % 7); }
  static Vec3 rough_centre(const SolidCell& cell) {
    Vec3 sum;
    double weights = 0;
    for (std::size_t k = 0; k < cell.vertices.size(); ++k) {
      sum = sum + weight(k) * cell.vertices[k]->near;
      weights += weight(k);
    }
    return 1 / weights * sum;
  }
  /// The same mean, rounded to so many bits more than doubles have of the largest of its coordinates.
  static SpacePoint centre_near(const SolidCell& cell, int bits) {
    const Vec3 c = rough_centre(cell);
    const double most = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    const int shift = bits - (most > 0 ? std::ilogb(most) : 0);
    if (bits == 0 || shift < 0) return SpacePoint(exactly(c));
    std::array<BigInteger, 4> h{0, 0, 0, 0};
    for (std::size_t v = 0; v < cell.vertices.size(); ++v) {
      const auto& at = cell.vertices[v]->exact;
      for (int k = 0; k < 3; ++k) h[k] += weight(v) * ((at[k] << shift) / at[3]);
      h[3] += weight(v);
    }
    h[3] <<= shift;
    return SpacePoint(std::move(h));
  }
  static RationalVector centre_of(const SolidCell& cell) {
    RationalVector centre{0, 0, 0};
    for (const SpacePointRef& v : cell.vertices) {
      const RationalVector p = v->rational();
      for (int k = 0; k < 3; ++k) centre[k] += p[k];
    }
    for (BigRational& c : centre) c /= static_cast<unsigned>(cell.vertices.size());
    return centre;
  }

  ExactSet set_;
  ExactLocator locator_;
  const NearTriangles& triangles_;
  const Poll& poll_;
  PlaneTable planes_;
  SolidCrossing surface_;
  CellCuts cuts_;
  FarthestInSolid best_;
  double root_below_ = -1;  // of best_.nearest.squared
  std::multimap<double, Cell, std::greater<>> queue_;
  std::size_t cuts_made_ = 0;
};

}  // namespace

FarthestInSolid farthest_in_solid(const SpatialSum& set, const NearTriangles& triangles, bool convex,
                                  const Poll& poll) {
  SolidSearch search(set, triangles, poll);
  search.see_vertices();
  if (!convex) search.see_cells();
  return std::move(search).result();
}

}  // namespace dymsum::check

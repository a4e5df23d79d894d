#include "dymsum/sum_locator.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <deque>
#include <span>
#include <stdexcept>
#include <vector>

#include "exact/orient.h"
#include "planar/position/exact_source.h"
#include "planar/sum/contains.h"

namespace dymsum::planar {
namespace {

// Positions for questions asked often: doubles decide nearly always, and exact numbers are kept only where doubles do
// not hold a position.

/// A position by its nearest doubles and the side of them on which it lies. Rounding to nearest is monotone, so
/// positions are ordered as their nearest doubles, then as these sides.
struct NearSpot {
  Point at;
  std::int8_t off_x = 0, off_y = 0;  ///< the signs of exact - at
  const Position* exact = nullptr;   ///< null: `at` is the position
};

/// Requires: finite.
inline NearSpot near_spot(Point p) { return {{p.x + 0.0, p.y + 0.0}}; }

Spot spot_of(const NearSpot& s) { return s.exact == nullptr ? make_spot(s.at) : Spot{*s.exact, s.at}; }

int compare_near(double a, int off_a, double b, int off_b) {
  if (a != b) return a < b ? -1 : 1;
  return (off_a > off_b) - (off_a < off_b);
}

/// The position, which is added to `kept` unless doubles hold it. Requires: its nearest doubles are finite.
NearSpot near_spot(Position p, std::deque<Position>& kept) {
  NearSpot s;
  s.at = {exact::round_to_double(p.x), exact::round_to_double(p.y)};
  s.off_x = static_cast<std::int8_t>(compare(p.x, exact::exact_value(s.at.x)));
  s.off_y = static_cast<std::int8_t>(compare(p.y, exact::exact_value(s.at.y)));
  if (s.off_x != 0 || s.off_y != 0) s.exact = &kept.emplace_back(std::move(p));
  return s;
}

int compare_x(const NearSpot& a, const NearSpot& b) {
  const int order = compare_near(a.at.x, a.off_x, b.at.x, b.off_x);
  return order != 0 || a.off_x == 0 ? order : compare(a.exact->x, b.exact->x);
}

int compare_y(const NearSpot& a, const NearSpot& b) {
  const int order = compare_near(a.at.y, a.off_y, b.at.y, b.off_y);
  return order != 0 || a.off_y == 0 ? order : compare(a.exact->y, b.exact->y);
}

/// The sign of (b - a) x (c - a), exactly.
int orientation(const NearSpot& a, const NearSpot& b, const NearSpot& c) {
  if (a.exact == nullptr && b.exact == nullptr && c.exact == nullptr) return exact::orient_sign(a.at, b.at, c.at);
  const int sign = orientation_filtered(a.at, b.at, c.at);
  return sign != 0 ? sign : orientation(spot_of(a), spot_of(b), spot_of(c));
}

/// True when c lies on the closed segment from a to b, which may be one point.
bool on_segment(const NearSpot& a, const NearSpot& b, const NearSpot& c) {
  return compare_x(a, c) * compare_x(c, b) >= 0 && compare_y(a, c) * compare_y(c, b) >= 0 && orientation(a, b, c) == 0;
}

}  // namespace

// Finds the points that lie on segments and points of a set: a tree of boxes.

/// A closed segment; both ends equal: a point.
struct Feature {
  NearSpot from, to;
};

/// Features may cross and overlap. Exact. O(n log n) to make; a question looks at the features in whose boxes the point
/// lies, and at O(log n) others where boxes are apart.
class FeatureTree {
 public:
  FeatureTree() = default;
  /// Requires: what the ends refer to outlives this.
  explicit FeatureTree(std::vector<Feature> features);

  bool holds(const NearSpot& z) const;

 private:
  struct Node {
    Point low, high;
    std::uint32_t first, last;  // its features
    std::uint32_t after;        // the node that follows when this one's box does not hold a point
    bool leaf;
  };
  void add_node(std::uint32_t first, std::uint32_t last);

  std::vector<Feature> features_;
  std::vector<Node> nodes_;  // each before its two children
};

FeatureTree::FeatureTree(std::vector<Feature> features) : features_(std::move(features)) {
  if (!features_.empty()) add_node(0, static_cast<std::uint32_t>(features_.size()));
}

void FeatureTree::add_node(std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 4;
  Point low = features_[first].from.at, high = low;
  for (std::uint32_t k = first; k < last; ++k)
    for (const NearSpot& end : {features_[k].from, features_[k].to}) {
      low = {std::min(low.x, end.at.x), std::min(low.y, end.at.y)};
      high = {std::max(high.x, end.at.x), std::max(high.y, end.at.y)};
    }
  const std::size_t self = nodes_.size();
  nodes_.push_back({low, high, first, last, 0, last - first <= kLeaf});
  if (!nodes_[self].leaf) {
    const bool wide = high.x - low.x >= high.y - low.y;
    const auto midpoint_of = [wide](const Feature& f) {
      return wide ? f.from.at.x / 2 + f.to.at.x / 2 : f.from.at.y / 2 + f.to.at.y / 2;
    };
    const std::uint32_t midpoint = first + (last - first) / 2;
    std::nth_element(features_.begin() + first, features_.begin() + midpoint, features_.begin() + last,
                     [&](const Feature& a, const Feature& b) { return midpoint_of(a) < midpoint_of(b); });
    add_node(first, midpoint);
    add_node(midpoint, last);
  }
  nodes_[self].after = static_cast<std::uint32_t>(nodes_.size());
}

// Boxes are those of nearest doubles. Rounding is monotone, so a point of a feature has its nearest doubles in the box.
bool FeatureTree::holds(const NearSpot& z) const {
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const bool near = node.low.x <= z.at.x && z.at.x <= node.high.x && node.low.y <= z.at.y && z.at.y <= node.high.y;
    for (std::uint32_t k = node.first; near && node.leaf && k < node.last; ++k)
      if (on_segment(features_[k].from, features_[k].to, z)) return true;
    n = near ? n + 1 : node.after;
  }
  return false;
}

namespace {

// Point location among rings: horizontal slabs between the heights of their vertices, in a binary tree of slabs.

/// The location of points against the set bounded by rings that do not cross (even-odd; they may touch in points). An
/// edge is kept at the O(log n) nodes of the tree whose slabs it spans and that together are its height. Edges of a
/// node do not meet inside its slab, so they have an order from left to right, and so have their sides at any point of
/// the closed slab. Exact. O(n log^2 n) to make, O(n log n) memory, O(log^2 n) a question.
class RingSlabs {
 public:
  RingSlabs() = default;
  /// Requires: what the vertices refer to outlives this, no two consecutive ones are equal.
  explicit RingSlabs(std::span<const std::vector<NearSpot>> rings);

  Location locate(const NearSpot& z) const;

 private:
  struct Edge {
    NearSpot low, high;
    std::uint32_t from, to;  // their levels
  };
  struct Flat {  // a horizontal edge
    NearSpot left, right;
    std::uint32_t level;
  };

  std::uint32_t level_of(const NearSpot& v) const;
  void take_edges(std::span<const std::vector<NearSpot>> rings);
  template <class Visit>
  void for_each_node(const Edge& edge, Visit&& visit) const;
  void fill_nodes();
  static bool left_of(const Edge& a, const Edge& b);
  Location in_slab(std::uint32_t slab, const NearSpot& z) const;
  bool on_flat(std::uint32_t level, const NearSpot& z) const;

  std::vector<NearSpot> levels_;  // one vertex of each height, from below
  std::vector<Edge> edges_;
  std::vector<Flat> flats_;             // by level, then from left to right
  std::uint32_t leaves_ = 1;            // a power of two; slab s, between levels s and s + 1, is node leaves_ + s
  std::vector<std::uint32_t> starts_;   // of each node in members_; node 1 is the root, its children 2 and 3
  std::vector<std::uint32_t> members_;  // edges
};

RingSlabs::RingSlabs(std::span<const std::vector<NearSpot>> rings) {
  for (const std::vector<NearSpot>& ring : rings) levels_.insert(levels_.end(), ring.begin(), ring.end());
  std::sort(levels_.begin(), levels_.end(), [](const NearSpot& a, const NearSpot& b) { return compare_y(a, b) < 0; });
  const auto same = [](const NearSpot& a, const NearSpot& b) { return compare_y(a, b) == 0; };
  levels_.erase(std::unique(levels_.begin(), levels_.end(), same), levels_.end());
  if (levels_.size() > 1) leaves_ = std::bit_ceil(static_cast<std::uint32_t>(levels_.size() - 1));
  take_edges(rings);
  fill_nodes();
}

/// The first level that is not below v.
std::uint32_t RingSlabs::level_of(const NearSpot& v) const {
  const auto below = [](const NearSpot& level, const NearSpot& at) { return compare_y(level, at) < 0; };
  return static_cast<std::uint32_t>(std::lower_bound(levels_.begin(), levels_.end(), v, below) - levels_.begin());
}

void RingSlabs::take_edges(std::span<const std::vector<NearSpot>> rings) {
  for (const std::vector<NearSpot>& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const NearSpot &a = ring[k], &b = ring[k + 1 == ring.size() ? 0 : k + 1];
      const std::uint32_t from = level_of(a), to = level_of(b);
      if (from == to) {
        const bool forward = compare_x(a, b) < 0;
        flats_.push_back({forward ? a : b, forward ? b : a, from});
      } else {
        edges_.push_back(from < to ? Edge{a, b, from, to} : Edge{b, a, to, from});
      }
    }
  std::sort(flats_.begin(), flats_.end(), [](const Flat& a, const Flat& b) {
    return a.level != b.level ? a.level < b.level : compare_x(a.left, b.left) < 0;
  });
}

/// The nodes whose slabs together are the edge's height, none above another one.
template <class Visit>
void RingSlabs::for_each_node(const Edge& edge, Visit&& visit) const {
  for (std::uint32_t l = edge.from + leaves_, r = edge.to + leaves_; l < r; l /= 2, r /= 2) {
    if (l % 2 == 1) visit(l++);
    if (r % 2 == 1) visit(--r);
  }
}

void RingSlabs::fill_nodes() {
  starts_.assign(2 * std::size_t{leaves_} + 1, 0);
  for (const Edge& edge : edges_) for_each_node(edge, [&](std::uint32_t node) { ++starts_[node + 1]; });
  for (std::size_t node = 1; node < starts_.size(); ++node) starts_[node] += starts_[node - 1];
  members_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    for_each_node(edges_[e], [&](std::uint32_t node) { members_[next[node]++] = e; });
  const auto left = [this](std::uint32_t a, std::uint32_t b) { return a != b && left_of(edges_[a], edges_[b]); };
  for (std::size_t node = 0; node + 1 < starts_.size(); ++node)
    std::sort(members_.begin() + starts_[node], members_.begin() + starts_[node + 1], left);
}

// Whether the first of two edges is left of the other, given that they do not meet between the heights that they share.
// Where the upper one of the lower ends lies on the other edge, the lower one of the upper ends does not.
bool RingSlabs::left_of(const Edge& a, const Edge& b) {
  const int low = a.from >= b.from ? orientation(b.low, b.high, a.low) : -orientation(a.low, a.high, b.low);
  if (low != 0) return low > 0;
  return (a.to <= b.to ? orientation(b.low, b.high, a.high) : -orientation(a.low, a.high, b.high)) > 0;
}

/// The edges to the left of z decide. Requires that z lies in the closed slab; where that is on one of its ends, the
/// answer is that of the points of the slab next to z, unless an edge of the slab passes z.
Location RingSlabs::in_slab(std::uint32_t slab, const NearSpot& z) const {
  std::uint32_t left = 0;
  for (std::uint32_t node = leaves_ + slab; node > 0; node /= 2) {
    std::uint32_t first = starts_[node], last = starts_[node + 1];
    left -= first;
    while (first < last) {
      const std::uint32_t midpoint = first + (last - first) / 2;
      const Edge& edge = edges_[members_[midpoint]];
      const int side = orientation(edge.low, edge.high, z);
      if (side == 0) return Location::boundary;
      if (side < 0) {
        first = midpoint + 1;
      } else {
        last = midpoint;
      }
    }
    left += first;
  }
  return left % 2 == 1 ? Location::inside : Location::outside;
}

bool RingSlabs::on_flat(std::uint32_t level, const NearSpot& z) const {
  const auto after = std::partition_point(flats_.begin(), flats_.end(), [&](const Flat& flat) {
    return flat.level < level || (flat.level == level && compare_x(flat.left, z) <= 0);
  });
  return after != flats_.begin() && (after - 1)->level == level && compare_x((after - 1)->right, z) >= 0;
}

Location RingSlabs::locate(const NearSpot& z) const {
  const std::uint32_t level = level_of(z);
  if (level == levels_.size()) return Location::outside;
  const bool at_level = compare_y(levels_[level], z) == 0;
  if (!at_level) return level == 0 ? Location::outside : in_slab(level - 1, z);
  if (on_flat(level, z)) return Location::boundary;
  if (level > 0 && in_slab(level - 1, z) == Location::boundary) return Location::boundary;
  return level + 1 < levels_.size() ? in_slab(level, z) : Location::outside;
}

}  // namespace
}  // namespace dymsum::planar

namespace dymsum {

using planar::NearSpot;

struct SumLocator::State {
  std::deque<planar::Position> positions;  // those that no doubles hold
  planar::RingSlabs rings;
  planar::FeatureTree features;  // in the closed set, beside its parts; outside the open one, inside its parts
  bool open;

  State(const PlanarSum& sum, Semantics semantics);
  NearSpot spot(const PlanarSum& sum, const SumVertex& v);
  bool contains(const NearSpot& z) const;
};

NearSpot SumLocator::State::spot(const PlanarSum& sum, const SumVertex& v) {
  if (sum.at_error == 0) return planar::near_spot(v.at);
  const std::shared_ptr<const ExactSource>& source = exact_source(sum);
  if (source == nullptr) throw std::logic_error("SumLocator: vertices without exact positions");
  return planar::near_spot(source->position(v), positions);
}

SumLocator::State::State(const PlanarSum& sum, Semantics semantics) : open(semantics == Semantics::open) {
  std::vector<std::vector<NearSpot>> all;
  const auto add_ring = [&](const SumRing& ring) {
    std::vector<NearSpot>& spots = all.emplace_back();
    for (const SumVertex& v : ring.vertices) spots.push_back(spot(sum, v));
  };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    for (const SumRing& hole : part.holes) add_ring(hole);
  }
  rings = planar::RingSlabs(all);
  if (semantics == Semantics::regular) return;
  std::vector<planar::Feature> thin;
  for (const SumSegment& s : open ? sum.tight_segments : sum.segments)
    thin.push_back({spot(sum, s.from), spot(sum, s.to)});
  for (const SumVertex& v : open ? sum.tight_points : sum.points) thin.push_back({spot(sum, v), spot(sum, v)});
  features = planar::FeatureTree(std::move(thin));
}

bool SumLocator::State::contains(const NearSpot& z) const {
  const planar::Location at = rings.locate(z);
  if (open) return at == planar::Location::inside && !features.holds(z);
  return at != planar::Location::outside || features.holds(z);
}

SumLocator::SumLocator(const PlanarSum& sum, Semantics semantics)
    : state_(std::make_shared<const State>(sum, semantics)) {}

bool SumLocator::contains(Point z) const {
  return std::isfinite(z.x) && std::isfinite(z.y) && state_->contains(planar::near_spot(z));
}

bool SumLocator::contains_rational(const RationalPoint& z) const {
  if (!std::isfinite(z.x.to_double()) || !std::isfinite(z.y.to_double())) return false;  // sums reach to 2^1001
  std::deque<planar::Position> kept;
  return state_->contains(planar::near_spot({exact::exact_value(z.x), exact::exact_value(z.y)}, kept));
}

Result<std::vector<std::uint8_t>> SumLocator::contains_each(std::span<const Point> points, int threads,
                                                            const Progress& progress) const {
  return planar::answer_blocks(points.size(), 1 << 16, 2048, threads, progress,
                               [&](std::size_t k) { return contains(points[k]); });
}

Result<std::vector<std::uint8_t>> SumLocator::contains_each(std::span<const RationalPoint> points, int threads,
                                                            const Progress& progress) const {
  return planar::answer_blocks(points.size(), 1 << 12, 16, threads, progress,
                               [&](std::size_t k) { return contains_rational(points[k]); });
}

}  // namespace dymsum

#include "depth/boundary_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "spatial/mesh/box_tree.h"

namespace dymsum::depth {

using exact::BigRational;
using spatial::Vec3;

namespace {

RationalVector difference(const RationalVector& a, const RationalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
BigRational product(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
RationalVector normal_of(const RationalVector& a, const RationalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

using Loops = std::vector<std::vector<std::uint32_t>>;

/// f(a, b) of all facet edges.
template <class F>
void for_each_facet_edge(const Loops& loops, F f) {
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k) f(loop[k], loop[(k + 1) % loop.size()]);
}

/// Vertices relative to the position in doubles, each coordinate within `off_`, and what these prove of distances.
class ProvedDistances {
 public:
  ProvedDistances(const SpatialSum& sum, const RationalVector& from) {
    const Vec3 origin{exact::round_to_double(from[0]), exact::round_to_double(from[1]),
                      exact::round_to_double(from[2])};
    double size = length(origin);
    for (const Point3& v : sum.vertices) {
      at_.push_back(Vec3{v.x, v.y, v.z} - origin);
      size = std::max(size, length(Vec3{v.x, v.y, v.z}));
    }
    off_ = sum.at_error + size * 0x1p-50 + 0x1p-1000;
    // A position of any facet edge or vertex bounds the least distance.
    const auto look = [&](const Loops& loops) {
      for_each_facet_edge(loops, [&](std::uint32_t a, std::uint32_t b) {
        const Bounded d = segment(a, b);
        at_most_ = std::min(at_most_, d.value + d.error);
      });
    };
    for (const SpatialFace& face : sum.faces) look(face.loops);
    for (const Loops& loops : sum.tight_faces) look(loops);
    for (const auto& [a, b] : sum.tight_segments) look({{a, b}});
    for (const std::uint32_t a : sum.tight_points) at_most_ = std::min(at_most_, (length(at_[a]) + 2 * off_) * kUp);
  }

  bool is_further(std::uint32_t a, std::uint32_t b) const {
    const Bounded d = segment(a, b);
    return d.value - d.error > at_most_;
  }
  /// Whether the foot on the face's plane is further away, or beside the face.
  bool is_foot_further(const Loops& loops) const {
    // The normal as in BoundaryDistance::face: every product errs by what its factors do, and by rounding.
    const std::vector<std::uint32_t>& outer = loops.front();
    Vec3 n;
    double error = 0;
    spatial::Box box;
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const Vec3 a = at_[outer[k]], b = at_[outer[(k + 1) % outer.size()]];
      const double la = length(a), lb = length(b);
      n = n + cross(a, b), box.add(a);
      error += 4 * off_ * (la + lb + 2 * off_) + la * lb * (0x1p-49 + static_cast<double>(outer.size()) * 0x1p-52);
    }
    const Vec3 a = at_[outer[0]];
    const double size = length(n), height = dot(n, a),
                 height_error = (error + size * 0x1p-48) * (length(a) + 2 * off_) + 2 * off_ * size;
    if ((std::abs(height) - height_error) * (1 - 0x1p-40) > at_most_ * (size + error)) return true;
    if (!(size > 8 * error)) return false;
    const double distance = std::abs(height) / size,
                 room = 4 * distance * error / size + 4 * height_error / size + distance * 0x1p-40 + 2 * off_;
    const Vec3 foot = (height / size / size) * n;
    box.grow(room);
    return foot.x < box.low.x || foot.y < box.low.y || foot.z < box.low.z || foot.x > box.high.x ||
           foot.y > box.high.y || foot.z > box.high.z;
  }

 private:
  static constexpr double kUp = 1 + 0x1p-40;
  struct Bounded {
    double value = 0, error = 0;
  };
  /// The distance of a segment. Components of its direction are rounded once, so that the parameter of the foot errs by
  /// 2^-49 |a| / |d| at most, along which the distance changes by |d| times as much.
  Bounded segment(std::uint32_t from, std::uint32_t to) const {
    const Vec3 a = at_[from], b = at_[to], d = b - a;
    const double square = dot(d, d), t = square > 0x1p-900 ? std::clamp(-dot(a, d) / square, 0.0, 1.0) : 0;
    return {length(a + t * d), (length(a) + length(b)) * 0x1p-44 + 4 * off_ + 0x1p-400};
  }

  std::vector<Vec3> at_;
  double off_ = 0, at_most_ = std::numeric_limits<double>::infinity();
};

class BoundaryDistance {
 public:
  BoundaryDistance(const SpatialSum& sum, const RationalVector& from)
      : sum_(sum), from_(from), at_(sum.vertices.size()) {}

  std::vector<RationalVector> take() { return std::move(nearest_); }

  void segment(std::uint32_t from, std::uint32_t to) {
    const RationalVector &a = at(from), &b = at(to), d = difference(b, a);
    const BigRational size = product(d, d), t = -product(a, d) / size;
    if (t <= 0) return offer(a);
    if (t >= 1) return offer(b);
    offer({a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]});
  }
  void point(std::uint32_t a) { offer(at(a)); }

  /// The foot on its plane, where it lies inside an odd number of loops.
  void foot(const Loops& loops) {
    RationalVector n{};
    const std::vector<std::uint32_t>& outer = loops.front();
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const RationalVector c = normal_of(at(outer[k]), at(outer[(k + 1) % outer.size()]));
      for (std::size_t i = 0; i < 3; ++i) n[i] += c[i];
    }
    const BigRational t = product(n, at(outer[0])) / product(n, n);
    const RationalVector foot{t * n[0], t * n[1], t * n[2]};
    std::size_t drop = 0;
    while (n[drop] == 0) ++drop;
    bool inside = false;
    for_each_facet_edge(loops, [&](std::uint32_t a, std::uint32_t b) {
      inside ^= passes(at(a), at(b), foot, (drop + 1) % 3, (drop + 2) % 3);
    });
    if (inside) offer(foot);
  }

 private:
  static bool passes(const RationalVector& a, const RationalVector& b, const RationalVector& x, std::size_t i,
                     std::size_t j) {
    if ((a[j] > x[j]) == (b[j] > x[j])) return false;
    return x[i] < a[i] + (x[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i]);
  }

  void offer(const RationalVector& x) {
    const BigRational square = product(x, x);
    if (!nearest_.empty() && square > least_) return;
    if (nearest_.empty() || square < least_) nearest_.clear(), least_ = square;
    if (std::find(nearest_.begin(), nearest_.end(), x) == nearest_.end()) nearest_.push_back(x);
  }

  const RationalVector& at(std::uint32_t v) {
    if (!at_[v]) {
      const RationalPoint3 x = sum_.exact(v);
      at_[v] = difference({exact::exact_value(x.x), exact::exact_value(x.y), exact::exact_value(x.z)}, from_);
    }
    return *at_[v];
  }

  const SpatialSum& sum_;
  const RationalVector& from_;
  std::vector<std::optional<RationalVector>> at_;  // where they were requested
  std::vector<RationalVector> nearest_;
  BigRational least_;
};

}  // namespace

std::vector<RationalVector> nearest_on_boundary(const SpatialSum& sum, const RationalVector& from) {
  BoundaryDistance distance(sum, from);
  const auto face = [&](const Loops& loops) {
    for_each_facet_edge(loops, [&](std::uint32_t a, std::uint32_t b) { distance.segment(a, b); });
    distance.foot(loops);
  };
  for (const SpatialFace& f : sum.faces) face(f.loops);
  for (const Loops& loops : sum.tight_faces) face(loops);
  for (const auto& [a, b] : sum.tight_segments) distance.segment(a, b);
  for (const std::uint32_t a : sum.tight_points) distance.point(a);
  return distance.take();
}

NearestOnBoundary nearest_by_doubles_first(const SpatialSum& sum, const RationalVector& from) {
  NearestOnBoundary result;
  const ProvedDistances proved(sum, from);
  BoundaryDistance distance(sum, from);
  const auto segment = [&](std::uint32_t a, std::uint32_t b) {
    if (proved.is_further(a, b)) return;
    ++result.segments;
    distance.segment(a, b);
  };
  const auto face = [&](const Loops& loops) {
    for_each_facet_edge(loops, segment);
    if (proved.is_foot_further(loops)) return;
    ++result.faces;
    distance.foot(loops);
  };
  for (const SpatialFace& f : sum.faces) face(f.loops);
  for (const Loops& loops : sum.tight_faces) face(loops);
  for (const auto& [a, b] : sum.tight_segments) segment(a, b);
  for (const std::uint32_t a : sum.tight_points) distance.point(a);
  result.all = distance.take();
  return result;
}

}  // namespace dymsum::depth

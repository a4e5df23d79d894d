#include "depth/boundary_distance.h"

#include <algorithm>
#include <cmath>

namespace dymsum::depth {

using exact::BigRational;

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

class BoundaryDistance {
 public:
  BoundaryDistance(const SpatialSum& sum, const RationalVector& from) {
    for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
      const RationalPoint3 x = sum.exact(v);
      at_.push_back(difference({exact::exact_value(x.x), exact::exact_value(x.y), exact::exact_value(x.z)}, from));
    }
  }

  std::vector<RationalVector> take() { return std::move(nearest_); }

  void segment(std::uint32_t a, std::uint32_t b) {
    const RationalVector d = difference(at_[b], at_[a]);
    const BigRational size = product(d, d), t = -product(at_[a], d) / size;
    if (t <= 0) return offer(at_[a]);
    if (t >= 1) return offer(at_[b]);
    offer({at_[a][0] + t * d[0], at_[a][1] + t * d[1], at_[a][2] + t * d[2]});
  }
  void point(std::uint32_t a) { offer(at_[a]); }

  /// The foot on its plane, where it lies inside an odd number of loops, and all borders.
  void face(const std::vector<std::vector<std::uint32_t>>& loops) {
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) segment(loop[k], loop[(k + 1) % loop.size()]);
    RationalVector n{};
    const std::vector<std::uint32_t>& outer = loops.front();
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const RationalVector c = normal_of(at_[outer[k]], at_[outer[(k + 1) % outer.size()]]);
      for (std::size_t i = 0; i < 3; ++i) n[i] += c[i];
    }
    const BigRational t = product(n, at_[outer[0]]) / product(n, n);
    const RationalVector foot{t * n[0], t * n[1], t * n[2]};
    std::size_t drop = 0;
    while (n[drop] == 0) ++drop;
    bool inside = false;
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        inside ^= passes(at_[loop[k]], at_[loop[(k + 1) % loop.size()]], foot, (drop + 1) % 3, (drop + 2) % 3);
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

  std::vector<RationalVector> at_;
  std::vector<RationalVector> nearest_;
  BigRational least_;
};

}  // namespace

std::vector<RationalVector> nearest_on_boundary(const SpatialSum& sum, const RationalVector& from) {
  BoundaryDistance distance(sum, from);
  for (const SpatialFace& face : sum.faces) distance.face(face.loops);
  for (const auto& loops : sum.tight_faces) distance.face(loops);
  for (const auto& [a, b] : sum.tight_segments) distance.segment(a, b);
  for (const std::uint32_t a : sum.tight_points) distance.point(a);
  return distance.take();
}

}  // namespace dymsum::depth

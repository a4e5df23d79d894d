#include "depth/ray_exit.h"

#include <algorithm>
#include <cmath>

#include "spatial/mesh/rounded_vector.h"

namespace dymsum::depth {

using spatial::Box;
using spatial::Vec3;

namespace {

/// Whether a ray from the origin may meet a box that is grown by `room`.
bool may_meet(const Box& box, Vec3 from, Vec3 way, double room) {
  double first = 0, last = 1e300;
  const auto cut = [&](double low, double high, double at, double v) {
    low -= at + room, high -= at - room;
    if (std::abs(v) < 0x1p-40) {  // over the few units that matter this does not count
      if (low > 0 || high < 0) last = -1;
      return;
    }
    const double a = low / v, b = high / v;
    first = std::max(first, std::min(a, b) * (1 - 0x1p-40)), last = std::min(last, std::max(a, b) * (1 + 0x1p-40));
  };
  cut(box.low.x, box.high.x, from.x, way.x);
  cut(box.low.y, box.high.y, from.y, way.y);
  cut(box.low.z, box.high.z, from.z, way.z);
  return first <= last;
}

class RayExit {
 public:
  RayExit(const FacetView& view, const ExactFrame& frame, const RationalVector& direction)
      : view_(view), frame_(frame) {
    exact::BigInteger all = 1;
    for (const BigRational& c : direction) all = lcm(all, denominator(c));
    const auto whole = [&](std::size_t k) {
      return Big(exact::BigInteger(numerator(direction[k]) * (all / denominator(direction[k]))));
    };
    way_ = {whole(0), whole(1), whole(2)};
    multiple_ = all;
  }

  /// Sorted, different, positive; multiples of the direction's multiple by `multiple()`.
  std::vector<BigRational> crossings() {
    const Vec3 way = spatial::unit(way_);
    for (std::uint32_t f = 0; f < view_.o.facets.size(); ++f) {
      if (!may_meet(view_.o.tree.box(f), view_.from, way, 4 * view_.slack)) continue;
      const spatial::SumFacet& facet = view_.o.facets[f];
      if (add(frame_.plane(facet))) continue;
      for (int k = 0; k < facet.corners; ++k) add(frame_.facet_edge(facet, k)), add_corner(facet, k);
    }
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

 private:
  /// False where the ray runs along the plane.
  bool add(const ExactPlane& plane) {
    const Big rise = exact::dot(plane.n, way_);
    if (sign(rise) == 0) return false;
    add_length(plane.d, rise);
    return true;
  }
  /// The foot of a corner on the ray's line: the corner itself where it lies on it.
  void add_corner(const spatial::SumFacet& facet, int k) {
    add_length(exact::dot(frame_.corner(facet.corner[static_cast<std::size_t>(k)]), way_), exact::dot(way_, way_));
  }
  /// Adds a length in units of the frame over way_: of the operands' units over the direction.
  void add_length(const Big& num, const Big& den) {
    BigRational s = exact::ratio(num, den);
    if (s <= 0) return;
    found_.push_back(frame_.in_operand_units(s) * multiple_);
  }

  const FacetView& view_;
  const ExactFrame& frame_;
  BigVector way_;
  exact::BigInteger multiple_;
  std::vector<BigRational> found_;
};

}  // namespace

BigRational exit_along(const FacetView& view, const ExactFrame& frame, DepthProbe& probe,
                       const RationalVector& direction, const RationalVector& from) {
  for (const BigRational& s : RayExit(view, frame, direction).crossings()) {
    const RationalVector x{from[0] + s * direction[0], from[1] + s * direction[1], from[2] + s * direction[2]};
    const Vec3 at = view.o.scaled(x);
    if (!probe.provably_overlaps(at, view.slack) && !probe.overlaps(x)) return s;
  }
  throw std::logic_error("exit_along: the sum is bounded, and no way leads out of it");
}

}  // namespace dymsum::depth

// What a region reports about itself.
#include "dymsum/region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/double_pair.h"
#include "planar/region/chains.h"

namespace dymsum {

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

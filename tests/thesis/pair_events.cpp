#include "thesis/pair_events.h"

#include <algorithm>
#include <cmath>

#include "planar/convolution/convolution.h"
#include "planar/motion/operand_pair.h"
#include "thesis/crossing_range.h"

namespace dymsum {

using namespace planar;

namespace {

struct Line {
  double xf, yf, xm, ym, dx, dy;  // start = fixed + s moving; unscaled vector
  double ex0, ey0, ex1, ey1;      // end
};

/// The segments at all scales, by pairs.
class SegmentPairs {
 public:
  explicit SegmentPairs(const OperandPair& base);
  std::size_t segments() const { return lines_.size(); }
  /// Adds the pairs of segment i with those after it.
  void count(std::size_t i, PairEventCount& count) const;

 private:
  void add(const WalkSegment& w);
  CrossingRange meet(const Line& a, const Line& b) const;
  struct ExactRange {
    bool any = false;
    std::optional<exact::BigRational> low, high;
  };
  ExactRange meet_exactly(const Segment& a, const Segment& b) const;

  const OperandPair& base_;
  ExactForms forms_;
  double span_fixed_, span_moving_;
  std::vector<Line> lines_;
  std::vector<Segment> segments_;
};

SegmentPairs::SegmentPairs(const OperandPair& base)
    : base_(base),
      forms_(base),
      span_fixed_(std::max(base.width[1 - base.moved], base.height[1 - base.moved])),
      span_moving_(std::max(base.width[base.moved], base.height[base.moved])) {
  const ReducedConvolution convolution(*base.lattice, base.operands[0], base.operands[1], never_filled);
  convolution.for_each([&](const WalkSegment& w) { add(w); });
}

void SegmentPairs::add(const WalkSegment& w) {
  const std::uint32_t k = base_.moved;
  const Operand &o = base_.operands[w.side], &other = base_.operands[1 - w.side];
  const PlacedPoints &fixed = *base_.lattice->points[1 - k], &moving = *base_.lattice->points[k];
  const std::uint32_t a = o.source[w.edge], b = o.source[o.next[w.edge]], v = other.source[w.vertex];
  const bool moves = w.side == k;
  const std::uint32_t ma = moves ? a : v, mb = moves ? b : v, fa = moves ? v : a, fb = moves ? v : b;
  lines_.push_back({fixed.x[fa], fixed.y[fa], moving.x[ma], moving.y[ma], o.ex[w.edge], o.ey[w.edge], fixed.x[fb],
                    fixed.y[fb], moving.x[mb], moving.y[mb]});
  segments_.push_back({o.edge(w.edge), v});
}

CrossingRange SegmentPairs::meet(const Line& a, const Line& b) const {
  CrossingRange in;
  const double u = a.dx * b.dy, v = a.dy * b.dx, d = u - v;
  if (std::abs(d) <= kEdgeCross * (std::abs(u) + std::abs(v)) + exact::kUnderflow) {
    in.unsure = true;
    return in;
  }
  const double s = d > 0 ? 1 : -1;
  const double eb = kSideCoefficient * (std::abs(b.dx) + std::abs(b.dy)),
               ea = kSideCoefficient * (std::abs(a.dx) + std::abs(a.dy));
  const auto side = [&](const Line& line, double xf, double yf, double xm, double ym, double sign, double e) {
    in.meet(sign * (line.dx * (yf - line.yf) - line.dy * (xf - line.xf)),
            sign * (line.dx * (ym - line.ym) - line.dy * (xm - line.xm)), e * span_fixed_, e * span_moving_);
  };
  side(b, a.xf, a.yf, a.xm, a.ym, s, eb);
  if (!in.empty) side(b, a.ex0, a.ey0, a.ex1, a.ey1, -s, eb);
  if (!in.empty) side(a, b.xf, b.yf, b.xm, b.ym, -s, ea);
  if (!in.empty) side(a, b.ex0, b.ey0, b.ex1, b.ey1, s, ea);
  if (!in.unsure) in.settle();
  return in;
}

SegmentPairs::ExactRange SegmentPairs::meet_exactly(const Segment& a, const Segment& b) const {
  ExactRange range;
  const int sign = base_.lattice->cross(a.edge, b.edge);
  if (sign == 0) return range;
  const auto meet = [&](ExactForm f, int s) {
    if (s < 0) f = {-f.a, -f.b};
    if (f.a.sign() <= 0 && f.b.sign() <= 0) return false;
    if (const auto root = f.root()) {
      std::optional<exact::BigRational>& end = f.b.sign() > 0 ? range.low : range.high;
      if (!end || (f.b.sign() > 0 ? *root > *end : *root < *end)) end = root;
    }
    return !range.low || !range.high || *range.low < *range.high;
  };
  range.any = meet(forms_.side(b, start_of(a)), sign) && meet(forms_.side(b, end_of(a)), -sign) &&
              meet(forms_.side(a, start_of(b)), -sign) && meet(forms_.side(a, end_of(b)), sign);
  return range;
}

void SegmentPairs::count(std::size_t i, PairEventCount& count) const {
  const Line& a = lines_[i];
  for (std::size_t j = i + 1; j < lines_.size(); ++j) {
    const CrossingRange in = meet(a, lines_[j]);
    if (in.empty) continue;
    if (!in.unsure) {
      ++count.pairs_that_meet;
      count.events += (in.low > 0) + (in.high < INFINITY);
      continue;
    }
    ++count.exact_pairs;
    if (const ExactRange exact = meet_exactly(segments_[i], segments_[j]); exact.any) {
      ++count.pairs_that_meet;
      count.events += static_cast<std::uint64_t>(exact.low.has_value()) + exact.high.has_value();
    }
  }
}

}  // namespace

Result<PairEventCount> count_pair_events(const Region& p, const Region& q, MovingOperand scaled,
                                         const Progress& progress) {
  const auto base = pair_of_regions(p, q, PairOptions{.moved = scaled == MovingOperand::p ? 0U : 1U});
  if (!base) return base.error();
  const SegmentPairs pairs(**base);
  const auto n = static_cast<double>(pairs.segments());
  PairEventCount count;
  count.segments = pairs.segments();
  for (std::size_t i = 0; i < pairs.segments(); ++i) {
    const auto done = static_cast<double>(i);
    if (progress && i % 64 == 0 && !progress("pairs", done * (2 * n - done) / n / n))
      return Error{ErrorCode::cancelled, "stopped on request", {}};
    pairs.count(i, count);
  }
  return count;
}

}  // namespace dymsum

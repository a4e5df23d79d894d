// The thesis's pair events over all positive scales, counted by streaming through the pairs.
#include <algorithm>
#include <cmath>

#include "dymsum/scaling_sum.h"
#include "planar/convolution/convolution.h"
#include "planar/scaling/crossing_range.h"
#include "planar/scaling/exact_forms.h"
#include "planar/scaling/fill_lattice.h"

namespace dymsum {

using namespace planar;

namespace {

struct Line {
  double xf, yf, xm, ym, dx, dy;  // start = fixed + s moving; unscaled vector
  double ex0, ey0, ex1, ey1;      // end
};

}  // namespace

Result<PairEventCount> count_pair_events(const Region& p, const Region& q, MovingOperand scaled,
                                         const Progress& progress) {
  Result<std::shared_ptr<const OperandPair>> made = OperandPair::create(p, q, scaled == MovingOperand::p ? 0 : 1, 0);
  if (!made) return made.error();
  const OperandPair& base = **made;
  const Lattice& l = *base.lattice;
  const UnfilledLattice never(l);
  const ReducedConvolution convolution(never, base.operands[0], base.operands[1]);
  const ExactForms forms(base);
  const std::uint32_t k = base.scaled;
  std::vector<Line> lines;
  std::vector<Segment> segments;
  convolution.for_each([&](const WalkSegment& w) {
    const Operand &o = base.operands[w.side], &other = base.operands[1 - w.side];
    const std::uint32_t a = o.source[w.edge], b = o.source[o.next[w.edge]], v = other.source[w.vertex];
    const bool moving = w.side == k;
    const std::uint32_t ma = moving ? a : v, mb = moving ? b : v, fa = moving ? v : a, fb = moving ? v : b;
    lines.push_back({l.points[1 - k]->x[fa], l.points[1 - k]->y[fa], l.points[k]->x[ma], l.points[k]->y[ma],
                     o.ex[w.edge], o.ey[w.edge], l.points[1 - k]->x[fb], l.points[1 - k]->y[fb], l.points[k]->x[mb],
                     l.points[k]->y[mb]});
    segments.push_back({o.edge(w.edge), v});
  });
  PairEventCount count;
  count.segments = lines.size();
  const double span_f = std::max(base.width[1 - k], base.height[1 - k]),
               span_m = std::max(base.width[k], base.height[k]);
  const auto exactly = [&](std::size_t i, std::size_t j) {
    const Segment &a = segments[i], &b = segments[j];
    const int sign = l.cross(a.edge, b.edge);
    std::optional<exact::BigRational> low, high;
    if (sign == 0) return std::pair{false, 0};
    const auto meet = [&](ExactForm f, int s) {
      if (s < 0) f = {-f.a, -f.b};
      if (f.a.sign() <= 0 && f.b.sign() <= 0) return false;
      if (const auto root = f.root()) {
        std::optional<exact::BigRational>& end = f.b.sign() > 0 ? low : high;
        if (!end || (f.b.sign() > 0 ? *root > *end : *root < *end)) end = root;
      }
      return !low || !high || *low < *high;
    };
    const bool any = meet(forms.side(b, start_of(a)), sign) && meet(forms.side(b, end_of(a)), -sign) &&
                     meet(forms.side(a, start_of(b)), -sign) && meet(forms.side(a, end_of(b)), sign);
    return std::pair{any, int(low.has_value()) + int(high.has_value())};
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (progress && i % 64 == 0 &&
        !progress("pairs",
                  double(i) * (2.0 * double(lines.size()) - double(i)) / double(lines.size()) / double(lines.size())))
      return Error{ErrorCode::cancelled, "stopped on request", {}};
    const Line& a = lines[i];
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const Line& b = lines[j];
      const double u = a.dx * b.dy, v = a.dy * b.dx, d = u - v;
      CrossingRange in;
      if (std::abs(d) <= kEdgeCross * (std::abs(u) + std::abs(v)) + exact::kUnderflow) {
        in.unsure = true;
      } else {
        const double s = d > 0 ? 1 : -1;
        const double eb = kSideCoefficient * (std::abs(b.dx) + std::abs(b.dy)),
                     ea = kSideCoefficient * (std::abs(a.dx) + std::abs(a.dy));
        const auto side = [&](const Line& line, double xf, double yf, double xm, double ym, double sign, double e) {
          in.meet(sign * (line.dx * (yf - line.yf) - line.dy * (xf - line.xf)),
                  sign * (line.dx * (ym - line.ym) - line.dy * (xm - line.xm)), e * span_f, e * span_m);
        };
        side(b, a.xf, a.yf, a.xm, a.ym, s, eb);
        if (!in.empty) side(b, a.ex0, a.ey0, a.ex1, a.ey1, -s, eb);
        if (!in.empty) side(a, b.xf, b.yf, b.xm, b.ym, -s, ea);
        if (!in.empty) side(a, b.ex0, b.ey0, b.ex1, b.ey1, s, ea);
        if (!in.unsure) in.settle();
      }
      if (in.empty) continue;
      if (in.unsure) {
        ++count.exact_pairs;
        const auto [any, ends] = exactly(i, j);
        if (any) {
          ++count.pairs_that_meet;
          count.events += static_cast<std::uint64_t>(ends);
        }
        continue;
      }
      ++count.pairs_that_meet;
      count.events += (in.low > 0) + (in.high < INFINITY);
    }
  }
  return count;
}

}  // namespace dymsum

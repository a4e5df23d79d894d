#include "planar/frame/turned_rings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planar/operand/contact_of.h"
#include "planar/position/nearest_point.h"

namespace dymsum::planar {
namespace {

/// Crossings that are known worse than this, times the span, are rounded from their exact positions. Any value is
/// right.
constexpr double kPoor = 0x1p-36;

}  // namespace

void TurnedRings::enter(const RotatingWindow& window) {
  window_ = &window;
  names_.assign(window.segments.size(), {{Contact::Kind::edge_of_p, kNone, kNone}, kNone, kNone});
}

const TurnedRings::Names& TurnedRings::names(std::uint32_t segment) {
  Names& names = names_[segment];
  if (names.contact.p != kNone) return names;
  const TurnSegment& s = window_->segments[segment];
  const Operand &fixed = forms_.operand(0), &moving = forms_.operand(1);
  names.contact = swapped_ ? contact_of({1 - s.side, s.edge, s.vertex}, moving, fixed) : contact_of(s, fixed, moving);
  names.corner_p = fixed.vertex_number[s.end.p];
  names.corner_q = moving.vertex_number[s.end.q];
  if (swapped_) std::swap(names.corner_p, names.corner_q);
  return names;
}

TurnedRings::Rigid TurnedRings::to_sum(const Orientation& theta) const {
  const Lattice& l = *base_.lattice;
  const Heading world = Heading::of(theta.radians());
  const auto turn = [&](Point p) { return Point{world.c * p.x - world.s * p.y, world.s * p.x + world.c * p.y}; };
  const Point fixed = l.points[0]->offset, moving{l.points[1]->offset.x + l.unit * forms_.centre().x,
                                                  l.points[1]->offset.y + l.unit * forms_.centre().y};
  const Point turned = turn(moving_turns_ ? moving : fixed), still = moving_turns_ ? fixed : moving;
  const Heading by = moving_turns_ ? Heading{} : world;
  return {by.c, by.s, l.unit, {turned.x + still.x, turned.y + still.y}};
}

// Turning back mixes both coordinates. Below the range of ordinary doubles the bound rounds to nothing, and so may at
// most seven products by half a unit each: of the unit, and of the offset that turns.
double TurnedRings::input_error(double error) const {
  const Lattice& l = *base_.lattice;
  double offsets = std::abs(forms_.centre().x) * l.unit + std::abs(forms_.centre().y) * l.unit;
  for (const auto& points : l.points) offsets += std::abs(points->offset.x) + std::abs(points->offset.y);
  return (kMixed * error + kTurnedBack * forms_.span()) * l.unit + kTurnedOffset * offsets + exact::kSubnormal;
}

KeptRings TurnedRings::at(const Orientation& theta, const RotatingFrame& frame, RotatingLoops& loops,
                          const ExactSource& source, const std::function<SumRing()>& spare) {
  const Rigid rigid = to_sum(theta);
  const double poor = kPoor * forms_.span();
  const VertexOrder order(source, input_error(poor));
  std::optional<NearestPoint> nearest;  // made when first asked for
  const RotatingFrame::Step* const steps = frame.steps().data();
  KeptRings kept;
  double error = 0;
  for (RotatingLoops::Loop& loop : loops.loops()) {
    if (!loop.kept) continue;
    // Returns the bound on what it puts.
    const auto put = [&](std::uint32_t k, SumVertex& to) {
      const RotatingFrame::Step& s = steps[k];
      const Names& in = names(s.segment);
      const bool end = s.to_crossing == RotatingFrame::kEnd;
      to.in = in.contact;
      to.out = names(steps[k + 1 == loop.last ? loop.first : k + 1].segment).contact;
      to.corner_p = end ? in.corner_p : SumVertex::kNone;
      to.corner_q = end ? in.corner_q : SumVertex::kNone;
      const RotatingFrame::Located z = frame.end_of(s);
      if (z.error <= poor) {
        to.at = rigid(z.at.x, z.at.y);
        return z.error;
      }
      if (!nearest) nearest.emplace(source);
      to.at = (*nearest)(to);
      return frame.point_error();
    };
    corners_.clear();
    for (std::uint32_t k = loop.first; k < loop.last; ++k)
      if (!steps[k].straight) corners_.push_back(k);
    SumRing ring = spare();
    error = std::max(error, write_ring(corners_, 0, order, put, ring).error);
    kept.rings.push_back(std::move(ring));
    kept.outer.push_back(loop.turning > 0);
    kept.loops.push_back(&loop);
  }
  kept.at_error = input_error(error);
  return kept;
}

}  // namespace dymsum::planar

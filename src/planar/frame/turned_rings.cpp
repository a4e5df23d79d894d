#include "planar/frame/turned_rings.h"

#include <algorithm>
#include <cmath>

#include "planar/operand/contact_of.h"

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

// Of a crossing.
Point TurnedRings::exactly_rounded(const RotatingFrame::Step& s, const RotatingFrame::Step& next) {
  if (!nearest_) nearest_.emplace(*source_);
  SumVertex v;
  v.in = names(s.segment).contact;
  v.out = names(next.segment).contact;
  return (*nearest_)(v);
}

// The steps of a kept loop that end at vertices and their positions, from the leftmost on: doubles mostly know where a
// ring begins. Returns the largest error, in the frame.
double TurnedRings::find_positions(const RotatingLoops::Loop& loop, const RotatingFrame& frame, const Rigid& to_sum) {
  const Rigid rigid = to_sum;  // by value: what is written below cannot be it
  const RotatingFrame::Step* steps = frame.steps().data();
  steps_.resize(loop.vertices);
  positions_.resize(loop.vertices);
  std::size_t n = 0, first = 0;
  const double poor = kPoor * forms_.span();
  double leftmost = INFINITY, worst = frame.point_error();
  for (std::uint32_t k = loop.first; k < loop.last; ++k) {
    const RotatingFrame::Step& s = steps[k];
    if (s.straight) continue;
    if (s.to_crossing == RotatingFrame::kEnd) {
      const Point at = frame.place(window_->segments[s.segment].end);
      positions_[n] = rigid(at.x, at.y);
    } else if (const RotatingFrame::Located z = frame.end_of(s); z.error <= poor) {
      worst = std::max(worst, z.error);
      positions_[n] = rigid(z.at.x, z.at.y);
    } else {
      positions_[n] = exactly_rounded(s, steps[k + 1 == loop.last ? loop.first : k + 1]);
    }
    const double u = positions_[n].x;
    first = u < leftmost ? n : first;
    leftmost = std::min(u, leftmost);
    steps_[n++] = k;
  }
  std::rotate(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(first), steps_.end());
  std::rotate(positions_.begin(), positions_.begin() + static_cast<std::ptrdiff_t>(first), positions_.end());
  return worst;
}

SumRing TurnedRings::ring(const RotatingLoops::Loop& loop, const RotatingFrame& frame) {
  SumRing ring;
  ring.vertices.resize(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const std::uint32_t k = steps_[i];
    const RotatingFrame::Step &s = frame.steps()[k], &next = frame.steps()[k + 1 == loop.last ? loop.first : k + 1];
    const Names& in = names(s.segment);
    SumVertex& v = ring.vertices[i];
    v.at = positions_[i];
    v.in = in.contact;
    v.out = names(next.segment).contact;
    if (s.to_crossing != RotatingFrame::kEnd) continue;
    v.corner_p = in.corner_p;
    v.corner_q = in.corner_q;
  }
  return ring;
}

TurnedRings::Rings TurnedRings::at(const Orientation& theta, const RotatingFrame& frame, RotatingLoops& loops,
                                   const ExactSource& source) {
  source_ = &source;
  nearest_.reset();
  Rings kept;
  const Rigid rigid = to_sum(theta);
  double error = 0;
  for (RotatingLoops::Loop& loop : loops.loops()) {
    if (!loop.kept) continue;
    error = std::max(error, find_positions(loop, frame, rigid));
    kept.rings.push_back(ring(loop, frame));
    kept.outer.push_back(loop.turning > 0);
    kept.loops.push_back(&loop);
  }
  kept.at_error = input_error(error);
  return kept;
}

}  // namespace dymsum::planar

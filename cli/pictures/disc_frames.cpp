#include "pictures/disc_frames.h"

#include <cmath>
#include <numbers>

#include "inputs.h"
#include "progress_bar.h"

namespace dymsum::cli {
namespace {

/// What the eye cannot tell from an arc, y downwards.
Chain chain_of(const DiscRing& ring, double r, Box& box) {
  constexpr double kStep = std::numbers::pi / 24;
  Chain chain;
  chain.closed = true;
  const auto add = [&](Point p) {
    p.y = -p.y + 0.0;
    chain.points.push_back(p);
    box.see(p);
  };
  for (const DiscPiece& piece : ring.pieces) {
    if (piece.from.kind != DiscCorner::Kind::none) add(piece.from.at);
    if (piece.of == DiscPiece::Of::edge) continue;
    const int steps = static_cast<int>(std::ceil(std::abs(piece.sweep) / kStep));
    for (int i = piece.from.kind == DiscCorner::Kind::none ? 0 : 1; i < steps; ++i) {
      const double angle = piece.from_angle + piece.sweep * i / steps;
      add({piece.centre.x + r * std::cos(angle), piece.centre.y + r * std::sin(angle)});
    }
  }
  return chain;
}

Drawn drawn(const DiscSet& set) {
  Drawn made;
  for (const DiscPart& part : set.parts) {
    made.chains.push_back(chain_of(part.outer, set.radius, made.box));
    for (const DiscRing& hole : part.holes) made.chains.push_back(chain_of(hole, set.radius, made.box));
  }
  const auto turned = [&](Point p) {
    p.y = -p.y + 0.0;
    made.box.see(p);
    return p;
  };
  for (const DiscSegment& s : set.segments) made.chains.push_back({{turned(s.from.at), turned(s.to.at)}, false});
  for (const DiscSegment& s : set.tight_segments) made.tight.push_back({{turned(s.from.at), turned(s.to.at)}, false});
  for (const DiscCorner& p : set.points) made.dots.push_back(turned(p.at));
  for (const DiscCorner& p : set.tight_points) made.dots.push_back(turned(p.at));
  return made;
}

}  // namespace

void append_frames(DiscFrames& frames, const DiscMaker& make, double last, std::size_t count,
                   const Progress& progress) {
  const Rational end = require(Rational::of(last));
  for (std::size_t i = 0; i < count; ++i) {
    throw_if_interrupted();
    progress("frames", static_cast<double>(i) / static_cast<double>(count));
    const Rational r = end * Rational(static_cast<std::int64_t>(i)) / Rational(static_cast<std::int64_t>(count - 1));
    const double alpha = 2 * r.to_double();
    frames.frames.push_back({alpha, "\u03b1 = " + number(alpha), drawn(require(make(r)))});
  }
}

std::string disc_page(const DiscFrames& frames) {
  std::vector<PicturedTick> ticks;
  const double last = frames.frames.empty() ? 0 : frames.frames.back().at;
  for (const DiscEvent& e : frames.events)
    if (2 * e.radius <= last) ticks.push_back({2 * e.radius, "\u03b1 = " + number(2 * e.radius), e.nodes > 1});
  return scrub_page(frames.frames, ticks, frames.title);
}

}  // namespace dymsum::cli

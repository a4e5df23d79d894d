#include "pictures/disc_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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
  std::vector<std::pair<double, DiscRadius>> radii;
  for (std::size_t i = 0; i < count; ++i) {
    const Rational r = end * Rational(static_cast<std::int64_t>(i)) / Rational(static_cast<std::int64_t>(count - 1));
    radii.emplace_back(r.to_double(), r);
  }
  const auto within = [&](const DiscEvent& e) { return e.radius <= last; };
  const auto events = static_cast<std::size_t>(std::count_if(frames.events.begin(), frames.events.end(), within));
  if (events + count <= kMostPictures)
    for (std::uint32_t i = 0; i < events; ++i) {
      std::erase_if(radii, [&](const auto& r) { return r.first == frames.events[i].radius; });
      radii.emplace_back(frames.events[i].radius, DiscRadius::at_event(i));
    }
  std::sort(radii.begin(), radii.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < radii.size(); ++i) {
    throw_if_interrupted();
    progress("frames", static_cast<double>(i) / static_cast<double>(radii.size()));
    const auto& [near, r] = radii[i];
    const std::string event = r.event ? ", event:" + std::to_string(*r.event) : "";
    frames.frames.push_back({near, "radius " + number(near) + event, drawn(require(make(r)))});
  }
}

std::string disc_page(const DiscFrames& frames) {
  std::vector<PicturedTick> ticks;
  const double last = frames.frames.empty() ? 0 : frames.frames.back().at;
  for (const DiscEvent& e : frames.events)
    if (e.radius <= last) ticks.push_back({e.radius, "radius " + number(e.radius), e.nodes > 1});
  return scrub_page(frames.frames, ticks, frames.title,
                    {"the " + frames.set, "several at once", drawn(frames.region), "the region"});
}

}  // namespace dymsum::cli

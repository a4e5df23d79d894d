#include "planar/frame/loop_rings.h"

#include <algorithm>
#include <cmath>

#include "planar/operand/sum_bounds.h"
#include "planar/position/vertex_order.h"

namespace dymsum::planar {
namespace {

// From the window's coordinates to those of the input.
struct ToInput {
  ToInput(const Window& window, const ExactFrame& frame) : span(window.span()) {
    const Lattice& l = *frame.base().lattice;
    grow = frame.blow_up(window.frame().moving);
    unit = l.unit;
    const double s = frame.value().approx;
    const PlacedPoints& moved = *l.points[frame.base().moved];
    const Point scaled{moved.offset.x * moved.stretch.x, moved.offset.y * moved.stretch.y};
    const Point& other = l.points[1 - frame.base().moved]->offset;
    origin = Two{scaled.x * s + other.x, scaled.y * s + other.y};
    reach = (std::abs(scaled.x) + std::abs(scaled.y)) * s + std::abs(other.x) + std::abs(other.y);
  }
  Two operator()(const Two& at) const { return both(grow) * at * both(unit) + origin; }
  double error(double of_point) const {
    return grow * (of_point + kKeptPosition * span) * unit * exact::kOutwards + kKeptOffsets * reach +
           exact::kSubnormal;
  }
  double span, grow = 1, unit = 1, reach = 0;
  Two origin{};
};

struct Written {
  std::uint32_t leader = kNone;  ///< the smallest vertex
  double error = 0;              ///< the largest of a position
};

// A loop's vertices as a ring from the smallest one on, which `start` often is.
template <class Put>
Written write(const std::vector<std::uint32_t>& vertices, std::size_t start, const VertexOrder& order, const Put& put,
              SumRing& ring) {
  const std::size_t n = vertices.size();
  ring.vertices.resize(n);
  SumVertex* const first = ring.vertices.data();
  SumVertex *to = first, *least = first;
  Written written;
  const auto put_all = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i, ++to) {
      written.error = std::max(written.error, put(vertices[i], *to));
      if (written.leader != kNone && (order.certainly_right(*to, *least) || order.compare(*to, *least) >= 0)) continue;
      least = to;
      written.leader = vertices[i];
    }
  };
  put_all(start, n);
  put_all(0, start);
  std::rotate(first, least, to);
  return written;
}

}  // namespace

// Where a ring of the last frame started, or 0.
std::size_t LoopRings::likely_start(const FrameLoop& loop) const {
  const auto led =
      std::find_if(loop.vertices.begin(), loop.vertices.end(), [&](std::uint32_t v) { return leads_[v] != 0; });
  return led == loop.vertices.end() ? 0 : static_cast<std::size_t>(led - loop.vertices.begin());
}

void LoopRings::lead(std::vector<std::uint32_t> leaders) {
  for (const std::uint32_t v : leaders_) leads_[v] = 0;
  for (const std::uint32_t v : leaders) leads_[v] = 1;
  leaders_ = std::move(leaders);
}

LoopRings::Rings LoopRings::at(double tau, const Window& window, const ExactFrame& frame, const ExactSource& source,
                               const std::function<SumRing()>& spare) {
  const ToInput to_input(window, frame);
  const double poor = kPoorPosition * window.span();
  const VertexOrder order(source, to_input.error(poor));
  const SumVertex* const vertices = loops_.vertices().data();
  const MovingPoint* const points = loops_.points().data();
  // Returns the bound on what it puts. By value: what it writes cannot be any of these.
  const auto put = [=, &source](std::uint32_t vertex, SumVertex& to) {
    to = vertices[vertex];
    const MovingPoint& v = points[vertex];
    if (v.error <= poor) {
      const Two at = to_input(v.at(tau));
      to.at = {at[0], at[1]};
      return v.error;
    }
    const ExactSource::Position p = source.position(to);
    to.at = {exact::round_to_double(p.x), exact::round_to_double(p.y)};
    return poor;
  };
  double error = 0;
  std::vector<std::uint32_t> leaders;
  leads_.resize(loops_.vertices().size(), 0);
  Rings kept;
  for (FrameLoop& loop : loops_.loops()) {
    if (!loop.kept) continue;
    if (loop.vertices.empty())
      for (const LoopStep& step : loop.steps)
        if (step.vertex != kNone) loop.vertices.push_back(step.vertex);
    SumRing ring = spare();
    const Written written = write(loop.vertices, likely_start(loop), order, put, ring);
    leaders.push_back(written.leader);
    error = std::max(error, written.error);
    kept.rings.push_back(std::move(ring));
    kept.outer.push_back(loop.turning > 0);
    kept.loops.push_back(&loop);
  }
  lead(std::move(leaders));
  kept.at_error = to_input.error(error);
  return kept;
}

}  // namespace dymsum::planar

#include "dymsum/sum_locator.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "planar/position/exact_source.h"
#include "planar/position/feature_tree.h"
#include "planar/position/ring_slabs.h"
#include "planar/sum/answer_blocks.h"

namespace dymsum {

using planar::NearSpot;

struct SumLocator::State {
  std::deque<planar::Position> positions;  // those that no doubles hold
  planar::RingSlabs rings;
  planar::FeatureTree features;  // in the closed set, beside its parts; outside the open one, inside its parts
  bool open;

  State(const PlanarSum& sum, Semantics semantics);
  NearSpot spot(const PlanarSum& sum, const SumVertex& v);
  bool contains(const NearSpot& z) const;
};

NearSpot SumLocator::State::spot(const PlanarSum& sum, const SumVertex& v) {
  if (sum.at_error == 0) return planar::near_spot(v.at);
  const std::shared_ptr<const ExactSource>& source = exact_source(sum);
  if (source == nullptr) throw std::logic_error("SumLocator: vertices without exact positions");
  return planar::near_spot(source->position(v), positions);
}

SumLocator::State::State(const PlanarSum& sum, Semantics semantics) : open(semantics == Semantics::open) {
  std::vector<std::vector<NearSpot>> all;
  const auto add_ring = [&](const SumRing& ring) {
    std::vector<NearSpot>& spots = all.emplace_back();
    for (const SumVertex& v : ring.vertices) spots.push_back(spot(sum, v));
  };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    for (const SumRing& hole : part.holes) add_ring(hole);
  }
  rings = planar::RingSlabs(all);
  if (semantics == Semantics::regular) return;
  std::vector<planar::Feature> thin;
  for (const SumSegment& s : open ? sum.tight_segments : sum.segments)
    thin.push_back({spot(sum, s.from), spot(sum, s.to)});
  for (const SumVertex& v : open ? sum.tight_points : sum.points) thin.push_back({spot(sum, v), spot(sum, v)});
  features = planar::FeatureTree(std::move(thin));
}

bool SumLocator::State::contains(const NearSpot& z) const {
  const planar::Location at = rings.locate(z);
  if (open) return at == planar::Location::inside && !features.holds(z);
  return at != planar::Location::outside || features.holds(z);
}

SumLocator::SumLocator(const PlanarSum& sum, Semantics semantics)
    : state_(std::make_shared<const State>(sum, semantics)) {}

bool SumLocator::contains(Point z) const {
  return std::isfinite(z.x) && std::isfinite(z.y) && state_->contains(planar::near_spot(z));
}

bool SumLocator::contains_rational(const RationalPoint& z) const {
  if (!std::isfinite(z.x.to_double()) || !std::isfinite(z.y.to_double())) return false;  // sums reach to 2^1001
  std::deque<planar::Position> kept;
  return state_->contains(planar::near_spot({exact::exact_value(z.x), exact::exact_value(z.y)}, kept));
}

Result<std::vector<std::uint8_t>> SumLocator::contains_each(std::span<const Point> points, int threads,
                                                            const Progress& progress) const {
  return planar::answer_blocks(points.size(), 1 << 16, 2048, threads, progress,
                               [&](std::size_t k) { return contains(points[k]); });
}

Result<std::vector<std::uint8_t>> SumLocator::contains_each(std::span<const RationalPoint> points, int threads,
                                                            const Progress& progress) const {
  return planar::answer_blocks(points.size(), 1 << 12, 16, threads, progress,
                               [&](std::size_t k) { return contains_rational(points[k]); });
}

}  // namespace dymsum

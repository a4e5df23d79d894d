// The public class: one position after the other.
#include "dymsum/local_sum.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/double_text.h"
#include "base/poll.h"
#include "spatial/convolution/facet_rule.h"
#include "spatial/local/ball_faces.h"
#include "spatial/local/local_boundary.h"
#include "spatial/local/near_facets.h"
#include "spatial/moving/dynamic_convolution.h"
#include "spatial/moving/inner_facets.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {

using spatial::ClipWalls;
using spatial::PosedSpace;
using spatial::PosePair;
using spatial::ReducedConvolution;

namespace {

double exact_end(double centre, double radius, double towards) {
  const exact::BigRational end = exact::exact_value(centre) + exact::exact_value(radius);
  const double rounded = centre + radius;
  if (!std::isfinite(rounded)) return std::copysign(std::numeric_limits<double>::max(), towards);
  const bool inside = towards > 0 ? exact::exact_value(rounded) < end : exact::exact_value(rounded) > end;
  return inside ? std::nextafter(rounded, towards) : rounded;
}

spatial::Centre centre_of(const ClipBox& box, const ClipBall* ball) {
  const auto centre = [](double low, double high) {
    return exact::BigRational((exact::exact_value(low) + exact::exact_value(high)) / 2);
  };
  const Point3 &a = ball != nullptr ? ball->centre : box.low, &b = ball != nullptr ? ball->centre : box.high;
  return {{centre(a.x, b.x), centre(a.y, b.y), centre(a.z, b.z)}, ball != nullptr};
}

bool is_finite_position(const Point3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::optional<Error> box_error(const ClipBox& box) {
  if (!is_finite_position(box.low) || !is_finite_position(box.high))
    return Error{ErrorCode::not_finite, "a corner of the box is not finite", {}};
  if (!(box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z))
    return Error{ErrorCode::out_of_range, "the box has no extent along an axis", {}};
  return std::nullopt;
}

}  // namespace

ClipBox bounding_box(const ClipBall& ball) {
  constexpr double kUp = std::numeric_limits<double>::infinity();
  const Point3& m = ball.centre;
  const double r = ball.radius;
  return {{exact_end(m.x, -r, -kUp), exact_end(m.y, -r, -kUp), exact_end(m.z, -r, -kUp)},
          {exact_end(m.x, r, kUp), exact_end(m.y, r, kUp), exact_end(m.z, r, kUp)}};
}

class LocalSum::State {
 public:
  State(const Mesh& p, const Mesh& q, const LocalOptions& given) : options_(given), pair_(spatial::solid_pair(p, q)) {
    stages_.tight = options_.tight, stages_.threads = options_.threads, stages_.progress = options_.progress;
    if (options_.engine == LocalEngine::brute) stages_.engine = SpatialEngine::brute;
    if (is_empty()) return;
    if (options_.engine != LocalEngine::brute) inner_.emplace(pair_);
    if (options_.engine == LocalEngine::updated) convolution_.emplace(pair_);
    if (options_.engine == LocalEngine::hierarchy) near_.emplace(pair_);
  }

  Result<LocalPart> in(const ClipBox& box, const ClipBall* ball, const PosePair& poses) {
    const Stopwatch watch;
    if (std::optional<Error> error = box_error(box)) return *std::move(error);
    Result<LocalPart> part = spatial::guarded([&] { return part_of(box, ball, poses); });
    if (!part) return part.error();
    LocalPart result = *std::move(part);
    result.work.ms = watch.ms();
    return result;
  }

  std::size_t facet_count() const { return convolution_ && moved_ ? convolution_->slots().facets() : all_facets_; }

 private:
  bool is_empty() const { return pair_.p.vertices.empty() || pair_.q.vertices.empty(); }

  LocalPart part_of(const ClipBox& box, const ClipBall* ball, const PosePair& poses) {
    LocalPart part;
    part.box = box;
    SpatialStats& stats = part.boundary.stats;
    spatial::StageWatch watch(stages_, stats);
    watch.begin("convolution");
    if (is_empty()) return part;
    ClipWalls walls(box, spatial::sum_bounds(pair_, poses), options_.engine != LocalEngine::brute);
    if (walls.misses()) return part;
    PosedSpace space = spatial::posed_space(pair_, poses, walls.levels());
    const exact::BigInteger scale = space.scale;
    ReducedConvolution near = facets(space, walls, poses, watch, part.work);
    part.work.facets = near.facets.size();
    stats.face_vertex = near.counts.face_vertex, stats.edge_edge = near.counts.edge_edge;
    spatial::LocalBoundary local =
        spatial::local_boundary(space, std::move(near), pair_, walls, centre_of(box, ball), stages_, stats, watch);
    watch.begin("faces");
    spatial::assemble(local.boundary, pair_.p, pair_.q, part.boundary, watch);
    watch.begin("");
    spatial::unscale(part.boundary, scale);
    if (ball != nullptr) spatial::keep_in_ball(*ball, part.boundary);
    part.work.contacts = stats.contacts, part.work.collision_tests = stats.collision_tests;
    part.work.tight_tests = stats.tight_tests, part.work.exact_signs = stats.exact_signs;
    part.where = !part.boundary.vertices.empty() ? LocalPart::Where::crossed
                 : local.centre_inside           ? LocalPart::Where::inside
                                                 : LocalPart::Where::outside;
    return part;
  }

  /// Those near the larger box of the walls; of the reference all.
  ReducedConvolution facets(const PosedSpace& space, const ClipWalls& walls, const PosePair& poses,
                            spatial::StageWatch& watch, LocalPart::Work& work) {
    const spatial::Box reach = walls.reach(*space.space, static_cast<std::uint32_t>(pair_.p.vertices.size()));
    if (inner_) inner_->move(space, poses);
    if (near_) {
      ReducedConvolution found = near_->find(*space.space, reach);
      work.rebuilt = true, work.pairs = near_->pairs();
      return outer_facets(found);
    }
    if (convolution_) return updated_facets(*space.space, reach, poses, work);
    ReducedConvolution all = spatial::reduced_convolution(*space.space, pair_.p, pair_.q, watch);
    work.rebuilt = true, all_facets_ = all.facets.size();
    return all;
  }

  /// Those that are not known to lie deep inside the open sum.
  ReducedConvolution outer_facets(const ReducedConvolution& all) {
    ReducedConvolution outer;
    outer.counts = all.counts;
    for (std::uint32_t f = 0; f < all.facets.size(); ++f) {
      inner_->forget(f);
      if (inner_->hold(f, all.facets[f])) continue;
      outer.facets.push_back(all.facets[f]), outer.planes.push_back(all.planes[f]);
    }
    return outer;
  }

  ReducedConvolution updated_facets(const spatial::SumSpace& space, const spatial::Box& reach, const PosePair& poses,
                                    LocalPart::Work& work) {
    if (!moved_ || !(poses_ == poses)) {
      spatial::SpaceOnDemand exact(pair_, poses);
      work.rebuilt = convolution_->set(poses, exact).rebuilt;
      poses_ = poses, moved_ = true;
      for (const std::uint32_t slot : convolution_->slots().added()) inner_->forget(slot);
    }
    ReducedConvolution near;
    const spatial::FacetSlots& slots = convolution_->slots();
    for (std::uint32_t slot = 0; slot < slots.count(); ++slot) {
      if (!slots.exists(slot)) continue;
      const spatial::SumFacet& facet = slots[slot];
      ++(facet.kind == spatial::SumFacet::Kind::edge_edge ? near.counts.edge_edge : near.counts.face_vertex);
      if (!spatial::comes_near(space, facet, reach) || inner_->hold(slot, facet)) continue;
      near.facets.push_back(facet);
      near.planes.push_back(spatial::plane_of(facet));
    }
    return near;
  }

  LocalOptions options_;
  SpatialOptions stages_;
  spatial::SolidPair pair_;
  std::optional<spatial::DynamicConvolution> convolution_;
  std::optional<spatial::NearFacets> near_;
  std::optional<spatial::InnerFacets> inner_;
  PosePair poses_;
  bool moved_ = false;
  std::size_t all_facets_ = 0;
};

Result<LocalSum> LocalSum::create(const Mesh& p, const Mesh& q, const LocalOptions& options) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  if (p.has_thin_parts() || q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "an operand of a local sum has parts without volume", {}};
  if (options.progress && !options.progress("operands", 0)) return cancelled();
  return LocalSum(std::make_unique<State>(p, q, options));
}

LocalSum::LocalSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
LocalSum::LocalSum(LocalSum&&) noexcept = default;
LocalSum& LocalSum::operator=(LocalSum&&) noexcept = default;
LocalSum::~LocalSum() = default;

Result<LocalPart> LocalSum::in(const ClipBox& box, const SolidPose& p, const SolidPose& q) {
  return state_->in(box, nullptr, {p, q});
}

Result<LocalPart> LocalSum::in(const ClipBall& ball, const SolidPose& p, const SolidPose& q) {
  if (!is_finite_position(ball.centre) || !std::isfinite(ball.radius))
    return Error{ErrorCode::not_finite, "the ball is not finite", {}};
  if (!(ball.radius > 0))
    return Error{ErrorCode::out_of_range, "the radius must be positive, not " + base::general_text(ball.radius, 6), {}};
  return state_->in(bounding_box(ball), &ball, {p, q});
}

std::size_t LocalSum::facet_count() const { return state_->facet_count(); }

}  // namespace dymsum

#include "spatial/moving/moving_pair.h"

namespace dymsum::spatial {

namespace {

/// To begin to follow costs about as much as two sums from scratch, and saves at most half of one at every pose.
constexpr std::uint32_t kNearStepsToFollow = 4;

}  // namespace

std::optional<Error> motion_refusal(const Mesh& p, const Mesh& q, const MovingSolidOptions& options) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  if (p.has_thin_parts() && q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "only one operand of a moving sum may have parts without volume", {}};
  return std::nullopt;
}

MovingPair::MovingPair(const Mesh& p, const Mesh& q, const MovingSolidOptions& options, PoseOrder order)
    : options_(options), stages_(stage_options(options)), pair_(solid_pair(p, q)), order_(order) {
  const bool empty = pair_.p.vertices.empty() || pair_.q.vertices.empty();
  if (empty || options_.mode == FrameMode::rebuild || p.has_thin_parts() || q.has_thin_parts()) return;
  if (Result<ConvexSum> made = ConvexSum::create(p, q); made.ok()) convex_ = *std::move(made);
  else frames_.emplace(pair_, stages_);
}

SpatialSum MovingPair::frame(const PosePair& to, SolidFrameWork& work) {
  if (stages_.progress && !stages_.progress("frame", 0)) throw Cancelled{};
  SpatialSum sum = any_frame(to, work);
  poses_ = to, started_ = true;
  return sum;
}

SpatialSum MovingPair::any_frame(const PosePair& to, SolidFrameWork& work) {
  if (convex_) return convex_frame(to, work);
  if (follows(to)) return frames_->frame(to, work);
  work.rebuilt = true;
  SpatialSum fresh = fresh_sum(pair_, to, stages_);
  work.facets = fresh.stats.face_vertex + fresh.stats.edge_edge;
  work.contacts = fresh.stats.contacts, work.exact_signs = fresh.stats.exact_signs;
  return fresh;
}

bool MovingPair::follows(const PosePair& to) {
  if (!frames_) return false;
  if (options_.mode == FrameMode::window) return true;
  if (order_ == PoseOrder::motion) return !started_ || !frames_->had_better_not(poses_, to);
  const bool near = started_ && !frames_->had_better_not(poses_, to);
  near_steps_ = near ? near_steps_ + 1 : 0;
  return near_steps_ >= kNearStepsToFollow;
}

SpatialSum MovingPair::convex_frame(const PosePair& to, SolidFrameWork& work) {
  const MotionWork& moved = convex_->set(to.p, to.q);
  work.normals_checked = moved.vertex_checks, work.pairs_checked = moved.crossing_checks;
  work.facets_added = moved.facets_added, work.facets_removed = moved.facets_removed;
  work.facets = convex_->face_vertex_count() + convex_->edge_edge_count(), work.exact_signs = moved.exact_signs;
  return convex_->sum();
}

}  // namespace dymsum::spatial

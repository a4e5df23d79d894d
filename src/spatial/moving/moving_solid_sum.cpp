#include "dymsum/moving_solid_sum.h"

#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "spatial/moving/frame_changes.h"
#include "spatial/moving/solid_frames.h"
#include "spatial/sum/grid_error.h"
#include "spatial/sum/sum_of_solids.h"

namespace dymsum {

using spatial::PosePair;

class MovingSolidSum::State {
 public:
  State(const Mesh& p, const Mesh& q, const MovingSolidOptions& given)
      : options(given), stages(spatial::stage_options(given)), pair(spatial::solid_pair(p, q)) {
    const bool empty = pair.p.vertices.empty() || pair.q.vertices.empty();
    if (empty || options.mode == FrameMode::rebuild || p.has_thin_parts() || q.has_thin_parts()) return;
    if (Result<ConvexSum> made = ConvexSum::create(p, q); made.ok()) convex = *std::move(made);
    else frames.emplace(pair, stages);
  }

  Result<SolidFrameWork> set(const PosePair& to) {
    const Stopwatch watch;
    SolidFrameWork now;
    Result<SpatialSum> made = spatial::guarded([&] { return frame(to, now); });
    if (!made) return made.error();
    before = std::exchange(sum, *std::move(made));
    poses = to, started = true, work = now;
    work.ms = watch.ms();
    return work;
  }

  MovingSolidOptions options;
  SpatialOptions stages;
  spatial::SolidPair pair;
  PosePair poses;
  SpatialSum sum;
  std::optional<SpatialSum> before;
  SolidFrameWork work;

 private:
  SpatialSum frame(const PosePair& to, SolidFrameWork& now) {
    if (stages.progress && !stages.progress("frame", 0)) throw spatial::Cancelled{};
    if (convex) return convex_frame(to, now);
    if (frames && (options.mode == FrameMode::window || !started || !frames->had_better_not(poses, to)))
      return frames->frame(to, now);
    now.rebuilt = true;
    SpatialSum fresh = spatial::fresh_sum(pair, to, stages);
    now.facets = fresh.stats.face_vertex + fresh.stats.edge_edge;
    now.contacts = fresh.stats.contacts, now.exact_signs = fresh.stats.exact_signs;
    return fresh;
  }

  SpatialSum convex_frame(const PosePair& to, SolidFrameWork& now) {
    const MotionWork& moved = convex->set(to.p, to.q);
    now.normals_checked = moved.vertex_checks, now.pairs_checked = moved.crossing_checks;
    now.facets_added = moved.facets_added, now.facets_removed = moved.facets_removed;
    now.facets = convex->face_vertex_count() + convex->edge_edge_count(), now.exact_signs = moved.exact_signs;
    return spatial::boundary_of(convex->sum());
  }

  bool started = false;
  std::optional<ConvexSum> convex;
  std::optional<spatial::SolidFrames> frames;
};

namespace {

std::optional<Error> refusal(const Mesh& p, const Mesh& q, const MovingSolidOptions& options) {
  if (options.threads < 0) return Error{ErrorCode::out_of_range, "the number of threads is negative", {}};
  if (p.has_thin_parts() && q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "only one operand of a moving sum may have parts without volume", {}};
  return std::nullopt;
}

}  // namespace

Result<MovingSolidSum> MovingSolidSum::create(const Mesh& p, const Mesh& q, const MovingSolidOptions& options) {
  if (std::optional<Error> error = refusal(p, q, options)) return *std::move(error);
  MovingSolidSum sum(std::make_unique<State>(p, q, options));
  if (const Result<SolidFrameWork> first = sum.set({}); !first) {
    const bool wide = first.error().code == ErrorCode::unsupported_operand && !p.empty() && !q.empty();
    if (std::optional<Error> error; wide && (error = spatial::grid_error(p.vertices(), q.vertices()))) return *error;
    return first.error();
  }
  sum.state_->before.reset();
  return sum;
}

MovingSolidSum::MovingSolidSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
MovingSolidSum::MovingSolidSum(MovingSolidSum&&) noexcept = default;
MovingSolidSum& MovingSolidSum::operator=(MovingSolidSum&&) noexcept = default;
MovingSolidSum::~MovingSolidSum() = default;

Result<SolidFrameWork> MovingSolidSum::set(const SolidPose& p, const SolidPose& q) { return state_->set({p, q}); }
const SolidPose& MovingSolidSum::p_pose() const { return state_->poses.p; }
const SolidPose& MovingSolidSum::q_pose() const { return state_->poses.q; }
const SpatialSum& MovingSolidSum::sum() const { return state_->sum; }
const SolidFrameWork& MovingSolidSum::work() const { return state_->work; }
SolidFrameChanges MovingSolidSum::changes() const {
  return state_->before ? spatial::frame_changes(*state_->before, state_->sum) : SolidFrameChanges{};
}

Result<SpatialSum> posed_sum(const Mesh& p, const Mesh& q, const SolidPose& p_pose, const SolidPose& q_pose,
                             const MovingSolidOptions& options) {
  if (std::optional<Error> error = refusal(p, q, options)) return *std::move(error);
  return spatial::guarded([&] {
    return spatial::fresh_sum(spatial::solid_pair(p, q), {p_pose, q_pose}, spatial::stage_options(options));
  });
}

}  // namespace dymsum

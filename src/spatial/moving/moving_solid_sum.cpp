#include "spatial/moving/moving_solid_sum.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/poll.h"
#include "dymsum/convex_sum.h"
#include "dymsum/moving_solid_sum.h"
#include "spatial/convex/pose_batch.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/moving/dynamic_convolution.h"
#include "spatial/moving/inner_facets.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

SpatialOptions stage_options(const MovingSolidOptions& options) {
  SpatialOptions stages;
  stages.semantics = options.semantics, stages.tight = options.tight;
  stages.threads = options.threads, stages.progress = options.progress;
  return stages;
}

SpatialSum sum_of_facets(const SolidPair& pair, PosedSpace space, ReducedConvolution convolution,
                         const ConvolutionHints& hints, const SpatialOptions& options, CornerContacts* corners) {
  SpatialSum sum;
  StageWatch watch(options, sum.stats);
  watch.begin("inner facets");
  SolidBoundary boundary =
      solid_boundary(std::move(space.space), std::move(convolution), pair.p, pair.q, hints, options, sum.stats, watch);
  watch.begin("faces");
  assemble(boundary, pair.p, pair.q, sum, watch, {}, corners);
  watch.begin("");
  unscale(sum, space.scale);
  return sum;
}

SpatialSum fresh_sum(const SolidPair& pair, const PosePair& poses, const SpatialOptions& options) {
  if (pair.p.vertices.empty() || pair.q.vertices.empty()) return {};
  return fresh_sum(pair, posed_space(pair, poses), options);
}

SpatialSum fresh_sum(const SolidPair& pair, PosedSpace space, const SpatialOptions& options, CornerContacts* corners) {
  SpatialStats stats;
  StageWatch watch(options, stats);
  watch.begin("convolution");
  ReducedConvolution convolution = reduced_convolution(*space.space, pair.p, pair.q, watch);
  return sum_of_facets(pair, std::move(space), std::move(convolution), {}, options, corners);
}

namespace {

// Frames of a sum of two solids of any shape: what is kept between them.

class SolidFrames {
 public:
  /// Requires operands that are not empty, without thin parts; the pair has to live as long.
  SolidFrames(const SolidPair& pair, const SpatialOptions& options)
      : pair_(pair), options_(options), convolution_(pair), inner_(pair) {}

  /// The sum at a pair of poses. Throws as fresh_sum; what is kept then still serves.
  SpatialSum frame(const PosePair& poses, SolidFrameWork& work);
  /// Whether a frame had better be made from scratch: the move is too long for the certificates of the convolution to
  /// serve, or normals lie on arcs in masses, as where faces and edges stay parallel while solids scale along an axis.
  /// That is found out at a frame, and holds for some after it.
  bool had_better_not(const PosePair& from, const PosePair& to);

 private:
  ReducedConvolution outer_facets();

  const SolidPair& pair_;
  const SpatialOptions& options_;
  DynamicConvolution convolution_;
  InnerFacets inner_;
  std::uint32_t crowded_ = 0;        // frames for which that holds
  std::uint32_t without_boxes_ = 0;  // frames for which boxes do not pay
};

/// Exact signs are some twenty times as expensive as what else makes a facet of a fresh convolution. Where an update
/// takes more of them than there are facets, it is given up for this many frames.
constexpr std::uint32_t kFramesFromScratch = 50;

/// The boxes of a fresh sum take about a quarter of it. Where they drop fewer than one in so many of the facets that
/// balls left, they are left out of this many frames.
constexpr std::uint64_t kOneIn = 12;

constexpr std::uint32_t kFramesWithoutBoxes = 8;

constexpr std::uint64_t kFewTests = 100;

bool SolidFrames::had_better_not(const PosePair& from, const PosePair& to) {
  if (convolution_.motion(from, to) > convolution_.longest_step()) return true;
  if (crowded_ == 0) return false;
  --crowded_;
  return true;
}

SpatialSum SolidFrames::frame(const PosePair& poses, SolidFrameWork& work) {
  SpaceOnDemand exact(pair_, poses);
  exact();  // throws before anything has moved
  const ConvolutionWork& moved = convolution_.set(poses, exact);
  work.normals_checked = moved.normals_checked, work.pairs_checked = moved.pairs_checked;
  work.facets = convolution_.slots().facets(), work.facets_added = moved.added, work.facets_removed = moved.removed;
  if (!moved.rebuilt && moved.exact_checks > convolution_.slots().facets()) crowded_ = kFramesFromScratch;
  for (const std::uint32_t slot : convolution_.slots().added()) inner_.forget(slot);
  PosedSpace space = exact.take();
  inner_.move(space, poses);
  ReducedConvolution outer = outer_facets();
  work.inner_kept = inner_.kept(), work.inner_tested = inner_.tested();
  const std::size_t count = outer.facets.size();
  const bool boxes = without_boxes_ == 0;
  SpatialSum sum = sum_of_facets(pair_, std::move(space), std::move(outer), {!boxes}, options_);
  const bool many_tests = sum.stats.tight_tests + sum.stats.collision_tests > kFewTests;
  if (many_tests) without_boxes_ = 0;
  else if (!boxes) --without_boxes_;
  else if (sum.stats.inner_facets * kOneIn < count) without_boxes_ = kFramesWithoutBoxes;
  work.contacts = sum.stats.contacts, work.exact_signs = sum.stats.exact_signs + moved.exact_checks;
  return sum;
}

/// The facets that are not known to lie deep inside, in the order of a fresh convolution.
ReducedConvolution SolidFrames::outer_facets() {
  ReducedConvolution outer;
  outer.facets.reserve(convolution_.slots().facets()), outer.planes.reserve(convolution_.slots().facets());
  for (const std::uint32_t slot : convolution_.in_order()) {
    const SumFacet& facet = convolution_.slots()[slot];
    ++(facet.kind == SumFacet::Kind::edge_edge ? outer.counts.edge_edge : outer.counts.face_vertex);
    if (inner_.hold(slot, facet)) continue;
    outer.facets.push_back(facet);
    outer.planes.push_back(plane_of(facet));
  }
  return outer;
}

// What follows a pair of solids from pose to pose, one sum at a time.

/// What follows: a motion, whose next pose is near as a rule, or poses of which few are near the one before.
enum class PoseOrder : std::uint8_t { motion, scattered };

class MovingPair {
 public:
  MovingPair(const Mesh& p, const Mesh& q, const MovingSolidOptions& options, PoseOrder order = PoseOrder::motion);
  MovingPair(const MovingPair&) = delete;

  /// The sum at a pair of poses, from what is kept of the frame before or from scratch. Throws as fresh_sum, Cancelled;
  /// the next frame then is made as if that one had not been requested.
  SpatialSum frame(const PosePair& to, SolidFrameWork& work);
  const PosePair& poses() const { return poses_; }
  const MovingSolidOptions& options() const { return options_; }

 private:
  SpatialSum any_frame(const PosePair& to, SolidFrameWork& work);
  bool follows(const PosePair& to);
  SpatialSum convex_frame(const PosePair& to, SolidFrameWork& work);

  MovingSolidOptions options_;
  SpatialOptions stages_;
  SolidPair pair_;
  PosePair poses_;
  PoseOrder order_;
  bool started_ = false;
  std::uint32_t near_steps_ = 0;     // in a row, of scattered poses
  std::optional<ConvexSum> convex_;  // both operands are convex
  std::optional<SolidFrames> frames_;
};

/// To begin to follow costs about as much as two sums from scratch, and saves at most half of one at every pose.
constexpr std::uint32_t kNearStepsToFollow = 4;

/// One error for all makers of moving sums: out_of_range, unsupported_operand.
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

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {
namespace {

using spatial::PosePair;

/// What the threads of a batch share.
class PoseBatch {
 public:
  PoseBatch(const std::vector<PosePair>& poses, const PosedSumVisit& visit, const MovingSolidOptions& options)
      : poses_(poses), visit_(visit), progress_(options.progress), works_(poses.size()) {}

  /// One part of the order: a motion of its own, so that parts share nothing but what they tell. The first failure ends
  /// all parts.
  void run(const Mesh& p, const Mesh& q, const MovingSolidOptions& own, std::span<const std::uint32_t> part) {
    try {
      spatial::MovingPair pair(p, q, own, spatial::PoseOrder::scattered);
      for (const std::uint32_t k : part) {
        const Stopwatch watch;
        const SpatialSum sum = pair.frame(poses_[k], works_[k]);
        works_[k].ms = watch.ms();
        tell(k, sum);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      fail();
    }
  }
  /// Throws what ended the batch.
  std::vector<SolidFrameWork> take() {
    if (failure_) std::rethrow_exception(failure_);
    return std::move(works_);
  }
  /// Whether to go on, between the stages of a sum: the caller is queried by one thread at a time, with the fraction of
  /// all poses.
  bool go_on() {
    const std::lock_guard lock(mutex_);
    if (!failure_ && !queried()) failure_ = std::make_exception_ptr(Cancelled{});
    return !failure_;
  }

 private:
  bool queried() const {
    return !progress_ || progress_("poses", static_cast<double>(done_) / static_cast<double>(poses_.size()));
  }
  void tell(std::uint32_t k, const SpatialSum& sum) {
    const std::lock_guard lock(mutex_);
    if (failure_) throw Cancelled{};
    try {
      visit_(k, sum);
      ++done_;
      if (!queried()) throw Cancelled{};
    } catch (...) {
      fail();  // still under the lock: no other thread visits after a failure
      throw;
    }
  }
  /// Keeps the failure that is being caught, if it is the first. The lock is held.
  void fail() {
    if (!failure_) failure_ = std::current_exception();
  }

  const std::vector<PosePair>& poses_;
  const PosedSumVisit& visit_;
  const Progress& progress_;
  std::vector<SolidFrameWork> works_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

/// P's turn as Q sees it, which is what a convolution depends on.
std::vector<Rotation> relative_turns(const std::vector<PosePair>& poses) {
  std::vector<Rotation> turns;
  for (const PosePair& at : poses) turns.push_back(at.q.rotation.inverse() * at.p.rotation);
  return turns;
}

}  // namespace

Result<std::vector<SolidFrameWork>> posed_sums(const Mesh& p, const Mesh& q, std::span<const SolidPose> p_poses,
                                               std::span<const SolidPose> q_poses, const PosedSumVisit& visit,
                                               const MovingSolidOptions& options) {
  if (std::optional<Error> error = spatial::motion_refusal(p, q, options)) return *std::move(error);
  if (!q_poses.empty() && q_poses.size() != p_poses.size())
    return Error{ErrorCode::out_of_range,
                 "there are " + std::to_string(p_poses.size()) + " poses of P and " + std::to_string(q_poses.size()) +
                     " of Q: as many are needed, or none of Q",
                 {}};
  std::vector<PosePair> poses;
  for (std::size_t k = 0; k < p_poses.size(); ++k)
    poses.push_back({p_poses[k], q_poses.empty() ? SolidPose{} : q_poses[k]});
  const std::vector<std::uint32_t> order = spatial::pose_order(relative_turns(poses));
  PoseBatch batch(poses, visit, options);
  MovingSolidOptions own = options;
  own.threads = 1;
  own.progress = [&](std::string_view, double) { return batch.go_on(); };
  const auto threads = static_cast<std::size_t>(options.threads > 0 ? options.threads : base::core_count());
  const std::size_t parts = std::min(poses.size(), threads);
  return spatial::guarded([&] {
    base::parallel_parts(parts, options.threads, [&](std::size_t part) {
      const std::size_t low = poses.size() * part / parts, high = poses.size() * (part + 1) / parts;
      batch.run(p, q, own, std::span(order).subspan(low, high - low));
    });
    return batch.take();
  });
}

namespace {

/// A face seen from one of its edges: what makes it, and what makes the face beyond.
struct Meeting {
  SolidContact face, beyond;
  friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

/// The meetings of every face with every other one at each edge, sorted.
std::vector<Meeting> meetings(const SpatialSum& sum) {
  const auto contact = [&](std::uint32_t f) { return SolidContact{sum.faces[f].p, sum.faces[f].q}; };
  std::vector<Meeting> all;
  const std::vector<SpatialEdge> edges = sum.edges();
  all.reserve(2 * edges.size());
  for (const SpatialEdge& edge : edges)
    for (const std::uint32_t a : edge.faces)
      for (const std::uint32_t b : edge.faces)
        if (a != b) all.push_back({contact(a), contact(b)});
  std::sort(all.begin(), all.end());
  return all;
}

std::int64_t more(std::size_t before, std::size_t after) {
  return static_cast<std::int64_t>(after) - static_cast<std::int64_t>(before);
}

SolidFrameChanges frame_changes(const SpatialSum& before, const SpatialSum& after) {
  SolidFrameChanges changes;
  const std::vector<Meeting> was = meetings(before), is = meetings(after);
  const auto end_of = [](auto at, auto end) {
    return std::find_if(at, end, [&](const Meeting& m) { return m.face != at->face; });
  };
  auto a = was.begin(), b = is.begin();
  while (a != was.end() || b != is.end()) {
    const auto a_end = end_of(a, was.end()), b_end = end_of(b, is.end());
    if (b == is.end() || (a != was.end() && a->face < b->face)) {
      changes.disappeared.push_back(a->face), a = a_end;
    } else if (a == was.end() || b->face < a->face) {
      changes.appeared.push_back(b->face), b = b_end;
    } else {
      if (!std::equal(a, a_end, b, b_end)) changes.changed.push_back(b->face);
      a = a_end, b = b_end;
    }
  }
  changes.shells = more(before.shells, after.shells);
  changes.tight_faces = more(before.tight_faces.size(), after.tight_faces.size());
  changes.tight_segments = more(before.tight_segments.size(), after.tight_segments.size());
  changes.tight_points = more(before.tight_points.size(), after.tight_points.size());
  return changes;
}

}  // namespace

class MovingSolidSum::State {
 public:
  State(const Mesh& p, const Mesh& q, const MovingSolidOptions& options) : motion(p, q, options) {}

  Result<SolidFrameWork> set(const PosePair& to) {
    const Stopwatch watch;
    SolidFrameWork now;
    Result<SpatialSum> made = spatial::guarded([&] { return motion.frame(to, now); });
    if (!made) return made.error();
    before = std::exchange(sum, *std::move(made));
    work = now;
    work.ms = watch.ms();
    return work;
  }

  spatial::MovingPair motion;
  SpatialSum sum;
  std::optional<SpatialSum> before;
  SolidFrameWork work;
};

Result<MovingSolidSum> MovingSolidSum::create(const Mesh& p, const Mesh& q, const MovingSolidOptions& options) {
  if (std::optional<Error> error = spatial::motion_refusal(p, q, options)) return *std::move(error);
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
const SolidPose& MovingSolidSum::p_pose() const { return state_->motion.poses().p; }
const SolidPose& MovingSolidSum::q_pose() const { return state_->motion.poses().q; }
const SpatialSum& MovingSolidSum::sum() const { return state_->sum; }
const SolidFrameWork& MovingSolidSum::work() const { return state_->work; }
SolidFrameChanges MovingSolidSum::changes() const {
  return state_->before ? frame_changes(*state_->before, state_->sum) : SolidFrameChanges{};
}

Result<SpatialSum> posed_sum(const Mesh& p, const Mesh& q, const SolidPose& p_pose, const SolidPose& q_pose,
                             const MovingSolidOptions& options) {
  if (std::optional<Error> error = spatial::motion_refusal(p, q, options)) return *std::move(error);
  return spatial::guarded([&] {
    return spatial::fresh_sum(spatial::solid_pair(p, q), {p_pose, q_pose}, spatial::stage_options(options));
  });
}

}  // namespace dymsum

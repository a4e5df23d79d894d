#include "dymsum/moving_solid_sum.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/poll.h"
#include "spatial/moving/moving_pair.h"
#include "spatial/sum/grid_error.h"

namespace dymsum {

using spatial::PosePair;

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

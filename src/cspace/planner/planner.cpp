#include "dymsum/planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/double_text.h"
#include "base/memory_budget.h"
#include "base/poll.h"
#include "cspace/boundary/obstacle_state.h"
#include "cspace/events/walked_rings.h"
#include "cspace/planner/path_levels.h"
#include "cspace/planner/path_points.h"
#include "cspace/planner/path_search.h"

namespace dymsum {
namespace {

using namespace planar;

using Clock = std::chrono::steady_clock;

class Planner {
 public:
  Planner(const CspaceObstacle& obstacle, PathEnd start, PathEnd goal, const PlanOptions& options, double frame,
          Clock::time_point deadline)
      : obstacle_(obstacle),
        options_(options),
        start_(std::move(start)),
        goal_(std::move(goal)),
        levels_(obstacle, options, frame),
        points_(obstacle, levels_, options.touching),
        joined_(obstacle),
        deadline_(deadline) {}

  // What needs nothing of the obstacle but slices at both ends: they are not free, or one rotation in place between
  // translations will do.
  Result<std::optional<Plan>> direct() {
    if (options_.progress && !options_.progress("search", 0)) return cancelled();
    if (!is_free(start_, NoPath::Kind::start_not_free) || !is_free(goal_, NoPath::Kind::goal_not_free))
      return std::optional(finished());
    if (walks_at_once() || turns_at_once()) return std::optional(finished());
    return std::optional<Plan>();
  }

  // The direct ways; then their components are compared, and the search.
  Result<Plan> run() {
    Result<std::optional<Plan>> at_once = direct();
    if (!at_once) return at_once.error();
    if (*at_once) return **std::move(at_once);
    levels_.add_all();
    levels_.add(start_.theta);
    levels_.add(goal_.theta);
    if (options_.touching == Touching::allowed) {
      const auto stopped = joined_.join_touching(obstacle_, levels_, {deadline_, options_.progress});
      if (stopped == SearchStop::cancelled) return cancelled();
      if (stopped == SearchStop::out_of_time) return out_of_time();
    }
    const std::vector<std::uint32_t> from = around(start_), to = around(goal_);
    if (!connected(from, to)) {
      refuse(NoPath::Kind::separated, from, to);
      return finished();
    }
    return search(from, to);
  }

 private:
  bool is_free(const PathEnd& end, NoPath::Kind kind) {
    const SliceMap& map = levels_.map(levels_.add(end.theta));
    const SlicePoint at(end.at);
    const SliceMap::Where where = map.where(at);
    if (where == SliceMap::Where::outside) return true;
    if (where == SliceMap::Where::touching && options_.touching == Touching::allowed) return true;
    NoPath& reason = plan_.reason.emplace();
    reason.kind = kind;
    reason.text = kind == NoPath::Kind::start_not_free ? "the start " : "the goal ";
    reason.text += where == SliceMap::Where::inside ? "overlaps the obstacle" : "touches the obstacle";
    if (const std::uint32_t e = map.edge_at(at); e != kUnknown) reason.contact = map.edges()[e].contact;
    return false;
  }

  // Whether translations at an orientation lead from the start's position to the goal's.
  bool walks(const Orientation& theta) {
    const SliceGraph& graph = levels_.graph(levels_.add(theta));
    const std::uint32_t group = graph.group_at(SlicePoint(start_.at));
    return group != kUnknown && group == graph.group_at(SlicePoint(goal_.at));
  }

  // Whether translations alone lead to the goal.
  bool walks_at_once() {
    if (!(start_.theta == goal_.theta) || !walks(start_.theta)) return false;
    write_path({});
    return true;
  }

  // Whether one rotation is enough: at the goal, after a path in the start's slice, or at the start; straight paths
  // first.
  bool turns_at_once() {
    if (start_.theta == goal_.theta) return false;
    for (const bool straight : {true, false})
      for (const bool at_goal : {true, false}) {
        const Position& at = at_goal ? goal_.at : start_.at;
        const Orientation& theta = at_goal ? start_.theta : goal_.theta;
        if (straight ? !points_.glides(theta, start_.at, goal_.at) : !walks(theta)) continue;
        ++plan_.work.rotations;
        const std::optional<TurnDirection> d = points_.turns(at, start_.theta, goal_.theta);
        if (!d) continue;
        write_path({{at, goal_.theta, *d}});
        return true;
      }
    return false;
  }

  // The components whose closure holds an end: those around it in its slice and, where it touches, those next to it in
  // angle.
  std::vector<std::uint32_t> around(const PathEnd& end) {
    std::vector<std::uint32_t> all;
    const auto add_at = [&](const Orientation& theta) {
      const std::size_t k = levels_.add(theta);
      const std::uint32_t group = levels_.graph(k).group_at(SlicePoint(end.at));
      if (group == kUnknown) return;
      const std::vector<std::uint32_t> more = levels_.components(k, group);
      all.insert(all.end(), more.begin(), more.end());
    };
    add_at(end.theta);
    if (levels_.map(levels_.add(end.theta)).where(SlicePoint(end.at)) == SliceMap::Where::touching) {
      Pivot pivot(obstacle_.robot(), obstacle_.obstacle());
      pivot.stand(end.at);
      for (const TurnDirection d : {TurnDirection::counter_clockwise, TurnDirection::clockwise}) {
        const Orientation beside = pivot.beside(end.theta, next_angle(end.theta, d), d);
        if (!pivot.overlaps(beside)) add_at(beside);
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // The next level on the way round: no event of the obstacle lies between.
  ExactAngle next_angle(const Orientation& theta, TurnDirection d) {
    const std::size_t k = levels_.add(theta), n = levels_.size();
    return levels_.angle(d == TurnDirection::counter_clockwise ? (k + 1) % n : (k + n - 1) % n);
  }

  bool joined(std::uint32_t a, std::uint32_t b) const { return joined_.root(a) == joined_.root(b); }

  // Unknown components may be any.
  bool connected(const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) const {
    for (const std::uint32_t a : from)
      for (const std::uint32_t b : to)
        if (a == kUnknown || b == kUnknown || joined(a, b)) return true;
    return false;
  }

  Result<Plan> search(const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) {
    PathLinks links(obstacle_, levels_, joined_);
    PathSearch search(obstacle_, levels_, links, options_.touching);
    const PathSearch::Outcome outcome = search.run(start_, goal_, {deadline_, options_.progress});
    plan_.work.rotations += search.rotations();
    plan_.work.refinements = search.refinements();
    switch (outcome) {
      case PathSearch::Outcome::cancelled:
        return cancelled();
      case PathSearch::Outcome::found:
        write_path(search.steps());
        break;
      case PathSearch::Outcome::nothing:
      case PathSearch::Outcome::out_of_time:
        refuse(NoPath::Kind::undecided, from, to);
        add_limit(outcome == PathSearch::Outcome::out_of_time, search.barrier());
    }
    return finished();
  }

  Plan out_of_time() {
    NoPath& reason = plan_.reason.emplace();
    reason.kind = NoPath::Kind::undecided;
    reason.text = "undecided, it was not yet found out whether start and goal are joined";
    add_limit(true, std::nullopt);
    return finished();
  }

  void add_limit(bool out_of_time, const std::optional<PathBarrier>& barrier) {
    SearchLimit& limit = plan_.reason->limit.emplace();
    limit.out_of_time = out_of_time;
    limit.seconds = options_.time_limit_seconds;
    if (barrier)
      limit.passage = {barrier->from.radians(), barrier->to.radians(), SlicePoint(barrier->reached).at(),
                       SlicePoint(barrier->beyond).at()};
    plan_.reason->text += "; " + text_of(limit);
  }

  void refuse(NoPath::Kind kind, const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) {
    NoPath& reason = plan_.reason.emplace();
    reason.kind = kind;
    for (const std::uint32_t c : from)
      if (c != kUnknown) reason.start.push_back(described(obstacle_, c));
    for (const std::uint32_t c : to)
      if (c != kUnknown) reason.goal.push_back(described(obstacle_, c));
    if (options_.touching == Touching::allowed)
      for (const ObstacleEvent& e : obstacle_.events())
        reason.unexamined_angles += e.kind == ObstacleEvent::Kind::tight && !obstacle_.angles()[e.angle].exact;
    const auto position = [](const std::vector<FreeComponent>& all) {
      return all.empty() ? std::string("a place that is held by contacts") : text_of(all[0]);
    };
    reason.text = kind == NoPath::Kind::separated ? "there is no path: "
                                                  : "undecided, start and goal are joined, but no path was found: ";
    reason.text += "the start lies in " + position(reason.start) + "; the goal lies in " + position(reason.goal);
  }

  void write_path(const std::vector<PathStep>& steps) {
    for (const PathPoint& p : points_.points(start_, steps, goal_)) {
      const Point near = SlicePoint(p.at).at();
      plan_.path.push_back({p.move,
                            {exact::to_rational(p.at.x), exact::to_rational(p.at.y)},
                            p.theta,
                            {near.x, near.y, p.theta.radians()}});
    }
  }

  Plan finished() {
    plan_.work.levels = levels_.size();
    plan_.work.slices = levels_.slices();
    return plan_;
  }

  const CspaceObstacle& obstacle_;
  const PlanOptions& options_;
  PathEnd start_, goal_;
  PathLevels levels_;
  PathPoints points_;
  JoinedComponents joined_;
  Clock::time_point deadline_;
  Plan plan_;
};

Result<ExactConfiguration> placement_of(const Configuration& c) {
  const Result<Rational> x = Rational::of(c.x), y = Rational::of(c.y);
  if (!x || !y) return Error{ErrorCode::not_finite, "a coordinate is not finite", {}};
  const Result<Orientation> theta = Orientation::nearest(c.theta);
  if (!theta) return theta.error();
  return ExactConfiguration{{*x, *y}, *theta};
}

struct Ends {
  ExactConfiguration start, goal;
};

Result<Ends> ends_of(const Configuration& start, const Configuration& goal) {
  const Result<ExactConfiguration> from = placement_of(start), to = placement_of(goal);
  if (!from) return from.error();
  if (!to) return to.error();
  return Ends{*from, *to};
}

Result<PathEnd> end_of(const ExactConfiguration& at) {
  const exact::BigRational x = exact::exact_value(at.at.x), y = exact::exact_value(at.at.y),
                           most = exact::exact_value(planar::kLargestCoordinate);
  if (abs(x) > most || abs(y) > most)
    return Error{ErrorCode::unsupported_operand, "a coordinate is larger than 2^400", {}};
  return PathEnd{{x, y}, at.theta};
}

// Calls f(planner) for two placements, and adds the time that it took.
template <class F>
auto planned(const CspaceObstacle& obstacle, const ExactConfiguration& start, const ExactConfiguration& goal,
             const PlanOptions& options, F f) -> Result<decltype(f(std::declval<Planner&>()))> {
  const auto began = Clock::now();
  if (!(options.time_limit_seconds >= 0))
    return Error{ErrorCode::out_of_range,
                 "the time limit must be at least 0 seconds, not " + base::general_text(options.time_limit_seconds, 6),
                 {}};
  // The clock's numbers might not do beyond a century.
  const std::chrono::duration<double> limit(std::min(options.time_limit_seconds, 3e9));
  const auto deadline = began + std::chrono::duration_cast<Clock::duration>(limit);
  Result<PathEnd> from = end_of(start), to = end_of(goal);
  if (!from) return from.error();
  if (!to) return to.error();
  const Pose pose(obstacle.robot(), obstacle.obstacle());
  double span = pose.reach();
  for (const Point& p : pose.obstacle().vertices) span = std::max({span, std::abs(p.x), std::abs(p.y)});
  for (const ExactConfiguration& at : {start, goal})
    span = std::max({span, std::abs(at.at.x.to_double()), std::abs(at.at.y.to_double())});
  Planner planner(obstacle, std::move(from).value(), std::move(to).value(), options, 4 * span, deadline);
  return f(planner);
}

constexpr const char* kSearch = "the search for a path";

double ms_since(Clock::time_point began) {
  return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

}  // namespace

Result<Plan> plan(const CspaceObstacle& obstacle, const ExactConfiguration& start, const ExactConfiguration& goal,
                  const PlanOptions& options) {
  const auto began = Clock::now();
  Result<Plan> answer = base::within_memory(options.memory, kSearch, [&]() -> Result<Plan> {
    Result<Result<Plan>> found =
        planned(obstacle, start, goal, options, [](Planner& planner) { return planner.run(); });
    if (!found) return found.error();
    return std::move(found).value();
  });
  if (!answer) return answer;
  Plan plan = std::move(answer).value();
  plan.work.ms = ms_since(began);
  return plan;
}

Result<Plan> plan(const CspaceObstacle& obstacle, const Configuration& start, const Configuration& goal,
                  const PlanOptions& options) {
  const Result<Ends> ends = ends_of(start, goal);
  if (!ends) return ends.error();
  return plan(obstacle, ends->start, ends->goal, options);
}

Result<std::optional<Plan>> direct_plan(const Region& robot, const Region& obstacle, const ExactConfiguration& start,
                                        const ExactConfiguration& goal, const PlanOptions& options) {
  const auto began = Clock::now();
  using Answer = Result<std::optional<Plan>>;
  Answer answer = base::within_memory(options.memory, kSearch, [&]() -> Answer {
    Result<std::unique_ptr<ObstacleState>> state = start_obstacle(robot, obstacle);
    if (!state) return state.error();
    const CspaceObstacle slices = ObstacleState::finish(std::move(state).value());
    Result<Answer> found = planned(slices, start, goal, options, [](Planner& planner) { return planner.direct(); });
    if (!found) return found.error();
    return std::move(found).value();
  });
  if (!answer) return answer;
  std::optional<Plan> plan = std::move(answer).value();
  if (plan) plan->work.ms = ms_since(began);
  return plan;
}

Result<std::optional<Plan>> direct_plan(const Region& robot, const Region& obstacle, const Configuration& start,
                                        const Configuration& goal, const PlanOptions& options) {
  const Result<Ends> ends = ends_of(start, goal);
  if (!ends) return ends.error();
  return direct_plan(robot, obstacle, ends->start, ends->goal, options);
}

}  // namespace dymsum

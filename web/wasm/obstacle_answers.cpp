// Questions to an obstacle: clearances, free angles, paths.
#include "arrays.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/path_check.h"
#include "dymsum/planner.h"
#include "obstacle.h"
#include "options.h"
#include "plain.h"
#include "planar_shape.h"

namespace dymsum::web {
namespace {

using emscripten::function;

/// The index with the obstacle that it looks at.
struct HeldQueries {
  explicit HeldQueries(std::shared_ptr<CspaceObstacle> of) : obstacle(std::move(of)), queries(*obstacle) {}
  std::shared_ptr<CspaceObstacle> obstacle;
  ObstacleQueries queries;
};

std::shared_ptr<HeldQueries> queries_of(const std::shared_ptr<CspaceObstacle>& obstacle) {
  return std::make_shared<HeldQueries>(obstacle);
}

val patch_or_null(std::uint32_t patch) { return patch == Patch::kNone ? val::null() : val(patch); }

bool contains_of(const HeldQueries& held, const val& at) { return held.queries.contains(configuration_in(at)); }

val free_angles_of(const HeldQueries& held, double x, double y) {
  return list_of(held.queries.free_angles(x, y), [](const FreeAngles& free) {
    val v = plain(free);
    v.set("beginPatch", patch_or_null(free.begin_patch));
    v.set("endPatch", patch_or_null(free.end_patch));
    return v;
  });
}

val clearance_of(const HeldQueries& held, const val& at, const val& options) {
  const double weight = member_or(options, "weight", held.queries.gyration_radius());
  const Clearance c = held.queries.clearance(configuration_in(at), weight, touching_in(member(options, "touching")));
  val v = plain(c);
  v.set("patch", patch_or_null(c.patch));
  v.set("contact", c.patch == Patch::kNone ? val::null() : plain(held.obstacle->patches()[c.patch].contact));
  return v;
}
double gyration_of(const HeldQueries& held) { return held.queries.gyration_radius(); }

val waypoint_data(const Waypoint& waypoint) {
  val v = plain(waypoint.approx);
  v.set("move", plain(waypoint.move));
  val exact = plain(waypoint.at);
  exact.set("tanHalf", tan_half_text(waypoint.theta));
  v.set("exact", exact);
  return v;
}

PlanOptions plan_options(const val& options) {
  PlanOptions how;
  how.touching = touching_in(member(options, "touching"));
  how.time_limit_seconds = member_or(options, "timeLimitSeconds", how.time_limit_seconds);
  how.progress = progress_in(member(options, "progress"));
  return how;
}

val plan_data(const Plan& made) {
  val v = val::object();
  v.set("path", list_of(made.path, waypoint_data));
  v.set("reason", plain(made.reason));
  v.set("work", plain(made.work));
  return v;
}

val plan_of(const CspaceObstacle& obstacle, const val& start, const val& goal, const val& options) {
  return plan_data(got(plan(obstacle, configuration_in(start), configuration_in(goal), plan_options(options))));
}

val direct_plan_of(const Region& robot, const Region& obstacle, const val& start, const val& goal, const val& options) {
  const std::optional<Plan> made =
      got(direct_plan(robot, obstacle, configuration_in(start), configuration_in(goal), plan_options(options)));
  return made ? plan_data(*made) : val::null();
}

val checked_path(const Region& robot, const Region& obstacle, const val& poses, const val& options) {
  std::vector<Configuration> path;
  const auto n = poses["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) path.push_back(configuration_in(poses[k]));
  return plain(got(check_path(robot, obstacle, path, touching_in(member(options, "touching")), {},
                              progress_in(member(options, "progress")))));
}

EMSCRIPTEN_BINDINGS(obstacle_answers) {
  handle<HeldQueries>("ObstacleQueries")
      .class_function("of", guarded<&queries_of>)
      .function("contains", guarded<&contains_of>)
      .function("freeAngles", guarded<&free_angles_of>)
      .function("clearance", guarded<&clearance_of>)
      .function("gyrationRadius", guarded<&gyration_of>);
  function("plan", guarded<&plan_of>);
  function("directPlan", guarded<&direct_plan_of>);
  function("checkPath", guarded<&checked_path>);
}

}  // namespace
}  // namespace dymsum::web

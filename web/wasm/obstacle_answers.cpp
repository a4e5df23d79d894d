// Questions to an obstacle: clearances, free angles, paths.
#include "arrays.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/path_check.h"
#include "dymsum/planner.h"
#include "obstacle.h"
#include "options.h"
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
val contact_or_null(const std::optional<Contact>& c) { return c ? contact(*c) : val::null(); }

bool contains_of(const HeldQueries& held, const val& at) { return held.queries.contains(configuration_in(at)); }

val free_angles_of(const HeldQueries& held, double x, double y) {
  return list_of(held.queries.free_angles(x, y), [](const FreeAngles& free) {
    val v = val::object();
    v.set("begin", free.begin);
    v.set("end", free.end);
    v.set("beginError", free.begin_error);
    v.set("endError", free.end_error);
    v.set("beginPatch", patch_or_null(free.begin_patch));
    v.set("endPatch", patch_or_null(free.end_patch));
    return v;
  });
}

val clearance_of(const HeldQueries& held, const val& at, const val& options) {
  const double weight = member_or(options, "weight", held.queries.gyration_radius());
  const Clearance c = held.queries.clearance(configuration_in(at), weight, touching_in(member(options, "touching")));
  val v = val::object();
  v.set("distance", c.distance);
  v.set("error", c.error);
  v.set("patch", patch_or_null(c.patch));
  v.set("nearest", configuration(c.nearest));
  v.set("contact", c.patch == Patch::kNone ? val::null() : contact(held.obstacle->patches()[c.patch].contact));
  return v;
}
double gyration_of(const HeldQueries& held) { return held.queries.gyration_radius(); }

val waypoint_data(const Waypoint& waypoint) {
  val v = configuration(waypoint.approx);
  v.set("move", std::string(name(waypoint.move)));
  val exact = exact_point(waypoint.at);
  exact.set("tanHalf", tan_half_text(waypoint.theta));
  v.set("exact", exact);
  return v;
}

val component_data(const FreeComponent& component) {
  val v = val::object();
  v.set("index", component.index);
  v.set("unbounded", component.unbounded);
  v.set("allAngles", component.all_angles);
  v.set("from", component.from);
  v.set("to", component.to);
  v.set("shells", list_of(component.shells, [](std::uint32_t shell) { return shell; }));
  return v;
}

val limit_data(const SearchLimit& limit) {
  val v = val::object();
  v.set("outOfTime", limit.out_of_time);
  v.set("seconds", limit.seconds);
  v.set("passage", val::null());
  if (!limit.passage) return v;
  val passage = val::object();
  passage.set("from", limit.passage->from);
  passage.set("to", limit.passage->to);
  passage.set("reached", point(limit.passage->reached));
  passage.set("beyond", point(limit.passage->beyond));
  v.set("passage", passage);
  return v;
}

val reason_data(const NoPath& reason) {
  val v = val::object();
  v.set("kind", std::string(name(reason.kind)));
  v.set("text", reason.text);
  v.set("contact", contact_or_null(reason.contact));
  v.set("start", list_of(reason.start, component_data));
  v.set("goal", list_of(reason.goal, component_data));
  v.set("limit", reason.limit ? limit_data(*reason.limit) : val::null());
  v.set("unexaminedAngles", reason.unexamined_angles);
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
  val v = val::object(), work = val::object();
  v.set("path", list_of(made.path, waypoint_data));
  v.set("reason", made.reason ? reason_data(*made.reason) : val::null());
  work.set("levels", static_cast<double>(made.work.levels));
  work.set("slices", static_cast<double>(made.work.slices));
  work.set("rotations", static_cast<double>(made.work.rotations));
  work.set("refinements", static_cast<double>(made.work.refinements));
  work.set("ms", made.work.ms);
  v.set("work", work);
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
  const PathCheck check = got(check_path(robot, obstacle, path, touching_in(member(options, "touching")), {},
                                         progress_in(member(options, "progress"))));
  val v = val::object();
  v.set("outcome", std::string(name(check.outcome)));
  v.set("piece", static_cast<double>(check.piece));
  v.set("low", check.low);
  v.set("high", check.high);
  v.set("at", configuration(check.at));
  v.set("contact", contact_or_null(check.contact));
  return v;
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

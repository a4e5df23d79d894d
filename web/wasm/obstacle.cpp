// CspaceObstacle: what it consists of, its slices and its mesh.
#include "obstacle.h"

#include "arrays.h"
#include "dymsum/obstacle_file.h"
#include "dymsum/obstacle_mesh.h"
#include "options.h"
#include "plain.h"
#include "planar/cspace_outputs.h"
#include "planar_shape.h"
#include "written.h"

namespace dymsum::web {

template <>
struct Derived<Patch> {
  static void add(val& made, const Patch& patch) { made.set("rotating", patch.rotating()); }
};

namespace {

std::shared_ptr<CspaceObstacle> created(const Region& robot, const Region& obstacle, const val& options) {
  ObstacleOptions how;
  how.progress = progress_in(member(options, "progress"));
  return shared(got(CspaceObstacle::create(robot, obstacle, how)));
}
std::shared_ptr<CspaceObstacle> read(const std::string& name, const std::string& text) {
  return shared(got(parse_obstacle(text, name)));
}

val angles_of(const CspaceObstacle& obstacle) {
  return list_of(obstacle.angles(), [](const EventAngle& angle) {
    val v = val::object();
    v.set("theta", angle.theta);
    v.set("low", angle.low);
    v.set("high", angle.high);
    v.set("exactTanHalf", angle.exact ? val(tan_half_text(*angle.exact)) : val::null());
    return v;
  });
}

val events_of(const CspaceObstacle& obstacle) { return plain(obstacle.events()); }
val tight_of(const CspaceObstacle& obstacle) { return plain(obstacle.tight()); }
val patches_of(const CspaceObstacle& obstacle) { return plain(obstacle.patches()); }
val shells_of(const CspaceObstacle& obstacle) { return plain(obstacle.shells()); }
val work_of(const CspaceObstacle& obstacle) { return plain(obstacle.work()); }

std::shared_ptr<PlanarSum> slice_of(const CspaceObstacle& obstacle, const val& angle, const val& semantics) {
  return shared(got(obstacle.slice(orientation_in(angle), semantics_in(semantics))));
}

/// Loops of patches by where each of them starts; null at an event angle.
val outline_of(const CspaceObstacle& obstacle, const val& angle) {
  const Orientation theta = orientation_in(angle);
  const auto slab = obstacle.slab_of(theta);
  if (!slab) return val::null();
  std::vector<double> vertices;
  std::vector<std::uint32_t> starts{0}, patches;
  for (const std::vector<std::uint32_t>& loop : obstacle.loops(*slab)) {
    for (const std::uint32_t patch : loop) {
      add(vertices, obstacle.ends(obstacle.patches()[patch], theta.radians())[0]);
      patches.push_back(patch);
    }
    starts.push_back(static_cast<std::uint32_t>(patches.size()));
  }
  val v = val::object();
  v.set("vertices", array_of(vertices));
  v.set("starts", array_of(starts));
  v.set("patches", array_of(patches));
  return v;
}

bool contains_of(const CspaceObstacle& obstacle, double x, double y, const val& angle) {
  check_finite({x, y});
  return obstacle.contains(x, y, orientation_in(angle));
}
bool may_have_tight_curves(const CspaceObstacle& obstacle) { return obstacle.may_have_tight_curves(); }

val patch_ends(const CspaceObstacle& obstacle, double index, double theta) {
  const std::uint32_t patch = index_in(index);
  check_finite({theta});
  if (patch >= obstacle.patches().size()) throw Thrown{{ErrorCode::bad_index, "the obstacle has no such patch", {}}};
  return plain(obstacle.ends(obstacle.patches()[patch], theta));
}

ObstacleMesh made_mesh(const CspaceObstacle& obstacle, const val& options) {
  ObstacleMeshOptions how;
  how.tolerance = member_or(options, "tolerance", how.tolerance);
  how.progress = progress_in(member(options, "progress"));
  return got(obstacle_mesh(obstacle, how));
}

val mesh_of(const CspaceObstacle& obstacle, const val& options) {
  const ObstacleMesh mesh = made_mesh(obstacle, options);
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles, patches;
  std::vector<std::uint8_t> closing;
  for (const Configuration& at : mesh.vertices) vertices.insert(vertices.end(), {at.x, at.y, at.theta});
  for (const ObstacleTriangle& triangle : mesh.triangles) {
    triangles.insert(triangles.end(), triangle.vertices.begin(), triangle.vertices.end());
    patches.push_back(triangle.patch);
    closing.push_back(triangle.closing ? 1 : 0);
  }
  val v = val::object();
  v.set("vertices", array_of(vertices));
  v.set("triangles", array_of(triangles));
  v.set("patches", array_of(patches));
  v.set("closing", array_of(closing));
  v.set("extent", mesh.extent);
  v.set("tolerance", mesh.tolerance);
  v.set("watertight", closure(mesh).watertight());
  return v;
}

val glb_of(const CspaceObstacle& obstacle, const val& options) {
  const ObstacleMesh mesh = made_mesh(obstacle, options);
  return bytes_of(as_written([&] { return cli::obstacle_glb(obstacle, mesh, cli::Ends::capped); }));
}
std::string formatted(const CspaceObstacle& obstacle) { return format_obstacle(obstacle); }

EMSCRIPTEN_BINDINGS(obstacle) {
  handle<CspaceObstacle>("CspaceObstacle")
      .class_function("create", guarded<&created>)
      .class_function("read", guarded<&read>)
      .function("angles", guarded<&angles_of>)
      .function("events", guarded<&events_of>)
      .function("tight", guarded<&tight_of>)
      .function("patches", guarded<&patches_of>)
      .function("shells", guarded<&shells_of>)
      .function("work", guarded<&work_of>)
      .function("mayHaveTightCurves", guarded<&may_have_tight_curves>)
      .function("slice", guarded<&slice_of>)
      .function("outline", guarded<&outline_of>)
      .function("contains", guarded<&contains_of>)
      .function("patchEnds", guarded<&patch_ends>)
      .function("mesh", guarded<&mesh_of>)
      .function("glb", guarded<&glb_of>)
      .function("format", guarded<&formatted>);
}

}  // namespace

Configuration configuration_in(const val& v) {
  const Configuration at{v["x"].as<double>(), v["y"].as<double>(), v["theta"].as<double>()};
  check_finite({at.x, at.y, at.theta});
  return at;
}

Touching touching_in(const val& v) { return enumerator(v, Touching::allowed); }

}  // namespace dymsum::web

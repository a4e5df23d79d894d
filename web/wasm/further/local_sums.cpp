// Sums near a position: of regions, and of solids.
#include "arrays.h"
#include "dymsum/local_sum.h"
#include "dymsum/planar_local_sum.h"
#include "options.h"
#include "plain.h"
#include "planar_shape.h"

namespace dymsum::web {
namespace {

LocalEngine engine_in(const val& options) { return enumerator(member(options, "engine"), LocalEngine::updated); }

/// A box has corners, a disc or a ball a radius.
bool is_round(const val& position) { return !is_none(position["radius"]); }

template <class Box>
val box_data(const Box& box) {
  val v = val::object();
  v.set("low", plain(box.low));
  v.set("high", plain(box.high));
  return v;
}

PlanarPose planar_pose_in(const val& v) {
  PlanarPose pose;
  if (is_none(v)) return pose;
  if (const val rotation = v["rotation"]; !is_none(rotation)) pose.rotation = orientation_in(rotation);
  const val scale = v["scale"];
  if (is_none(scale)) return pose;
  for (std::size_t k = 0; k < 2; ++k) pose.scale[k] = scale_in(scale.isArray() ? scale[k] : scale);
  return pose;
}

std::shared_ptr<PlanarLocalSum> planar_created(const Region& p, const Region& q, const val& options) {
  PlanarLocalOptions how;
  how.engine = engine_in(options);
  how.progress = progress_in(member(options, "progress"));
  return shared(got(PlanarLocalSum::create(p, q, how)));
}
std::shared_ptr<PlanarLocalPart> planar_in(PlanarLocalSum& sum, const val& position, const val& p, const val& q) {
  const PlanarPose pose_p = planar_pose_in(p), pose_q = planar_pose_in(q);
  if (is_round(position))
    return shared(
        got(sum.in(PlanarDisc{point_in(position["middle"]), position["radius"].as<double>()}, pose_p, pose_q)));
  return shared(got(sum.in(PlanarBox{point_in(position["low"]), point_in(position["high"])}, pose_p, pose_q)));
}

val ends_of(const std::vector<PlanarLocalPart::Edge>& edges) {
  std::vector<std::uint32_t> ends;
  for (const auto& edge : edges) ends.insert(ends.end(), {edge.from, edge.to});
  return array_of(ends);
}
val contacts_of(const std::vector<PlanarLocalPart::Edge>& edges) {
  return list_of(edges, [](const auto& edge) { return plain(edge.contact); });
}
val planar_part_shape(const PlanarLocalPart& part) {
  std::vector<double> vertices;
  for (const Point at : part.vertices) add(vertices, at);
  val v = val::object();
  v.set("vertices", array_of(vertices));
  v.set("edges", ends_of(part.edges));
  v.set("edgeContacts", contacts_of(part.edges));
  v.set("tightSegments", ends_of(part.tight_segments));
  v.set("tightPoints", array_of(part.tight_points));
  return v;
}
val planar_part_exact(const PlanarLocalPart& part, double vertex) {
  if (!(vertex >= 0 && vertex < static_cast<double>(part.vertices.size())))
    throw Thrown{{ErrorCode::bad_index, "the part has no such vertex", {}}};
  return plain(part.exact(static_cast<std::uint32_t>(vertex)));
}
std::string planar_part_where(const PlanarLocalPart& part) { return std::string(name(part.where)); }
val planar_part_box(const PlanarLocalPart& part) { return box_data(part.box); }
bool planar_parts_equal(const PlanarLocalPart& a, const PlanarLocalPart& b) { return a == b; }
std::string planar_part_drawn(const PlanarLocalPart& part) { return part_svg(part); }

std::shared_ptr<LocalSum> created(const Mesh& p, const Mesh& q, const val& options) {
  LocalOptions how;
  how.engine = engine_in(options);
  how.tight = member_or(options, "tight", how.tight);
  how.progress = progress_in(member(options, "progress"));
  return shared(got(LocalSum::create(p, q, how)));
}
val part_in(LocalSum& sum, const val& position, const val& p, const val& q) {
  const SolidPose pose_p = pose_in(p), pose_q = pose_in(q);
  LocalPart part =
      is_round(position)
          ? got(sum.in(ClipBall{point3_in(position["middle"]), position["radius"].as<double>()}, pose_p, pose_q))
          : got(sum.in(ClipBox{point3_in(position["low"]), point3_in(position["high"])}, pose_p, pose_q));
  val v = val::object();
  v.set("where", plain(part.where));
  v.set("box", box_data(part.box));
  v.set("boundary", shared(std::move(part.boundary)));
  return v;
}

EMSCRIPTEN_BINDINGS(local_sums) {
  handle<PlanarLocalPart>("PlanarLocalPart")
      .property("where", &planar_part_where)
      .function("box", guarded<&planar_part_box>)
      .function("shape", guarded<&planar_part_shape>)
      .function("exact", guarded<&planar_part_exact>)
      .function("equals", guarded<&planar_parts_equal>)
      .function("svg", guarded<&planar_part_drawn>);
  handle<PlanarLocalSum>("PlanarLocalSum")
      .class_function("create", guarded<&planar_created>)
      .function("in", guarded<&planar_in>);
  handle<LocalSum>("LocalSum").class_function("create", guarded<&created>).function("in", guarded<&part_in>);
}

}  // namespace
}  // namespace dymsum::web

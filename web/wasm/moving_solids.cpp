// MovingSolidSum and ConvexSum.
#include <algorithm>
#include <map>

#include "arrays.h"
#include "dymsum/convex_solid.h"
#include "dymsum/convex_sum.h"
#include "dymsum/moving_solid_sum.h"
#include "mesh.h"
#include "options.h"
#include "plain.h"
#include "solid/solid_outputs.h"
#include "solid_feature.h"
#include "spatial_shape.h"
#include "written.h"

namespace dymsum::web {
namespace {

std::shared_ptr<MovingSolidSum> moving(const Mesh& p, const Mesh& q, const val& options) {
  MovingSolidOptions how;
  how.semantics = semantics_in(member(options, "semantics"));
  how.tight = member_or(options, "tight", true);
  how.mode = enumerator(member(options, "mode"), FrameMode::automatic);
  how.progress = progress_in(member(options, "progress"));
  return shared(got(MovingSolidSum::create(p, q, how)));
}

val move_solid(MovingSolidSum& sum, const val& p, const val& q) { return plain(got(sum.set(pose_in(p), pose_in(q)))); }
val shape_of(const MovingSolidSum& sum) { return spatial_shape(sum.sum()); }
std::shared_ptr<SpatialSum> sum_of(const MovingSolidSum& sum) { return shared(sum.sum()); }
val work_of(const MovingSolidSum& sum) { return plain(sum.work()); }

val changes_of(const MovingSolidSum& sum) { return plain(sum.changes()); }

constexpr std::uint8_t kAppeared = 1, kChanged = 2;

val face_changes(const MovingSolidSum& sum) {
  const SolidFrameChanges changes = sum.changes();
  const auto among = [](const std::vector<SolidContact>& sorted, const SpatialFace& face) {
    return std::binary_search(sorted.begin(), sorted.end(), SolidContact{face.p, face.q});
  };
  std::vector<std::uint8_t> marks;
  for (const SpatialFace& face : sum.sum().faces)
    marks.push_back(among(changes.appeared, face) ? kAppeared : among(changes.changed, face) ? kChanged : 0);
  return array_of(marks);
}

/// A sum with the buffers that follow it.
struct HeldConvexSum {
  explicit HeldConvexSum(ConvexSum made) : sum(std::move(made)) {}
  ConvexSum sum;
  SolidBuffers buffers;
};

std::shared_ptr<HeldConvexSum> convex(const Mesh& p, const Mesh& q) {
  return std::make_shared<HeldConvexSum>(got(ConvexSum::create(p, q)));
}
val move_convex(HeldConvexSum& held, const val& p, const val& q) { return plain(held.sum.set(pose_in(p), pose_in(q))); }
val motion_of(const HeldConvexSum& held) { return plain(held.sum.work()); }

val buffers_of(HeldConvexSum& held) {
  const ConvexSolid& solid = held.sum.solid();
  solid.write(held.buffers);
  std::vector<std::uint32_t> triangle_facets(held.buffers.triangles.size() / 3, ConvexSolid::kFree), contacts;
  std::vector<std::uint8_t> marks(solid.facets.size(), 0);
  for (std::uint32_t k = 0; k < solid.facets.size(); ++k) {
    const ConvexSolid::Facet& facet = solid.facets[k];
    add(contacts, facet.p);
    add(contacts, facet.q);
    for (std::uint32_t t = 0; t + 2 < facet.count; ++t) triangle_facets[facet.first_triangle + t] = k;
  }
  for (const FacetChange& change : solid.changes.facets) {
    if (change.kind == FacetChange::Kind::disappeared || change.facet >= marks.size()) continue;
    marks[change.facet] = change.kind == FacetChange::Kind::appeared ? kAppeared : kChanged;
  }
  val v = val::object();
  v.set("positions", array_of(held.buffers.positions));
  v.set("triangles", array_of(held.buffers.triangles));
  v.set("triangleFacets", array_of(triangle_facets));
  v.set("facetContacts", array_of(contacts));
  v.set("facetChanges", array_of(marks));
  v.set("vertexCount", static_cast<double>(solid.vertex_count));
  v.set("facetCount", static_cast<double>(solid.facet_count));
  return v;
}

double volume_of(const HeldConvexSum& held) { return held.sum.volume(); }
std::string volume_exact_of(const HeldConvexSum& held) { return held.sum.volume_exact().to_string(); }
val support_of(const HeldConvexSum& held, const val& direction) {
  const ConvexSum::Support support = held.sum.support(point3_in(direction));
  val v = val::object();
  v.set("p", support.vertex.p);
  v.set("q", support.vertex.q);
  v.set("at", plain(support.at));
  return v;
}
val depth_of(const HeldConvexSum& held, const val& at) {
  return plain(held.sum.depth(is_none(at) ? Point3{} : point3_in(at)));
}
val facet_count_of(const HeldConvexSum& held) { return plain(held.sum.facet_count()); }
std::shared_ptr<Mesh> mesh_of(const HeldConvexSum& held) { return shared(got(held.sum.sum().rounded_mesh())); }
std::string file_of(const HeldConvexSum& held, const std::string& extension) {
  return as_written([&] {
    return cli::solid_output(held.sum.sum(), "sum." + extension, {"off", false, false, 0, held.sum.changed_facets()});
  });
}
val formatted(const HeldConvexSum& held, const std::string& name) {
  mesh_format_in(name);
  return bytes_of(file_of(held, name));
}
std::string json_of(const HeldConvexSum& held) { return file_of(held, "json"); }

std::shared_ptr<SpatialSum> value_of(const HeldConvexSum& held) { return shared(held.sum.sum()); }

val exact_of(HeldConvexSum& held, double vertex) {
  const ConvexSolid& solid = held.sum.solid();
  if (!(vertex >= 0 && vertex < static_cast<double>(solid.vertices.size())))
    throw Thrown{{ErrorCode::bad_index, "the sum has no such vertex", {}}};
  const ConvexSum::Vertex pair = solid.vertices[static_cast<std::size_t>(vertex)];
  if (pair.p == ConvexSolid::kFree) throw Thrown{{ErrorCode::bad_index, "no vertex has this index now", {}}};
  return plain(held.sum.exact(pair));
}

EMSCRIPTEN_BINDINGS(moving_solids) {
  handle<MovingSolidSum>("MovingSolidSum")
      .class_function("create", guarded<&moving>)
      .function("set", guarded<&move_solid>)
      .function("shape", guarded<&shape_of>)
      .function("faceChanges", guarded<&face_changes>)
      .function("sum", guarded<&sum_of>)
      .function("work", guarded<&work_of>)
      .function("changes", guarded<&changes_of>);
  handle<HeldConvexSum>("ConvexSum")
      .class_function("create", guarded<&convex>)
      .function("set", guarded<&move_convex>)
      .function("work", guarded<&motion_of>)
      .function("buffers", guarded<&buffers_of>)
      .function("volume", guarded<&volume_of>)
      .function("volumeExact", guarded<&volume_exact_of>)
      .function("support", guarded<&support_of>)
      .function("depth", guarded<&depth_of>)
      .function("facetCount", guarded<&facet_count_of>)
      .function("sum", guarded<&value_of>)
      .function("mesh", guarded<&mesh_of>)
      .function("exact", guarded<&exact_of>)
      .function("format", guarded<&formatted>)
      .function("toJson", guarded<&json_of>);
}

}  // namespace
}  // namespace dymsum::web

// SpatialSum, the functions that make one, and slices.
#include "dymsum/spatial_sum.h"

#include <array>

#include "arrays.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_slice.h"
#include "mesh.h"
#include "options.h"
#include "plain.h"
#include "planar_shape.h"
#include "solid/solid_outputs.h"
#include "solid_feature.h"
#include "spatial_shape.h"
#include "written.h"

namespace dymsum::web {
namespace {

using emscripten::function;
using SharedSum = std::shared_ptr<SpatialSum>;

val shape_of(const SpatialSum& sum) { return spatial_shape(sum); }

val stats_of(const SpatialSum& sum) { return plain(sum.stats); }

double volume_of(const SpatialSum& sum) { return sum.volume(); }
double area_of(const SpatialSum& sum) { return sum.area(); }
val volume_exact_of(const SpatialSum& sum, const val& bits) {
  const auto volume = sum.volume_exact_within(bits_in(bits));
  return volume ? val(volume->to_string()) : val::null();
}
val exact_of(const SpatialSum& sum, double vertex) {
  if (!(vertex >= 0 && vertex < static_cast<double>(sum.vertices.size())))
    throw Thrown{{ErrorCode::bad_index, "the sum has no such vertex", {}}};
  return plain(sum.exact(static_cast<std::size_t>(vertex)));
}
val tight_contacts_of(const SpatialSum& sum) {
  val v = val::object();
  v.set("faces", plain(sum.tight_face_contacts));
  v.set("segments", plain(sum.tight_segment_contacts));
  v.set("points", plain(sum.tight_point_contacts));
  return v;
}
std::shared_ptr<Mesh> mesh_of(const SpatialSum& sum) { return shared(got(as_mesh(sum))); }
bool equal(const SpatialSum& a, const SpatialSum& b) { return a == b; }
std::string file_of(const SpatialSum& sum, const std::string& extension) {
  return as_written([&] { return cli::solid_output(sum, "sum." + extension); });
}
val formatted(const SpatialSum& sum, const std::string& name) {
  mesh_format_in(name);
  return bytes_of(file_of(sum, name));
}
std::string json_of(const SpatialSum& sum) { return file_of(sum, "json"); }

double vertex_count(const SpatialSum& sum) { return static_cast<double>(sum.vertices.size()); }
double face_count(const SpatialSum& sum) { return static_cast<double>(sum.faces.size()); }
double shell_count(const SpatialSum& sum) { return static_cast<double>(sum.shells); }

using OfTwo = Result<SpatialSum> (*)(const Mesh&, const Mesh&, const SpatialOptions&);
template <OfTwo operation>
SharedSum of_two(const Mesh& a, const Mesh& b, const val& options) {
  return shared(got(operation(a, b, spatial_options(options))));
}
bool mesh_contains(const Mesh& p, const Mesh& q, const val& z, const val& semantics) {
  return got(contains(p, q, point3_in(z), semantics_in(semantics)));
}

std::shared_ptr<SolidSlice> slice_at(const Mesh& p, const Mesh& q, double z, const val& options) {
  return shared(got(slice_of_sum(p, q, z, spatial_options(options))));
}
std::shared_ptr<PlanarSum> section_of(const SolidSlice& slice) { return shared(slice.section); }
val touching_of(const SolidSlice& slice) { return part_rings(slice.touching); }

EMSCRIPTEN_BINDINGS(spatial_sum) {
  handle<SpatialSum>("SpatialSum")
      .property("shellCount", &shell_count)
      .property("faceCount", &face_count)
      .property("vertexCount", &vertex_count)
      .function("shape", guarded<&shape_of>)
      .function("stats", guarded<&stats_of>)
      .function("volume", guarded<&volume_of>)
      .function("area", guarded<&area_of>)
      .function("volumeExact", guarded<&volume_exact_of>)
      .function("exact", guarded<&exact_of>)
      .function("tightContacts", guarded<&tight_contacts_of>)
      .function("asMesh", guarded<&mesh_of>)
      .function("equals", guarded<&equal>)
      .function("format", guarded<&formatted>)
      .function("toJson", guarded<&json_of>);
  handle<SolidSlice>("SolidSlice")
      .function("takeSection", guarded<&section_of>)
      .function("touching", guarded<&touching_of>);
  function("sumOfMeshes", guarded<&of_two<&minkowski_sum>>);
  function("erodeMeshes", guarded<&of_two<&erode>>);
  function("meshContains", guarded<&mesh_contains>);
  function("sliceOfSum", guarded<&slice_at>);
}

}  // namespace

val spatial_shape(const SpatialSum& sum) {
  using Indices = std::vector<std::uint32_t>;
  const auto pairs = [](const auto& arrays) {
    Indices all;
    for (const auto& one : arrays) all.insert(all.end(), one.begin(), one.end());
    return array_of(all);
  };
  std::vector<double> vertices;
  for (const Point3& at : sum.vertices) add(vertices, at);
  const SpatialSum::Rounded drawn = sum.drawn();
  Indices triangles, contacts, shells, edges;
  for (const Face& triangle : drawn.mesh.faces)
    for (const std::uint32_t corner : triangle) triangles.push_back(drawn.vertex[corner]);
  for (const SpatialFace& face : sum.faces) {
    add(contacts, face.p);
    add(contacts, face.q);
    shells.push_back(face.shell);
  }
  for (const SpatialEdge& edge : sum.edges()) edges.insert(edges.end(), {edge.from, edge.to});
  val v = val::object();
  v.set("vertices", array_of(vertices));
  v.set("triangles", array_of(triangles));
  v.set("triangleFaces", array_of(drawn.face));
  v.set("faceContacts", array_of(contacts));
  v.set("faceShells", array_of(shells));
  v.set("edges", array_of(edges));
  v.set("tightTriangles", pairs(sum.tight_triangles()));
  v.set("tightSegments", pairs(sum.tight_segments));
  v.set("tightPoints", array_of(sum.tight_points));
  v.set("atError", sum.at_error);
  return v;
}

}  // namespace dymsum::web

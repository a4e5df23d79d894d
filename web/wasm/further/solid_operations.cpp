// What is made of solids besides their sum: Boolean operations, inner fits, openings, closings, offsets, solids by
// their planes.
#include "arrays.h"
#include "dymsum/solid_by_planes.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_offset.h"
#include "dymsum/solid_union.h"
#include "mesh.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

using emscripten::function;

using SharedSum = std::shared_ptr<SpatialSum>;

using OfTwo = Result<SpatialSum> (*)(const Mesh&, const Mesh&, const SpatialOptions&);
template <OfTwo operation>
SharedSum of_two(const Mesh& a, const Mesh& b, const val& options) {
  return shared(got(operation(a, b, spatial_options(options))));
}
/// Of a result, and a mesh or another one.
using OfOperands = Result<SpatialSum> (*)(const SpatialOperand&, const SpatialOperand&, const SpatialOptions&);
template <OfOperands operation>
SharedSum of_result(const SpatialSum& a, const val& b, const val& options) {
  const SpatialOptions how = spatial_options(options);
  if (b.instanceof (val::module_property("Mesh")))
    return shared(got(operation(a, *b.as<std::shared_ptr<Mesh>>(), how)));
  return shared(got(operation(a, *b.as<SharedSum>(), how)));
}
SharedSum union_of_meshes(const val& meshes, const val& options) {
  std::vector<Mesh> all;
  const auto n = meshes["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) all.push_back(*meshes[k].as<std::shared_ptr<Mesh>>());
  return shared(got(united(all, spatial_options(options))));
}

val planes_data(SolidByPlanes made) {
  val v = val::object();
  v.set("report", made.to_string());
  v.set("solid", shared(std::move(made.solid)));
  v.set("axes", plain(made.axes));
  v.set("tolerance", made.tolerance);
  v.set("largestMove", made.largest_move);
  v.set("merged", plain(made.merged));
  v.set("bentFaces", plain(made.bent_faces));
  return v;
}
/// Of one solid's data, or of a list of them, which have axes in common.
val by_its_planes(const val& data, const val& options) {
  PlanesOptions how;
  if (const val tolerance = member(options, "tolerance"); !is_none(tolerance)) how.tolerance = tolerance.as<double>();
  how.sums = spatial_options(options);
  if (!data.isArray()) return planes_data(got(by_planes(mesh_data_in(data), how)));
  std::vector<MeshData> solids;
  const auto n = data["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) solids.push_back(mesh_data_in(data[k]));
  return list_of(got(by_planes(solids, how)), planes_data);
}

BetweenSteps between_in(const val& options) { return enumerator(member(options, "between"), BetweenSteps::exact); }
val opened_data(SolidOpening made) {
  val v = val::object();
  v.set("solid", shared(std::move(made.solid)));
  v.set("moved", made.moved);
  return v;
}
val opened(const Mesh& a, const Mesh& b, const val& options) {
  return opened_data(got(opening(a, b, spatial_options(options), between_in(options))));
}
val closed(const Mesh& a, const Mesh& b, const val& options) {
  return opened_data(got(closing(a, b, spatial_options(options), between_in(options))));
}

val offset_by(const Mesh& mesh, double distance, double tolerance, const val& options) {
  const OffsetBound bound = enumerator(member(options, "bound"), OffsetBound::inside);
  SolidOffset made = got(offset(mesh, distance, tolerance, bound, spatial_options(options)));
  val v = val::object();
  v.set("solid", shared(std::move(made.solid)));
  v.set("low", made.low);
  v.set("high", made.high);
  v.set("ballFacets", static_cast<double>(made.ball_facets));
  return v;
}

EMSCRIPTEN_BINDINGS(solid_operations) {
  function("unitedMeshes", guarded<&union_of_meshes>);
  function("intersectionOfMeshes", guarded<&of_two<&intersection>>);
  function("differenceOfMeshes", guarded<&of_two<&difference>>);
  function("symmetricDifferenceOfMeshes", guarded<&of_two<&symmetric_difference>>);
  function("byPlanes", guarded<&by_its_planes>);
  function("sumOfResult", guarded<&of_result<&minkowski_sum>>);
  function("erodeResult", guarded<&of_result<&erode>>);
  function("opening", guarded<&opened>);
  function("closing", guarded<&closed>);
  function("offset", guarded<&offset_by>);
}

}  // namespace
}  // namespace dymsum::web

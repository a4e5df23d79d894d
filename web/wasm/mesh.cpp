// Mesh, and files of meshes.
#include "mesh.h"

#include <span>

#include "arrays.h"
#include "file.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

using SharedMesh = std::shared_ptr<Mesh>;

std::vector<Point3> points3(const val& array) {
  const std::vector<double> numbers = numbers_in(array);
  if (numbers.size() % 3 != 0)
    throw Thrown{
        {ErrorCode::malformed, "vertices are x, y, z after x, y, z: their number is no multiple of three", {}}};
  std::vector<Point3> points;
  for (std::size_t k = 0; k < numbers.size(); k += 3) points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  return points;
}

MeshData parsed(const std::string& name, const std::string& bytes) {
  return got(parse_mesh(bytes, got(mesh_format(name)), name));
}

RepairedMesh mesh_after_repair(MeshData data, bool thin) {
  return got(thin ? repair_with_thin_parts(std::move(data)) : repair(std::move(data)));
}

Mesh valid(MeshData data, const val& options) {
  const bool thin = member_or(options, "thinParts", false);
  if (member_or(options, "repair", false)) return mesh_after_repair(std::move(data), thin).mesh;
  if (member_or(options, "hull", false)) return got(hulled(data)).mesh;
  return got(thin ? Mesh::with_thin_parts(std::move(data)) : Mesh::create(std::move(data)));
}

SharedMesh read(const std::string& name, const std::string& bytes, const val& options) {
  return in_file(name, [&] { return shared(valid(parsed(name, bytes), options)); });
}
SharedMesh from_data(const val& data, const val& options) { return shared(valid(mesh_data_in(data), options)); }

val coordinates(const std::vector<Point3>& points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const Point3& at : points) add(numbers, at);
  return array_of(numbers);
}

void put_faces(val& v, const std::vector<Face>& faces) {
  std::vector<std::uint32_t> starts{0}, corners;
  for (const Face& face : faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  v.set("faceStarts", array_of(starts));
  v.set("faceVertices", array_of(corners));
}

val read_data(const std::string& name, const std::string& bytes) {
  const MeshData data = parsed(name, bytes);
  val v = val::object();
  v.set("vertices", coordinates(data.vertices));
  put_faces(v, data.faces);
  return v;
}

val repaired(const val& data, const val& options) {
  RepairedMesh made = mesh_after_repair(mesh_data_in(data), member_or(options, "thinParts", false));
  val v = val::object();
  v.set("changed", made.report.changed());
  v.set("report", made.report.to_string());
  v.set("mesh", shared(std::move(made.mesh)));
  return v;
}

SharedMesh hull_of_points(const val& points) { return shared(got(convex_hull(points3(points)))); }
SharedMesh hull_of(const Mesh& mesh) { return shared(got(convex_hull(mesh.vertices()))); }

val shape_of(const Mesh& mesh) {
  const TriangulatedMesh made = triangulated(mesh);
  std::vector<std::uint32_t> triangles, faces;
  for (std::size_t k = 0; k < made.face.size(); ++k) {
    const Face& triangle = made.mesh.faces()[k];
    if (triangle.size() != 3) continue;
    triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    faces.push_back(made.face[k]);
  }
  val v = val::object();
  v.set("vertices", coordinates(made.mesh.vertices()));
  v.set("triangles", array_of(triangles));
  v.set("triangleFaces", array_of(faces));
  put_faces(v, mesh.faces());
  return v;
}

double volume_of(const Mesh& mesh) { return volume(mesh); }
double surface_of(const Mesh& mesh) { return surface_area(mesh); }
val bounds_of(const Mesh& mesh) { return plain(bounds(mesh)); }
val convexity_of(const Mesh& mesh) {
  const auto error = convexity_error(mesh);
  return error ? error_data(*error) : val::null();
}
SharedMesh negated_of(const Mesh& mesh) { return shared(negated(mesh)); }
SharedMesh translated_of(const Mesh& mesh, double dx, double dy, double dz) {
  return shared(got(translated(mesh, dx, dy, dz)));
}
SharedMesh scaled_of(const Mesh& mesh, double sx, double sy, double sz) {
  return shared(got(scaled(mesh, sx, sy, sz)));
}
bool equal(const Mesh& a, const Mesh& b) { return a == b; }
val formatted(const Mesh& mesh, const std::string& name) {
  const MeshFormat format = mesh_format_in(name);
  if (const auto error = rounding_error(mesh, format)) throw Thrown{*error};
  return bytes_of(format_mesh(mesh, format));
}

double vertex_count(const Mesh& mesh) { return static_cast<double>(mesh.vertices().size()); }
double face_count(const Mesh& mesh) { return static_cast<double>(mesh.faces().size()); }
double shell_count(const Mesh& mesh) { return static_cast<double>(mesh.shell_count()); }

EMSCRIPTEN_BINDINGS(mesh) {
  handle<Mesh>("Mesh")
      .property("empty", &Mesh::empty)
      .property("vertexCount", &vertex_count)
      .property("faceCount", &face_count)
      .property("shellCount", &shell_count)
      .function("shape", guarded<&shape_of>)
      .function("volume", guarded<&volume_of>)
      .function("surfaceArea", guarded<&surface_of>)
      .function("bounds", guarded<&bounds_of>)
      .function("convexityError", guarded<&convexity_of>)
      .function("negated", guarded<&negated_of>)
      .function("translated", guarded<&translated_of>)
      .function("scaled", guarded<&scaled_of>)
      .function("convexHull", guarded<&hull_of>)
      .function("equals", guarded<&equal>)
      .function("format", guarded<&formatted>)
      .class_function("read", guarded<&read>)
      .class_function("readData", guarded<&read_data>)
      .class_function("fromData", guarded<&from_data>)
      .class_function("repair", guarded<&repaired>)
      .class_function("hullOf", guarded<&hull_of_points>);
}

}  // namespace

MeshData mesh_data_in(const val& v) {
  MeshData data;
  data.vertices = points3(v["vertices"]);
  const val faces = v["faces"];
  const auto n = faces["length"].as<unsigned>();
  if (n > 0 && faces[0].typeOf().as<std::string>() == "object") {
    for (unsigned k = 0; k < n; ++k) data.faces.push_back(indices_in(faces[k]));
    return data;
  }
  const std::vector<std::uint32_t> corners = indices_in(faces);
  if (corners.size() % 3 != 0)
    throw Thrown{{ErrorCode::malformed, "triangles are three indices each: their number is no multiple of three", {}}};
  for (std::size_t k = 0; k < corners.size(); k += 3)
    data.faces.push_back({corners[k], corners[k + 1], corners[k + 2]});
  return data;
}

MeshFormat mesh_format_in(const std::string& text) {
  static_assert(name(MeshFormat::three_mf) == names_of<MeshFormat>().back());  // it is zipped, which needs libzip
  return enumerator(val(text), MeshFormat::off, std::span(names_of<MeshFormat>()).first<5>());
}

}  // namespace dymsum::web

#include "solid/any_solid_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <utility>

#include "exit_code.h"
#include "outputs.h"
#include "progress_bar.h"
#include "solid/solid_limits.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

using Kind = SolidFeature::Kind;

/// Bits of the integers that hold both operands; 0 for integers of any size, as convex ones in the end have.
int grid_tier(const SpatialSum& sum) {
  return sum.stats.cells == 0 || sum.stats.bits > 54 ? 0 : sum.stats.bits <= 26 ? 26 : 54;
}

std::string face_kind(const SpatialFace& f) {
  if (f.p.kind == Kind::face && f.q.kind == Kind::vertex) return "face_vertex";
  if (f.p.kind == Kind::vertex && f.q.kind == Kind::face) return "vertex_face";
  return f.p.kind == Kind::edge && f.q.kind == Kind::edge ? "edge_edge" : "merged";
}

Json exact_json(const SpatialSum& sum) {
  Json json = any_solid_sum_json(sum);
  Json vertices = Json::array(), faces = Json::array();
  for (std::size_t i = 0; i < sum.vertices.size(); ++i) {
    const RationalPoint3 at = sum.exact(i);
    vertices.push_back({{"at", {sum.vertices[i].x, sum.vertices[i].y, sum.vertices[i].z}},
                        {"exact", {at.x.to_string(), at.y.to_string(), at.z.to_string()}}});
  }
  for (const SpatialFace& f : sum.faces) {
    faces.push_back({{"kind", face_kind(f)},
                     {"p", feature_json(f.p)},
                     {"q", feature_json(f.q)},
                     {"shell", f.shell},
                     {"loops", f.loops}});
  }
  json["vertex_list"] = std::move(vertices);
  json["face_list"] = std::move(faces);
  json["tight_list"] = {{"faces", sum.tight_faces}, {"segments", sum.tight_segments}, {"points", sum.tight_points}};
  return json;
}

std::vector<FaceColour> colours_of(const SpatialSum& sum, const SpatialSum::Rounded& rounded) {
  std::vector<FaceColour> colours{{{0.91f, 0.64f, 0.24f}, {}},
                                  {{0.36f, 0.73f, 0.55f}, {}},
                                  {{0.55f, 0.73f, 0.90f}, {}},
                                  {{0.70f, 0.72f, 0.75f}, {}}};
  for (std::uint32_t t = 0; t < rounded.face.size(); ++t) {
    const std::string kind = face_kind(sum.faces[rounded.face[t]]);
    const std::size_t k = kind == "face_vertex" ? 0 : kind == "vertex_face" ? 1 : kind == "edge_edge" ? 2 : 3;
    colours[k].faces.push_back(t);
  }
  return colours;
}

/// An octahedron about a place, or a bar with three sides between two: large enough to be seen.
class Marks {
 public:
  explicit Marks(const SpatialSum& sum) : sum_(sum) {
    Point3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (const Point3& v : sum.vertices) {
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    radius_ = 0.004 * std::max({high.x - low.x, high.y - low.y, high.z - low.z, 0.0});
    for (const std::uint32_t v : sum.tight_points) add_point(sum.vertices[v], 2 * radius_);
    for (const auto& [from, to] : sum.tight_segments) add_bar(sum.vertices[from], sum.vertices[to]);
    for (const auto& face : sum.tight_faces) {
      for (const std::vector<std::uint32_t>& loop : face) {
        for (std::size_t k = 0; k < loop.size(); ++k) add_bar(at(loop[k]), at(loop[(k + 1) % loop.size()]));
      }
    }
  }
  const MeshData& mesh() const { return mesh_; }

 private:
  const Point3& at(std::uint32_t v) const { return sum_.vertices[v]; }
  std::uint32_t add(double x, double y, double z) {
    mesh_.vertices.push_back({x, y, z});
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  void add_point(const Point3& p, double r) {
    const std::uint32_t east = add(p.x + r, p.y, p.z), west = add(p.x - r, p.y, p.z);
    const std::uint32_t north = add(p.x, p.y + r, p.z), south = add(p.x, p.y - r, p.z);
    const std::uint32_t top = add(p.x, p.y, p.z + r), bottom = add(p.x, p.y, p.z - r);
    for (const auto& [a, b] :
         std::array<std::array<std::uint32_t, 2>, 4>{{{east, north}, {north, west}, {west, south}, {south, east}}}) {
      mesh_.faces.push_back({a, b, top});
      mesh_.faces.push_back({b, a, bottom});
    }
  }

  void add_bar(const Point3& a, const Point3& b) {
    const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0)) return;
    // Two directions across: along the axis that the bar runs along least, made perpendicular, and their product.
    std::array<double, 3> d{x / length, y / length, z / length}, u{}, v{};
    const std::size_t least = static_cast<std::size_t>(
        std::min_element(d.begin(), d.end(), [](double s, double t) { return std::abs(s) < std::abs(t); }) - d.begin());
    u[least] = 1;
    for (std::size_t k = 0; k < 3; ++k) u[k] -= d[least] * d[k];
    const double size = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (double& c : u) c *= radius_ / size;
    for (std::size_t k = 0; k < 3; ++k) v[k] = d[(k + 1) % 3] * u[(k + 2) % 3] - d[(k + 2) % 3] * u[(k + 1) % 3];
    std::array<std::uint32_t, 6> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = std::cos(2.0943951023931953 * static_cast<double>(k)),
                   s = std::sin(2.0943951023931953 * static_cast<double>(k));
      const std::array<double, 3> off{c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2]};
      corners[k] = add(a.x + off[0], a.y + off[1], a.z + off[2]);
      corners[3 + k] = add(b.x + off[0], b.y + off[1], b.z + off[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      mesh_.faces.push_back({corners[k], corners[next], corners[3 + next]});
      mesh_.faces.push_back({corners[k], corners[3 + next], corners[3 + k]});
    }
    mesh_.faces.push_back({corners[2], corners[1], corners[0]});
    mesh_.faces.push_back({corners[3], corners[4], corners[5]});
  }

  const SpatialSum& sum_;
  double radius_ = 0;
  MeshData mesh_;
};

void print_text(std::ostream& out, const std::string& verb, const std::vector<SolidInput>& inputs,
                const SpatialSum& sum, const Timing& timing) {
  out << verb << " of ";
  for (std::size_t i = 0; i < inputs.size(); ++i)
    out << (i == 0 ? "" : i + 1 < inputs.size() ? ", " : " and ") << inputs[i].file;
  out << "\n  " << counted(sum.faces.size(), "face") << " on " << counted(sum.shells, "shell") << ", "
      << counted(sum.vertices.size(), "vertex", "vertices") << "\n  volume " << shown(sum.volume()) << ", area "
      << shown(sum.area()) << "\n";
  if (!sum.tight_faces.empty() || !sum.tight_segments.empty() || !sum.tight_points.empty()) {
    out << "  tight: " << counted(sum.tight_faces.size(), "face") << ", "
        << counted(sum.tight_segments.size(), "segment") << ", " << counted(sum.tight_points.size(), "point") << "\n";
  }
  out << "  " << sum.stats.face_vertex << " face + vertex and " << sum.stats.edge_edge << " edge + edge facets, "
      << timing.median_ms << " ms, "
      << (grid_tier(sum) == 0 ? "arbitrary precision" : std::to_string(grid_tier(sum)) + "-bit") << " coordinates\n";
}

}  // namespace

Json any_solid_sum_json(const SpatialSum& sum) {
  return {{"shells", sum.shells},
          {"vertices", sum.vertices.size()},
          {"faces", sum.faces.size()},
          {"volume", sum.volume()},
          {"volume_exact", sum.volume_exact().to_string()},
          {"area", sum.area()},
          {"tight",
           {{"points", sum.tight_points.size()},
            {"segments", sum.tight_segments.size()},
            {"faces", sum.tight_faces.size()}}},
          {"convolution", {{"fv", sum.stats.face_vertex}, {"ee", sum.stats.edge_edge}}}};
}

std::string any_solid_output(const SpatialSum& sum, const std::string& file, const SolidOutput& how) {
  const std::string name = format_name(file, how.to);
  if (name.ends_with(".json")) return exact_json(sum).dump(1) + "\n";
  const MeshFormat format = require(mesh_format(name));
  Result<SpatialSum::Rounded> rounded = sum.rounded();
  if (!rounded) {
    Error error = rounded.error();
    error.evidence.file = file;
    error.message += " (.json keeps the sum exactly)";
    stop_with(error);
  }
  const std::vector<FaceColour> colours = colours_of(sum, *rounded);
  const Result<Mesh> mesh = Mesh::create(rounded->mesh);
  if (format != MeshFormat::glb) {
    if (mesh) return mesh_text(*mesh, format, file, colours);
    // A vertex or an edge of the sum that touches a face inside it: no file of a mesh would be read back.
    Error error = mesh.error();
    error.evidence.file = file;
    error.message += " (.json keeps the sum exactly, .glb draws it)";
    stop_with(error);
  }
  if (mesh) mesh_text(*mesh, format, file);  // whether single precision holds it
  const Marks marks(sum);
  return format_glb(rounded->mesh, {colours, {}, &marks.mesh()});
}

ExitCode run_any_solid_sum(const SumVerb& verb, const SumCommand& command, const std::vector<SolidInput>& inputs,
                           const SolidOutput& how) {
  const InterruptGuard guard;
  std::vector<Mesh> operands;
  for (const SolidInput& input : inputs) operands.push_back(input.mesh);
  if (verb.reflects_second) operands[1] = negated(operands[1]);
  std::optional<ProgressBar> bar(std::in_place);
  SpatialOptions options;
  options.semantics = command.semantics == "regular" ? Semantics::regular
                      : command.semantics == "open"  ? Semantics::open
                                                     : Semantics::closed;
  options.engine = command.engine == "brute" ? SpatialEngine::brute : SpatialEngine::fast;
  options.progress = bar->callback();
  options.memory = memory_bytes(command.memory_mb);
  announce_cost(inputs[0].mesh, q);
  const auto [sum, timing] = timed(command.report.repeat, [&] {
    Result<SpatialSum> made =
        inputs.size() > 2 ? minkowski_sum(operands, options) : minkowski_sum(operands[0], operands[1], options);
    throw_if_interrupted();
    return require(std::move(made));
  });
  bar.reset();
  std::vector<std::string> texts;
  for (const std::string& file : command.output.files) texts.push_back(any_solid_output(sum, file, how));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.output.files[i], texts[i]);
  std::ostream& out = report_stream(command.output.files, command.report.json);
  if (command.report.json) {
    Json json = report_head(verb.name, solid_inputs_json(inputs), grid_tier(sum), timing);
    json["engine"] = command.engine;
    json["semantics"] = command.semantics;
    json.update(any_solid_sum_json(sum));
    print_report(json);
    return kDone;
  }
  print_text(out, verb.name, inputs, sum, timing);
  return kDone;
}

}  // namespace dymsum::cli

#include "solid/solid_outputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "dymsum/solid_sum_io.h"
#include "exit_code.h"
#include "outputs.h"
#include "solid/tight_marks.h"

namespace dymsum::cli {
namespace {

bool is_json(const std::string& file) { return file.ends_with(".json"); }

/// The colours of facets by kind: of P, of Q, of two edges, of several kinds; of those that changed.
constexpr std::array<std::array<double, 3>, 5> kColours{
    {{0.91, 0.64, 0.24}, {0.36, 0.73, 0.55}, {0.55, 0.73, 0.90}, {0.70, 0.72, 0.75}, {0.85, 0.12, 0.20}}};
constexpr std::size_t kSeveralKinds = 3, kChanged = 4;

/// The colour of every face of a sum.
std::vector<std::size_t> face_colours(const SpatialSum& sum, const SolidOutput& how) {
  std::vector<std::size_t> all;
  for (const SpatialFace& face : sum.faces) {
    const std::string kind = face_kind(face);
    const bool changed = std::binary_search(how.changed.begin(), how.changed.end(), SolidContact{face.p, face.q});
    all.push_back(changed                 ? kChanged
                  : kind == "face_vertex" ? 0
                  : kind == "vertex_face" ? 1
                  : kind == "edge_edge"   ? 2
                                          : kSeveralKinds);
  }
  return all;
}

std::vector<FaceColour> no_faces() {
  std::vector<FaceColour> colours;
  for (const std::array<double, 3>& rgb : kColours) colours.push_back({rgb, {}});
  return colours;
}

/// The colours of the triangles that faces became.
std::vector<FaceColour> colours_of(const SpatialSum& sum, const SpatialSum::Rounded& rounded, const SolidOutput& how) {
  const std::vector<std::size_t> of_face = face_colours(sum, how);
  std::vector<FaceColour> colours = no_faces();
  for (std::uint32_t t = 0; t < rounded.face.size(); ++t) colours[of_face[rounded.face[t]]].faces.push_back(t);
  return colours;
}

/// The convolution at its position, and the result to the right of it.
std::string stages_of(const SpatialSum& sum, const SpatialSum::Rounded& rounded, const SolidOutput& how) {
  std::vector<FaceColour> colours = colours_of(sum, rounded, how);
  MeshData all;
  double low = INFINITY, high = -INFINITY;
  for (FaceColour& colour : colours)
    for (std::uint32_t& face : colour.faces) face += static_cast<std::uint32_t>(sum.trace->facets.size());
  for (const SpatialTrace::Facet& facet : sum.trace->facets) {
    Face& face = all.faces.emplace_back();
    colours[static_cast<std::size_t>(facet.kind)].faces.push_back(static_cast<std::uint32_t>(all.faces.size() - 1));
    for (const Point3& p : facet.corners) {
      face.push_back(static_cast<std::uint32_t>(all.vertices.size()));
      all.vertices.push_back(p);
      low = std::min(low, p.x), high = std::max(high, p.x);
    }
  }
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const Point3& p : rounded.mesh.vertices) all.vertices.push_back({p.x + 1.2 * (high - low), p.y, p.z});
  for (const Face& face : rounded.mesh.faces) {
    Face& moved = all.faces.emplace_back(face);
    for (std::uint32_t& v : moved) v += first;
  }
  const MeshData cuts = bars(sum.trace->pieces, 0.0015 * (high - low));
  return format_glb(all, {colours, {}, &cuts});
}

/// A picture is drawn whatever rounding does to parts of it.
std::string picture_of(const SpatialSum& sum, const std::string& file, bool stages, const SolidOutput& how) {
  const SpatialSum::Rounded drawn = sum.drawn();
  if (const std::optional<Error> error = picture_error(drawn.mesh)) stop_for(*error, file, kExactFile);
  if (stages && sum.trace && !sum.trace->facets.empty()) return stages_of(sum, drawn, how);
  const std::vector<FaceColour> colours = colours_of(sum, drawn, how);
  const MeshData marks = tight_marks(sum);
  return format_glb(drawn.mesh, {colours, {}, &marks});
}

/// The faces that meet at a position, by number, for the positions of a sum that was rounded.
class FacesAt {
 public:
  FacesAt(const SpatialSum& sum, Precision precision) {
    for (std::uint32_t f = 0; f < sum.faces.size(); ++f)
      for (const std::uint32_t v : sum.faces[f].loops[0]) at_[key(sum.vertices[v], precision)].push_back(f);
  }
  /// The face that has all these vertices; nothing where rounding made faces of parts of several.
  std::optional<std::uint32_t> with(const Mesh& mesh, const Face& face) const {
    const auto first = at_.find(key(mesh.vertices()[face[0]], Precision::doubles));
    if (first == at_.end()) return std::nullopt;
    for (const std::uint32_t f : first->second) {
      const auto has = [&](std::uint32_t v) {
        const auto here = at_.find(key(mesh.vertices()[v], Precision::doubles));
        return here != at_.end() && std::binary_search(here->second.begin(), here->second.end(), f);
      };
      if (std::all_of(face.begin(), face.end(), has)) return f;
    }
    return std::nullopt;
  }

 private:
  static std::array<double, 3> key(const Point3& p, Precision precision) {
    const auto rounded = [&](double c) {
      return precision == Precision::doubles ? c : static_cast<double>(static_cast<float>(c));
    };
    return {rounded(p.x), rounded(p.y), rounded(p.z)};
  }
  std::map<std::array<double, 3>, std::vector<std::uint32_t>> at_;
};

/// The colours of the faces of the mesh that a convex sum became.
std::vector<FaceColour> hull_colours(const SpatialSum& sum, const Mesh& mesh, Precision precision,
                                     const SolidOutput& how) {
  const std::vector<std::size_t> of_face = face_colours(sum, how);
  std::vector<FaceColour> colours = no_faces();
  const FacesAt faces(sum, precision);
  for (std::uint32_t i = 0; i < mesh.faces().size(); ++i) {
    const std::optional<std::uint32_t> f = faces.with(mesh, mesh.faces()[i]);
    colours[f ? of_face[*f] : kSeveralKinds].faces.push_back(i);
  }
  return colours;
}

/// The hull of the rounded vertices of a convex sum, of which some may no longer be corners.
Mesh rounded_hull(const SpatialSum& sum, Precision precision, const std::string& file) {
  const Result<HulledMesh> made = sum.rounded_hull(precision);
  if (!made) stop_for(made.error(), file, kExactFile);
  // No stream: a page's module has this file as well, and streams would be a part of it.
  if (made->mesh.vertices().size() != sum.vertices.size())
    std::fprintf(stderr, "%s: rounded, %s became %zu, largest deviation %g\n", file.c_str(),
                 counted(sum.vertices.size(), "vertex", "vertices").c_str(), made->mesh.vertices().size(),
                 made->report.deviation);
  return made->mesh;
}

Mesh convex_mesh(const SpatialSum& sum, Precision precision, const std::string& file, bool hull) {
  if (hull) return rounded_hull(sum, precision, file);
  Result<Mesh> mesh = sum.rounded_mesh(precision);
  if (mesh) return std::move(mesh).value();
  if (mesh.error().code == ErrorCode::rounding_changed_topology) return rounded_hull(sum, precision, file);
  stop_for(mesh.error(), file);
}

std::string convex_text(const SpatialSum& sum, MeshFormat format, const std::string& file, const SolidOutput& how) {
  const Precision precision = precision_of(format);
  Mesh mesh = convex_mesh(sum, precision, file, how.hull);
  if (how.triangulate) mesh = triangulated(mesh).mesh;
  return mesh_text(mesh, format, file, hull_colours(sum, mesh, precision, how));
}

Json mesh_rounding_json(const SpatialSum::Rounded& rounded) {
  return {{"merged_vertices", rounded.merged_vertices},
          {"collapsed_edges", rounded.collapsed_edges},
          {"bends", rounded.bends},
          {"lost_faces", rounded.lost_faces},
          {"distance", rounded.distance},
          {"volume_change", rounded.volume_change},
          {"topology_kept", rounded.topology_kept}};
}

SpatialSum::Rounded require_rounded(const SpatialSum& sum, Precision precision, double round, const std::string& file) {
  Result<SpatialSum::Rounded> rounded = sum.rounded(precision, round);
  if (!rounded) stop_for(rounded.error(), file, std::string("--round allows more, ") + kOtherFiles);
  return *std::move(rounded);
}

}  // namespace

bool is_stage_mesh(const std::string& file) { return file.ends_with("stages.glb"); }

std::uint64_t stage_mesh_bytes(const SpatialTrace& trace) {
  // Measured: two triangles for a facet, eight for the bar along a piece, with their corners, which are numbered.
  return 900 * trace.facets.size() + 2400 * trace.pieces.size();
}

void check_solid_outputs(const std::vector<std::string>& files, const SolidOutput& how, const std::string& also) {
  for (const std::string& file : files) {
    const std::string name = format_name(file, how.to);
    if (is_json(name) || mesh_format(name)) continue;
    throw Stop(kUsage, "-o writes of solids " + also +
                           ".off .obj .stl .ply .3mf .glb or .json: " + (file == "-" ? "--to " + how.to : file));
  }
}

bool writes_mesh(const std::vector<std::string>& files, const SolidOutput& how) {
  return std::any_of(files.begin(), files.end(),
                     [&](const std::string& file) { return !is_json(format_name(file, how.to)); });
}

MeshFormat mesh_output_format(const std::string& file, const std::string& to) {
  const std::string name = format_name(file, to);
  if (!region_format(name)) return require_format(mesh_format(name));
  throw Stop(kUsage, (file == "-" ? "--to " + to : file) +
                         " is a format of planar regions; solids are written as .off .obj .stl .ply .3mf or .glb");
}

void stop_for(Error error, const std::string& file, const std::string& instead) {
  error.evidence.file = file;
  error.message += " (" + instead + ")";
  stop_with(error);
}

std::string mesh_text(const Mesh& mesh, MeshFormat format, const std::string& file,
                      const std::vector<FaceColour>& colours, const std::string& instead) {
  if (const std::optional<Error> error = rounding_error(mesh, format)) stop_for(*error, file, instead);
  return format_mesh(mesh, format, colours);
}

WrittenSolid mesh_of_sum(const SpatialSum& sum, MeshFormat format, const std::string& file, const SolidOutput& how) {
  if (sum.is_convex()) return {convex_text(sum, format, file, how), Json()};
  // What is a mesh in doubles is rounded to single precision as a mesh.
  SpatialSum::Rounded rounded = require_rounded(sum, Precision::doubles, how.round, file);
  Result<Mesh> mesh = Mesh::create(rounded.mesh);
  if (precision_of(format) == Precision::singles && (!rounded.nearest || !mesh || rounding_error(*mesh, format))) {
    rounded = require_rounded(sum, Precision::singles, how.round, file);
    mesh = Mesh::create(rounded.mesh);
  }
  if (!mesh) stop_for(mesh.error(), file);  // a set that no mesh is: no file of one would be read back
  WrittenSolid written{mesh_text(*mesh, format, file, colours_of(sum, rounded, how)), Json()};
  if (rounded.nearest) return written;
  std::fprintf(stderr, "%s: rounding: %s\n", file.c_str(), rounded.to_string().c_str());
  written.rounding = mesh_rounding_json(rounded);
  return written;
}

WrittenSolid written_solid(const SpatialSum& sum, const std::string& file, const SolidOutput& how) {
  const std::string name = format_name(file, how.to);
  if (is_json(name)) return {solid_sum_to_json(sum), Json()};
  const MeshFormat format = require(mesh_format(name));
  if (format == MeshFormat::glb) return {picture_of(sum, file, is_stage_mesh(name), how), Json()};
  return mesh_of_sum(sum, format, file, how);
}

std::string solid_output(const SpatialSum& sum, const std::string& file, const SolidOutput& how) {
  return written_solid(sum, file, how).text;
}

Error in_solid_operand(Error error, const std::vector<SolidInput>& inputs) {
  const Evidence& at = error.evidence;
  if (error.code == ErrorCode::unsupported_operand && at == Evidence()) {
    // Of a pair the second one is at fault that every position holds.
    for (const SolidInput& input : inputs)
      if (input.mesh.empty()) error.evidence.file = shown_file(input.file);
    return error;
  }
  if (!at.file.empty() || !at.vertex || !at.x || !at.y || !at.z) return error;
  const Point3 position{*at.x, *at.y, *at.z}, reflected{-*at.x, -*at.y, -*at.z};
  const auto input = std::find_if(inputs.begin(), inputs.end(), [&](const SolidInput& one) {
    const auto k = static_cast<std::size_t>(*at.vertex);
    const std::vector<Point3>& vertices = one.mesh.vertices();
    return k < vertices.size() && (vertices[k] == position || vertices[k] == reflected);
  });
  if (input == inputs.end()) return error;
  error.evidence.file = shown_file(input->file);
  const Point3& own = input->mesh.vertices()[static_cast<std::size_t>(*at.vertex)];
  error.evidence.x = own.x, error.evidence.y = own.y, error.evidence.z = own.z;
  return error;
}

}  // namespace dymsum::cli

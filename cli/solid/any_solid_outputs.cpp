#include "solid/any_solid_outputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "exit_code.h"
#include "outputs.h"
#include "solid/tight_marks.h"

namespace dymsum::cli {
namespace {

using Kind = SolidFeature::Kind;

std::string face_kind(const SpatialFace& f) {
  if (f.p.kind == Kind::face && f.q.kind == Kind::vertex) return "face_vertex";
  if (f.p.kind == Kind::vertex && f.q.kind == Kind::face) return "vertex_face";
  return f.p.kind == Kind::edge && f.q.kind == Kind::edge ? "edge_edge" : "merged";
}

Json contact_json(const SolidContact& contact) {
  return {{"p", feature_json(contact.p)}, {"q", feature_json(contact.q)}};
}

/// p and q, null where there is no contact.
Json with_contact(Json json, const std::optional<SolidContact>& contact) {
  json["p"] = contact ? feature_json(contact->p) : Json();
  json["q"] = contact ? feature_json(contact->q) : Json();
  return json;
}

Json contacts_json(const std::vector<SolidContact>& contacts) {
  Json list = Json::array();
  for (const SolidContact& contact : contacts) list.push_back(contact_json(contact));
  return list;
}

Json vertex_list(const SpatialSum& sum) {
  Json list = Json::array();
  for (std::size_t i = 0; i < sum.vertices.size(); ++i) {
    const RationalPoint3 at = sum.exact(i);
    list.push_back(with_contact({{"at", {at.x.to_double(), at.y.to_double(), at.z.to_double()}},
                                 {"exact", {at.x.to_string(), at.y.to_string(), at.z.to_string()}}},
                                sum.vertex_contacts[i]));
  }
  return list;
}

Json tight_list(const SpatialSum& sum) {
  Json faces = Json::array(), segments = Json::array(), points = Json::array();
  for (std::size_t k = 0; k < sum.tight_faces.size(); ++k)
    faces.push_back({{"loops", sum.tight_faces[k]},
                     {"front", contact_json(sum.tight_face_contacts[k][0])},
                     {"back", contact_json(sum.tight_face_contacts[k][1])}});
  for (std::size_t k = 0; k < sum.tight_segments.size(); ++k)
    segments.push_back(
        {{"vertices", sum.tight_segments[k]}, {"contacts", contacts_json(sum.tight_segment_contacts[k])}});
  for (std::size_t k = 0; k < sum.tight_points.size(); ++k)
    points.push_back({{"vertex", sum.tight_points[k]}, {"contacts", contacts_json(sum.tight_point_contacts[k])}});
  return {{"faces", std::move(faces)}, {"segments", std::move(segments)}, {"points", std::move(points)}};
}

}  // namespace

Json exact_sum_json(const SpatialSum& sum, Json json) {
  Json faces = Json::array(), edges = Json::array();
  for (const SpatialFace& f : sum.faces) {
    faces.push_back({{"kind", face_kind(f)},
                     {"p", feature_json(f.p)},
                     {"q", feature_json(f.q)},
                     {"shell", f.shell},
                     {"loops", f.loops}});
  }
  for (const SpatialEdge& e : sum.edges)
    edges.push_back(with_contact({{"vertices", {e.from, e.to}}, {"faces", e.faces}}, e.contact));
  json["vertex_list"] = vertex_list(sum);
  json["edge_list"] = std::move(edges);
  json["face_list"] = std::move(faces);
  json["tight_list"] = tight_list(sum);
  return json;
}

namespace {

/// 0 to 3: a face of P, a face of Q, two edges, several facets of different kinds.
std::size_t face_colour(const SpatialFace& face) {
  const std::string kind = face_kind(face);
  return kind == "face_vertex" ? 0 : kind == "vertex_face" ? 1 : kind == "edge_edge" ? 2 : 3;
}

std::vector<FaceColour> colours_of(const SpatialSum& sum, const SpatialSum::Rounded& rounded) {
  std::vector<FaceColour> colours{
      {{0.91, 0.64, 0.24}, {}}, {{0.36, 0.73, 0.55}, {}}, {{0.55, 0.73, 0.90}, {}}, {{0.70, 0.72, 0.75}, {}}};
  for (std::uint32_t t = 0; t < rounded.face.size(); ++t)
    colours[face_colour(sum.faces[rounded.face[t]])].faces.push_back(t);
  return colours;
}

/// The convolution at its place, and the result to the right of it.
std::string stages_of(const SpatialSum& sum, const SpatialSum::Rounded& rounded) {
  std::vector<FaceColour> colours = colours_of(sum, rounded);
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
std::string picture_of(const SpatialSum& sum, const std::string& file, bool stages) {
  const SpatialSum::Rounded drawn = sum.drawn();
  if (const std::optional<Error> error = picture_error(drawn.mesh)) stop_for(*error, file, kExactFile);
  if (stages && sum.trace && !sum.trace->facets.empty()) return stages_of(sum, drawn);
  const std::vector<FaceColour> colours = colours_of(sum, drawn);
  const MeshData marks = tight_marks(sum);
  return format_glb(drawn.mesh, {colours, {}, &marks});
}

}  // namespace

bool is_stage_mesh(const std::string& file) { return file.ends_with("stages.glb"); }

std::uint64_t stage_mesh_bytes(const SpatialTrace& trace) {
  // Measured: two triangles for a facet, eight for the bar along a piece, with their corners, which are numbered.
  return 900 * trace.facets.size() + 2400 * trace.pieces.size();
}

Json any_solid_sum_json(const SpatialSum& sum, bool exact) {
  constexpr std::size_t kMostBits = 16384;
  const std::optional<Rational> volume = exact ? std::optional(sum.volume_exact()) : sum.volume_exact_within(kMostBits);
  return {{"shells", sum.shells},
          {"vertices", sum.vertices.size()},
          {"faces", sum.faces.size()},
          {"volume", measure_json(volume_of(sum))},
          {"volume_exact", volume ? Json(volume->to_string()) : Json()},
          {"area", measure_json(surface_of(sum))},
          {"tight",
           {{"points", sum.tight_points.size()},
            {"segments", sum.tight_segments.size()},
            {"faces", sum.tight_faces.size()}}},
          {"convolution", {{"fv", sum.stats.face_vertex}, {"ee", sum.stats.edge_edge}}}};
}

namespace {

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

WrittenSolid rounded_sum_text(const SpatialSum& sum, MeshFormat format, const std::string& file, double round) {
  // What is a mesh in doubles is rounded to single precision as a mesh.
  SpatialSum::Rounded rounded = require_rounded(sum, Precision::doubles, round, file);
  Result<Mesh> mesh = Mesh::create(rounded.mesh);
  if (precision_of(format) == Precision::singles && (!rounded.nearest || !mesh || rounding_error(*mesh, format))) {
    rounded = require_rounded(sum, Precision::singles, round, file);
    mesh = Mesh::create(rounded.mesh);
  }
  if (!mesh) stop_for(mesh.error(), file);  // a set that no mesh is: no file of one would be read back
  WrittenSolid written{mesh_text(*mesh, format, file, colours_of(sum, rounded)), Json()};
  if (rounded.nearest) return written;
  std::fprintf(stderr, "%s: rounding: %s\n", file.c_str(), rounded.to_string().c_str());
  written.rounding = mesh_rounding_json(rounded);
  return written;
}

WrittenSolid written_solid(const SpatialSum& sum, const std::string& file, const SolidOutput& how) {
  const std::string name = format_name(file, how.to);
  if (name.ends_with(".json")) return {exact_sum_json(sum, any_solid_sum_json(sum, false)).dump(1) + "\n", Json()};
  const MeshFormat format = require(mesh_format(name));
  if (format == MeshFormat::glb) return {picture_of(sum, file, is_stage_mesh(name)), Json()};
  return rounded_sum_text(sum, format, file, how.round);
}

std::string any_solid_output(const SpatialSum& sum, const std::string& file, const SolidOutput& how) {
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
  const Point3 place{*at.x, *at.y, *at.z}, reflected{-*at.x, -*at.y, -*at.z};
  const auto input = std::find_if(inputs.begin(), inputs.end(), [&](const SolidInput& one) {
    const auto k = static_cast<std::size_t>(*at.vertex);
    const std::vector<Point3>& vertices = one.mesh.vertices();
    return k < vertices.size() && (vertices[k] == place || vertices[k] == reflected);
  });
  if (input == inputs.end()) return error;
  error.evidence.file = shown_file(input->file);
  const Point3& own = input->mesh.vertices()[static_cast<std::size_t>(*at.vertex)];
  error.evidence.x = own.x, error.evidence.y = own.y, error.evidence.z = own.z;
  return error;
}

}  // namespace dymsum::cli

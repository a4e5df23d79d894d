#include "solid/solid_outputs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "exit_code.h"
#include "outputs.h"

namespace dymsum::cli {
namespace {

using Kind = SolidFeature::Kind;

/// The vertex, or the edge between two.
Json between(std::uint32_t a, std::uint32_t b) {
  if (a == b) return feature_json({Kind::vertex, a, 0});
  return feature_json({Kind::edge, std::min(a, b), std::max(a, b)});
}

/// Every edge with the two facets beside it, and what touches along it.
Json edge_list(const SolidSum& sum) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> facets;
  for (std::uint32_t f = 0; f < sum.facets.size(); ++f) {
    const std::vector<std::uint32_t>& loop = sum.facets[f].vertices;
    for (std::size_t k = 0; k < loop.size(); ++k)
      facets[std::minmax(loop[k], loop[(k + 1) % loop.size()])].push_back(f);
  }
  Json list = Json::array();
  for (const auto& [ends, faces] : facets) {
    const SolidSum::Vertex &a = sum.vertices[ends.first], &b = sum.vertices[ends.second];
    list.push_back({{"vertices", {ends.first, ends.second}},
                    {"faces", faces},
                    {"p", between(a.p, b.p)},
                    {"q", between(a.q, b.q)}});
  }
  return list;
}

/// With the keys of sums of any shape: one shell, faces without holes, nothing tight.
Json exact_json(const SolidSum& sum) {
  Json vertices = Json::array(), faces = Json::array();
  for (std::size_t i = 0; i < sum.vertices.size(); ++i) {
    const RationalPoint3 at = sum.exact(i);
    vertices.push_back({{"at", {sum.at[i].x, sum.at[i].y, sum.at[i].z}},
                        {"exact", {at.x.to_string(), at.y.to_string(), at.z.to_string()}},
                        {"p", feature_json({Kind::vertex, sum.vertices[i].p, 0})},
                        {"q", feature_json({Kind::vertex, sum.vertices[i].q, 0})}});
  }
  for (const SolidFacet& f : sum.facets)
    faces.push_back({{"kind", facet_kind(f)},
                     {"p", feature_json(f.p)},
                     {"q", feature_json(f.q)},
                     {"shell", 0},
                     {"loops", Json::array({f.vertices})}});
  Json json = solid_sum_json(sum);
  json["vertex_list"] = std::move(vertices);
  json["edge_list"] = edge_list(sum);
  json["face_list"] = std::move(faces);
  json["tight_list"] = {{"faces", Json::array()}, {"segments", Json::array()}, {"points", Json::array()}};
  return json;
}

bool is_json(const std::string& file) { return file.ends_with(".json"); }

}  // namespace

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

std::string facet_kind(const SolidFacet& f) {
  if (f.p.kind == Kind::face && f.q.kind == Kind::vertex) return "face_vertex";
  if (f.p.kind == Kind::vertex && f.q.kind == Kind::face) return "vertex_face";
  if (f.p.kind == Kind::edge && f.q.kind == Kind::edge) return "edge_edge";
  return "merged";
}

namespace {

/// The facets that meet at a place, by number, for the places of a sum that was rounded.
class FacetsAt {
 public:
  FacetsAt(const SolidSum& sum, Precision precision) {
    for (std::uint32_t f = 0; f < sum.facets.size(); ++f)
      for (const std::uint32_t v : sum.facets[f].vertices) at_[key(sum.at[v], precision)].push_back(f);
  }
  /// The facet that has all these vertices; nothing where rounding made faces of parts of several.
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

/// The hull of rounded vertices, of which some may no longer be corners.
Mesh rounded_hull(const SolidSum& sum, Precision precision, const std::string& file, bool picture) {
  const Result<HulledMesh> made = sum.rounded_hull(precision);
  if (!made) stop_for(made.error(), file, kExactFile);
  const HulledMesh& hulled = *made;
  // No stream: a page's module has this file as well, and streams would be a part of it.
  if (!picture && hulled.mesh.vertices().size() != sum.vertices.size())
    std::fprintf(stderr, "%s: rounded, %s became %zu, largest deviation %g\n", file.c_str(),
                 counted(sum.vertices.size(), "vertex", "vertices").c_str(), hulled.mesh.vertices().size(),
                 hulled.report.deviation);
  return hulled.mesh;
}

Mesh rounded_mesh(const SolidSum& sum, Precision precision, const std::string& file, bool hull, bool picture) {
  if (hull || picture) return rounded_hull(sum, precision, file, !hull);
  Result<Mesh> mesh = sum.rounded_mesh(precision);
  if (mesh) return std::move(mesh).value();
  if (mesh.error().code == ErrorCode::rounding_changed_topology) return rounded_hull(sum, precision, file, false);
  stop_for(mesh.error(), file);
}

}  // namespace

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

std::vector<FaceColour> facet_colours(const SolidSum& sum, const Mesh& mesh, Precision precision) {
  std::vector<FaceColour> colours{{{0.91, 0.64, 0.24}, {}},
                                  {{0.36, 0.73, 0.55}, {}},
                                  {{0.55, 0.73, 0.90}, {}},
                                  {{0.70, 0.72, 0.75}, {}},
                                  {{0.85, 0.12, 0.20}, {}}};
  const FacetsAt facets(sum, precision);
  for (std::uint32_t i = 0; i < mesh.faces().size(); ++i) {
    const std::optional<std::uint32_t> f = facets.with(mesh, mesh.faces()[i]);
    const std::string kind = f ? facet_kind(sum.facets[*f]) : "";
    const std::size_t k = f && sum.facets[*f].changed ? 4
                          : kind == "face_vertex"     ? 0
                          : kind == "vertex_face"     ? 1
                          : kind == "edge_edge"       ? 2
                                                      : 3;
    colours[k].faces.push_back(i);
  }
  return colours;
}

std::string solid_output(const SolidSum& sum, const std::string& file, const SolidOutput& how) {
  const std::string name = format_name(file, how.to);
  if (is_json(name)) return exact_json(sum).dump(1) + "\n";
  const MeshFormat format = require(mesh_format(name));
  // A picture keeps doubles for as long as it can; what it loses in the end is judged by itself.
  const Precision precision = format == MeshFormat::glb ? Precision::doubles : precision_of(format);
  Mesh mesh = rounded_mesh(sum, precision, file, how.hull, format == MeshFormat::glb);
  if (how.triangulate) mesh = triangulated(mesh).mesh;
  return mesh_text(mesh, format, file, facet_colours(sum, mesh, precision),
                   format == MeshFormat::glb ? kExactFile : kDoubles);
}

Json feature_json(const SolidFeature& f) {
  if (f.kind == Kind::vertex) return {{"vertex", f.a}};
  if (f.kind == Kind::edge) return {{"edge", {f.a, f.b}}};
  return {{"face", f.a}};
}

FacetKinds facet_kinds(const SolidSum& sum) {
  FacetKinds kinds;
  for (const SolidFacet& f : sum.facets) (facet_kind(f) == "edge_edge" ? kinds.of_edges : kinds.with_face) += 1;
  return kinds;
}

Json solid_sum_json(const SolidSum& sum) {
  const FacetKinds kinds = facet_kinds(sum);
  return {{"shells", sum.facets.empty() ? 0 : 1},
          {"vertices", sum.vertices.size()},
          {"faces", sum.facets.size()},
          {"volume", measure_json(volume_of(sum))},
          {"volume_exact", sum.volume_exact().to_string()},
          {"area", measure_json(surface_of(sum))},
          {"tight", {{"points", 0}, {"segments", 0}, {"faces", 0}}},
          {"convolution", {{"fv", kinds.with_face}, {"ee", kinds.of_edges}}}};
}

}  // namespace dymsum::cli

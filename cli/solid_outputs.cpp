#include "solid_outputs.h"

#include <algorithm>

#include "exit_code.h"

namespace dymsum::cli {
namespace {

using Kind = SolidFeature::Kind;

Json exact_json(const SolidSum& sum) {
  Json vertices = Json::array(), facets = Json::array();
  for (std::size_t i = 0; i < sum.vertices.size(); ++i) {
    const RationalPoint3 at = sum.exact(i);
    vertices.push_back({{"at", {sum.at[i].x, sum.at[i].y, sum.at[i].z}},
                        {"exact", {at.x.to_string(), at.y.to_string(), at.z.to_string()}},
                        {"p", sum.vertices[i].p},
                        {"q", sum.vertices[i].q}});
  }
  for (const SolidFacet& f : sum.facets)
    facets.push_back({{"kind", facet_kind(f)}, {"p", feature_json(f.p)}, {"q", feature_json(f.q)}, {"vertices", f.vertices}});
  Json json = solid_sum_json(sum);
  json["vertex_list"] = std::move(vertices);
  json["facet_list"] = std::move(facets);
  return json;
}

bool is_json(const std::string& file) { return file.ends_with(".json"); }

}  // namespace

void check_solid_outputs(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (is_json(file)) continue;
    if (!mesh_format(file)) throw Stop(kUsage, "-o writes .off .obj .stl .ply .glb or .json: " + file);
  }
}

std::string facet_kind(const SolidFacet& f) {
  if (f.p.kind == Kind::face && f.q.kind == Kind::vertex) return "face_vertex";
  if (f.p.kind == Kind::vertex && f.q.kind == Kind::face) return "vertex_face";
  if (f.p.kind == Kind::edge && f.q.kind == Kind::edge) return "edge_edge";
  return "merged";
}

std::vector<FaceColour> facet_colours(const SolidSum& sum) {
  std::vector<FaceColour> colours{{{0.91f, 0.64f, 0.24f}, {}}, {{0.36f, 0.73f, 0.55f}, {}}, {{0.55f, 0.73f, 0.90f}, {}}, {{0.70f, 0.72f, 0.75f}, {}}, {{0.85f, 0.12f, 0.20f}, {}}};
  for (std::uint32_t i = 0; i < sum.facets.size(); ++i) {
    const std::string kind = facet_kind(sum.facets[i]);
    const std::size_t k = sum.facets[i].changed ? 4 : kind == "face_vertex" ? 0 : kind == "vertex_face" ? 1 : kind == "edge_edge" ? 2 : 3;
    colours[k].faces.push_back(i);
  }
  return colours;
}

std::string solid_output(const SolidSum& sum, const std::string& file) {
  if (is_json(file)) return exact_json(sum).dump(1) + "\n";
  return format_mesh(sum.rounded(), require(mesh_format(file)), facet_colours(sum));
}

Json feature_json(const SolidFeature& f) {
  if (f.kind == Kind::vertex) return {{"vertex", f.a}};
  if (f.kind == Kind::edge) return {{"edge", {f.a, f.b}}};
  return {{"face", f.a}};
}

Json solid_sum_json(const SolidSum& sum) {
  std::size_t fv = 0, ee = 0;
  for (const SolidFacet& f : sum.facets) (facet_kind(f) == "edge_edge" ? ee : fv) += 1;
  return {{"shells", sum.facets.empty() ? 0 : 1},
          {"vertices", sum.vertices.size()},
          {"faces", sum.facets.size()},
          {"volume", sum.volume()},
          {"volume_exact", sum.volume_exact().to_string()},
          {"area", sum.area()},
          {"tight", {{"points", 0}, {"segments", 0}, {"faces", 0}}},
          {"convolution", {{"fv", fv}, {"ee", ee}}}};
}

}  // namespace dymsum::cli

#include "solid/solid_json.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace dymsum::cli {
namespace {

using Kind = SolidFeature::Kind;

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

std::string face_kind(const SpatialFace& f) {
  if (f.p.kind == Kind::face && f.q.kind == Kind::vertex) return "face_vertex";
  if (f.p.kind == Kind::vertex && f.q.kind == Kind::face) return "vertex_face";
  return f.p.kind == Kind::edge && f.q.kind == Kind::edge ? "edge_edge" : "merged";
}

Json feature_json(const SolidFeature& f) {
  if (f.kind == Kind::vertex) return {{"vertex", f.a}};
  if (f.kind == Kind::edge) return {{"edge", {f.a, f.b}}};
  return {{"face", f.a}};
}

Json solid_sum_json(const SpatialSum& sum, bool exact) {
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

Json exact_sum_json(const SpatialSum& sum, Json json) {
  Json faces = Json::array(), edges = Json::array();
  for (const SpatialFace& f : sum.faces) {
    faces.push_back({{"kind", face_kind(f)},
                     {"p", feature_json(f.p)},
                     {"q", feature_json(f.q)},
                     {"shell", f.shell},
                     {"loops", f.loops}});
  }
  for (const SpatialEdge& e : sum.edges())
    edges.push_back(with_contact({{"vertices", {e.from, e.to}}, {"faces", e.faces}}, e.contact));
  json["vertex_list"] = vertex_list(sum);
  json["edge_list"] = std::move(edges);
  json["face_list"] = std::move(faces);
  json["tight_list"] = tight_list(sum);
  return json;
}

}  // namespace dymsum::cli

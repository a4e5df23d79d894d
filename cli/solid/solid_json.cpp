#include "solid/solid_json.h"

#include <optional>

namespace dymsum::cli {

using Kind = SolidFeature::Kind;

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

}  // namespace dymsum::cli

#include "dymsum/solid_union.h"

#include <algorithm>
#include <stdexcept>

#include "spatial/boolean/solid_inside.h"

namespace dymsum {

namespace {

using spatial::InsideRule;

/// Faces of a solid behind those of others, perhaps turned inside out; thin ones stay as faces that are left out.
void append(MeshData& all, const Mesh& solid, bool inside_out = false) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), solid.vertices().begin(), solid.vertices().end());
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    Face face = solid.faces()[f];
    if (solid.has_thin_parts() && solid.thin_faces()[f]) face.resize(1);
    for (std::uint32_t& v : face) v += first;
    if (inside_out) std::reverse(face.begin(), face.end());
    all.faces.push_back(std::move(face));
  }
}

Result<SpatialSum> of_two(const Mesh& a, const Mesh& b, bool b_inside_out, InsideRule rule,
                          const SpatialOptions& options) {
  MeshData all;
  append(all, a);
  append(all, b, b_inside_out);
  return spatial::solid_inside(all, rule, options);
}

InsideRule rule_of(Fill fill) {
  switch (fill) {
    case Fill::positive:
      return {};
    case Fill::nonzero:
      return {1, true, false};
    case Fill::even_odd:
      return {1, true, true};
  }
  throw std::invalid_argument("no fill");
}

}  // namespace

Result<SpatialSum> united(const MeshData& surface, Fill fill, const SpatialOptions& options) {
  return spatial::solid_inside(surface, rule_of(fill), options);
}

Result<SpatialSum> united(std::span<const Mesh> solids, const SpatialOptions& options) {
  MeshData all;
  for (const Mesh& solid : solids) append(all, solid);
  return spatial::solid_inside(all, {}, options);
}

Result<SpatialSum> intersection(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return of_two(a, b, false, {2, false, false}, options);
}

Result<SpatialSum> intersection(std::span<const Mesh> solids, const SpatialOptions& options) {
  if (solids.empty()) return Error{ErrorCode::out_of_range, "an intersection takes at least one solid, not 0", {}};
  MeshData all;
  for (const Mesh& solid : solids) append(all, solid);
  return spatial::solid_inside(all, {static_cast<int>(solids.size()), false, false}, options);
}

Result<SpatialSum> difference(const Mesh& a, std::span<const Mesh> taken, const SpatialOptions& options) {
  MeshData all;
  append(all, a);
  for (const Mesh& solid : taken) append(all, solid, true);
  return spatial::solid_inside(all, {}, options);
}

Result<SpatialSum> difference(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return of_two(a, b, true, {}, options);
}

Result<SpatialSum> symmetric_difference(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return of_two(a, b, false, {1, true, true}, options);
}

}  // namespace dymsum

#include "spatial/moving/sum_shape.h"

#include <algorithm>
#include <map>

#include "spatial/moving/shape_hashes.h"
#include "spatial/moving/shell_euler.h"

namespace dymsum::spatial {

namespace {

using Names = std::vector<std::uint64_t>;
using Loops = std::vector<std::vector<std::uint32_t>>;

/// A hash of a cyclic list, wherever it begins.
std::uint64_t cyclic_hash(const Names& ring) {
  const std::size_t n = ring.size();
  std::size_t i = 0, j = 1, k = 0;
  while (i < n && j < n && k < n) {
    const std::uint64_t a = ring[(i + k) % n], b = ring[(j + k) % n];
    if (a == b) {
      ++k;
      continue;
    }
    (a > b ? i : j) += k + 1;
    if (i == j) ++j;
    k = 0;
  }
  std::uint64_t h = n;
  for (std::size_t m = 0; m < n; ++m) h = mixed(h, ring[(std::min(i, j) + m) % n]);
  return h;
}

/// Names of the parts of a sum, made of those of planes.
class PartNames {
 public:
  PartNames(const SpatialSum& sum, const PlaneName& plane_name)
      : sum_(sum), plane_name_(plane_name), edges_(sum.edges()) {
    std::vector<Names> around(sum.vertices.size());
    for (const SpatialFace& face : sum.faces) {
      plane_.push_back(plane({face.p, face.q}));
      for (const auto& loop : face.loops)
        for (const std::uint32_t v : loop) around[v].push_back(plane_.back());
    }
    for (Names& faces : around) vertex_.push_back(mixed_list(13, faces));
  }

  std::uint64_t face(std::size_t f) const { return mixed(plane_[f], loops(sum_.faces[f].loops)); }
  /// Which of its sides is the front one depends on positions, and so does the sense of its loops.
  std::uint64_t tight_face(std::size_t t) {
    Names corners;
    for (const auto& loop : sum_.tight_faces[t])
      for (const std::uint32_t v : loop) corners.push_back(vertex_[v]);
    return mixed(mixed(29, plane(sum_.tight_face_contacts[t][0])), mixed_list(19, corners));
  }

 private:
  std::uint64_t plane(const SolidContact& c) {
    const auto [at, fresh] = known_.try_emplace(c, 0);
    if (fresh) at->second = plane_name_(c);
    return at->second;
  }
  std::uint64_t edge(std::uint32_t a, std::uint32_t b) const {
    const std::pair ends{std::min(a, b), std::max(a, b)};
    const auto at = std::lower_bound(edges_.begin(), edges_.end(), ends, [](const SpatialEdge& e, const auto& v) {
      return std::pair{e.from, e.to} < v;
    });
    Names faces;
    if (at != edges_.end() && at->from == ends.first && at->to == ends.second)
      for (const std::uint32_t f : at->faces) faces.push_back(plane_[f]);
    return mixed_list(17, faces);
  }
  std::uint64_t loops(const Loops& all) const {
    Names names;
    for (const auto& loop : all) {
      Names ring;
      for (std::size_t k = 0; k < loop.size(); ++k)
        ring.push_back(mixed(vertex_[loop[k]], edge(loop[k], loop[(k + 1) % loop.size()])));
      names.push_back(cyclic_hash(ring));
    }
    return mixed_list(19, names);
  }

  const SpatialSum& sum_;
  const PlaneName& plane_name_;
  std::vector<SpatialEdge> edges_;
  std::map<SolidContact, std::uint64_t> known_;
  Names plane_, vertex_;  // of faces, of vertices
};

}  // namespace

SumShape shape_of(const SpatialSum& sum, const PlaneName& plane_name) {
  SumShape shape;
  shape.topology.euler = shell_euler_numbers(sum);
  shape.topology.tight = {sum.tight_faces.size(), sum.tight_segments.size(), sum.tight_points.size()};
  PartNames names(sum, plane_name);
  std::vector<Names> shells(sum.shells);
  for (std::size_t f = 0; f < sum.faces.size(); ++f) shells[sum.faces[f].shell].push_back(names.face(f));
  Names parts;
  for (Names& faces : shells) parts.push_back(mixed_list(23, faces));
  for (std::size_t t = 0; t < sum.tight_faces.size(); ++t) parts.push_back(names.tight_face(t));
  for (const std::size_t count : shape.topology.tight) parts.push_back(mixed(31, count));
  shape.hash = mixed_list(41, parts);
  return shape;
}

ShapeChange change_of(const SumShape& before, const std::optional<SumShape>& at, const SumShape& after) {
  const SumShape& here = at ? *at : after;
  return {!(before == here) || !(here == after),
          !(before.topology == here.topology) || !(here.topology == after.topology)};
}

}  // namespace dymsum::spatial

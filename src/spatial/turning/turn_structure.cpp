#include "spatial/turning/turn_structure.h"

#include <algorithm>
#include <map>

#include "spatial/turning/plane_hashes.h"

namespace dymsum::spatial {

namespace {

/// Names of planes: see PlaneHashes. Two planes with one name are a coincidence of one in 2^60.
class PlaneNames {
 public:
  explicit PlaneNames(const TurningPair& pair) : pair_(pair), frame_(pair, 0) {}

  std::uint64_t of(const SolidContact& c) {
    const auto [at, fresh] = known_.emplace(c, 0);
    if (fresh) at->second = name(c);
    return at->second;
  }

 private:
  std::uint32_t vertex_of(int op, const SolidFeature& f) const {
    return f.kind == SolidFeature::Kind::face ? pair_.operand(op).triangles[triangle_of(op, f.a)][0] : f.a;
  }
  std::uint32_t triangle_of(int op, std::uint32_t face) const {
    const std::vector<std::uint32_t>& faces = pair_.operand(op).face;
    return static_cast<std::uint32_t>(std::find(faces.begin(), faces.end(), face) - faces.begin());
  }
  PolynomialFrame::Vector normal(const SolidContact& c) const {
    for (int op = 0; op < 2; ++op) {
      const SolidFeature& f = op == 0 ? c.p : c.q;
      if (f.kind != SolidFeature::Kind::face) continue;
      const Triangle& t = pair_.operand(op).triangles[triangle_of(op, f.a)];
      return frame_.normal(op, t[0], t[1], t[2]);
    }
    return frame_.across(c.p.a, c.p.b, c.q.a, c.q.b);
  }

  std::uint64_t name(const SolidContact& c) const {
    const PolynomialFrame::Vector n = normal(c);
    return PlaneHashes(pair_, 0).of(n, {vertex_of(0, c.p), vertex_of(1, c.q)});
  }

  const TurningPair& pair_;
  PolynomialFrame frame_;
  std::map<SolidContact, std::uint64_t> known_;
};

std::uint64_t hash_of(std::vector<std::uint64_t>& names) {
  std::sort(names.begin(), names.end());
  std::uint64_t hash = names.size();
  for (const std::uint64_t n : names) hash = joined_hashes(hash, n);
  return hash;
}

}  // namespace

SolidTopology topology_of(const SpatialSum& sum) {
  SolidTopology topology{sum.shells, sum.tight_faces.size(), sum.tight_segments.size(), sum.tight_points.size(), 0};
  std::vector<bool> used(sum.vertices.size());
  for (const SpatialFace& f : sum.faces) {
    topology.euler += 2 - static_cast<std::int64_t>(f.loops.size());
    for (const auto& loop : f.loops)
      for (const std::uint32_t v : loop) used[v] = true;
  }
  topology.euler += std::count(used.begin(), used.end(), true) - static_cast<std::int64_t>(sum.edges.size());
  return topology;
}

std::uint64_t structure_hash(const TurningPair& pair, const SpatialSum& sum) {
  PlaneNames planes(pair);
  std::vector<std::uint64_t> face(sum.faces.size());
  std::vector<std::vector<std::uint64_t>> around(sum.vertices.size());
  for (std::size_t f = 0; f < sum.faces.size(); ++f) {
    face[f] = planes.of({sum.faces[f].p, sum.faces[f].q});
    for (const auto& loop : sum.faces[f].loops)
      for (const std::uint32_t v : loop) around[v].push_back(face[f]);
  }
  std::vector<std::uint64_t> vertex, parts;
  for (auto& names : around) vertex.push_back(hash_of(names));
  for (const SpatialEdge& e : sum.edges) {
    std::vector<std::uint64_t> beside, ends{vertex[e.from], vertex[e.to]};
    for (const std::uint32_t f : e.faces) beside.push_back(face[f]);
    parts.push_back(joined_hashes(hash_of(beside), hash_of(ends)));
  }
  for (std::size_t f = 0; f < sum.faces.size(); ++f) {
    std::vector<std::uint64_t> loops;
    for (const auto& loop : sum.faces[f].loops) loops.push_back(loop.size());
    parts.push_back(joined_hashes(face[f], hash_of(loops)));
  }
  const SolidTopology topology = topology_of(sum);
  for (const std::size_t n : {topology.shells, topology.tight_faces, topology.tight_segments, topology.tight_points})
    parts.push_back(joined_hashes(0x7469676874ULL, n));
  return hash_of(parts);
}

}  // namespace dymsum::spatial

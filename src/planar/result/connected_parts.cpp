#include "planar/result/connected_parts.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "planar/result/part_nesting.h"
#include "planar/result/ring_visits.h"
#include "planar/result/sum_skeleton.h"

namespace dymsum::planar {
namespace {

/// Visits in the order of a ring.
using Path = std::vector<std::uint32_t>;

/// Simple rings of visits: a ring that comes back to a position is cut there.
std::vector<Path> simple_paths(const SumSkeleton& skeleton, const std::vector<RingVisits::Visit>& visits) {
  std::vector<Path> paths;
  std::vector<std::uint8_t> seen(visits.size(), 0);
  for (std::uint32_t start = 0; start < visits.size(); ++start) {
    Path path;
    std::map<std::uint32_t, std::size_t> at;  // position -> length of the path before it
    for (std::uint32_t v = start; seen[v] == 0; v = visits[v].next) {
      seen[v] = 1;
      const std::uint32_t position = skeleton.position[visits[v].vertex];
      if (const auto back = at.find(position); back != at.end()) {
        const std::size_t before = back->second;
        paths.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(before), path.end());
        for (const std::uint32_t w : paths.back()) at.erase(skeleton.position[visits[w].vertex]);
        path.resize(before);
      }
      at[position] = path.size();
      path.push_back(v);
    }
    if (!path.empty()) paths.push_back(std::move(path));
  }
  return paths;
}

/// The vertices of a sum in the order of its skeleton.
std::vector<const SumVertex*> vertices_of(const PlanarSum& sum) {
  std::vector<const SumVertex*> vertices;
  for_each_vertex(sum, [&](const SumVertex& v) { vertices.push_back(&v); });
  return vertices;
}

/// Writes rings of visits as rings of a sum.
class RingWriter {
 public:
  RingWriter(const PlanarSum& sum, const SumSkeleton& skeleton, const RingVisits& rings)
      : skeleton_(skeleton), visits_(rings.visits()), vertices_(vertices_of(sum)) {
    // A position that is a sum of two vertices is that of every visit there.
    for (const auto& [position, here] : rings.at())
      for (const std::uint32_t v : here)
        if (vertices_[visits_[v].vertex]->corner_p != SumVertex::kNone)
          corner_[position] = vertices_[visits_[v].vertex];
  }

  SumRing ring(const Path& path) const {
    SumRing out;
    for (std::size_t k = 0; k < path.size(); ++k) {
      const std::uint32_t before = path[(k + path.size() - 1) % path.size()], after = path[(k + 1) % path.size()];
      const std::uint32_t here = visits_[path[k]].vertex;
      if (orientation(spot(before), spot(path[k]), spot(after)) == 0) continue;  // straight on
      SumVertex v = *vertices_[here];
      v.in = vertices_[visits_[before].edge]->out;
      v.out = vertices_[visits_[path[k]].edge]->out;
      const auto corner = corner_.find(skeleton_.position[here]);
      v.corner_p = corner == corner_.end() ? SumVertex::kNone : corner->second->corner_p;
      v.corner_q = corner == corner_.end() ? SumVertex::kNone : corner->second->corner_q;
      if (corner != corner_.end()) v.at = corner->second->at;
      out.vertices.push_back(v);
    }
    return out;
  }

  /// The corner at the lexicographically smallest position bends as the ring does.
  bool counter_clockwise(const Path& path) const {
    const auto before = [&](std::uint32_t a, std::uint32_t b) { return compare(spot(a), spot(b)) < 0; };
    const auto least = std::min_element(path.begin(), path.end(), before);
    const auto k = static_cast<std::size_t>(least - path.begin());
    return orientation(spot(path[(k + path.size() - 1) % path.size()]), spot(path[k]),
                       spot(path[(k + 1) % path.size()])) > 0;
  }

 private:
  const Spot& spot(std::uint32_t visit) const { return skeleton_.spot(visits_[visit].vertex); }

  const SumSkeleton& skeleton_;
  const std::vector<RingVisits::Visit>& visits_;
  std::vector<const SumVertex*> vertices_;
  std::map<std::uint32_t, const SumVertex*> corner_;  // by position
};

bool has_holes(const SumPart& part) { return !part.holes.empty(); }

}  // namespace

void separate_parts(PlanarSum& sum) {
  if (std::none_of(sum.parts.begin(), sum.parts.end(), has_holes)) return;
  const SumSkeleton skeleton(sum);
  const RingVisits rings(skeleton);
  const auto shared = [](const auto& here) { return here.second.size() > 1; };
  if (std::count_if(rings.at().begin(), rings.at().end(), shared) < 2) return;
  const RingWriter writer(sum, skeleton, rings);
  std::vector<SumRing> joined;
  std::vector<std::uint8_t> outer;
  for (const Path& path : simple_paths(skeleton, rings.visits())) {
    joined.push_back(writer.ring(path));
    outer.push_back(writer.counter_clockwise(path));
  }
  const ExactSource& source = *exact_source(sum);
  std::vector<SumPart> parts = group_rings(std::move(joined), outer, source, sum.at_error);
  canonicalize(parts, source, sum.at_error);
  sum.parts = std::move(parts);
}

}  // namespace dymsum::planar

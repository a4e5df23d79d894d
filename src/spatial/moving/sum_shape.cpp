#include "spatial/moving/sum_shape.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/scratch.h"
#include "exact/big.h"

namespace dymsum::spatial {
namespace {

using Vector = std::array<exact::BigRational, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
int sign_of_product(const Vector& a, const Vector& b) {
  return exact::BigRational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).sign();
}

/// A side of a face: a piece of a loop from a vertex to the next one. Its corner of the face is that at `from`.
struct Side {
  std::uint32_t from = 0, to = 0, face = 0, next = 0;
};

std::vector<Side> sides_of(const SpatialSum& sum) {
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < sum.faces.size(); ++f)
    for (const auto& loop : sum.faces[f].loops) {
      const auto first = static_cast<std::uint32_t>(sides.size()), n = static_cast<std::uint32_t>(loop.size());
      for (std::uint32_t k = 0; k < n; ++k) sides.push_back({loop[k], loop[(k + 1) % n], f, first + (k + 1) % n});
    }
  return sides;
}

class SidesAroundEdge {
 public:
  SidesAroundEdge(const SpatialSum& sum, const std::vector<Side>& sides) : sum_(sum), sides_(sides) {}

  /// Sorts sides along one edge, of four faces or more, so that each two bound one wedge of the outside.
  void pair(std::vector<std::uint32_t>& around) {
    const auto [a, b] = std::minmax(sides_[around[0]].from, sides_[around[0]].to);
    along_ = minus(position(b), position(a));
    std::vector<Around> order;
    for (const std::uint32_t s : around) {
      const Vector n = normal(sides_[s].face);
      order.push_back({s, sides_[s].from == a ? cross(n, along_) : cross(along_, n)});
    }
    std::sort(order.begin() + 1, order.end(),
              [&](const Around& i, const Around& j) { return is_before(order[0], i, j); });
    // A face that runs from a to b has the outside counter-clockwise of it, seen against the edge.
    if (sides_[order[0].side].from != a) std::rotate(order.begin(), order.begin() + 1, order.end());
    for (std::size_t k = 0; k < order.size(); ++k) around[k] = order[k].side;
  }

 private:
  struct Around {
    std::uint32_t side;
    Vector in;  // into the face, across the edge
  };
  Vector position(std::uint32_t v) const {
    const RationalPoint3 p = sum_.exact(v);
    return {exact::exact_value(p.x), exact::exact_value(p.y), exact::exact_value(p.z)};
  }
  Vector normal(std::uint32_t face) const {
    const std::vector<std::uint32_t>& loop = sum_.faces[face].loops[0];
    const Vector origin = position(loop[0]);
    Vector n{0, 0, 0};
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      n = plus(n, cross(minus(position(loop[k]), origin), minus(position(loop[k + 1]), origin)));
    return n;
  }
  /// Counter-clockwise about the edge, from the first one on.
  bool is_before(const Around& first, const Around& i, const Around& j) const {
    const int a = half(first, i), b = half(first, j);
    return a != b ? a < b : turn(i, j) > 0;
  }
  int turn(const Around& i, const Around& j) const { return sign_of_product(along_, cross(i.in, j.in)); }
  int half(const Around& first, const Around& i) const {
    const int side = turn(first, i);
    return side > 0 || (side == 0 && sign_of_product(first.in, i.in) > 0) ? 0 : 1;
  }

  const SpatialSum& sum_;
  const std::vector<Side>& sides_;
  Vector along_;
};

}  // namespace

std::vector<std::int64_t> shell_euler_numbers(const SpatialSum& sum) {
  const std::vector<Side> sides = sides_of(sum);
  std::vector<std::uint32_t> order(sides.size());
  for (std::uint32_t s = 0; s < order.size(); ++s) order[s] = s;
  const auto ends = [&](std::uint32_t s) { return std::minmax(sides[s].from, sides[s].to); };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t s, std::uint32_t t) { return ends(s) != ends(t) ? ends(s) < ends(t) : s < t; });
  UnionFind corners(static_cast<std::uint32_t>(sides.size()));  // of one surface at one vertex
  SidesAroundEdge edges(sum, sides);
  for (std::size_t i = 0, j = 0; i < order.size(); i = j) {
    while (j < order.size() && ends(order[j]) == ends(order[i])) ++j;
    std::vector<std::uint32_t> around(order.begin() + static_cast<std::ptrdiff_t>(i),
                                      order.begin() + static_cast<std::ptrdiff_t>(j));
    if (around.size() > 2) edges.pair(around);
    for (std::size_t k = 0; k + 1 < around.size(); k += 2) {
      const std::uint32_t s = around[k], t = around[k + 1];
      corners.unite(s, sides[t].next), corners.unite(t, sides[s].next);
    }
  }
  std::vector<std::int64_t> euler(sum.shells), halves(sum.shells);
  for (const SpatialFace& face : sum.faces) euler[face.shell] += 2 - static_cast<std::int64_t>(face.loops.size());
  for (std::uint32_t s = 0; s < sides.size(); ++s) {
    const std::uint32_t shell = sum.faces[sides[s].face].shell;
    ++halves[shell], euler[shell] += corners.root(s) == s;
  }
  for (std::size_t s = 0; s < euler.size(); ++s) euler[s] -= halves[s] / 2;
  std::sort(euler.begin(), euler.end());
  return euler;
}

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

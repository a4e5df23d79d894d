#include "spatial/sum/feature_pairs.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace dymsum::spatial {
namespace {

using exact::BigRational;

/// Whether b lies on the segment from a to c: all coordinates in one proportion.
bool between(const SumSpace& space, const PointTable& points, PointId a, PointId b, PointId c) {
  BigRational u[3], v[3];
  for (int axis = 0; axis < 3; ++axis) {
    const BigRational midpoint = space.exact_coordinate(points.source(b), axis);
    u[axis] = midpoint - space.exact_coordinate(points.source(a), axis);
    v[axis] = space.exact_coordinate(points.source(c), axis) - midpoint;
  }
  return u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] &&
         u[0] * v[0] + u[1] * v[1] + u[2] * v[2] > 0;
}

}  // namespace

std::vector<TightLine> joined_lines(const SumSpace& space, const PointTable& points,
                                    std::span<const std::array<PointId, 2>> pieces) {
  // Ends as 2 k for the first and 2 k + 1 for the second one of piece k, by points.
  const auto at = [&](std::uint32_t end) { return pieces[end / 2][end % 2]; };
  std::vector<std::uint32_t> ends(2 * pieces.size()), next(ends.size(), kNoId);
  for (std::uint32_t e = 0; e < ends.size(); ++e) ends[e] = e;
  std::sort(ends.begin(), ends.end(),
            [&](std::uint32_t a, std::uint32_t b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
  for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
    while (last < ends.size() && at(ends[last]) == at(ends[first])) ++last;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t j = i + 1; j < last; ++j)
        if (between(space, points, at(ends[i] ^ 1), at(ends[i]), at(ends[j] ^ 1)))
          next[ends[i]] = ends[j], next[ends[j]] = ends[i];
  }
  std::vector<TightLine> lines;
  for (std::uint32_t e = 0; e < next.size(); ++e) {
    if (next[e] != kNoId) continue;
    std::uint32_t to = e ^ 1;
    while (next[to] != kNoId) to = next[to] ^ 1;
    if (e < to) lines.push_back({at(e), at(to), e / 2, to / 2});
  }
  return lines;
}

namespace {

using Kind = SolidFeature::Kind;

std::uint64_t key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

std::unordered_map<std::uint64_t, std::uint32_t> diagonals(const SolidOperand& solid) {
  std::unordered_map<std::uint64_t, std::uint32_t> found;
  for (const Wedge& w : solid.wedges) {
    if (w.is_segment() || w.bend != Wedge::Bend::flat) continue;
    if (solid.face[w.left] == solid.face[w.right]) found.emplace(key(w.from, w.to), solid.face[w.left]);
  }
  return found;
}

SolidFeature edge_feature(std::uint32_t a, std::uint32_t b) { return {Kind::edge, std::min(a, b), std::max(a, b)}; }

std::vector<Box> facet_boxes(const SumSpace& space, const FacetTable& table) {
  std::vector<Box> boxes;
  boxes.reserve(table.facets.size());
  for (const TableFacet& f : table.facets) {
    Box box;
    for (int k = 0; k < f.facet.corners; ++k) box.add(space.approx(f.facet.corner[k]));
    box.grow(space.sum_radius());
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

FeaturePairs::FeaturePairs(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q,
                           StageWatch& watch)
    : boundary_(boundary),
      space_(*boundary.space),
      arrangement_(*boundary.arrangement),
      p_(p),
      q_(q),
      diagonal_{diagonals(p), diagonals(q)} {
  if (!boundary.tight.segments.empty() || !boundary.tight.points.empty())
    facets_ = BoxTree(facet_boxes(space_, boundary.table), watch.threads());
  const std::vector<SumEdge>& edges = space_.edges();
  first_end_.assign(space_.p().size() + 1, 0);
  for (const SumEdge& edge : edges) ++first_end_[edge.from.p + 1], ++first_end_[edge.to.p + 1];
  std::partial_sum(first_end_.begin(), first_end_.end(), first_end_.begin());
  ends_.resize(2 * edges.size());
  std::vector<std::uint32_t> position(first_end_.begin(), first_end_.end() - 1);
  for (EdgeId e = 0; e < edges.size(); ++e)
    for (const SumPoint end : {edges[e].from, edges[e].to}) ends_[position[end.p]++] = {end.q, e};
}

// The facets of a group tile or overlap, and which of them cover a position depends on nothing but the sum and its
// convolution. Of thin parts in both operands, and of surfaces that
// cross, either side of a facet may be free.
SolidContact FeaturePairs::of_face(const Position& position, int side) const {
  std::optional<SolidContact> least;
  for (const std::uint32_t f : position.group.facets) {
    const TableFacet& facet = boundary_.table.facets[f];
    if (facet.side != side && !boundary_.either_side) continue;
    const SolidContact contact = features(facet.facet);
    if ((!least || contact < *least) && covers(facet, position)) least = contact;
  }
  if (!least) throw std::logic_error("solid sum: a face without a facet");
  return *least;
}

/// Calls f for the edges of sums that a point's source tells to hold it.
template <class F>
void FeaturePairs::for_each_edge_at(PointId at, F f) const {
  const PointSource& source = arrangement_.points.source(at);
  if (source.kind == PointSource::Kind::edge) f(source.a);
  if (source.kind != PointSource::Kind::sum) return;
  for (std::uint32_t k = first_end_[source.a]; k < first_end_[source.a + 1]; ++k)
    if (ends_[k].q == source.b) f(ends_[k].edge);
}

std::optional<SolidContact> FeaturePairs::of_edge(PointId a, PointId b) const {
  std::optional<SumEdge> least;
  for (const auto& [from, to] : {std::pair{a, b}, {b, a}}) {
    for_each_edge_at(from, [&, from = from, to = to](EdgeId e) {
      const SumEdge& edge = space_.edges()[e];
      if (least && !(edge < *least)) return;
      if ((is_named_by(from, e) && is_named_by(to, e)) || runs_along(edge, from, to)) least = edge;
    });
  }
  return least ? std::optional(features(*least)) : std::nullopt;
}

std::optional<SolidContact> FeaturePairs::of_point(PointId at) const {
  const PointSource& source = arrangement_.points.source(at);
  if (source.kind == PointSource::Kind::sum)
    return SolidContact{{Kind::vertex, source.a, 0}, {Kind::vertex, source.b, 0}};
  if (source.kind == PointSource::Kind::edge) return features(space_.edges()[source.a]);
  return std::nullopt;
}

std::vector<SolidContact> FeaturePairs::of_facets_along(PointId at, PointId to) const {
  const Approx& first = arrangement_.points.approx(at);
  Box box;
  box.add(first.at);
  box.grow(first.radius + space_.span() * 0x1p-50);
  std::vector<SolidContact> contacts;
  facets_.for_each(box, [&](std::uint32_t f) {
    const TableFacet& facet = boundary_.table.facets[f];
    if (is_on(facet, at) && is_on(facet, to) && holds_start(facet, at, to)) contacts.push_back(features(facet.facet));
  });
  std::sort(contacts.begin(), contacts.end());
  contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
  return contacts;
}

/// Whether the convex facet covers the position.
bool FeaturePairs::covers(const TableFacet& facet, const Position& position) const {
  if (position.group.facets.size() == 1) return true;
  if (!holds_start(facet, position.from, position.to)) return false;
  // The facet is to the left of its facet edges, seen from its own side.
  for (int i = 0; i < facet.facet.corners; ++i) {
    if (side_of_facet_edge(facet, i, position.from) != 0 || side_of_facet_edge(facet, i, position.to) != 0) continue;
    const SumPoint a = facet.facet.corner[i], b = facet.facet.corner[(i + 1) % facet.facet.corners];
    if (runs_with(a, b, position.from, position.to) != (facet.side == position.seen_from)) return false;
  }
  return true;
}

/// Whether a facet holds a point of its plane and what is near it on the way to another one there.
bool FeaturePairs::holds_start(const TableFacet& facet, PointId at, PointId to) const {
  for (int i = 0; i < facet.facet.corners; ++i) {
    const int here = side_of_facet_edge(facet, i, at);
    if (here < 0 || (here == 0 && at != to && side_of_facet_edge(facet, i, to) < 0)) return false;
  }
  return true;
}

bool FeaturePairs::is_on(const TableFacet& facet, PointId at) const {
  return space_.side(facet.plane, arrangement_.points.source(at), arrangement_.points.approx(at)) == 0;
}

/// 1 to the left of the facet edge, 0 on its line, -1 to the right, seen against the facet's normal; requires a point
/// in the facet's plane.
int FeaturePairs::side_of_facet_edge(const TableFacet& facet, int facet_edge, PointId at) const {
  const int n = facet.facet.corners;
  const SumPoint a = facet.facet.corner[facet_edge], b = facet.facet.corner[(facet_edge + 1) % n];
  const Vec3 normal = static_cast<double>(facet.side) * space_.plane(facet.plane).n;
  const Vec3 from = space_.approx(a), d = space_.approx(b) - from;
  const Approx& p = arrangement_.points.approx(at);
  const Vec3 w = p.at - from;
  const double v = dot(normal, cross(d, w));
  const double size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + 4 * space_.sum_radius();
  // The error of a short facet edge: the ends' own errors count most: they are off by twice the radius.
  const double error = size * (space_.span() * 0x1p-46 + 4 * p.radius + 16 * space_.sum_radius()) +
                       8 * space_.sum_radius() * (std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
  if (v > error) return 1;
  if (v < -error) return -1;
  return exact_side_of_facet_edge(facet, a, b, at);
}

int FeaturePairs::exact_side_of_facet_edge(const TableFacet& facet, SumPoint a, SumPoint b, PointId at) const {
  const PointSource& source = arrangement_.points.source(at);
  if (source.kind == PointSource::Kind::sum && (SumPoint{source.a, source.b} == a || SumPoint{source.a, source.b} == b))
    return 0;
  if (source.kind == PointSource::Kind::edge) {
    const SumEdge& edge = space_.edges()[source.a];
    if (edge == SumEdge{a, b} || edge == SumEdge{b, a}) return 0;
  }
  const DirectionSource along = a.q == b.q ? DirectionSource{DirectionSource::Of::p, a.p, b.p}
                                           : DirectionSource{DirectionSource::Of::q, a.q, b.q};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const int up = space_.exact_normal(facet.plane, static_cast<int>(axis)) * facet.side;
    if (up == 0) continue;
    // Along the axis e the way d to the point w turns to the left: e . (d x w) = -(d x e) . w.
    const PlaneSource upright{a, along, {DirectionSource::Of::axis, axis, 0}, false};
    return -space_.exact_side(upright, Flag{source, 0, 0, 0, 0, 0}) * up;
  }
  throw std::logic_error("solid sum: a plane without a normal");
}

/// Whether two parallel ways have one direction.
bool FeaturePairs::runs_with(SumPoint a, SumPoint b, PointId from, PointId to) const {
  const auto source = [](SumPoint s) { return PointSource{PointSource::Kind::sum, s.p, s.q, 0}; };
  for (int axis = 0; axis < 3; ++axis)
    if (const int s = space_.exact_order(source(a), source(b), axis))
      return s == space_.exact_order(arrangement_.points.source(from), arrangement_.points.source(to), axis);
  return false;
}

/// Whether a point's source tells that it lies on an edge of sums.
bool FeaturePairs::is_named_by(PointId at, EdgeId e) const {
  const PointSource& source = arrangement_.points.source(at);
  if (source.kind == PointSource::Kind::edge) return source.a == e;
  const SumEdge& edge = space_.edges()[e];
  const SumPoint sum{source.a, source.b};
  return source.kind == PointSource::Kind::sum && (sum == edge.from || sum == edge.to);
}

/// Whether an edge of sums that holds `from` goes on from there towards `to`.
bool FeaturePairs::runs_along(const SumEdge& edge, PointId from, PointId to) const {
  const Approx &f = arrangement_.points.approx(from), &t = arrangement_.points.approx(to);
  const Vec3 start = space_.approx(edge.from), d = space_.approx(edge.to) - start, direction = t.at - f.at;
  const auto norm = [](Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  const double radius = f.radius + t.radius + 8 * space_.sum_radius() + space_.span() * 0x1p-46;
  if (norm(cross(d, direction)) > 8 * (norm(d) + norm(direction) + radius) * radius) return false;
  // With from = x / v and to = y / w, in multiples of v w: the way is y v - x w, and sums have the weight 1.
  using exact::BigInteger;
  const auto x = space_.homogeneous(arrangement_.points.source(from)),
             y = space_.homogeneous(arrangement_.points.source(to)),
             a = space_.homogeneous({PointSource::Kind::sum, edge.from.p, edge.from.q, 0}),
             b = space_.homogeneous({PointSource::Kind::sum, edge.to.p, edge.to.q, 0});
  BigInteger e[3], w[3], before = 0, after = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = b[i] - a[i];
    w[i] = y[i] * x[3] - x[i] * y[3];
    before += w[i] * (a[i] * x[3] - x[i]);
    after += w[i] * (b[i] * x[3] - x[i]);
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (e[i] * w[(i + 1) % 3] != e[(i + 1) % 3] * w[i]) return false;
  return before > 0 || after > 0;
}

SolidContact features_of(const SumFacet& f, const SolidOperand& p, const SolidOperand& q) {
  const auto edge = [](const SolidOperand& s, std::uint32_t w) {
    return edge_feature(s.wedges[w].from, s.wedges[w].to);
  };
  switch (f.kind) {
    case SumFacet::Kind::face_vertex:
      return {{Kind::face, p.face[f.p], 0}, {Kind::vertex, f.q, 0}};
    case SumFacet::Kind::vertex_face:
      return {{Kind::vertex, f.p, 0}, {Kind::face, q.face[f.q], 0}};
    case SumFacet::Kind::edge_edge:
      break;
  }
  return {edge(p, f.p), edge(q, f.q)};
}

/// An edge of one operand, or the face that it splits, and a vertex of the other one.
SolidContact FeaturePairs::features(const SumEdge& edge) const {
  const bool of_p = edge.from.q == edge.to.q;
  const std::uint32_t a = of_p ? edge.from.p : edge.from.q, b = of_p ? edge.to.p : edge.to.q;
  const auto inside = diagonal_[of_p ? 0 : 1].find(key(a, b));
  const SolidFeature line =
      inside == diagonal_[of_p ? 0 : 1].end() ? edge_feature(a, b) : SolidFeature{Kind::face, inside->second, 0};
  const SolidFeature vertex{Kind::vertex, of_p ? edge.from.q : edge.from.p, 0};
  return of_p ? SolidContact{line, vertex} : SolidContact{vertex, line};
}

void start_at_smallest(std::vector<std::uint32_t>& loop) {
  const std::size_t n = loop.size();
  std::size_t best = 0;
  for (std::size_t at = 1; at < n; ++at) {
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t x = loop[(at + k) % n], y = loop[(best + k) % n];
      if (x == y) continue;
      if (x < y) best = at;
      break;
    }
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best), loop.end());
}

}  // namespace dymsum::spatial

namespace dymsum {

namespace spatial {
namespace {

SolidFeature spanned(const SolidFeature& a, const SolidFeature& b) {
  if (a == b) return a;
  return {SolidFeature::Kind::edge, std::min(a.a, b.a), std::max(a.a, b.a)};
}

/// The contact along an edge of a convex sum, between vertices at which vertices touch, one edge touches a vertex, or
/// two parallel edges touch.
SolidContact between(const SolidContact& a, const SolidContact& b) { return {spanned(a.p, b.p), spanned(a.q, b.q)}; }

/// Calls f(a, b, face) for all sides of faces, from a vertex to a larger one.
template <class F>
void for_each_side(const std::vector<SpatialFace>& faces, F f) {
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    for (const std::vector<std::uint32_t>& loop : faces[face].loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto [a, b] = std::minmax(loop[k], loop[k + 1 < loop.size() ? k + 1 : 0]);
        f(a, b, face);
      }
    }
  }
}

}  // namespace

EdgeList edge_list(const std::vector<SpatialFace>& faces) {
  struct Side {
    std::uint32_t to, face;
    auto operator<=>(const Side&) const = default;
  };
  // Edges are listed by their smaller ends, then at each of these.
  std::vector<std::uint32_t> begin(1, 0);
  for_each_side(faces, [&](std::uint32_t a, std::uint32_t, std::uint32_t) {
    if (begin.size() < a + std::size_t{2}) begin.resize(a + std::size_t{2}, 0);
    ++begin[a + std::size_t{1}];
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Side> sides(begin.back());
  std::vector<std::uint32_t> position(begin.begin(), begin.end() - 1);
  for_each_side(faces, [&](std::uint32_t a, std::uint32_t b, std::uint32_t face) { sides[position[a]++] = {b, face}; });
  EdgeList list;
  list.edges.reserve(sides.size() / 2 + 1), list.faces.reserve(sides.size());
  for (std::uint32_t a = 0; a + 1 < begin.size(); ++a) {
    const auto first = sides.begin() + begin[a], last = sides.begin() + begin[a + 1];
    std::sort(first, last);
    for (auto side = first; side != last; ++side) {
      const bool fresh = side == first || side->to != list.edges.back().to;
      if (fresh) list.edges.push_back({a, side->to, static_cast<std::uint32_t>(list.faces.size())});
      if (fresh || list.faces.back() != side->face) list.faces.push_back(side->face);
    }
  }
  list.edges.push_back({0, 0, static_cast<std::uint32_t>(list.faces.size())});
  return list;
}

std::vector<SpatialEdge> edges_of(const std::vector<SpatialFace>& faces) {
  const EdgeList list = edge_list(faces);
  std::vector<SpatialEdge> edges;
  edges.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto of = list.faces_of(k);
    edges.push_back({list.edges[k].from, list.edges[k].to, {of.begin(), of.end()}, std::nullopt});
  }
  return edges;
}

}  // namespace spatial

std::vector<SpatialEdge> SpatialSum::edges() const {
  std::vector<SpatialEdge> edges = spatial::edges_of(faces);
  if (is_convex()) {
    for (SpatialEdge& edge : edges)
      edge.contact = spatial::between(*vertex_contacts[edge.from], *vertex_contacts[edge.to]);
  } else {
    for (std::size_t k = 0; k < edges.size(); ++k) edges[k].contact = edge_contacts_[k];
  }
  return edges;
}

}  // namespace dymsum

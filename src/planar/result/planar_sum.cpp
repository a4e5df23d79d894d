#include "planar/result/planar_sum.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/poll.h"
#include "dymsum/area_text.h"
#include "dymsum/planar_sum.h"
#include "exact/big.h"
#include "planar/boundary/boundary.h"
#include "planar/operand/operand.h"
#include "planar/position/area.h"
#include "planar/position/exact_source.h"
#include "planar/result/pieces.h"
#include "planar/result/rounding.h"

namespace dymsum::planar {

Segment SumSource::segment(const Contact& contact) const {
  const bool of_p = contact.kind == Contact::Kind::edge_of_p;
  const auto [from, to] = operands_[of_p ? 0 : 1]->edge_of_index[of_p ? contact.p : contact.q];
  return {{of_p ? 0u : 1u, from, to}, operands_[of_p ? 1 : 0]->vertex_of_index[of_p ? contact.q : contact.p]};
}

Pair SumSource::corner(const SumVertex& v) const {
  return {operands_[0]->vertex_of_index[v.corner_p], operands_[1]->vertex_of_index[v.corner_q]};
}

ExactSource::Position SumSource::position(const SumVertex& vertex) const { return reduced(homogeneous(vertex)); }

ExactSource::Homogeneous SumSource::homogeneous(const SumVertex& vertex) const {
  if (vertex.corner_p != SumVertex::kNone) return lattice_->homogeneous(corner(vertex));
  return lattice_->homogeneous(crossing(vertex));
}

ExactSource::NearPosition SumSource::near(const SumVertex& vertex) const {
  if (vertex.corner_p != SumVertex::kNone) return lattice_->near(corner(vertex));
  return lattice_->near(crossing(vertex));
}

std::optional<Point> SumSource::rounded_once(const SumVertex& vertex) const {
  // The lattices of operands that are scaled or turned share integers; vertices of results may be fractions.
  if (vertex.corner_p == SumVertex::kNone || lattice_->integers != nullptr) return std::nullopt;
  for (const auto& points : lattice_->points)
    if (points->fractions != nullptr) return std::nullopt;
  const Pair v = corner(vertex);
  const Point &p = lattice_->points[0]->input[v.p], &q = lattice_->points[1]->input[v.q];
  return Point{p.x + q.x + 0.0, p.y + q.y + 0.0};
}

SegmentPosition SumSource::crossing(const SumVertex& v) const {
  SegmentPosition position;
  position.on = segment(v.in);
  position.first.kind = Cut::Kind::crossing;
  position.first.by = segment(v.out);
  return position;
}

int SumSource::compare(const SumVertex& a, const SumVertex& b, int axis) const {
  const bool corner_a = a.corner_p != SumVertex::kNone, corner_b = b.corner_p != SumVertex::kNone;
  if (corner_a && corner_b) return lattice_->compare_coordinate(corner(a), corner(b), axis);
  if (corner_a) return lattice_->compare_coordinate(corner(a), crossing(b), axis);
  if (corner_b) return -lattice_->compare_coordinate(corner(b), crossing(a), axis);
  return lattice_->compare_coordinate(crossing(a), crossing(b), axis);
}

int SumSource::compare_x(const SumVertex& a, const SumVertex& b) const { return compare(a, b, 0); }

int SumSource::compare_y(const SumVertex& a, const SumVertex& b) const { return compare(a, b, 1); }

bool SumSource::on_segment(const Segment& s, const Position& at) const {
  const auto spot = [&](Pair v) { return make_spot(lattice_->position(v)); };
  return planar::on_segment(spot(start_of(s)), spot(end_of(s)), make_spot(at));
}

bool SumSource::on_contact(const Contact& contact, const Position& at) const {
  return on_segment(segment(contact), at);
}

// An edge merged from three contacts or more does not remember those in the middle, and where rings touch an edge
// index stands for several walk edges: then all walk edges on the line are looked at.
Contact SumSource::contact_at(const Contact& first, const Contact& last, const Position& at) const {
  if (on_contact(first, at)) return first;
  if (on_contact(last, at)) return last;
  const Segment line = segment(first);
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand &o = *operands_[op], &other = *operands_[1 - op];
    for (std::uint32_t e = 0; e < o.size(); ++e) {
      if (o.next[e] == e || lattice_->cross(o.edge(e), line.edge) != 0) continue;
      for (std::uint32_t v = 0; v < other.size(); ++v) {
        const Segment s{o.edge(e), other.source[v]};
        if (lattice_->side(line, start_of(s)) != 0) continue;
        const Contact c = contact_of({op, e, v}, *operands_[0], *operands_[1]);
        if (c.p != SumVertex::kNone && c.q != SumVertex::kNone && on_segment(s, at)) return c;
      }
    }
  }
  throw std::logic_error("SumSource: a position on a ring edge lies on no contact");
}

namespace {

/// The smaller of the rotations of a ring that start at i and j, vertex by vertex.
std::size_t smaller_rotation(const std::vector<SumVertex>& ring, std::size_t i, std::size_t j,
                             const VertexOrder& order) {
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n; ++k) {
    const int sign = order.compare(ring[(i + k) % n], ring[(j + k) % n]);
    if (sign != 0) return sign < 0 ? i : j;
  }
  return i;
}

std::size_t canonical_start(const std::vector<SumVertex>& ring, const VertexOrder& order) {
  const std::size_t n = ring.size();
  const SumVertex* const v = ring.data();
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k) {
    if (order.provably_right(v[k], v[best])) continue;
    const int sign = order.compare(ring[k], ring[best]);
    if (sign < 0) best = k;
    if (sign == 0) best = smaller_rotation(ring, best, k, order);
  }
  return best;
}

void rotate_to_start(SumRing& ring, const VertexOrder& order) {
  const auto start = static_cast<std::ptrdiff_t>(canonical_start(ring.vertices, order));
  if (start != 0) std::rotate(ring.vertices.begin(), ring.vertices.begin() + start, ring.vertices.end());
}

int compare_rings(const SumRing& a, const SumRing& b, const VertexOrder& order) {
  const std::size_t common = std::min(a.vertices.size(), b.vertices.size());
  for (std::size_t k = 0; k < common; ++k)
    if (const int sign = order.compare(a.vertices[k], b.vertices[k]); sign != 0) return sign;
  return a.vertices.size() < b.vertices.size() ? -1 : a.vertices.size() > b.vertices.size();
}

/// The innermost of the outer rings that contain a hole.
std::size_t parent_of(const SumRing& hole, const std::vector<const SumRing*>& outers, const std::vector<RingBox>& boxes,
                      const ExactSource& source, double at_error) {
  const RingBox box = box_of(hole, at_error);
  std::optional<std::size_t> parent;
  for (std::size_t i = 0; i < outers.size(); ++i) {
    if (boxes_disjoint(box, boxes[i]) || !ring_contains(*outers[i], hole, source, at_error)) continue;
    if (!parent || ring_contains(*outers[*parent], *outers[i], source, at_error)) parent = i;
  }
  if (!parent) throw std::logic_error("group_rings: a hole lies in no outer ring");
  return *parent;
}

}  // namespace

std::vector<SumPart> group_rings(std::vector<SumRing> rings, std::span<const std::uint8_t> is_outer,
                                 const ExactSource& source, double at_error) {
  if (rings.size() != is_outer.size()) throw std::logic_error("group_rings: one entry of is_outer per ring");
  std::vector<SumPart> parts;
  if (rings.size() == 1 && is_outer[0] != 0) {
    parts.emplace_back().outer = std::move(rings[0]);
    return parts;
  }
  std::vector<const SumRing*> outers;
  std::vector<std::size_t> part_of(rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (is_outer[i] == 0) continue;
    part_of[i] = outers.size();
    outers.push_back(&rings[i]);
  }
  if (outers.empty() && !rings.empty()) throw std::logic_error("group_rings: a hole lies in no outer ring");
  if (outers.size() > 1 && outers.size() < rings.size()) {
    std::vector<RingBox> boxes;
    for (const SumRing* outer : outers) boxes.push_back(box_of(*outer, at_error));
    for (std::size_t i = 0; i < rings.size(); ++i)
      if (is_outer[i] == 0) part_of[i] = parent_of(rings[i], outers, boxes, source, at_error);
  }
  parts.resize(outers.size());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    SumPart& part = parts[part_of[i]];
    if (is_outer[i] != 0) part.outer = std::move(rings[i]);
    else part.holes.push_back(std::move(rings[i]));
  }
  return parts;
}

void canonicalize(std::vector<SumPart>& parts, const ExactSource& source, double at_error) {
  const VertexOrder order(source, at_error);
  const auto before = [&](const SumRing& a, const SumRing& b) { return compare_rings(a, b, order) < 0; };
  for (SumPart& part : parts) {
    rotate_to_start(part.outer, order);
    for (SumRing& hole : part.holes) rotate_to_start(hole, order);
    std::sort(part.holes.begin(), part.holes.end(), before);
  }
  std::sort(parts.begin(), parts.end(), [&](const SumPart& a, const SumPart& b) { return before(a.outer, b.outer); });
}

void canonicalize(std::vector<SumSegment>& segments, const ExactSource& source, double at_error) {
  const VertexOrder order(source, at_error);
  const auto compare = [&](const SumSegment& a, const SumSegment& b) {
    const int sign = order.compare(a.from, b.from);
    return sign != 0 ? sign : order.compare(a.to, b.to);
  };
  for (SumSegment& s : segments)
    if (order.compare(s.to, s.from) < 0) std::swap(s.from, s.to);
  std::stable_sort(segments.begin(), segments.end(),
                   [&](const SumSegment& a, const SumSegment& b) { return compare(a, b) < 0; });
  const auto same = [&](const SumSegment& a, const SumSegment& b) { return compare(a, b) == 0; };
  segments.erase(std::unique(segments.begin(), segments.end(), same), segments.end());
}

void canonicalize(std::vector<SumVertex>& points, const ExactSource& source, double at_error) {
  const VertexOrder order(source, at_error);
  std::stable_sort(points.begin(), points.end(),
                   [&](const SumVertex& a, const SumVertex& b) { return order.compare(a, b) < 0; });
  const auto same = [&](const SumVertex& a, const SumVertex& b) { return order.compare(a, b) == 0; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
}

void trace_stages(const Soup& soup, const InteriorMask* mask, const Arrangement& arrangement, const SortedLoops& loops,
                  const ReducedConvolution& convolution, PlanarTrace& trace) {
  const Lattice& lattice = soup.lattice;
  convolution.for_each([&](const WalkSegment& w) {
    const SoupBox b = soup.box(w);
    trace.convolution.push_back({lattice.to_input(b.ax, b.ay), lattice.to_input(b.bx, b.by), w.side == 0});
  });
  if (mask != nullptr)
    for (int r = 0; r < mask->grid().rows; ++r)
      for (int c = 0; c < mask->grid().columns; ++c) {
        if (!mask->covered(r, c)) continue;
        const int first = c;
        while (c + 1 < mask->grid().columns && mask->covered(r, c + 1)) ++c;
        const double h = mask->grid().cell;
        trace.masked_cells.push_back({lattice.to_input(first * h, r * h), lattice.to_input((c + 1) * h, (r + 1) * h)});
      }
  for (const Crossing& c : arrangement.crossings()) {
    const SoupBox& b = soup.boxes[c.a];
    trace.crossings.push_back(lattice.to_input(b.ax + c.ta * (b.bx - b.ax), b.ay + c.ta * (b.by - b.ay)));
  }
  const auto ring = [&](const BoundaryLoop& loop) {
    Ring r;
    for (const Step& step : loop.steps) {
      const SegmentPosition p = arrangement.end_position(step);
      r.push_back(lattice.to_input(p.x, p.y));
    }
    return r;
  };
  for (const BoundaryLoop& loop : loops.kept) trace.kept_loops.push_back(ring(loop));
  for (const BoundaryLoop& loop : loops.dropped) trace.dropped_loops.push_back(ring(loop));
}

void trace_windings(const Soup& soup, const SegmentGraph& graph, const std::vector<BoundaryEdges>& rings,
                    PlanarTrace& trace) {
  const Lattice& lattice = soup.lattice;
  const auto at = [&](std::uint32_t node) {
    const SegmentPosition& x = graph.nodes()[node].position;
    return lattice.to_input(x.x, x.y);
  };
  for (std::uint32_t s = 0; s < soup.size(); ++s) {
    const SoupBox& b = soup.boxes[s];
    trace.convolution.push_back(
        {lattice.to_input(b.ax, b.ay), lattice.to_input(b.bx, b.by), soup.segments[s].side() == 0});
  }
  for (std::uint32_t v = 0; v < graph.nodes().size(); ++v)
    if (!graph.nodes()[v].end.pair) trace.crossings.push_back(at(v));
  for (const auto& ring : rings) {
    trace.kept_loops.emplace_back();
    for (const BoundaryEdge& e : ring) trace.kept_loops.back().push_back(at(e.to));
  }
}

PlanarSum finish_sum(SumState&& state, const SumOptions& options) {
  PlanarSum sum;
  StageClock clock(state.stats, timed(state));
  RawBoundary& raw = state.boundary;
  PieceCandidates lower;
  if (options.semantics == Semantics::closed) lower = lower_dimensional_candidates(*state.lattice, *state.p, *state.q);
  const auto source = std::make_shared<SumSource>(state.lattice, std::move(state.p), std::move(state.q));
  exact_source(sum) = source;
  sum.parts = group_rings(std::move(raw.rings), raw.outer, *source, raw.at_error);
  canonicalize(sum.parts, *source, raw.at_error);
  merge_pieces(*source, {}, {std::move(raw.cracks), std::move(raw.punctures)}, sum.tight_segments, sum.tight_points);
  merge_pieces(*source, sum.parts, lower, sum.segments, sum.points);
  if (state.trace) {
    for (const SumVertex& v : sum.tight_points) state.trace->tight_points.push_back(v.at);
    for (const SumSegment& s : sum.tight_segments) state.trace->tight_segments.push_back({s.from.at, s.to.at});
  }
  clock.done("output");
  sum.at_error = raw.at_error;
  // Where pieces are cut off, their ends are rounded even if all other positions are exact.
  if (!sum.segments.empty() || !sum.tight_segments.empty())
    sum.at_error = std::max(sum.at_error, rounding_error(*state.lattice));
  sum.stats = std::move(state.stats);
  if (state.trace) sum.trace = std::move(*state.trace);
  return sum;
}

}  // namespace dymsum::planar

namespace dymsum {

// The questions a sum answers after it has been computed.

namespace {

/// Both coordinates, crosswise: no greatest common divisor is needed to compare.
bool equal(const ExactSource::Homogeneous& p, const ExactSource::Homogeneous& q) {
  if (p.w == q.w) return p.x == q.x && p.y == q.y;
  return p.x * q.w == q.x * p.w && p.y * q.w == q.y * p.w;
}

/// n / w, w > 0. Most denominators are powers of two, which need no greatest common divisor.
Rational lowest_terms(exact::BigInteger n, exact::BigInteger w) {
  if (n.is_zero()) return {};
  const auto twos = std::min(lsb(exact::BigInteger(abs(n))), lsb(w));
  n >>= twos;
  w >>= twos;
  if (msb(w) != lsb(w)) {
    const exact::BigInteger common = gcd(n, w);
    n /= common;
    w /= common;
  }
  return exact::to_rational(std::move(n), std::move(w));
}

/// Compares vertices of two sums by their exact positions; those of one source and one provenance without asking it.
class SameVertices {
 public:
  SameVertices(const PlanarSum& a, const PlanarSum& b) : a_(exact_source(a).get()), b_(exact_source(b).get()) {}

  bool operator()(const SumVertex& a, const SumVertex& b) const {
    if (a_ == b_ && planar::same_position(a, b)) return true;
    if (a_ == nullptr || b_ == nullptr) throw std::logic_error("PlanarSum: vertices without exact positions");
    return equal(a_->homogeneous(a), b_->homogeneous(b));
  }
  bool operator()(const SumSegment& a, const SumSegment& b) const {
    return (*this)(a.from, b.from) && (*this)(a.to, b.to);
  }
  bool operator()(const SumRing& a, const SumRing& b) const { return (*this)(a.vertices, b.vertices); }
  bool operator()(const SumPart& a, const SumPart& b) const {
    return (*this)(a.outer, b.outer) && (*this)(a.holes, b.holes);
  }

  template <class T>
  bool operator()(const std::vector<T>& a, const std::vector<T>& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), *this);
  }

 private:
  const ExactSource* a_;
  const ExactSource* b_;
};

/// The numbers of holes and vertices of every part agree: checked before any position is computed.
bool same_sizes(const PlanarSum& a, const PlanarSum& b) {
  const auto ring = [](const SumRing& r, const SumRing& s) { return r.vertices.size() == s.vertices.size(); };
  const auto part = [&](const SumPart& p, const SumPart& q) {
    return ring(p.outer, q.outer) && std::equal(p.holes.begin(), p.holes.end(), q.holes.begin(), q.holes.end(), ring);
  };
  return a.segments.size() == b.segments.size() && a.points.size() == b.points.size() &&
         a.tight_segments.size() == b.tight_segments.size() && a.tight_points.size() == b.tight_points.size() &&
         std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), part);
}

}  // namespace

std::size_t PlanarSum::hole_count() const {
  std::size_t count = 0;
  for (const SumPart& part : parts) count += part.holes.size();
  return count;
}

std::size_t PlanarSum::vertex_count() const {
  std::size_t count = 0;
  for (const SumPart& part : parts) {
    count += part.outer.vertices.size();
    for (const SumRing& hole : part.holes) count += hole.vertices.size();
  }
  return count;
}

Rational PlanarSum::area_exact() const { return planar::area_fraction(*this); }

std::optional<Rational> PlanarSum::area_exact_within(std::size_t bits) const {
  return planar::area_within(*this, bits);
}

double PlanarSum::area() const { return planar::nearest_area(*this); }

RationalPoint PlanarSum::exact(const SumVertex& vertex) const {
  if (!source_) throw std::logic_error("PlanarSum: vertices without exact positions");
  const ExactSource::Homogeneous p = source_->homogeneous(vertex);
  return {lowest_terms(p.x, p.w), lowest_terms(p.y, p.w)};
}

Result<Region> PlanarSum::rounded() const { return planar::rounded(*this); }

Result<SnapRounded> snap_rounded(const PlanarSum& sum) { return planar::snap_rounded(sum); }

Result<Repaired> PlanarSum::rounded_with_repair() const { return planar::rounded_with_repair(*this); }

bool operator==(const PlanarSum& a, const PlanarSum& b) {
  const SameVertices same(a, b);
  return same_sizes(a, b) && same(a.parts, b.parts) && same(a.segments, b.segments) && same(a.points, b.points) &&
         same(a.tight_segments, b.tight_segments) && same(a.tight_points, b.tight_points);
}

namespace {

constexpr int kDigits = 17;  // enough to distinguish any two doubles

}  // namespace

std::string area_text(const PlanarSum& sum) {
  std::string text;
  planar::narrow_area(sum, [&](const planar::AreaRange& range) {
    text = exact::decimal_text(range.first, kDigits);
    return exact::decimal_text(range.second, kDigits) == text;
  });
  return text;
}

std::string area_text(const Region& region) {
  std::vector<std::vector<planar::Position>> rings;
  const auto add = [&](const Ring& ring) {
    std::vector<planar::Position>& to = rings.emplace_back();
    for (const Point p : ring) to.push_back({exact::exact_value(p.x), exact::exact_value(p.y)});
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  const planar::ExactArea area = planar::exact_area(rings);
  return exact::decimal_text(exact::BigRational(area.numerator, area.denominator), kDigits);
}

}  // namespace dymsum

#include "cspace/obstacle/slice_reader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cspace/events/walked_rings.h"
#include "exact/rounding_bound.h"
#include "planar/boundary/collision.h"
#include "planar/motion/operand_pair.h"
#include "planar/position/exact_source.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

// The errors of a position from the lattice's base: that of its double, times the span, which Collision's own slack
// covers as well; and that of the sum of the offsets, times the reach.
constexpr double kPosition = exact::rounding_bound(1, 2), kBase = exact::rounding_bound(1, 2);

// The middle of the loop's first piece.
SegmentPosition position_on_loop(const std::vector<WalkSegment>& loop, const TurningForms& forms,
                                 const PlacedPair& state) {
  const auto exact_segment = [&](const WalkSegment& s) {
    const Operand &o = s.side == 0 ? *state.p : *state.q, &other = s.side == 0 ? *state.q : *state.p;
    return Segment{o.edge(s.edge), other.source[s.vertex]};
  };
  // The cut where the boundary turns from one segment of the loop into the next, `by` the one that is not the first.
  const auto cut = [&](const WalkSegment& from, const WalkSegment& to, const WalkSegment& by) {
    Cut c;
    if (forms.end(from) == TurningForms::start(to)) {
      c.pair = {state.p->source[forms.end(from).p], state.q->source[forms.end(from).q]};
    } else {
      c.kind = Cut::Kind::crossing;
      c.by = exact_segment(by);
    }
    return c;
  };
  SegmentPosition position;
  position.on = exact_segment(loop[0]);
  position.between = true;
  position.first = cut(loop.back(), loop[0], loop.back());
  position.second = cut(loop[0], loop[1], loop[1]);
  const Lattice& lattice = *state.lattice;
  const Lattice::Position p = lattice.position(position);
  const auto in_steps = [&](const auto& v, double low) {
    return exact::round_to_double(exact::BigRational((v - exact::exact_value(low)) / exact::exact_value(lattice.unit)));
  };
  position.x = in_steps(p.x, lattice.base.x);
  position.y = in_steps(p.y, lattice.base.y);
  position.error = kPosition * lattice.span + (lattice.base_reach * kBase + lattice.base_error) / lattice.unit;
  return position;
}

}  // namespace

SliceReader::SliceReader(const TurningForms& forms, std::shared_ptr<const OperandPair> base)
    : forms_(forms), base_(std::move(base)), index_(forms.size(0), forms.size(1)) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = forms.operand(op);
    walk_vertex_[op].assign(o.vertex_of_index.size(), kNobody);
    walk_edge_[op].assign(o.edge_of_index.size(), kNobody);
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      walk_vertex_[op][o.vertex_index[i]] = i;
      walk_edge_[op][o.edge_index[i]] = i;
    }
  }
}

WalkSegment SliceReader::segment(const Contact& c) const {
  return c.kind == Contact::Kind::edge_of_p ? WalkSegment{0, walk_edge_[0][c.p], walk_vertex_[1][c.q]}
                                            : WalkSegment{1, walk_edge_[1][c.q], walk_vertex_[0][c.p]};
}

std::vector<std::uint32_t> SliceReader::segments(const SumRing& ring) const {
  std::vector<WalkSegment> along;
  const std::size_t n = ring.vertices.size();
  for (std::size_t k = 0; k < n; ++k)
    append_run(segment(ring.vertices[k].out), segment(ring.vertices[k + 1 == n ? 0 : k + 1].in), forms_, along);
  std::vector<std::uint32_t> all;
  for (const WalkSegment& s : along) all.push_back(index_.of(s));
  return all;
}

std::vector<SliceLoop> SliceReader::loops(const Orientation& at) const {
  SumOptions options;
  options.semantics = Semantics::regular;
  const Result<SumState> computed = compute_boundary(base_->placed(at), options);
  if (!computed) throw std::logic_error("SliceReader: a slice failed");
  const RawBoundary& raw = computed->boundary;
  std::vector<SliceLoop> all;
  for (std::size_t l = 0; l < raw.rings.size(); ++l)
    all.push_back({segments(raw.rings[l]), base_->connected && raw.outer[l] != 0});
  return all;
}

PlanarSum SliceReader::slice(const Orientation& at, Semantics semantics) const {
  SumOptions options;
  options.semantics = semantics;
  Result<PlanarSum> sum = placed_sum(base_->placed(at), options);
  if (!sum) throw std::logic_error("SliceReader: a slice failed");
  return std::move(*sum);
}

std::uint32_t SliceReader::cell_at(const SumRing& ring, const BoundaryGraph& graph) const {
  const std::vector<std::uint32_t> all = segments(ring);
  for (std::uint32_t n = graph.first_on(all.front()); n != kNobody; n = graph[n].next_on_segment)
    if (graph[n].left == all.back()) return graph[n].cell;
  throw std::logic_error("SliceReader: a ring of the slice is not on the boundary");
}

SliceReader::Faces SliceReader::faces(const Orientation& at, const BoundaryGraph& graph) const {
  const PlanarSum sum = slice(at, Semantics::regular);
  std::vector<const SumRing*> holes;
  for (const SumPart& part : sum.parts)
    for (const SumRing& hole : part.holes) holes.push_back(&hole);
  Faces faces;
  for (const SumPart& part : sum.parts) {
    const std::uint32_t cell = cell_at(part.outer, graph);
    const SumRing* inside = nullptr;
    for (const SumRing* hole : holes)
      if (ring_contains(*hole, part.outer, *exact_source(sum), sum.at_error) &&
          (inside == nullptr || ring_contains(*inside, *hole, *exact_source(sum), sum.at_error)))
        inside = hole;
    if (inside != nullptr) {
      faces.same.emplace_back(cell, cell_at(*inside, graph));
      continue;
    }
    if (!faces.unbounded.empty()) faces.same.emplace_back(cell, faces.unbounded.back());
    faces.unbounded.push_back(cell);
  }
  return faces;
}

bool SliceReader::is_free(const std::vector<WalkSegment>& loop, const Orientation& at) const {
  const PlacedPair state = base_->placed(at);
  Collision collision(*state.lattice, *state.p, *state.q, true);
  return !collision.overlaps_right_of(position_on_loop(loop, forms_, state));
}

namespace {

/// Lines that collinear() may call one have offsets from the origin that differ by less than this fraction of the span,
/// a tenth of it.
constexpr double kLineNear = 0x1p-34;
/// The error of an end of an interval, beside what its fraction of the segment errs by, is this times the span: two
/// positions (16), a difference and a direction (19 for the one, 19 and 2 for the unit vector), products and sums.
constexpr double kInterval = exact::rounding_bound(2 * 16 + 1 + 19 + 21 + 6, 8192);
/// The error of the cross product of two directions at an angle that errs by 2^-49 is this times their lengths.
constexpr double kParallelLines = exact::rounding_bound(56 + 2 * 16, 8192);
/// So many times what sides err by are proved at the angle, too.
constexpr double kSides = 64;

}  // namespace

SharedLines::SharedLines(const TurningForms& forms, const AngleNow& now, std::vector<SubEdge> before)
    : forms_(forms),
      now_(now),
      heading_(now.heading()),
      before_(std::move(before)),
      lines_before_(by_offset(before_)) {}

double SharedLines::offset(const SubEdge& e) const {
  const Point d = forms_.direction(e.segment, heading_),
              from = forms_.position(TurningForms::start(e.segment), heading_);
  return (d.x * from.y - d.y * from.x) / std::hypot(d.x, d.y);
}

SharedLines::ByOffset SharedLines::by_offset(const std::vector<SubEdge>& edges) const {
  ByOffset lines;
  lines.reserve(edges.size());
  for (std::uint32_t k = 0; k < edges.size(); ++k) lines.emplace_back(offset(edges[k]), k);
  std::sort(lines.begin(), lines.end());
  return lines;
}

template <class F>
void SharedLines::for_each_near(const ByOffset& lines, double offset, F&& f) const {
  const double near = kLineNear * forms_.span();
  const auto first = std::lower_bound(lines.begin(), lines.end(), std::pair{offset - near, std::uint32_t{0}});
  for (auto line = first; line != lines.end() && line->first <= offset + near; ++line) f(line->second);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> SharedLines::continued(const std::vector<SubEdge>& ended,
                                                                            const std::vector<SubEdge>& fresh) const {
  const ByOffset lines = by_offset(fresh);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t n = 0; n < ended.size(); ++n)
    for_each_near(lines, offset(ended[n]), [&](std::uint32_t m) {
      if (have_common_interval(ended[n], fresh[m])) found.emplace_back(n, m);
    });
  return found;
}

// A sub-edge's interval on a line. Positions along it of nearly parallel lines may be anywhere on the segment.
SharedLines::Interval SharedLines::interval_on(const WalkSegment& line, const SubEdge& edge) const {
  const WalkSegment& s = edge.segment;
  const Point d = forms_.direction(line, heading_), base = forms_.position(TurningForms::start(line), heading_);
  const Point from = forms_.position(TurningForms::start(s), heading_), e = forms_.direction(s, heading_);
  const double length = std::hypot(d.x, d.y);
  double error = kInterval * forms_.span();
  const auto along = [&](bool at_start) {
    const Located at = position_on(forms_, s, at_start ? edge.left : edge.right, at_start, heading_);
    error += std::isnan(at.error) ? INFINITY : at.error * forms_.length1(s);
    const double u = std::clamp(at.t, 0.0, 1.0);
    return (d.x * (from.x + u * e.x - base.x) + d.y * (from.y + u * e.y - base.y)) / length;
  };
  const double first = along(true), last = along(false);
  return {std::min(first, last), std::max(first, last), error};
}

// Whether two sub-edges have one direction and an interval in common at the angle. Ends are quotients `side / cross` of
// polynomials, where a line runs along this one the quotient of their derivatives.
bool SharedLines::have_common_interval(const SubEdge& n, const SubEdge& m) const {
  if (!(cosine(n.segment, m.segment) > 0) || !collinear(n.segment, m.segment)) return false;
  const Interval s = interval_on(n.segment, n), t = interval_on(n.segment, m);
  const double fraction = std::min(s.to, t.to) - std::max(s.from, t.from), error = s.error + t.error;
  if (fraction > error) return true;
  if (fraction < -error) return false;
  const SignsAt& signs = now_.signs();
  for (const SubEdge* end : {&n, &m}) {
    const std::optional<Fraction> to = end_along(signs, n.segment, *end, true);
    for (const SubEdge* start : {&n, &m}) {
      const std::optional<Fraction> from = end_along(signs, n.segment, *start, false);
      // Lines that are parallel at every angle do not bound each other.
      if (!to || !from) throw std::logic_error("SharedLines: a sub-edge ends nowhere on its line");
      if (signs.compare(*to, *from) <= 0) return false;
    }
  }
  return true;
}

double SharedLines::cosine(const WalkSegment& s, const WalkSegment& t) const {
  const Point d = forms_.direction(s, heading_), e = forms_.direction(t, heading_);
  return d.x * e.x + d.y * e.y;
}

// Exactly, where doubles do not distinguish the lines.
bool SharedLines::collinear(const WalkSegment& s, const WalkSegment& t) const {
  if (std::abs(forms_.cross(s, t).at(heading_)) > kParallelLines * forms_.length1(s) * forms_.length1(t)) return false;
  const TrigForm side = forms_.side(s, TurningForms::start(t));
  if (std::abs(side.at(heading_)) > kSides * forms_.side_error(s)) return false;
  if (const QuarterTurn* turn = now_.crowded(); turn != nullptr)
    return turn->on_line(s, TurningForms::start(t)) && turn->on_line(s, forms_.end(t));
  const SignsAt& signs = now_.signs();
  if (s.side == t.side ? !forms_.parallel(s, t) : signs.sign(forms_.exact_cross(s, t, signs.chart())) != 0)
    return false;
  return signs.sign(forms_.exact_side(s, TurningForms::start(t), signs.chart())) == 0;
}

// Walls of the other direction on a sub-edge's line. Turned round, a line has the opposite offset.
std::vector<SubEdge> SharedLines::opposite_walls(const SubEdge& e) const {
  std::vector<SubEdge> walls;
  for_each_near(lines_before_, -offset(e), [&](std::uint32_t m) {
    const SubEdge& wall = before_[m];
    if (cosine(e.segment, wall.segment) < 0 && collinear(e.segment, wall.segment)) walls.push_back(wall);
  });
  return walls;
}

// Doubles decide where they leave a gap that is proved, else exact numbers do.
bool SharedLines::shut(std::span<const SubEdge> edges) const {
  const WalkSegment& line = edges[0].segment;
  const std::vector<SubEdge> walls = opposite_walls(edges[0]);
  double low = -INFINITY, high = INFINITY, error = 0;
  for (const SubEdge& e : edges) {
    const Interval s = interval_on(line, e);
    low = std::max(low, s.from);
    high = std::min(high, s.to);
    error += s.error;
  }
  if (walls.empty() && high - low > 2 * error) return false;
  double reach = low, errors = error;
  std::vector<Interval> intervals;
  for (const SubEdge& wall : walls) intervals.push_back(interval_on(line, wall));
  std::sort(intervals.begin(), intervals.end());
  for (const Interval& s : intervals) {
    errors = std::max(errors, error + s.error);
    if (s.from <= reach + 2 * errors) reach = std::max(reach, s.to);
  }
  if (high - reach > 2 * errors) return false;
  return covered_exactly(edges, walls);
}

bool SharedLines::covered_exactly(std::span<const SubEdge> edges, const std::vector<SubEdge>& walls) const {
  const WalkSegment& line = edges[0].segment;
  const SignsAt& signs = now_.signs();
  std::optional<Fraction> at, end;
  for (const SubEdge& e : edges) {
    const std::optional<Fraction> from = end_along(signs, line, e, false), to = end_along(signs, line, e, true);
    if (!from || !to) return false;
    if (!at || signs.compare(*from, *at) > 0) at = from;
    if (!end || signs.compare(*to, *end) < 0) end = to;
  }
  for (bool grown = true; grown && signs.compare(*at, *end) < 0;) {
    grown = false;
    for (const SubEdge& wall : walls) {
      const std::optional<Fraction> to = end_along(signs, line, wall, false), from = end_along(signs, line, wall, true);
      if (!to || !from || signs.compare(*from, *at) > 0 || signs.compare(*to, *at) <= 0) continue;
      at = to;
      grown = true;
    }
  }
  return signs.compare(*at, *end) >= 0;
}

void match_along_lines(const BoundaryGraph& graph, const SharedLines& lines, SliceEdit& edit) {
  std::vector<SubEdge> ended, fresh;
  for (const std::uint32_t n : edit.ended) ended.push_back(graph.sub_edge(n));
  std::vector<std::uint32_t> position_of_fresh;
  std::uint32_t index = 0;
  for (const SliceEdit::Loop& loop : edit.loops)
    for (const SliceEdit::Position& p : loop.positions) {
      if (p.stays == kNobody || (graph.angle() != kNobody && graph[p.stays].begin == graph.angle())) {
        const SegmentIndex& segments = graph.segments();
        fresh.push_back({segments.segment(p.segment), segments.segment(p.left), segments.segment(p.right)});
        position_of_fresh.push_back(index);
      }
      ++index;
    }
  for (const auto& [n, m] : lines.continued(ended, fresh)) {
    const bool shut = lines.shut(std::array{ended[n], fresh[m]});
    (shut ? edit.touching : edit.continued).emplace_back(edit.ended[n], position_of_fresh[m]);
  }
}

}  // namespace dymsum::planar

#include "planar/result/pieces.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;
using Rings = std::vector<std::vector<Spot>>;

/// y = slope x + offset, or x = offset.
struct Line {
  bool vertical = false;
  BigRational slope, offset;
};

int compare(const Line& a, const Line& b) {
  if (a.vertical != b.vertical) return a.vertical ? 1 : -1;
  const int order = planar::compare(a.slope, b.slope);
  return order != 0 ? order : planar::compare(a.offset, b.offset);
}

struct Interval {
  Line line;
  Spot low, high;
  std::size_t candidate;
};

/// The candidates of one line whose union is the segment from low to high.
struct Run {
  std::span<const Interval> members;
  const Spot* low;
  const Spot* high;
};

/// A position where the run may enter or leave the parts.
struct RingCut {
  Spot at;
  std::uint32_t ring, edge;
};

Interval make_interval(const PieceCandidate& candidate, std::size_t index) {
  Interval v{{}, make_spot(candidate.a), make_spot(candidate.b), index};
  const int order = compare(v.low, v.high);
  if (order == 0) throw std::invalid_argument("lower_dimensional_pieces: a candidate segment is a point");
  if (order > 0) std::swap(v.low, v.high);
  const BigRational dx = v.high.exact.x - v.low.exact.x;
  const BigRational dy = v.high.exact.y - v.low.exact.y;
  v.line.vertical = dx.is_zero();
  if (v.line.vertical) {
    v.line.offset = v.low.exact.x;
  } else if (dy.is_zero()) {
    v.line.offset = v.low.exact.y;
  } else {
    v.line.slope = dy / dx;
    v.line.offset = v.low.exact.y - v.line.slope * v.low.exact.x;
  }
  return v;
}

std::vector<Interval> sorted_intervals(std::span<const PieceCandidate> segments) {
  std::vector<Interval> intervals;
  intervals.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) intervals.push_back(make_interval(segments[i], i));
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
    if (const int order = compare(a.line, b.line); order != 0) return order < 0;
    if (const int order = compare(a.low, b.low); order != 0) return order < 0;
    return a.candidate < b.candidate;
  });
  return intervals;
}

/// Merges what overlaps or touches on one line.
std::vector<Run> runs_of(const std::vector<Interval>& intervals) {
  std::vector<Run> runs;
  for (std::size_t first = 0; first < intervals.size();) {
    const Spot* high = &intervals[first].high;
    std::size_t last = first + 1;
    while (last < intervals.size() && compare(intervals[last].line, intervals[first].line) == 0 &&
           compare(intervals[last].low, *high) <= 0) {
      if (compare(intervals[last].high, *high) > 0) high = &intervals[last].high;
      ++last;
    }
    runs.push_back({std::span(intervals).subspan(first, last - first), &intervals[first].low, high});
    first = last;
  }
  return runs;
}

BigRational doubled_area(const Position& a, const Position& b, const Position& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The crossing of the line of (low, high) with a segment whose ends lie on different sides of it.
Spot crossing(const Spot& low, const Spot& high, const Spot& a, const Spot& b) {
  const BigRational from = doubled_area(low.exact, high.exact, a.exact);
  const BigRational t = from / (from - doubled_area(low.exact, high.exact, b.exact));
  return make_spot(Position{a.exact.x + t * (b.exact.x - a.exact.x), a.exact.y + t * (b.exact.y - a.exact.y)});
}

bool boxes_apart(const Spot& a, const Spot& b, const Spot& c, const Spot& d) {
  const auto apart = [](double p, double q, double r, double s) {
    return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
  };
  return apart(a.nearest.x, b.nearest.x, c.nearest.x, d.nearest.x) ||
         apart(a.nearest.y, b.nearest.y, c.nearest.y, d.nearest.y);
}

/// Ring vertices on the run and crossings of ring edges with it, strictly between its ends, sorted, each position once.
std::vector<RingCut> cuts_of(const Run& run, const Rings& rings) {
  std::vector<RingCut> cuts;
  const auto add = [&](Spot at, std::size_t ring, std::size_t edge) {
    if (compare(*run.low, at) < 0 && compare(at, *run.high) < 0)
      cuts.push_back({std::move(at), static_cast<std::uint32_t>(ring), static_cast<std::uint32_t>(edge)});
  };
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t k = 0; k < rings[r].size(); ++k) {
      const Spot& a = rings[r][k];
      const Spot& b = rings[r][k + 1 == rings[r].size() ? 0 : k + 1];
      if (boxes_apart(*run.low, *run.high, a, b)) continue;
      const int side = orientation(*run.low, *run.high, a), next_side = orientation(*run.low, *run.high, b);
      // a vertex is named by an edge that leaves the line, so that the two lines determine it
      if (side == 0) add(a, r, next_side != 0 ? k : k == 0 ? rings[r].size() - 1 : k - 1);
      if (side * next_side < 0) add(crossing(*run.low, *run.high, a, b), r, k);
    }
  }
  std::stable_sort(cuts.begin(), cuts.end(),
                   [](const RingCut& a, const RingCut& b) { return compare(a.at, b.at) < 0; });
  const auto same = [](const RingCut& a, const RingCut& b) { return compare(a.at, b.at) == 0; };
  cuts.erase(std::unique(cuts.begin(), cuts.end(), same), cuts.end());
  return cuts;
}

Spot midpoint(const Spot& a, const Spot& b) {
  return make_spot(Position{(a.exact.x + b.exact.x) / 2, (a.exact.y + b.exact.y) / 2});
}

PieceEnd make_end(const Spot& at, const RingCut* cut) {
  PieceEnd end;
  end.at = at.exact;
  if (cut != nullptr) {
    end.cut_ring = cut->ring;
    end.cut_edge = cut->edge;
  }
  return end;
}

/// Names the supporting candidates: every member that overlaps the piece, the one at each end reaching into the piece.
void name_candidates(PieceSegment& piece, const Spot& from, const Spot& to, const Run& run) {
  constexpr auto kUnset = static_cast<std::size_t>(-1);
  piece.candidate = piece.from.candidate = piece.to.candidate = kUnset;
  const auto take = [](std::size_t& slot, std::size_t candidate) { slot = std::min(slot, candidate); };
  for (const Interval& m : run.members) {
    if (compare(m.low, to) >= 0 || compare(m.high, from) <= 0) continue;
    take(piece.candidate, m.candidate);
    if (compare(m.low, from) <= 0) take(piece.from.candidate, m.candidate);
    if (compare(m.high, to) >= 0) take(piece.to.candidate, m.candidate);
  }
}

/// The pieces of one run: its intervals between cuts whose midpoints lie outside the parts, neighbours joined.
void add_pieces(const Run& run, const Rings& rings, std::vector<PieceSegment>& pieces) {
  const std::vector<RingCut> cuts = cuts_of(run, rings);
  const auto spot = [&](std::size_t i) -> const Spot& {
    return i == 0 ? *run.low : i <= cuts.size() ? cuts[i - 1].at : *run.high;
  };
  const auto cut = [&](std::size_t i) { return i == 0 || i > cuts.size() ? nullptr : &cuts[i - 1]; };
  const auto free = [&](std::size_t i) {
    return rings.empty() || locate(rings, midpoint(spot(i), spot(i + 1))) == Location::outside;
  };
  for (std::size_t i = 0; i <= cuts.size(); ++i) {
    if (!free(i)) continue;
    std::size_t end = i + 1;
    while (end <= cuts.size() && free(end)) ++end;
    PieceSegment piece{make_end(spot(i), cut(i)), make_end(spot(end), cut(end))};
    name_candidates(piece, spot(i), spot(end), run);
    pieces.push_back(std::move(piece));
    i = end;  // the interval after `end` is known not to be free
  }
}

std::vector<PiecePoint> isolated_points(std::span<const Position> points, const Rings& rings,
                                        const std::vector<PieceSegment>& segments) {
  struct Candidate {
    Spot at;
    std::size_t index;
  };
  std::vector<Candidate> sorted;
  for (std::size_t i = 0; i < points.size(); ++i) sorted.push_back({make_spot(points[i]), i});
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Candidate& a, const Candidate& b) { return compare(a.at, b.at) < 0; });
  std::vector<std::pair<Spot, Spot>> spots;
  for (const PieceSegment& s : segments) spots.emplace_back(make_spot(s.from.at), make_spot(s.to.at));
  std::vector<PiecePoint> isolated;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Spot& at = sorted[i].at;
    if (i > 0 && compare(sorted[i - 1].at, at) == 0) continue;
    const auto covers = [&](const std::pair<Spot, Spot>& s) { return on_segment(s.first, s.second, at); };
    if (std::any_of(spots.begin(), spots.end(), covers) || locate(rings, at) != Location::outside) continue;
    isolated.push_back({at.exact, sorted[i].index});
  }
  return isolated;
}

}  // namespace

Pieces lower_dimensional_pieces(std::span<const std::vector<Position>> rings, std::span<const PieceCandidate> segments,
                                std::span<const Position> points) {
  Rings spots;
  for (const std::vector<Position>& ring : rings) {
    std::vector<Spot>& to = spots.emplace_back();
    for (const Position& p : ring) to.push_back(make_spot(p));
  }
  const std::vector<Interval> intervals = sorted_intervals(segments);
  Pieces pieces;
  for (const Run& run : runs_of(intervals)) add_pieces(run, spots, pieces.segments);
  std::sort(pieces.segments.begin(), pieces.segments.end(), [](const PieceSegment& a, const PieceSegment& b) {
    const int order = compare(a.from.at, b.from.at);
    return order != 0 ? order < 0 : compare(a.to.at, b.to.at) < 0;
  });
  pieces.points = isolated_points(points, spots, pieces.segments);
  return pieces;
}

namespace {

// Sums of a vertex or edge of P and a vertex or edge of Q.
class Candidates {
 public:
  Candidates(const Lattice& lattice, const Operand& p, const Operand& q, PieceCandidates& out)
      : lattice_(lattice), p_(p), q_(q), out_(out) {}

  void add(std::uint32_t i, int dimension_p, std::uint32_t j, int dimension_q) {
    if (dimension_p == 0 && dimension_q == 0) {
      out_.points.push_back(corner(i, j, {}));
    } else if (dimension_p == 0) {
      add_edge_of_q(i, j);
    } else if (dimension_q == 0) {
      add_edge_of_p(i, j);
    } else if (lattice_.cross(p_.edge(i), q_.edge(j)) == 0 && lattice_.dot(p_.edge(i), q_.edge(j)) > 0) {
      // Edge by edge, so that every piece lies on its contact.
      add_edge_of_p(i, j);
      add_edge_of_q(p_.next[i], j);
    }
  }

 private:
  void add_edge_of_p(std::uint32_t e, std::uint32_t j) {
    const Contact line = contact_of({0, e, j}, p_, q_);
    out_.segments.push_back({corner(e, j, line), corner(p_.next[e], j, line)});
  }
  void add_edge_of_q(std::uint32_t i, std::uint32_t f) {
    const Contact line = contact_of({1, f, i}, p_, q_);
    out_.segments.push_back({corner(i, f, line), corner(i, q_.next[f], line)});
  }
  SumVertex corner(std::uint32_t i, std::uint32_t j, const Contact& line) const {
    SumVertex v;
    v.in = v.out = line;
    v.corner_p = p_.vertex_index[i];
    v.corner_q = q_.vertex_index[j];
    v.at = lattice_.to_input(p_.x[i] + q_.x[j], p_.y[i] + q_.y[j]);
    return v;
  }

  const Lattice& lattice_;
  const Operand &p_, &q_;
  PieceCandidates& out_;
};

}  // namespace

PieceCandidates lower_dimensional_candidates(const Lattice& lattice, const Operand& p, const Operand& q) {
  PieceCandidates out;
  Candidates candidates(lattice, p, q, out);
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension == 2 || cq.dimension == 2) continue;
      for (std::uint32_t i = cp.first; i < cp.last; ++i)
        for (std::uint32_t j = cq.first; j < cq.last; ++j) candidates.add(i, cp.dimension, j, cq.dimension);
    }
  return out;
}

void merge_pieces(const SumSource& source, const std::vector<SumPart>& parts, const PieceCandidates& candidates,
                  std::vector<SumSegment>& segments, std::vector<SumVertex>& points) {
  if (candidates.segments.empty() && candidates.points.empty()) return;
  std::vector<std::vector<Position>> rings;
  std::vector<const SumRing*> ring_of;
  for (const SumPart& part : parts) {
    ring_of.push_back(&part.outer);
    for (const SumRing& hole : part.holes) ring_of.push_back(&hole);
  }
  for (const SumRing* ring : ring_of) {
    rings.emplace_back();
    for (const SumVertex& v : ring->vertices) rings.back().push_back(source.position(v));
  }
  std::vector<PieceCandidate> lines;
  std::vector<Position> spots;
  for (const SumSegment& s : candidates.segments) lines.push_back({source.position(s.from), source.position(s.to)});
  for (const SumVertex& v : candidates.points) spots.push_back(source.position(v));
  const Pieces pieces = lower_dimensional_pieces(rings, lines, spots);
  const auto vertex = [&](const PieceEnd& end) {
    const SumSegment& candidate = candidates.segments[end.candidate];
    if (end.cut_ring == PieceEnd::kNone) {
      const bool is_a = compare(end.at, lines[end.candidate].a) == 0;
      return is_a ? candidate.from : candidate.to;
    }
    SumVertex v;
    v.in = candidate.from.in;
    const SumRing& ring = *ring_of[end.cut_ring];
    const SumVertex &from = ring.vertices[end.cut_edge], &to = ring.vertices[(end.cut_edge + 1) % ring.vertices.size()];
    v.out = source.contact_at(from.out, to.in, end.at);
    v.at = {exact::round_to_double(end.at.x), exact::round_to_double(end.at.y)};
    return v;
  };
  for (const PieceSegment& s : pieces.segments) segments.push_back({vertex(s.from), vertex(s.to)});
  for (const PiecePoint& p : pieces.points) points.push_back(candidates.points[p.candidate]);
}

}  // namespace dymsum::planar

#include "planar/result/sum_source.h"

#include <stdexcept>

#include "planar/operand/contact_of.h"
#include "planar/position/position_signs.h"

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

}  // namespace dymsum::planar

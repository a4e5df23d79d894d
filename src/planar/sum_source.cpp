#include "planar/sum_source.h"

#include <algorithm>

#include "planar/position_signs.h"

namespace dymsum::planar {

Segment SumSource::segment(const Contact& contact) const {
  const bool of_p = contact.kind == Contact::Kind::edge_of_p;
  const auto [from, to] = operands_[of_p ? 0 : 1]->numbered_edge[of_p ? contact.p : contact.q];
  return {{of_p ? 0u : 1u, from, to}, operands_[of_p ? 1 : 0]->numbered_vertex[of_p ? contact.q : contact.p]};
}

Pair SumSource::corner(const SumVertex& v) const {
  return {operands_[0]->numbered_vertex[v.corner_p], operands_[1]->numbered_vertex[v.corner_q]};
}

ExactSource::Position SumSource::position(const SumVertex& vertex) const {
  Lattice::Position p;
  if (vertex.corner_p != SumVertex::kNone) {
    p = lattice_->position(corner(vertex));
  } else {
    p = lattice_->position(crossing(vertex));
  }
  return {std::move(p.x), std::move(p.y)};
}

Place SumSource::crossing(const SumVertex& v) const {
  Place place;
  place.on = segment(v.in);
  place.first.kind = Cut::Kind::crossing;
  place.first.by = segment(v.out);
  return place;
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

bool SumSource::on_contact(const Contact& contact, const Position& at) const {
  const Segment s = segment(contact);
  const auto spot = [&](Pair v) {
    Lattice::Position p = lattice_->position(v);
    return make_spot(Position{std::move(p.x), std::move(p.y)});
  };
  return on_segment(spot(start_of(s)), spot(end_of(s)), make_spot(at));
}

}  // namespace dymsum::planar

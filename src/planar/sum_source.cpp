#include "planar/sum_source.h"

#include <algorithm>

#include "planar/position_signs.h"

namespace dymsum::planar {

const SumSource::Numbering& SumSource::numbering(std::uint32_t op) const {
  std::call_once(numbered_, [this] {
    for (std::uint32_t k = 0; k < 2; ++k) {
      const Operand& o = *operands_[k];
      Numbering& n = numbering_[k];
      // Numbers of an erosion's frame are not given to anyone.
      std::uint32_t size = 0;
      for (const auto* numbers : {&o.vertex_number, &o.edge_number})
        for (const std::uint32_t v : *numbers) size = v == SumVertex::kNone ? size : std::max(size, v + 1);
      n.vertex.assign(size, 0);
      n.edge.assign(size, {0, 0});
      for (std::uint32_t i = 0; i < o.size(); ++i) {
        if (o.vertex_number[i] != SumVertex::kNone) n.vertex[o.vertex_number[i]] = o.source[i];
        if (o.edge_number[i] != SumVertex::kNone) n.edge[o.edge_number[i]] = {o.source[i], o.source[o.next[i]]};
      }
    }
  });
  return numbering_[op];
}

Segment SumSource::segment(const Contact& contact) const {
  const bool of_p = contact.kind == Contact::Kind::edge_of_p;
  const auto [from, to] = numbering(of_p ? 0 : 1).edge[of_p ? contact.p : contact.q];
  return {{of_p ? 0u : 1u, from, to}, numbering(of_p ? 1 : 0).vertex[of_p ? contact.q : contact.p]};
}

Pair SumSource::corner(const SumVertex& v) const {
  return {numbering(0).vertex[v.corner_p], numbering(1).vertex[v.corner_q]};
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

// Corners against corners and crossings against crossings in fixed-width integers; the rest is rare.
std::optional<int> SumSource::compare(const SumVertex& a, const SumVertex& b, int axis) const {
  const bool corner_a = a.corner_p != SumVertex::kNone, corner_b = b.corner_p != SumVertex::kNone;
  if (corner_a && corner_b) return lattice_->compare_coordinate(corner(a), corner(b), axis);
  if (!corner_a && !corner_b) return lattice_->compare_coordinate(crossing(a), crossing(b), axis);
  return std::nullopt;
}

int SumSource::compare_x(const SumVertex& a, const SumVertex& b) const {
  const std::optional<int> sign = compare(a, b, 0);
  return sign ? *sign : ExactSource::compare_x(a, b);
}

int SumSource::compare_y(const SumVertex& a, const SumVertex& b) const {
  const std::optional<int> sign = compare(a, b, 1);
  return sign ? *sign : ExactSource::compare_y(a, b);
}

bool SumSource::on_contact(const Contact& contact, const Position& at) const {
  const Segment s = segment(contact);
  const auto spot = [&](Pair v) {
    Lattice::Position p = lattice_->position(v);
    return make_spot(Position{std::move(p.x), std::move(p.y)});
  };
  return on_segment(spot(start_of(s)), spot(end_of(s)), make_spot(at));
}

}  // namespace dymsum::planar

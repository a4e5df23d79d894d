#include "io/family/name_check.h"

namespace dymsum::io {

using exact::BigRational;
using planar::Operand;

namespace {

template <class Pair>
BigRational cross(const Pair& a, const Pair& b) {
  return a[0] * b[1] - a[1] * b[0];
}
template <class Pair>
Pair minus(const Pair& a, const Pair& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

}  // namespace

bool NameCheck::names_an_edge(const Contact& c) const {
  const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1;
  const Operand &of_edge = path_.given->operands[op], &of_vertex = path_.given->operands[1 - op];
  const std::uint32_t edge = op == 0 ? c.p : c.q, vertex = op == 0 ? c.q : c.p;
  if (edge >= of_edge.edge_of_index.size() || vertex >= of_vertex.vertex_of_index.size()) return false;
  const auto [from, to] = of_edge.edge_of_index[edge];
  const std::size_t sources = path_.given->lattice->points[op]->input.size();
  return from < sources && to < sources;
}

/// As it moves: of the moved operand times the factors of the path.
NameCheck::Vector NameCheck::vertex(std::uint32_t op, std::uint32_t source) const {
  const Point at = path_.given->given->points[op]->input[source];
  Vector v{exact::exact_value(at.x), exact::exact_value(at.y)};
  if (op != path_.given->moved) return v;
  return {v[0] * planar::rational(path_.factors.x), v[1] * planar::rational(path_.factors.y)};
}

NameCheck::Line NameCheck::line(const Contact& c) const {
  const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1;
  const auto [from, to] = path_.given->operands[op].edge_of_index[op == 0 ? c.p : c.q];
  const std::uint32_t other = path_.given->operands[1 - op].vertex_of_index[op == 0 ? c.q : c.p];
  const Vector start = vertex(op, from), vertex_of_other = vertex(1 - op, other);
  const bool edge_moves = op == path_.given->moved;
  return {minus(vertex(op, to), start), edge_moves ? vertex_of_other : start, edge_moves ? start : vertex_of_other};
}

bool NameCheck::on_line(const SumVertex& v, const Contact& c) const {
  const std::uint32_t moved = path_.given->moved;
  const auto source = [&](std::uint32_t op) {
    return path_.given->operands[op].vertex_of_index[op == 0 ? v.corner_p : v.corner_q];
  };
  const Line l = line(c);
  return cross(l.direction, minus(vertex(moved, source(moved)), l.moved)) == 0 &&
         cross(l.direction, minus(vertex(1 - moved, source(1 - moved)), l.still)) == 0;
}

const char* NameCheck::fault(const SumVertex& v) const {
  if (!names_an_edge(v.in) || !names_an_edge(v.out)) return "a vertex lies on an edge that is not there";
  if (v.corner_p == SumVertex::kNone)
    return cross(line(v.in).direction, line(v.out).direction) == 0 ? "a vertex lies on parallel lines" : nullptr;
  const auto& operands = path_.given->operands;
  if (v.corner_p >= operands[0].vertex_of_index.size() || v.corner_q >= operands[1].vertex_of_index.size())
    return "a vertex is the sum of vertices that are not there";
  return on_line(v, v.in) && on_line(v, v.out) ? nullptr : "a vertex does not lie on its edges";
}

}  // namespace dymsum::io

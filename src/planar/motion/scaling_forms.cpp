#include "planar/motion/scaling_forms.h"

#include "exact/grid.h"

namespace dymsum::planar {

using exact::BigInteger;

// A stretched operand has fractions over the denominator of its factors, with which the other one is multiplied.
ExactForms::ExactForms(const OperandPair& base) : scaled_(base.moved) {
  const Lattice& l = *base.given;
  const LatticeScale factors = base.lattice_scale(ScaleValue{});
  for (std::uint32_t op = 0; op < 2; ++op) {
    const bool moves = op == base.moved;
    const BigInteger &x = moves ? factors.x : factors.den, &y = moves ? factors.y : factors.den;
    const Point offset = l.points[op]->offset;
    for (const Point& v : l.points[op]->input)
      at_[op].push_back({exact::grid_coordinate<exact::Big>(v.x, offset.x, l.grid_exponent).value() * x,
                         exact::grid_coordinate<exact::Big>(v.y, offset.y, l.grid_exponent).value() * y});
  }
}

ExactForms::Vec ExactForms::edge(const Edge& e) const {
  const Vec &a = at_[e.op][e.from], &b = at_[e.op][e.to];
  return {b.x - a.x, b.y - a.y};
}

ExactForm ExactForms::cross(const Vec& d, Pair v) const {
  const Vec& p = at_[0][v.p];
  const Vec& q = at_[1][v.q];
  ExactForm f{d.x * p.y - d.y * p.x, d.x * q.y - d.y * q.x};
  if (scaled_ == 0) std::swap(f.a, f.b);
  return f;
}

ExactForm ExactForms::side(const Segment& s, Pair v) const {
  const Vec d = edge(s.edge);
  const ExactForm at = cross(d, v), from = cross(d, start_of(s));
  return {at.a - from.a, at.b - from.b};
}

ExactForm ExactForms::along(const Segment& s, Pair v) const {
  const Vec d = edge(s.edge), turned{d.y, -d.x};  // turned x w = d . w
  const ExactForm at = cross({turned.x, turned.y}, v), from = cross({turned.x, turned.y}, start_of(s));
  return {at.a - from.a, at.b - from.b};
}

ExactForm ExactForms::concurrent(const Segment& a, const Segment& b, const Segment& c) const {
  const Vec da = edge(a.edge), db = edge(b.edge), dc = edge(c.edge);
  const ExactForm ha = cross(da, start_of(a)), hb = cross(db, start_of(b)), hc = cross(dc, start_of(c));
  const BigInteger bc = db.x * dc.y - db.y * dc.x, ca = dc.x * da.y - dc.y * da.x, ab = da.x * db.y - da.y * db.x;
  return {ha.a * bc + hb.a * ca + hc.a * ab, ha.b * bc + hb.b * ca + hc.b * ab};
}

std::uint64_t ExactForms::line_hash(const Segment& s) const {
  Vec d = edge(s.edge);
  const BigInteger common = gcd(d.x, d.y);
  if (common > 1) {
    d.x /= common;
    d.y /= common;
  }
  const ExactForm h = cross(d, start_of(s));
  std::uint64_t hash = 0;
  for (const BigInteger& v : {d.x, d.y, h.a, h.b}) {
    const auto& raw = v.backend();
    for (unsigned i = 0; i < raw.size(); ++i)
      hash = (hash ^ static_cast<std::uint64_t>(raw.limbs()[i])) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (v.sign() < 0)) * 0xbf58476d1ce4e5b9u;
    hash ^= hash >> 31;
  }
  return hash;
}

}  // namespace dymsum::planar

#include "spatial/boundary/contact_cones.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

/// A direction of P, or the opposite of one of Q: sign times way.
struct Ray {
  DirectionSource direction;
  int sign = 1;
};

/// A part of the boundary of a cone: a plane sector of less than half a turn, counter-clockwise from one ray to the
/// other seen from outside. The outward normal is sign (u x v).
struct Sector {
  Ray from, to;
  DirectionSource u, v;
  int sign = 1;
};

/// The local cone of P, or of -Q, at a feature: of its solid parts, or of its thin ones, which have no inside.
class Cone {
 public:
  Cone(const SumSpace& space, const IndexedSolid& indexed, bool reflected, Feature at, bool thin)
      : space_(space),
        indexed_(indexed),
        solid_(indexed.solid),
        of_(reflected ? DirectionSource::Of::q : DirectionSource::Of::p),
        sign_(reflected ? -1 : 1),
        at_(at) {
    const SolidOperand& solid = solid_;
    const auto is_wanted = [&](std::uint32_t triangle) { return (triangle >= solid.first_plate) == thin; };
    if (thin) add_segments();
    if (at.kind == Feature::Kind::triangle) {
      if (!is_wanted(at.index)) return;
      // A plane: three sectors between the directions of the triangle's sides.
      const Triangle& t = solid.triangles[at.index];
      for (int k = 0; k < 3; ++k)
        add(at.index, direction(t[k], t[(k + 1) % 3]), direction(t[(k + 1) % 3], t[(k + 2) % 3]));
    } else if (at.kind == Feature::Kind::wedge) {
      const Wedge& w = solid.wedges[at.index];
      if (w.is_segment() || !is_wanted(w.left)) return;
      add(w.left, direction(w.from, w.to), direction(w.from, w.left_apex));
      add(w.left, direction(w.from, w.left_apex), direction(w.to, w.from));
      add(w.right, direction(w.to, w.from), direction(w.from, w.right_apex));
      add(w.right, direction(w.from, w.right_apex), direction(w.from, w.to));
    } else {
      for (std::uint32_t c = solid.corner_begin[at.index]; c < solid.corner_begin[at.index + 1]; ++c) {
        const std::uint32_t t = solid.corners[c] / 3, k = solid.corners[c] % 3;
        if (!is_wanted(t)) continue;
        add(t, direction(at.index, solid.triangles[t][(k + 1) % 3]),
            direction(at.index, solid.triangles[t][(k + 2) % 3]));
      }
    }
  }

  const std::vector<Sector>& sectors() const { return sectors_; }
  /// Segments by themselves.
  const std::vector<Ray>& rays() const { return rays_; }

  /// Whether a direction that is not on the boundary points into the cone.
  bool holds(Ray d) const {
    if (at_.kind == Feature::Kind::triangle) return side(sectors_[0], d) < 0;
    if (at_.kind == Feature::Kind::wedge) {
      const bool left = side(sectors_[0], d) < 0, right = side(sectors_[2], d) < 0;
      return solid_.wedges[at_.index].bend == Wedge::Bend::reflex ? left || right : left && right;
    }
    return holds_at_vertex(d);
  }

  /// The sign of the sector's outward normal times d.
  int side(const Sector& s, Ray d) const { return s.sign * d.sign * space_.det(s.u, s.v, d.direction); }

 private:
  DirectionSource direction(std::uint32_t from, std::uint32_t to) const { return {of_, from, to}; }

  void add_segments() {
    if (at_.kind == Feature::Kind::wedge && solid_.wedges[at_.index].is_segment()) {
      const Wedge& w = solid_.wedges[at_.index];
      rays_.push_back({direction(w.from, w.to), 1});
      rays_.push_back({direction(w.from, w.to), -1});
    }
    if (at_.kind != Feature::Kind::vertex) return;
    indexed_.segments.for_each(box_at_vertex(), [&](std::uint32_t k) {
      const Wedge& w = solid_.wedges[solid_.segments[k]];
      if (w.from == at_.index) rays_.push_back({direction(w.from, w.to), sign_});
      if (w.to == at_.index) rays_.push_back({direction(w.to, w.from), sign_});
    });
  }
  Box box_at_vertex() const {
    Box box;
    box.add(indexed_.at[at_.index]);
    box.grow(space_.sum_radius());
    return box;
  }

  void add(std::uint32_t triangle, DirectionSource from, DirectionSource to) {
    const Triangle& t = solid_.triangles[triangle];
    const DirectionSource u = direction(t[0], t[1]), v = direction(t[0], t[2]);
    // The reflection turns outward normals over, and the order around them with it.
    if (sign_ > 0) sectors_.push_back({{from, 1}, {to, 1}, u, v, 1});
    else sectors_.push_back({{to, -1}, {from, -1}, u, v, -1});
  }

  /// The point at an infinitesimal distance from the vertex: an odd number of the solid's triangles lies above it, in
  /// the solid's own coordinates. Ties are broken as if it were moved along the first axis, and less along the second
  /// one.
  bool holds_at_vertex(Ray d) const {
    const int sign = d.sign * sign_;
    const std::uint32_t v = at_.index;
    const auto order = [&](DirectionSource u, DirectionSource w,
                           std::uint32_t from) {  // of (u x w) . (vertex + d - from)
      const int s = from == v ? 0 : space_.det(u, w, direction(from, v));
      if (s != 0) return s;
      return sign * space_.det(u, w, d.direction);
    };
    bool inside = false;
    Box above = box_at_vertex();
    above.high.z = 1e300;
    indexed_.triangles.for_each(above, [&](std::uint32_t triangle) {
      const Triangle& t = solid_.triangles[triangle];
      int turn[3];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        const DirectionSource u = direction(a, b), up{DirectionSource::Of::axis, 2, 0};
        turn[k] = order(u, up, a);
        for (std::uint32_t axis = 0; axis < 2 && turn[k] == 0; ++axis)
          turn[k] = space_.det(u, up, {DirectionSource::Of::axis, axis, 0});
      }
      if (turn[0] == 0 || turn[0] != turn[1] || turn[1] != turn[2]) return;
      const DirectionSource u = direction(t[0], t[1]), w = direction(t[0], t[2]);
      const int up = space_.det(u, w, {DirectionSource::Of::axis, 2, 0});
      if (order(u, w, t[0]) * up < 0) inside = !inside;
    });
    return inside;
  }

  const SumSpace& space_;
  const IndexedSolid& indexed_;
  const SolidOperand& solid_;
  DirectionSource::Of of_;
  int sign_;
  Feature at_;
  std::vector<Sector> sectors_;
  std::vector<Ray> rays_;
};

/// A half-plane of a cone's boundary at a common ray: to the left of the ray seen against the outward normal, or to the
/// right.
struct ConeWall {
  const Sector* sector;
  bool left;
  int cone;
};

class Overlap {
 public:
  Overlap(const SumSpace& space, const Cone& p, const Cone& q) : space_(space), cone_{&p, &q} {}

  bool run() {
    for (const Sector& s : cone_[0]->sectors())
      for (const Sector& t : cone_[1]->sectors())
        if (cross(s, t)) return true;
    for (int c = 0; c < 2; ++c) {
      for (const Sector& s : cone_[c]->sectors()) {
        if (on_boundary(1 - c, s.from)) {
          if (overlap_around(s.from)) return true;
        } else if (cone_[1 - c]->holds(s.from)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Whether the second cone, a thin one, meets the inside of the first one: at a ray of either, or where sectors
  /// cross. A sector that runs along the first one's boundary leaves it at such a ray.
  bool thin_meets() {
    const Cone &solid = *cone_[0], &thin = *cone_[1];
    for (const Ray r : thin.rays())
      if (!on_boundary(0, r) && solid.holds(r)) return true;
    for (const Sector& s : solid.sectors()) {
      for (const Sector& t : thin.sectors())
        if (cross(s, t)) return true;
      if (on_boundary(1, s.from) && thin_meets_around(s.from)) return true;
    }
    for (const Sector& t : thin.sectors()) {
      for (const Ray r : {t.from, t.to}) {
        if (on_boundary(0, r) ? thin_meets_around(r) : solid.holds(r)) return true;
      }
    }
    return false;
  }

 private:
  int side(const Sector& s, Ray d) const { return s.sign * d.sign * space_.det(s.u, s.v, d.direction); }

  /// Whether the insides of both sectors cross.
  bool cross(const Sector& s, const Sector& t) const {
    const int a = side(t, s.from), b = side(t, s.to);
    if (a * b >= 0) return false;
    const int c = side(s, t.from), d = side(s, t.to);
    if (c * d >= 0) return false;
    // Counter-clockwise about n, the ray n x m is where the heights over m fall: s comes along it when a > 0, t along m
    // x n when c > 0.
    return (a > 0) == (c < 0);
  }

  /// The position of a ray in a sector's plane and sector: 0 outside, 1 along `from`, 2 inside, 3 along `to`.
  int position(const Sector& s, Ray d) const {
    if (side(s, d) != 0) return 0;
    const auto turn = [&](Ray x, Ray y) {  // of (x x y) . normal
      return x.sign * y.sign * s.sign * space_.exact_dot(x.direction, y.direction, s.u, s.v);
    };
    const int a = turn(s.from, d), b = turn(d, s.to);
    if (a > 0 && b > 0) return 2;
    if (a == 0 && b > 0) return 1;
    if (a > 0 && b == 0) return 3;
    return 0;
  }

  bool on_boundary(int cone, Ray d) const {
    for (const Sector& s : cone_[cone]->sectors())
      if (position(s, d) != 0) return true;
    return false;
  }

  /// The walls of both cones at a common ray, counter-clockwise around it.
  void collect_walls(Ray r) {
    walls_.clear();
    for (int c = 0; c < 2; ++c) {
      for (const Sector& s : cone_[c]->sectors()) {
        const int at = position(s, r);
        if (at == 1 || at == 2) walls_.push_back({&s, true, c});
        if (at == 3 || at == 2) walls_.push_back({&s, false, c});
      }
    }
    reference_ = walls_[0];
    std::stable_sort(walls_.begin(), walls_.end(),
                     [&](const ConeWall& x, const ConeWall& y) { return before(r, x, y); });
  }
  int sector(Ray r, const ConeWall& w) const {
    const int t = turn(r, reference_, w);
    return t > 0 ? 1 : t < 0 ? 3 : same_side(reference_, w) ? 0 : 2;
  }
  bool before(Ray r, const ConeWall& x, const ConeWall& y) const {
    const int a = sector(r, x), b = sector(r, y);
    if (a != b) return a < b;
    return (a == 1 || a == 3) && turn(r, x, y) > 0;
  }
  /// f(enters, leaves) for the walls in every half-plane around r, twice around, so that the state before the first
  /// wall is known: counter-clockwise of a right half lies the inside of its cone. Whether f ever says true.
  template <class F>
  bool any_around(Ray r, F f) {
    collect_walls(r);
    for (std::size_t k = 0; k < 2 * walls_.size();) {
      std::size_t last = k;
      bool enters[2] = {false, false}, leaves[2] = {false, false};
      do {
        const ConeWall& w = walls_[last % walls_.size()];
        (w.left ? leaves : enters)[w.cone] = true;
        ++last;
      } while (last % walls_.size() != 0 && !before(r, walls_[k % walls_.size()], walls_[last % walls_.size()]));
      if (f(enters, leaves)) return true;
      k = last;
    }
    return false;
  }

  bool overlap_around(Ray r) {
    bool inside[2] = {false, false}, known[2] = {false, false};
    return any_around(r, [&](const bool(&enters)[2], const bool(&leaves)[2]) {
      for (int c = 0; c < 2; ++c) {
        if (enters[c]) inside[c] = known[c] = true;
        else if (leaves[c]) inside[c] = false, known[c] = true;
      }
      return known[0] && known[1] && inside[0] && inside[1];
    });
  }
  bool thin_meets_around(Ray r) {
    bool inside = false;
    return any_around(r, [&](const bool(&enters)[2], const bool(&leaves)[2]) {
      if (enters[0] || leaves[0]) {
        inside = enters[0];
        return false;
      }
      return inside && (enters[1] || leaves[1]);
    });
  }

  /// The sign of the turn around r from one half-plane to another: r . (n x m), as for walls at an edge.
  int turn(Ray r, const ConeWall& x, const ConeWall& y) const {
    const Sector &s = *x.sector, &t = *y.sector;
    return (x.left ? 1 : -1) * (y.left ? 1 : -1) * s.sign * t.sign * r.sign *
           space_.exact_turn(r.direction, s.u, s.v, t.u, t.v);
  }
  /// Whether two halves of one plane have the inside on one side: with equal normals both to the left or both to the
  /// right, with opposite ones the other way.
  bool same_side(const ConeWall& x, const ConeWall& y) const {
    const Sector &s = *x.sector, &t = *y.sector;
    const bool equal = s.sign * t.sign * space_.exact_dot(s.u, s.v, t.u, t.v) > 0;
    return (x.left == y.left) == equal;
  }

  const SumSpace& space_;
  const Cone* cone_[2];
  std::vector<ConeWall> walls_;
  ConeWall reference_{};
};

}  // namespace

bool cones_overlap(const SumSpace& space, const IndexedSolid& p, Feature at_p, const IndexedSolid& q, Feature at_q) {
  const Cone a(space, p, false, at_p, false), b(space, q, true, at_q, false);
  const bool solid_a = !a.sectors().empty(), solid_b = !b.sectors().empty();
  if (solid_a && solid_b && Overlap(space, a, b).run()) return true;
  if (solid_a && q.solid.has_thin() && Overlap(space, a, Cone(space, q, true, at_q, true)).thin_meets()) return true;
  return solid_b && p.solid.has_thin() && Overlap(space, b, Cone(space, p, false, at_p, true)).thin_meets();
}

}  // namespace dymsum::spatial

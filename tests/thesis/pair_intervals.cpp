#include "thesis/pair_intervals.h"

#include <algorithm>

#include "exact/big.h"
#include "spatial/events/meeting_point.h"

namespace dymsum::spatial {

using exact::BigInteger;
using exact::BigRational;

namespace {

using IntervalEnd = PairInterval::End;

double norm1(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// a + s b with bounds of the errors of both. What names show to be zero has no error.
struct NearForm {
  double a = 0, b = 0, ea = 0, eb = 0;

  bool is_zero_a() const { return a == 0 && ea == 0; }
  bool is_zero_b() const { return b == 0 && eb == 0; }
  void clear_a() { a = ea = 0; }
  void clear_b() { b = eb = 0; }

  /// The sign at all s > 0; 0 where it changes or is not known.
  int lasting_sign() const {
    const int i = a > ea ? 1 : a < -ea ? -1 : 0, j = b > eb ? 1 : b < -eb ? -1 : 0;
    if (i == 0) return is_zero_a() ? j : 0;
    return i == j || is_zero_b() ? i : 0;
  }
  int sign_at(double s) const {
    const double v = a + s * b, e = (ea + s * eb) + (std::abs(a) + std::abs(s * b)) * 0x1p-50;
    return v > e ? 1 : v < -e ? -1 : 0;
  }
};

/// A positive root; its doubles are not proved where `unsure`.
struct NearRoot {
  bool any = false, unsure = false;
  double s = 0, radius = 0;
};
NearRoot root_of(const NearForm& f) {
  NearRoot root;
  if (f.lasting_sign() != 0 || (f.is_zero_a() && std::abs(f.b) > f.eb) || (f.is_zero_b() && std::abs(f.a) > f.ea))
    return root;
  if (std::abs(f.a) <= f.ea || std::abs(f.b) <= f.eb) {
    root.unsure = true;
    return root;
  }
  root.s = -f.a / f.b;
  root.any = root.s > 0;
  root.radius = (f.ea + root.s * f.eb) / (std::abs(f.b) - f.eb) * 2 + root.s * 0x1p-50;
  return root;
}

NearForm near_form(const ProvedForm& f) { return {f.a, f.b, std::abs(f.a) * 0x1p-52, std::abs(f.b) * 0x1p-52}; }

/// Of a corner over the plane of a facet: what it has in common with one of that facet's corners drops out.
NearForm height_form(const PairFacets& all, SumPoint c, std::uint32_t facet) {
  if (const std::optional<ProvedForm> proved = all.proved_height(c, facet)) return near_form(*proved);
  const PlaneRow& row = all.row(facet);
  const Vec3 n{row[0], row[1], row[2]}, f = all.fixed(c), m = all.moved(c);
  const auto size = [&](Vec3 v) { return std::abs(n.x * v.x) + std::abs(n.y * v.y) + std::abs(n.z * v.z); };
  NearForm form{dot(n, f) - row[4], dot(n, m) + row[3], (size(f) + std::abs(row[4])) * 0x1p-49,
                (size(m) + std::abs(row[3])) * 0x1p-49};
  const SumFacet& of = all.facets()[facet];
  for (int k = 0; k < of.corners; ++k) {
    if (all.same_fixed(c, of.corner[k])) form.clear_a();
    if (all.same_moved(c, of.corner[k])) form.clear_b();
  }
  return form;
}

struct Side {
  SumPoint a, b;
  Vec3 way;  // along it, without the scale
  double blur;
};
Side side_of(const PairFacets& all, const SumFacet& facet, int k) {
  const SumPoint a = facet.corner[k], b = facet.corner[(k + 1) % facet.corners];
  const Vec3 u = all.fixed(b) - all.fixed(a), v = all.moved(b) - all.moved(a);
  return {a, b, u + v, (norm1(all.fixed(a)) + norm1(all.moved(a)) + norm1(u + v)) * 0x1p-51};
}

/// Of det(e, h, gap) for the gap between two borders, from e's beginning to h's.
NearForm twist_form(const PairFacets& all, const Side& e, const Side& h) {
  if (const std::optional<ProvedForm> proved = all.proved_twist({e.a, e.b}, {h.a, h.b})) return near_form(*proved);
  const Vec3 n = cross(e.way, h.way), f = all.fixed(h.a) - all.fixed(e.a), m = all.moved(h.a) - all.moved(e.a);
  const double E = norm1(e.way), H = norm1(h.way);
  const auto error = [&](Vec3 gap, double sizes) {
    return 4 * (e.blur * H + h.blur * E + E * H * 0x1p-50) * norm1(gap) + E * H * sizes * 0x1p-49;
  };
  NearForm form{dot(n, f), dot(n, m), error(f, norm1(all.fixed(h.a)) + norm1(all.fixed(e.a))),
                error(m, norm1(all.moved(h.a)) + norm1(all.moved(e.a)))};
  for (const SumPoint a : {e.a, e.b})
    for (const SumPoint b : {h.a, h.b}) {
      if (all.same_fixed(a, b)) form.clear_a();
      if (all.same_moved(a, b)) form.clear_b();
    }
  return form;
}

/// Edges of sums with one edge of an operand.
bool are_parallel(const PairFacets& all, const Side& e, const Side& h) {
  const auto same = [&](SumPoint a, SumPoint b, SumPoint c, SumPoint d, auto equal) {
    return !equal(a, b) && ((equal(a, c) && equal(b, d)) || (equal(a, d) && equal(b, c)));
  };
  return same(e.a, e.b, h.a, h.b, [&](SumPoint x, SumPoint y) { return all.same_fixed(x, y); }) ||
         same(e.a, e.b, h.a, h.b, [&](SumPoint x, SumPoint y) { return all.same_moved(x, y); });
}

/// Whether two borders that are in one plane at a root cross there: 1 provably, -1 provably not, else 0.
int facet_edges_meet(const PairFacets& all, const Side& e, const Side& h, const NearRoot& root) {
  // Along e, where the wall through h that is upright on both crosses it, and the other way round.
  const Vec3 n = cross(e.way, h.way);
  const Vec3 e0 = all.at(e.a, root.s), e1 = all.at(e.b, root.s), h0 = all.at(h.a, root.s), h1 = all.at(h.b, root.s);
  const double reach = norm1(all.moved(e.a)) + norm1(all.moved(e.b)) + norm1(all.moved(h.a)) + norm1(all.moved(h.b)),
               blur = root.radius * reach + all.span(root.s) * 0x1p-48;
  const auto side = [&](Vec3 point, Vec3 from, Vec3 along) {
    const Vec3 gap = point - from;
    const double v = dot(cross(n, along), gap), N = norm1(n), A = norm1(along);
    const double error = 8 * N * A * blur + 16 * (e.blur + h.blur) * (norm1(e.way) + norm1(h.way)) * A * norm1(gap) +
                         N * A * norm1(gap) * 0x1p-46;
    return v > error ? 1 : v < -error ? -1 : 0;
  };
  const int a = side(e0, h0, h.way), b = side(e1, h0, h.way), c = side(h0, e0, e.way), d = side(h1, e0, e.way);
  if (a * b > 0 || c * d > 0) return -1;
  return a * b * c * d == 0 ? 0 : 1;
}

/// Where a corner comes onto a facet's plane.
NearMeeting corner_at_root(const PairFacets& all, SumPoint c, const NearRoot& root) {
  return {all.at(c, root.s), root.s, norm1(all.moved(c)) * root.radius + all.span(root.s) * 0x1p-50, root.radius};
}

/// The vertices of what two facets have in common, over (x, s), in doubles.
class NearVertices {
 public:
  NearVertices(const PairFacets& all, std::uint32_t f, std::uint32_t g) : all_(all), f_(f), g_(g) {}

  std::optional<PairInterval> interval() {
    NearForm heights[2][4];
    for (const int k : {0, 1}) {
      const SumFacet& facet = facet_of(k);
      int lasting = 2;
      for (int c = 0; c < facet.corners; ++c) {
        heights[k][c] = height_form(all_, facet.corner[c], k == 0 ? g_ : f_);
        const int s = heights[k][c].lasting_sign();
        lasting = lasting == 2 || lasting == s ? s : 0;
      }
      if (lasting != 0) return PairInterval{};
    }
    for (const int k : {0, 1})
      for (int c = 0; c < facet_of(k).corners && !unsure_; ++c)
        corner_on_facet(facet_of(k).corner[c], k == 0 ? g_ : f_, heights[k][c]);
    for (int i = 0; i < facet_of(0).corners && !unsure_; ++i)
      for (int j = 0; j < facet_of(1).corners && !unsure_; ++j)
        facet_edges_cross(side_of(all_, facet_of(0), i), side_of(all_, facet_of(1), j));
    return unsure_ ? std::nullopt : from_vertices();
  }

 private:
  struct Vertex {
    double s, radius;
    IntervalEnd kind;
  };
  const SumFacet& facet_of(int k) const { return all_.facets()[k == 0 ? f_ : g_]; }

  void corner_on_facet(SumPoint c, std::uint32_t facet, const NearForm& height) {
    const NearRoot root = root_of(height);
    unsure_ |= root.unsure;
    if (!root.any) return;
    add(provably_holds(all_, facet, corner_at_root(all_, c, root)), root, IntervalEnd::corner);
  }

  void facet_edges_cross(const Side& e, const Side& h) {
    if (are_parallel(all_, e, h)) return;
    const NearRoot root = root_of(twist_form(all_, e, h));
    unsure_ |= root.unsure;
    if (!root.any) return;
    if (const int meet = facet_edges_meet(all_, e, h, root); meet >= 0) add(meet, root, IntervalEnd::facet_edges);
  }

  void add(int holds, const NearRoot& root, IntervalEnd kind) {
    if (holds == 0) unsure_ = true;
    if (holds > 0) vertices_.push_back({root.s, root.radius, kind});
  }

  std::optional<PairInterval> from_vertices() {
    PairInterval result;
    if (vertices_.empty()) return contact_at(1) == 0 ? std::nullopt : std::optional(PairInterval{contact_at(1) > 0});
    const auto [low, high] = std::minmax_element(vertices_.begin(), vertices_.end(),
                                                 [](const Vertex& a, const Vertex& b) { return a.s < b.s; });
    for (const Vertex& v : vertices_) {
      if (&v != &*low && v.s - v.radius <= low->s + low->radius) return std::nullopt;
      if (&v != &*high && v.s + v.radius >= high->s - high->radius) return std::nullopt;
    }
    const int before = contact_at(low->s / 2), after = contact_at(high->s * 2);
    if (before == 0 || after == 0) return std::nullopt;
    if (low == high && before < 0 && after < 0) return std::nullopt;
    result.meets = true;
    if (before < 0) result.low = low->kind;
    if (after < 0) result.high = high->kind;
    return result;
  }

  /// Whether the facets meet at a scale at which no vertex lies: a border of one passes through the other.
  int contact_at(double s) const {
    bool unsure = false;
    for (const int k : {0, 1}) {
      const SumFacet &of = facet_of(k), &other = facet_of(1 - k);
      for (int i = 0; i < of.corners; ++i) {
        const Side e = side_of(all_, of, i);
        const std::uint32_t plane = k == 0 ? g_ : f_;
        const int a = height_form(all_, e.a, plane).sign_at(s), b = height_form(all_, e.b, plane).sign_at(s);
        if (a * b > 0) continue;
        int turn = 0;
        bool open = a * b == 0, missed = false;
        for (int j = 0; j < other.corners && !missed; ++j) {
          const int t = twist_form(all_, e, side_of(all_, other, j)).sign_at(s);
          open |= t == 0;
          missed = turn * t < 0;
          if (t != 0) turn = t;
        }
        if (missed) continue;
        if (!open) return 1;
        unsure = true;
      }
    }
    return unsure ? 0 : -1;
  }

  const PairFacets& all_;
  std::uint32_t f_, g_;
  std::vector<Vertex> vertices_;
  bool unsure_ = false;
};

/// The same in integers, of what doubles do not decide.
class ExactVertices {
 public:
  ExactVertices(const PairFacets& all, std::uint32_t f, std::uint32_t g, Ahead ahead)
      : all_(all), f_(f), g_(g), ahead_(ahead) {}

  PairInterval interval() {
    if (are_apart(f_, g_) || are_apart(g_, f_)) return {};
    for (const auto& [of, plane] : {std::pair{f_, g_}, std::pair{g_, f_}}) {
      const SumFacet& facet = all_.facets()[of];
      for (int c = 0; c < facet.corners; ++c) {
        const NearRoot root = root_of(height_form(all_, facet.corner[c], plane));
        if (ahead_ == Ahead::doubles && !root.unsure) {
          if (!root.any || provably_holds(all_, plane, corner_at_root(all_, facet.corner[c], root)) < 0) continue;
        } else {
          for (int j = 0; j < all_.facets()[plane].corners; ++j)
            corner_on_facet_edge(facet.corner[c], all_.facet_edges().of(plane, j));
        }
        add(meeting_of(all_, facet.corner[c], all_.plane(plane)), IntervalEnd::corner);
      }
    }
    for (int i = 0; i < all_.facets()[f_].corners; ++i)
      for (int j = 0; j < all_.facets()[g_].corners; ++j) {
        if (ahead_ == Ahead::doubles &&
            provably_miss(side_of(all_, all_.facets()[f_], i), side_of(all_, all_.facets()[g_], j)))
          continue;
        const auto u = all_.planes_of(all_.facet_edges().of(f_, i)), v = all_.planes_of(all_.facet_edges().of(g_, j));
        add(meeting_of({&all_.plane(u[0]), &all_.plane(u[1]), &all_.plane(v[0]), &all_.plane(v[1])}),
            IntervalEnd::facet_edges);
      }
    return from_vertices();
  }

 private:
  struct Vertex {
    BigRational s;
    IntervalEnd kind;
  };

  bool provably_miss(const Side& e, const Side& h) const {
    if (are_parallel(all_, e, h)) return true;
    const NearForm twist = twist_form(all_, e, h);
    if (twist.is_zero_b()) return true;  // in one plane at no scale, or at all
    const NearRoot root = root_of(twist);
    return !root.unsure && (!root.any || facet_edges_meet(all_, e, h, root) < 0);
  }

  /// All corners of one facet stay on one side of the other one's plane.
  bool are_apart(std::uint32_t of, std::uint32_t plane) const {
    const SumFacet& facet = all_.facets()[of];
    const MovingPlane& p = all_.plane(plane);
    int side = 0;
    for (int k = 0; k < facet.corners; ++k) {
      const BigVector &f = all_.exact_fixed(facet.corner[k]), &m = all_.exact_moved(facet.corner[k]);
      const BigInteger a = p.n[0] * f[0] + p.n[1] * f[1] + p.n[2] * f[2] - p.d0,
                       b = p.n[0] * m[0] + p.n[1] * m[1] + p.n[2] * m[2] - p.d1;
      const int s = a.sign() != 0 ? a.sign() : b.sign();
      if (s == 0 || a.sign() * b.sign() < 0 || side * s < 0) return false;
      side = s;
    }
    return true;
  }

  /// A corner that stays in a plane comes onto its facet across a border.
  void corner_on_facet_edge(SumPoint c, std::uint32_t facet_edge) {
    for (const std::uint32_t plane : all_.planes_of(facet_edge))
      add(meeting_of(all_, c, all_.plane(plane)), IntervalEnd::corner);
  }

  void add(const std::optional<ExactMeeting>& at, IntervalEnd kind) {
    if (!at || at->s <= 0) return;
    const NearMeeting around = near(*at);
    if (!position_in(all_, f_, *at, around).holds || !position_in(all_, g_, *at, around).holds) return;
    vertices_.push_back({at->scale(), kind});
  }

  PairInterval from_vertices() const {
    if (vertices_.empty()) return {contact_at(BigRational(1)), IntervalEnd::none, IntervalEnd::none};
    BigRational low = vertices_[0].s, high = low;
    for (const Vertex& v : vertices_) low = std::min(low, v.s), high = std::max(high, v.s);
    const auto kind_at = [&](const BigRational& s) {
      IntervalEnd kind = IntervalEnd::facet_edges;
      for (const Vertex& v : vertices_)
        if (v.s == s && v.kind == IntervalEnd::corner) kind = IntervalEnd::corner;
      return kind;
    };
    const bool before = contact_at(BigRational(low / 2)), after = contact_at(BigRational(high * 2));
    PairInterval result{before || after || low < high, IntervalEnd::none, IntervalEnd::none};
    if (!result.meets) return result;
    if (!before) result.low = kind_at(low);
    if (!after) result.high = kind_at(high);
    return result;
  }

  bool contact_at(const BigRational& s) const {
    MovingPlane level;
    level.n = {0, 0, 0}, level.d0 = -numerator(s), level.d1 = denominator(s);
    for (const auto& [of, other] : {std::pair{f_, g_}, std::pair{g_, f_}})
      for (int k = 0; k < all_.facets()[of].corners; ++k) {
        const auto u = all_.planes_of(all_.facet_edges().of(of, k));
        const std::optional<ExactMeeting> at =
            meeting_of({&all_.plane(u[0]), &all_.plane(u[1]), &all_.plane(other), &level});
        if (!at) continue;
        const NearMeeting around = near(*at);
        if (position_in(all_, f_, *at, around).holds && position_in(all_, g_, *at, around).holds) return true;
      }
    return false;
  }

  const PairFacets& all_;
  std::uint32_t f_, g_;
  Ahead ahead_;
  std::vector<Vertex> vertices_;
};

}  // namespace

std::optional<PairInterval> near_interval(const PairFacets& all, std::uint32_t f, std::uint32_t g) {
  return NearVertices(all, f, g).interval();
}
PairInterval exact_interval(const PairFacets& all, std::uint32_t f, std::uint32_t g, Ahead ahead) {
  return ExactVertices(all, f, g, ahead).interval();
}

}  // namespace dymsum::spatial

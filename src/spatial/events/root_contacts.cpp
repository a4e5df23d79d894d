#include "spatial/events/root_contacts.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "spatial/boundary/collision.h"
#include "spatial/events/crossing_search.h"
#include "spatial/events/proved_overlap.h"
#include "spatial/sum/feature_pairs.h"

namespace dymsum::spatial {

using exact::AlgebraicRoot;
using exact::RootValue;

namespace {

/// Half the angles between the root's bounds, at least what doubles leave open.
double spread_of(const RotatingPair& pair, int chart, const AlgebraicRoot& root) {
  return std::max(pair.circle.radians(chart, root.high()) - pair.circle.radians(chart, root.low()), 0.0) + 0x1p-45;
}

/// Values at t = n / d are integers of so many bits more than coordinates, which have room for that.
std::optional<exact::BigRational> short_rational(const RotatingPair& pair, const AlgebraicRoot& root) {
  constexpr unsigned kMostBits = 140;
  std::optional<exact::BigRational> t = exact::rational_value(root);
  if (!t) return t;
  const auto bits = [](const exact::BigInteger& v) { return v.is_zero() ? 1 : static_cast<unsigned>(msb(abs(v))) + 1; };
  const unsigned square = bits(exact::BigInteger(pair.circle.square()));
  const unsigned most = static_cast<unsigned>(std::max(pair.pair.p_positions.bits, pair.pair.q_positions.bits)) + 4 +
                        2 * (square + std::max(bits(numerator(*t)), bits(denominator(*t))));
  if (most > kMostBits) t.reset();
  return t;
}

/// The sign at all t within 2^-bits.
template <class Frame>
Frame frame_at(const RotatingPair& pair, int chart, const AlgebraicRoot& root, long bits) {
  exact::RootBracket bracket = root.bracket();
  if (!bracket.is_point()) bracket.refine_to(bits);
  return {pair, chart, bracket.low().value(), bracket.high().value()};
}
/// The bits of a root that pairs of doubles need: some 2^-100 of the root's size.
long fine_bits(const AlgebraicRoot& root) {
  const double size = std::max(std::abs(root.low()), std::abs(root.high()));
  return size > 0 ? 104L - std::max(std::ilogb(size), -400) : 104L;
}
constexpr long kWideBits = exact::WideInterval::kFractionBits + 8;

SolidFeature edge_feature(std::uint32_t a, std::uint32_t b) {
  return {SolidFeature::Kind::edge, std::min(a, b), std::max(a, b)};
}
SolidFeature vertex_feature(std::uint32_t a) { return {SolidFeature::Kind::vertex, a, 0}; }
SolidContact features_of(SumPoint v) { return {vertex_feature(v.p), vertex_feature(v.q)}; }
SolidContact features_of(const SumEdge& e) {
  return is_of_p(e) ? SolidContact{edge_feature(e.from.p, e.to.p), vertex_feature(e.from.q)}
                    : SolidContact{vertex_feature(e.from.p), edge_feature(e.from.q, e.to.q)};
}

/// An angle at which masses meet lists so many of its contacts.
constexpr std::size_t kMostContacts = 16;

bool precedes(const SolidRotationContact& a, const SolidRotationContact& b) {
  return a.kind != b.kind ? a.kind < b.kind : a.features < b.features;
}

/// Triangles of one face have the same features.
bool lists(const std::vector<SolidRotationContact>& all, const SolidRotationContact& contact) {
  return std::any_of(all.begin(), all.end(), [&](const SolidRotationContact& c) {
    return c.kind == contact.kind && c.features == contact.features;
  });
}

/// One angle, the root of a meeting of a window.
class RootContacts {
 public:
  RootContacts(const RotatingPair& pair, const PairOfBalls& balls, const RotationWindow& window,
               const AlgebraicRoot& root, SolidRotationWork& work)
      : pair_(pair),
        balls_(balls),
        w_(window),
        work_(work),
        root_(root),
        point_(root),
        t_(short_rational(pair, root)),
        radians_(pair.circle.radians(window.range.chart, root.approx())),
        reach_(spread_of(pair, window.range.chart, root)),
        jets_frame_(pair, radians_, reach_),
        fine_frame_(frame_at<FineFrame>(pair, window.range.chart, root, fine_bits(root))),
        exact_frame_(t_ ? PolynomialFrame(pair, window.range.chart, *t_)
                        : PolynomialFrame(pair, window.range.chart, &point_)),
        jets_(jets_frame_),
        fine_(fine_frame_),
        exact_(exact_frame_),
        turned_(balls.balls),
        known_(window.facets.size(), 0) {
    for (InnerBalls::Ball& b : turned_[pair.turning]) b.centre = jets_frame_.matrix() * b.centre;
  }

  /// What a meeting tells of the sum's boundary: nothing where a feature does not exist at this angle, where they do
  /// not meet as far as they reach, or where the position lies in the open sum. Exact, but of normal_on_arc: these are
  /// left out only where balls prove the face plus the edge to lie in the open sum. Where not `known` it is asked as
  /// well whether the form of the meeting vanishes here.
  std::optional<SolidRotationContact> contact(const Meeting& meeting, bool known) {
    if (meeting.kind == Meeting::Kind::normal_on_arc) return normal_on_arc(meeting);
    if (!exist(meeting)) return std::nullopt;
    const auto always = [] { return true; };
    if (meeting.kind == Meeting::Kind::vertex_on_facet)
      return contact_at(
                 meeting, [&](const auto& s) { return s.at(meeting.vertex); }, always,
                 [&](SumSpace&) {
                   return PointSource{PointSource::Kind::sum, meeting.vertex.p, meeting.vertex.q, 0};
                 })
          .value_or(std::nullopt);
    if (meeting.kind == Meeting::Kind::edge_on_edge) {
      // Parallel ones meet where one of them ends, on facets of the other.
      const SumEdge &a = meeting.edges[0], &b = meeting.edges[1];
      return contact_at(
                 meeting, [&](const auto& s) { return s.at(a, b); }, always,
                 [&](SumSpace& space) {
                   std::uint32_t axis = 0;
                   while (space.exact_det(direction_of(b), DirectionSource{DirectionSource::Of::axis, axis, 0},
                                          direction_of(a)) == 0)
                     ++axis;
                   const PlaneSource plane{b.from, direction_of(b), {DirectionSource::Of::axis, axis, 0}, false};
                   return PointSource{PointSource::Kind::edge, space.add_edges({&a, 1}), space.add_planes({&plane, 1}),
                                      0};
                 })
          .value_or(std::nullopt);
    }
    return meeting.kind == Meeting::Kind::edge_and_facets ? edge_and_facets(meeting, known)
                                                          : four_facets(meeting, known);
  }

  /// Calls take(contact) for all edge_and_facets and four_facets of this angle, until it says false. Most facets of a
  /// window do not exist at a crowded angle, or do not meet.
  void crossings(const std::function<bool(SolidRotationContact)>& take, const std::function<void()>& again) {
    std::vector<RotationCells> here;
    for (std::uint32_t f = 0; f < w_.facets.size(); ++f) here.push_back(exists(f) ? 1 : 0);
    find_crossings(w_, jets_frame_, jets_frame_, std::move(here), again, [&](const Meeting& meeting) {
      std::optional<SolidRotationContact> found = contact(meeting, false);
      return !found || take(*std::move(found));
    });
  }

 private:
  using Jets = RotationSigns<JetFrame>;
  using Exact = RotationSigns<PolynomialFrame>;
  /// A position in doubles; not `proved` where they do not decide.
  struct NearPosition {
    Vec3 at;
    double radius = 0;
    bool proved = false;
  };

  /// The sign of form(RotationSigns) here: jets, in doubles and in pairs of them, then in fixed point, else exact.
  template <class F>
  int sign(F form) const {
    if (const int s = form(jets_).sign(); s != 0) return s;
    if (const int s = form(fine_).sign(); s != 0) return s;
    if (!wide_frame_) wide_frame_.emplace(frame_at<WideFrame>(pair_, w_.range.chart, root_, kWideBits));
    if (const std::optional<int> s = sign_of(form(RotationSigns<WideFrame>(*wide_frame_)))) return *s;
    return exact::sign(form(exact_));
  }

  bool slant_holds(const SlantCondition& c) const {
    const Triangle& t = pair_.operand(c.op).triangles[c.triangle];
    return c.sense * sign([&](const auto& s) { return s.slant(c.op, t, c.direction); }) <= 0;
  }

  bool exists(std::uint32_t facet) const {
    std::int8_t& known = known_[facet];
    if (known != 0) return known > 0;
    const WindowFacet& f = w_.facets[facet];
    bool holds = std::all_of(f.unsure.begin(), f.unsure.end(), [&](const SlantCondition& c) { return slant_holds(c); });
    if (holds && f.facet.kind == SumFacet::Kind::edge_edge && f.unsure.size() == 4) {
      // Parallel edges make no facet.
      const auto strict = [&](const SlantCondition& c) {
        const Triangle& t = pair_.operand(c.op).triangles[c.triangle];
        return sign([&](const auto& s) { return s.slant(c.op, t, c.direction); }) != 0;
      };
      holds = std::any_of(f.unsure.begin(), f.unsure.end(), strict);
    }
    known = holds ? 1 : -1;
    return holds;
  }

  bool exists_at(SumPoint v) const {
    const auto around = w_.graph.corners.around(w_.graph.corners.index(v));
    return std::any_of(around.begin(), around.end(), [&](std::uint32_t f) { return exists(f); });
  }

  bool exists_at(const SumEdge& e) const {
    const auto around = w_.graph.edges.around(w_.graph.edges.index(e));
    return std::any_of(around.begin(), around.end(), [&](std::uint32_t f) { return exists(f); });
  }

  template <class F>
  bool in_facet(std::uint32_t facet, F position, int w) const {
    const WindowFacet& f = w_.facets[facet];
    for (int k = 0; k < f.facet.corners; ++k)
      if (w * sign([&](const auto& s) {
            return s.inside(s.inward(s.normal(f.plane), f.facet_edge(k)), f.facet.corner[k], position(s));
          }) <
          0)
        return false;
    return true;
  }

  template <class F>
  bool on_edge(const SumEdge& e, F position, int w) const {
    for (const SumPoint end : {e.from, e.to})
      if (w * sign([&](const auto& s) { return s.beyond(e, end, position(s)); }) > 0) return false;
    return true;
  }

  /// Whether all features do.
  bool exist(const Meeting& meeting) const {
    const auto exists_there = [&](const auto& feature) { return exists_at(feature); };
    const auto facets = meeting.all_facets();
    const auto edges = meeting.all_edges();
    return std::all_of(facets.begin(), facets.end(), [&](std::uint32_t f) { return exists(f); }) &&
           std::all_of(edges.begin(), edges.end(), exists_there) &&
           (meeting.kind != Meeting::Kind::vertex_on_facet || exists_at(meeting.vertex));
  }

  /// What a meeting tells at a position that some of its features determine, and the space of the angle names by
  /// `source`; nothing where they do not determine one (w = 0). No contact where not vanishes(): other features miss
  /// the position.
  template <class P, class F, class S>
  std::optional<std::optional<SolidRotationContact>> contact_at(const Meeting& meeting, P position, F vanishes,
                                                                S source) {
    using Found = std::optional<SolidRotationContact>;
    const NearPosition at = near(position(jets_));
    if (provably_covered(at)) return Found();
    const int w = sign([&](const auto& s) { return position(s).w; });
    if (w == 0) return std::nullopt;
    if (!vanishes()) return Found();
    for (const SumEdge& e : meeting.all_edges())
      if (!on_edge(e, position, w)) return Found();
    for (const std::uint32_t f : meeting.all_facets())
      if (!in_facet(f, position, w)) return Found();
    return free_contact(meeting, at, source);
  }

  /// The contact where facets with this condition hold all others: the face plus the edge.
  std::optional<SolidRotationContact> normal_on_arc(const Meeting& meeting) {
    const SlantCondition& c = meeting.slant;
    const auto hangs_on = [&](const WindowFacet& f) {
      return std::any_of(f.unsure.begin(), f.unsure.end(), [&](const SlantCondition& d) {
        return d.op == c.op && d.triangle == c.triangle &&
               std::minmax(d.direction.from, d.direction.to) == std::minmax(c.direction.from, c.direction.to);
      });
    };
    bool any = false;
    for (std::uint32_t f = 0; f < w_.facets.size() && !any; ++f) any = hangs_on(w_.facets[f]) && exists(f);
    if (!any) return std::nullopt;
    ++work_.roots;
    const Triangle& t = pair_.operand(c.op).triangles[c.triangle];
    std::vector<Vec3> corners;
    double radius = 0;
    for (const std::uint32_t v : t)
      for (const std::uint32_t w : {c.direction.from, c.direction.to}) {
        const JetFrame::Vector at = jets_frame_.position(c.op, v) + jets_frame_.position(1 - c.op, w);
        corners.push_back({at.x.value, at.y.value, at.z.value});
        radius = std::max({radius, at.x.reach(), at.y.reach(), at.z.reach()});
      }
    if (in_balls(corners, radius)) {
      ++work_.covered;
      return std::nullopt;
    }
    SolidRotationContact contact;
    contact.kind = meeting.kind;
    const std::uint32_t name = pair_.operand(c.op).face[c.triangle];
    const SolidFeature face{SolidFeature::Kind::face, name, 0}, edge = edge_feature(c.direction.from, c.direction.to);
    contact.features = {c.op == 0 ? SolidContact{face, edge} : SolidContact{edge, face}};
    const Vec3 at = (1 / pair_.unit) * corners[0];
    contact.at = {at.x, at.y, at.z};
    return contact;
  }

  std::optional<SolidRotationContact> edge_and_facets(const Meeting& meeting, bool known) {
    const SumEdge& e = meeting.edges[0];
    for (int k = 0; k < 2; ++k) {
      const PlaneSource &plane = w_.facets[meeting.facets[k]].plane, &other = w_.facets[meeting.facets[1 - k]].plane;
      const auto found = contact_at(
          meeting, [&](const auto& s) { return s.at(e, s.plane(plane)); },
          [&] { return known || sign([&](const auto& s) { return s.order(e, s.plane(plane), s.plane(other)); }) == 0; },
          [&](SumSpace& space) {
            return PointSource{PointSource::Kind::edge, space.add_edges({&e, 1}), space.add_planes({&plane, 1}), 0};
          });
      if (found) return *found;
    }
    return std::nullopt;  // in both planes: it ends in the facets, or crosses facet edges of theirs
  }

  std::optional<SolidRotationContact> four_facets(const Meeting& meeting, bool known) {
    static constexpr int kThree[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
    for (const auto& three : kThree) {
      const auto plane = [&](int k) { return w_.facets[meeting.facets[three[k]]].plane; };
      const PlaneSource planes[3] = {plane(0), plane(1), plane(2)}, fourth = plane(3);
      const auto found = contact_at(
          meeting, [&](const auto& s) { return s.at(s.plane(planes[0]), s.plane(planes[1]), s.plane(planes[2])); },
          [&] {
            return known ||
                   sign([&](const auto& s) {
                     return s.height(s.plane(planes[0]), s.plane(planes[1]), s.plane(planes[2]), s.plane(fourth));
                   }) == 0;
          },
          [&](SumSpace& space) {
            const PlaneId first = space.add_planes(planes);
            return PointSource{PointSource::Kind::planes, first, first + 1, first + 2};
          });
      if (found) return *found;
    }
    return std::nullopt;  // all along a line, that ends in facet edges
  }

  NearPosition near(const Jets::Position& position) const {
    const JetFrame::Vector origin =
        jets_frame_.position(0, position.origin.p) + jets_frame_.position(1, position.origin.q);
    NearPosition near{{origin.x.value, origin.y.value, origin.z.value}, 0, false};
    const double w = std::abs(position.w.value), w_low = w - position.w.reach();
    if (w_low <= 0) return near;
    near.proved = true;
    near.at = near.at + (1 / position.w.value) * Vec3{position.x.x.value, position.x.y.value, position.x.z.value};
    for (const Jet* x : {&origin.x, &origin.y, &origin.z}) near.radius = std::max(near.radius, x->reach());
    for (const Jet* x : {&position.x.x, &position.x.y, &position.x.z})
      near.radius =
          std::max(near.radius, origin.x.reach() + (x->reach() + std::abs(x->value) * position.w.reach() / w) / w_low);
    near.radius *= 2;
    return near;
  }

  bool provably_covered(const NearPosition& position) {
    if (!position.proved) return false;
    if (!in_balls({position.at}, position.radius) && !provably_overlaps(position.at, position.radius)) return false;
    ++work_.roots, ++work_.covered;
    return true;
  }

  /// Whether a position lies in the open sum, exactly. Many meetings share one: each is tested once.
  bool is_covered(const NearPosition& near, const PointSource& position) {
    for (const TestedPosition& tested : tested_) {
      const Vec3 d = near.at - tested.near.at;
      const double room = near.radius + tested.near.radius + 0x1p-40;  // and what doubles of size 4 are rounded by
      if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > room) continue;
      if (space_->same_point(position, tested.position)) return tested.covered;
    }
    ++work_.exact_tests;
    tested_.push_back({near, position, collision_->overlaps({position})});
    return tested_.back().covered;
  }

  template <class F>
  std::optional<SolidRotationContact> free_contact(const Meeting& meeting, NearPosition near, F source) {
    ++work_.roots;
    space();
    const PointSource position = source(*space_);
    if (!near.proved) {
      const Approx rounded = space_->approximate(position);  // in multiples of the grid, weighted
      const double unit = std::ldexp(pair_.unit, pair_.pair.p_positions.exponent),
                   weight = exact::to_double(exact_frame_.weight());
      near.at = unit * ((1 / weight) * rounded.at), near.radius = unit * (rounded.radius / weight);
    }
    if (is_covered(near, position)) return std::nullopt;
    SolidRotationContact contact;
    contact.kind = meeting.kind;
    contact.features = features(meeting);
    const Vec3 at = (1 / pair_.unit) * near.at;
    contact.at = {at.x, at.y, at.z};
    return contact;
  }

  std::vector<SolidContact> features(const Meeting& meeting) const {
    std::vector<SolidContact> all;
    if (meeting.kind == Meeting::Kind::vertex_on_facet) all.push_back(features_of(meeting.vertex));
    for (const SumEdge& e : meeting.all_edges()) all.push_back(features_of(e));
    for (const std::uint32_t f : meeting.all_facets())
      all.push_back(spatial::features_of(w_.facets[f].facet, pair_.pair.p, pair_.pair.q));
    return all;
  }

  bool in_balls(const std::vector<Vec3>& positions, double radius) {
    const double margin = radius + 0x1p-36;
    for (const InnerBalls::Ball& a : turned_[0])
      for (const InnerBalls::Ball& b : turned_[1]) {
        const Vec3 centre = a.centre + b.centre;
        const double within = a.radius + b.radius - margin;
        if (within <= 0) continue;
        if (std::all_of(positions.begin(), positions.end(), [&](Vec3 x) {
              const Vec3 d = x - centre;
              return dot(d, d) < within * within;
            }))
          return true;
      }
    return false;
  }

  bool provably_overlaps(Vec3 at, double radius) {
    if (!overlap_) {
      std::array<std::vector<Vec3>, 2> positions = pair_.positions;
      for (Vec3& v : positions[pair_.turning]) v = jets_frame_.matrix() * v;
      overlap_.emplace(pair_.pair.p, std::move(positions[0]), pair_.pair.q, std::move(positions[1]));
    }
    // Vertices are at most 2 long, and those that have rotated off by 2^-44 of that.
    return overlap_->surfaces({at, 1, 2 * (radius + 0x1p-43)}) == ProvedOverlap::Answer::overlap;
  }

  const SumSpace& space() {
    if (space_) return *space_;
    std::array<std::vector<exact::Vector3<RootValue>>, 2> positions;
    int bits = 0;
    for (int op = 0; op < 2; ++op)
      for (std::uint32_t v = 0; v < pair_.operand(op).vertices.size(); ++v)
        positions[op].push_back(exact_frame_.placed(op, pair_.grid(op).position<exact::Big>(v), true));
    // A turned coordinate is at most twice a coordinate, times the weight.
    const double weight = exact::to_double(exact_frame_.weight());
    bits = std::max(pair_.pair.p_positions.bits, pair_.pair.q_positions.bits) + 1 + std::ilogb(weight) + 1;
    space_ = make_root_space(std::move(positions[0]), std::move(positions[1]), bits);
    collision_.emplace(*space_, pair_.pair.p, pair_.pair.q);
    return *space_;
  }

  const RotatingPair& pair_;
  const PairOfBalls& balls_;
  const RotationWindow& w_;
  SolidRotationWork& work_;
  const exact::AlgebraicRoot& root_;
  exact::RootPoint point_;
  std::optional<exact::BigRational> t_;  // where it is rational, and short
  double radians_ = 0, reach_ = 0;
  JetFrame jets_frame_;
  FineFrame fine_frame_;
  mutable std::optional<WideFrame> wide_frame_;  // made when it is requested
  PolynomialFrame exact_frame_;
  Jets jets_;
  RotationSigns<FineFrame> fine_;
  Exact exact_;
  std::array<std::vector<InnerBalls::Ball>, 2> turned_;
  std::optional<ProvedOverlap> overlap_;
  std::unique_ptr<SumSpace> space_;
  std::optional<Collision> collision_;
  struct TestedPosition {
    NearPosition near;
    PointSource position;
    bool covered = false;
  };
  std::vector<TestedPosition> tested_;
  mutable std::vector<std::int8_t> known_;  // per facet: exists, 0 not asked
};

}  // namespace

PairOfBalls::PairOfBalls(const RotatingPair& pair) {
  for (int op = 0; op < 2; ++op) {
    balls[op] = inner_balls(pair.operand(op)).balls;
    for (InnerBalls::Ball& b : balls[op]) b = {pair.unit * b.centre, pair.unit * b.radius * (1 - 0x1p-40) - 0x1p-40};
  }
}

std::vector<SolidRotationContact> contacts_at(const RotatingPair& pair, const PairOfBalls& balls,
                                              const RotationWindow& window, const exact::AlgebraicRoot& root,
                                              const MeetingsAt& meetings, SolidRotationWork& work,
                                              const std::function<void()>& again) {
  RootContacts all(pair, balls, window, root, work);
  std::vector<SolidRotationContact> contacts;
  const auto take = [&](SolidRotationContact contact) {
    if (!lists(contacts, contact)) contacts.push_back(std::move(contact));
    return contacts.size() < kMostContacts;
  };
  const auto add_all = [&] {
    for (const Meeting& m : meetings.all) {
      if (std::optional<SolidRotationContact> contact = all.contact(m, true); contact && !take(*std::move(contact)))
        return;
      again();
    }
    if (meetings.crowded) all.crossings(take, again);
  };
  add_all();
  std::sort(contacts.begin(), contacts.end(), precedes);
  return contacts;
}

}  // namespace dymsum::spatial

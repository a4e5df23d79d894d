#include "spatial/turning/turn_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "exact/root_bracket.h"
#include "spatial/turning/plane_hashes.h"

namespace dymsum::spatial {

using exact::AlgebraicRoot;
using exact::Polynomial;
using exact::RootValue;

namespace {

SumEdge ordered(const SumEdge& e) { return e.to < e.from ? SumEdge{e.to, e.from} : e; }
bool share_end(const SumEdge& a, const SumEdge& b) {
  return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
}

/// Whether a border of a facet runs inside a face of an operand, between triangles in one plane: it bounds nothing.
bool is_inner(const TurningPair& pair, const WindowFacet& f, int k) {
  if (f.facet.kind == SumFacet::Kind::edge_edge) return false;
  const int op = f.facet.kind == SumFacet::Kind::face_vertex ? 0 : 1;
  const SolidOperand& solid = pair.operand(op);
  const std::uint32_t t = op == 0 ? f.facet.p : f.facet.q;
  return solid.wedges[solid.wedge_of[3 * t + static_cast<std::uint32_t>(k)]].bend == Wedge::Bend::flat;
}

Box box_at(const JetFrame::Vector& at) {
  Box box;
  box.add(Vec3{at.x.low(), at.y.low(), at.z.low()}), box.add(Vec3{at.x.high(), at.y.high(), at.z.high()});
  return box;
}

class Finder {
 public:
  Finder(const TurningPair& pair, const SolidTurnWindow& window, TurningSolidWork& work,
         const std::function<void()>& again)
      : pair_(pair),
        w_(window),
        work_(work),
        again_(again),
        jets_frame_(pair, window.middle, window.half),
        exact_frame_(pair, window.range.chart),
        jets_(jets_frame_),
        exact_(exact_frame_) {
    const auto [low, ignored] = exact::double_bounds(w_.range.low);
    low_ = std::nextafter(low, -std::numeric_limits<double>::infinity());
    high_ = exact::double_bounds(w_.range.high).second;
  }

  std::vector<RootMeeting> run() {
    slants();
    std::vector<Box> boxes;
    for (const WindowFacet& f : w_.facets) boxes.push_back(f.box);
    tree_ = BoxTree(std::move(boxes));
    vertices_on_facets();
    edges_on_edges();
    crossings();
    facets_in_points();
    return std::move(found_);
  }

 private:
  using Jets = TurnSigns<JetFrame>;

  void poll() {
    if (++since_ % 512 == 0) again_();
  }

  /// What a form is made of, up to what stays the same at all angles: planes by their numbers.
  using Key = std::array<std::uint32_t, 5>;

  /// Roots of a form within the window; none where it vanishes at all angles.
  template <class F>
  void roots(const Key& key, F form, Meeting meeting) {
    const auto [at, fresh] = known_.emplace(key, Roots{static_cast<std::uint32_t>(known_.size()), {}});
    if (fresh) at->second.roots = roots_of(form(exact_).terms());
    meeting.place = at->second.place;
    for (const AlgebraicRoot& root : at->second.roots) found_.push_back({root, meeting});
  }
  std::vector<AlgebraicRoot> roots_of(exact::Terms terms) {
    ++work_.candidates;
    while (terms.size() > 3 && exact::divide_exactly(terms, pair_.circle.divisor())) continue;
    if (terms.size() < 2) return {};
    std::vector<exact::Big> c;
    for (exact::BigInteger& term : terms) c.emplace_back(std::move(term));
    std::vector<AlgebraicRoot> all =
        exact::roots_in(exact::primitive_part(Polynomial(std::move(c))), low_, high_, counts_);
    std::erase_if(all, [&](const AlgebraicRoot& root) {
      return exact::compare(root, w_.range.low) <= 0 || exact::compare(root, w_.range.high) > 0;
    });
    return all;
  }

  void slants() {
    std::set<Key> seen;
    for (const WindowFacet& f : w_.facets)
      for (const SlantCondition& c : f.unsure) {
        const std::uint32_t low = std::min(c.way.from, c.way.to), high = std::max(c.way.from, c.way.to);
        const Key key{0, static_cast<std::uint32_t>(c.op), c.triangle, low, high};
        if (!seen.insert(key).second) continue;
        poll();
        const Triangle& t = pair_.operand(c.op).triangles[c.triangle];
        if (jets_.slant(c.op, t, c.way).sign() != 0) continue;
        Meeting meeting;
        meeting.kind = Meeting::Kind::normal_on_arc, meeting.slant = c;
        roots(
            key, [&](const auto& s) { return s.slant(c.op, t, c.way); }, meeting);
      }
  }

  void vertices_on_facets() {
    for (const SumPoint v : w_.vertices) {
      const Box box = box_at(jets_frame_.place(0, v.p) + jets_frame_.place(1, v.q));
      tree_.for_each(box, [&](std::uint32_t f) {
        const WindowFacet& facet = w_.facets[f];
        poll();
        if (facet.has_corner(v) || jets_.side(facet.plane, v).sign() != 0) return;
        const Jets::Place at = jets_.at(v);
        if (surely_outside(facet, at)) return;
        Meeting meeting;
        meeting.kind = Meeting::Kind::vertex_on_facet, meeting.vertex = v, meeting.facets[0] = f;
        roots(
            {1, v.p, v.q, w_.plane_of[f], 0}, [&](const auto& s) { return s.side(facet.plane, v); }, meeting);
      });
    }
  }

  bool surely_outside(const WindowFacet& f, const Jets::Place& at) const {
    const int w = at.w.sign();
    if (w == 0) return false;
    const JetFrame::Vector n = jets_.normal(f.plane);
    for (int k = 0; k < f.facet.corners; ++k)
      if (jets_.inside(n, f.border(k), at).sign() * w < 0) return true;
    return false;
  }

  /// Two edges in one plane across the axis, or both along the axis.
  bool always_coplanar(std::uint32_t i, std::uint32_t j) const {
    return (level_[i] && level_[i] == level_[j]) || (upright_[i] != 0 && upright_[j] != 0);
  }
  void find_levels() {
    const TurnAxis& axis = pair_.circle.axis();
    const auto along = [&](int op, std::uint32_t v) {
      const auto at = pair_.grid(op).place<exact::Big>(v);
      const auto by = [](std::int32_t c) { return exact::Big::from_int64(c); };
      return (by(axis[0]) * at.x + by(axis[1]) * at.y + by(axis[2]) * at.z).value();
    };
    for (const SumEdge& e : w_.edges) {
      const exact::BigInteger from = along(0, e.from.p) + along(1, e.from.q), to = along(0, e.to.p) + along(1, e.to.q);
      level_.push_back(from == to ? std::optional(from) : std::nullopt);
      const bool of_p = e.from.q == e.to.q;
      upright_.push_back(of_p ? pair_.along_axis(0, e.from.p, e.to.p) : pair_.along_axis(1, e.from.q, e.to.q));
    }
  }

  void edges_on_edges() {
    find_levels();
    std::vector<Box> boxes;
    for (const SumEdge& e : w_.edges) {
      Box box = box_at(jets_frame_.place(0, e.from.p) + jets_frame_.place(1, e.from.q));
      box.add(box_at(jets_frame_.place(0, e.to.p) + jets_frame_.place(1, e.to.q)));
      boxes.push_back(box);
    }
    edge_boxes_ = boxes;
    const BoxTree tree(std::move(boxes));
    for (std::uint32_t i = 0; i < w_.edges.size(); ++i) {
      if (!w_.bounds[i]) continue;
      const SumEdge& a = w_.edges[i];
      tree.for_each(edge_boxes_[i], [&](std::uint32_t j) {
        if (j <= i || !w_.bounds[j] || share_end(a, w_.edges[j]) || always_coplanar(i, j)) return;
        poll();
        const SumEdge& b = w_.edges[j];
        if (jets_.twist(a, b).sign() != 0) return;
        const Jets::Place at = jets_.at(a, b);
        if (surely_beyond(a, at) || surely_beyond(b, jets_.at(b, a))) return;
        Meeting meeting;
        meeting.kind = Meeting::Kind::edge_on_edge, meeting.a = a, meeting.b = b;
        roots(
            {2, i, j, 0, 0}, [&](const auto& s) { return s.twist(a, b); }, meeting);
      });
    }
  }
  bool surely_beyond(const SumEdge& e, const Jets::Place& at) const {
    const int w = at.w.sign();
    return w != 0 && (jets_.beyond(e, e.from, at).sign() * w > 0 || jets_.beyond(e, e.to, at).sign() * w > 0);
  }

  /// Edges that may pass through facets; and of each edge pairs of these.
  void crossings() {
    neighbours_.resize(w_.facets.size());
    for (std::uint32_t i = 0; i < w_.edges.size(); ++i) {
      const SumEdge& e = w_.edges[i];
      std::vector<std::uint32_t> met;
      tree_.for_each(edge_boxes_[i], [&](std::uint32_t f) {
        poll();
        if (may_pass(e, w_.facets[f])) met.push_back(f);
      });
      std::sort(met.begin(), met.end());
      for (const std::uint32_t f : met)
        for (const std::uint32_t g : w_.facets_at_edge[i]) {
          neighbours_[f].push_back(g), neighbours_[g].push_back(f);
        }
      for (std::size_t k = 0; k < met.size() && w_.bounds[i]; ++k)
        for (std::size_t l = k + 1; l < met.size(); ++l) {
          const WindowFacet &f = w_.facets[met[k]], &g = w_.facets[met[l]];
          poll();
          if (w_.plane_of[met[k]] == w_.plane_of[met[l]] || !overlap(f.box, g.box)) continue;
          if (jets_.order(e, f.plane, g.plane).sign() != 0) continue;
          Meeting meeting;
          meeting.kind = Meeting::Kind::edge_and_facets, meeting.a = e, meeting.facets = {met[k], met[l], 0, 0};
          const auto [low, high] = std::minmax(w_.plane_of[met[k]], w_.plane_of[met[l]]);
          roots(
              {3, i, low, high, 0}, [&](const auto& s) { return s.order(e, f.plane, g.plane); }, meeting);
        }
    }
  }
  bool may_pass(const SumEdge& e, const WindowFacet& f) const {
    for (int k = 0; k < f.facet.corners; ++k)
      if (ordered(f.border(k)) == e) return false;
    if (f.has_corner(e.from) || f.has_corner(e.to)) return false;  // passes the plane there, if it is not in it
    const int from = jets_.side(f.plane, e.from).sign(), to = jets_.side(f.plane, e.to).sign();
    if (from * to > 0) return false;
    const int rise = jets_.rise(f.plane, e).sign();
    for (int k = 0; k < f.facet.corners && rise != 0; ++k)
      if (jets_.twist(e, f.border(k)).sign() * rise > 0) return false;
    return true;
  }

  /// Two facets cross along a segment whose ends are on borders, so neighbours are all that cross somewhere within the
  /// window, but for those that share a corner.
  void facets_in_points() {
    for (std::uint32_t v = 0; v < w_.vertices.size(); ++v) join_around(w_.facets_at_vertex[v]);
    for (auto& list : neighbours_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    std::vector<std::uint32_t> of_two, of_three;
    for (std::uint32_t f = 0; f < w_.facets.size(); ++f)
      for (const std::uint32_t g : neighbours_[f]) {
        if (g <= f || !crossing(f, g)) continue;
        common(neighbours_[f], neighbours_[g], g, of_two);
        for (const std::uint32_t h : of_two) {
          if (!crossing(f, h) || !crossing(g, h) || !may_have_point(f, g, h)) continue;
          common(of_two, neighbours_[h], h, of_three);
          for (const std::uint32_t k : of_three)
            if (crossing(f, k) && crossing(g, k) && crossing(h, k)) four(f, g, h, k);
        }
      }
  }
  void join_around(const std::vector<std::uint32_t>& around) {
    for (const std::uint32_t f : around)
      for (const std::uint32_t g : around)
        if (f != g && !share_border(f, g)) neighbours_[f].push_back(g);
  }
  bool share_border(std::uint32_t f, std::uint32_t g) const {
    int shared = 0;
    for (int k = 0; k < w_.facets[f].facet.corners; ++k)
      shared += w_.facets[g].has_corner(w_.facets[f].facet.corner[k]);
    return shared >= 2;
  }
  bool crossing(std::uint32_t f, std::uint32_t g) const {
    return w_.plane_of[f] != w_.plane_of[g] && overlap(w_.facets[f].box, w_.facets[g].box) && !share_border(f, g);
  }
  static void common(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b, std::uint32_t above,
                     std::vector<std::uint32_t>& out) {
    out.clear();
    std::set_intersection(std::upper_bound(a.begin(), a.end(), above), a.end(),
                          std::upper_bound(b.begin(), b.end(), above), b.end(), std::back_inserter(out));
  }
  bool may_have_point(std::uint32_t f, std::uint32_t g, std::uint32_t h) {
    poll();
    const WindowFacet &a = w_.facets[f], &b = w_.facets[g], &c = w_.facets[h];
    if (!overlap(a.box, c.box)) return false;
    const Jets::Place at = jets_.at(a.plane, b.plane, c.plane);
    return !surely_outside(a, at) && !surely_outside(b, at) && !surely_outside(c, at);
  }
  void four(std::uint32_t f, std::uint32_t g, std::uint32_t h, std::uint32_t k) {
    const WindowFacet &a = w_.facets[f], &b = w_.facets[g], &c = w_.facets[h], &d = w_.facets[k];
    poll();
    for (int i = 0; i < a.facet.corners; ++i) {  // a common corner is no event
      const SumPoint v = a.facet.corner[i];
      if (b.has_corner(v) && c.has_corner(v) && d.has_corner(v)) return;
    }
    if (jets_.height(a.plane, b.plane, c.plane, d.plane).sign() != 0) return;
    const Jets::Place at = jets_.at(a.plane, b.plane, c.plane);
    if (surely_outside(d, at)) return;
    Meeting meeting;
    meeting.kind = Meeting::Kind::four_facets, meeting.facets = {f, g, h, k};
    Key key{4, w_.plane_of[f], w_.plane_of[g], w_.plane_of[h], w_.plane_of[k]};
    std::sort(key.begin() + 1, key.end());
    roots(
        key, [&](const auto& s) { return s.height(a.plane, b.plane, c.plane, d.plane); }, meeting);
  }

  struct Roots {
    std::uint32_t place;
    std::vector<AlgebraicRoot> roots;
  };
  const TurningPair& pair_;
  const SolidTurnWindow& w_;
  TurningSolidWork& work_;
  const std::function<void()>& again_;
  JetFrame jets_frame_;
  PolynomialFrame exact_frame_;
  Jets jets_;
  TurnSigns<PolynomialFrame> exact_;
  double low_ = 0, high_ = 0;
  BoxTree tree_;
  std::vector<Box> edge_boxes_;
  std::vector<std::vector<std::uint32_t>> neighbours_;  // per facet, those that may cross it
  exact::FilterCounts counts_;
  std::map<Key, Roots> known_;
  std::vector<RootMeeting> found_;
  std::vector<std::optional<exact::BigInteger>> level_;  // per edge, of those in a plane across the axis
  std::vector<std::uint8_t> upright_;                    // per edge, of those along the axis
  std::size_t since_ = 0;
};

}  // namespace

namespace {

/// Whether two planes are one at every angle.
bool same_plane(const TurnSigns<PolynomialFrame>& signs, const WindowFacet& f, const WindowFacet& g) {
  const auto c = exact::cross(signs.normal(f.plane), signs.normal(g.plane));
  return c.x.terms().empty() && c.y.terms().empty() && c.z.terms().empty() &&
         signs.side(f.plane, g.plane.at).terms().empty();
}

/// Numbers for planes: those with equal hashes are compared exactly, with the first of each.
std::vector<std::uint32_t> number_planes(const TurningPair& pair, const SolidTurnWindow& window) {
  const PlaneHashes hashes(pair, window.range.chart);
  const PolynomialFrame frame(pair, window.range.chart);
  const TurnSigns<PolynomialFrame> signs(frame);
  std::multimap<std::uint64_t, std::uint32_t> first;  // facets by hash
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t f = 0; f < window.facets.size(); ++f) {
    const std::uint64_t hash = hashes.of(signs, window.facets[f].plane);
    std::uint32_t number = f;
    for (auto [at, end] = first.equal_range(hash); at != end && number == f; ++at)
      if (same_plane(signs, window.facets[at->second], window.facets[f])) number = at->second;
    if (number == f) first.emplace(hash, f);
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

SolidTurnWindow::SolidTurnWindow(const TurningPair& pair, const GaussMaps& maps, const TurnRangeOfT& given)
    : range(given) {
  const double low = pair.circle.radians(range.chart, exact::round_to_double(range.low)),
               high = pair.circle.radians(range.chart, exact::round_to_double(range.high));
  middle = (low + high) / 2, half = (high - low) / 2 * (1 + 0x1p-30) + 0x1p-45;
  facets = maps.facets(middle, half);
  std::map<SumPoint, std::vector<std::uint32_t>> at_vertex;
  std::map<SumEdge, std::vector<std::uint32_t>> at_edge;
  std::set<SumEdge> inner;
  for (std::uint32_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < facets[f].facet.corners; ++k) {
      at_vertex[facets[f].facet.corner[k]].push_back(f);
      const SumEdge e = ordered(facets[f].border(k));
      at_edge[e].push_back(f);
      if (is_inner(pair, facets[f], k)) inner.insert(e);
    }
  plane_of = number_planes(pair, *this);
  for (auto& [v, list] : at_vertex) vertices.push_back(v), facets_at_vertex.push_back(std::move(list));
  for (auto& [e, list] : at_edge) {
    edges.push_back(e), facets_at_edge.push_back(std::move(list));
    bounds.push_back(!inner.contains(e));
  }
}

const std::vector<std::uint32_t>& SolidTurnWindow::around(SumPoint v) const {
  return facets_at_vertex[std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin()];
}
const std::vector<std::uint32_t>& SolidTurnWindow::around(const SumEdge& e) const {
  return facets_at_edge[std::lower_bound(edges.begin(), edges.end(), e) - edges.begin()];
}

std::vector<RootMeeting> meetings_in(const TurningPair& pair, const SolidTurnWindow& window, TurningSolidWork& work,
                                     const std::function<void()>& again) {
  ++work.windows, work.facets += window.facets.size();
  return Finder(pair, window, work, again).run();
}

}  // namespace dymsum::spatial

#include "spatial/events/rotation_candidates.h"

#include <algorithm>
#include <map>
#include <optional>

#include "spatial/events/crossing_search.h"
#include "spatial/events/plane_names.h"

namespace dymsum::spatial {

using exact::AlgebraicRoot;

namespace {

/// Whether a edge of a facet runs inside a face of an operand, between triangles in one plane: it bounds nothing.
bool is_inner(const RotatingPair& pair, const WindowFacet& f, int k) {
  if (f.facet.kind == SumFacet::Kind::edge_edge) return false;
  const int op = f.facet.kind == SumFacet::Kind::face_vertex ? 0 : 1;
  const SolidOperand& solid = pair.operand(op);
  const std::uint32_t t = op == 0 ? f.facet.p : f.facet.q;
  return solid.wedges[solid.wedge_of[3 * t + static_cast<std::uint32_t>(k)]].bend == Wedge::Bend::flat;
}

/// The width in radians below which windows are looked at in pairs of doubles.
constexpr double kNarrowWindow = 0x1p-20;

/// What does not happen in the window is determined by signs in `Frame`.
template <class Frame>
class Finder {
 public:
  Finder(const RotatingPair& pair, const RotationWindow& window, const Frame& frame, SolidRotationWork& work,
         const std::function<void()>& again)
      : pair_(pair),
        w_(window),
        again_(again),
        boxes_(pair, window.midpoint, window.half),
        frame_(frame),
        exact_frame_(pair, window.range.chart),
        jets_(frame_),
        exact_(exact_frame_),
        roots_(pair.circle, window.range, work),
        exact_planes_(window.facets.size()) {}

  WindowMeetings run() {
    slants();
    if (!result_.parts.empty()) return std::move(result_);
    vertices_on_facets();
    edges_on_edges();
    find_crossings(w_, frame_, boxes_, result_.cells.of, again_, [&](const Meeting& meeting) {
      add_crossing(meeting);
      return true;
    });
    result_.angles = std::move(roots_.angles());
    return std::move(result_);
  }

 private:
  using Jets = RotationSigns<Frame>;
  using SidedPlane = typename Jets::SidedPlane;
  using Position = typename Jets::Position;
  using ExactPlane = RotationSigns<PolynomialFrame>::SidedPlane;

  void poll() {
    if (++since_ % 512 == 0) again_();
  }

  /// What a form is made of, up to what stays the same at all angles: planes by their indices.
  using Key = std::array<std::uint32_t, 5>;
  void add(const FormRoot& root, const Meeting& meeting) { result_.meetings.push_back({root.angle, meeting}); }

  /// Adds candidates at all roots of a form.
  template <class F>
  void add_roots(const Key& key, const Meeting& meeting, F form) {
    const auto [at, fresh] = known_.try_emplace(key);
    if (fresh) at->second = form();
    for (const FormRoot& root : at->second) add(root, meeting);
  }

  void slants() {
    const WindowSlants slants(
        pair_, w_.facets,
        [&](const SlantCondition& c) {
          return jets_.slant(c.op, pair_.operand(c.op).triangles[c.triangle], c.direction).sign();
        },
        w_.range, roots_, again_);
    result_.parts = parts_of(slants, roots_.angles(), w_.range);
    if (!result_.parts.empty()) return;
    result_.cells = FacetCells(w_.facets, slants, roots_.angles());
    for (const WindowSlant& slant : slants.all()) {
      Meeting meeting;
      meeting.kind = Meeting::Kind::normal_on_arc, meeting.slant = slant.of;
      for (const FormRoot& root : slant.roots) add(root, meeting);
    }
  }

  /// False only where a facet exists at no angle of the window; at crowded ones it may exist without a cell.
  bool may_exist(std::uint32_t facet) const { return !result_.cells.crowded.empty() || result_.cells.of[facet] != 0; }
  bool any_may_exist(std::span<const std::uint32_t> facets) const {
    return std::any_of(facets.begin(), facets.end(), [&](std::uint32_t f) { return may_exist(f); });
  }

  void vertices_on_facets() {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> live;
    for (std::uint32_t f = 0; f < w_.facets.size(); ++f)
      if (may_exist(f)) live.push_back(f), boxes.push_back(w_.facets[f].box);
    const BoxTree tree(std::move(boxes));
    const FeatureLists<SumPoint>& vertices = w_.graph.corners;
    for (std::uint32_t k = 0; k < vertices.size(); ++k) {
      const SumPoint v = vertices[k];
      if (!any_may_exist(vertices.around(k))) continue;
      tree.for_each(boxes_.box(v), [&](std::uint32_t j) {
        const std::uint32_t f = live[j];
        const WindowFacet& facet = w_.facets[f];
        poll();
        if (facet.has_corner(v)) return;
        const SidedPlane plane = jets_.plane(facet.plane);
        if (jets_.side(plane, v).sign() != 0) return;
        const auto inward = [&](int facet_edge) { return jets_.inward(plane.normal, facet.facet_edge(facet_edge)); };
        if (provably_outside(jets_, facet, jets_.at(v), inward)) return;
        Meeting meeting;
        meeting.kind = Meeting::Kind::vertex_on_facet, meeting.vertex = v, meeting.facets[0] = f;
        add_roots({1, v.p, v.q, w_.plane_of[f], 0}, meeting,
                  [&] { return roots_.of(exact_.side(exact_.plane(facet.plane), v).terms()); });
      });
    }
  }
  /// Two edges in one plane across the axis, or both along the axis.
  bool always_coplanar(std::uint32_t i, std::uint32_t j) const {
    return (level_[i] && level_[i] == level_[j]) || (upright_[i] != 0 && upright_[j] != 0);
  }
  void find_levels() {
    const TurnAxis& axis = pair_.circle.axis();
    const auto along = [&](int op, std::uint32_t v) {
      const auto at = pair_.grid(op).position<exact::Big>(v);
      const auto by = [](std::int32_t c) { return exact::Big::from_int64(c); };
      return (by(axis[0]) * at.x + by(axis[1]) * at.y + by(axis[2]) * at.z).value();
    };
    for (const SumEdge& e : w_.graph.edges.all()) {
      const exact::BigInteger from = along(0, e.from.p) + along(1, e.from.q), to = along(0, e.to.p) + along(1, e.to.q);
      level_.push_back(from == to ? std::optional(from) : std::nullopt);
      const DirectionSource direction = direction_of(e);
      upright_.push_back(
          pair_.along_axis(direction.of == DirectionSource::Of::p ? 0 : 1, direction.from, direction.to));
    }
  }

  void edges_on_edges() {
    find_levels();
    std::vector<Box> boxes;
    std::vector<std::uint32_t> live;
    const FeatureLists<SumEdge>& edges = w_.graph.edges;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      if (!w_.bounds[i] || !any_may_exist(edges.around(i))) continue;
      const SumEdge& e = edges[i];
      Box box = boxes_.box(e.from);
      box.add(boxes_.box(e.to));
      live.push_back(i), boxes.push_back(box);
    }
    const BoxTree tree(std::move(boxes));
    for (std::uint32_t n = 0; n < live.size(); ++n) {
      const std::uint32_t i = live[n];
      const SumEdge& a = edges[i];
      tree.for_each(tree.box(n), [&](std::uint32_t m) {
        const std::uint32_t j = live[m];
        if (j <= i || share_end(a, edges[j]) || always_coplanar(i, j)) return;
        poll();
        const SumEdge& b = edges[j];
        if (jets_.twist(a, b).sign() != 0) return;
        const Position at = jets_.at(a, b);
        if (provably_beyond(a, at) || provably_beyond(b, jets_.at(b, a))) return;
        Meeting meeting;
        meeting.kind = Meeting::Kind::edge_on_edge, meeting.edges = {a, b};
        add_roots({2, i, j, 0, 0}, meeting, [&] { return roots_.of(exact_.twist(a, b).terms()); });
      });
    }
  }
  bool provably_beyond(const SumEdge& e, const Position& at) const {
    const int w = at.w.sign();
    return w != 0 && (jets_.beyond(e, e.from, at).sign() * w > 0 || jets_.beyond(e, e.to, at).sign() * w > 0);
  }

  /// An edge and two facets, or four facets. What they do at crowded angles is asked there.
  void add_crossing(const Meeting& m) {
    const auto plane = [&](int k) { return w_.plane_of[m.facets[k]]; };
    const auto exact_plane = [&](int k) -> const ExactPlane& {
      std::optional<ExactPlane>& plane = exact_planes_[m.facets[k]];
      if (!plane) plane = exact_.plane(w_.facets[m.facets[k]].plane);
      return *plane;
    };
    if (m.kind == Meeting::Kind::edge_and_facets) {
      const std::uint32_t edge = w_.graph.edges.index(m.edges[0]);
      add_roots({3, edge, std::min(plane(0), plane(1)), std::max(plane(0), plane(1)), 0}, m,
                [&] { return uncrowded(roots_.of(exact_.order(m.edges[0], exact_plane(0), exact_plane(1)).terms())); });
      return;
    }
    Key key{4, plane(0), plane(1), plane(2), plane(3)};
    std::sort(key.begin() + 1, key.end());
    add_roots(key, m, [&] {
      return uncrowded(
          roots_.of(exact_.height(exact_plane(0), exact_plane(1), exact_plane(2), exact_plane(3)).terms()));
    });
  }
  std::vector<FormRoot> uncrowded(std::vector<FormRoot> roots) const {
    std::erase_if(roots, [&](const FormRoot& root) { return result_.cells.is_crowded(root.angle); });
    return roots;
  }

  const RotatingPair& pair_;
  const RotationWindow& w_;
  const std::function<void()>& again_;
  JetFrame boxes_;
  const Frame& frame_;
  PolynomialFrame exact_frame_;
  Jets jets_;
  RotationSigns<PolynomialFrame> exact_;
  WindowRoots roots_;
  std::vector<std::optional<ExactPlane>> exact_planes_;  // of facets, where they were requested
  WindowMeetings result_;
  std::map<Key, std::vector<FormRoot>> known_;
  std::vector<std::optional<exact::BigInteger>> level_;  // per edge, of those in a plane across the axis
  std::vector<std::uint8_t> upright_;                    // per edge, of those along the axis
  std::size_t since_ = 0;
};

/// Whether two planes are one at every angle.
bool same_plane(const RotationSigns<PolynomialFrame>& signs, const WindowFacet& f, const WindowFacet& g) {
  const auto c = exact::cross(signs.normal(f.plane), signs.normal(g.plane));
  return c.x.terms().empty() && c.y.terms().empty() && c.z.terms().empty() &&
         signs.side(signs.plane(f.plane), g.plane.at).terms().empty();
}

/// Numbers for planes: those with equal hashes are compared exactly, with the first of each.
std::vector<std::uint32_t> number_planes(const RotatingPair& pair, const RotationWindow& window) {
  const PolynomialFrame frame(pair, window.range.chart);
  const RotationSigns<PolynomialFrame> signs(frame);
  std::multimap<std::uint64_t, std::uint32_t> first;  // facets by hash
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t f = 0; f < window.facets.size(); ++f) {
    const std::uint64_t hash = plane_hash(frame, window.facets[f].plane);
    std::uint32_t number = f;
    for (auto [at, end] = first.equal_range(hash); at != end && number == f; ++at)
      if (same_plane(signs, window.facets[at->second], window.facets[f])) number = at->second;
    if (number == f) first.emplace(hash, f);
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

RotationWindow::RotationWindow(const RotatingPair& pair, const GaussMaps& maps, const RotationRange& given)
    : range(given) {
  const double low = pair.circle.radians(range.chart, exact::round_to_double(range.low)),
               high = pair.circle.radians(range.chart, exact::round_to_double(range.high));
  midpoint = (low + high) / 2, half = (high - low) / 2 * (1 + 0x1p-30) + 0x1p-45;
  facets = maps.facets(midpoint, half);
  std::vector<SumFacet> all;
  for (const WindowFacet& f : facets) all.push_back(f.facet);
  graph = FacetGraph(all);
  bounds.assign(graph.edges.size(), true);
  for (std::uint32_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < facets[f].facet.corners; ++k)
      if (is_inner(pair, facets[f], k)) bounds[graph.edges.of(f, k)] = false;
  plane_of = number_planes(pair, *this);
}

WindowMeetings meetings_in(const RotatingPair& pair, const RotationWindow& window, SolidRotationWork& work,
                           const std::function<void()>& again) {
  ++work.windows, work.facets += window.facets.size();
  if (window.half < kNarrowWindow) {
    const FineFrame fine(pair, window.range.chart, window.range.low, window.range.high);
    return Finder<FineFrame>(pair, window, fine, work, again).run();
  }
  const JetFrame jets(pair, window.midpoint, window.half);
  return Finder<JetFrame>(pair, window, jets, work, again).run();
}

}  // namespace dymsum::spatial

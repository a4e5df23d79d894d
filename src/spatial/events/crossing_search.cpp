#include "spatial/events/crossing_search.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

void common(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b, std::uint32_t above,
            std::vector<std::uint32_t>& out) {
  out.clear();
  std::set_intersection(std::upper_bound(a.begin(), a.end(), above), a.end(),
                        std::upper_bound(b.begin(), b.end(), above), b.end(), std::back_inserter(out));
}

template <class Frame>
class CrossingSearch {
 public:
  CrossingSearch(const RotationWindow& window, const Frame& frame, const JetFrame& boxes_frame,
                 std::vector<RotationCells> cells, const std::function<void()>& again)
      : w_(window),
        again_(again),
        boxes_(boxes_frame),
        jets_(frame),
        cells_(std::move(cells)),
        near_(window.facets.size()) {
    std::vector<Box> boxes;
    for (std::uint32_t f = 0; f < w_.facets.size(); ++f) {
      if (cells_[f] == 0) continue;
      const WindowFacet& facet = w_.facets[f];
      NearFacet& near = near_[f];
      near.plane = jets_.plane(facet.plane);
      for (int k = 0; k < facet.facet.corners; ++k) {
        near.inward[k] = jets_.inward(near.plane.normal, facet.facet_edge(k));
        near.box.add(boxes_.box(facet.facet.corner[k]));
      }
      live_.push_back(f), boxes.push_back(near.box);
    }
    tree_ = BoxTree(std::move(boxes));
  }

  using Take = std::function<bool(const Meeting&)>;

  /// Calls take(meeting) until it says false.
  void run(const Take& take) {
    neighbours_.assign(w_.facets.size(), {});
    std::vector<std::uint32_t> met;
    for (std::uint32_t e = 0; e < w_.graph.edges.size(); ++e) {
      pass(e, met);
      if (w_.bounds[e] && !pairs_along(e, met, take)) return;
    }
    join_neighbours();
    for (const std::uint32_t f : live_)
      for (const std::uint32_t g : neighbours_[f])
        if (g > f && crossing(f, g) && !fours_of(f, g, take)) return;
  }

 private:
  using Jets = RotationSigns<Frame>;
  using SidedPlane = typename Jets::SidedPlane;
  using Position = typename Jets::Position;
  struct NearFacet {
    SidedPlane plane;
    std::array<typename Jets::Vector, 4> inward;  ///< of facet edges
    Box box;
  };

  void poll() {
    if (++since_ % 512 == 0) again_();
  }
  RotationCells cells_around(std::uint32_t edge) const {
    RotationCells cells = 0;
    for (const std::uint32_t f : w_.graph.edges.around(edge)) cells |= cells_[f];
    return cells;
  }

  /// The facets that an edge may pass through, which thereby are neighbours of those beside it.
  void pass(std::uint32_t edge, std::vector<std::uint32_t>& met) {
    met.clear();
    const RotationCells cells = cells_around(edge);
    if (cells == 0) return;
    const SumEdge& e = w_.graph.edges[edge];
    Box box = boxes_.box(e.from);
    box.add(boxes_.box(e.to));
    tree_.for_each(box, [&](std::uint32_t k) {
      poll();
      if ((cells & cells_[live_[k]]) != 0 && may_pass(e, live_[k])) met.push_back(live_[k]);
    });
    std::sort(met.begin(), met.end());
    for (const std::uint32_t f : met)
      for (const std::uint32_t g : w_.graph.edges.around(edge))
        if ((cells_[f] & cells_[g]) != 0) neighbours_[f].push_back(g), neighbours_[g].push_back(f);
  }

  bool may_pass(const SumEdge& e, std::uint32_t facet) const {
    const WindowFacet& f = w_.facets[facet];
    const bool from_corner = f.has_corner(e.from), to_corner = f.has_corner(e.to);
    if (from_corner && to_corner) return false;  // in its plane at all angles
    const SidedPlane& plane = near_[facet].plane;
    const int rise = jets_.rise(plane, e).sign();
    if (from_corner || to_corner)
      return rise == 0 && may_turn_into(facet, from_corner ? e.from : e.to, from_corner ? e.to : e.from);
    const int from = jets_.side(plane, e.from).sign(), to = jets_.side(plane, e.to).sign();
    if (from * to > 0) return false;
    for (int k = 0; k < f.facet.corners && rise != 0; ++k)
      if (jets_.twist(e, f.facet_edge(k)).sign() * rise > 0) return false;
    return true;
  }

  /// Whether the way from a corner of a facet to a point may lead into its plane between the facet edges at that
  /// corner.
  bool may_turn_into(std::uint32_t facet, SumPoint corner, SumPoint to) const {
    const WindowFacet& f = w_.facets[facet];
    for (int k = 0; k < f.facet.corners; ++k) {
      const SumEdge facet_edge = f.facet_edge(k);
      if (facet_edge.from != corner && facet_edge.to != corner) continue;
      if (jets_.inside(near_[facet].inward[k], corner, jets_.at(to)).sign() < 0) return false;
    }
    return true;
  }

  bool pairs_along(std::uint32_t edge, const std::vector<std::uint32_t>& met, const Take& take) {
    const SumEdge& e = w_.graph.edges[edge];
    const RotationCells cells = cells_around(edge);
    for (std::size_t k = 0; k < met.size(); ++k)
      for (std::size_t l = k + 1; l < met.size(); ++l) {
        const std::uint32_t f = met[k], g = met[l];
        poll();
        if ((cells & cells_[f] & cells_[g]) == 0 || (has_end(f, e) && has_end(g, e))) continue;
        if (w_.plane_of[f] == w_.plane_of[g] || !overlap(near_[f].box, near_[g].box)) continue;
        if (jets_.order(e, near_[f].plane, near_[g].plane).sign() != 0) continue;
        Meeting meeting;
        meeting.kind = Meeting::Kind::edge_and_facets, meeting.edges[0] = e, meeting.facets = {f, g, 0, 0};
        if (!take(meeting)) return false;
      }
    return true;
  }

  /// Two facets cross along a segment whose ends are on facet edges, so that neighbours are all that cross somewhere,
  /// but for those that share a corner, or a facet edge about which they fold.
  void join_neighbours() {
    for (std::uint32_t v = 0; v < w_.graph.corners.size(); ++v)
      for (const std::uint32_t f : w_.graph.corners.around(v))
        for (const std::uint32_t g : w_.graph.corners.around(v))
          if (f != g && (cells_[f] & cells_[g]) != 0 && crossing(f, g)) neighbours_[f].push_back(g);
    for (std::vector<std::uint32_t>& list : neighbours_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  bool has_end(std::uint32_t facet, const SumEdge& e) const {
    return w_.facets[facet].has_corner(e.from) || w_.facets[facet].has_corner(e.to);
  }

  /// Whether two facets in different planes share a facet edge, or two other corners, and meet nowhere else. They do
  /// where they fold onto each other, at an angle at which their planes are one.
  bool meet_in_facet_edge(std::uint32_t f, std::uint32_t g) const {
    const WindowFacet &a = w_.facets[f], &b = w_.facets[g];
    int shared = 0;
    for (int k = 0; k < a.facet.corners; ++k) shared += b.has_corner(a.facet.corner[k]);
    if (shared < 2) return false;
    for (int k = 0; k < a.facet.corners; ++k)
      if (jets_.side(near_[g].plane, a.facet.corner[k]).sign() != 0) return true;
    for (int k = 0; k < a.facet.corners; ++k) {
      const SumEdge e = a.facet_edge(k);
      for (int l = 0; l < b.facet.corners; ++l) {
        const SumEdge other = b.facet_edge(l);
        if ((e == other || e == SumEdge{other.to, other.from}) &&
            dot(near_[f].inward[k], near_[g].inward[l]).sign() < 0)
          return true;
      }
    }
    return false;
  }

  bool crossing(std::uint32_t f, std::uint32_t g) const {
    return w_.plane_of[f] != w_.plane_of[g] && overlap(near_[f].box, near_[g].box) && !meet_in_facet_edge(f, g);
  }

  bool fours_of(std::uint32_t f, std::uint32_t g, const Take& take) {
    std::vector<std::uint32_t> of_two, of_three;
    common(neighbours_[f], neighbours_[g], g, of_two);
    const RotationCells both = cells_[f] & cells_[g];
    for (const std::uint32_t h : of_two) {
      poll();
      const RotationCells all = both & cells_[h];
      if (all == 0 || !crossing(f, h) || !crossing(g, h)) continue;
      const Position at = jets_.at(near_[f].plane, near_[g].plane, near_[h].plane);
      if (provably_outside(f, at) || provably_outside(g, at) || provably_outside(h, at)) continue;
      common(of_two, neighbours_[h], h, of_three);
      for (const std::uint32_t k : of_three) {
        poll();
        if ((all & cells_[k]) == 0 || !crossing(f, k) || !crossing(g, k) || !crossing(h, k)) continue;
        Meeting meeting;
        meeting.kind = Meeting::Kind::four_facets, meeting.facets = {f, g, h, k};
        if (may_meet(meeting.facets, at) && !take(meeting)) return false;
      }
    }
    return true;
  }

  bool may_meet(const std::array<std::uint32_t, 4>& four, const Position& at) const {
    const std::uint32_t f = four[0], g = four[1], h = four[2], k = four[3];
    for (int i = 0; i < w_.facets[f].facet.corners; ++i) {  // a common corner is no event
      const SumPoint v = w_.facets[f].facet.corner[i];
      if (w_.facets[g].has_corner(v) && w_.facets[h].has_corner(v) && w_.facets[k].has_corner(v)) return false;
    }
    return jets_.height(near_[f].plane, near_[g].plane, near_[h].plane, near_[k].plane).sign() == 0 &&
           !provably_outside(k, at);
  }
  bool provably_outside(std::uint32_t facet, const Position& at) const {
    return spatial::provably_outside(jets_, w_.facets[facet], at,
                                     [&](int k) -> const typename Jets::Vector& { return near_[facet].inward[k]; });
  }

  const RotationWindow& w_;
  const std::function<void()>& again_;
  const JetFrame& boxes_;
  Jets jets_;
  std::vector<RotationCells> cells_;
  std::vector<NearFacet> near_;
  std::vector<std::uint32_t> live_;
  BoxTree tree_;                                        // of live facets
  std::vector<std::vector<std::uint32_t>> neighbours_;  // per facet, those that may cross it
  std::size_t since_ = 0;
};

}  // namespace

template <class Frame>
void find_crossings(const RotationWindow& window, const Frame& frame, const JetFrame& boxes,
                    std::vector<RotationCells> cells, const std::function<void()>& again,
                    const std::function<bool(const Meeting&)>& take) {
  CrossingSearch<Frame>(window, frame, boxes, std::move(cells), again).run(take);
}
template void find_crossings(const RotationWindow&, const JetFrame&, const JetFrame&, std::vector<RotationCells>,
                             const std::function<void()>&, const std::function<bool(const Meeting&)>&);
template void find_crossings(const RotationWindow&, const FineFrame&, const JetFrame&, std::vector<RotationCells>,
                             const std::function<void()>&, const std::function<bool(const Meeting&)>&);

}  // namespace dymsum::spatial

#include "planar/boolean/boolean_boundary.h"

#include <algorithm>
#include <map>

#include "planar/arrangement/segment_graph.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/winding_boundary.h"

namespace dymsum::planar {

InputWindings::InputWindings(const Soup& soup, const SegmentGraph& graph, const std::vector<std::uint32_t>& input_of,
                             std::size_t inputs, const Poll& poll)
    : inputs_(inputs) {
  const auto& edges = graph.edges();
  windings_.assign(2 * edges.size() * inputs, 0);
  const RayRows rows(soup);
  std::vector<std::uint8_t> known(edges.size(), 0), done(graph.nodes().size(), 0);
  std::vector<std::uint32_t> open;  // nodes with a known edge
  // Left of an edge the rings of its sub-edges go around once more than right of it, where these run as it does.
  const auto jump = [&](std::uint32_t edge, std::span<std::int32_t> windings, int sign) {
    const SegmentGraph::Edge& e = edges[edge];
    for (std::uint32_t k = e.first; k < e.last; ++k) {
      const SegmentGraph::SubEdge& s = graph.sub_edges()[k];
      windings[input_of[s.segment]] += SegmentGraph::forward(e, s) ? sign : -sign;
    }
  };
  const auto enter = [&](std::uint32_t edge) {
    known[edge] = 1;
    for (const std::uint32_t v : {edges[edge].low, edges[edge].high})
      if (!done[v]) {
        done[v] = 1;
        open.push_back(v);
      }
  };
  // The face clockwise of a ray is known.
  const auto set = [&](const SegmentGraph::Ray& ray, std::span<const std::int32_t> clockwise) {
    if (known[ray.edge]) return;
    const std::size_t k = ray.forward ? 1 : 0;
    std::copy(clockwise.begin(), clockwise.end(), side(ray.edge, k).begin());
    std::copy(clockwise.begin(), clockwise.end(), side(ray.edge, 1 - k).begin());
    jump(ray.edge, side(ray.edge, 1 - k), ray.forward ? 1 : -1);
    enter(ray.edge);
  };
  std::vector<std::int32_t> seed(inputs);
  std::size_t seeds = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (known[e]) continue;
    poll.at_test(seeds++, edges.size());
    std::fill(seed.begin(), seed.end(), 0);
    rows.for_each_passed(graph.sample(e), [&](std::uint32_t s, int by) { seed[input_of[s]] += by; });
    // Right of the segment from which the ray starts.
    set({e, SegmentGraph::forward(edges[e], graph.sub_edges()[edges[e].first])}, seed);
    while (!open.empty()) {
      const auto rays = graph.rays(open.back());
      open.pop_back();
      std::size_t first = 0;
      while (!known[rays[first].edge]) ++first;
      for (std::size_t k = 0; k + 1 < rays.size(); ++k)
        set(rays[(first + k + 1) % rays.size()], beside(rays[(first + k) % rays.size()]));
    }
  }
}

namespace {

bool inside(Fill fill, std::int32_t winding) {
  if (fill == Fill::positive) return winding > 0;
  return fill == Fill::nonzero ? winding != 0 : (winding & 1) != 0;
}

class CellMembership {
 public:
  CellMembership(const SegmentGraph& graph, const InputWindings& windings, const SegmentInputs& segments,
                 const BooleanTerms& terms)
      : graph_(graph), windings_(windings), segments_(segments), terms_(terms), in_(terms.inputs.size()) {
    if (!segments.thin) return;
    // A point is where the segment begins that leads to it.
    for (const SegmentGraph::SubEdge& s : graph.sub_edges())
      if (s.from_event == kNone && segments.kind[s.segment] == SegmentInputs::Kind::from_point)
        points_.emplace(s.from, segments.input[s.segment]);
  }

  bool face(std::span<const std::int32_t> windings) {
    begin();
    add(windings);
    return end().closed;
  }
  Membership edge(std::uint32_t edge) {
    begin();
    add(windings_.left(edge));
    add(windings_.right(edge));
    add_lines(edge);
    return end();
  }
  Membership node(std::uint32_t node) {
    begin();
    for (const SegmentGraph::Ray& ray : graph_.rays(node)) {
      add(windings_.beside(ray));
      add_lines(ray.edge);
    }
    const auto [first, last] = points_.equal_range(node);
    for (auto at = first; at != last; ++at) in_[at->second].closed = true;
    return end();
  }

 private:
  // A cell lies in the closure of an input where some face around it does, in its interior where all do.
  void begin() { std::fill(in_.begin(), in_.end(), Membership{false, true}); }
  void add(std::span<const std::int32_t> windings) {
    for (std::size_t i = 0; i < in_.size(); ++i) {
      const bool lies = inside(terms_.inputs[i]->fill, windings[i]);
      in_[i] = {in_[i].closed || lies, in_[i].open && lies};
    }
  }
  // Lines and points have no interior.
  void add_lines(std::uint32_t edge) {
    if (!segments_.thin) return;
    const SegmentGraph::Edge& e = graph_.edges()[edge];
    for (std::uint32_t k = e.first; k < e.last; ++k) {
      const std::uint32_t s = graph_.sub_edges()[k].segment;
      if (segments_.kind[s] == SegmentInputs::Kind::line) in_[segments_.input[s]].closed = true;
    }
  }
  Membership end() { return terms_.evaluate(in_, stack_); }

  const SegmentGraph& graph_;
  const InputWindings& windings_;
  const SegmentInputs& segments_;
  const BooleanTerms& terms_;
  std::vector<Membership> in_, stack_;
  std::multimap<std::uint32_t, std::uint32_t> points_;  // node -> input
};

class Finder {
 public:
  Finder(const Soup& soup, const SegmentGraph& graph, const InputWindings& windings, const SegmentInputs& segments,
         const BooleanTerms& terms)
      : soup_(soup),
        graph_(graph),
        segments_(segments),
        cells_(graph, windings, segments, terms),
        sides_(graph.edges().size()) {
    for (std::uint32_t e = 0; e < sides_.size(); ++e)
      sides_[e] = {cells_.face(windings.left(e)), cells_.face(windings.right(e))};
  }

  BooleanBoundary run() {
    const GraphRings rings(soup_, graph_, sides_, names());
    error_ = soup_.point_error;
    for (const BoundaryEdges& ring : rings.rings())
      out_.boundary.add(rings.ring(ring, error_), rings.counter_clockwise(ring));
    find_tight();
    out_.boundary.at_error = input_error(soup_.lattice, error_);
    return std::move(out_);
  }

 private:
  // A boundary edge is named by a segment that runs as it does, else, where what lies there is taken away, by one that
  // runs back.
  std::vector<std::uint32_t> names() const {
    std::vector<std::uint32_t> segments(sides_.size(), kNone);
    const auto any = [&](std::uint32_t s) { return segments_.kind[s] == SegmentInputs::Kind::ring; };
    for (std::uint32_t e = 0; e < sides_.size(); ++e) {
      if (sides_[e].left == sides_[e].right) continue;
      segments[e] = segment_along(graph_, e, sides_[e].left, any);
      if (segments[e] == kNone) segments[e] = segment_along(graph_, e, !sides_[e].left, any);
    }
    return segments;
  }

  // Whether a cell is tight whose faces are all inside or all outside.
  static bool is_tight(Membership m) { return m.closed && !m.open; }

  void find_tight() {
    for (std::uint32_t e = 0; e < sides_.size(); ++e) {
      const GraphSides s = sides_[e];
      if (s.left != s.right || !is_tight(cells_.edge(e))) continue;
      const SegmentGraph::Edge& edge = graph_.edges()[e];
      const std::uint32_t segment = segment_on(edge);
      out_.boundary.cracks.push_back({vertex(edge.low, segment), vertex(edge.high, segment)});
      if (!s.left) out_.pieces.segments.push_back(out_.boundary.cracks.back());
    }
    for (std::uint32_t v = 0; v < graph_.nodes().size(); ++v) {
      bool some = false, all = true;
      for (const SegmentGraph::Ray& ray : graph_.rays(v)) {
        some |= sides_[ray.edge].left || sides_[ray.edge].right;
        all &= sides_[ray.edge].left && sides_[ray.edge].right;
      }
      if ((some && !all) || !is_tight(cells_.node(v))) continue;
      const SegmentGraph::Node& node = graph_.nodes()[v];
      out_.boundary.punctures.push_back(vertex(v, node.end.pair ? node.segment : node.end.other));
      if (!some) out_.pieces.points.push_back(out_.boundary.punctures.back());
    }
  }

  // One that belongs to an input, and does not only lead to a point.
  std::uint32_t segment_on(const SegmentGraph::Edge& edge) const {
    for (std::uint32_t k = edge.first; k < edge.last; ++k)
      if (const std::uint32_t s = graph_.sub_edges()[k].segment; segments_.is_of_input(s)) return s;
    return graph_.sub_edges()[edge.first].segment;
  }

  SumVertex vertex(std::uint32_t node, std::uint32_t segment) {
    error_ = std::max(error_, position_error(soup_, graph_.nodes()[node].position));
    return vertex_on(soup_, graph_, node, segment);
  }

  const Soup& soup_;
  const SegmentGraph& graph_;
  const SegmentInputs& segments_;
  CellMembership cells_;
  std::vector<GraphSides> sides_;
  BooleanBoundary out_;
  double error_ = 0;
};

}  // namespace

BooleanBoundary boolean_boundary(const Soup& soup, const SegmentGraph& graph, const InputWindings& windings,
                                 const SegmentInputs& segments, const BooleanTerms& terms) {
  return Finder(soup, graph, windings, segments, terms).run();
}

}  // namespace dymsum::planar

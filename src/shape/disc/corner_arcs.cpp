// The arcs of corner discs from contact to contact.
#include <map>

#include "shape/disc/level_rings.h"

namespace dymsum::shape {

namespace {

class CornerArcs {
 public:
  explicit CornerArcs(const DiscPositions& positions) : positions_(positions) {
    const std::size_t edges = positions.complex().edges.size();
    made_.arc_after.assign(edges, kNoIndex);
    made_.arc_across.assign(edges, {kNoIndex, kNoIndex});
  }

  /// Those between the run that ends on edge `in` and the one that begins on `out`.
  void append(std::uint32_t in, std::uint32_t out) {
    const std::uint32_t disc = index_of(positions_.disc_on(in), in), first = size();
    if (!made_.discs[disc].at_node) append_on_edge(disc, in);
    else if (complex().edges[in].low == made_.discs[disc].index) append_at_node(disc, in, out);
    else append_across(disc, spoke_of(made_.discs[disc].index, in));
    for (std::uint32_t arc = first; arc < size(); ++arc) {
      made_.arcs[arc].out = out;
      if (arc + 1 < size()) made_.arcs[arc].next = arc + 1;
    }
    if (first < size()) made_.arc_after[in] = first;
  }

  ArcSet take() { return std::move(made_); }

 private:
  const Complex& complex() const { return positions_.complex(); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(made_.arcs.size()); }

  std::uint32_t index_of(const CornerDisc& disc, std::uint32_t in) {
    const auto [found, is_new] =
        index_.try_emplace({disc.at_node, disc.index}, static_cast<std::uint32_t>(made_.discs.size()));
    if (is_new) {
      made_.discs.push_back(disc);
      made_.disc_edge.push_back(in);
    }
    return found->second;
  }

  std::optional<Point> vertex(std::uint32_t site) const {
    const Site& s = complex().sites[site];
    if (s.kind == Site::Kind::vertex) return s.a;
    return std::nullopt;
  }

  void append_on_edge(std::uint32_t disc, std::uint32_t edge) {
    const Edge& e = complex().edges[edge];
    made_.arc_across[edge][1] = size();
    made_.arcs.push_back({disc, edge, e.right, e.left, vertex(e.right), vertex(e.left)});
  }

  std::uint32_t spoke_of(std::uint32_t node, std::uint32_t edge) const {
    std::uint32_t spoke = complex().first_spoke[node];
    while (complex().spokes[spoke].edge != edge) ++spoke;
    return spoke;
  }
  std::uint32_t clockwise(std::uint32_t node, std::uint32_t spoke) const {
    return spoke == complex().first_spoke[node] ? complex().first_spoke[node + 1] - 1 : spoke - 1;
  }
  std::uint32_t counter_clockwise(std::uint32_t node, std::uint32_t spoke) const {
    return spoke + 1 == complex().first_spoke[node + 1] ? complex().first_spoke[node] : spoke + 1;
  }
  /// The sites on both sides of a spoke, clockwise about its node.
  std::uint32_t before(std::uint32_t spoke) const {
    const Spoke& s = complex().spokes[spoke];
    return s.up ? complex().edges[s.edge].left : complex().edges[s.edge].right;
  }
  std::uint32_t after(std::uint32_t spoke) const {
    const Spoke& s = complex().spokes[spoke];
    return s.up ? complex().edges[s.edge].right : complex().edges[s.edge].left;
  }

  /// Where an edge meets its end, the disc touches both: they are the sites of neighbouring spokes.
  void append_across(std::uint32_t disc, std::uint32_t spoke) {
    const std::uint32_t node = made_.discs[disc].index;
    const Spoke& s = complex().spokes[spoke];
    std::optional<Point> start = vertex(before(spoke)), stop = vertex(after(spoke));
    if (!start) start = vertex(after(counter_clockwise(node, spoke)));
    if (!stop) stop = vertex(before(clockwise(node, spoke)));
    made_.arc_across[s.edge][s.up ? 0 : 1] = size();
    made_.arcs.push_back({disc, s.edge, before(spoke), after(spoke), start, stop});
  }

  /// Appends the arc between two edges that rise from the node; none where they follow each other and touch one
  /// position.
  void append_at_node(std::uint32_t disc, std::uint32_t in, std::uint32_t out) {
    const std::uint32_t node = made_.discs[disc].index;
    for (std::uint32_t spoke = clockwise(node, spoke_of(node, in)); complex().spokes[spoke].edge != out;
         spoke = clockwise(node, spoke))
      append_across(disc, spoke);
  }

  const DiscPositions& positions_;
  ArcSet made_;
  std::map<std::pair<bool, std::uint32_t>, std::uint32_t> index_;
};

}  // namespace

ArcSet corner_arcs(const DiscPositions& positions, const BoundaryOrder& order, const LevelRings& rings) {
  CornerArcs arcs(positions);
  for (const Run& run : rings.runs) {
    if (run.whole()) continue;
    const std::uint32_t in = order.items[run.to].edge;
    arcs.append(in, edge_after(positions.complex(), positions.level(), in, Connected::region));
  }
  return arcs.take();
}

}  // namespace dymsum::shape

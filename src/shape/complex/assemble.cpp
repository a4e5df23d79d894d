#include "shape/complex/assemble.h"

#include <algorithm>
#include <stdexcept>

namespace dymsum::shape {
namespace {

class Assembly {
 public:
  Assembly(Order& order, const Cells& cells) : order_(order), walks_(order.walks()), pieces_(cells.pieces) {}

  Graph operator()() {
    find_nodes();
    edges_of_.assign(pieces_.size(), {kNoIndex, kNoIndex});
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (owns(i)) add_edges(i);
    }
    add_spokes();
    return std::move(graph_);
  }

 private:
  /// Whether a piece, not its mate, is the one whose site describes the discs.
  bool owns(std::uint32_t i) const {
    const CellPiece& p = pieces_[i];
    if (p.other == kNoIndex) return false;
    const bool edge = walks_.is_edge(p.site), other_edge = walks_.is_edge(p.other);
    return edge != other_edge ? edge : p.site < p.other;
  }

  /// The disc where piece i ends and the next one begins is the same for all such pairs of pieces round a node: from
  /// a piece over to its mate, which ends where the piece begins.
  void find_nodes() {
    node_after_.assign(pieces_.size(), kNoIndex);
    mark_infinity();
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (node_after_[i] != kNoIndex) continue;
      const auto node = static_cast<std::uint32_t>(graph_.nodes.size());
      std::vector<std::uint32_t> round;
      for (std::uint32_t k = i; node_after_[k] == kNoIndex; k = pieces_[pieces_[k].next].mate) {
        node_after_[k] = node;
        round.push_back(k);
      }
      add_node(round);
      rounds_.push_back(std::move(round));
    }
  }
  static constexpr std::uint32_t kInfinite = kNoIndex - 1;
  /// Half-planes: next to nothing, and from there round to nothing again, where vertices of the hull lie on one line.
  void mark_infinity() {
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].other != kNoIndex) continue;
      node_after_[i] = kInfinite;
      for (std::uint32_t k = i; pieces_[pieces_[k].next].other != kNoIndex;) {
        k = pieces_[pieces_[k].next].mate;
        node_after_[k] = kInfinite;
      }
    }
  }
  std::uint32_t node_after(std::uint32_t i) const { return node_after_[i] == kInfinite ? kNoIndex : node_after_[i]; }

  void add_node(const std::vector<std::uint32_t>& round) {
    Node node;
    DiscSource disc;
    std::vector<std::uint32_t> contacts;
    if (round.size() == 1) {
      const std::uint32_t after = pieces_[pieces_[round[0]].next].site;
      node.kind = Node::Kind::corner;
      node.vertex = walks_.corner[after];
      disc = {.kind = DiscSource::Kind::corner, .section = {}, .mark = {}, .point = walks_.ends[after].a};
      contacts = {pieces_[round[0]].site, after};
    } else {
      node.kind = round.size() == 2 ? Node::Kind::pass : Node::Kind::joint;
      disc = source(round);
      for (const std::uint32_t i : round) contacts.push_back(pieces_[pieces_[i].next].site);
    }
    graph_.nodes.push_back(node);
    graph_.discs.push_back(disc);
    graph_.contacts.push_back(std::move(contacts));
  }

  /// The simplest of the descriptions round a node: along an edge, of few edges.
  DiscSource source(const std::vector<std::uint32_t>& round) const {
    std::uint32_t best = round[0];
    int least = 100;
    for (const std::uint32_t i : round) {
      const CellPiece &p = pieces_[i], &q = pieces_[p.next];
      int cost =
          (walks_.is_edge(p.site) ? 0 : 2) + (walks_.is_edge(p.other) ? 1 : 0) + (walks_.is_edge(q.other) ? 1 : 0);
      if (p.to.kind != Mark::Kind::crossing) cost -= 2;
      if (cost < least) {
        least = cost;
        best = i;
      }
    }
    const CellPiece& p = pieces_[best];
    return {.section = p.to_section, .mark = p.to, .other = p.other};
  }

  // Edges.

  /// -1, 0, 1 as the radius falls, stays, grows along the piece at its position `at`: for vertices.
  int side_of_neck(const CellPiece& p, const Section& s, const Mark& at) {
    return order_.sign([&](const auto& formulas) {
      using T = decltype(formulas.value(s, at));
      const auto d = formulas.turned(s, formulas.between(walks_.ends[p.site].a, walks_.ends[p.other].a));
      const T x = formulas.value(s, at);
      return T(d.x) * T(2) * x - T(d.y) * (T(1) - x * x);
    });
  }

  void add_edges(std::uint32_t i) {
    const CellPiece& p = pieces_[i];
    const std::uint32_t from = node_after(p.prev);
    const std::uint32_t to = node_after(i);
    if (walks_.is_edge(p.site) && walks_.is_edge(p.other)) {
      const Site &s = walks_.sites[p.site], &o = walks_.sites[p.other];
      const int slope = exact::cross_sign(s.a, s.b, o.a, o.b);
      const std::uint32_t e = slope < 0 ? add_edge(i, to, from, false) : add_edge(i, from, to, true);
      graph_.edges[e].flat = slope == 0;
      record(i, e, e);
      return;
    }
    int before = 0, after = 0;  // the sides of the neck at which the piece begins and ends
    if (walks_.is_edge(p.site)) {
      const Mark foot = order_.mark(p.section, {.kind = Mark::Kind::toward, .i = p.other});
      before = order_.compare(p.section, p.from, foot);
      after = order_.compare(p.section, p.to, foot);
    } else {
      before = side_of_neck(p, p.section, p.from);
      after = side_of_neck(p, p.to_section, p.to);
    }
    if (before < 0 && after > 0) {
      const std::uint32_t neck = add_neck(p);
      const std::uint32_t down = add_edge(i, neck, from, false), up = add_edge(i, neck, to, true);
      record(i, down, up);
    } else {
      const std::uint32_t e = after <= 0 ? add_edge(i, to, from, false) : add_edge(i, from, to, true);
      record(i, e, e);
    }
  }

  std::uint32_t add_edge(std::uint32_t i, std::uint32_t low, std::uint32_t high, bool forwards) {
    const CellPiece& p = pieces_[i];
    graph_.edges.push_back({low, high, forwards ? p.site : p.other, forwards ? p.other : p.site, false});
    return static_cast<std::uint32_t>(graph_.edges.size() - 1);
  }

  std::uint32_t add_neck(const CellPiece& p) {
    const bool edge = walks_.is_edge(p.site);
    DiscSource disc{.kind = edge ? DiscSource::Kind::disc : DiscSource::Kind::neck,
                    .section = p.section,
                    .mark = {},
                    .other = p.other};
    if (edge) disc.mark = order_.mark(p.section, {.kind = Mark::Kind::toward, .i = p.other});
    graph_.nodes.push_back({.kind = Node::Kind::neck});
    graph_.discs.push_back(disc);
    graph_.contacts.push_back({p.site, p.other});
    rounds_.emplace_back();
    return static_cast<std::uint32_t>(graph_.nodes.size() - 1);
  }

  /// The edges of a piece at its beginning and at its end, and of its mate the other way round.
  void record(std::uint32_t i, std::uint32_t at_from, std::uint32_t at_to) {
    edges_of_[i] = {at_from, at_to};
    edges_of_[pieces_[i].mate] = {at_to, at_from};
    if (at_from != at_to) necks_.push_back({graph_.edges[at_from].low, at_from, at_to});
  }

  // Spokes: the rounds are clockwise.

  void add_spokes() {
    graph_.spokes.resize(graph_.nodes.size());
    for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
      std::vector<Spoke>& spokes = graph_.spokes[n];
      for (const std::uint32_t i : rounds_[n]) {
        const std::uint32_t e = edges_of_[pieces_[i].next][0];
        spokes.push_back({e, graph_.edges[e].low == n});
      }
      std::reverse(spokes.begin(), spokes.end());
      if (spokes.size() == 2 && spokes[0].up && spokes[1].up && !graph_.edges[spokes[0].edge].flat &&
          !graph_.edges[spokes[1].edge].flat)
        graph_.nodes[n].kind = Node::Kind::neck;
    }
    for (const auto& [node, down, up] : necks_) graph_.spokes[node] = {{down, true}, {up, true}};
  }

  Order& order_;
  const Walks& walks_;
  const std::vector<CellPiece>& pieces_;
  Graph graph_;
  std::vector<std::uint32_t> node_after_;           // per piece
  std::vector<std::vector<std::uint32_t>> rounds_;  // per node: pieces that end there
  std::vector<std::array<std::uint32_t, 2>> edges_of_;
  std::vector<std::array<std::uint32_t, 3>> necks_;
};

}  // namespace

Graph assemble(Order& order, const Cells& cells) { return Assembly(order, cells)(); }

}  // namespace dymsum::shape

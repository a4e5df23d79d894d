#include "shape/complex/make_complex.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "base/poll.h"
#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "exact/orient.h"
#include "shape/complex/site_rows.h"

namespace dymsum::shape {
namespace {

// Polylines and points that touch something else: the walks of the boundary know none of these.

/// A segment or, with equal ends, a point. Segments `k` and `k + 1` of one chain share an end.
struct ChainSegment {
  Point a, b;
  std::uint32_t chain = 0, k = 0;
  bool thin = false;
};

struct Chains {
  std::vector<ChainSegment> segments;
  std::vector<std::uint32_t> closed_at;  ///< per chain: its last segment, where that ends at the first one's start
};

constexpr std::uint32_t kOpen = 0xffffffff;

void add_chain(Chains& out, const std::vector<Point>& chain, bool ring) {
  const auto n = static_cast<std::uint32_t>(chain.size()), name = static_cast<std::uint32_t>(out.closed_at.size());
  const std::uint32_t count = ring ? n : n - 1;
  for (std::uint32_t i = 0; i < count; ++i)
    out.segments.push_back({chain[i], chain[i + 1 == n ? 0 : i + 1], name, i, !ring});
  if (n == 1) out.segments.push_back({chain[0], chain[0], name, 0, true});
  const bool closed = ring || (n > 2 && chain.front() == chain.back());
  out.closed_at.push_back(closed ? count - 1 : kOpen);
}

bool spans(const ChainSegment& s, Point p) {
  return std::min(s.a.x, s.b.x) <= p.x && p.x <= std::max(s.a.x, s.b.x) && std::min(s.a.y, s.b.y) <= p.y &&
         p.y <= std::max(s.a.y, s.b.y);
}

/// p lies on s, an end counts.
bool lies_on(const ChainSegment& s, Point p) {
  return spans(s, p) && (s.a == s.b || exact::orient_sign(s.a, s.b, p) == 0);
}

bool cross(const ChainSegment& s, const ChainSegment& t) {
  if (s.a == s.b || t.a == t.b) return false;
  return exact::orient_sign(s.a, s.b, t.a) * exact::orient_sign(s.a, s.b, t.b) < 0 &&
         exact::orient_sign(t.a, t.b, s.a) * exact::orient_sign(t.a, t.b, s.b) < 0;
}

/// Neighbours of a chain meet at the end of the first and otherwise only where they run back along each other.
bool follows(const Chains& chains, const ChainSegment& s, const ChainSegment& t) {
  if (s.chain != t.chain) return false;
  return s.k + 1 == t.k || (chains.closed_at[s.chain] == s.k && t.k == 0);
}

bool folds(const ChainSegment& s, const ChainSegment& t) {
  return exact::orient_sign(s.a, s.b, t.b) == 0 && exact::dot_sign(s.b, s.a, s.b, t.b) > 0;
}

bool meet(const Chains& chains, const ChainSegment& s, const ChainSegment& t) {
  if (follows(chains, s, t)) return folds(s, t);
  if (follows(chains, t, s)) return folds(t, s);
  return lies_on(s, t.a) || lies_on(s, t.b) || lies_on(t, s.a) || lies_on(t, s.b) || cross(s, t);
}

Error refusal(Point at) {
  Error error{ErrorCode::unsupported_operand,
              "a polyline or point touches another piece of the region, or itself: discs want them apart",
              {}};
  error.evidence.x = at.x;
  error.evidence.y = at.y;
  return error;
}

/// unsupported_operand, with the position, where a polyline or a point meets a part, another polyline or point, or
/// itself but for neighbouring segments and the ends of a closed polyline; lying inside a part counts. Exact. O(n log
/// n) for n segments of which few lie above each other, and O(n) for every polyline and point that parts surround.
std::optional<Error> thin_contact(const Region& region) {
  if (region.polylines().empty() && region.points().empty()) return std::nullopt;
  Chains chains;
  for (const Part& part : region.parts()) {
    add_chain(chains, part.outer, true);
    for (const Ring& hole : part.holes) add_chain(chains, hole, true);
  }
  for (const Polyline& line : region.polylines()) add_chain(chains, line, false);
  for (const Point& p : region.points()) add_chain(chains, {p}, false);

  // By smallest x; those that reach the one at hand are looked at.
  std::vector<ChainSegment>& all = chains.segments;
  const auto low = [](const ChainSegment& s) { return std::min(s.a.x, s.b.x); };
  std::sort(all.begin(), all.end(), [&](const ChainSegment& s, const ChainSegment& t) {
    return std::tuple(low(s), s.chain, s.k) < std::tuple(low(t), t.chain, t.k);
  });
  std::vector<const ChainSegment*> open;
  for (const ChainSegment& s : all) {
    std::erase_if(open, [&](const ChainSegment* o) { return std::max(o->a.x, o->b.x) < low(s); });
    for (const ChainSegment* o : open) {
      if ((s.thin || o->thin) && meet(chains, *o, s)) return refusal(s.thin ? s.a : o->a);
    }
    open.push_back(&s);
  }

  // What touches nothing lies inside a part or outside with its first point.
  if (region.parts().empty()) return std::nullopt;
  const Result<Region> parts = Region::create({region.parts(), {}, {}}), origin = Region::create({{}, {}, {{0, 0}}});
  std::vector<Point> firsts = region.points();
  for (const Polyline& line : region.polylines()) firsts.push_back(line[0]);
  for (const Point& p : firsts)
    if (contains(*parts, *origin, p)) return refusal(p);
  return std::nullopt;
}

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

namespace {

Candidates all_pairs(const Walks& walks) {
  const auto n = static_cast<std::uint32_t>(walks.sites.size());
  Candidates all(n);
  for (std::uint32_t s = 0; s < n; ++s) {
    for (std::uint32_t j = 0; j < n; ++j) {
      if (j != s) all[s].push_back(j);
    }
  }
  return all;
}

/// Matched cells, or nothing where the certificate fails.
std::optional<Cells> certified_cells(Order& order, Candidates candidates, int threads, SiteRows::Guess kind,
                                     const Poll& poll, Work& work) {
  SiteRows rows(order.walks(), std::move(candidates), threads);
  if (!rows.close(kind, poll)) return std::nullopt;
  const bool closes = rows.closes_at_infinity();
  work.candidates = rows.work.candidates;
  work.closing_rounds = rows.work.closing_rounds;
  work.full_sites = rows.work.full_sites;
  work.signs += rows.work.signs;
  if (!closes) return std::nullopt;
  Cells cells = join_cells(order.walks(), rows.sections(), rows.rows());
  if (!match_cells(order, cells)) return std::nullopt;
  return cells;
}

Error beyond_range(const std::string& what, Point at) {
  Error error{ErrorCode::out_of_range, what, {}};
  error.evidence.x = at.x;
  error.evidence.y = at.y;
  return error;
}

std::optional<Error> too_large(const Walks& walks) {
  constexpr double kLargest = 0x1p1000;
  for (const BoundaryPoint& p : walks.points) {
    if (std::abs(p.input.x) > kLargest || std::abs(p.input.y) > kLargest)
      return beyond_range("discs want coordinates of at most 2^1000", p.input);
  }
  return std::nullopt;
}

/// Discs that almost are half-planes can be larger than any double.
std::optional<Error> too_large(const Complex& c) {
  for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
    const Node& node = c.nodes[n];
    if (!std::isfinite(node.radius) || !std::isfinite(node.centre.x) || !std::isfinite(node.centre.y))
      return beyond_range("a disc that touches three places is larger than doubles reach",
                          c.sites[c.exact->contacts[n][0]].a);
  }
  return std::nullopt;
}

/// One complex from guesses, the best one last.
Complex complex_of(Walks walks, int threads, std::optional<Candidates> guess, SiteRows::Guess kind, const Poll& poll) {
  auto exact = std::make_shared<ExactComplex>();
  exact->walks = std::move(walks);
  Work work;
  if (exact->walks.sites.empty()) {
    work.certified = guess.has_value();
    return ranked({}, std::move(exact), work);
  }
  Order order(exact->walks);
  const auto cells_from = [&](Candidates candidates, SiteRows::Guess how) {
    return certified_cells(order, std::move(candidates), threads, how, poll, work);
  };
  std::optional<Cells> cells;
  if (kind == SiteRows::Guess::rough) {
    if (guess) cells = cells_from(*std::move(guess), SiteRows::Guess::rough);
    if (!cells) guess = candidates_of(exact->walks);
  }
  if (!cells && guess) cells = cells_from(*std::move(guess), SiteRows::Guess::good);
  work.certified = cells.has_value();
  if (!cells) cells = cells_from(all_pairs(exact->walks), SiteRows::Guess::good);
  if (!cells) throw std::logic_error("the cells of a complex do not match");
  poll(0.8);
  Graph graph = assemble(order, *cells);
  poll(0.85);
  work.signs += order.counts;
  return ranked(std::move(graph), std::move(exact), work);
}

}  // namespace

Complex complex_from(Walks walks, std::optional<Candidates> guess, int threads, const Poll& poll) {
  return complex_of(std::move(walks), threads, std::move(guess), SiteRows::Guess::good, poll);
}

Complex complex_from_rough(Walks walks, int threads, const Poll& poll) {
  std::optional<Candidates> guess = walks.sites.empty() ? Candidates{} : rough_candidates_of(walks);
  return complex_of(std::move(walks), threads, std::move(guess), SiteRows::Guess::rough, poll);
}

namespace {

Result<Complex> made(const Region& region, Side side, Engine engine, int threads, const Poll& poll) {
  if (side == Side::outside) {
    if (std::optional<Error> error = thin_contact(region)) return *std::move(error);
  }
  Result<Walks> walks = make_walks(region, side);
  if (!walks) return walks.error();
  if (std::optional<Error> error = too_large(*walks)) return *std::move(error);
  Complex complex = engine == Engine::fast ? complex_from_rough(std::move(walks).value(), threads, poll)
                                           : complex_from(std::move(walks).value(), std::nullopt, threads, poll);
  if (std::optional<Error> error = too_large(complex)) return *std::move(error);
  return complex;
}

}  // namespace

Result<Complex> make_complex(const Region& region, Side side, Engine engine, int threads, const Progress& progress) {
  Poll poll(progress);
  try {
    poll.stage("complex");
    return made(region, side, engine, threads, poll);
  } catch (const Cancelled&) {
    return cancelled();
  }
}

}  // namespace dymsum::shape

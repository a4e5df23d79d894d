#include "placement/free_boundary.h"

#include <algorithm>

namespace dymsum::placement {
namespace {

using Kind = BoundaryEdge::Kind;

/// A position on an edge at which something begins or ends.
struct Stop {
  Site at;
  std::vector<std::uint32_t> covers;  // whose cuts it is, by their indices at this edge
  bool covered = false;
  bool gap_covered = false, gap_left_out = false, right_covered = false;  // of what follows up to the next stop
};

/// The cover of one edge by one set.
struct Part {
  const PlacedSet* by;
  const EdgeCover* cover;
};

class EdgeReader {
 public:
  EdgeReader(EdgeOf edge, std::span<const Part> parts) : edge_(edge), parts_(parts) {}

  void run(FreeBoundary& out) {
    for (const Part& part : parts_)
      if (part.cover->cuts.empty()) return;  // wholly covered
    find_stops();
    for (std::uint32_t k = 0; k < parts_.size(); ++k) mark(k);
    collect(out);
  }

 private:
  void find_stops() {
    struct Mark {
      const Site* at;
      std::uint32_t cover;
    };
    const Site from = vertex_site(*edge_.set, edge_->from), to = vertex_site(*edge_.set, edge_->to);
    std::vector<Mark> marks{{&from, kNone}};
    for (std::uint32_t k = 0; k < parts_.size(); ++k)
      for (const Site& s : parts_[k].cover->cuts) marks.push_back({&s, k});
    if (edge_->kind != Kind::point) marks.push_back({&to, kNone});
    std::stable_sort(marks.begin(), marks.end(),
                     [&](const Mark& a, const Mark& b) { return compare_along(edge_, *a.at, *b.at) < 0; });
    for (const Mark& m : marks) {
      if (stops_.empty() || compare_along(edge_, stops_.back().at, *m.at) != 0) stops_.push_back({*m.at, {}});
      if (m.cover != kNone) stops_.back().covers.push_back(m.cover);
      else stops_.back().at = *m.at;  // an end is named as such
    }
  }

  // Goes through the gaps of a cover with the stops.
  void mark(std::uint32_t k) {
    const Part& part = parts_[k];
    std::size_t gap = 0;
    for (Stop& s : stops_) {
      const bool cut = std::find(s.covers.begin(), s.covers.end(), k) != s.covers.end();
      if (cut) ++gap;
      else s.covered |= part.cover->gaps[gap].covered;
      const Gap& next = part.cover->gaps[gap];
      s.gap_covered |= next.covered;
      s.right_covered |= next.right_covered;
      s.gap_left_out |= next.along && part.by->id() < edge_.set->id();
    }
  }

  FreeNode node(const Stop& s) const {
    FreeNode n{s.at, {edge_.set->id()}};
    for (const std::uint32_t k : s.covers) n.touches.push_back(parts_[k].by->id());
    std::sort(n.touches.begin(), n.touches.end());
    return n;
  }

  void collect(FreeBoundary& out) const {
    bool before = false;  // whether the gap before is free
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      const Stop& s = stops_[i];
      const bool after = i + 1 < stops_.size() && !s.gap_covered;
      if (!s.covered && !before && !after) out.nodes.push_back(node(s));
      if (after && !s.gap_left_out)
        out.pieces.push_back({edge_, node(s), node(stops_[i + 1]), edge_->kind == Kind::ring && !s.right_covered});
      before = after;
    }
  }

  EdgeOf edge_;
  std::span<const Part> parts_;
  std::vector<Stop> stops_;
};

}  // namespace

FreeBoundary free_boundary(const PlacedSet& set, std::span<const Cover* const> covers) {
  const auto n = static_cast<std::uint32_t>(set.set().edges().size());
  std::vector<std::uint32_t> first(n + 1, 0);
  for (const Cover* c : covers)
    for (const EdgeCover& e : c->edges) ++first[e.edge + 1];
  for (std::uint32_t e = 0; e < n; ++e) first[e + 1] += first[e];
  std::vector<Part> parts(first[n]);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (const Cover* c : covers)
    for (const EdgeCover& e : c->edges) parts[next[e.edge]++] = {c->by, &e};
  FreeBoundary out;
  for (std::uint32_t e = 0; e < n; ++e)
    EdgeReader({&set, e}, std::span(parts).subspan(first[e], first[e + 1] - first[e])).run(out);
  return out;
}

}  // namespace dymsum::placement

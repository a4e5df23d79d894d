#include "cspace/obstacle/local_arrangement.h"

namespace dymsum::planar {

bool LocalArrangement::any() const {
  for (int k = 0; k < size; ++k)
    if (members[k].in != kNobody || members[k].out != kNobody) return true;
  return !vanish.empty();
}

// The kill rule, lemma 4: where b passes from right to left of a, what comes before on a is inside; where it passes
// from left to right, what follows.
bool LocalArrangement::ends_visible(Piece p) const {
  const Member& m = members[p.member];
  if (p.index == m.count) return !m.closes;
  const Vertex& v = m.vertices[p.index];
  return v.chain ? v.other >= 0 : cross[p.member][v.other] < 0;
}

bool LocalArrangement::starts_visible(Piece p) const {
  const Member& m = members[p.member];
  if (p.index == 0) return !m.opens;
  const Vertex& v = m.vertices[p.index - 1];
  return v.chain ? v.other >= 0 : cross[p.member][v.other] > 0;
}

bool LocalArrangement::visible(Piece p) const { return starts_visible(p) && ends_visible(p); }

LocalArrangement::Piece LocalArrangement::successor(Piece p) const {
  const Vertex& v = members[p.member].vertices[p.index];
  const Member& to = members[v.other];
  for (int k = 0; k < to.count; ++k)
    if (to.vertices[k].other == p.member && to.vertices[k].chain == v.chain) return {v.other, k + 1};
  return {};
}

LocalArrangement::Routes LocalArrangement::routes() const {
  Seen seen{};
  Routes found;
  found.paths = paths(seen);
  if (found.paths) found.cycles = cycles(seen);
  return found;
}

std::optional<std::vector<LocalArrangement::Path>> LocalArrangement::paths(Seen& seen) const {
  std::vector<Path> found;
  std::size_t outs = 0;
  for (int s = 0; s < size; ++s) {
    outs += members[s].out != kNobody;
    if (members[s].in == kNobody) continue;
    Path path;
    path.in = members[s].in;
    Piece at{s, 0};
    for (;;) {
      if (seen[at.member][at.index] || !visible(at)) return std::nullopt;
      seen[at.member][at.index] = true;
      path.members.push_back(at.member);
      if (at.index == members[at.member].count) break;
      at = successor(at);
      if (at.member < 0) return std::nullopt;
    }
    path.out = members[at.member].out;
    if (path.out == kNobody) return std::nullopt;
    found.push_back(std::move(path));
  }
  if (outs != found.size()) return std::nullopt;
  return found;
}

// The cycles of visible pieces that no path takes.
std::vector<std::vector<int>> LocalArrangement::cycles(Seen& seen) const {
  std::vector<std::vector<int>> found;
  for (int s = 0; s < size; ++s)
    for (int piece = 1; piece < members[s].count; ++piece) {
      std::vector<int> cycle;
      Piece at{s, piece};
      while (at.member >= 0 && at.index > 0 && at.index < members[at.member].count && !seen[at.member][at.index] &&
             visible(at)) {
        seen[at.member][at.index] = true;
        cycle.push_back(at.member);
        at = successor(at);
      }
      if (at.member == s && at.index == piece && cycle.size() > 1) found.push_back(std::move(cycle));
    }
  return found;
}

}  // namespace dymsum::planar

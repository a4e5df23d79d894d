#include "io/region/dxf_chains.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "io/number_text.h"

namespace dymsum::io {
namespace {

/// End 2 i of piece i is where it begins, 2 i + 1 where it stops.
class PieceJoiner {
 public:
  PieceJoiner(const Source& source, std::vector<DxfPiece> pieces)
      : source_(source), pieces_(std::move(pieces)), mate_(2 * pieces_.size(), kNone), used_(pieces_.size(), false) {}

  DxfChains run() {
    join(false);
    join(true);
    DxfChains chains;
    // Open chains begin at an end without a mate; what is left is closed.
    for (std::size_t end = 0; end < mate_.size(); ++end)
      if (mate_[end] == kNone && !used_[end / 2]) chains.open.push_back(follow(end));
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (used_[i]) continue;
      // Its last vertex and its first are one joint.
      const std::size_t last = mate_[2 * i];
      const bool of_curve = pieces_[i].reach > 0 && pieces_[last / 2].reach == 0;
      ChordChain ring = follow(2 * i);
      if (of_curve) ring.set_front(ring.back());
      ring.pop_back();
      chains.rings.push_back(std::move(ring));
    }
    return chains;
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  static constexpr std::uint64_t kMostTests = 100'000'000;

  Point position(std::size_t end) const {
    const ChordChain& chain = pieces_[end / 2].chain;
    return end % 2 == 0 ? chain.front() : chain.back();
  }
  double reach(std::size_t end) const { return pieces_[end / 2].reach; }

  void join(bool within_reach) {
    std::vector<std::size_t> ends;
    double widest = 0;
    for (std::size_t end = 0; end < mate_.size(); ++end) {
      if (mate_[end] != kNone) continue;
      ends.push_back(end);
      if (within_reach) widest = std::max(widest, reach(end));
    }
    std::sort(ends.begin(), ends.end(), [this](std::size_t a, std::size_t b) {
      const Point p = position(a), q = position(b);
      return std::tie(p.x, p.y, a) < std::tie(q.x, q.y, b);
    });
    std::uint64_t tests = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size() && position(ends[j]).x - position(ends[i]).x <= widest; ++j) {
        if (++tests > kMostTests)
          source_.fail(ErrorCode::malformed, "too many ends of lines and arcs lie within reach of one another",
                       pieces_[ends[i] / 2].offset);
        if (meet(ends[i], ends[j], within_reach)) mate(ends[i], ends[j]);
        else if (!within_reach) break;  // equal ones follow each other
      }
    }
  }

  bool meet(std::size_t a, std::size_t b, bool within_reach) const {
    const Point p = position(a), q = position(b);
    const double most = within_reach ? std::max(reach(a), reach(b)) : 0;
    return std::abs(p.x - q.x) <= most && std::abs(p.y - q.y) <= most;
  }

  void mate(std::size_t a, std::size_t b) {
    if (mate_[a] != kNone || mate_[b] != kNone) {
      const Point p = position(a);
      std::string at = "more than two lines or arcs end at ";
      append_number(at, p.x);
      at += ' ';
      append_number(at, p.y);
      source_.fail(ErrorCode::malformed, at, pieces_[b / 2].offset);
    }
    mate_[a] = b;
    mate_[b] = a;
  }

  /// The chain that begins with this end.
  ChordChain follow(std::size_t end) {
    ChordChain chain;
    double before = 0;
    while (end != kNone && !used_[end / 2]) {
      used_[end / 2] = true;
      ChordChain next = pieces_[end / 2].chain;
      if (end % 2 != 0) next.reverse();
      if (!chain.empty() && before > 0) chain.set_back(next.front());
      chain.append(next);
      before = reach(end);
      end = mate_[end ^ 1];
    }
    return chain;
  }

  const Source& source_;
  std::vector<DxfPiece> pieces_;
  std::vector<std::size_t> mate_;
  std::vector<bool> used_;
};

}  // namespace

DxfChains join_pieces(const Source& source, std::vector<DxfPiece> pieces) {
  return PieceJoiner(source, std::move(pieces)).run();
}

}  // namespace dymsum::io

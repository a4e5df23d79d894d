#include "io/region/dxf_chains.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "io/source.h"

namespace dymsum::io {
namespace {

constexpr int kMostDegree = 25;

/// The knots that count are those from the degree on: between them there has to be something.
void require_sound(const Source& source, const DxfEntity& entity, const DxfSpline& spline) {
  const auto fail = [&](const std::string& what) {
    source.fail(ErrorCode::malformed, "the spline " + what, entity.offset);
  };
  const std::size_t points = spline.control.points.size();
  if (points <= spline.degree) fail("has too few control points for its degree");
  if (spline.knots.size() != points + spline.degree + 1)
    fail("has " + std::to_string(spline.knots.size()) + " knots, not " + std::to_string(points + spline.degree + 1));
  if (!std::is_sorted(spline.knots.begin(), spline.knots.end())) fail("has knots that do not ascend");
  if (!(spline.knots[spline.degree] < spline.knots[points])) fail("has no length between its knots");
  const std::vector<double>& weights = spline.control.weights;
  if (!weights.empty() && weights.size() != points) fail("has weights for some of its control points only");
  if (!std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0; }))
    fail("has a weight that is not positive");
}

}  // namespace

DxfSpline dxf_spline(const Source& source, const DxfEntity& entity) {
  DxfSpline spline;
  bool passes = false, y_missing = false;
  for (const DxfGroup& group : entity) {
    if (group.code == 71) {
      const int degree = dxf_flags(source, group);
      if (degree < 1 || degree > kMostDegree)
        source.fail(ErrorCode::malformed, "the degree of a spline is from 1 to " + std::to_string(kMostDegree),
                    group.offset);
      spline.degree = static_cast<std::size_t>(degree);
    }
    if (group.code == 40) spline.knots.push_back(dxf_number(source, group));
    if (group.code == 41) spline.control.weights.push_back(dxf_number(source, group));
    if (group.code == 10) spline.control.points.push_back({dxf_number(source, group), 0});
    if (group.code == 20 && y_missing) spline.control.points.back().y = dxf_number(source, group);
    if (group.code == 10 || group.code == 20) y_missing = group.code == 10;
    passes = passes || group.code == 11;
  }
  if (spline.control.points.empty() && passes)
    source.fail(ErrorCode::malformed, "the spline has points that it passes through, and no control points",
                entity.offset);
  if (spline.degree == 0) source.fail(ErrorCode::malformed, "the spline has no degree", entity.offset);
  require_sound(source, entity, spline);
  return spline;
}

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

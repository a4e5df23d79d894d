#include "planar/boolean/joined_inputs.h"

#include <algorithm>
#include <utility>

namespace dymsum::planar {
namespace {

using Kind = SegmentInputs::Kind;
using exact::HomogeneousPoint;

/// A vertex that is to be one of the region.
struct JoinedVertex {
  Point at;
  const HomogeneousPoint* exact = nullptr;  ///< null where the double is
  std::uint32_t index = 0, input = 0;
  Kind kind = Kind::ring;
};

HomogeneousPoint exact_position(const JoinedVertex& v) {
  return v.exact != nullptr ? *v.exact : exact::homogeneous(v.at.x, v.at.y);
}

bool same_position_as(const JoinedVertex& a, const JoinedVertex& b) {
  if (a.exact == nullptr && b.exact == nullptr) return a.at == b.at;
  const HomogeneousPoint u = exact_position(a), v = exact_position(b);
  return u.x * v.w == v.x * u.w && u.y * v.w == v.y * u.w;
}

class InputJoiner {
 public:
  explicit InputJoiner(const BooleanTerms& terms) {
    for (const auto& input : terms.inputs) exact_ |= !input->fractions.empty();
    for (const auto& input : terms.inputs) {
      fraction_ = input->fractions.empty() ? nullptr : input->fractions.data();
      for (const Ring& ring : input->rings) add_ring(ring);
      for (const Polyline& line : input->lines) add_line(line);
      for (const Point& point : input->points) points_.push_back(next(point, Kind::from_point));
      ++input_;
    }
    // Along a chain that runs to the right segments hardly cross.
    std::sort(points_.begin(), points_.end(), [](const JoinedVertex& a, const JoinedVertex& b) {
      return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
    });
    for (std::size_t k = 0; k < points_.size(); ++k) add_point(k);
  }

  JoinedInputs joined() && {
    // The region's vertices are those of all parts, then those of all polylines.
    for (const std::vector<JoinedVertex>* vertices : {&rings_, &lines_})
      for (const JoinedVertex& v : *vertices) {
        out_.region.vertex_indices.push_back(v.index);
        out_.input.push_back(v.input);
        out_.kind.push_back(v.kind);
        if (exact_) fractions_.push_back(exact_position(v));
      }
    out_.region.edge_indices = out_.region.vertex_indices;
    if (exact_) out_.region.fractions = std::make_shared<const std::vector<HomogeneousPoint>>(std::move(fractions_));
    return std::move(out_);
  }

 private:
  JoinedVertex next(Point at, Kind kind) {
    return {at, fraction_ != nullptr ? fraction_++ : nullptr, index_++, input_, kind};
  }

  // What does not count: a vertex that repeats the one before it, a ring of two vertices. Fractions are of results,
  // which have neither.
  void add_ring(const Ring& ring) {
    const bool any = fraction_ != nullptr;
    std::vector<JoinedVertex> kept;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const JoinedVertex v = next(ring[k], Kind::ring);
      if (any || ring[k] != ring[k + 1 == ring.size() ? 0 : k + 1]) kept.push_back(v);
    }
    if (kept.size() < 3) return;
    Ring& own = out_.region.own.parts.emplace_back().outer;
    for (const JoinedVertex& v : kept) own.push_back(v.at);
    rings_.insert(rings_.end(), kept.begin(), kept.end());
  }

  void add_line(const Polyline& line) {
    Polyline& own = out_.region.own.polylines.emplace_back();
    for (const Point& v : line) {
      own.push_back(v);
      lines_.push_back(next(v, Kind::line));
    }
  }

  // To some vertex elsewhere: windings cancel, and what lies between belongs to nothing.
  void add_point(std::size_t k) {
    const JoinedVertex& point = points_[k];
    JoinedVertex other = elsewhere(k);
    other.index = index_++;
    other.input = point.input;
    other.kind = Kind::to_point;
    out_.region.own.polylines.push_back({point.at, other.at});
    lines_.push_back(point);
    lines_.push_back(other);
  }
  JoinedVertex elsewhere(std::size_t k) const {
    const JoinedVertex& point = points_[k];
    for (std::size_t next = k + 1; next < points_.size(); ++next)
      if (!same_position_as(points_[next], point)) return points_[next];
    for (const std::vector<JoinedVertex>* vertices : {&rings_, &lines_, &points_})
      for (const JoinedVertex& v : *vertices)
        if (!same_position_as(v, point)) return v;
    // Nothing is anywhere else.
    JoinedVertex twice = point;
    twice.exact = nullptr;
    twice.at = point.at == Point{0, 0} ? Point{1, 0} : Point{2 * point.at.x, 2 * point.at.y};
    return twice;
  }

  JoinedInputs out_;
  std::vector<JoinedVertex> rings_, lines_, points_;
  std::vector<HomogeneousPoint> fractions_;
  const HomogeneousPoint* fraction_ = nullptr;
  bool exact_ = false;
  std::uint32_t index_ = 0, input_ = 0;
};

}  // namespace

JoinedInputs joined_inputs(const BooleanTerms& terms) { return InputJoiner(terms).joined(); }

SegmentInputs segments_of(const JoinedInputs& joined, const Operand& operand) {
  SegmentInputs segments;
  for (std::uint32_t e = 0; e < operand.size(); ++e) {
    const std::uint32_t start = operand.source[e];
    segments.input.push_back(joined.input[start]);
    segments.kind.push_back(joined.kind[start]);
    segments.thin |= segments.kind.back() != Kind::ring;
  }
  return segments;
}

}  // namespace dymsum::planar

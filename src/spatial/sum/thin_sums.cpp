#include "spatial/sum/thin_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "spatial/sum/exact_locator.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

using exact::BigInteger;
using exact::BigRational;

bool is_before(const ExactPosition& a, const ExactPosition& b) { return lexicographic_order(a, b) < 0; }

/// Whether x lies on the line through two positions.
bool on_line(const ExactPosition& a, const ExactPosition& b, const ExactPosition& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if ((b[i] - a[i]) * (x[j] - a[j]) != (b[j] - a[j]) * (x[i] - a[i])) return false;
  }
  return true;
}

/// All sums of a segment or a point of one operand and one of the other that span no plane.
class SumsOfLines {
 public:
  SumsOfLines(const SumSpace& space, const SolidOperand& p, const SolidOperand& q) : space_(space), p_(p), q_(q) {}

  std::vector<ThinSum> run() {
    for (const std::uint32_t e : p_.segments) {
      for (const std::uint32_t g : q_.segments) add_parallel(p_.wedges[e], q_.wedges[g]);
      for (const std::uint32_t v : q_.points)
        add({p_.wedges[e].from, v}, {p_.wedges[e].to, v}, {edge(p_.wedges[e]), vertex(v)});
    }
    for (const std::uint32_t v : p_.points) {
      for (const std::uint32_t g : q_.segments)
        add({v, q_.wedges[g].from}, {v, q_.wedges[g].to}, {vertex(v), edge(q_.wedges[g])});
      for (const std::uint32_t w : q_.points) add({v, w}, {v, w}, {vertex(v), vertex(w)});
    }
    return std::move(sums_);
  }

 private:
  static SolidFeature vertex(std::uint32_t v) { return {SolidFeature::Kind::vertex, v, 0}; }
  static SolidFeature edge(const Wedge& w) {
    return {SolidFeature::Kind::edge, std::min(w.from, w.to), std::max(w.from, w.to)};
  }
  ExactPosition at(SumPoint s) const {
    const PointSource source{PointSource::Kind::sum, s.p, s.q, 0};
    return {space_.world_coordinate(source, 0), space_.world_coordinate(source, 1), space_.world_coordinate(source, 2)};
  }
  void add(SumPoint from, SumPoint to, const SolidContact& contact) {
    ThinSum sum{at(from), at(to), contact};
    if (is_before(sum.to, sum.from)) std::swap(sum.from, sum.to);
    sums_.push_back(std::move(sum));
  }
  void add_parallel(const Wedge& e, const Wedge& g) {
    const DirectionSource along_e{DirectionSource::Of::p, e.from, e.to}, along_g{DirectionSource::Of::q, g.from, g.to};
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      if (space_.det(along_e, along_g, {DirectionSource::Of::axis, axis, 0}) != 0) return;
    const bool opposite = space_.exact_leading(along_e) != space_.exact_leading(along_g);
    add({e.from, opposite ? g.to : g.from}, {e.to, opposite ? g.from : g.to}, {edge(e), edge(g)});
  }

  const SumSpace& space_;
  const SolidOperand &p_, &q_;
  std::vector<ThinSum> sums_;
};

/// The parts of them that nothing else of the sum holds.
class Remainder {
 public:
  Remainder(const SpatialSum& sum, const std::vector<ThinSum>& sums) : locator_(sum) {
    for (const ThinSum& s : sums) s.from == s.to ? add_point(s) : add_segment(s);
  }

  std::vector<std::array<ExactPosition, 2>> segments;
  std::vector<ExactPosition> points;

 private:
  bool is_left(const ExactPosition& x) const {
    return locator_.of(x) == ExactLocator::Where::outside && !locator_.on_tight_face(x);
  }
  void add_point(const ThinSum& s) {
    if (is_left(s.from)) points.push_back(s.from);
  }
  void add_segment(const ThinSum& s) {
    std::vector<BigRational> cuts = locator_.cuts(s.from, s.to);
    cuts.insert(cuts.begin(), 0);
    cuts.emplace_back(1);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if (!is_left(position_between(s.from, s.to, (cuts[k] + cuts[k + 1]) / 2))) continue;
      segments.push_back({position_between(s.from, s.to, cuts[k]), position_between(s.from, s.to, cuts[k + 1])});
    }
  }

  ExactLocator locator_;
};

/// Tight segments and points in canonical order: pieces of one line that touch or overlap are one, and points lie on
/// none of them.
class TightLines {
 public:
  TightLines(std::vector<ThinSum> sources, std::vector<std::array<ExactPosition, 2>> segments,
             std::vector<ExactPosition> points)
      : sources_(std::move(sources)), segments_(std::move(segments)), points_(std::move(points)) {
    join_segments();
    std::erase_if(points_, [&](const ExactPosition& x) {
      return std::any_of(segments_.begin(), segments_.end(),
                         [&](const auto& s) { return lies_on_segment(s[0], s[1], x); });
    });
    std::sort(points_.begin(), points_.end(), is_before);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  const std::vector<std::array<ExactPosition, 2>>& segments() const { return segments_; }
  const std::vector<ExactPosition>& points() const { return points_; }

  /// What touches at a position, and on from there to another one.
  std::vector<SolidContact> contacts(const ExactPosition& at, const ExactPosition& to) const {
    std::vector<SolidContact> found;
    for (const ThinSum& s : sources_) {
      const bool goes_on = at == to || (on_line(at, to, s.from) && on_line(at, to, s.to) && is_before(at, s.to));
      if (goes_on && lies_on_segment(s.from, s.to, at)) found.push_back(s.contact);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  static bool by_ends(const std::array<ExactPosition, 2>& a, const std::array<ExactPosition, 2>& b) {
    const int order = lexicographic_order(a[0], b[0]);
    return order != 0 ? order < 0 : is_before(a[1], b[1]);
  }
  void join_segments() {
    std::sort(segments_.begin(), segments_.end(), by_ends);
    std::vector<std::array<ExactPosition, 2>> joined;
    for (std::array<ExactPosition, 2>& s : segments_) {
      const auto before = std::find_if(joined.begin(), joined.end(), [&](const auto& other) {
        return !is_before(other[1], s[0]) && on_line(other[0], other[1], s[0]) && on_line(other[0], other[1], s[1]);
      });
      if (before == joined.end()) joined.push_back(std::move(s));
      else if (is_before((*before)[1], s[1])) (*before)[1] = std::move(s[1]);
    }
    segments_ = std::move(joined);
    std::sort(segments_.begin(), segments_.end(), by_ends);
  }

  std::vector<ThinSum> sources_;
  std::vector<std::array<ExactPosition, 2>> segments_;
  std::vector<ExactPosition> points_;
};

std::array<BigInteger, 4> over_one_denominator(const ExactPosition& at) {
  BigInteger w = 1;
  for (const BigRational& c : at) w = lcm(w, denominator(c));
  const auto whole = [&](const BigRational& c) { return BigInteger(numerator(c) * (w / denominator(c))); };
  return {whole(at[0]), whole(at[1]), whole(at[2]), w};
}

/// A sum with further vertices, all in the order of positions: the names of its own become others in the same order, so
/// its lists stay as they are sorted.
class WithVertices {
 public:
  WithVertices(SpatialSum& sum, const std::vector<ExactPosition>& added) : sum_(sum) {
    for (std::size_t v = 0; v < sum.vertices.size(); ++v)  // an empty sum has no positions
      all_.push_back({SpatialSumInternals::positions(sum).at(v), v});
    for (const ExactPosition& at : added) all_.push_back({at, kAdded});
    std::stable_sort(all_.begin(), all_.end(), [](const Entry& a, const Entry& b) { return is_before(a.at, b.at); });
    all_.erase(std::unique(all_.begin(), all_.end(), [](const Entry& a, const Entry& b) { return a.at == b.at; }),
               all_.end());
    rename();
    move_vertices();
  }

  std::uint32_t name(const ExactPosition& at) const {
    const auto found = std::lower_bound(all_.begin(), all_.end(), at,
                                        [](const Entry& e, const ExactPosition& x) { return is_before(e.at, x); });
    return static_cast<std::uint32_t>(found - all_.begin());
  }

 private:
  static constexpr std::size_t kAdded = static_cast<std::size_t>(-1);
  struct Entry {
    ExactPosition at;
    std::size_t old;
  };

  void rename() {
    std::vector<std::uint32_t> name(sum_.vertices.size());
    for (std::uint32_t k = 0; k < all_.size(); ++k)
      if (all_[k].old != kAdded) name[all_[k].old] = k;
    const auto rename_loops = [&](std::vector<std::vector<std::uint32_t>>& loops) {
      for (auto& loop : loops)
        for (std::uint32_t& v : loop) v = name[v];
    };
    for (SpatialFace& face : sum_.faces) rename_loops(face.loops);
    for (auto& loops : sum_.tight_faces) rename_loops(loops);
  }

  void move_vertices() {
    const std::vector<Point3> vertices = std::exchange(sum_.vertices, {});
    const auto contacts = std::exchange(sum_.vertex_contacts, {});
    auto positions = std::make_shared<SpatialPositions>();
    for (const Entry& e : all_) {
      const auto c = [&](std::size_t axis) { return exact::round_to_double(e.at[axis]); };
      sum_.vertices.push_back(e.old != kAdded ? vertices[e.old] : Point3{c(0), c(1), c(2)});
      sum_.vertex_contacts.push_back(e.old != kAdded ? contacts[e.old] : std::nullopt);
      const Point3& v = sum_.vertices.back();
      sum_.at_error =
          std::max(sum_.at_error, std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) * 0x1p-53 + 0x1p-1074);
      positions->listed.push_back(over_one_denominator(e.at));
    }
    SpatialSumInternals::set_positions(sum_, std::move(positions));
  }

  SpatialSum& sum_;
  std::vector<Entry> all_;
};

}  // namespace

void add_tight_lines(SpatialSum& sum, std::vector<ThinSum> sources, std::vector<std::array<ExactPosition, 2>> segments,
                     std::vector<ExactPosition> points) {
  if (segments.empty() && points.empty()) return;
  const TightLines lines(std::move(sources), std::move(segments), std::move(points));
  std::vector<ExactPosition> ends = lines.points();
  for (const auto& segment : lines.segments()) ends.insert(ends.end(), segment.begin(), segment.end());
  const WithVertices named(sum, ends);
  for (const auto& [from, to] : lines.segments()) {
    sum.tight_segments.push_back({named.name(from), named.name(to)});
    sum.tight_segment_contacts.push_back(lines.contacts(from, to));
  }
  for (const ExactPosition& at : lines.points()) {
    sum.tight_points.push_back(named.name(at));
    sum.tight_point_contacts.push_back(lines.contacts(at, at));
  }
}

void add_thin_sums(SpatialSum& sum, const SumSpace& space, const SolidOperand& p, const SolidOperand& q) {
  std::vector<ThinSum> sums = SumsOfLines(space, p, q).run();
  if (sums.empty()) return;
  Remainder left(sum, sums);
  add_tight_lines(sum, std::move(sums), std::move(left.segments), std::move(left.points));
}

}  // namespace dymsum::spatial

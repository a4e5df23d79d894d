#include "spatial/mesh/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace dymsum::spatial {

// The method is that of de Berg, Cheong, van Kreveld, Overmars: Computational Geometry, sections 3.2 and 3.3. At a
// position where rings touch, edges are joined anew so that every corner is a whole wedge of the inside; wedges at one
// position are disjoint.

namespace {

using Corner = std::uint32_t;
using PositionId = std::uint32_t;

/// Thrown where rings are not what a sweep is for.
struct NotSimple {};

/// The corners of all rings; the inside is to the left of the way from each to the next one.
struct RingCorners {
  std::vector<PositionId> at;
  std::vector<Corner> next, previous;

  explicit RingCorners(std::span<const std::vector<PositionId>> rings) {
    for (const std::vector<PositionId>& ring : rings) {
      const auto first = static_cast<Corner>(at.size()), n = static_cast<Corner>(ring.size());
      if (n < 2) throw NotSimple{};
      for (Corner k = 0; k < n; ++k) {
        at.push_back(ring[k]);
        next.push_back(first + (k + 1) % n);
        previous.push_back(first + (k + n - 1) % n);
      }
    }
  }
  PositionId to(Corner c) const { return at[next[c]]; }
  PositionId from(Corner c) const { return at[previous[c]]; }
};

/// Directions from a position to others, by their angles from one of them: counter-clockwise, whose own is the last.
class Around {
 public:
  Around(PlaneOrder& order, PositionId centre, PositionId first) : order_(order), centre_(centre), first_(first) {}

  bool operator()(PositionId a, PositionId b) const {
    const int in_a = sector(a), in_b = sector(b);
    return in_a != in_b ? in_a < in_b : in_a % 2 == 0 && order_.turn(centre_, a, b) > 0;
  }

 private:
  int sector(PositionId a) const {
    const int turn = order_.turn(centre_, first_, a);
    if (turn != 0) return turn > 0 ? 0 : 2;
    return order_.before(centre_, a) == order_.before(centre_, first_) ? 3 : 1;
  }

  PlaneOrder& order_;
  PositionId centre_, first_;
};

/// Joins edges at positions with several corners: the one that comes in goes on to the next one clockwise that leaves.
void part_wedges(RingCorners& corners, std::span<const Corner> here, PlaneOrder& order) {
  std::vector<std::pair<Corner, Corner>> joins;  // previous and next corners
  std::vector<Corner> left;                      // ways out that no way in has taken
  for (const Corner c : here) left.push_back(corners.next[c]);
  for (const Corner c : here) {
    const Around around(order, corners.at[c], corners.from(c));
    // The last one counter-clockwise, save the way back.
    const auto later = [&](Corner a, Corner b) { return around(corners.at[a], corners.at[b]); };
    const auto is_back = [&](Corner a) { return corners.at[a] == corners.from(c); };
    std::vector<Corner> ways;
    for (const Corner d : here)
      if (!is_back(corners.next[d])) ways.push_back(corners.next[d]);
    const auto best = std::max_element(ways.begin(), ways.end(), later);
    const auto taken = best == ways.end() ? left.end() : std::find(left.begin(), left.end(), *best);
    if (taken == left.end()) throw NotSimple{};
    joins.push_back({corners.previous[c], *taken});
    left.erase(taken);
  }
  for (std::size_t k = 0; k < here.size(); ++k) {
    corners.previous[here[k]] = joins[k].first;
    corners.next[here[k]] = joins[k].second;
    corners.previous[joins[k].second] = here[k];
  }
}

/// Diagonals that part the inside into monotone pieces.
class Sweep {
 public:
  Sweep(const RingCorners& corners, std::span<const Corner> sorted, PlaneOrder& order)
      : corners_(corners),
        sorted_(sorted),
        order_(order),
        status_(Below{this}),
        in_status_(corners.at.size(), status_.end()),
        helper_(corners.at.size()),
        kind_(corners.at.size()) {}

  std::vector<std::array<Corner, 2>> run() {
    for (Corner c = 0; c < kind_.size(); ++c) kind_[c] = kind_of(c);
    for (std::size_t first = 0, last = 0; first < sorted_.size(); first = last) {
      while (last < sorted_.size() && corners_.at[sorted_[last]] == corners_.at[sorted_[first]]) ++last;
      const std::span<const Corner> here = sorted_.subspan(first, last - first);
      // What ends at a position leaves before what begins there comes.
      for (const Corner c : here)
        if (kind_[c] == Kind::end || kind_[c] == Kind::merge || kind_[c] == Kind::lower) leave(c);
      for (const Corner c : here)
        if (kind_[c] == Kind::merge || kind_[c] == Kind::split || kind_[c] == Kind::upper) look_below(c);
      for (const Corner c : here)
        if (kind_[c] == Kind::start || kind_[c] == Kind::split || kind_[c] == Kind::lower) enter(c);
    }
    return std::move(diagonals_);
  }

 private:
  enum class Kind : std::uint8_t {
    start,  ///< convex, both edges lead on
    split,  ///< reflex, both edges lead on
    end,    ///< convex, both edges lead back
    merge,  ///< reflex, both edges lead back
    lower,  ///< the inside is above
    upper   ///< the inside is below
  };

  Kind kind_of(Corner c) const {
    const PositionId at = corners_.at[c], from = corners_.from(c), to = corners_.to(c);
    const bool came = order_.before(from, at), goes_on = order_.before(at, to);
    if (came && goes_on) return Kind::lower;
    if (!came && !goes_on) return Kind::upper;
    const bool convex = order_.turn(from, at, to) > 0;  // at the end of a slit the inside is all around
    if (came) return convex ? Kind::end : Kind::merge;
    return convex ? Kind::start : Kind::split;
  }

  /// Edges by the corners at which they begin, and positions.
  struct Below {
    using is_transparent = void;
    Sweep* sweep;
    struct Point {
      PositionId at;
    };
    bool operator()(Corner a, Corner b) const { return sweep->edge_below(a, b); }
    bool operator()(Corner a, Point b) const { return sweep->below(a, b.at); }
  };
  bool below(Corner edge, PositionId at) const { return order_.turn(corners_.at[edge], corners_.to(edge), at) > 0; }
  /// The order of edges that the sweep meets at once.
  bool edge_below(Corner a, Corner b) const {
    if (a == b) return false;
    const PositionId from_a = corners_.at[a], from_b = corners_.at[b];
    if (from_a == from_b) return order_.turn(from_a, corners_.to(a), corners_.to(b)) > 0;
    if (order_.before(from_a, from_b)) {
      const int turn = order_.turn(from_a, corners_.to(a), from_b);
      return turn != 0 ? turn > 0 : below(a, corners_.to(b));
    }
    const int turn = order_.turn(from_b, corners_.to(b), from_a);
    return turn != 0 ? turn < 0 : order_.turn(from_b, corners_.to(b), corners_.to(a)) < 0;
  }

  void enter(Corner c) {
    const auto [at, added] = status_.insert(c);
    if (!added) throw NotSimple{};
    in_status_[c] = at;
    helper_[c] = c;
  }
  void leave(Corner c) {
    const Corner edge = corners_.previous[c];
    if (in_status_[edge] == status_.end()) throw NotSimple{};
    join_merge(c, edge);
    status_.erase(std::exchange(in_status_[edge], status_.end()));
  }
  void look_below(Corner c) {
    const auto above = status_.lower_bound(typename Below::Point{corners_.at[c]});
    if (above == status_.begin()) throw NotSimple{};
    const Corner edge = *std::prev(above);
    if (kind_[c] == Kind::split) diagonals_.push_back({c, helper_[edge]});
    else join_merge(c, edge);
    helper_[edge] = c;
  }
  void join_merge(Corner c, Corner edge) {
    if (kind_[helper_[edge]] == Kind::merge) diagonals_.push_back({c, helper_[edge]});
  }

  const RingCorners& corners_;
  std::span<const Corner> sorted_;
  PlaneOrder& order_;
  std::set<Corner, Below> status_;  // edges that the sweep meets with the inside above them, from below
  std::vector<std::set<Corner, Below>::iterator> in_status_;
  std::vector<Corner> helper_;  // of an edge: the last corner above it to which nothing lies between them
  std::vector<Kind> kind_;
  std::vector<std::array<Corner, 2>> diagonals_;
};

/// The pieces into which diagonals part the inside, as loops of corners.
class Pieces {
 public:
  Pieces(const RingCorners& corners, const std::vector<std::array<Corner, 2>>& diagonals, PlaneOrder& order)
      : corners_(corners), first_(corners.at.size() + 1, 1), at_(2 * diagonals.size()) {
    for (const auto& [a, b] : diagonals) ++first_[a], ++first_[b];
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0u);
    ways_.resize(first_.back());
    std::vector<std::uint32_t> free(first_.begin(), first_.end() - 1);
    for (Corner c = 0; c < corners.at.size(); ++c) ways_[free[c]++] = {corners.next[c], kEdge, false};
    for (std::uint32_t k = 0; k < at_.size(); ++k) {
      const std::array<Corner, 2>& ends = diagonals[k / 2];
      ways_[free[ends[k % 2]]++] = {ends[1 - k % 2], k, false};
    }
    for (Corner c = 0; c < corners.at.size(); ++c) {
      const Around around(order, corners.at[c], corners.to(c));
      std::sort(ways_.begin() + first_[c] + 1, ways_.begin() + first_[c + 1],
                [&](const Way& a, const Way& b) { return around(corners.at[a.to], corners.at[b.to]); });
    }
    for (std::uint32_t w = 0; w < ways_.size(); ++w)
      if (ways_[w].half != kEdge) at_[ways_[w].half] = w;
  }

  std::vector<std::vector<Corner>> run() {
    std::vector<std::vector<Corner>> pieces;
    for (Corner c = 0; c < corners_.at.size(); ++c)
      for (std::uint32_t w = first_[c]; w < first_[c + 1]; ++w)
        if (!ways_[w].seen) pieces.push_back(follow(c, w));
    return pieces;
  }

 private:
  static constexpr std::uint32_t kEdge = 0xffffffff;
  struct Way {
    Corner to;
    std::uint32_t half;  // of a diagonal, 2 k and 2 k + 1 for its two ways; kEdge for an edge
    bool seen;
  };

  std::vector<Corner> follow(Corner c, std::uint32_t w) {
    std::vector<Corner> piece;
    while (!ways_[w].seen) {
      ways_[w].seen = true;
      piece.push_back(c);
      c = ways_[w].to;
      // The next way clockwise from the one back; the edge that comes in is behind all diagonals.
      w = (ways_[w].half == kEdge ? first_[c + 1] : at_[ways_[w].half ^ 1]) - 1;
    }
    return piece;
  }

  const RingCorners& corners_;
  std::vector<std::uint32_t> first_;  // of each corner's ways: its edge, then its diagonals counter-clockwise
  std::vector<std::uint32_t> at_;     // the position of a diagonal's half among the ways
  std::vector<Way> ways_;
};

/// A monotone piece, by a stack of corners that are still to be joined.
class PieceSplitter {
 public:
  PieceSplitter(const RingCorners& corners, PlaneOrder& order, std::vector<std::array<PositionId, 3>>& triangles)
      : corners_(corners), order_(order), triangles_(triangles) {}

  void run(const std::vector<Corner>& piece) {
    sort(piece);
    std::vector<Step> stack{steps_[0], steps_[1]};
    for (std::size_t k = 2; k < steps_.size(); ++k) {
      const Step& here = steps_[k];
      const bool lower = stack.back().lower;
      if (k + 1 == steps_.size() || here.lower != lower) {
        for (std::size_t i = 1; i < stack.size(); ++i)
          if (!add(stack[i - 1].at, stack[i].at, here.at, lower)) throw NotSimple{};
        stack = {stack.back(), here};
        continue;
      }
      while (stack.size() > 1 && add(stack[stack.size() - 2].at, stack.back().at, here.at, lower)) stack.pop_back();
      stack.push_back(here);
    }
  }

 private:
  struct Step {
    PositionId at;
    bool lower;  ///< on the way from the first to the last place, the inside to its left
  };

  /// Both ways from the first position to the last one, as one.
  void sort(const std::vector<Corner>& piece) {
    const auto before = [&](Corner a, Corner b) { return order_.before(corners_.at[a], corners_.at[b]); };
    const auto [first, last] = std::minmax_element(piece.begin(), piece.end(), before);
    const std::size_t n = piece.size(), begin = static_cast<std::size_t>(first - piece.begin()),
                      end = static_cast<std::size_t>(last - piece.begin());
    if (n < 3) throw NotSimple{};
    std::size_t low = begin, high = (begin + n - 1) % n;
    steps_.clear();
    while (low != end || high != end) {
      const bool lower = low != end && (high == end || before(piece[low], piece[high]));
      std::size_t& at = lower ? low : high;
      steps_.push_back({corners_.at[piece[at]], lower});
      at = lower ? (at + 1) % n : (at + n - 1) % n;
    }
    steps_.push_back({corners_.at[piece[end]], true});
    for (std::size_t k = 1; k < steps_.size(); ++k)
      if (!order_.before(steps_[k - 1].at, steps_[k].at)) throw NotSimple{};
  }

  /// Whether two steps of one chain and a later one are a triangle inside.
  bool add(PositionId a, PositionId b, PositionId c, bool lower) {
    if (!lower) std::swap(a, b);
    if (order_.turn(a, b, c) <= 0) return false;
    triangles_.push_back({a, b, c});
    return true;
  }

  const RingCorners& corners_;
  PlaneOrder& order_;
  std::vector<std::array<PositionId, 3>>& triangles_;
  std::vector<Step> steps_;
};

std::vector<std::array<PositionId, 3>> triangles_of(std::span<const std::vector<PositionId>> rings, PlaneOrder& order) {
  RingCorners corners(rings);
  std::vector<Corner> sorted(corners.at.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(), [&](Corner a, Corner b) {
    const PositionId at_a = corners.at[a], at_b = corners.at[b];
    return at_a == at_b ? a < b : order.before(at_a, at_b);
  });
  for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
    while (last < sorted.size() && corners.at[sorted[last]] == corners.at[sorted[first]]) ++last;
    if (last - first > 1) part_wedges(corners, std::span<const Corner>(sorted).subspan(first, last - first), order);
  }
  const std::vector<std::array<Corner, 2>> diagonals = Sweep(corners, sorted, order).run();
  std::vector<std::array<PositionId, 3>> triangles;
  PieceSplitter splitter(corners, order, triangles);
  for (const std::vector<Corner>& piece : Pieces(corners, diagonals, order).run()) splitter.run(piece);
  return triangles;
}

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> sweep_triangles(
    std::span<const std::vector<std::uint32_t>> rings, PlaneOrder& order) {
  try {
    return triangles_of(rings, order);
  } catch (const NotSimple&) {
    return std::nullopt;
  }
}

namespace {

using exact::Axis;

/// The positions of a face as it is looked at, along one of the two axes that are seen and, of equal ones, the other.
class FaceOrder final : public PlaneOrder {
 public:
  FaceOrder(const std::vector<Point3>& vertices, View view) : vertices_(vertices), view_(view) {}

  bool before(std::uint32_t a, std::uint32_t b) override {
    const Point3 &p = vertices_[a], &q = vertices_[b];
    if (view_.axis == Axis::x) return std::tie(p.y, p.z) < std::tie(q.y, q.z);
    if (view_.axis == Axis::y) return std::tie(p.z, p.x) < std::tie(q.z, q.x);
    return std::tie(p.x, p.y) < std::tie(q.x, q.y);
  }
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) override {
    return view_.sign * exact::normal_sign(vertices_[a], vertices_[b], vertices_[c], view_.axis);
  }

 private:
  const std::vector<Point3>& vertices_;
  View view_;
};

/// A polygon that loses its ears one by one; corners are positions in the face.
class Ears {
 public:
  Ears(const std::vector<Point3>& vertices, const Face& face, View view)
      : vertices_(vertices), face_(face), view_(view) {
    const std::size_t n = face.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_.push_back((i + 1) % n);
      previous_.push_back((i + n - 1) % n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (turn(i) <= 0) blunt_.push_back(i);
    }
  }

  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    std::size_t at = 0;
    bool simple = true;
    for (std::size_t left = face_.size(); left >= 3; --left) {
      const std::optional<std::size_t> clear = simple ? find_ear(at, left) : std::nullopt;
      simple = clear.has_value();
      const std::size_t ear = clear.value_or(at);
      triangles.push_back({face_[previous_[ear]], face_[ear], face_[next_[ear]]});
      next_[previous_[ear]] = next_[ear];
      previous_[next_[ear]] = previous_[ear];
      std::erase_if(blunt_, [&](std::size_t i) { return i == ear || turn(i) > 0; });
      at = next_[ear];
    }
    return triangles;
  }

 private:
  int side(std::size_t a, std::size_t b, std::size_t c) const {
    return view_.sign * exact::normal_sign(vertices_[face_[a]], vertices_[face_[b]], vertices_[face_[c]], view_.axis);
  }
  bool same(std::size_t a, std::size_t b) const { return vertices_[face_[a]] == vertices_[face_[b]]; }
  int turn(std::size_t i) const { return side(previous_[i], i, next_[i]); }

  /// A convex corner whose closed triangle holds no other corner; only blunt ones can be in its way. A simple polygon
  /// always has one. At a bridge to a hole two corners are at the same position: they are not in each other's way.
  std::optional<std::size_t> find_ear(std::size_t start, std::size_t left) const {
    for (std::size_t i = start; left > 0; --left, i = next_[i]) {
      if (turn(i) > 0 && is_clear(i)) return i;
    }
    return std::nullopt;
  }

  bool is_clear(std::size_t ear) const {
    const std::size_t a = previous_[ear], c = next_[ear];
    return std::none_of(blunt_.begin(), blunt_.end(), [&](std::size_t i) {
      return !same(i, a) && !same(i, ear) && !same(i, c) && side(a, ear, i) >= 0 && side(ear, c, i) >= 0 &&
             side(c, a, i) >= 0;
    });
  }

  const std::vector<Point3>& vertices_;
  const Face& face_;
  View view_;
  std::vector<std::size_t> next_, previous_;
  std::vector<std::size_t> blunt_;  ///< corners of at least 180 degrees that are left
};

}  // namespace

View view_of(const FacePlane& plane) { return {plane.axis, plane.axis_sign}; }

View average_view(const std::vector<Point3>& vertices, const Face& face) {
  const Point3& o = vertices[face[0]];
  double scale = 0;
  for (const std::uint32_t v : face) {
    const Point3& p = vertices[v];
    scale = std::max({scale, std::abs(p.x - o.x), std::abs(p.y - o.y), std::abs(p.z - o.z)});
  }
  Point3 sum;
  for (std::size_t i = 2; i < face.size(); ++i) {
    const auto unit = [&](std::uint32_t v) {
      const Point3& p = vertices[v];
      return Point3{(p.x - o.x) / scale, (p.y - o.y) / scale, (p.z - o.z) / scale};
    };
    const Point3 a = unit(face[i - 1]), b = unit(face[i]);
    sum = {sum.x + (a.y * b.z - a.z * b.y), sum.y + (a.z * b.x - a.x * b.z), sum.z + (a.x * b.y - a.y * b.x)};
  }
  const double x = std::abs(sum.x), y = std::abs(sum.y), z = std::abs(sum.z);
  if (x > y && x > z) return {Axis::x, sum.x < 0 ? -1 : 1};
  if (y > z) return {Axis::y, sum.y < 0 ? -1 : 1};
  return {Axis::z, sum.z < 0 ? -1 : 1};
}

std::vector<Triangle> triangulated(const std::vector<Point3>& vertices, const Face& face, View view) {
  if (face.size() == 3) return {{face[0], face[1], face[2]}};
  // Ears are for any face, and of operands their triangles meet fewer others than the long ones of a sweep.
  constexpr std::size_t kFewCorners = 400;
  if (face.size() > kFewCorners) {
    FaceOrder order(vertices, view);
    if (auto triangles = sweep_triangles(std::span(&face, 1), order)) return *std::move(triangles);
  }
  return Ears(vertices, face, view).cut();
}

Triangles triangulated(const MeshData& data) {
  Triangles all;
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    if (data.faces[f].size() < 3) continue;
    const View view = data.faces[f].size() == 3 ? View{} : view_of(face_plane(data.vertices, data.faces[f]));
    for (const Triangle& t : triangulated(data.vertices, data.faces[f], view)) {
      all.triangles.push_back(t);
      all.face.push_back(f);
    }
  }
  return all;
}

}  // namespace dymsum::spatial

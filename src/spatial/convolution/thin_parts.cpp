#include "spatial/convolution/thin_parts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace dymsum::spatial {

namespace {

/// A side of a plate's front, from corner k to k + 1.
struct PlateSide {
  std::uint32_t low, high, triangle, corner;
  bool forward;  ///< from low to high
  friend bool operator<(const PlateSide& a, const PlateSide& b) {
    return std::tie(a.low, a.high, a.triangle, a.corner) < std::tie(b.low, b.high, b.triangle, b.corner);
  }
};

class ThinParts {
 public:
  ThinParts(SolidOperand& operand, const OperandSigns& signs, const MeshData& data, const std::vector<bool>& thin)
      : operand_(operand), signs_(signs), data_(data), thin_(thin), neighbours_(data.vertices.size()) {}

  void run() {
    add_plates();
    add_edges();
    add_segments();
    add_shells();
    for (std::uint32_t v = 0; v < neighbours_.size(); ++v) {
      if (operand_.thin_shell[v] == Wedge::kNone) continue;
      if (neighbours_[v].empty()) operand_.points.push_back(v);
      add_cone(v);
    }
  }

 private:
  /// Whether two vertices lie in one direction from o: on its line, on the same side. Requires both elsewhere than o.
  bool same_direction(std::uint32_t o, std::uint32_t a, std::uint32_t b) const {
    const auto same_side = [&](exact::Axis axis) { return signs_.order(o, a, axis) == signs_.order(o, b, axis); };
    return signs_.collinear(o, a, b) && same_side(exact::Axis::x) && same_side(exact::Axis::y) &&
           same_side(exact::Axis::z);
  }

  void add_plates() {
    const Triangles all = triangulated(data_);
    for (std::size_t k = 0; k < all.triangles.size(); ++k) {
      if (!thin_[all.face[k]]) continue;
      const Triangle& t = all.triangles[k];
      const auto front = static_cast<std::uint32_t>(operand_.triangles.size());
      operand_.triangles.insert(operand_.triangles.end(), {t, Triangle{t[0], t[2], t[1]}});
      operand_.face.insert(operand_.face.end(), 2, all.face[k]);
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t a = t[c], b = t[(c + 1) % 3];
        sides_.push_back({std::min(a, b), std::max(a, b), front, c, a < b});
        join(a, b);
      }
    }
    operand_.wedge_of.resize(3 * operand_.triangles.size(), Wedge::kNone);
  }
  void join(std::uint32_t a, std::uint32_t b) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }

  std::uint32_t apex(const PlateSide& s) const { return operand_.triangles[s.triangle][(s.corner + 2) % 3]; }
  /// The front or back of a plate that runs through the edge from low to high, or the other way.
  static std::uint32_t face_of(const PlateSide& s, bool forward) { return s.triangle + (s.forward == forward ? 0 : 1); }

  /// Material from one plate counter-clockwise to another one, seen against the vector from low to high; between front
  /// and back of the same one.
  Wedge wedge(const PlateSide& right, const PlateSide& left, Wedge::Bend bend) const {
    return {left.low, left.high, face_of(left, true), face_of(right, false), apex(left), apex(right), bend};
  }

  void add_edges() {
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t first = 0, last = 0; first < sides_.size(); first = last) {
      while (last < sides_.size() && sides_[last].low == sides_[first].low && sides_[last].high == sides_[first].high)
        ++last;
      // Touching is looked at plate by plate, support at all of them.
      for (std::size_t k = first; k < last; ++k) {
        const auto w = static_cast<std::uint32_t>(operand_.wedges.size());
        operand_.wedges.push_back(wedge(sides_[k], sides_[k], Wedge::Bend::flat));
        operand_.wedge_of[3 * sides_[k].triangle + sides_[k].corner] = w;
        operand_.wedge_of[3 * (sides_[k].triangle + 1) + 2 - sides_[k].corner] = w;  // 0 2 1: its sides backward
      }
      add_supporting_wedge({&sides_[first], last - first});
    }
  }

  int turn(const PlateSide& a, const PlateSide& b) const { return signs_.orient(a.low, a.high, apex(a), apex(b)); }
  /// Whether two plates in one plane lie in the same half of it.
  bool same_half(const PlateSide& a, const PlateSide& b) const {
    for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x, exact::Axis::y}) {
      const int s = signs_.normal(a.low, a.high, apex(a), axis);
      if (s != 0) return s == signs_.normal(a.low, a.high, apex(b), axis);
    }
    return true;
  }
  /// Whether the half-plane of b is that of a, or comes before half a turn counter-clockwise from it.
  bool follows(const PlateSide& a, const PlateSide& b) const {
    const int t = turn(a, b);
    return t > 0 || (t == 0 && same_half(a, b));
  }

  void add_supporting_wedge(std::span<const PlateSide> sides) {
    const auto first = std::find_if(sides.begin(), sides.end(), [&](const PlateSide& a) {
      return std::all_of(sides.begin(), sides.end(), [&](const PlateSide& b) { return follows(a, b); });
    });
    const auto last = std::find_if(sides.begin(), sides.end(), [&](const PlateSide& b) {
      return std::all_of(sides.begin(), sides.end(), [&](const PlateSide& a) { return follows(a, b); });
    });
    if (first == sides.end() || last == sides.end()) return;  // they support no plane, or only one in which they lie
    operand_.wedges.push_back(wedge(*first, *last, Wedge::Bend::convex));
  }

  void add_segments() {
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      const Face& face = data_.faces[f];
      if (!thin_[f] || face.size() != 2) continue;
      operand_.segments.push_back(static_cast<std::uint32_t>(operand_.wedges.size()));
      operand_.segment_face.push_back(static_cast<std::uint32_t>(f));
      operand_.wedges.push_back({face[0], face[1], Wedge::kNone, Wedge::kNone, 0, 0, Wedge::Bend::convex});
      join(face[0], face[1]);
    }
  }

  void add_shells() {
    std::vector<std::uint32_t>& shell = operand_.thin_shell;
    shell.assign(data_.vertices.size(), Wedge::kNone);
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (!thin_[f] || shell[data_.faces[f][0]] != Wedge::kNone) continue;
      const auto index = static_cast<std::uint32_t>(operand_.shell_vertex.size());
      operand_.shell_vertex.push_back(data_.faces[f][0]);
      std::vector<std::uint32_t> open{data_.faces[f][0]};
      shell[open[0]] = index;
      while (!open.empty()) {
        const std::uint32_t v = open.back();
        open.pop_back();
        for (const std::uint32_t w : neighbours_[v])
          if (shell[w] == Wedge::kNone) shell[w] = index, open.push_back(w);
      }
    }
    for (std::size_t t = operand_.first_plate; t < operand_.triangles.size(); ++t)
      operand_.shell.push_back(shell[operand_.triangles[t][0]]);
  }

  void add_cone(std::uint32_t v) {
    std::vector<std::uint32_t> rays;
    for (const std::uint32_t n : neighbours_[v]) {
      const auto same = [&](std::uint32_t r) { return same_direction(v, r, n); };
      if (std::none_of(rays.begin(), rays.end(), same)) rays.push_back(n);
    }
    SupportCone cone{v, static_cast<std::uint32_t>(operand_.rays.size()), 0, lie_in_a_plane(v, rays)};
    if (cone.flat) {
      operand_.rays.insert(operand_.rays.end(), rays.begin(), rays.end());
    } else {
      for (const std::uint32_t k : extreme_rays(signs_, v, rays)) operand_.rays.push_back(rays[k]);
    }
    cone.last = static_cast<std::uint32_t>(operand_.rays.size());
    if (cone.flat || cone.last > cone.first) operand_.cones.push_back(cone);
  }

  bool lie_in_a_plane(std::uint32_t v, const std::vector<std::uint32_t>& rays) const {
    for (std::size_t j = 1; j < rays.size(); ++j) {
      if (signs_.collinear(v, rays[0], rays[j])) continue;
      return std::all_of(rays.begin(), rays.end(),
                         [&](std::uint32_t r) { return signs_.orient(v, rays[0], rays[j], r) == 0; });
    }
    return true;
  }

  SolidOperand& operand_;
  const OperandSigns& signs_;
  const MeshData& data_;
  const std::vector<bool>& thin_;
  std::vector<PlateSide> sides_;
  std::vector<std::vector<std::uint32_t>> neighbours_;  // per vertex, along thin parts
};

}  // namespace

void add_thin_parts(SolidOperand& operand, const OperandSigns& signs, const MeshData& data,
                    const std::vector<bool>& thin) {
  ThinParts(operand, signs, data, thin).run();
}

}  // namespace dymsum::spatial

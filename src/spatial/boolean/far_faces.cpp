#include "spatial/boolean/far_faces.h"

#include <algorithm>
#include <numeric>

#include "exact/orient.h"

namespace dymsum::spatial {
namespace {

std::uint32_t next(std::uint32_t half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }

/// Per half-edge the only other one of its edge, where that runs the other way; else kNoId.
std::vector<std::uint32_t> twins(const SolidOperand& surface) {
  struct Side {
    std::uint32_t to, half_edge;
  };
  const auto count = static_cast<std::uint32_t>(3 * surface.triangles.size());
  const auto from = [&](std::uint32_t h) { return surface.triangles[h / 3][h % 3]; };
  // Sides by their smaller vertices, at each of these by the other one.
  std::vector<std::uint32_t> begin(surface.vertices.size() + 1, 0);
  for (std::uint32_t h = 0; h < count; ++h) ++begin[std::min(from(h), from(next(h))) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> position(begin.begin(), begin.end() - 1);
  std::vector<Side> sides(count);
  for (std::uint32_t h = 0; h < count; ++h) {
    const std::uint32_t a = from(h), b = from(next(h));
    sides[position[std::min(a, b)]++] = {std::max(a, b), h};
  }
  std::vector<std::uint32_t> twin(count, kNoId);
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    const auto first = sides.begin() + begin[v], last = sides.begin() + begin[v + 1];
    std::sort(first, last, [](const Side& a, const Side& b) { return a.to < b.to; });
    for (auto side = first, end = first; side != last; side = end) {
      while (end != last && end->to == side->to) ++end;
      if (end - side != 2) continue;
      const std::uint32_t a = side->half_edge, b = (side + 1)->half_edge;
      if (from(a) != from(b)) twin[a] = b, twin[b] = a;
    }
  }
  return twin;
}

class Split {
 public:
  Split(const Surface& surface, FarFaces& faces)
      : surface_(surface.operand), faces_(faces), near_(surface_.triangles.size(), 0) {}

  void run(const NearPairs& pairs) {
    const auto count = static_cast<std::uint32_t>(surface_.triangles.size());
    faces_.twin = twins(surface_);
    faces_.flat.assign(3 * std::size_t{count}, 0);
    for (std::uint32_t f = 0; f < count; ++f) {
      const auto others = pairs.of(f);
      if (!others.empty()) near_[f] = 1;
      for (const std::uint32_t g : others) near_[g] = 1;
    }
    for (std::uint32_t h = 0; h < 3 * count; ++h)
      if (faces_.twin[h] == kNoId) near_[h / 3] = 1;
    find_flat_edges();
    for (std::uint32_t t = 0; t < count; ++t)
      if (near_[t] != 0) spread(t);
    for (std::uint32_t h = 0; h < 3 * count; ++h)
      if (near_[h / 3] == 0 && faces_.flat[h] == 0 && goes_straight_on(h)) spread(h / 3);
    find_sheets();
    for (std::uint32_t t = 0; t < count; ++t)
      if (near_[t] != 0) faces_.near.push_back(t);
  }

 private:
  std::uint32_t from(std::uint32_t h) const { return surface_.triangles[h / 3][h % 3]; }
  const Point3& at(std::uint32_t h) const { return surface_.vertices[from(h)]; }

  /// Between triangles that are near already nobody asks.
  void find_flat_edges() {
    for (std::uint32_t h = 0; h < faces_.twin.size(); ++h) {
      const std::uint32_t twin = faces_.twin[h];
      if (twin == kNoId || twin < h || (near_[h / 3] != 0 && near_[twin / 3] != 0)) continue;
      const std::uint32_t apex = next(next(twin));
      faces_.flat[h] = faces_.flat[twin] = surface_.face[h / 3] == surface_.face[twin / 3] ||
                                           exact::orient3_sign(at(h), at(next(h)), at(next(next(h))), at(apex)) == 0;
    }
  }
  /// All triangles of a face are near.
  void spread(std::uint32_t triangle) {
    near_[triangle] = 1;
    todo_.assign(1, triangle);
    while (!todo_.empty()) {
      const std::uint32_t t = todo_.back();
      todo_.pop_back();
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (faces_.flat[h] == 0 || near_[faces_.twin[h] / 3] != 0) continue;
        near_[faces_.twin[h] / 3] = 1;
        todo_.push_back(faces_.twin[h] / 3);
      }
    }
  }
  /// Whether the outline of a face runs on along the line of a half-edge. Within one triangle it bends.
  bool goes_straight_on(std::uint32_t h) const {
    std::uint32_t g = next(h);
    if (faces_.flat[g] == 0) return false;
    while (faces_.flat[g] != 0) g = next(faces_.twin[g]);
    return exact::collinear(at(h), at(g), at(next(g)));
  }

  void find_sheets() {
    const auto count = static_cast<std::uint32_t>(near_.size());
    std::vector<std::uint32_t>& sheet = faces_.sheet;
    sheet.assign(count, kNoId);
    for (std::uint32_t first = 0; first < count; ++first) {
      if (near_[first] != 0 || sheet[first] != kNoId) continue;
      const auto name = static_cast<std::uint32_t>(faces_.rims.size());
      faces_.rims.emplace_back();
      if (fill(first, name)) continue;
      // Without a rim: one face is near. What that connected is beside it, and one sheet still.
      spread(first);
    }
    for (std::uint32_t t = 0; t < count; ++t)
      if (near_[t] != 0) sheet[t] = kNoId;
    for (std::uint32_t h = 0; h < 3 * count; ++h)
      if (near_[h / 3] == 0 && near_[faces_.twin[h] / 3] != 0)
        faces_.rims[sheet[h / 3]].push_back({from(h), from(next(h))});
  }
  /// Names all far triangles that edges connect to one; returns whether any is beside a near one.
  bool fill(std::uint32_t first, std::uint32_t name) {
    bool rim = false;
    faces_.sheet[first] = name;
    todo_.assign(1, first);
    while (!todo_.empty()) {
      const std::uint32_t t = todo_.back();
      todo_.pop_back();
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const std::uint32_t other = faces_.twin[h] / 3;
        rim = rim || near_[other] != 0;
        if (near_[other] != 0 || faces_.sheet[other] != kNoId) continue;
        faces_.sheet[other] = name;
        todo_.push_back(other);
      }
    }
    return rim;
  }

  const SolidOperand& surface_;
  FarFaces& faces_;
  std::vector<std::uint8_t> near_;  // per triangle
  std::vector<std::uint32_t> todo_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> outlines(const FarFaces& faces, std::uint32_t first,
                                                 std::vector<std::uint8_t>& seen) {
  const auto is_flat = [&](std::uint32_t h) { return faces.flat[h] != 0; };
  seen[first] = 1;
  std::vector<std::vector<std::uint32_t>> loops;
  if (!is_flat(3 * first) && !is_flat(3 * first + 1) && !is_flat(3 * first + 2)) {
    loops.emplace_back(std::initializer_list<std::uint32_t>{3 * first, 3 * first + 1, 3 * first + 2});
    return loops;
  }
  std::vector<std::uint32_t> triangles{first}, sides;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    for (std::uint32_t h = 3 * triangles[k]; h < 3 * triangles[k] + 3; ++h) {
      if (!is_flat(h)) {
        sides.push_back(h);
      } else if (const std::uint32_t other = faces.twin[h] / 3; seen[other] == 0) {
        seen[other] = 1;
        triangles.push_back(other);
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<bool> passed(sides.size(), false);
  const auto index = [&](std::uint32_t h) { return std::lower_bound(sides.begin(), sides.end(), h) - sides.begin(); };
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (passed[k]) continue;
    std::vector<std::uint32_t>& loop = loops.emplace_back();
    for (std::uint32_t h = sides[k]; loop.empty() || h != sides[k];) {
      passed[static_cast<std::size_t>(index(h))] = true;
      loop.push_back(h);
      h = next(h);
      while (is_flat(h)) h = next(faces.twin[h]);
    }
  }
  return loops;
}

FarFaces far_faces(const Surface& surface, const NearPairs& pairs, StageWatch& watch) {
  // Per half-edge: its side, twin, and whether it is flat; per triangle: its sheet and whether it is near.
  watch.hold(surface.operand.triangles.size() * 64);
  FarFaces faces;
  Split(surface, faces).run(pairs);
  return faces;
}

}  // namespace dymsum::spatial

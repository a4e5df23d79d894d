#include "spatial/convolution/flat_vertices.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "exact/orient.h"

namespace dymsum::spatial {

namespace {

constexpr std::uint32_t kNoCorner = 0xffffffff;

/// Triangles that lose vertices one by one. Half-edge 3 t + k runs from corner k of triangle t to the next one.
class FlatVertices {
 public:
  FlatVertices(const std::vector<Point3>& vertices, Triangles surface, std::span<const Wedge> wedges,
               std::span<const std::uint32_t> wedge_of, const std::vector<bool>& keep)
      : at_(vertices), surface_(std::move(surface)), alive_(surface_.triangles.size(), true) {
    find_twins(wedges, wedge_of);
    merge_faces();
    corner_.assign(at_.size(), kNoCorner);
    std::vector<std::uint32_t> corners(at_.size(), 0);
    for (std::uint32_t h = 0; h < twin_.size(); ++h) corner_[from(h)] = h, ++corners[from(h)];
    for (std::uint32_t v = 0; v < at_.size(); ++v)
      if (corners[v] > 0 && (keep.empty() || !keep[v]) && is_flat(v, corners[v])) flat_.push_back(v);
  }

  Triangles run() {
    // What has few neighbours first, so that stars stay small.
    for (std::size_t most = 8; !flat_.empty(); most *= 2)
      std::erase_if(flat_, [&](std::uint32_t v) {
        collect_star(v);
        if (star_.size() > most) return false;
        leave_out_centre();
        return true;
      });
    Triangles result;
    for (std::uint32_t t = 0; t < alive_.size(); ++t) {
      if (!alive_[t]) continue;
      result.triangles.push_back(surface_.triangles[t]);
      result.face.push_back(surface_.face[t]);
    }
    return result;
  }

 private:
  std::uint32_t from(std::uint32_t h) const { return surface_.triangles[h / 3][h % 3]; }
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t before(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t to(std::uint32_t h) const { return from(next(h)); }

  enum class Kind : std::uint8_t { flat, hard, crowded };  // crowded: more than two triangles meet there

  void find_twins(std::span<const Wedge> wedges, std::span<const std::uint32_t> wedge_of) {
    twin_.resize(3 * surface_.triangles.size()), kind_.resize(twin_.size());
    const auto same_edge = [&](std::size_t v, std::size_t w) {
      return w < wedges.size() && wedges[v].from == wedges[w].from && wedges[v].to == wedges[w].to;
    };
    for (std::uint32_t h = 0; h < twin_.size(); ++h) {
      const std::uint32_t w = wedge_of[h];
      const std::uint32_t other = wedges[w].left == h / 3 ? wedges[w].right : wedges[w].left;
      std::uint32_t g = 3 * other;
      while (from(g) != to(h)) ++g;
      twin_[h] = g;
      const bool crowded = same_edge(w, w + 1) || (w > 0 && same_edge(w, w - 1));  // wedges are listed edge by edge
      kind_[h] = crowded ? Kind::crowded : wedges[w].bend == Wedge::Bend::flat ? Kind::flat : Kind::hard;
    }
  }

  void merge_faces() {
    std::vector<std::uint32_t> parent(surface_.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t t) {
      while (parent[t] != t) t = parent[t] = parent[parent[t]];
      return t;
    };
    for (std::uint32_t h = 0; h < twin_.size(); ++h)
      if (kind_[h] == Kind::flat) parent[root(h / 3)] = root(twin_[h] / 3);
    std::vector<std::uint32_t> least(parent.size(), kNoCorner);
    for (std::uint32_t t = 0; t < parent.size(); ++t) least[root(t)] = std::min(least[root(t)], surface_.face[t]);
    for (std::uint32_t t = 0; t < parent.size(); ++t) surface_.face[t] = least[root(t)];
  }

  /// The half-edges out of a vertex, counter-clockwise; only one fan of them.
  void collect_star(std::uint32_t v) {
    star_.clear();
    std::uint32_t h = corner_[v];
    do {
      star_.push_back(h);
      h = twin_[before(h)];
    } while (h != corner_[v]);
  }

  bool is_flat(std::uint32_t v, std::size_t corners) {
    collect_star(v);
    if (star_.size() != corners) return false;
    std::array<std::uint32_t, 2> end{};
    std::size_t ends = 0;
    for (const std::uint32_t h : star_) {
      if (kind_[h] == Kind::crowded) return false;
      if (kind_[h] == Kind::flat) continue;
      if (ends == 2) return false;
      end[ends++] = to(h);
    }
    return ends == 0 || (ends == 2 && exact::collinear(at_[end[0]], at_[v], at_[end[1]]));
  }

  /// The vertex whose star was collected.
  void leave_out_centre() {
    const auto hard = [&](std::uint32_t h) { return kind_[h] == Kind::hard; };
    const auto first = std::find_if(star_.begin(), star_.end(), hard);
    if (first != star_.end()) std::rotate(star_.begin(), first, star_.end());
    const bool on_edge = first != star_.end();
    const auto second = static_cast<std::size_t>(
        on_edge ? std::find_if(star_.begin() + 1, star_.end(), hard) - star_.begin() : star_.end() - star_.begin());
    sides_.clear(), around_.clear();
    for (const std::uint32_t h : star_) {
      alive_[h / 3] = false;
      around_.push_back(to(h));
      const std::uint32_t out = twin_[next(h)];  // of the ring's side beyond
      sides_.push_back({from(out), to(out), out, kind_[out]});
    }
    std::size_t slot = 0;
    fill({0, second}, on_edge, slot);
    if (on_edge) fill({second, star_.size()}, on_edge, slot);
    pair_sides();
  }

  /// Puts the triangles of some of the star's anew: their outer corners are a polygon, seen from outside
  /// counter-clockwise, whose last side on an edge is what was two.
  void fill(std::array<std::size_t, 2> range, bool on_edge, std::size_t& slot) {
    const auto [begin, end] = range;
    Face ring;
    for (std::size_t k = begin; k < end; ++k) ring.push_back(around_[k]);
    if (on_edge) ring.push_back(around_[end % around_.size()]);
    const std::uint32_t t = star_[begin] / 3;
    const Triangle& old = surface_.triangles[t];
    View view;
    for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x, exact::Axis::y}) {
      view = {axis, exact::normal_sign(at_[old[0]], at_[old[1]], at_[old[2]], axis)};
      if (view.sign != 0) break;
    }
    const std::uint32_t face = surface_.face[t];
    for (const Triangle& made : triangulated(at_, ring, view)) {
      if (slot == star_.size()) throw std::logic_error("flat vertices: a star with too many triangles");
      const std::uint32_t id = star_[slot++] / 3;
      surface_.triangles[id] = made, surface_.face[id] = face;
      alive_[id] = true;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const bool closing = on_edge && made[k] == ring.back() && made[(k + 1) % 3] == ring.front();
        sides_.push_back({made[k], made[(k + 1) % 3], 3 * id + k, closing ? Kind::hard : Kind::flat});
        corner_[made[k]] = 3 * id + k;
      }
    }
  }

  /// Every side that was made lies opposite to another one, or to what is around the star, whose kind it takes.
  void pair_sides() {
    const auto key = [](const RingSide& s) { return std::array{std::min(s.from, s.to), std::max(s.from, s.to)}; };
    std::sort(sides_.begin(), sides_.end(), [&](const RingSide& a, const RingSide& b) {
      return key(a) != key(b) ? key(a) < key(b) : a.half_edge < b.half_edge;
    });
    for (std::size_t k = 0; k < sides_.size(); k += 2) {
      const RingSide &a = sides_[k], &b = sides_.at(k + 1);
      if (a.from != b.to || a.to != b.from) throw std::logic_error("flat vertices: sides that do not pair up");
      twin_[a.half_edge] = b.half_edge, twin_[b.half_edge] = a.half_edge;
      kind_[a.half_edge] = kind_[b.half_edge] = std::max(a.kind, b.kind);
    }
  }

  struct RingSide {
    std::uint32_t from, to, half_edge;
    Kind kind;
  };

  const std::vector<Point3>& at_;
  Triangles surface_;
  std::vector<bool> alive_;            // per triangle
  std::vector<std::uint32_t> twin_;    // per half-edge
  std::vector<Kind> kind_;             // per half-edge
  std::vector<std::uint32_t> corner_;  // per vertex: a half-edge out of it
  std::vector<std::uint32_t> flat_;    // vertices to be left out
  // Scratch.
  std::vector<std::uint32_t> star_, around_;  // half-edges out of a vertex, and their ends
  std::vector<RingSide> sides_;
};

}  // namespace

Triangles without_flat_vertices(const std::vector<Point3>& vertices, Triangles surface, std::span<const Wedge> wedges,
                                std::span<const std::uint32_t> wedge_of, const std::vector<bool>& keep) {
  return FlatVertices(vertices, std::move(surface), wedges, wedge_of, keep).run();
}

}  // namespace dymsum::spatial

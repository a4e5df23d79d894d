// The brute force of thesis section 5.2, kept as reference and baseline.
#include <algorithm>
#include <stdexcept>

#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {
namespace {

/// All edges of the vertex fall in the direction of the face.
bool compatible(const Signs& signs, int op, std::uint32_t f, std::uint32_t v) {
  for (const HalfEdge h : signs.poly(1 - op).leaving(v))
    if (signs.sign(op, f, h) > 0) return false;
  return true;
}

/// The arcs cross: the ends of each lie on different sides of the other's circle, and on the same half of the sphere.
/// Returns the half-edge of Q that the arc of p crosses outwards, or nothing as -1.
std::int64_t crossing_half_edge(const Signs& signs, std::uint32_t p, std::uint32_t q) {
  const Polytope &a = signs.poly(0), &b = signs.poly(1);
  const int f_left = signs.sign(0, a.face[2 * p], 2 * q), f_right = signs.sign(0, a.face[2 * p + 1], 2 * q);
  if (f_left == f_right) return -1;
  const int g_left = signs.sign(1, b.face[2 * q], 2 * p), g_right = signs.sign(1, b.face[2 * q + 1], 2 * p);
  if (g_left == g_right || f_right != g_left) return -1;
  return f_right > 0 ? 2 * q : 2 * q + 1;
}

}  // namespace

void Overlay::build_brute(const RelativeMap& map) {
  restart();
  const std::uint64_t exact_before = signs_.signs().exact();
  signs_.set(map);
  arcs_.clear();
  for (int op = 0; op < 2; ++op) {
    std::fill(vertex_until_[op].begin(), vertex_until_[op].end(), clock_);
    for (std::uint32_t f = 0; f < poly(op).face_count(); ++f) {
      ++work_.vertex_checks;
      std::uint32_t found = 0;
      for (std::uint32_t v = 0; v < poly(1 - op).vertex_count(); ++v) {
        if (!compatible(signs_, op, f, v)) continue;
        ++found;
        extreme_[op][f] = v;
      }
      if (found != 1) throw std::logic_error("Overlay::build_brute: a face has to have one extreme vertex");
    }
  }
  find_pairs();
  // Arcs that begin or end in the same direction do not count as crossing: see overlay_parallel.cpp.
  const auto share_an_end = [this](std::uint32_t p, std::uint32_t q) {
    for (const std::uint32_t f : {poly(0).face[2 * p], poly(0).face[2 * p + 1]})
      for (const std::uint32_t g : {poly(1).face[2 * q], poly(1).face[2 * q + 1]})
        if (pairs_.parallel[0][f] == g) return true;
    return false;
  };
  std::vector<HalfEdge> crossed;
  for (std::uint32_t p = 0; p < poly(0).edge_count(); ++p) {
    crossed.clear();
    for (std::uint32_t q = 0; q < poly(1).edge_count(); ++q)
      if (const std::int64_t h = crossing_half_edge(signs_, p, q); h >= 0 && !share_an_end(p, q))
        crossed.push_back(static_cast<HalfEdge>(h));
    // The crossings are in order: each leaves the vertex that the one before it led to.
    std::uint32_t v = end_cell(0, 2 * p), last = kNoCrossing;
    for (auto from = crossed.begin(); from != crossed.end(); ++from) {
      const auto it = std::find_if(from, crossed.end(), [&](HalfEdge h) { return poly(1).origin[h] == v; });
      if (it == crossed.end()) throw std::logic_error("Overlay::build_brute: crossings do not join");
      std::iter_swap(from, it);
      v = poly(1).target(*from);
      last = append_crossing(p, *from, clock_, last);
    }
  }
  finish_crossings();
  work_.exact_signs = signs_.signs().exact() - exact_before;
}

}  // namespace dymsum::spatial

#include "convex/expert.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

namespace dymsum::bench {
namespace {

constexpr std::size_t kPoints = 16, kEdges = 64;  // looked at together

void fill_up(Vectors& v, Point3 with, std::size_t block) {
  v.count = v.x.size();
  const std::size_t size = (v.count + block - 1) / block * block;
  v.x.resize(size, with.x);
  v.y.resize(size, with.y);
  v.z.resize(size, with.z);
}

void add(Vectors& v, Point3 p) {
  v.x.push_back(p.x);
  v.y.push_back(p.y);
  v.z.push_back(p.z);
}

Point3 minus(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point3 cross(Point3 a, Point3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double dot(Point3 a, Point3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Half the sum of cross products round the face: its area along its normal.
Point3 area_vector(const MeshData& mesh, const Face& face) {
  Point3 twice;
  for (std::size_t k = 1; k + 1 < face.size(); ++k) {
    const Point3 a = mesh.vertices[face[0]], b = mesh.vertices[face[k]], c = mesh.vertices[face[k + 1]];
    const Point3 n = cross(minus(b, a), minus(c, a));
    twice = {twice.x + n.x, twice.y + n.y, twice.z + n.z};
  }
  return {twice.x / 2, twice.y / 2, twice.z / 2};
}

/// matrix v, all of them.
void map_all(const std::array<double, 9>& m, const Vectors& v, Vectors& to) {
  for (std::size_t i = 0; i < v.x.size(); ++i) {
    const double x = v.x[i], y = v.y[i], z = v.z[i];
    to.x[i] = m[0] * x + m[1] * y + m[2] * z;
    to.y[i] = m[3] * x + m[4] * y + m[5] * z;
    to.z[i] = m[6] * x + m[7] * y + m[8] * z;
  }
}

/// The products of n with a block of vectors.
template <std::size_t N>
inline void products(Point3 n, const Vectors& v, std::size_t at, double (&to)[N]) {
  const double *x = v.x.data() + at, *y = v.y.data() + at, *z = v.z.data() + at;
#pragma GCC unroll 1  // or GCC takes the loop apart before it finds that it can be vectorised
  for (std::size_t k = 0; k < N; ++k) to[k] = n.x * x[k] + n.y * y[k] + n.z * z[k];
}

/// Which of these are negative.
inline std::uint64_t sign_bits(const double (&values)[kEdges]) {
  std::uint64_t bits = 0;
#ifdef __SSE2__
  for (std::size_t k = 0; k < kEdges; k += 2)
    bits |= static_cast<std::uint64_t>(_mm_movemask_pd(_mm_loadu_pd(values + k))) << k;
#else
  for (std::size_t k = 0; k < kEdges; ++k) bits |= static_cast<std::uint64_t>(std::signbit(values[k])) << k;
#endif
  return bits;
}

/// The vertex furthest in a direction. Of most blocks nothing but their largest product is looked at.
std::uint32_t furthest(Point3 n, const Vectors& v) {
  double best = -INFINITY, values[kPoints];
  std::size_t found = 0;
  for (std::size_t at = 0; at < v.x.size(); at += kPoints) {
    products(n, v, at, values);
    double most[4];
    std::copy(values, values + 4, most);
    for (std::size_t k = 4; k < kPoints; k += 4)
      for (std::size_t i = 0; i < 4; ++i) most[i] = most[i] < values[k + i] ? values[k + i] : most[i];
    const double largest = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
    if (largest <= best) continue;
    best = largest;
    found = at + static_cast<std::size_t>(std::find(values, values + kPoints, largest) - values);
  }
  return static_cast<std::uint32_t>(found < v.count ? found : 0);
}

}  // namespace

ExpertSolid::ExpertSolid(const Mesh& mesh) {
  const Mesh whole = mesh.canonical();
  const MeshData& data = whole.data();
  for (const Point3& v : data.vertices) add(vertices, v);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> left_of;
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    const Face& face = data.faces[f];
    add(normals, area_vector(data, face));
    on_face.push_back(face[0]);
    for (std::size_t k = 0; k < face.size(); ++k) left_of[{face[k], face[(k + 1) % face.size()]}] = f;
  }
  for (const auto& [ends, left] : left_of) {
    const auto [a, b] = ends;
    if (a > b) continue;
    add(edges, minus(data.vertices[b], data.vertices[a]));
    sides.push_back({a, left, left_of.at({b, a})});
  }
  fill_up(vertices, vertices[0], kPoints);
  fill_up(edges, {}, kEdges);
  fill_up(normals, {}, 1);
}

ExpertBrute::ExpertBrute(const Mesh& p, const Mesh& q) : p_at_rest_(p), p_(p_at_rest_), q_(q) {
  extreme_of_p_.resize(p_.normals.count);
  extreme_of_q_.resize(q_.normals.count);
}

void ExpertBrute::build(const SolidPose& p, Signs signs) {
  turn(p);
  find_extremes();
  find_crossings(signs);
}

void ExpertBrute::turn(const SolidPose& pose) {
  const auto n = pose.rotation.matrix();
  const auto norm = static_cast<double>(pose.rotation.norm());
  const std::array<double, 3> s{pose.scale[0].approx(), pose.scale[1].approx(), pose.scale[2].approx()};
  std::array<double, 9> points{}, cofactors{};  // normals turn with the cofactors
  for (std::size_t k = 0; k < 9; ++k) {
    points[k] = static_cast<double>(n[k]) / norm * s[k % 3];
    cofactors[k] = static_cast<double>(n[k]) / norm * s[(k + 1) % 3] * s[(k + 2) % 3];
  }
  map_all(points, p_at_rest_.vertices, p_.vertices);
  map_all(points, p_at_rest_.edges, p_.edges);
  map_all(cofactors, p_at_rest_.normals, p_.normals);
}

void ExpertBrute::find_extremes() {
  for (std::size_t f = 0; f < extreme_of_p_.size(); ++f) extreme_of_p_[f] = furthest(p_.normals[f], q_.vertices);
  for (std::size_t g = 0; g < extreme_of_q_.size(); ++g) extreme_of_q_[g] = furthest(q_.normals[g], p_.vertices);
}

void ExpertBrute::find_crossings(Signs signs) {
  const std::size_t blocks = q_.edges.x.size() / kEdges;
  const auto fill_row = [&](std::uint32_t face, std::uint64_t* row) {
    double values[kEdges];
    for (std::size_t b = 0; b < blocks; ++b) {
      products(p_.normals[face], q_.edges, b * kEdges, values);
      row[b] = sign_bits(values);
    }
  };
  const bool shared = signs == Signs::by_faces;
  signs_.resize(blocks * (shared ? p_.normals.count : 2));
  for (std::uint32_t f = 0; shared && f < p_.normals.count; ++f) fill_row(f, signs_.data() + f * blocks);
  crossings_.clear();
  for (std::uint32_t e = 0; e < p_.sides.size(); ++e) {
    const auto [from, left_face, right_face] = p_.sides[e];
    const std::uint64_t* left = signs_.data() + (shared ? left_face * blocks : 0);
    const std::uint64_t* right = signs_.data() + (shared ? right_face * blocks : blocks);
    if (!shared) {
      fill_row(left_face, signs_.data());
      fill_row(right_face, signs_.data() + blocks);
    }
    const Point3 along = p_.edges[e];
    for (std::size_t b = 0; b < blocks; ++b)
      for (std::uint64_t differ = left[b] ^ right[b]; differ != 0; differ &= differ - 1) {
        const int k = std::countr_zero(differ);
        const auto q = static_cast<std::uint32_t>(b * kEdges) + static_cast<std::uint32_t>(k);
        if (q >= q_.sides.size()) continue;  // filled up
        const bool right_sign = (right[b] >> k & 1) != 0;
        const bool q_left = std::signbit(dot(q_.normals[q_.sides[q].left], along)),
                   q_right = std::signbit(dot(q_.normals[q_.sides[q].right], along));
        if (q_left != q_right && q_left == right_sign) crossings_.push_back({e, q});
      }
  }
}

double ExpertBrute::volume() const {
  double sum = 0;
  for (std::size_t f = 0; f < extreme_of_p_.size(); ++f)
    sum += dot(p_.normals[f], p_.vertices[p_.on_face[f]]) / 3 + dot(p_.normals[f], q_.vertices[extreme_of_p_[f]]);
  for (std::size_t g = 0; g < extreme_of_q_.size(); ++g)
    sum += dot(q_.normals[g], q_.vertices[q_.on_face[g]]) / 3 + dot(q_.normals[g], p_.vertices[extreme_of_q_[g]]);
  return sum;
}

}  // namespace dymsum::bench

// Positions and measures of an assembled sum.
#include <algorithm>
#include <cmath>
#include <optional>

#include "dymsum/volume_text.h"
#include "exact/decimal_text.h"
#include "spatial/convex/convex_state.h"
#include "spatial/convex/exact_places.h"
#include "spatial/convex/nearest_places.h"
#include "spatial/convex/place_sum.h"
#include "spatial/mesh/length_sum.h"

namespace dymsum {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using spatial::BigVector;
using spatial::ExactPlaces;

/// The numerators of all vertices.
std::vector<BigVector> numerators(const SolidSum& sum, const ExactPlaces& places) {
  std::array<std::vector<BigVector>, 2> table;
  std::array<std::vector<bool>, 2> known;
  for (int op = 0; op < 2; ++op) {
    table[op].resize(spatial::ConvexSumInternals::operands(sum).operand[op].size());
    known[op].resize(table[op].size());
  }
  const auto at = [&](int op, std::uint32_t v) -> const BigVector& {
    if (!known[op][v]) table[op][v] = places.of(op, v);
    known[op][v] = true;
    return table[op][v];
  };
  std::vector<BigVector> all;
  all.reserve(sum.vertices.size());
  for (const SolidSum::Vertex& v : sum.vertices) {
    const BigVector &a = at(0, v.p), &b = at(1, v.q);
    all.push_back({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
  }
  return all;
}

exact::Vector3<Big> big_vector(const BigVector& v) { return {Big(v[0]), Big(v[1]), Big(v[2])}; }

BigInteger determinant(const BigVector& a, const BigVector& b, const BigVector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

BigRational volume_of(const SolidSum& sum) {
  if (sum.vertices.empty()) return 0;
  const ExactPlaces places(spatial::ConvexSumInternals::operands(sum), sum.p_pose, sum.q_pose);
  const std::vector<BigVector> at = numerators(sum, places);
  BigInteger six = 0;
  for (const SolidFacet& f : sum.facets)
    for (std::size_t i = 1; i + 1 < f.vertices.size(); ++i)
      six += determinant(at[f.vertices[0]], at[f.vertices[i]], at[f.vertices[i + 1]]);
  return BigRational(six) * places.unit() * places.unit() * places.unit() / 6;
}

spatial::LengthSum surface_of(const SolidSum& sum) {
  spatial::LengthSum surface;
  if (sum.vertices.empty()) return surface;
  const ExactPlaces places(spatial::ConvexSumInternals::operands(sum), sum.p_pose, sum.q_pose);
  const std::vector<BigVector> at = numerators(sum, places);
  for (const SolidFacet& f : sum.facets) {
    exact::Vector3<Big>& twice = surface.vectors.emplace_back();
    const auto from_first = [&](std::size_t i) {
      return big_vector(at[f.vertices[i]]) - big_vector(at[f.vertices[0]]);
    };
    for (std::size_t i = 1; i + 1 < f.vertices.size(); ++i)
      twice = twice + exact::cross(from_first(i), from_first(i + 1));
  }
  surface.unit = places.unit() * places.unit() / 2;
  return surface;
}

}  // namespace

namespace spatial {

void place_sum(SolidSum& sum) {
  const ConvexOperands& operands = ConvexSumInternals::operands(sum);
  std::array<std::vector<std::uint32_t>, 2> used, position;  // vertices of the sum, and where these stand among them
  for (std::size_t op = 0; op < 2; ++op) position[op].assign(operands.operand[op].size(), kNoPair.p);
  const auto position_of = [&](std::size_t op, std::uint32_t v) {
    if (position[op][v] == kNoPair.p) {
      position[op][v] = static_cast<std::uint32_t>(used[op].size());
      used[op].push_back(v);
    }
    return position[op][v];
  };
  std::vector<VertexPair> pairs;
  pairs.reserve(sum.vertices.size());
  for (const SolidSum::Vertex& v : sum.vertices) pairs.push_back({position_of(0, v.p), position_of(1, v.q)});
  NearestPlaces places(operands, {used[0], used[1]});
  places.pose(sum.p_pose, sum.q_pose);
  sum.at.resize(pairs.size());
  places.place(pairs, sum.at);
}

}  // namespace spatial

RationalPoint3 SolidSum::exact(std::size_t vertex) const {
  const ExactPlaces places(*source_, p_pose, q_pose);
  const BigVector a = places.of(0, vertices.at(vertex).p), b = places.of(1, vertices.at(vertex).q);
  const auto value = [&](int k) { return exact::to_rational(BigRational(BigInteger(a[k] + b[k])) * places.unit()); };
  return {value(0), value(1), value(2)};
}

MeshData SolidSum::rounded_data() const {
  MeshData data;
  data.vertices = at;
  for (const SolidFacet& f : facets) data.faces.push_back(f.vertices);
  return data;
}

std::size_t SolidSum::edge_count() const {
  std::size_t halves = 0;
  for (const SolidFacet& f : facets) halves += f.vertices.size();
  return halves / 2;
}

Rational SolidSum::volume_exact() const { return exact::to_rational(volume_of(*this)); }
double SolidSum::volume() const { return exact::round_to_double(volume_of(*this)); }

double SolidSum::area() const { return surface_of(*this).nearest(); }

std::string volume_text(const SolidSum& sum) { return exact::decimal_text(volume_of(sum), 17); }

std::string surface_text(const SolidSum& sum) { return surface_of(sum).text(); }

}  // namespace dymsum

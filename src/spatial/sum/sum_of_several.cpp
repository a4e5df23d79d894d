// Sums as operands of further sums. Where vertices of a sum are fractions, it is an operand in units of their common
// denominator: sums commute with scaling.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "dymsum/spatial_sum.h"
#include "spatial/sum/face_triangles.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/touching_vertices.h"

namespace dymsum {

namespace {

using exact::BigInteger;
using exact::BigRational;
using spatial::SpatialSumInternals;

/// A set in units of 1 / scale.
struct Term {
  Mesh mesh;
  BigInteger scale = 1;
};

const BigInteger kWhole = 1;
// Beyond, multiples of a unit of 1 / scale are more than a double's digits apart from the unit itself.
const BigInteger kLargestScale = BigInteger(1) << 52;

/// The double that a number is, or nothing.
std::optional<double> as_double(const BigRational& value) {
  const double nearest = exact::round_to_double(value);
  if (!std::isfinite(nearest) || exact::exact_value(nearest) != value) return std::nullopt;
  return nearest;
}

std::optional<Point3> as_point(const spatial::ExactPosition& at, const BigInteger& scale) {
  const auto x = as_double(at[0] * scale), y = as_double(at[1] * scale), z = as_double(at[2] * scale);
  if (!x || !y || !z) return std::nullopt;
  return Point3{*x, *y, *z};
}

/// The smallest odd number in whose fractions a position lies, up to powers of two, as a multiple of `scale`.
BigInteger common_scale(const spatial::ExactPosition& at, const BigInteger& scale) {
  BigInteger all = scale;
  for (const BigRational& c : at) {
    const BigInteger below = denominator(c);
    all = lcm(all, BigInteger(below >> lsb(below)));
  }
  return all;
}

Error no_operand(const Point3& at) {
  Error error{ErrorCode::unsupported_operand, "a vertex of the sum is no operand's: no doubles hold its position", {}};
  error.evidence.x = at.x, error.evidence.y = at.y, error.evidence.z = at.z;
  return error;
}

/// The regular part of a sum, in the largest unit of at least 1 / `largest` in which doubles hold all vertices.
Result<Term> as_term(const SpatialSum& sum, const BigInteger& largest) {
  Term term;
  const spatial::Triangles all = spatial::split_at_touching_vertices(sum, spatial::triangulated(sum));
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> name(sum.vertices.size(), kNone), used;
  MeshData data;
  for (const spatial::Triangle& t : all.triangles) {
    Face& face = data.faces.emplace_back();
    for (const std::uint32_t v : t) {
      if (name[v] == kNone) name[v] = static_cast<std::uint32_t>(used.size()), used.push_back(v);
      face.push_back(name[v]);
    }
  }
  std::vector<spatial::ExactPosition> at;
  for (const std::uint32_t v : used) {
    at.push_back(SpatialSumInternals::positions(sum).at(v));
    term.scale = common_scale(at.back(), term.scale);
    if (term.scale > largest) return no_operand(sum.vertices[v]);
  }
  for (std::size_t k = 0; k < at.size(); ++k) {
    const std::optional<Point3> p = as_point(at[k], term.scale);
    if (!p) return no_operand(sum.vertices[used[k]]);
    data.vertices.push_back(*p);
  }
  Result<Mesh> mesh = Mesh::create(std::move(data));
  if (!mesh) return mesh.error();
  term.mesh = *std::move(mesh);
  return term;
}

/// Another unit, where doubles hold the vertices in it.
std::optional<Mesh> in_units(const Term& term, const BigInteger& scale) {
  if (term.scale == scale) return term.mesh;
  const BigInteger factor = scale / term.scale;
  const double by = exact::round_to_double(factor, kWhole);
  for (const Point3& v : term.mesh.vertices())
    if (!as_point({exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)}, factor))
      return std::nullopt;
  Result<Mesh> larger = scaled(term.mesh, by, by, by);
  return larger ? std::optional(*std::move(larger)) : std::nullopt;
}

Result<SpatialSum> sum_of_terms(const Term& a, const Term& b, const SpatialOptions& options) {
  const BigInteger scale = lcm(a.scale, b.scale);
  const std::optional<Mesh> p = in_units(a, scale), q = in_units(b, scale);
  if (!p || !q) return no_operand((p ? b : a).mesh.vertices()[0]);
  Result<SpatialSum> sum = minkowski_sum(*p, *q, options);
  if (!sum) return sum;
  SpatialSum made = *std::move(sum);
  spatial::unscale(made, scale);
  return made;
}

/// Adds the first two operands whose sum is one again; the error of the first two where no sum is.
std::optional<Error> add_two(std::vector<Term>& terms, const SpatialOptions& options) {
  std::optional<Error> first;
  for (std::size_t j = 1; j < terms.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const Result<SpatialSum> sum = sum_of_terms(terms[i], terms[j], options);
      if (!sum && sum.error().code != ErrorCode::unsupported_operand) return sum.error();
      Result<Term> term = sum ? as_term(*sum, kLargestScale) : sum.error();
      if (!term) {
        if (!first) first = term.error();
        continue;
      }
      terms[i] = *std::move(term);
      terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(j));
      return std::nullopt;
    }
  }
  return first;
}

}  // namespace

Result<Mesh> as_mesh(const SpatialSum& sum) {
  Result<Term> term = as_term(sum, kWhole);
  if (!term) return term.error();
  return std::move(*std::move(term)).mesh;
}

Result<SpatialSum> minkowski_sum(std::span<const Mesh> operands, const SpatialOptions& options) {
  if (operands.empty()) return Error{ErrorCode::unsupported_operand, "a sum needs an operand", {}};
  std::vector<Term> terms;
  for (const Mesh& mesh : operands) terms.push_back({mesh});
  const auto rank = [](const Term& t) { return t.mesh.has_thin_parts() ? 2 : convexity_error(t.mesh) ? 1 : 0; };
  std::stable_sort(terms.begin(), terms.end(), [&](const Term& a, const Term& b) { return rank(a) < rank(b); });
  if (terms.size() == 1) terms.push_back({Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value()});
  SpatialOptions between = options;
  between.semantics = Semantics::regular;
  between.trace = false;
  while (terms.size() > 2) {
    if (std::optional<Error> error = add_two(terms, between)) {
      error->message =
          "the sum of " + std::to_string(operands.size() - terms.size() + 2) + " of the operands: " + error->message;
      return *std::move(error);
    }
  }
  return sum_of_terms(terms[0], terms[1], options);
}

}  // namespace dymsum

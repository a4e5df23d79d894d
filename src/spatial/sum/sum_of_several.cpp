// Sums as operands of further sums. Where vertices of a sum are fractions, it is an operand in units of their common
// denominator: sums commute with scaling. Of doubles in these units where those hold the vertices, else of integers.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/poll.h"
#include "dymsum/spatial_sum.h"
#include "spatial/sum/exact_set.h"
#include "spatial/sum/mapped_sum.h"
#include "spatial/sum/spatial_sum.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum {

namespace {

using exact::BigInteger;
using exact::BigRational;
using spatial::SpatialSumInternals;

/// A set in units of 1 / scale; or, where no doubles hold it, by its exact positions alone.
struct Term {
  Mesh mesh;
  BigInteger scale = 1;
  std::optional<spatial::ExactSet> exact = std::nullopt;
};

const BigInteger kWhole = 1;
// The largest scale. Beyond it, multiples of a unit of 1 / scale are more than a double's digits apart from the unit
// itself.
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

spatial::ExactSet as_exact_set(const Term& term) {
  if (term.exact) return *term.exact;
  spatial::ExactSet set = spatial::exact_set(term.mesh.data(), term.mesh.thin_faces());
  for (spatial::ExactPosition& at : set.at)
    for (BigRational& c : at) c /= term.scale;
  return set;
}

Result<SpatialSum> sum_of_terms(const Term& a, const Term& b, const SpatialOptions& options) {
  if (a.exact || b.exact) return spatial::sum_of_exact_sets(as_exact_set(a), as_exact_set(b), options);
  const BigInteger scale = lcm(a.scale, b.scale);
  const std::optional<Mesh> p = in_units(a, scale), q = in_units(b, scale);
  if (!p || !q) return spatial::sum_of_exact_sets(as_exact_set(a), as_exact_set(b), options);
  Result<SpatialSum> sum = minkowski_sum(*p, *q, options);
  if (!sum) return sum;
  SpatialSum made = *std::move(sum);
  spatial::unscale(made, scale);
  return made;
}

bool has_thin(const Term& term) { return term.exact ? !term.exact->thin.empty() : term.mesh.has_thin_parts(); }

Result<Term> sum_of_two(const Term& a, const Term& b, SpatialOptions options) {
  // Parts without volume of both may add what has none; what else is tight lies within the closed sum.
  const bool both_thin = has_thin(a) && has_thin(b);
  options.semantics = both_thin ? Semantics::closed : Semantics::regular;
  options.tight = true;
  const Result<SpatialSum> sum = sum_of_terms(a, b, options);
  if (!sum) return sum.error();
  if (both_thin)
    if (spatial::ExactSet set = spatial::closed_set(*sum); !set.thin.empty()) return Term{{}, 1, std::move(set)};
  Result<Term> in_doubles = as_term(*sum, kLargestScale);
  return in_doubles ? std::move(in_doubles) : Term{{}, 1, spatial::exact_set(*sum)};
}

/// Adds the first two operands whose sum doubles hold, else the first two that have one.
Result<void> add_two(std::vector<Term>& terms, const SpatialOptions& options) {
  struct Made {
    std::size_t i, j;
    Term term;
  };
  std::optional<Error> first;
  std::optional<Made> chosen;
  for (std::size_t j = 1; j < terms.size() && !(chosen && !chosen->term.exact); ++j) {
    for (std::size_t i = 0; i < j && !(chosen && !chosen->term.exact); ++i) {
      Result<Term> term = sum_of_two(terms[i], terms[j], options);
      if (!term && term.error().code != ErrorCode::unsupported_operand && term.error().code != ErrorCode::out_of_range)
        return term.error();
      if (!term && !first) first = term.error();
      if (term && (!chosen || !term->exact)) chosen = Made{i, j, *std::move(term)};
    }
  }
  if (!chosen) return *std::move(first);
  terms[chosen->i] = std::move(chosen->term);
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(chosen->j));
  return {};
}

Result<SpatialSum> sum_of_convex(std::span<const Mesh> operands, const SpatialOptions& options) {
  Result<SpatialSum> sum = minkowski_sum(operands[0], operands[1], options);
  for (std::size_t k = 2; k < operands.size() && sum; ++k) {
    if (options.progress && !options.progress("convex", double(k - 1) / double(operands.size() - 1)))
      return cancelled();
    sum = spatial::small_convex_sum(*sum, operands[k], options.memory);
  }
  return sum;
}

}  // namespace

namespace {

/// The sum of the two before they were mapped; nothing where no doubles hold these.
std::optional<Result<SpatialSum>> sum_before_mapping(const SpatialSum& p, const SpatialSum& q,
                                                     const SpatialOptions& options) {
  return spatial::before_mapping(p, q, 1, [&](const Mesh& a, const Mesh& b) { return minkowski_sum(a, b, options); });
}

}  // namespace

Result<Mesh> as_mesh(const SpatialSum& sum) {
  Result<Term> term = as_term(sum, kWhole);
  if (!term) return term.error();
  return std::move(*std::move(term)).mesh;
}

Result<SpatialSum> minkowski_sum(const SpatialOperand& p, const SpatialOperand& q, const SpatialOptions& options) {
  const spatial::OperandSet a(p, options.semantics), b(q, options.semantics);
  const SpatialSum *first = spatial::result_of(p), *second = spatial::result_of(q);
  if (first != nullptr && second != nullptr && !a.has_thin() && !b.has_thin())
    if (auto sum = sum_before_mapping(*first, *second, options)) return *std::move(sum);
  if (a.mesh() && b.mesh()) return minkowski_sum(*a.mesh(), *b.mesh(), options);
  return spatial::sum_of_exact_sets(a.set(), b.set(), options);
}

Result<SpatialSum> minkowski_sum(const SpatialSum& p, const Mesh& q, const SpatialOptions& options) {
  return minkowski_sum(SpatialOperand(p), SpatialOperand(q), options);
}
Result<SpatialSum> minkowski_sum(const Mesh& p, const SpatialSum& q, const SpatialOptions& options) {
  return minkowski_sum(SpatialOperand(p), SpatialOperand(q), options);
}
Result<SpatialSum> minkowski_sum(const SpatialSum& p, const SpatialSum& q, const SpatialOptions& options) {
  return minkowski_sum(SpatialOperand(p), SpatialOperand(q), options);
}

Result<SpatialSum> minkowski_sum(std::span<const Mesh> operands, const SpatialOptions& options) {
  if (operands.empty()) return Error{ErrorCode::unsupported_operand, "a sum needs an operand", {}};
  const auto is_convex = [](const Mesh& mesh) { return !convexity_error(mesh); };
  if (operands.size() > 1 && options.engine == SpatialEngine::fast && !options.trace &&
      std::all_of(operands.begin(), operands.end(), is_convex))
    return sum_of_convex(operands, options);
  std::vector<Term> terms;
  for (const Mesh& mesh : operands) terms.push_back({mesh});
  const auto rank = [](const Term& t) { return t.mesh.has_thin_parts() ? 2 : convexity_error(t.mesh) ? 1 : 0; };
  std::stable_sort(terms.begin(), terms.end(), [&](const Term& a, const Term& b) { return rank(a) < rank(b); });
  if (terms.size() == 1) terms.push_back({Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value()});
  SpatialOptions between = options;
  between.trace = false;
  while (terms.size() > 2) {
    if (const Result<void> added = add_two(terms, between); !added) {
      Error error = added.error();
      error.message =
          "the sum of " + std::to_string(operands.size() - terms.size() + 2) + " of the operands: " + error.message;
      return error;
    }
  }
  return sum_of_terms(terms[0], terms[1], options);
}

}  // namespace dymsum

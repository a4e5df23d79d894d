#include "spatial/sum/mapped_sum.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "exact/orient.h"
#include "spatial/sum/feature_pairs.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

namespace {

using exact::BigInteger;
using exact::BigRational;
using Loops = std::vector<std::vector<std::uint32_t>>;
using Position = std::array<BigInteger, 4>;  // (x, y, z) / w

/// The map in integers: (rows x + shift) / unit.
class IntegerMap {
 public:
  explicit IntegerMap(const AffineMap& map) {
    std::array<BigRational, 12> all;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& row = map.rows[i];
      all[4 * i] = exact::exact_value(row.x), all[4 * i + 1] = exact::exact_value(row.y);
      all[4 * i + 2] = exact::exact_value(row.z), all[4 * i + 3] = map.shift[i];
    }
    for (const BigRational& c : all) unit_ = lcm(unit_, denominator(c));
    for (std::size_t k = 0; k < 12; ++k) m_[k] = numerator(BigRational(all[k] * unit_));
  }
  Position operator()(const ExactPosition& at) const {
    BigInteger w = 1;
    for (const BigRational& c : at) w = lcm(w, denominator(c));
    std::array<BigInteger, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = numerator(at[i]) * (w / denominator(at[i]));
    Position result;
    for (std::size_t i = 0; i < 3; ++i)
      result[i] = m_[4 * i] * x[0] + m_[4 * i + 1] * x[1] + m_[4 * i + 2] * x[2] + m_[4 * i + 3] * w;
    result[3] = unit_ * w;
    BigInteger common = result[3];
    for (std::size_t i = 0; i < 3; ++i) common = gcd(common, result[i]);
    if (common != 1)
      for (BigInteger& c : result) c /= common;
    return result;
  }

 private:
  BigInteger unit_ = 1;
  std::array<BigInteger, 12> m_;
};

bool before(const Position& a, const Position& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const int order = BigInteger(a[axis] * b[3]).compare(BigInteger(b[axis] * a[3]))) return order < 0;
  return false;
}

class Image {
 public:
  Image(SpatialSum base, AffineMap map) : mapped_(std::make_shared<MappedSum>()) {
    mapped_->base = std::move(base), mapped_->map = std::move(map);
    const auto row = [&](std::size_t i) {
      const Vec3& r = mapped_->map.rows[i];
      return Point3{r.x, r.y, r.z};
    };
    reflects_ = exact::orient3_sign({0, 0, 0}, row(0), row(1), row(2)) < 0;
  }

  SpatialSum run() {
    add_vertices();
    add_faces();
    add_tight();
    result_.stats = base().stats;
    positions_->mapped = mapped_;
    SpatialSumInternals::set_positions(result_, positions_);
    return std::move(result_);
  }

 private:
  const SpatialSum& base() const { return mapped_->base; }

  void add_vertices() {
    const std::size_t n = base().vertices.size();
    if (n == 0) return;
    const IntegerMap map(mapped_->map);
    std::vector<Position> at;
    for (std::size_t v = 0; v < n; ++v) at.push_back(map(SpatialSumInternals::positions(base()).at(v)));
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return before(at[a], at[b]); });
    name_.resize(n);
    double largest = 0;
    for (const std::uint32_t v : order) {
      name_[v] = static_cast<std::uint32_t>(result_.vertices.size());
      const auto c = [&](std::size_t axis) { return exact::round_to_double(at[v][axis], at[v][3]); };
      const Point3 p{c(0), c(1), c(2)};
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      result_.vertices.push_back(p);
      result_.vertex_contacts.push_back(base().vertex_contacts[v]);
      positions_->listed.push_back(std::move(at[v]));
    }
    result_.at_error = largest * 0x1p-53 + 0x1p-1074;
  }

  /// Loops in their new order: the outer one stays the first.
  Loops named(Loops loops) {
    for (auto& loop : loops) {
      for (std::uint32_t& v : loop) v = name_[v];
      if (reflects_) std::reverse(loop.begin(), loop.end());
      start_at_smallest(loop);
    }
    std::sort(loops.begin() + 1, loops.end());
    return loops;
  }

  void add_faces() {
    const std::size_t n = base().faces.size();
    std::vector<SpatialFace> faces = base().faces;
    for (SpatialFace& face : faces) face.loops = named(std::move(face.loops));
    std::vector<std::uint32_t> order(n), shell(base().shells, kNoId);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto begins = [&](std::uint32_t f) { return std::pair(faces[f].loops[0][0], faces[f].loops[0][1]); };
      return begins(a) != begins(b) ? begins(a) < begins(b) : faces[a].loops < faces[b].loops;
    });
    for (const std::uint32_t f : order) {
      std::uint32_t& s = shell[faces[f].shell];
      if (s == kNoId) s = static_cast<std::uint32_t>(result_.shells++);
      faces[f].shell = s;
      result_.faces.push_back(std::move(faces[f]));
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<SolidContact>> contact;
    for (const SpatialEdge& edge : base().edges())
      contact[std::minmax(name_[edge.from], name_[edge.to])] = edge.contact;
    std::vector<std::optional<SolidContact>> contacts;
    for (const SpatialEdge& edge : edges_of(result_.faces)) contacts.push_back(contact.at({edge.from, edge.to}));
    SpatialSumInternals::set_edge_contacts(result_, std::move(contacts));
  }

  /// Lists of features and of what touches there, sorted by the features.
  template <class Feature, class Contacts>
  static void add_sorted(std::vector<std::pair<Feature, Contacts>> entries, std::vector<Feature>& features,
                         std::vector<Contacts>& contacts) {
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [feature, touching] : entries) {
      features.push_back(std::move(feature));
      contacts.push_back(std::move(touching));
    }
  }
  void add_tight() {
    std::vector<std::pair<Loops, std::array<SolidContact, 2>>> faces;
    for (std::size_t k = 0; k < base().tight_faces.size(); ++k)
      faces.emplace_back(named(base().tight_faces[k]), base().tight_face_contacts[k]);
    add_sorted(std::move(faces), result_.tight_faces, result_.tight_face_contacts);
    std::vector<std::pair<std::array<std::uint32_t, 2>, std::vector<SolidContact>>> segments;
    for (std::size_t k = 0; k < base().tight_segments.size(); ++k) {
      const auto [a, b] = base().tight_segments[k];
      const auto [from, to] = std::minmax(name_[a], name_[b]);
      segments.emplace_back(std::array{from, to}, base().tight_segment_contacts[k]);
    }
    add_sorted(std::move(segments), result_.tight_segments, result_.tight_segment_contacts);
    std::vector<std::pair<std::uint32_t, std::vector<SolidContact>>> points;
    for (std::size_t k = 0; k < base().tight_points.size(); ++k)
      points.emplace_back(name_[base().tight_points[k]], base().tight_point_contacts[k]);
    add_sorted(std::move(points), result_.tight_points, result_.tight_point_contacts);
  }

  std::shared_ptr<MappedSum> mapped_;
  bool reflects_ = false;
  std::vector<std::uint32_t> name_;  // per vertex of the base
  std::shared_ptr<SpatialPositions> positions_ = std::make_shared<SpatialPositions>();
  SpatialSum result_;
};

}  // namespace

bool same_linear_part(const AffineMap& a, const AffineMap& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (a.rows[i].x != b.rows[i].x || a.rows[i].y != b.rows[i].y || a.rows[i].z != b.rows[i].z) return false;
  return true;
}

std::optional<Result<SpatialSum>> before_mapping(
    const SpatialSum& p, const SpatialSum& q, int sign,
    const std::function<Result<SpatialSum>(const Mesh&, const Mesh&)>& operation) {
  if (p.vertices.empty() || q.vertices.empty()) return std::nullopt;
  const MappedSum *a = SpatialSumInternals::positions(p).mapped.get(),
                  *b = SpatialSumInternals::positions(q).mapped.get();
  if (!a || !b || !same_linear_part(a->map, b->map)) return std::nullopt;
  const Result<Mesh> first = as_mesh(a->base), second = as_mesh(b->base);
  if (!first || !second) return std::nullopt;
  Result<SpatialSum> result = operation(*first, *second);
  if (!result) return result;
  AffineMap map = a->map;
  for (std::size_t axis = 0; axis < 3; ++axis) map.shift[axis] += sign * b->map.shift[axis];
  return mapped_sum(*std::move(result), std::move(map));
}

SpatialSum mapped_sum(SpatialSum base, AffineMap map) {
  if (base.vertices.empty()) return base;
  return Image(std::move(base), std::move(map)).run();
}

}  // namespace dymsum::spatial

namespace dymsum {

SpatialSum negated(const SpatialSum& sum) {
  using spatial::AffineMap, spatial::mapped_sum, spatial::SpatialSumInternals;
  if (sum.vertices.empty()) return sum;
  if (const auto& mapped = SpatialSumInternals::positions(sum).mapped) {
    AffineMap map = mapped->map;
    for (exact::BigRational& c : map.shift) c = -c;
    return mapped_sum(negated(mapped->base), std::move(map));
  }
  AffineMap through_origin;
  for (spatial::Vec3& row : through_origin.rows) row = -row;
  return mapped_sum(sum, through_origin);
}

}  // namespace dymsum

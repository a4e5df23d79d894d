// Spaces for coordinates of all sizes: the narrowest integers that hold them.
#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "spatial/convolution/grid_space.h"
#include "spatial/mesh/grid_points.h"
#include "spatial/mesh/rounded_vector.h"

namespace dymsum::spatial {

namespace {

using exact::Big;
using exact::Fraction;
using exact::Int;
using exact::Vector3;

std::vector<double> coordinates(const std::vector<Point3>& points, double Point3::*axis) {
  std::vector<double> values;
  for (const Point3& p : points) values.push_back(p.*axis);
  return values;
}

using Line = SumSpace::Line;

/// The grid along one axis; `bits` is raised to what it needs.
Line common_line(const std::vector<Point3>& p, const std::vector<Point3>& q, double Point3::*axis, int& bits) {
  const std::vector<double> a = coordinates(p, axis), b = coordinates(q, axis);
  Line line;
  line.exponent = exact::common_exponent(a, b);
  const auto offset = [&](const std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double midpoint = exact::grid_center(*low, *high, line.exponent);
    bits = std::max(bits, exact::bits_needed(*low, *high, midpoint, line.exponent));
    return midpoint;
  };
  line.p_offset = offset(a);
  line.q_offset = offset(b);
  return line;
}

template <class C>
std::vector<Vector3<C>> on_grid(const std::vector<Point3>& points, const Line (&lines)[3], double Line::*offset) {
  std::vector<Vector3<C>> result;
  result.reserve(points.size());
  for (const Point3& v : points) {
    result.push_back({exact::grid_coordinate<C>(v.x, lines[0].*offset, lines[0].exponent),
                      exact::grid_coordinate<C>(v.y, lines[1].*offset, lines[1].exponent),
                      exact::grid_coordinate<C>(v.z, lines[2].*offset, lines[2].exponent)});
  }
  return result;
}

/// Coordinates in 128 bits, where products and sums of mapped positions stay within 126.
std::optional<std::vector<Vector3<exact::i128>>> mapped_in_words(const MappedPositions& p) {
  std::array<exact::i128, 9> m;
  int bits = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    bits = std::max(bits, bit_length(Big(p.matrix[k])));
    if (bits > 124) return std::nullopt;
    m[k] = exact::narrowed<Int<124>>(Big(p.matrix[k])).raw();
  }
  if (p.positions.bits > 61 || p.positions.bits + bits > 124) return std::nullopt;
  std::vector<Vector3<exact::i128>> result;
  result.reserve(p.positions.grid.size());
  for (const auto& [x, y, z] : p.positions.grid)
    result.push_back({m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z});
  for (const Vector3<Big>& v : p.further) {
    if (bit_length(v) > 124) return std::nullopt;
    const auto word = [](const Big& c) { return exact::narrowed<Int<124>>(c).raw(); };
    result.push_back({word(v.x), word(v.y), word(v.z)});
  }
  return result;
}

std::vector<Vector3<Big>> mapped_of_any_size(const MappedPositions& p) {
  exact::Matrix3<Big> m;
  for (std::size_t r = 0; r < 3; ++r) m[r] = {Big(p.matrix[3 * r]), Big(p.matrix[3 * r + 1]), Big(p.matrix[3 * r + 2])};
  std::vector<Vector3<Big>> result;
  const std::size_t count = p.positions.bits <= 61 ? p.positions.grid.size() : p.positions.big.size();
  for (std::uint32_t v = 0; v < count; ++v) result.push_back(exact::apply(m, p.positions.position<Big>(v)));
  result.insert(result.end(), p.further.begin(), p.further.end());
  return result;
}

int bits_of(const std::vector<Vector3<exact::i128>>& points) {
  exact::i128 most = 0;
  for (const Vector3<exact::i128>& v : points)
    for (const exact::i128 c : {v.x, v.y, v.z}) most = std::max(most, c < 0 ? -c : c);
  int bits = 0;
  while (bits < 126 && (exact::i128{1} << bits) < most) ++bits;
  return bits;
}

template <class C, class Word>
std::vector<Vector3<C>> narrowed_points(const std::vector<Vector3<Word>>& points) {
  const auto narrow = [](const Word& v) {
    if constexpr (std::is_same_v<Word, Big>) return exact::narrowed<C>(v);
    else if constexpr (std::is_same_v<C, Big>) return exact::to_big(v);
    else return C::from_raw(exact::raw_cast<C::kBits>(v));
  };
  std::vector<Vector3<C>> result;
  result.reserve(points.size());
  for (const Vector3<Word>& v : points) result.push_back({narrow(v.x), narrow(v.y), narrow(v.z)});
  return result;
}

/// f(C{}) with the narrowest type of coordinates of so many bits.
template <class F>
std::unique_ptr<SumSpace> with_width(int bits, F f) {
  if (bits <= 26) return f(Int<26>{});
  if (bits <= 61) return f(Int<61>{});  // doubles of about one size
  if constexpr (kWidthOf72)
    if (bits <= 72) return f(Int<72>{});  // heights of slices: all digits of a double, next to operands of few
  if (bits <= 124) return f(Int<124>{});  // turned by quaternions; what rounding leaves of zeros, as in sin(pi)
  if (bits <= 250) return f(Int<250>{});  // turned by quaternions and of all digits, or with what rounding leaves
  if (bits <= kMostGridBits) return f(Big{});
  throw std::invalid_argument("coordinates of more than " + std::to_string(kMostGridBits) +
                              " bits on their common grid");
}

}  // namespace

std::unique_ptr<SumSpace> make_sum_space(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  int bits = 0;
  const Line lines[3] = {common_line(p, q, &Point3::x, bits), common_line(p, q, &Point3::y, bits),
                         common_line(p, q, &Point3::z, bits)};
  return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
    return std::make_unique<GridSpace<C>>(on_grid<C>(p, lines, &Line::p_offset), on_grid<C>(q, lines, &Line::q_offset),
                                          bits, lines);
  });
}

std::unique_ptr<SumSpace> make_sum_space(const MappedPositions& p, const MappedPositions& q, int exponent) {
  const Line lines[3] = {{exponent, 0, 0}, {exponent, 0, 0}, {exponent, 0, 0}};
  const auto a = mapped_in_words(p), b = mapped_in_words(q);
  if (a && b) {
    const int bits = std::max(bits_of(*a), bits_of(*b));
    return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
      return std::make_unique<GridSpace<C>>(narrowed_points<C>(*a), narrowed_points<C>(*b), bits, lines);
    });
  }
  const std::vector<Vector3<Big>> big_p = mapped_of_any_size(p), big_q = mapped_of_any_size(q);
  int bits = 0;
  for (const std::vector<Vector3<Big>>* points : {&big_p, &big_q})
    for (const Vector3<Big>& v : *points) bits = std::max(bits, bit_length(v));
  return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
    return std::make_unique<GridSpace<C>>(narrowed_points<C>(big_p), narrowed_points<C>(big_q), bits, lines);
  });
}

std::unique_ptr<SumSpace> make_sum_space(const std::vector<Vector3<Fraction>>& p,
                                         const std::vector<Vector3<Fraction>>& q, int exponent) {
  const Line lines[3] = {{exponent, 0, 0}, {exponent, 0, 0}, {exponent, 0, 0}};
  int bits = 0;
  bool whole = true;
  for (const std::vector<Vector3<Fraction>>* points : {&p, &q}) {
    for (const Vector3<Fraction>& v : *points) {
      for (const Fraction* c : {&v.x, &v.y, &v.z}) {
        whole = whole && c->below() == 1;
        bits = std::max({bits, bit_length(Big(c->above())), bit_length(Big(c->below()))});
      }
    }
  }
  if (!whole || bits > kMostGridBits)
    return std::make_unique<GridSpace<Fraction>>(p, q, std::max(bits, 52), lines);
  return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
    const auto narrowed = [](const std::vector<Vector3<Fraction>>& points) {
      const auto number = [](const Fraction& c) { return exact::narrowed<C>(Big(c.above())); };
      std::vector<Vector3<C>> result;
      for (const Vector3<Fraction>& v : points) result.push_back({number(v.x), number(v.y), number(v.z)});
      return result;
    };
    return std::make_unique<GridSpace<C>>(narrowed(p), narrowed(q), bits, lines);
  });
}

std::unique_ptr<SumSpace> make_root_space(std::vector<Vector3<exact::RootValue>> p,
                                          std::vector<Vector3<exact::RootValue>> q, int bits) {
  const Line lines[3] = {};
  return std::make_unique<GridSpace<exact::RootValue>>(std::move(p), std::move(q), std::max(bits, 52), lines);
}

}  // namespace dymsum::spatial

#include "versus/cgal.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_vertical_decomposition_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/Small_side_angle_bisector_decomposition_2.h>
#include <CGAL/minkowski_sum_2.h>

#include <exception>
#include <sstream>

#include "versus/child.h"

namespace dymsum::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using PolygonWithHoles = CGAL::Polygon_with_holes_2<Kernel>;
using Exact = Kernel::FT::Exact_type;

/// Sums with more vertices than this are not added up exactly: the fractions grow with every vertex.
constexpr std::size_t kExactAreaVertices = 1500;

Kernel::Point_2 as_given(const Point& point) { return {point.x, point.y}; }

/// -R(theta), applied exactly: its results are plain numbers, without the operations that led to them.
class ReflectedTurn {
 public:
  explicit ReflectedTurn(const Orientation& theta) {
    const bool half = theta.is_half_turn();  // tan(theta / 2) = 1 / 0
    const Exact n = half ? Exact(1) : Exact(theta.tan_half().numerator());
    const Exact d = half ? Exact(0) : Exact(theta.tan_half().denominator());
    const Exact w = n * n + d * d;
    cosine_ = (d * d - n * n) / w;
    sine_ = 2 * n * d / w;
  }
  Kernel::Point_2 operator()(const Point& point) const {
    const Exact x(point.x), y(point.y);
    return {Kernel::FT(Exact(sine_ * y - cosine_ * x)), Kernel::FT(Exact(-sine_ * x - cosine_ * y))};
  }

 private:
  Exact cosine_, sine_;
};

template <class Place>
Polygon polygon(const Ring& ring, const Place& place) {
  Polygon result;
  for (const Point& point : ring) result.push_back(place(point));
  return result;
}

template <class Place>
PolygonWithHoles polygon(const RegionData& region, const Place& place) {
  const Part& part = region.parts.at(0);
  PolygonWithHoles result(polygon(part.outer, place));
  for (const Ring& hole : part.holes) result.add_hole(polygon(hole, place));
  return result;
}

/// The ring without its repeated and collinear vertices.
std::vector<Kernel::Point_2> corners(const Polygon& ring) {
  std::vector<Kernel::Point_2> points(ring.vertices_begin(), ring.vertices_end());
  bool changed = true;
  while (changed && points.size() > 2) {
    std::vector<Kernel::Point_2> kept;
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Kernel::Point_2& before = kept.empty() ? points[n - 1] : kept.back();
      if (!CGAL::collinear(before, points[i], points[(i + 1) % n])) kept.push_back(points[i]);
    }
    changed = kept.size() != n;
    points = std::move(kept);
  }
  return points;
}

/// Twice the signed area's terms, one per edge, about `origin` to keep the numbers short.
template <class Number, class Coordinate>
void area_terms(const std::vector<Kernel::Point_2>& ring, Coordinate&& coordinate, std::vector<Number>& terms) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& a = ring[i];
    const auto& b = ring[(i + 1) % ring.size()];
    const Number ax = coordinate(a.x()), ay = coordinate(a.y()), bx = coordinate(b.x()), by = coordinate(b.y());
    terms.push_back(Number(ax * by - bx * ay));
  }
}

/// The sum in a balanced tree: the fractions stay short until the last few additions.
template <class Number>
Number balanced_sum(std::vector<Number> terms) {
  if (terms.empty()) return Number(0);
  while (terms.size() > 1) {
    std::vector<Number> next;
    for (std::size_t i = 0; i + 1 < terms.size(); i += 2) next.push_back(Number(terms[i] + terms[i + 1]));
    if (terms.size() % 2 == 1) next.push_back(terms.back());
    terms = std::move(next);
  }
  return terms[0];
}

void describe(const PolygonWithHoles& sum, RivalAnswer& answer) {
  std::vector<std::vector<Kernel::Point_2>> rings{corners(sum.outer_boundary())};
  for (auto hole = sum.holes_begin(); hole != sum.holes_end(); ++hole) rings.push_back(corners(*hole));
  answer.outer = 1;
  answer.holes = rings.size() - 1;
  for (const auto& ring : rings) answer.vertices += ring.size();
  if (answer.vertices <= kExactAreaVertices) {
    std::vector<Exact> terms;
    for (const auto& ring : rings)
      area_terms<Exact>(
          ring, [](const Kernel::FT& x) { return CGAL::exact(x); }, terms);
    const Exact area = balanced_sum(std::move(terms)) / Exact(2);
    answer.area = CGAL::to_double(area);
    std::ostringstream text;
    text << area;
    answer.area_exact = text.str();
    if (answer.area_exact.find('/') == std::string::npos) answer.area_exact += "/1";
  } else {
    std::vector<double> terms;
    const auto origin = rings[0][0];
    const Kernel::Vector_2 shift = CGAL::ORIGIN - origin;
    for (auto& ring : rings) {
      for (auto& point : ring) point = point + shift;
      area_terms<double>(
          ring, [](const Kernel::FT& x) { return CGAL::to_double(CGAL::exact(x)); }, terms);
    }
    answer.area = balanced_sum(std::move(terms)) / 2;
  }
}

PolygonWithHoles compute(const PolygonWithHoles& p, const PolygonWithHoles& q, CgalMethod method) {
  switch (method) {
    case CgalMethod::reduced_convolution:
      return CGAL::minkowski_sum_by_reduced_convolution_2(p, q);
    case CgalMethod::full_convolution:
      return CGAL::minkowski_sum_by_full_convolution_2(p.outer_boundary(), q.outer_boundary());
    case CgalMethod::small_side_angle_bisector:
      return CGAL::minkowski_sum_2(p.outer_boundary(), q.outer_boundary(),
                                   CGAL::Small_side_angle_bisector_decomposition_2<Kernel>());
    case CgalMethod::vertical_decomposition:
      return CGAL::minkowski_sum_2(p, q, CGAL::Polygon_vertical_decomposition_2<Kernel>());
  }
  return {};
}

}  // namespace

const char* name(CgalMethod method) {
  switch (method) {
    case CgalMethod::reduced_convolution:
      return "CGAL reduced convolution";
    case CgalMethod::full_convolution:
      return "CGAL full convolution";
    case CgalMethod::small_side_angle_bisector:
      return "CGAL decomposition (small side angle bisector)";
    case CgalMethod::vertical_decomposition:
      return "CGAL decomposition (vertical)";
  }
  return "";
}

struct CgalOperands::Polygons {
  PolygonWithHoles p, q;
};

CgalOperands::CgalOperands(const RegionData& p, const RegionData& q)
    : polygons_(new Polygons{polygon(p, as_given), polygon(q, as_given)}) {}
CgalOperands::CgalOperands(const RegionData& p, const RegionData& q, const Orientation& theta)
    : polygons_(new Polygons{polygon(p, as_given), polygon(q, ReflectedTurn(theta))}) {}
CgalOperands::~CgalOperands() = default;

RivalAnswer CgalOperands::sum(CgalMethod method, const Repeats& repeats) const {
  RivalAnswer answer;
  const PolygonWithHoles &p = polygons_->p, &q = polygons_->q;
  const bool takes_holes = method == CgalMethod::reduced_convolution || method == CgalMethod::vertical_decomposition;
  if (!takes_holes && (p.has_holes() || q.has_holes())) {
    answer.why_not = "cannot take holes";
    return answer;
  }
  try {
    PolygonWithHoles last;
    const Times times = measure(
        repeats, [&] { return compute(p, q, method); }, [&](PolygonWithHoles&& sum) { last = std::move(sum); });
    answer.median_ms = times.median();
    answer.min_ms = times.min();
    answer.runs = static_cast<int>(times.ms.size());
    describe(last, answer);
    answer.finished = true;
  } catch (const std::exception& problem) {
    answer = RivalAnswer{};
    answer.why_not = std::string("threw: ") + problem.what();
  }
  return answer;
}

RivalAnswer CgalOperands::sum_in_child(CgalMethod method, const Repeats& repeats, double limit_s) const {
  return in_child([&] { return sum(method, repeats); }, limit_s);
}

}  // namespace dymsum::bench

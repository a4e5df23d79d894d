#include "spatial/events/facet_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/big.h"
#include "exact/root_bracket.h"

namespace dymsum::spatial {
namespace {

DirectionSource::Of of_operand(int op) { return op == 0 ? DirectionSource::Of::p : DirectionSource::Of::q; }
Vec3 unit_of(Vec3 v) { return (1 / length(v)) * v; }

/// The unit vector along u x v within 2^-32, or zero, which excludes nothing, where that is not proved: the product
/// errs by 2^-50 of the sizes of u and v.
Vec3 provably_unit(Vec3 u, Vec3 v) {
  const Vec3 n = cross(u, v);
  return length(n) < length(u) * length(v) * 0x1p-16 ? Vec3{} : unit_of(n);
}

Box box_of(const WindowFacet& f, const JetFrame& frame) {
  Box box;
  for (int k = 0; k < f.facet.corners; ++k) box.add(frame.box(f.facet.corner[k]));
  return box;
}

}  // namespace

GaussMaps::GaussMaps(const RotatingPair& pair) : pair_(pair) {
  for (int op = 0; op < 2; ++op) {
    const SolidOperand& solid = pair.operand(op);
    const std::vector<Vec3>& at = pair.positions[op];
    for (const Triangle& t : solid.triangles)
      sides_[op].normals.push_back(provably_unit(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]));
    for (std::uint32_t w = 0; w < solid.wedges.size(); ++w) {
      if (solid.wedges[w].bend != Wedge::Bend::convex) continue;
      sides_[op].convex.push_back(w);
      sides_[op].edges.push_back(unit_of(at[solid.wedges[w].to] - at[solid.wedges[w].from]));
    }
    sides_[op].rays.resize(solid.rays.size());
    for (const SupportCone& cone : solid.cones)
      for (std::uint32_t k = cone.first; k < cone.last; ++k)
        sides_[op].rays[k] = unit_of(at[solid.rays[k]] - at[cone.vertex]);
  }
}

// Directions turn by at most `half`, so products of unit vectors change by no more.
std::vector<WindowFacet> GaussMaps::facets(double midpoint, double half) const {
  const JetFrame frame(pair_, midpoint, half);
  const double margin = half * (1 + 0x1p-20) + 0x1p-30;
  std::vector<WindowFacet> facets;
  for (int op = 0; op < 2; ++op) add_face_vertex(op, frame, margin, facets);
  add_edge_edge(frame, margin, facets);
  for (WindowFacet& f : facets) f.box = box_of(f, frame);
  return facets;
}

void GaussMaps::add_face_vertex(int op, const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const {
  const SolidOperand &faces = pair_.operand(op), &vertices = pair_.operand(1 - op);
  std::vector<Vec3> rays = sides_[1 - op].rays;
  for (Vec3& r : rays) r = turned(1 - op, frame.matrix(), r);
  for (std::uint32_t t = 0; t < faces.triangles.size(); ++t) {
    const Vec3 n = turned(op, frame.matrix(), sides_[op].normals[t]);
    for (const SupportCone& cone : vertices.cones) {
      bool excluded = false, proved = true;
      for (std::uint32_t k = cone.first; k < cone.last && !excluded; ++k) {
        const double slant = dot(n, rays[k]);
        excluded = slant > margin, proved = proved && slant < -margin;
      }
      if (excluded) continue;
      WindowFacet facet;
      facet.facet = face_vertex_facet(of_operand(op), faces, t, cone.vertex);
      facet.plane = plane_of(facet.facet);
      for (std::uint32_t k = cone.first; k < cone.last && !proved; ++k)
        if (!(dot(n, rays[k]) < -margin))
          facet.unsure.push_back(
              {static_cast<std::int8_t>(op), 1, t, DirectionSource{of_operand(1 - op), cone.vertex, vertices.rays[k]}});
      facets.push_back(std::move(facet));
    }
  }
}

void GaussMaps::add_edge_edge(const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const {
  const SolidOperand &p = pair_.pair.p, &q = pair_.pair.q;
  std::array<std::vector<Vec3>, 2> normals, edges;
  for (int op = 0; op < 2; ++op) {
    for (const Vec3& n : sides_[op].normals) normals[op].push_back(turned(op, frame.matrix(), n));
    for (const Vec3& e : sides_[op].edges) edges[op].push_back(turned(op, frame.matrix(), e));
  }
  for (std::size_t i = 0; i < edges[0].size(); ++i) {
    const std::uint32_t we = sides_[0].convex[i];
    const Wedge& e = p.wedges[we];
    const Vec3 el = normals[0][e.left], er = normals[0][e.right];
    const bool along = pair_.along_axis(0, e.from, e.to);
    for (std::size_t j = 0; j < edges[1].size(); ++j) {
      const double a = dot(el, edges[1][j]), b = dot(er, edges[1][j]);
      if ((a > margin && b > margin) || (a < -margin && b < -margin)) continue;
      const std::uint32_t wg = sides_[1].convex[j];
      const Wedge& g = q.wedges[wg];
      if (along && pair_.along_axis(1, g.from, g.to)) continue;  // parallel at every angle
      const double c = dot(normals[1][g.left], edges[0][i]), d = dot(normals[1][g.right], edges[0][i]);
      for (const int s : {1, -1}) {
        // s (g . e_left) >= 0 >= s (g . e_right), s (e . g_left) <= 0 <= s (e . g_right): facet_rule.h.
        const double up[4] = {-s * a, s * b, s * c, -s * d};
        if (up[0] > margin || up[1] > margin || up[2] > margin || up[3] > margin) continue;
        const SlantCondition all[4] = {
            {0, static_cast<std::int8_t>(-s), e.left, {DirectionSource::Of::q, g.from, g.to}},
            {0, static_cast<std::int8_t>(s), e.right, {DirectionSource::Of::q, g.from, g.to}},
            {1, static_cast<std::int8_t>(s), g.left, {DirectionSource::Of::p, e.from, e.to}},
            {1, static_cast<std::int8_t>(-s), g.right, {DirectionSource::Of::p, e.from, e.to}}};
        WindowFacet facet;
        facet.facet = edge_edge_facet(p, q, we, wg, s);
        facet.plane = plane_of(facet.facet);
        for (int k = 0; k < 4; ++k)
          if (!(up[k] < -margin)) facet.unsure.push_back(all[k]);
        facets.push_back(std::move(facet));
      }
    }
  }
}

using exact::AlgebraicRoot;
using exact::Polynomial;

WindowRoots::WindowRoots(const RotationCircle& circle, const RotationRange& range, SolidRotationWork& work)
    : circle_(circle), range_(range), work_(work) {
  low_ = std::nextafter(exact::double_bounds(range.low).first, -std::numeric_limits<double>::infinity());
  high_ = exact::double_bounds(range.high).second;
}

Polynomial WindowRoots::polynomial(exact::Terms form) const {
  while (form.size() > 3 && exact::divide_exactly(form, circle_.divisor())) continue;
  std::vector<exact::Big> c;
  for (exact::BigInteger& term : form) c.emplace_back(std::move(term));
  return exact::primitive_part(Polynomial(std::move(c)));
}

const std::vector<FormRoot>& WindowRoots::of(const Polynomial& p) {
  ++work_.candidates;
  std::vector<exact::BigInteger> key;
  for (int k = 0; k <= p.degree(); ++k) key.push_back(p[k].value());
  if (!key.empty() && key.back().sign() < 0)
    for (exact::BigInteger& c : key) c = -c;
  const auto [at, fresh] = known_.try_emplace(std::move(key));
  if (fresh) at->second = find(p);
  return at->second;
}

/// Whether a form has no root, by its value at the midpoint and a bound of all slopes. Coefficients are within 2^-51,
/// products of powers and sums of at most a dozen of them within 2^-48 of the sum of their sizes.
bool WindowRoots::has_none(const exact::Terms& form) const {
  std::vector<exact::BinaryParts> parts;
  int top = std::numeric_limits<int>::min();
  for (const exact::BigInteger& c : form) {
    parts.push_back(exact::binary_parts(exact::Big(c)));
    if (!parts.back().is_zero()) top = std::max(top, parts.back().exponent);
  }
  const double midpoint = low_ + (high_ - low_) / 2, half = std::max(high_ - midpoint, midpoint - low_),
               most = std::max(std::abs(low_), std::abs(high_));
  double value = 0, size = 0, slope = 0;
  for (std::size_t k = parts.size(); k-- > 0;) {
    const double c = parts[k].is_zero() ? 0 : parts[k].scaled(-top);
    value = value * midpoint + c;
    size = size * most + std::abs(c);
    if (k > 0) slope = slope * most + static_cast<double>(k) * std::abs(c);
  }
  return std::abs(value) > (half * slope) * (1 + 0x1p-40) + size * 0x1p-46 + 0x1p-900;
}

std::vector<FormRoot> WindowRoots::of(exact::Terms form) {
  if (form.empty()) {
    ++work_.candidates;
    return {};
  }
  std::size_t zeros = 0;
  while (form[zeros].is_zero()) ++zeros;
  form.erase(form.begin(), form.begin() + static_cast<std::ptrdiff_t>(zeros));
  std::vector<FormRoot> found;
  if (has_none(form)) ++work_.candidates;
  else found = of(polynomial(std::move(form)));
  if (zeros == 0 || !(range_.low < 0 && range_.high >= 0)) return found;
  if (!zero_) zero_ = angles_.add(AlgebraicRoot::of(0));
  const auto at = std::find_if(found.begin(), found.end(),
                               [&](const FormRoot& root) { return angles_.is_before(*zero_, root.angle); });
  found.insert(at, {*zero_, zeros % 2 != 0});
  return found;
}

std::vector<FormRoot> WindowRoots::find(const Polynomial& p) {
  std::vector<FormRoot> found;
  if (p.degree() < 1) return found;
  for (const AlgebraicRoot& root : exact::roots_in(p, low_, high_, counts_))
    if (exact::compare(root, range_.low) > 0 && exact::compare(root, range_.high) <= 0)
      found.push_back({angles_.add(root), root.changes_sign()});
  return found;
}

std::uint32_t RootOrder::add(const AlgebraicRoot& root) {
  std::size_t low = 0, high = ascending_.size();
  while (low < high) {
    const std::size_t midpoint = (low + high) / 2;
    const int order = exact::compare(root, roots_[ascending_[midpoint]]);
    if (order == 0) return ascending_[midpoint];
    (order < 0 ? high : low) = order < 0 ? midpoint : midpoint + 1;
  }
  const auto index = static_cast<std::uint32_t>(roots_.size());
  roots_.push_back(root);
  ascending_.insert(ascending_.begin() + static_cast<std::ptrdiff_t>(low), index);
  return index;
}

namespace {

/// Fewer slants at one angle are not worth a search of its own.
constexpr std::size_t kCrowd = 32;
constexpr std::size_t kMostCrowded = 63;

bool is_turned_over(const SlantCondition& a, const SlantCondition& b) { return a.direction.from != b.direction.from; }

std::vector<std::uint32_t> crowded_angles(const WindowSlants& slants, const RootOrder& angles) {
  std::vector<std::size_t> count(angles.size());
  for (const WindowSlant& s : slants.all())
    for (const FormRoot& root : s.roots) ++count[root.angle];
  std::vector<std::uint32_t> crowded;
  for (const std::uint32_t a : angles.ascending())
    if (count[a] >= kCrowd && crowded.size() < kMostCrowded && exact::rational_value(angles[a])) crowded.push_back(a);
  return crowded;
}

/// The cells in which sense times the slant is negative or zero at some angle.
RotationCells cells_of(const WindowSlant& slant, int sense, const std::vector<std::uint32_t>& ends,
                       const RootOrder& angles) {
  const RotationCells all = ~RotationCells{0} >> (kMostCrowded - ends.size());
  const auto from = [&](std::size_t cell) { return cell > kMostCrowded ? 0 : all >> cell << cell; };
  if (slant.sign == 0) return all;
  RotationCells cells = 0;
  std::size_t first = 0;  // the cell in which the slant has the sign
  int sign = sense * slant.sign;
  for (const FormRoot& root : slant.roots) {
    const auto at = std::lower_bound(ends.begin(), ends.end(), root.angle,
                                     [&](std::uint32_t a, std::uint32_t b) { return angles.is_before(a, b); });
    const auto cell = static_cast<std::size_t>(at - ends.begin());
    const bool at_end = at != ends.end() && *at == root.angle;
    if (sign < 0) cells |= from(first) & ~from(cell + 1);
    if (!at_end) cells |= RotationCells{1} << cell;
    first = at_end ? cell + 1 : cell;
    if (root.changes_sign) sign = -sign;
  }
  return sign < 0 ? cells | from(first) : cells;
}

}  // namespace

WindowSlants::Key WindowSlants::key(const SlantCondition& c) {
  return {static_cast<std::uint32_t>(c.op), c.triangle, std::min(c.direction.from, c.direction.to),
          std::max(c.direction.from, c.direction.to)};
}

WindowSlants::WindowSlants(const RotatingPair& pair, const std::vector<WindowFacet>& facets,
                           const ProvedSign& proved_sign, const RotationRange& range, WindowRoots& roots,
                           const std::function<void()>& again) {
  const PolynomialFrame frame(pair, range.chart);
  const RotationSigns<PolynomialFrame> exact(frame);
  std::vector<exact::Polynomial> forms;
  for (const WindowFacet& f : facets)
    for (const SlantCondition& c : f.unsure) {
      if (!index_.emplace(key(c), all_.size()).second) continue;
      if (all_.size() % 256 == 0) again();
      const Triangle& t = pair.operand(c.op).triangles[c.triangle];
      WindowSlant slant{c, proved_sign(c), {}};
      forms.emplace_back();
      if (slant.sign == 0) {
        forms.back() = roots.polynomial(exact.slant(c.op, t, c.direction).terms());
        slant.roots = roots.of(forms.back());
      }
      all_.push_back(std::move(slant));
    }
  find_signs(range, roots.angles(), forms);
}

/// Finds the signs at one angle before all of their roots.
void WindowSlants::find_signs(const RotationRange& range, const RootOrder& angles,
                              const std::vector<exact::Polynomial>& forms) {
  const AlgebraicRoot first =
      angles.size() > 0 ? angles[angles.ascending().front()] : AlgebraicRoot::rational(range.high);
  const exact::BigRational before = exact::between(AlgebraicRoot::rational(range.low), first);
  for (std::size_t k = 0; k < all_.size(); ++k)
    if (!forms[k].is_zero()) all_[k].sign = forms[k].sign_at(before);
}

namespace {

/// Slants that vanish at one angle, or at two so near to each other that a window is this many times as wide.
struct SlantsAt {
  std::uint32_t angle = 0;
  std::size_t count = 0;
};
constexpr double kCrowdWidth = 0x1p-20, kRoomBesideCrowd = 0x1p10;
/// The width, in t times |axis|, of windows in which boxes and positions decide nothing more.
constexpr double kNarrow = 0x1p-20;
constexpr std::size_t kSlantsOfPart = 16;

std::vector<exact::BigRational> around_crowds(const std::vector<SlantsAt>& at, const RootOrder& angles,
                                              const RotationRange& range) {
  const double low = exact::round_to_double(range.low), high = exact::round_to_double(range.high),
               near = (high - low) * kCrowdWidth;
  std::vector<exact::BigRational> parts;
  const auto add = [&](double t) {
    exact::BigRational end = exact::exact_value(t);
    if (end > range.low && end < range.high && (parts.empty() || end > parts.back())) parts.push_back(std::move(end));
  };
  for (std::size_t first = 0, next = 0; first < at.size(); first = next) {
    std::size_t count = 0;
    for (next = first; next < at.size(); ++next) {
      if (next > first && angles[at[next].angle].low() - angles[at[next - 1].angle].high() > near) break;
      count += at[next].count;
    }
    if (next - first < 2 || count < kCrowd) continue;
    const double begin = angles[at[first].angle].low(), end = angles[at[next - 1].angle].high(),
                 room = (end - begin) * kRoomBesideCrowd;
    const double before = first == 0 ? low : angles[at[first - 1].angle].high(),
                 after = next == at.size() ? high : angles[at[next].angle].low();
    add(begin - std::min(room, (begin - before) / 2)), add(end + std::min(room, (after - end) / 2));
  }
  return parts;
}

/// A rational angle at which so many slants vanish that it is searched on its own, as that at which an operand lies as
/// it does in itself, has a window of its own between the others: next to nothing else happens there.
std::vector<exact::BigRational> around_crowded_angles(const std::vector<SlantsAt>& at, const RootOrder& angles,
                                                      const RotationRange& range) {
  std::vector<exact::BigRational> parts;
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (at[k].count < kCrowd) continue;
    const std::optional<exact::BigRational> t = exact::rational_value(angles[at[k].angle]);
    if (!t) continue;
    const exact::BigRational before = k == 0 ? range.low : exact::exact_value(angles[at[k - 1].angle].high()),
                             after =
                                 k + 1 == at.size() ? range.high : exact::exact_value(angles[at[k + 1].angle].low());
    if (before >= *t || after <= *t) continue;
    const double room =
        exact::round_to_double(std::min<exact::BigRational>(*t - before, after - *t)) / kRoomBesideCrowd;
    const auto beside = [&](const exact::BigRational& end) {
      const AlgebraicRoot at_end = AlgebraicRoot::rational(end), at_t = AlgebraicRoot::rational(*t);
      return end < *t ? exact::between(at_end, at_t) : exact::between(at_t, at_end);
    };
    const exact::BigRational by = exact::exact_value(room);
    for (const exact::BigRational& end : {beside(*t - by), beside(*t + by)})
      if (parts.empty() || end > parts.back()) parts.push_back(end);
  }
  return parts;
}

}  // namespace

std::vector<exact::BigRational> parts_of(const WindowSlants& slants, const RootOrder& angles,
                                         const RotationRange& range) {
  std::vector<std::size_t> count(angles.size());
  for (const WindowSlant& s : slants.all())
    for (const FormRoot& root : s.roots) ++count[root.angle];
  std::vector<SlantsAt> at;
  std::size_t all = 0;
  for (const std::uint32_t a : angles.ascending())
    if (count[a] > 0) at.push_back({a, count[a]}), all += count[a];
  if (all < kCrowd || at.size() < 2) return {};
  std::vector<exact::BigRational> parts = around_crowds(at, angles, range);
  if (!parts.empty() || !(exact::round_to_double(range.high - range.low) < kNarrow)) return parts;
  parts = around_crowded_angles(at, angles, range);
  if (!parts.empty()) return parts;
  std::size_t here = 0;
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    here += at[k].count;
    if (here < kSlantsOfPart) continue;
    exact::BigRational end = exact::between(angles[at[k].angle], angles[at[k + 1].angle]);
    parts.push_back(std::move(end));
    here = 0;
  }
  return parts;
}

FacetCells::FacetCells(const std::vector<WindowFacet>& facets, const WindowSlants& slants, const RootOrder& angles)
    : crowded(crowded_angles(slants, angles)) {
  for (const WindowFacet& f : facets) {
    RotationCells cells = ~RotationCells{0} >> (kMostCrowded - crowded.size());
    for (const SlantCondition& c : f.unsure) {
      const WindowSlant& slant = slants.of(c);
      cells &= cells_of(slant, is_turned_over(c, slant.of) ? -c.sense : c.sense, crowded, angles);
    }
    of.push_back(cells);
  }
}

bool FacetCells::is_crowded(std::uint32_t angle) const {
  return std::find(crowded.begin(), crowded.end(), angle) != crowded.end();
}

}  // namespace dymsum::spatial

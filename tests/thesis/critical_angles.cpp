#include "thesis/critical_angles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dymsum::spatial {
namespace {

using exact::Big;
using exact::Quadratic;
using exact::QuadraticRoot;
using exact::Slope;

const double kTurn = 2 * std::acos(-1.0);

/// a + b cos theta + c sin theta: a form in doubles, for a unit normal, edge and axis.
struct Wave {
  double a = 0, b = 0, c = 0;
  double at(double cosine, double sine) const { return a + b * cosine + c * sine; }
};

// Unit vectors err by 2^-50, the unit axis too. Scalar products of two err by 2 2^-50 and 3 roundings of 2^-53, below
// 2^-48.5; a, a product of two such, by 2^-47.4; b, the difference of one and a, by 2^-46.8; c, of three vectors, by
// 2^-47.5. Together, with cos and sin at most 1 and the roundings of at(): below 2^-45.
constexpr double kWaveError = 0x1p-45;

/// The angle at which a wave rises or falls through zero, if doubles prove that it does: within `error` of that of
/// (cosine, sine).
struct WaveRoot {
  double cosine = 0, sine = 0, error = 0;
};

enum class Roots { none, unknown, two };

class WaveRoots {
 public:
  // A wave of amplitude r has no roots when |a| > r; here with 8 errors to spare, as r and a are at most 1 and a
  // little.
  explicit WaveRoots(const Wave& w) : w_(w), square_(w.b * w.b + w.c * w.c), height_(square_ - w.a * w.a) {}
  Roots known() const {
    return height_ < -8 * kWaveError ? Roots::none : height_ > 64 * kWaveError ? Roots::two : Roots::unknown;
  }

  /// Where w' = slope sqrt(r^2 - a^2). Let e bound |w| there and the slope be d: where d^2 >= 16 e (r + error) the
  /// slope stays above 3 d / 4 within 2 e / d, so the true wave has a root there, with this slope, and only one such
  /// exists. False where doubles cannot decide.
  bool find(int slope, WaveRoot& root) const {
    const double steep = slope * std::sqrt(height_);
    root.cosine = (-w_.a * w_.b + w_.c * steep) / square_;
    root.sine = (-w_.a * w_.c - w_.b * steep) / square_;
    const double d = slope * (w_.c * root.cosine - w_.b * root.sine) - kWaveError;
    const double e = std::abs(w_.at(root.cosine, root.sine)) + kWaveError;
    if (!(d > 0 && d * d >= 16 * e * (std::sqrt(square_) + kWaveError))) return false;
    root.error = 2 * e / d;
    return true;
  }

 private:
  Wave w_;
  double square_, height_;
};

/// The events of one face with all edges.
class FaceEvents {
 public:
  FaceEvents(const RotationForms& forms, RotationEventCounts& counts, std::vector<RotationEvent>& events)
      : forms_(forms), counts_(counts), events_(events) {}

  void find(int op, std::uint32_t f) {
    op_ = op;
    f_ = f;
    const Polytope& other = forms_.poly(1 - op);
    const Vec3 n = forms_.poly(op).normal[f], d = forms_.unit_axis();
    const double along = dot(n, d);
    const Vec3 across = (op == 0 ? -1.0 : 1.0) * cross(n, d);
    waves_.resize(other.edge_count());
    for (std::uint32_t e = 0; e < other.edge_count(); ++e) {
      const Vec3 x = other.direction[e];
      const double a = along * dot(d, x);
      waves_[e] = {a, dot(n, x) - a, dot(across, x)};
    }
    counts_.pairs += waves_.size();
    for (std::uint32_t e = 0; e < other.edge_count(); ++e) pair(e);
  }

 private:
  void pair(std::uint32_t e) {
    const WaveRoots roots(waves_[e]);
    if (roots.known() == Roots::none) return;
    if (roots.known() == Roots::unknown) return exact_pair(e);
    WaveRoot falling, rising;
    if (!roots.find(-1, falling) || !roots.find(1, rising)) return exact_pair(e);
    const int first = on_arc(falling, e), second = on_arc(rising, e);
    if (first == kUnknown || second == kUnknown) return exact_pair(e);
    if (first == kYes) add(e, QuadraticRoot::of(forms_.form(op_, f_, 2 * e), Slope::falling));
    if (second == kYes) add(e, QuadraticRoot::of(forms_.form(op_, f_, 2 * e), Slope::rising));
  }

  void exact_pair(std::uint32_t e) {
    ++counts_.exact_pairs;
    const Quadratic q = forms_.form(op_, f_, 2 * e);
    if (q.is_zero()) {
      ++counts_.persistent;
      return;
    }
    for (QuadraticRoot& root : exact::roots_of(q))
      if (exactly_on_arc(root, e)) add(e, std::move(root));
  }

  /// The two edges that bound the arc's ends: a normal on the circle lies on the arc when neither face, on the edge's
  /// left and right, is further out along it, which the next edges of these faces tell.
  std::array<HalfEdge, 2> bounds(std::uint32_t e) const {
    const Polytope& other = forms_.poly(1 - op_);
    return {other.next[2 * e], other.next[2 * e + 1]};
  }

  static constexpr int kNo = 0, kYes = 1, kUnknown = 2;
  int on_arc(const WaveRoot& root, std::uint32_t e) const {
    int answer = kYes;
    for (const HalfEdge h : bounds(e)) {
      const Wave& w = waves_[h / 2];
      const double value = (h & 1 ? -1.0 : 1.0) * w.at(root.cosine, root.sine);
      const double error = 2 * root.error + 2 * kWaveError;  // waves are at most 1 and a little steep
      if (value > error) return kNo;
      if (value >= -error) answer = kUnknown;
    }
    return answer;
  }
  bool exactly_on_arc(const QuadraticRoot& root, std::uint32_t e) const {
    for (const HalfEdge h : bounds(e))
      if (exact::sign_at(root, forms_.form(op_, f_, h)) > 0) return false;
    return true;
  }

  void add(std::uint32_t e, const std::optional<QuadraticRoot>& root) {
    if (!root) throw std::logic_error("find_turn_events: a root that doubles proved is missing");
    events_.push_back(
        {forms_.angle(*root), f_, e, static_cast<std::int8_t>(op_), static_cast<std::int8_t>(root->slope())});
  }

  const RotationForms& forms_;
  RotationEventCounts& counts_;
  std::vector<RotationEvent>& events_;
  std::vector<Wave> waves_;
  int op_ = 0;
  std::uint32_t f_ = 0;
};

/// One event per angle. Doubles order all but clusters of neighbours that are closer than their errors; these are
/// ordered exactly.
std::vector<RotationEvent> in_order(const RotationForms& forms, std::vector<RotationEvent> events,
                                    RotationEventCounts& counts) {
  std::stable_sort(events.begin(), events.end(),
                   [](const RotationEvent& a, const RotationEvent& b) { return a.angle < b.angle; });
  std::vector<RotationEvent> distinct;
  exact::RungCounts orders;
  for (std::size_t begin = 0, end; begin < events.size(); begin = end) {
    end = begin + 1;
    while (end < events.size() && events[end].angle - events[end - 1].angle <= 2 * RotationForms::kAngleError) ++end;
    std::vector<std::pair<QuadraticRoot, std::size_t>> cluster;
    if (end - begin > 1)
      for (std::size_t k = begin; k < end; ++k) cluster.emplace_back(events[k].root(forms), k);
    std::stable_sort(cluster.begin(), cluster.end(),
                     [&](const auto& a, const auto& b) { return exact::compare_turns(a.first, b.first, orders) < 0; });
    distinct.push_back(events[cluster.empty() ? begin : cluster[0].second]);
    for (std::size_t k = 1; k < cluster.size(); ++k)
      if (exact::compare_turns(cluster[k - 1].first, cluster[k].first, orders) != 0)
        distinct.push_back(events[cluster[k].second]);
  }
  counts.exact_orders += orders.exact();
  return distinct;
}

}  // namespace

RotationForms::RotationForms(const Polytope& p, const Polytope& q, std::array<std::int64_t, 3> axis)
    : poly_{&p, &q}, axis_(axis) {
  const Vec3 d{static_cast<double>(axis[0]), static_cast<double>(axis[1]), static_cast<double>(axis[2])};
  length_ = length(d);
  unit_ = {d.x / length_, d.y / length_, d.z / length_};
}

// Widths for coordinates of B bits and an axis of 15: normals 2 B + 3, edges B + 1, their product 3 B + 6; the middle
// term 3 B + 22 and the last one 3 B + 41 at most.
Quadratic RotationForms::form(int op, std::uint32_t f, HalfEdge h) const {
  const Polytope &own = *poly_[op], &other = *poly_[1 - op];
  const auto of = [&](auto c) {
    using C = decltype(c);
    using D = std::conditional_t<std::is_same_v<C, Big>, Big, exact::Int<15>>;
    const exact::Vector3<D> d{D::from_int64(axis_[0]), D::from_int64(axis_[1]), D::from_int64(axis_[2])};
    const auto n = own.template normal_vector<C>(f);
    const auto x = other.template edge_vector<C>(h);
    const auto plain = exact::dot(n, x);
    const auto midpoint = exact::shift_left<1>(exact::dot(n, exact::cross(d, x)));
    const auto last = exact::shift_left<1>(exact::dot(n, d) * exact::dot(d, x)) - exact::dot(d, d) * plain;
    return Quadratic(Big(plain), op == 0 ? -Big(midpoint) : Big(midpoint), Big(last));
  };
  const int bits = std::max(own.bits, other.bits);
  if (bits <= 26) return of(exact::Int<26>{});
  if (bits <= 61) return of(exact::Int<61>{});
  return of(Big{});
}

// A component errs by 2^-49 of itself, the length by 2^-52, so the half angle by 2^-48 at most, and atan2, doubling and
// adding a full turn by a few 2^-50.
double RotationForms::angle(const QuadraticRoot& root) const {
  const auto [u, v] = root.approx();
  const double theta = 2 * std::atan2(v * length_, u);
  return theta < 0 ? theta + kTurn : theta;
}

QuadraticRoot RotationEvent::root(const RotationForms& forms) const {
  return *QuadraticRoot::of(forms.form(op, face, 2 * edge), static_cast<Slope>(slope));
}

std::optional<std::vector<RotationEvent>> find_rotation_events(
    const RotationForms& forms, RotationEventCounts& counts,
    const std::function<bool(std::size_t, std::size_t)>& on_face) {
  std::vector<RotationEvent> events;
  FaceEvents face(forms, counts, events);
  const std::size_t all = forms.poly(0).face_count() + forms.poly(1).face_count();
  std::size_t done = 0;
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t f = 0; f < forms.poly(op).face_count(); ++f, ++done) {
      if (done % 16 == 0 && !on_face(done, all)) return std::nullopt;
      face.find(op, f);
    }
  counts.meetings = events.size();
  return in_order(forms, std::move(events), counts);
}

}  // namespace dymsum::spatial

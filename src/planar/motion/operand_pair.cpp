#include "planar/motion/operand_pair.h"

#include <cmath>
#include <string>

#include "base/double_text.h"
#include "exact/grid.h"
#include "planar/motion/orientation.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

using exact::BigInteger;

// A stretched operand has fractions over the denominator of its factors, with which the other one is multiplied.
ExactForms::ExactForms(const OperandPair& base) : scaled_(base.moved) {
  const Lattice& l = *base.given;
  const LatticeScale factors = base.lattice_scale(ScaleValue{});
  for (std::uint32_t op = 0; op < 2; ++op) {
    const bool moves = op == base.moved;
    const BigInteger &x = moves ? factors.x : factors.den, &y = moves ? factors.y : factors.den;
    const Point offset = l.points[op]->offset;
    for (const Point& v : l.points[op]->input)
      at_[op].push_back({exact::grid_coordinate<exact::Big>(v.x, offset.x, l.grid_exponent).value() * x,
                         exact::grid_coordinate<exact::Big>(v.y, offset.y, l.grid_exponent).value() * y});
  }
}

ExactForms::Vec ExactForms::edge(const Edge& e) const {
  const Vec &a = at_[e.op][e.from], &b = at_[e.op][e.to];
  return {b.x - a.x, b.y - a.y};
}

ExactForm ExactForms::cross(const Vec& d, Pair v) const {
  const Vec& p = at_[0][v.p];
  const Vec& q = at_[1][v.q];
  ExactForm f{d.x * p.y - d.y * p.x, d.x * q.y - d.y * q.x};
  if (scaled_ == 0) std::swap(f.a, f.b);
  return f;
}

ExactForm ExactForms::side(const Segment& s, Pair v) const {
  const Vec d = edge(s.edge);
  const ExactForm at = cross(d, v), from = cross(d, start_of(s));
  return {at.a - from.a, at.b - from.b};
}

ExactForm ExactForms::along(const Segment& s, Pair v) const {
  const Vec d = edge(s.edge), turned{d.y, -d.x};  // turned x w = d . w
  const ExactForm at = cross({turned.x, turned.y}, v), from = cross({turned.x, turned.y}, start_of(s));
  return {at.a - from.a, at.b - from.b};
}

ExactForm ExactForms::concurrent(const Segment& a, const Segment& b, const Segment& c) const {
  const Vec da = edge(a.edge), db = edge(b.edge), dc = edge(c.edge);
  const ExactForm ha = cross(da, start_of(a)), hb = cross(db, start_of(b)), hc = cross(dc, start_of(c));
  const BigInteger bc = db.x * dc.y - db.y * dc.x, ca = dc.x * da.y - dc.y * da.x, ab = da.x * db.y - da.y * db.x;
  return {ha.a * bc + hb.a * ca + hc.a * ab, ha.b * bc + hb.b * ca + hc.b * ab};
}

std::uint64_t ExactForms::line_hash(const Segment& s) const {
  Vec d = edge(s.edge);
  const BigInteger common = gcd(d.x, d.y);
  if (common > 1) {
    d.x /= common;
    d.y /= common;
  }
  const ExactForm h = cross(d, start_of(s));
  std::uint64_t hash = 0;
  for (const BigInteger& v : {d.x, d.y, h.a, h.b}) {
    const auto& raw = v.backend();
    for (unsigned i = 0; i < raw.size(); ++i)
      hash = (hash ^ static_cast<std::uint64_t>(raw.limbs()[i])) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (v.sign() < 0)) * 0xbf58476d1ce4e5b9u;
    hash ^= hash >> 31;
  }
  return hash;
}

namespace {

// The vertex that needs the finest grid.
Error too_far_apart(const Lattice& lattice) {
  Error error{ErrorCode::unsupported_operand,
              "sums that move need operands that reach less than 2^920 times as far as the finest step of their "
              "coordinates; this one takes steps of 2^" +
                  std::to_string(lattice.grid_exponent),
              {}};
  for (const auto& points : lattice.points)
    for (const Point& v : points->input)
      if (v != Point{} && exact::common_exponent({&v, 1}) == lattice.grid_exponent) {
        error.evidence.x = v.x;
        error.evidence.y = v.y;
        return error;
      }
  return error;
}

}  // namespace

Result<std::shared_ptr<const OperandPair>> OperandPair::create(
    const std::array<std::shared_ptr<const Operand>, 2>& kept, const std::array<std::vector<Point>, 2>& further,
    std::uint32_t moved, int min_tier_bits, Spread spread) {
  auto base = std::make_shared<OperandPair>();
  base->moved = moved;
  base->min_tier_bits = min_tier_bits;
  std::array<std::shared_ptr<const PlacedPoints>, 2> points;
  for (std::uint32_t op = 0; op < 2; ++op) {
    if (std::optional<Error> error = too_large(*kept[op])) return *std::move(error);
    points[op] = kept[op]->points;
    if (further[op].empty()) continue;
    std::vector<Point> all = points[op]->input;
    all.insert(all.end(), further[op].begin(), further[op].end());
    points[op] = place_points(std::move(all));
    if (std::optional<Error> error = too_large(*points[op])) return *std::move(error);
  }
  base->given = base->lattice = make_lattice(points[0], points[1], min_tier_bits, Further::lattices);
  if (spread == Spread::narrow && base->lattice->wide) return too_far_apart(*base->lattice);
  base->place({placed_on(*base->lattice, kept[0]), placed_on(*base->lattice, kept[1])});
  for (const Operand& o : base->operands) {
    for (const Component& c : o.components) base->regular &= c.dimension == 2;
    base->connected &= o.components.size() == 1;
  }
  return std::shared_ptr<const OperandPair>(std::move(base));
}

void OperandPair::place(const std::array<std::shared_ptr<const Operand>, 2>& placed) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    operands[op] = *placed[op];
    width[op] = operands[op].points->width;
    height[op] = operands[op].points->height;
  }
}

// Coordinates of moderate size are stretched and scaled, and two of them multiplied; where units are chosen for their
// spread, products may underflow as far as they do without a factor.
static_assert(2 * (PlacedPoints::kModerateBits + 65 + OperandPair::kFactorBits) <= 1022);
bool OperandPair::may_be_stretched() const {
  return given->points[moved]->bits(given->grid_exponent) + kFactorBits <= kNarrowBits;
}

std::shared_ptr<const OperandPair> OperandPair::stretched(const ScaleValue& x, const ScaleValue& y) const {
  auto made = std::make_shared<OperandPair>();
  made->moved = moved;
  made->min_tier_bits = min_tier_bits;
  made->given = given;
  made->lattice = lattice_at(lattice_scale(x, y));
  made->regular = regular;
  made->connected = connected;
  made->factors_ = {x, y};
  made->place({operand_at(0, *made->lattice), operand_at(1, *made->lattice)});
  return made;
}

LatticeScale OperandPair::lattice_scale(const ScaleValue& x, const ScaleValue& y) const {
  if (x == y) return {x.num, x.num, x.den, moved};
  const exact::BigInteger common = boost::multiprecision::lcm(x.den, y.den);
  return {exact::BigInteger(x.num * (common / x.den)), exact::BigInteger(y.num * (common / y.den)), common, moved};
}

LatticeScale OperandPair::lattice_scale(const ScaleValue& s) const {
  const auto along = [&](const ScaleValue& factors) {
    if (factors == ScaleValue{}) return s;
    return scale_value(exact::BigRational(rational(s) * rational(factors)));
  };
  return lattice_scale(along(factors_[0]), along(factors_[1]));
}

std::shared_ptr<const Lattice> OperandPair::lattice_at(const Placement& at) const {
  if (const auto* scale = std::get_if<LatticeScale>(&at)) return make_scaled_lattice(*given, *scale, min_tier_bits);
  return make_turned_lattice(*lattice, turn_of(std::get<Orientation>(at), moved), min_tier_bits);
}

std::shared_ptr<const Operand> OperandPair::operand_at(std::uint32_t op, const Lattice& at) const {
  return placed_on(at, std::shared_ptr<const Operand>(shared_from_this(), &operands[op]));
}

PlacedPair OperandPair::placed_on_lattice(std::shared_ptr<const Lattice> at) const {
  const Lattice& l = *at;
  return {std::move(at), operand_at(0, l), operand_at(1, l)};
}

Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const PairOptions& options) {
  return OperandPair::create({prepared_operand(p, 0), prepared_operand(q, 1, options.reflect_q)}, options.further,
                             options.moved, options.min_tier_bits, options.spread);
}

Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const MovingOptions& options) {
  if (!(options.window >= 0) || std::isinf(options.window))
    return Error{ErrorCode::out_of_range,
                 "the window must be finite and at least 0, not " + base::general_text(options.window, 6),
                 {}};
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  return pair_of_regions(p, q,
                         PairOptions{.moved = options.moving == MovingOperand::p ? 0U : 1U,
                                     .reflect_q = options.reflect_q,
                                     .min_tier_bits = SumInternals::min_tier_bits(options)});
}

namespace {

// Sums of vertices need no lattice: (p - p') num + (q - q') den, with P and Q the other way round when Q scales.
std::optional<int> compare_scaled(const OperandPair& base, const LatticeScale& scale, const SumVertex& a,
                                  const SumVertex& b, int axis) {
  if (base.given->tier_bits == 0) return std::nullopt;
  const SharedIntegers& integers = base.given->unscaled_integers();
  exact::BigInteger sum = 0;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const auto& source = base.operands[op].vertex_of_index;
    const std::uint32_t i = source[op == 0 ? a.corner_p : a.corner_q], j = source[op == 0 ? b.corner_p : b.corner_q];
    const exact::i128 d = integers.at[op][i][axis] - integers.at[op][j][axis];
    if (d == 0) continue;
    sum += exact::to_big(d).value() * (op != scale.op ? scale.den : axis == 0 ? scale.x : scale.y);
  }
  return sum.sign();
}

// Sums with one vertex of the rotating operand differ as the vertices that stand still do.
std::optional<int> compare_turned(const OperandPair& base, const SumVertex& a, const SumVertex& b, int axis) {
  const std::uint32_t still = 1 - base.moved;
  if ((still == 0 ? a.corner_q : a.corner_p) != (still == 0 ? b.corner_q : b.corner_p)) return std::nullopt;
  const auto& source = base.operands[still].vertex_of_index;
  const std::vector<Point>& input = base.lattice->points[still]->input;
  const Point &u = input[source[still == 0 ? a.corner_p : a.corner_q]],
              &v = input[source[still == 0 ? b.corner_p : b.corner_q]];
  const double x = axis == 0 ? u.x : u.y, y = axis == 0 ? v.x : v.y;
  return x < y ? -1 : x > y;
}

}  // namespace

// Both ways round to the nearest double; quotients of doubles do so by themselves.
double ExactFrame::tau(std::uint32_t moving) const {
  if (moving == base_->moved) return value_.approx;
  constexpr std::int64_t kDoubles = std::int64_t{1} << 53;
  if (value_.num < kDoubles && value_.den < kDoubles)
    return value_.den.convert_to<double>() / value_.num.convert_to<double>();
  return exact::round_to_double(exact::BigRational(value_.den, value_.num));
}

const Lattice& ExactFrame::lattice() {
  if (lattice_ == nullptr) lattice_ = base_->lattice_at(at_);
  return *lattice_;
}

// The operand that stands still is the same at every scale, but not on the lattice of a rotation.
const Operand& ExactFrame::operand(std::uint32_t op) {
  if (operands_[op] == nullptr)
    operands_[op] = op != base_->moved && std::holds_alternative<LatticeScale>(at_)
                        ? std::shared_ptr<const Operand>(base_, &base_->operands[op])
                        : base_->operand_at(op, lattice());
  return *operands_[op];
}

PlacedPair ExactFrame::placed() {
  lattice();
  operand(0);
  operand(1);
  return {lattice_, operands_[0], operands_[1]};
}

Collision& ExactFrame::collision() {
  if (collision_ == nullptr) collision_ = std::make_unique<Collision>(lattice(), operand(0), operand(1), true);
  return *collision_;
}

bool ExactFrame::inside_right_of(const Segment& on, const std::optional<Segment>& from,
                                 const std::optional<Segment>& to) {
  const auto cut = [](const std::optional<Segment>& by, Pair end) {
    return by ? Cut{Cut::Kind::crossing, {}, *by} : Cut{Cut::Kind::pair, end, {}};
  };
  SegmentPosition p;
  p.on = on;
  p.first = cut(from, start_of(on));
  p.second = cut(to, end_of(on));
  p.between = true;
  round_position(lattice(), p);
  return collision().overlaps_right_of(p);
}

// Both lie on one contact whose edge is upright (axis 0) or level (axis 1): rectilinear shapes ask this all the time.
// What no boundary passes may be a sum of two points, which no contact carries, whatever it names.
bool FrameSource::on_common_line(const SumVertex& a, const SumVertex& b, int axis) const {
  if (a.in == a.out || b.in == b.out) return false;
  const auto straight = [&](const Contact& c) {
    const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1;
    if (op == base_->moved && std::holds_alternative<Orientation>(at_)) return false;
    const auto [from, to] = base_->operands[op].edge_of_index[op == 0 ? c.p : c.q];
    const Point &u = base_->lattice->points[op]->input[from], &v = base_->lattice->points[op]->input[to];
    return axis == 0 ? u.x == v.x : u.y == v.y;
  };
  for (const Contact& c : {a.in, a.out})
    if ((c == b.in || c == b.out) && straight(c)) return true;
  return false;
}

// The order of two sums of vertices, where it can be determined without placing the operands.
std::optional<int> FrameSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  if (a.corner_p == SumVertex::kNone || b.corner_p == SumVertex::kNone) return std::nullopt;
  const auto* scale = std::get_if<LatticeScale>(&at_);
  return scale != nullptr ? compare_scaled(*base_, *scale, a, b, axis) : compare_turned(*base_, a, b, axis);
}

int FrameSource::compare(const SumVertex& a, const SumVertex& b, int axis) const {
  if (on_common_line(a, b, axis)) return 0;
  if (const std::optional<int> sign = compare_corners(a, b, axis)) return *sign;
  return axis == 0 ? source().compare_x(a, b) : source().compare_y(a, b);
}

const SumSource& FrameSource::source() const {
  std::call_once(made_, [this] {
    PlacedPair at = base_->placed(at_);
    source_ = std::make_unique<SumSource>(std::move(at.lattice), std::move(at.p), std::move(at.q));
  });
  return *source_;
}

}  // namespace dymsum::planar

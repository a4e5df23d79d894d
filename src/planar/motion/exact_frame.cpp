#include "planar/motion/exact_frame.h"

#include "planar/operand/round_position.h"

namespace dymsum::planar {
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
bool FrameSource::on_common_line(const SumVertex& a, const SumVertex& b, int axis) const {
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

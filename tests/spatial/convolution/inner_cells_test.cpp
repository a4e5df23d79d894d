// What is known to be deep inside a sum: never a position outside of it. The sums are known: of two L-shaped prisms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "oracles/sanitized.h"
#include "spatial/convolution/inner_cells.h"

namespace dymsum {
namespace {

using spatial::Box;
using spatial::InnerCells;
using spatial::SolidOperand;
using spatial::SumFacet;
using spatial::SumPoint;
using spatial::Vec3;

/// [0, 2] x [0, 2] without its corner beyond (step, step), of some height.
MeshData l_prism(double step, double height) {
  MeshData m;
  for (const double z : {0.0, height})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, step}, {step, step}, {step, 2.0}, {0.0, 2.0}})
      m.vertices.push_back({x, y, z});
  m.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (std::uint32_t i = 0; i < 6; ++i) m.faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
  return m;
}

/// Axes taken in another order, some of them backward.
struct Turn {
  std::array<std::size_t, 3> axis;
  std::array<double, 3> sign;

  std::array<double, 3> forth(const std::array<double, 3>& v) const {
    std::array<double, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = sign[i] * v[axis[i]];
    return r;
  }
  std::array<double, 3> back(const std::array<double, 3>& v) const {
    std::array<double, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) r[axis[i]] = sign[i] * v[i];
    return r;
  }
  MeshData operator()(MeshData m) const {
    for (Point3& p : m.vertices) {
      const auto [x, y, z] = forth({p.x, p.y, p.z});
      p = {x, y, z};
    }
    if (is_reflection())
      for (Face& f : m.faces) std::reverse(f.begin(), f.end());
    return m;
  }
  bool is_reflection() const {
    const bool odd = (axis[0] + 1) % 3 != axis[1];
    return odd != (sign[0] * sign[1] * sign[2] < 0);
  }
};

/// The open sum of two such prisms.
struct SumOfTwo {
  double s, t, height;

  bool corner(double x, double y) const {
    return (x < 4 && y < s + t) || (x < s + t && y < 4) || (x < 2 + t && y < s + 2) || (x < s + 2 && y < 2 + t);
  }
  bool holds(const std::array<double, 3>& v) const { return holds(v, v); }
  /// A closed box: with its upper corner it holds all of it that has positive coordinates.
  bool holds(const std::array<double, 3>& low, const std::array<double, 3>& high) const {
    return low[0] > 0 && low[1] > 0 && low[2] > 0 && high[2] < height && corner(high[0], high[1]);
  }
};

class InnerCellsOfPrisms {
 public:
  InnerCellsOfPrisms(std::mt19937_64& random, const Turn& turn)
      : random_(random),
        turn_(turn),
        s_(dyadic(0.25, 1.75)),
        t_(dyadic(0.25, 1.75)),
        height_(random() % 2 == 0 ? 0.5 : 3),
        sum_{s_, t_, 2 * height_},
        watch_(options_, stats_) {
    MeshData p = l_prism(s_, height_);
    // Points of no face, to make facets of.
    for (int k = 0; k < 200; ++k) p.vertices.push_back({dyadic(0, 2), dyadic(0, 2), dyadic(0, height_)});
    p_ = spatial::solid_operand(turn(p), {}, spatial::FlatFeatures::kept);
    q_ = spatial::solid_operand(turn(l_prism(t_, height_)), {}, spatial::FlatFeatures::kept);
    space_ = spatial::make_sum_space(p_.vertices, q_.vertices);
    watch_.begin("inner cells");
    inner_ = std::make_unique<InnerCells>(*space_, p_, q_, 24 + static_cast<int>(random() % 20), watch_);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto line = space_->line(static_cast<int>(i));
      offset_[i] = line.p_offset + line.q_offset, unit_[i] = std::ldexp(1.0, line.exponent);
    }
  }

  int check_boxes() {
    int held = 0;
    for (int k = 0; k < 4000; ++k) {
      std::array<double, 3> low{}, high{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double most = i == 2 ? 2 * height_ : 4;
        low[i] = dyadic(-0.1, most), high[i] = low[i] + dyadic(0, 0.06 * most);
      }
      if (k % 2 == 1) {  // near the inner steps, where boxes of both may end at once
        const std::size_t across = random_() % 2;
        low[across] = s_ + t_ + dyadic(-0.25, 0.05), high[across] = low[across] + dyadic(0, 0.25);
        low[1 - across] = 2 + std::max(s_, t_) + dyadic(0, 0.2), high[1 - across] = low[1 - across] + 0.0625;
      }
      const auto a = turn_.forth(low), b = turn_.forth(high);
      Box box;
      box.add(on_grid(a)), box.add(on_grid(b));
      if (!inner_->hold(box)) continue;
      ++held;
      EXPECT_TRUE(sum_.holds(low, high)) << low[0] << " " << low[1] << " " << low[2] << " to " << high[0] << " "
                                         << high[1] << " " << high[2] << ", steps " << s_ << " " << t_;
    }
    return held;
  }

  int check_facets() {
    int held = 0;
    const auto vertices = static_cast<std::uint32_t>(p_.vertices.size());
    for (int k = 0; k < 4000; ++k) {
      SumFacet facet;
      facet.corners = 3 + random_() % 2;
      for (SumPoint& c : facet.corner)
        c = {static_cast<std::uint32_t>(12 + random_() % (vertices - 12)), static_cast<std::uint32_t>(random_() % 12)};
      std::array<std::array<double, 3>, 4> at;
      for (std::size_t i = 0; i < 4; ++i) {
        const Point3 &a = p_.vertices[facet.corner[i].p], &b = q_.vertices[facet.corner[i].q];
        at[i] = turn_.back({a.x + b.x, a.y + b.y, a.z + b.z});
      }
      if (!inner_->hold(facet)) continue;
      ++held;
      bool all = sample(at[0], at[1], at[2]);
      if (facet.corners == 4) all = all && sample(at[0], at[2], at[3]);
      EXPECT_TRUE(all) << "steps " << s_ << " " << t_;
    }
    return held;
  }

 private:
  double dyadic(double low, double high) {
    const double v = low + (high - low) * static_cast<double>(random_() % 4096) / 4096;
    return std::floor(v * 256) / 256;
  }
  Vec3 on_grid(const std::array<double, 3>& v) const {
    return {(v[0] - offset_[0]) / unit_[0], (v[1] - offset_[1]) / unit_[1], (v[2] - offset_[2]) / unit_[2]};
  }
  bool sample(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c) const {
    constexpr int kSteps = 24;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        std::array<double, 3> v{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          v[axis] = (i * a[axis] + j * b[axis] + (kSteps - i - j) * c[axis]) / kSteps;
        if (!sum_.holds(v)) return false;
      }
    return true;
  }

  std::mt19937_64& random_;
  Turn turn_;
  double s_, t_, height_;
  SumOfTwo sum_;
  SpatialOptions options_;
  SpatialStats stats_;
  spatial::StageWatch watch_;
  SolidOperand p_, q_;
  std::unique_ptr<spatial::SumSpace> space_;
  std::unique_ptr<InnerCells> inner_;
  std::array<double, 3> offset_{}, unit_{};
};

TEST(InnerCells, know_what_lies_over_a_point) {
  const Vec3 a{0, 0, 1}, b{4, 0, 1}, c{0, 4, 1};
  const auto passes = [&](Vec3 from) { return spatial::passes_upward(from, a, b, c, 0x1p-40); };
  EXPECT_EQ(passes({1, 1, 0}), 1);
  EXPECT_EQ(passes({1, 1, 2}), 0) << "above";
  EXPECT_EQ(passes({3, 3, 0}), 0) << "beside";
  EXPECT_EQ(passes({1, 1, 1}), -1) << "on it";
  EXPECT_EQ(passes({2, 2, 0}), -1) << "below its border";
  EXPECT_EQ(passes({2 + 0x1p-41, 2, 0}), -1) << "as far as the margin tells";
  EXPECT_EQ(spatial::passes_upward({1, 1, 0}, a, c, b, 0x1p-40), 1) << "seen from the other side";
}

TEST(InnerCells, hold_boxes_and_facets_of_the_open_sum_alone) {
  std::mt19937_64 random(7);
  int boxes = 0, facets = 0;
  for (const std::array<std::size_t, 3> axis :
       {std::array<std::size_t, 3>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}})
    for (int signs = 0; signs < 8; signs += oracles::kSanitized ? 3 : 1) {
      const Turn turn{axis, {signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, signs & 4 ? -1.0 : 1.0}};
      InnerCellsOfPrisms cells(random, turn);
      boxes += cells.check_boxes();
      facets += cells.check_facets();
    }
  EXPECT_GT(boxes, oracles::rounds(10000, 3));
  EXPECT_GT(facets, oracles::rounds(1000, 3));
}

}  // namespace
}  // namespace dymsum

#include "scaling/kinds.h"

#include <numbers>
#include <vector>

#include "dymsum/orientation_sum.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"
#include "off_grid.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

struct Scaling {
  using Sum = ScalingSum;
  using Position = Scale;
  ScalingSum from_scratch;

  Scaling(const Region& p, const Region& q) : from_scratch(rebuilding(p, q)) {}
  static ScalingSum rebuilding(const Region& p, const Region& q) {
    MovingOptions options;
    options.mode = FrameMode::rebuild;
    return ScalingSum::create(p, q, options).value();
  }
  PlanarSum at(const Scale& s) {
    from_scratch.set(s).value();
    return from_scratch.sum();
  }
};

struct Turning {
  using Sum = RotatingSum;
  using Position = Orientation;
  Region p, q;
  PlanarSum at(const Orientation& theta) const { return rotated_sum(p, q, theta).value(); }
};

/// Making the sum, and all frames.
template <class Motion>
OffGridCase sweep_case(const std::string& name, const Region& p, const Region& q,
                       const std::vector<typename Motion::Position>& positions) {
  return off_grid_case(name, p, q, [positions](const Region& a, const Region& b) {
    OffGridWork work;
    work.run = [=] {
      auto sum = Motion::Sum::create(a, b, MovingOptions{}).value();
      std::size_t vertices = 0;
      for (const auto& position : positions) {
        sum.set(position).value();
        vertices += sum.sum().vertex_count();
      }
      return vertices;
    };
    work.compare = [=] {
      auto sum = Motion::Sum::create(a, b, MovingOptions{}).value();
      Motion motion(a, b);
      std::size_t different = 0;
      double ms = 0;
      for (const auto& position : positions) {
        sum.set(position).value();
        const double start = cpu_ms();
        const PlanarSum answer = motion.at(position);
        ms += cpu_ms() - start;
        different += !(answer == sum.sum());
      }
      return Compared{different == 0 ? "equal" : std::to_string(different) + " DIFFERENT", different > 0, ms};
    };
    return work;
  });
}

/// The events between two scales, each of them with an exact frame.
OffGridCase events_case(const std::string& name, const Region& p, const Region& q, const Scale& low,
                        const Scale& high) {
  return off_grid_case(name, p, q, [=](const Region& a, const Region& b) {
    const auto sum = std::make_shared<const ScalingSum>(ScalingSum::create(a, b).value());
    OffGridWork work;
    work.run = [=] { return sum->events(low, high).value().size(); };
    work.compare = [] { return Compared{"-", false, 0}; };
    return work;
  });
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const Region star = shapes::noisy_star(100, 0.5, 1), other = shapes::noisy_star(100, 0.5, 2),
               gear = shapes::gear(30, 8, 10, shapes::demo_snap(10)),
               pinion = shapes::gear(13, 2, 3, shapes::demo_snap(3)), comb = shapes::comb(20, 2, 1, 3),
               small_comb = shapes::comb(7, 2, 1, 3);
  std::vector<Scale> scales;
  for (int k = 0; k <= 50; ++k) scales.push_back(Scale::of(Rational::of(100 + k, 100).value()).value());
  std::vector<Orientation> turn;
  for (int k = 0; k < 120; ++k) turn.push_back(Orientation::nearest(2 * std::numbers::pi * k / 120, 1e-6).value());
  const Scale one = scales.front(), later = Scale::of(Rational::of(33, 32).value()).value();
  return off_grid_table(
      {"scaling",
       "Sums that scale (`1:1.5:0.01`) and turn (120 steps a turn): making the sum and all frames together; "
       "and the events between two scales (per event).",
       "vertex", "from scratch",
       "From scratch: the static sum at every one of the places, exactly. Compared: every frame with it."},
      {sweep_case<Scaling>("scales, star 100 + star 100", star, other, scales),
       sweep_case<Scaling>("scales, gear 30 + gear 13", gear, pinion, scales),
       sweep_case<Scaling>("scales, comb 20 + comb 7", comb, small_comb, scales),
       sweep_case<Turning>("turns, star 100 + star 100", star, other, turn),
       sweep_case<Turning>("turns, comb 20 + comb 7", comb, small_comb, turn),
       events_case("events of 1:33/32, gear 30 + gear 13", gear, pinion, one, later)},
      folder);
}

}  // namespace dymsum::bench

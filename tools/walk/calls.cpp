// One public call by its name, for walk.py: what a call needs is made before it, and its functions are counted from the
// entry of walked() to its return.
#include <dymsum/dymsum.h>
#include <dymsum/penetration_depth.h>

#include <array>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>

namespace {

using namespace dymsum;

/// Makes what a call needs and returns the call.
using Call = std::function<void()>;

template <class T>
std::shared_ptr<T> held(Result<T> made) {
  return std::make_shared<T>(std::move(made).value());
}

const Region kGear = shapes::gear(12, 8, 10), kStar = shapes::star(5, 1.5, 3), kComb = shapes::comb(3, 2, 1, 6),
             kRod = shapes::rectangle(-1.5, -0.25, 1.5, 0.25);

Mesh channel() { return solids::prism(shapes::letter_u(4, 4, 1).parts().front().outer, 5); }

/// Exact scales from s on in steps of 1 %.
Scale scale_of(int step) { return Scale::parse(std::to_string(100 + step) + "/100").value(); }

std::map<std::string, std::function<Call()>> calls() {
  std::map<std::string, std::function<Call()>> all;
  all["minkowski_sum(regions)"] = [] { return [] { minkowski_sum(kGear, kStar).value(); }; };
  all["erode(regions)"] = [] { return [] { erode(kGear, kStar).value(); }; };
  all["united"] = [] { return [] { united(kGear, kComb).value(); }; };
  all["ScalingSum::set"] = [] {
    const auto sum = held(ScalingSum::create(kGear, kStar));
    return [sum] {
      for (int step = 1; step < 12; ++step) sum->set(scale_of(step)).value();
    };
  };
  all["ScalingSum::next_event"] = [] {
    const auto sum = held(ScalingSum::create(kGear, kStar));
    return [sum] { sum->next_event(scale_of(0), scale_of(100)).value(); };
  };
  all["RotatingSum::set"] = [] {
    MovingOptions options;
    options.mode = FrameMode::window;
    const auto sum = held(RotatingSum::create(kStar, kGear, options));
    return [sum] {
      for (int step = 1; step < 12; ++step) sum->set(Orientation::of(step, 1000).value()).value();
    };
  };
  all["CspaceObstacle::create"] = [] { return [] { CspaceObstacle::create(kRod, kComb).value(); }; };
  all["plan"] = [] {
    const auto obstacle = held(CspaceObstacle::create(kRod, kComb));
    return [obstacle] { plan(*obstacle, Configuration{-3, 10, 0}, Configuration{1.5, 3, 1.5}).value(); };
  };
  all["minkowski_sum(convex solids)"] = [] {
    return [p = solids::geodesic_sphere(2, 3), q = solids::cylinder(9, 1, 2)] { minkowski_sum(p, q).value(); };
  };
  all["minkowski_sum(solids)"] = [] {
    return [p = channel(), q = solids::box(0, 0, 0, 2, 1, 1)] { minkowski_sum(p, q).value(); };
  };
  all["MovingSolidSum::set"] = [] {
    MovingSolidOptions options;
    options.mode = FrameMode::window;
    const auto sum = held(MovingSolidSum::create(channel(), solids::rod(18, 9, 0.5, 3, solids::kDemoSnap), options));
    return [sum] {
      for (int step = 1; step < 3; ++step) {
        sum->set({Rotation::about({1, 2, 3}, 0.01 * step).value(), {}}).value();
        sum->sum();
      }
    };
  };
  all["SolidDepth::at"] = [] {
    const auto depth = held(SolidDepth::create(channel(), solids::rod(18, 9, 0.5, 3, solids::kDemoSnap)));
    return [depth] { depth->at({0.5, 0.5, 1}); };
  };
  return all;
}

}  // namespace

/// What is counted.
__attribute__((noinline)) void walked(const std::function<void()>& call) { call(); }

int main(int argc, char** argv) {
  const auto all = calls();
  if (argc == 1)
    for (const auto& [name, make] : all) std::cout << name << "\n";
  if (argc == 2) walked(all.at(argv[1])());
}

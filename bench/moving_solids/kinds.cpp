#include "moving_solids/kinds.h"

#include <memory>
#include <numbers>

#include "dymsum/moving_solid_sum.h"
#include "dymsum/solid_scale_events.h"
#include "off_grid.h"
#include "solid/inputs.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

using Pose = SolidPose (*)(int frame);
constexpr int kFrames = 10;

SolidPose turned_by(int frame) { return {*Rotation::about({1, 2, 3}, 2 * std::numbers::pi * frame / 500), {}}; }
SolidPose scaled_by(int frame) {
  SolidPose pose;
  for (Scale& axis : pose.scale) axis = *Scale::parse(std::to_string(100 + frame) + "/100");
  return pose;
}

MovingSolidSum moving_sum(const Mesh& p, const Mesh& q, FrameMode mode = FrameMode::automatic) {
  MovingSolidOptions options;
  options.mode = mode;
  return MovingSolidSum::create(p, q, options).value();
}

/// The frames of a motion there and back; the sum is made before.
OffGridCase motion_case(const std::string& name, const SolidPair& pair, Pose pose) {
  return off_grid_case(name + ", " + pair.name, Mesh::create(pair.p).value(), Mesh::create(pair.q).value(),
                       [=](const Mesh& p, const Mesh& q) {
                         const auto moving = std::make_shared<MovingSolidSum>(moving_sum(p, q));
                         OffGridWork work;
                         work.run = [=] {
                           std::size_t faces = 0;
                           for (int k = 1; k <= 2 * kFrames; ++k) {
                             moving->set(pose(k <= kFrames ? k : 2 * kFrames - k)).value();
                             faces += moving->sum().faces.size();
                           }
                           return faces;
                         };
                         work.compare = [=] {
                           MovingSolidSum fresh = moving_sum(p, q, FrameMode::rebuild);
                           std::size_t different = 0;
                           double ms = 0;
                           for (int k = 1; k <= kFrames; ++k) {
                             const double start = cpu_ms();
                             fresh.set(pose(k)).value();
                             ms += 2 * (cpu_ms() - start);
                             moving->set(pose(k)).value();
                             different += !(moving->sum() == fresh.sum());
                           }
                           const bool wrong = different > 0;
                           return Compared{wrong ? std::to_string(different) + " DIFFERENT" : "equal", wrong, ms};
                         };
                         return work;
                       });
}

/// Events of P + s Q over [1, 33/32].
OffGridCase events_case(const SolidPair& pair) {
  return off_grid_case("events, " + pair.name, Mesh::create(pair.p).value(), Mesh::create(pair.q).value(),
                       [](const Mesh& p, const Mesh& q) {
                         const auto sum =
                             std::make_shared<const SolidScaleEvents>(SolidScaleEvents::create(p, q).value());
                         const Scale low = *Scale::parse("1"), high = *Scale::parse("33/32");
                         OffGridWork work;
                         work.run = [=] { return sum->events(low, high).value().size(); };
                         work.compare = [] { return Compared{"-", false, 0}; };
                         return work;
                       });
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const std::vector<SolidPair> pairs = solid_pairs("");
  std::vector<OffGridCase> cases;
  for (const char* name : {"torus 256 + torus 256", "block + thinner peg", "L + L"}) {
    cases.push_back(motion_case("turns", pair_named(pairs, name), turned_by));
    cases.push_back(motion_case("scales", pair_named(pairs, name), scaled_by));
  }
  cases.push_back(events_case(pair_named(pairs, "torus 96 + ball 48")));
  return off_grid_table(
      {"moving-solids",
       "Ten frames of 1/500 turn, or of 1 % of scale, there and back; and the events of a scaling "
       "(their number in place of faces).",
       "face", "from scratch", "Compared: the frames there with sums from scratch at the same exact poses."},
      cases, folder);
}

}  // namespace dymsum::bench

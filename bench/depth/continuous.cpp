#include "depth/continuous.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <mutex>
#include <numbers>
#include <random>
#include <thread>

#include "depth/kinds.h"
#include "dymsum/continuous_depth.h"
#include "dymsum/solids.h"
#include "page.h"
#include "solid/inputs.h"

namespace dymsum::bench {
namespace {

using Steady = std::chrono::steady_clock;

double us_since(Steady::time_point begin) {
  return std::chrono::duration<double, std::micro>(Steady::now() - begin).count();
}

/// Of this thread: others take the processor from it now and then.
double processor_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

double distance_of(const Point3& a, const Point3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }
double angle_between(const Point3& a, const Point3& b) { return 2 * std::asin(std::min(1.0, 0.5 * distance_of(a, b))); }

double percentile(std::vector<double>& sorted, double fraction) {
  return sorted.empty() ? 0
                        : sorted[std::min(sorted.size() - 1,
                                          static_cast<std::size_t>(fraction * static_cast<double>(sorted.size())))];
}

/// Steps of a thousandth of the size, in directions that turn slowly; back to the boundary where Q left P or came deep.
class Walk {
 public:
  Walk(double size, Point3 start) : size_(size), at_(start) {}

  Point3 next(const ContinuousContact& last, double deepest) {
    const auto bend = [&](double v) { return v + 0.2 * noise_(random_); };
    way_ = {bend(way_.x), bend(way_.y), bend(way_.z)};
    if (last.meeting == Meeting::overlapping && last.euclidean_depth > deepest) way_ = last.euclidean_normal;
    if (last.meeting != Meeting::overlapping) way_ = {home_.x - at_.x, home_.y - at_.y, home_.z - at_.z};
    else home_ = at_;
    const double step = 0.001 * size_ / std::max(1e-9, std::hypot(way_.x, way_.y, way_.z));
    return at_ = {at_.x + step * way_.x, at_.y + step * way_.y, at_.z + step * way_.z};
  }
  Point3 at() const { return at_; }

 private:
  double size_;
  Point3 at_, home_{}, way_{1, 0, 0};
  std::mt19937_64 random_{17};
  std::normal_distribution<double> noise_;
};

struct Continuity {
  long overlapping = 0, unsmoothed = 0, unexplained = 0;
  long jumps[5] = {};
  double turn = 0, slope = 0, ratio = 1, ratios = 0, exact_slope = 0;
  std::vector<double> us, recut_us;  ///< of answers without and with local sums

  void add(const ContinuousContact& last, const ContinuousContact& c, double moved, double took_us) {
    if (c.meeting != Meeting::overlapping) return;
    ++overlapping, unsmoothed += !c.smoothed, ++jumps[static_cast<int>(c.discontinuity)];
    ratio = std::max(ratio, c.depth / c.euclidean_depth), ratios += c.depth / c.euclidean_depth;
    (c.work.local_sums == 0 ? us : recut_us).push_back(took_us);
    if (last.meeting == Meeting::overlapping)
      exact_slope = std::max(exact_slope, std::abs(c.euclidean_depth - last.euclidean_depth) / moved);
    if (c.discontinuity != Discontinuity::none) return;
    const double turned = angle_between(last.normal, c.normal);
    turn = std::max(turn, turned / moved), slope = std::max(slope, std::abs(c.depth - last.depth) / moved);
    // Across an edge of the boundary the rate changes once.
    unexplained += turned > 3 * std::max(last.turn_rate, c.turn_rate) * moved + 1e-6;
  }
};

Point3 start_of(const Mesh& p, const Mesh& q) {
  return {bounds(p)[3] - bounds(q)[0] - 0.01 * (bounds(p)[3] - bounds(p)[0]), 0, 0};
}

}  // namespace

std::vector<ContinuousPair> continuous_pairs() {
  return {{"bar + cube", solids::box(-2, -1, -0.5, 2, 1, 0.5).data(),
           solids::box(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5).data(), 2},
          {"torus 1024 + torus 1024", torus(1, 0.4, 32, 16), turned(torus(1, 0.4, 32, 16), 0.7, 0.3, 0.2), 2},
          {"blob 1012 + blob 1012", blob(1, 0.3, 23, 23, 1), blob(1, 0.3, 23, 23, 2), 2},
          {"ell + tunnel", ell(), tunnel(), 10}};
}

void continuity(long steps, Kind kind, Report& report) {
  report.line("\n## Continuous depth\n");
  report.line(
      "Q walks at random in and about P, in steps of a thousandth of P's size, down to a tenth of it deep; so many "
      "steps "
      "in all. `turn` is the largest turn of the normal, in radians, and `slope` the largest change of depth, for a "
      "unit of translation in P's sizes, both without jumps; `exact slope` that of the exact depth, which is 1 at "
      "most. `unexplained`: steps without a told jump whose normal turns by more than three times what the derivatives "
      "at both ends say. Microseconds of processor time are those of whole answers, exact depth included; where the "
      "margin was used up, with a local sum, milliseconds in the last column.\n");
  report.heading({"pair", "smoothing", "steps inside", "turn", "slope", "exact slope", "depth / exact: mean", "worst",
                  "folds", "too long", "lost", "not smoothed", "unexplained", "us: median", "p99", "worst",
                  "with a local sum: worst ms"});
  const std::vector<ContinuousPair> pairs = with_coordinates(continuous_pairs(), kind, report);
  const std::vector<double> lengths = {0.1, 0.3, 1};
  const long each = steps / static_cast<long>(pairs.size() * lengths.size());
  for (const ContinuousPair& pair : pairs)
    for (const double length : lengths) {
      const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
      ContinuousDepthOptions options;
      options.smoothing_length = length * pair.size;
      ContinuousDepth depth = ContinuousDepth::create(p, q, options).value();
      Walk walk(pair.size, start_of(p, q));
      Continuity found;
      ContinuousContact last = depth.query(walk.at()).value();
      for (long k = 0; k < each; ++k) {
        const Point3 before = walk.at(), at = walk.next(last, 0.1 * pair.size);
        const double begin = processor_us();
        const ContinuousContact c = depth.query(at).value();
        found.add(last, c, distance_of(before, at), processor_us() - begin);
        last = c;
      }
      for (std::vector<double>* list : {&found.us, &found.recut_us}) std::sort(list->begin(), list->end());
      const auto count = [&](Discontinuity why) { return std::to_string(found.jumps[static_cast<int>(why)]); };
      report.row({pair.name, fixed(length, 1) + " sizes", std::to_string(found.overlapping),
                  fixed(found.turn * pair.size, 2), fixed(found.slope, 3), fixed(found.exact_slope, 6),
                  fixed(found.ratios / static_cast<double>(std::max(1L, found.overlapping)), 3), fixed(found.ratio, 3),
                  count(Discontinuity::fold), count(Discontinuity::inflation), count(Discontinuity::lost),
                  std::to_string(found.unsmoothed), std::to_string(found.unexplained),
                  fixed(percentile(found.us, 0.5), 1), fixed(percentile(found.us, 0.99), 1),
                  fixed(percentile(found.us, 1), 1), fixed(percentile(found.recut_us, 1) / 1000, 1)});
    }
}

namespace {

/// The last patch that was published, and when Q is where.
struct Shared {
  std::mutex mutex;
  std::optional<DepthPatch> patch;
  std::uint64_t version = 0;
  std::atomic<bool> stop{false};
  Steady::time_point begin = Steady::now();

  double seconds() const { return us_since(begin) * 1e-6; }
};

/// A hand that presses Q into P about a position, and moves it to and fro by some hundredths of the size.
struct Hand {
  Point3 about;
  double size;

  Point3 at(double s) const {
    const double r = 0.02 * size;
    return {about.x + r * std::sin(6.3 * s), about.y + 3 * r * std::sin(2.7 * s), about.z + 3 * r * std::cos(1.9 * s)};
  }
  Rotation turned(double s) const { return Rotation::about({1, 2, 3}, 0.1 * std::sin(1.7 * s)).value(); }
};

/// From outside towards the origin, until Q is some hundredths deep.
Hand hand_of(ContinuousDepth& depth, double size, const Mesh& p, const Mesh& q) {
  Hand hand{start_of(p, q), size};
  while (depth.query(hand.about).value().depth < 0.04 * size) hand.about.x -= 0.005 * size;
  return hand;
}

std::vector<double> make_patches(ContinuousDepth& depth, const Hand& hand, Shared& shared) {
  std::vector<double> ms;
  while (!shared.stop) {
    const double now = shared.seconds(), begin = processor_us();
    if (!depth.query(hand.at(now), hand.turned(now))) continue;
    DepthPatch patch = depth.patch();
    {
      const std::lock_guard lock(shared.mutex);
      shared.patch = std::move(patch), ++shared.version;
    }
    ms.push_back((processor_us() - begin) / 1000);
  }
  return ms;
}

struct ForceLoop {
  std::vector<double> us, late_us;
  double jump = 0;  ///< the largest turn of the normal from one force to the next
  long jumps = 0;
};

ForceLoop query_patches(const Hand& hand, double seconds, Shared& shared) {
  ForceLoop loop;
  // Before all others, as force loops run; without the right to, as it comes.
  const sched_param priority{.sched_priority = 10};
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
  std::optional<DepthPatch> patch;
  std::uint64_t version = 0;
  Point3 normal{};
  Steady::time_point due = Steady::now();
  while (shared.seconds() < seconds) {
    due += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(due);
    loop.late_us.push_back(us_since(due));
    const double begin = processor_us();
    if (std::unique_lock lock(shared.mutex, std::try_to_lock); lock && shared.version != version)
      patch = shared.patch, version = shared.version;
    if (!patch) continue;
    const ContinuousContact c = patch->at(hand.at(shared.seconds()));
    loop.us.push_back(processor_us() - begin);
    if (c.meeting != Meeting::overlapping) continue;
    if (normal != Point3{}) loop.jump = std::max(loop.jump, angle_between(normal, c.normal));
    loop.jumps += c.discontinuity != Discontinuity::none && c.discontinuity != Discontinuity::entered;
    normal = c.normal;
  }
  return loop;
}

}  // namespace

void two_rates(double seconds, Kind kind, Report& report) {
  report.line("\n## Two rates\n");
  report.line(
      "One thread follows Q, which moves and turns, by local sums and publishes what it knows of the boundary; another "
      "one, with real-time priority, asks the last patch for a depth and a direction every millisecond, as a force "
      "loop "
      "does. Processor time of all calls in " +
      fixed(seconds, 0) + " seconds; `late` is how much after its millisecond the loop wakes up.\n");
  report.heading({"pair", "geometry ms: median", "p99", "worst", "force us: median", "p99", "worst", "late us: p99",
                  "worst", "largest turn", "jumps"});
  for (const ContinuousPair& pair : with_coordinates(continuous_pairs(), kind, report)) {
    const double size = pair.size;
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    ContinuousDepthOptions options;
    options.smoothing_length = 0.1 * size, options.margin = 0.02 * size, options.tight = false;
    ContinuousDepth depth = ContinuousDepth::create(p, q, options).value();
    const Hand hand = hand_of(depth, size, p, q);
    Shared shared;
    std::vector<double> ms;
    std::thread geometry([&] { ms = make_patches(depth, hand, shared); });
    ForceLoop loop;
    std::thread([&] { loop = query_patches(hand, seconds, shared); }).join();
    shared.stop = true;
    geometry.join();
    for (std::vector<double>* list : {&ms, &loop.us, &loop.late_us}) std::sort(list->begin(), list->end());
    report.row({pair.name, fixed(percentile(ms, 0.5), 2), fixed(percentile(ms, 0.99), 2), fixed(percentile(ms, 1), 2),
                fixed(percentile(loop.us, 0.5), 1), fixed(percentile(loop.us, 0.99), 1),
                fixed(percentile(loop.us, 1), 1), fixed(percentile(loop.late_us, 0.99), 0),
                fixed(percentile(loop.late_us, 1), 0), fixed(loop.jump, 4), std::to_string(loop.jumps)});
  }
}

}  // namespace dymsum::bench

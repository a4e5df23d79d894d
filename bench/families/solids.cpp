#include "families/solids.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dymsum/moving_solid_sum.h"
#include "dymsum/solid_rotation_family.h"
#include "dymsum/solid_scaling_family.h"
#include "spread.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

struct Measured {
  std::vector<double> first, again, scratch;
  std::size_t compared = 0, different = 0, vertices = 0;
};

template <class Family>
void write_row(Report& report, const std::string& name, const std::string& interval, const Family& family,
               double making, const Measured& m) {
  const SolidFamilyWork work = family.work();
  const double scratch = spread(m.scratch).mean, again = spread(m.again).mean;
  report.row(
      {name, interval, std::to_string(m.vertices), std::to_string(work.events) + ", " + std::to_string(work.visible),
       fixed(making, 0), ratio(making, scratch, 0), fixed(scratch, 2), fixed(spread(m.first).mean, 2), fixed(again, 3),
       "**" + ratio(scratch, again, 1) + "**",
       fixed(static_cast<double>(work.bytes) / static_cast<double>(std::max<std::uint64_t>(work.kept, 1)) / 1024, 0),
       std::to_string(m.compared) + ", " + std::to_string(m.different)});
}

void heading(Report& report) {
  report.heading({"pair", "interval", "vertices", "events, visible", "making ms", "in sums from scratch",
                  "from scratch ms", "first in a cell ms", "further ones ms", "from scratch / further",
                  "KB a structure", "compared, different"});
}

/// A query in a cell that was not asked, further ones at the same parameter, and a sum from scratch there.
template <class Family, class Parameter, class Scratch>
void measure_at(const Family& family, const Parameter& at, Scratch scratch, Measured& m) {
  const auto timed = [](auto work, std::vector<double>& ms, int times) {
    for (int k = 0; k < times; ++k) {
      const double start = cpu_ms();
      const Result<SpatialSum> sum = work();
      ms.push_back(cpu_ms() - start);
      if (!sum) throw std::runtime_error("a sum failed");
    }
  };
  timed([&] { return family.at(at); }, m.first, 1);
  timed([&] { return family.at(at); }, m.again, 5);
  timed(scratch, m.scratch, 1);
  const SpatialSum sum = family.at(at).value();
  ++m.compared, m.vertices = std::max(m.vertices, sum.vertices.size());
  m.different += !(sum == scratch().value());
}

struct Plan {
  const char *name, *low, *high;
};

}  // namespace

void measure_solid_scalings(Report& report, const std::string& only, const std::string& data) {
  report.line(
      "\n## Solids, one of which scales\n\nQ scales. From scratch: `minkowski_sum` of prepared operands at the exact "
      "scale. First: the first "
      "query in a cell, which makes its structure; further ones: in the same cell. Six random scales.\n");
  heading(report);
  const std::vector<SolidPair> pairs = solid_pairs(data);
  for (const Plan& plan : {Plan{"blob 1024 + blob 1024", "1/2", "2"}, Plan{"blob 1024 + blob 1024", "1", "101/100"},
                           Plan{"torus 1024 + torus 1024", "1", "11/10"}}) {
    if (std::string(plan.name).find(only) == std::string::npos) continue;
    const SolidPair& pair = pair_named(pairs, plan.name);
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    const Scale low = Scale::parse(plan.low).value(), high = Scale::parse(plan.high).value();
    SolidFamilyOptions options;
    options.moving = MovingOperand::q;
    const double start = cpu_ms();
    const SolidScalingFamily family = SolidScalingFamily::create(p, q, low, high, options).value();
    const double making = cpu_ms() - start;
    Measured measured;
    for (const double u : {0.13, 0.27, 0.41, 0.58, 0.72, 0.93}) {
      const double s = low.approx() + u * (high.approx() - low.approx());
      const Scale at = Scale::of(std::round(s * 0x1p12) * 0x1p-12).value();
      if (family.locate(at).event) continue;
      measure_at(
          family, at,
          [&] {
            return posed_sum(p, q, {}, {{}, {at, at, at}});
          },
          measured);
    }
    write_row(report, plan.name, std::string(plan.low) + " to " + plan.high, family, making, measured);
  }
}

void measure_solid_turns(Report& report, const std::string& only, const std::string& data) {
  report.line(
      "\n## Solids, one of which turns\n\nP turns about (1, 2, 3), by half angles with tangents from 1/1000 to "
      "11/1000. From scratch: `posed_sum` at the exact "
      "angle.\n");
  heading(report);
  const std::vector<SolidPair> pairs = solid_pairs(data);
  for (const std::string name : {"torus 1024 + torus 1024", "blob 1024 + blob 1024"}) {
    if (name.find(only) == std::string::npos) continue;
    const SolidPair& pair = pair_named(pairs, name);
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    const AxisTurn from = AxisTurn::of(Rational::parse("1/1000").value()),
                   to = AxisTurn::of(Rational::parse("11/1000").value());
    const double start = cpu_ms();
    const SolidRotationFamily family = SolidRotationFamily::create(p, q, {1, 2, 3}, from, to).value();
    const double making = cpu_ms() - start;
    const SolidRotationEvents scratch = SolidRotationEvents::create(p, q, {1, 2, 3}).value();
    Measured measured;
    for (const double u : {0.13, 0.27, 0.41, 0.58, 0.72, 0.93}) {
      const AxisTurn at = AxisTurn::of(Rational::of(std::round((0.001 + 0.01 * u) * 0x1p20) * 0x1p-20).value());
      if (family.locate(at).event) continue;
      measure_at(
          family, at, [&] { return scratch.at(at); }, measured);
    }
    write_row(report, name, "t from 1/1000 to 11/1000", family, making, measured);
  }
}

}  // namespace dymsum::bench

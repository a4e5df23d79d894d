#include "solid/measure.h"

#include <malloc.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>

#include "dymsum/mesh_io.h"
#include "python.h"
#include "spread.h"
#include "versus/child.h"
#include "versus/solid_rivals.h"

namespace dymsum::bench {
namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// kB of the process now, or at most since the mark was reset.
double status_kb(const char* field) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(field)) return std::strtod(line.c_str() + std::string(field).size() + 1, nullptr);
  return 0;
}

/// Bytes that allocations hold; of a process that has used one thread only.
double allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// The peak (as `area`) and what of it the sum holds (as `min_ms`), in a process of its own.
RivalAnswer measured_memory(const Mesh& p, const Mesh& q) {
  return in_child(
      [&] {
        SpatialOptions options;
        options.threads = 1;
        const Mesh tiny = Mesh::create(ell()).value();
        if (!minkowski_sum(tiny, tiny, options)) return RivalAnswer{};  // the program's own pages are there now
        malloc_trim(0);  // or the sum would use what earlier ones gave back, which is counted already
        std::ofstream("/proc/self/clear_refs") << "5";
        const double before = status_kb("VmRSS:"), allocated = allocated_bytes();
        const Result<SpatialSum> sum = minkowski_sum(p, q, options);
        RivalAnswer bytes;
        bytes.finished = sum.ok();
        bytes.area = (status_kb("VmHWM:") - before) * 1024;
        bytes.min_ms = allocated_bytes() - allocated;
        return bytes;
      },
      600);
}

/// Of a valid mesh.
MeshData triangles_of(const MeshData& data) { return triangulated(Mesh::create(data).value()).mesh.data(); }

RivalAnswer query_cgal(const SolidPair& pair, double limit_s) {
  return in_child(
      [&] {
        RivalAnswer answer;
        const NefAnswer nef = cgal_nef_sum_of_solids(triangles_of(pair.p), triangles_of(pair.q));
        answer.finished = true;
        answer.median_ms = answer.min_ms = nef.ms, answer.runs = 1;
        answer.area = nef.volume, answer.vertices = nef.vertices;
        return answer;
      },
      limit_s);
}

}  // namespace

RivalAnswer query_manifold(const SolidPair& pair, bool guard, double limit_s) {
  RivalAnswer answer;
  if (!has_python()) {
    answer.why_not = "no manifold3d";
    return answer;
  }
  std::istringstream words(query_python("manifold_sum.py",
                                        {{"p.off", format_mesh(triangles_of(pair.p), MeshFormat::off)},
                                         {"q.off", format_mesh(triangles_of(pair.q), MeshFormat::off)}},
                                        guard ? "--guard" : "", limit_s));
  if (words >> answer.median_ms >> answer.area >> answer.outer) {
    answer.finished = true, answer.runs = 1, answer.min_ms = answer.median_ms;
  } else {
    answer.why_not = "stopped after " + std::to_string(static_cast<int>(limit_s)) + " s";
  }
  return answer;
}

Ours measure_ours(const SolidPair& pair, double budget_ms) {
  Ours ours;
  auto start = Clock::now();
  const Result<Mesh> p = Mesh::create(pair.p), q = Mesh::create(pair.q);
  ours.validate_ms = since(start);
  if (!p || !q) {
    ours.wrong = (p ? q : p).error().to_string();
    return ours;
  }
  ours.predicted = predict_cost(*p, *q);
  const RivalAnswer memory = measured_memory(*p, *q);
  ours.peak_bytes = memory.area, ours.result_bytes = memory.min_ms;
  SpatialSum one, two;
  double used = 0;
  for (int k = 0; k < 3 || (k < 50 && used < budget_ms); ++k) {
    for (const int threads : {1, 2}) {
      SpatialOptions options;
      options.threads = threads;
      start = Clock::now();
      Result<SpatialSum> sum = minkowski_sum(*p, *q, options);
      const double ms = since(start);
      (threads == 1 ? ours.ms : ours.two_threads_ms).push_back(ms);
      used += ms;
      if (!sum) {
        ours.wrong = sum.error().to_string();
        return ours;
      }
      (threads == 1 ? one : two) = *std::move(sum);
    }
    if (k == 0 && used > 4 * budget_ms) break;
  }
  if (!(one == two)) ours.wrong = "two threads differ";
  ours.stats = one.stats;
  ours.faces = one.faces.size();
  ours.tight = one.tight_faces.size() + one.tight_segments.size() + one.tight_points.size();
  start = Clock::now();
  if (const Result<SpatialSum::Rounded> rounded = one.rounded()) format_mesh(rounded->mesh, MeshFormat::off);
  ours.round_ms = since(start);
  // Over fans in doubles: exact fractions of many faces are long.
  const auto at = [&](std::uint32_t v) { return one.vertices[v]; };
  double six = 0;
  for (const SpatialFace& face : one.faces)
    for (const auto& loop : face.loops)
      for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        const Point3 a = at(loop[0]), b = at(loop[k]), c = at(loop[k + 1]);
        six += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
      }
  ours.volume = six / 6;
  return ours;
}

SolidRow measure_pair(const SolidPair& pair, const SolidProtocol& protocol) {
  SolidRow row{pair.name, pair.group, 0, 0, pair.published_ms, pair.limit_ms, {}, {}, {}, {}};
  row.ours = measure_ours(pair, protocol.budget_ms);
  if (!row.ours.wrong.empty()) return row;
  row.p_triangles = triangles_of(pair.p).faces.size(), row.q_triangles = triangles_of(pair.q).faces.size();
  if (protocol.limit_s > 0) {
    row.cgal = query_cgal(pair, protocol.limit_s);
    row.manifold = query_manifold(pair, true, protocol.limit_s);
    row.unguarded = query_manifold(pair, false, protocol.limit_s);
  }
  return row;
}

}  // namespace dymsum::bench

#include "solid/inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

#include "dymsum/mesh_io.h"
#include "dymsum/solids.h"

namespace dymsum::bench {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kBits = 22;

MeshData placed(MeshData mesh, Snapping snapping) {
  if (snapping == Snapping::raw) return mesh;
  for (Point3& p : mesh.vertices)
    for (double Point3::*c : {&Point3::x, &Point3::y, &Point3::z})
      p.*c = std::ldexp(std::nearbyint(std::ldexp(p.*c, kBits)), -kBits);
  return mesh;
}

/// The Mersenne Twister seeded and read as the recipe's author did (Python's random.Random): uniform doubles.
class Uniform {
 public:
  explicit Uniform(std::uint32_t seed) {
    state_[0] = 19650218u;
    for (std::uint32_t i = 1; i < kSize; ++i) state_[i] = 1812433253u * mixed(i) + i;
    std::uint32_t i = 1;
    const auto step = [&](std::uint32_t factor) { return state_[i] ^ (mixed(i) * factor); };
    const auto next = [&] {
      if (++i < kSize) return;
      state_[0] = state_[kSize - 1];
      i = 1;
    };
    for (std::uint32_t k = 0; k < kSize; ++k) state_[i] = step(1664525u) + seed, next();
    for (std::uint32_t k = 1; k < kSize; ++k) state_[i] = step(1566083941u) - i, next();
    state_[0] = 0x80000000u;
  }
  double operator()(double low, double high) {
    const double a = word() >> 5, b = word() >> 6;
    return low + (high - low) * ((a * 67108864.0 + b) / 9007199254740992.0);
  }

 private:
  static constexpr std::uint32_t kSize = 624;
  std::uint32_t mixed(std::uint32_t i) const { return state_[i - 1] ^ (state_[i - 1] >> 30); }
  std::uint32_t word() {
    if (at_ == kSize) {
      for (std::uint32_t k = 0; k < kSize; ++k) {
        const std::uint32_t y = (state_[k] & 0x80000000u) | (state_[(k + 1) % kSize] & 0x7fffffffu);
        state_[k] = state_[(k + 397) % kSize] ^ (y >> 1) ^ ((y & 1) != 0 ? 0x9908b0dfu : 0u);
      }
      at_ = 0;
    }
    std::uint32_t y = state_[at_++];
    y ^= y >> 11;
    y ^= (y << 7) & 0x9d2c5680u;
    y ^= (y << 15) & 0xefc60000u;
    return y ^ (y >> 18);
  }

  std::array<std::uint32_t, kSize> state_{};
  std::uint32_t at_ = kSize;
};

/// The boundary of a union of cells of a lattice, every exposed square a face.
MeshData cells(int nx, int ny, int nz, const std::function<bool(int, int, int)>& solid) {
  MeshData mesh;
  std::map<std::array<int, 3>, std::uint32_t> index;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [position, added] = index.emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (added)
      mesh.vertices.push_back({static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
    return position->second;
  };
  const auto filled = [&](const std::array<int, 3>& c) {
    return c[0] >= 0 && c[0] < nx && c[1] >= 0 && c[1] < ny && c[2] >= 0 && c[2] < nz && solid(c[0], c[1], c[2]);
  };
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> corner{x, y, z}, neighbour = corner;
            neighbour[axis] += side == 1 ? 1 : -1;
            if (!filled({x, y, z}) || filled(neighbour)) continue;
            corner[axis] += side;
            Face face;
            for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
              std::array<int, 3> at = corner;
              at[(axis + 1) % 3] += side == 1 ? u : v, at[(axis + 2) % 3] += side == 1 ? v : u;
              face.push_back(vertex(at));
            }
            mesh.faces.push_back(std::move(face));
          }
  return mesh;
}

std::string named(const std::string& name, Snapping c) { return (c == Snapping::raw ? "raw " : "") + name; }

SolidPair tori(int nu, int nv, Snapping c = Snapping::snapped) {
  const std::string n = std::to_string(2 * nu * nv);
  return {named("torus " + n + " + torus " + n, c), "tori", torus(2, 0.6, nu, nv, c),
          turned(torus(1.3, 0.35, nu, nv, c), 0.7, 0.4, 0.3, c)};
}

SolidPair blobs(int stacks, int slices, Snapping c = Snapping::snapped) {
  const std::string n = std::to_string(2 * slices * (stacks - 1));
  return {named("blob " + n + " + blob " + n, c), "blobs",
          turned(blob(1, 0.12, stacks, slices, 1, c), 0.3, 0.5, 0.2, c),
          turned(blob(0.6, 0.12, stacks, slices, 2, c), 0.1, 0.9, 0.4, c)};
}

MeshData ball(int stacks, int slices) { return blob(0.3, 0, stacks, slices, 0); }

SolidPair promised(SolidPair pair, double published, double limit) {
  pair.published_ms = published, pair.limit_ms = limit;
  return pair;
}

void add_real_pairs(const std::string& data, std::vector<SolidPair>& pairs) {
  const auto load = [&](const std::string& name) -> MeshData {
    const std::string path = data + "/solid/" + name;
    if (!std::filesystem::exists(path)) return {};
    const Result<MeshData> mesh = read_mesh(path);
    return mesh.ok() && Mesh::create(*mesh).ok() ? *mesh : MeshData{};
  };
  for (const auto& [p, q] : {std::pair{"bunny-348.obj", "bunny-128.off"},
                             {"bumpy-528.off", "bunny-128.off"},
                             {"gc_fox.off", "gc_bob_small.off"},
                             {"tm_plate_holes.off", "tm_tube.off"},
                             {"tm_mirror.off", "tm_7_8ths_cube.off"},
                             {"pr2_finger_tip_l.off", "franka_hand.off"}}) {
    MeshData a = load(p), b = load(q);
    if (!a.faces.empty() && !b.faces.empty())
      pairs.push_back({std::string(p) + " + " + q, "real", std::move(a), std::move(b)});
  }
}

}  // namespace

MeshData torus(double large, double small, int nu, int nv, Snapping snapping) {
  MeshData mesh;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = kTurn * i / nu, w = kTurn * j / nv, r = large + small * std::cos(w);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), small * std::sin(w)});
    }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>((i % nu) * nv + j % nv); };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      mesh.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return placed(std::move(mesh), snapping);
}

MeshData blob(double radius, double bump, int stacks, int slices, std::uint32_t seed, Snapping snapping) {
  struct Wave {
    double q[3], phase;
  };
  Uniform uniform(seed);
  std::vector<Wave> waves(12);
  for (Wave& wave : waves) {
    for (double& q : wave.q) q = uniform(-1, 1);
    wave.phase = uniform(0, 6.28);
  }
  MeshData mesh;
  const auto add = [&](double x, double y, double z) {
    double sum = 0;
    for (const Wave& w : waves) sum += std::sin(8 * (x * w.q[0] + y * w.q[1] + z * w.q[2]) + w.phase);
    const double r = radius * (1 + bump * sum / std::sqrt(12.0));
    mesh.vertices.push_back({r * x, r * y, r * z});
  };
  add(0, 0, 1);
  for (int i = 1; i < stacks; ++i)
    for (int j = 0; j < slices; ++j) {
      const double a = kTurn / 2 * i / stacks, b = kTurn * j / slices;
      add(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  add(0, 0, -1);
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(1 + (i - 1) * slices + j % slices); };
  for (int j = 0; j < slices; ++j) {
    mesh.faces.push_back({0, id(1, j), id(1, j + 1)});
    for (int i = 1; i + 1 < stacks; ++i) {
      mesh.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
    mesh.faces.push_back({bottom, id(stacks - 1, j + 1), id(stacks - 1, j)});
  }
  return placed(std::move(mesh), snapping);
}

MeshData turned(const MeshData& mesh, double x, double y, double z, Snapping snapping) {
  MeshData result = mesh;
  const auto turn = [](double& a, double& b, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), old = a;
    a = c * old - s * b, b = s * old + c * b;
  };
  for (Point3& p : result.vertices) turn(p.y, p.z, x), turn(p.z, p.x, y), turn(p.x, p.y, z);
  return placed(std::move(result), snapping);
}

MeshData grate(int bars) {
  const int n = 2 * bars + 1;
  return cells(n, n, 2, [](int x, int y, int z) { return (z == 0 ? x : y) % 2 == 0; });
}

MeshData comb(int teeth, bool upright) {
  const int n = 2 * teeth - 1, depth = 3;
  if (upright) return cells(1, n, depth, [](int, int y, int z) { return z == 0 || y % 2 == 0; });
  return cells(depth, n, 1, [](int x, int y, int) { return x == 0 || y % 2 == 0; });
}

MeshData gear(int teeth, double radius) {
  MeshData mesh;
  const int n = 4 * teeth;
  for (const double z : {-1.0, 1.0})
    for (int k = 0; k < n; ++k) {
      const double r = k % 4 < 2 ? radius : 0.8 * radius, a = kTurn * (k + (k % 2 == 0 ? 0.15 : -0.15)) / n;
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
    }
  Face top, bottom;
  for (int k = 0; k < n; ++k) {
    const auto a = static_cast<std::uint32_t>(k), b = static_cast<std::uint32_t>((k + 1) % n),
               m = static_cast<std::uint32_t>(n);
    top.push_back(m + a), bottom.insert(bottom.begin(), a);
    mesh.faces.push_back({a, b, m + b, m + a});
  }
  mesh.faces.push_back(std::move(top)), mesh.faces.push_back(std::move(bottom));
  return placed(std::move(mesh), Snapping::snapped);
}

MeshData cube(double half) {
  MeshData mesh = cells(1, 1, 1, [](int, int, int) { return true; });
  for (Point3& p : mesh.vertices) p = {half * (2 * p.x - 1), half * (2 * p.y - 1), half * (2 * p.z - 1)};
  return mesh;
}

MeshData ell() { return solids::prism({{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}}, 10).data(); }

MeshData tunnel() {
  MeshData mesh;
  for (const double x : {-5.0, 5.0})
    for (const double h : {5.0, 1.0})
      for (const auto& [y, z] : {std::pair{-h, -h}, {h, -h}, {h, h}, {-h, h}}) mesh.vertices.push_back({x, y, z});
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t j = (k + 1) % 4;
    mesh.faces.push_back({k, j, j + 8, k + 8});
    mesh.faces.push_back({4 + k, 12 + k, 12 + j, 4 + j});
    mesh.faces.push_back({8 + k, 8 + j, 12 + j, 12 + k});
    mesh.faces.push_back({k, 4 + k, 4 + j, j});
  }
  return mesh;
}

std::vector<SolidPair> solid_pairs(const std::string& data) {
  std::vector<SolidPair> pairs;
  for (const Snapping c : {Snapping::snapped, Snapping::raw}) {
    pairs.push_back(promised(tori(8, 6, c), 39, 36));
    pairs.push_back(promised(tori(16, 8, c), 130, 40));
    pairs.push_back(promised(tori(32, 16, c), 390, 100));
    pairs.push_back(promised(tori(64, 40, c), 2400, 0));
    pairs.push_back(promised(blobs(17, 32, c), 1260, 320));
    pairs.push_back(promised(blobs(37, 70, c), 11400, 2900));
  }
  const MeshData t96 = torus(2, 0.6, 8, 6), t1024 = torus(2, 0.6, 32, 16), t5120 = torus(2, 0.6, 64, 40);
  pairs.push_back({"torus 96 + ball 48", "balls", t96, ball(5, 6)});
  pairs.push_back({"torus 1024 + ball 224", "balls", t1024, ball(8, 16), 130, 32});
  pairs.push_back({"torus 5120 + ball 224", "balls", t5120, ball(8, 16)});
  pairs.push_back(
      {"blob 1024 + ball 224", "balls", turned(blob(1, 0.12, 17, 32, 1), 0.3, 0.5, 0.2), ball(8, 16), 370, 0});
  pairs.push_back({"L + cube", "flat", ell(), cube(0.25)});
  pairs.push_back({"L + L", "flat", ell(), ell()});
  pairs.push_back({"block + peg that fits", "flat", tunnel(), cube(1)});
  pairs.push_back({"block + thinner peg", "flat", tunnel(), cube(0.96875)});
  for (const int bars : {2, 4, 6, 8}) {
    const std::string name = "grate " + std::to_string(bars);
    pairs.push_back({name + " + " + name, "flat", grate(bars), grate(bars)});
  }
  pairs.push_back({"grate 8 + cube", "flat", grate(8), cube(0.25)});
  for (const int teeth : {4, 8, 16, 32}) {
    const std::string count = std::to_string(teeth);
    pairs.push_back({"comb " + count + " + upright comb " + count, "flat", comb(teeth, false), comb(teeth, true)});
  }
  pairs.push_back({"gear 12 + gear 9", "gears", gear(12, 4), gear(9, 3)});
  pairs.push_back({"gear 24 + turned gear 16", "gears", gear(24, 4), turned(gear(16, 2.5), 0, 0, 0.3)});
  add_real_pairs(data, pairs);
  return pairs;
}

SolidPair growth_pair(bool of_blobs, int triangles) {
  // The proportions of 1024 triangles: 32 x 16 around, 32 slices by 16 bands.
  const double side = std::sqrt(triangles / 1024.0);
  if (of_blobs) return blobs(static_cast<int>(std::lround(16 * side)) + 1, static_cast<int>(std::lround(32 * side)));
  return tori(static_cast<int>(std::lround(32 * side)), static_cast<int>(std::lround(16 * side)));
}

std::string set_coordinates(MeshData& p, MeshData& q, Kind kind) {
  if (!kind) return "";
  for (MeshData* const data : {&p, &q}) {
    const Result<Mesh> valid = Mesh::create(*data);
    if (!valid) return valid.error().to_string();
    const Result<Mesh> made = with_coordinates(*valid, kind);
    if (!made) return made.error().to_string();
    *data = made->data();
  }
  return "";
}

std::vector<SolidPair> with_coordinates(std::vector<SolidPair> pairs, Kind kind, std::vector<std::string>& notes) {
  std::erase_if(pairs, [&](SolidPair& pair) {
    if (kind && pair.name.starts_with("raw ")) return true;
    const std::string wrong = set_coordinates(pair.p, pair.q, kind);
    if (!wrong.empty()) notes.push_back(pair.name + ": left out: " + wrong);
    return !wrong.empty();
  });
  return pairs;
}

const SolidPair& pair_named(const std::vector<SolidPair>& pairs, std::string_view name) {
  const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const SolidPair& pair) { return pair.name == name; });
  if (found == pairs.end()) throw std::invalid_argument("there is no pair " + std::string(name));
  return *found;
}

}  // namespace dymsum::bench

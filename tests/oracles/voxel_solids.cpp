#include "oracles/voxel_solids.h"

#include <algorithm>
#include <map>
#include <vector>

namespace dymsum::oracles {

MeshData voxel_mesh(const Voxels& voxels, const IntegerMap& map) {
  MeshData mesh;
  std::map<Voxel, std::uint32_t> index;
  const auto vertex = [&](const Voxel& at) {
    const auto [position, added] = index.emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (added) {
      double v[3];
      for (int i = 0; i < 3; ++i) v[i] = map[i][0] * at[0] + map[i][1] * at[1] + map[i][2] * at[2];
      mesh.vertices.push_back({v[0], v[1], v[2]});
    }
    return position->second;
  };
  for (const Voxel& voxel : voxels) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        Voxel neighbour = voxel;
        neighbour[axis] += side == 1 ? 1 : -1;
        if (voxels.contains(neighbour)) continue;
        Voxel corner = voxel;
        corner[axis] += side;
        Face face;
        for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          Voxel at = corner;
          at[(axis + 1) % 3] += u, at[(axis + 2) % 3] += v;
          face.push_back(vertex(at));
        }
        if (side == 0) std::reverse(face.begin(), face.end());
        mesh.faces.push_back(std::move(face));
      }
    }
  }
  return mesh;
}

namespace {

/// Cells of the integer lattice by doubled coordinates: an odd one is an open unit interval, an even one a point.
class CellGrid {
 public:
  CellGrid(const Voxel& low, const Voxel& high) {
    for (int i = 0; i < 3; ++i) low_[i] = 2 * low[i] - 2, size_[i] = 2 * high[i] + 3 - low_[i];
    in_sum_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
    reached_.resize(in_sum_.size());
  }

  /// The open cube of size 2 at a voxel.
  void add(const Voxel& at) {
    for_box({2 * at[0] + 1, 2 * at[1] + 1, 2 * at[2] + 1}, {2 * at[0] + 3, 2 * at[1] + 3, 2 * at[2] + 3},
            [&](std::size_t k) { in_sum_[k] = true; });
  }

  /// Cells at which f holds.
  template <class F>
  void add_if(F f) {
    for_all([&](const Voxel& cell) {
      if (f(cell)) in_sum_[position(cell)] = true;
    });
  }

  /// Open cells of the sum, then cells outside of it that are in no closure of a larger one; or where it is `closed`
  /// those of the sum.
  VoxelSum count(bool closed = false) {
    VoxelSum sum;
    for (int dimension = 3; dimension >= 0; --dimension) {
      std::vector<Voxel> found;
      for_all([&](const Voxel& cell) {
        if (std::abs(cell[0] % 2) + std::abs(cell[1] % 2) + std::abs(cell[2] % 2) != dimension) return;
        if (in_sum_[position(cell)]) sum.volume += dimension == 3;
        if (in_sum_[position(cell)] == closed && (dimension == 3 || !reached_[position(cell)])) found.push_back(cell);
      });
      if (dimension == 2) sum.tight_faces = found.size();
      if (dimension == 1) sum.tight_edges = found.size();
      if (dimension == 0) sum.tight_points = found.size();
      for (const Voxel& cell : found) reach(cell);
    }
    return sum;
  }

 private:
  std::size_t position(const Voxel& c) const {
    return (static_cast<std::size_t>(c[0] - low_[0]) * size_[1] + static_cast<std::size_t>(c[1] - low_[1])) * size_[2] +
           static_cast<std::size_t>(c[2] - low_[2]);
  }
  template <class F>
  void for_box(const Voxel& low, const Voxel& high, F f) {
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int z = low[2]; z <= high[2]; ++z) f(position({x, y, z}));
  }
  /// All cells but the outermost ones.
  template <class F>
  void for_all(F f) const {
    for (int x = 1; x + 1 < size_[0]; ++x)
      for (int y = 1; y + 1 < size_[1]; ++y)
        for (int z = 1; z + 1 < size_[2]; ++z) f(Voxel{low_[0] + x, low_[1] + y, low_[2] + z});
  }
  void reach(const Voxel& c) {
    const auto half = [&](int i) { return std::abs(c[i] % 2); };
    for_box({c[0] - half(0), c[1] - half(1), c[2] - half(2)}, {c[0] + half(0), c[1] + half(1), c[2] + half(2)},
            [&](std::size_t k) { reached_[k] = true; });
  }

  Voxel low_{}, size_{};
  std::vector<bool> in_sum_, reached_;
};

}  // namespace

VoxelSum voxel_sum(const Voxels& p, const Voxels& q) {
  Voxel low{1 << 20, 1 << 20, 1 << 20}, high{-(1 << 20), -(1 << 20), -(1 << 20)};
  Voxels sums;
  for (const Voxel& a : p) {
    for (const Voxel& b : q) {
      const Voxel c{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
      sums.insert(c);
      for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], c[i]), high[i] = std::max(high[i], c[i] + 2);
    }
  }
  CellGrid grid(low, high);
  for (const Voxel& c : sums) grid.add(c);
  return grid.count();
}

MeshData lattice_mesh(const LatticeCells& cells, const IntegerMap& map) {
  Voxels cubes;
  for (const Voxel& c : cells)
    if (c[0] % 2 != 0 && c[1] % 2 != 0 && c[2] % 2 != 0) cubes.insert({(c[0] - 1) / 2, (c[1] - 1) / 2, (c[2] - 1) / 2});
  MeshData mesh = voxel_mesh(cubes);
  const auto vertex = [&](const Voxel& at) {
    const Point3 p{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    const auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
    if (found == mesh.vertices.end()) mesh.vertices.push_back(p);
    return static_cast<std::uint32_t>(std::find(mesh.vertices.begin(), mesh.vertices.end(), p) - mesh.vertices.begin());
  };
  for (const Voxel& c : cells) {
    std::vector<int> along;
    Voxel low{};
    for (int i = 0; i < 3; ++i) {
      const bool open = c[i] % 2 != 0;
      if (open) along.push_back(i);
      low[i] = (c[i] - (open ? 1 : 0)) / 2;
    }
    if (along.size() == 3) continue;
    Face face;
    const auto add = [&](int u, int v) {
      Voxel at = low;
      if (!along.empty()) at[along[0]] += u;
      if (along.size() == 2) at[along[1]] += v;
      face.push_back(vertex(at));
    };
    add(0, 0);
    if (!along.empty()) add(1, 0);
    if (along.size() == 2) add(1, 1), add(0, 1);
    mesh.faces.push_back(std::move(face));
  }
  for (Point3& p : mesh.vertices) {
    double v[3];
    for (int i = 0; i < 3; ++i) v[i] = map[i][0] * p.x + map[i][1] * p.y + map[i][2] * p.z;
    p = {v[0], v[1], v[2]};
  }
  return mesh;
}

namespace {

/// Lattice cells, open ones by odd coordinates, in the interior of the voxels' union.
LatticeCells interior_cells(const Voxels& voxels) {
  LatticeCells cells;
  for (const Voxel& v : voxels) {
    for (int corner = 0; corner < 27; ++corner) {
      const Voxel cell{2 * v[0] + corner % 3, 2 * v[1] + corner / 3 % 3, 2 * v[2] + corner / 9};
      bool inside = true;
      for (int side = 0; side < 8; ++side) {
        Voxel at{};
        for (int i = 0; i < 3; ++i) {
          const int c = cell[i], before = (side >> i) & 1;
          at[i] = c % 2 != 0 ? (c - 1) / 2 : c / 2 - before;
        }
        inside &= voxels.contains(at);
      }
      if (inside) cells.insert(cell);
    }
  }
  return cells;
}

/// Does x - Q, x the centre of a cell, meet open cells?
bool meet(const LatticeCells& inside, const LatticeCells& q, const Voxel& x) {
  for (const Voxel& b : q) {
    for (const Voxel& c : inside) {
      bool meets = true;
      for (int i = 0; i < 3; ++i) {
        // x - b is [from, to], the cell a point or an open interval
        const int half = std::abs(b[i] % 2), from = x[i] - b[i] - half, to = x[i] - b[i] + half;
        const int open = std::abs(c[i] % 2);
        meets &= open == 0 ? from <= c[i] && c[i] <= to : from < c[i] + 1 && to > c[i] - 1;
      }
      if (meets) return true;
    }
  }
  return false;
}

Voxels cubes_of(const LatticeCells& cells) {
  Voxels cubes;
  for (const Voxel& c : cells)
    if (c[0] % 2 != 0 && c[1] % 2 != 0 && c[2] % 2 != 0) cubes.insert({(c[0] - 1) / 2, (c[1] - 1) / 2, (c[2] - 1) / 2});
  return cubes;
}

/// Room for all sums of two cells.
CellGrid grid_of_sums(const LatticeCells& p, const LatticeCells& q) {
  Voxel low{1 << 20, 1 << 20, 1 << 20}, high{-(1 << 20), -(1 << 20), -(1 << 20)};
  for (const Voxel& a : p) {
    for (const Voxel& b : q) {
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], a[i] / 2 + b[i] / 2 - 1), high[i] = std::max(high[i], a[i] / 2 + b[i] / 2 + 3);
      }
    }
  }
  return CellGrid(low, high);
}

}  // namespace

VoxelSum lattice_sum(const Voxels& p, const LatticeCells& q) {
  LatticeCells cells;
  for (const Voxel& v : p) cells.insert({2 * v[0] + 1, 2 * v[1] + 1, 2 * v[2] + 1});
  const LatticeCells inside = interior_cells(p);
  CellGrid grid = grid_of_sums(cells, q);
  grid.add_if([&](const Voxel& x) { return meet(inside, q, x); });
  return grid.count();
}

VoxelSum lattice_sum_of_both(const LatticeCells& p, const LatticeCells& q) {
  const LatticeCells inside_p = interior_cells(cubes_of(p)), inside_q = interior_cells(cubes_of(q));
  CellGrid grid = grid_of_sums(p, q);
  grid.add_if([&](const Voxel& x) { return meet(inside_p, q, x) || meet(inside_q, p, x); });
  return grid.count();
}

bool closed_sum_holds(const LatticeCells& p, const LatticeCells& q, const Voxel& x) {
  for (const Voxel& a : p)
    for (const Voxel& b : q) {
      bool holds = true;
      for (int i = 0; i < 3; ++i)
        holds = holds && std::abs(x[i] - a[i] - b[i]) <= std::abs(a[i] % 2) + std::abs(b[i] % 2);
      if (holds) return true;
    }
  return false;
}

VoxelSum closed_lattice_sum(const LatticeCells& p, const LatticeCells& q) {
  CellGrid grid = grid_of_sums(p, q);
  grid.add_if([&](const Voxel& x) { return closed_sum_holds(p, q, x); });
  return grid.count(true);
}

std::size_t volume_of_sums(const LatticeCells& p, const LatticeCells& q) {
  Voxels cubes;
  for (const Voxel& a : p) {
    for (const Voxel& b : q) {
      Voxel low{}, size{};
      for (int i = 0; i < 3; ++i) {
        size[i] = std::abs(a[i] % 2) + std::abs(b[i] % 2);
        low[i] = (a[i] + b[i] - size[i]) / 2;
      }
      for (int x = 0; x < size[0]; ++x)
        for (int y = 0; y < size[1]; ++y)
          for (int z = 0; z < size[2]; ++z) cubes.insert({low[0] + x, low[1] + y, low[2] + z});
    }
  }
  return cubes.size();
}

std::array<Voxels, 2> random_voxels(int size, std::mt19937_64& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  const auto filled = [&](const Voxel& box) {
    Voxels voxels;
    const int fraction = 20 + below(75);
    while (voxels.empty()) {
      for (int x = 0; x < box[0]; ++x)
        for (int y = 0; y < box[1]; ++y)
          for (int z = 0; z < box[2]; ++z)
            if (below(100) < fraction) voxels.insert({x, y, z});
    }
    return voxels;
  };
  const auto box = [&] { return Voxel{1 + below(size), 1 + below(size), 1 + below(size)}; };
  const Voxel room = box();
  Voxels p = filled(room), q = filled(box());
  if (below(3) == 0) {
    // What the gaps of P in its box leave, reflected: it fits into them exactly.
    Voxels gaps;
    for (int x = 0; x < room[0]; ++x)
      for (int y = 0; y < room[1]; ++y)
        for (int z = 0; z < room[2]; ++z)
          if (!p.contains({x, y, z})) gaps.insert({-x, -y, -z});
    if (!gaps.empty()) q = gaps;
  }
  return {p, q};
}

}  // namespace dymsum::oracles

// Stand-ins for the polygons of Behar's figure 3.3: the originals' names, sizes and characters, drawn anew.
#include "thesis/thesis_shapes.h"

#include <cmath>
#include <utility>

#include "dymsum/shapes.h"
#include "planar/shapes/shapes.h"

namespace dymsum::shapes {
namespace {

/// Full doubles, as coordinates come from other programs: every coordinate times 1/3 has no finite binary expansion.
Ring full_doubles(Ring ring) { return scaled_ring(std::move(ring), 1.0 / 3); }

/// Seen from above; 25 points on the right and the nose.
Ring airplane() {
  return mirrored({{0, 11},     {0.5, 10.6}, {0.8, 9.9},  {0.95, 9},    {1, 8},      {1, 4.2},    {3.1, 2.9},
                   {3.1, 3.6},  {3.3, 3.8},  {3.7, 3.8},  {3.9, 3.6},   {3.9, 2.4},  {8.8, -0.6}, {9.4, -1.1},
                   {9.6, -1.8}, {9.4, -1.9}, {8.8, -1.5}, {3.9, 0.1},   {1, 0.3},    {0.9, -3},   {0.6, -6.2},
                   {3.4, -7.9}, {3.5, -8.8}, {0.4, -7.9}, {0.25, -9.1}, {0.12, -9.2}});
}

/// A zigzag of feathers from `from` to `to`: each has its root, its two sides and its tip on the left of the way.
void feathers(Ring& ring, Point from, Point to, int count, double length, double lean) {
  const double dx = (to.x - from.x) / count, dy = (to.y - from.y) / count;
  const double size = std::sqrt(dx * dx + dy * dy);
  for (int i = 0; i < count; ++i) {
    // Longest in the middle of the row.
    const double along = (i + 0.5) / count, reach = length * (0.45 + 2.2 * along * (1 - along)) / size;
    const double ox = -dy * reach, oy = dx * reach;  // outward
    const auto at = [&](double fraction, double out) {
      return Point{from.x + (i + fraction) * dx + out * (ox + lean * oy),
                   from.y + (i + fraction) * dy + out * (oy - lean * ox)};
    };
    ring.push_back(at(0.0, 0));
    ring.push_back(at(0.1, 0.72));
    ring.push_back(at(0.42, 1));
    ring.push_back(at(0.78, 0.66));
  }
}

/// Seen from above with spread wings, feather by feather; 137 points on each side and the beak.
Ring bird() {
  // The right half from the beak down; the ring is turned round at the end.
  Ring half{{0, 9.4}};
  const Ring head{{0.16, 8.9}, {0.3, 8.45}, {0.62, 8.2},  {0.86, 7.8}, {0.98, 7.3}, {0.94, 6.8},
                  {0.8, 6.35}, {0.78, 5.9}, {0.95, 5.45}, {1.3, 5.1},  {1.75, 4.9}, {2.25, 4.85}};
  half.insert(half.end(), head.begin(), head.end());
  // Leading edge: out to the wrist, then back to the wing tip.
  const Ring edge{{2.9, 5.0},  {3.5, 5.25},  {4.1, 5.6},    {4.65, 5.95}, {5.2, 6.25},  {5.75, 6.45}, {6.3, 6.5},
                  {6.85, 6.4}, {7.4, 6.15},  {7.9, 5.8},    {8.4, 5.4},   {8.9, 4.95},  {9.35, 4.45}, {9.8, 3.9},
                  {10.2, 3.3}, {10.55, 2.7}, {10.85, 2.05}, {11.1, 1.4},  {11.25, 0.8}, {11.3, 0.3}};
  half.insert(half.end(), edge.begin(), edge.end());
  feathers(half, {11.05, 0.25}, {6.4, 1.5}, 11, 2.6, -0.45);
  feathers(half, {6.4, 1.5}, {1.5, 0.7}, 10, 2.0, -0.1);
  const Ring flank{{1.5, 0.7}, {1.38, -0.4}, {1.15, -1.5}, {0.9, -2.6}, {0.75, -3.6}};
  half.insert(half.end(), flank.begin(), flank.end());
  feathers(half, {2.0, -4.7}, {0.04, -5.2}, 4, 3.0, -0.1);
  return counter_clockwise(mirrored(half));
}

Ring blob() {
  return smooth({{0, 0}, {3, -1.4}, {5.2, 0.2}, {4.2, 2.4}, {5.6, 4.6}, {3.2, 6}, {1.4, 4.2}, {-1.4, 4.8}, {-2.2, 2}},
                18);
}

/// From the side, walking to the right.
Ring dog() {
  return smooth(
      {{0, 0},      {0.9, 0.1},   {0.7, 1.6},   {1.5, 3.4},   {2.3, 4.1},  {2.4, 2.2},   {1.9, 0.1},   {3.1, 0},
       {3.3, 2.3},  {4.1, 4.3},   {7.6, 4.1},   {9.6, 4.4},   {9.2, 2.4},  {8.6, 0.1},   {9.8, 0},     {10.3, 2.2},
       {10.9, 3.8}, {11.6, 2.0},  {11.5, 0.1},  {12.6, 0},    {12.6, 2.4}, {12.4, 4.6},  {13.1, 6.5},  {14.1, 7.9},
       {15.4, 7.6}, {16.9, 7.7},  {17.4, 8.3},  {17.1, 8.9},  {15.9, 9.6}, {15.2, 10.9}, {13.9, 11.4}, {13.2, 11.1},
       {12.7, 12},  {12.1, 11},   {11.9, 8.9},  {11.2, 8.3},  {9.2, 8.1},  {5.4, 8.2},   {2.6, 8.0},   {1.3, 8.4},
       {0.2, 10.2}, {-0.9, 11.6}, {-1.5, 11.4}, {-0.9, 10.2}, {-0.2, 8.4}, {0.3, 6.6},   {-0.1, 4.4},  {-0.6, 2.2}},
      145);
}

/// An open hand: five fingers apart.
Ring hand1() {
  return smooth(
      {{0, 0},      {3.6, 0},    {4.0, 2.6},  {5.2, 3.8},  {7.3, 5.1},  {8.0, 6.2},   {7.1, 6.5},  {5.3, 5.7},
       {4.3, 5.9},  {5.3, 9.2},  {5.5, 11.2}, {4.7, 11.5}, {4.0, 9.6},  {3.1, 7.2},   {3.0, 10.2}, {2.8, 12.5},
       {1.9, 12.5}, {1.7, 10.2}, {1.7, 7.2},  {0.8, 9.7},  {0.0, 11.6}, {-0.8, 11.2}, {-0.4, 9.0}, {0.4, 6.5},
       {-1.1, 8.0}, {-2.3, 9.0}, {-2.8, 8.3}, {-1.9, 6.9}, {-0.6, 4.4}, {-0.5, 2.0}},
      57);
}

/// A pointing hand: one finger out, the others curled.
Ring hand2() {
  return smooth(
      {{-6, 0.2},    {-2.4, 0},   {-1.6, -0.9}, {0.2, -1.5}, {2.4, -1.7}, {3.2, -1.2}, {3.1, -0.5}, {2.2, -0.3},
       {1.6, -0.15}, {2.6, -0.1}, {3.7, 0.1},   {4.0, 0.7},  {3.6, 1.2},  {2.3, 1.15}, {1.9, 1.3},  {3.0, 1.4},
       {3.9, 1.7},   {4.1, 2.3},  {3.5, 2.7},   {2.2, 2.6},  {2.0, 2.85}, {4.4, 3.0},  {7.6, 3.1},  {8.9, 3.4},
       {9.1, 3.9},   {8.5, 4.3},  {5.2, 4.4},   {2.6, 4.5},  {1.7, 4.9},  {1.5, 6.3},  {2.0, 7.5},  {1.7, 8.2},
       {1.0, 8.1},   {0.3, 6.9},  {-0.3, 5.1},  {-1.7, 4.1}, {-3.0, 3.7}, {-6, 3.6}},
      84);
}

/// A letter G: an open ring of `samples` chords outside and inside, its bar turned inwards.
Ring letter_g(int samples, double outer, double inner, const Ring& bar) {
  Ring ring;
  // From an eighth of a turn round to the bar at nearly a full turn.
  const auto around = [samples](int k) { return circle_point(8 + 54 * k / samples, 64); };
  for (int k = 0; k <= samples; ++k) ring.push_back({outer * around(k).x, outer * around(k).y});
  ring.insert(ring.end(), bar.begin(), bar.end());
  for (int k = samples; k >= 0; --k) ring.push_back({inner * around(k).x, inner * around(k).y});
  return ring;
}

/// A sewing machine: base, column, arm, head.
Ring sewing() {
  return {{0, 0}, {10, 0}, {10, 7.5}, {0, 7.5}, {0, 4}, {1.5, 3.5}, {2, 5.5}, {7.5, 5.5}, {7.5, 1.5}, {0, 1.5}};
}

}  // namespace

std::vector<Named> thesis_like_set() {
  const auto plain = [](std::string_view name, Ring ring) {
    return Named{name, made(name, on_grid(counter_clockwise(std::move(ring)), 10))};
  };
  const auto full = [](std::string_view name, Ring ring) {
    return Named{name, made(name, full_doubles(counter_clockwise(std::move(ring))))};
  };
  std::vector<Named> set;
  set.push_back(plain("airplane", airplane()));
  set.push_back(plain("bar", {{0, 0}, {9, 0}, {9, 1}, {0, 1}}));
  set.push_back(full("bird", scaled_ring(bird(), 3)));
  set.push_back(plain("blob", blob()));
  set.push_back(full("dog", scaled_ring(dog(), 4)));
  set.push_back(plain("G1", letter_g(12, 5, 3.4, {{4.9, 0.7}, {1.6, 0.7}, {1.6, -0.7}, {3.2, -0.7}})));
  set.push_back(full("G2", scaled_ring(letter_g(14, 6, 5, {{5.8, 0.4}, {2.8, 0.4}, {2.8, -0.4}, {4.8, -0.4}}), 3)));
  set.push_back(plain("G3", letter_g(9, 4, 1.8, {{4.6, 0.6}, {1.2, 0.6}, {1.2, -0.5}, {1.5, -0.5}})));
  set.push_back(plain("G4", letter_g(18, 7, 5.2, {{6.8, 1}, {8, 1}, {8, 1.8}, {3, 1.8}, {3, 0.2}})));
  set.push_back(plain("hand1", hand1()));
  set.push_back(full("hand2", scaled_ring(hand2(), 3)));
  set.push_back(plain("insignia", {{0, 0}, {3, -2}, {0, 6}, {-3, -2}}));
  set.push_back(plain("sewing", sewing()));
  set.push_back(
      plain("fence", {{0, 0}, {9, 0}, {9, 4}, {8, 6}, {6.5, 3.5}, {5.5, 6}, {4, 3.5}, {3, 6}, {1.5, 3.5}, {0.5, 6}}));
  set.push_back(Named{"pentagon", disc(5, 4, demo_snap(4))});
  set.push_back(Named{"star", star(22, 3.2, 6.9, demo_snap(6.9))});
  set.push_back(Named{"U", letter_u(6, 7, 1.5)});
  return set;
}

}  // namespace dymsum::shapes

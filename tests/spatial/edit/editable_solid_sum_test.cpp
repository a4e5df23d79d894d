// Edited solids: what each edit makes, what is refused, and sums that equal fresh ones after any steps, undone and made
// again.
#include "dymsum/editable_solid_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "dymsum/names.h"
#include "dymsum/solids.h"
#include "oracles/random.h"

namespace dymsum {
namespace {

using Kind = SolidEditKind;
constexpr MovingOperand kP = MovingOperand::p, kQ = MovingOperand::q;

Mesh unit_box() { return solids::box(0, 0, 0, 1, 1, 1); }

EditableSolidSum boxes(const SolidEditOptions& options = {}) {
  return EditableSolidSum::create(unit_box(), solids::box(0, 0, 0, 2, 2, 2), options).value();
}

std::uint32_t vertex_at(const Mesh& mesh, const Point3& at) {
  const auto found = std::find(mesh.vertices().begin(), mesh.vertices().end(), at);
  EXPECT_NE(found, mesh.vertices().end());
  return static_cast<std::uint32_t>(found - mesh.vertices().begin());
}

/// The face all of whose vertices have this height.
std::uint32_t face_at_height(const Mesh& mesh, double z) {
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f)
    if (std::all_of(mesh.faces()[f].begin(), mesh.faces()[f].end(),
                    [&](std::uint32_t v) { return mesh.vertices()[v].z == z; }))
      return f;
  ADD_FAILURE() << "no face at height " << z;
  return 0;
}

/// Everything that an edit could change.
struct Snapshot {
  std::array<MeshData, 2> data;
  std::array<std::vector<std::uint64_t>, 6> names;
  SpatialSum sum;
  std::uint64_t hash = 0;
  std::size_t undo = 0, redo = 0;
};

Snapshot snapshot(const EditableSolidSum& sum) {
  return {{sum.p().data(), sum.q().data()},
          {sum.vertex_names(kP), sum.vertex_names(kQ), sum.face_names(kP), sum.face_names(kQ), sum.face_ancestors(kP),
           sum.face_ancestors(kQ)},
          sum.sum(),
          sum.hash(),
          sum.undo_count(),
          sum.redo_count()};
}

/// But for the counts of steps.
void expect_state(const EditableSolidSum& sum, const Snapshot& was) {
  const Snapshot is = snapshot(sum);
  ASSERT_EQ(is.data, was.data);
  ASSERT_EQ(is.names, was.names);
  ASSERT_TRUE(is.sum == was.sum);
  ASSERT_EQ(is.sum.vertex_contacts, was.sum.vertex_contacts);
  ASSERT_EQ(is.hash, was.hash);
}

TEST(EditableSolidSum, an_extruded_top_makes_a_taller_box) {
  EditableSolidSum sum = boxes();
  const std::uint32_t top = face_at_height(sum.p(), 1);
  const std::uint64_t name = sum.face_names(kP)[top], ancestor = sum.face_ancestors(kP)[top];
  const SolidEditWork work = sum.edit(SolidEdit::extrude(kP, {top}, {0, 0, 0.5})).value();
  EXPECT_TRUE(sum.p() == solids::box(0, 0, 0, 1, 1, 1.5));
  EXPECT_EQ(sum.p().faces().size(), 10u);
  EXPECT_EQ(sum.p().vertices().size(), 12u);
  EXPECT_EQ(work.vertices_edited, 4u);
  EXPECT_EQ(work.faces_edited, 5u);
  EXPECT_FALSE(work.kept);
  EXPECT_EQ(sum.sum().volume(), 3 * 3 * 3.5);
  EXPECT_EQ(sum.face_names(kP)[top], name);
  for (std::size_t f = 6; f < 10; ++f) EXPECT_EQ(sum.face_ancestors(kP)[f], ancestor);
}

TEST(EditableSolidSum, faces_that_move_inwards_make_a_dent) {
  EditableSolidSum sum = EditableSolidSum::create(solids::tessellated_cube(4, 4), unit_box()).value();
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < sum.p().faces().size(); ++f) {
    const Face& face = sum.p().faces()[f];
    if (std::all_of(face.begin(), face.end(), [&](std::uint32_t v) {
          const Point3& at = sum.p().vertices()[v];
          return at.z == 2 && std::abs(at.x) <= 1 && std::abs(at.y) <= 1;
        }))
      faces.push_back(f);
  }
  ASSERT_EQ(faces.size(), 8u);
  ASSERT_TRUE(sum.edit(SolidEdit::extrude(kP, faces, {0, 0, -1})));
  EXPECT_EQ(volume(sum.p()), 64 - 4);
  ASSERT_TRUE(sum.edit(SolidEdit::extrude(kQ, {face_at_height(sum.q(), 1)}, {0, 0, 1})));
  EXPECT_EQ(sum.sum().volume(), 5 * 5 * 6 - 1);  // what is left of the dent is 2 - 1 wide, both ways, and 1 deep
  EXPECT_TRUE(sum.sum() == minkowski_sum(sum.p(), sum.q()).value());
}

TEST(EditableSolidSum, a_vertex_put_in_and_taken_out_leaves_what_was) {
  EditableSolidSum sum = boxes();
  const MeshData before = sum.p().data();
  const std::uint32_t top = face_at_height(sum.p(), 1);
  ASSERT_TRUE(sum.edit(SolidEdit::insert_in_face(kP, top, {0.5, 0.5, 2})));
  EXPECT_EQ(sum.p().faces().size(), 9u);
  EXPECT_EQ(volume(sum.p()), 1 + 1.0 / 3);
  ASSERT_TRUE(sum.edit(SolidEdit::remove(kP, 8)));
  EXPECT_TRUE(sum.p() == unit_box());
  EXPECT_EQ(sum.p().faces().size(), 6u);
  const std::uint32_t a = vertex_at(sum.p(), {0, 0, 0}), b = vertex_at(sum.p(), {1, 0, 0});
  ASSERT_TRUE(sum.edit(SolidEdit::insert_in_edge(kP, a, b, {0.25, 0, 0})));
  EXPECT_EQ(sum.p().faces().size(), 6u);  // it lies in both planes: they stay whole
  EXPECT_TRUE(sum.p() == unit_box());
  ASSERT_TRUE(sum.edit(SolidEdit::remove(kP, 8)));
  EXPECT_EQ(sum.p().vertices(), before.vertices);
  ASSERT_TRUE(sum.edit(SolidEdit::insert_in_edge(kP, a, b, {0.5, -1, -1})));
  EXPECT_EQ(sum.p().faces().size(), 4u + 6u);
  EXPECT_TRUE(sum.sum() == minkowski_sum(sum.p(), sum.q()).value());
}

TEST(EditableSolidSum, a_corner_that_is_taken_out_is_filled) {
  EditableSolidSum sum = boxes();
  const std::uint32_t corner = vertex_at(sum.p(), {1, 1, 1});
  ASSERT_TRUE(sum.edit(SolidEdit::remove(kP, corner)));
  EXPECT_EQ(sum.p().vertices().size(), 7u);
  EXPECT_LT(volume(sum.p()), 1);
  EXPECT_TRUE(sum.sum() == minkowski_sum(sum.p(), sum.q()).value());
}

TEST(EditableSolidSum, an_inverted_edge_takes_the_other_diagonal_and_back) {
  EditableSolidSum sum = EditableSolidSum::create(solids::dipyramid(4, 1, 2), unit_box()).value();
  const MeshData before = sum.p().data();
  const double was = volume(sum.p());
  const Face& face = sum.p().faces()[0];
  std::uint32_t a = face[0], b = face[1], c = face[2];
  const auto beyond = std::find_if(sum.p().faces().begin() + 1, sum.p().faces().end(), [&](const Face& other) {
    return std::count(other.begin(), other.end(), a) == 1 && std::count(other.begin(), other.end(), b) == 1;
  });
  std::uint32_t d = 0;
  for (const std::uint32_t v : *beyond)
    if (v != a && v != b) d = v;
  const std::vector<std::uint64_t> names = sum.face_names(kP);
  ASSERT_TRUE(sum.edit(SolidEdit::invert(kP, a, b)));
  EXPECT_LT(volume(sum.p()), was);
  EXPECT_EQ(sum.face_names(kP), names);
  EXPECT_TRUE(sum.sum() == minkowski_sum(sum.p(), sum.q()).value());
  ASSERT_TRUE(sum.edit(SolidEdit::invert(kP, c, d)));
  EXPECT_EQ(volume(sum.p()), was);
  EXPECT_TRUE(sum.p() == Mesh::create(before).value());
}

TEST(EditableSolidSum, shells_come_and_go) {
  EditableSolidSum sum = EditableSolidSum::create(solids::box(0, 0, 0, 4, 4, 4), unit_box()).value();
  MeshData cavity = solids::box(1, 1, 1, 3, 3, 3).data();
  for (Face& face : cavity.faces) std::reverse(face.begin(), face.end());
  const std::array both{SolidEdit::add_shell(kP, cavity),
                        SolidEdit::add_shell(kP, solids::box(9, 0, 0, 10, 1, 1).data())};
  ASSERT_TRUE(sum.edit(both));
  EXPECT_EQ(sum.p().shell_count(), 3u);
  EXPECT_EQ(sum.sum().volume(), 125 - 1 + 8);
  const std::uint64_t first = sum.vertex_names(kP)[16];
  ASSERT_TRUE(sum.edit(SolidEdit::remove_shell(kP, 7)));
  EXPECT_EQ(sum.p().shell_count(), 2u);
  EXPECT_EQ(sum.vertex_names(kP)[8], first);
  EXPECT_EQ(sum.sum().volume(), 125 + 8);
  ASSERT_TRUE(sum.edit(SolidEdit::remove_shell(kQ, 0)));
  EXPECT_TRUE(sum.sum().faces.empty());
  ASSERT_TRUE(sum.undo());
  EXPECT_TRUE(sum.work().kept);
  EXPECT_EQ(sum.sum().volume(), 125 + 8);
}

TEST(EditableSolidSum, what_is_refused_changes_nothing_and_has_its_evidence) {
  EditableSolidSum sum = EditableSolidSum::create(solids::tessellated_cube(2, 1), unit_box()).value();
  ASSERT_TRUE(sum.edit(SolidEdit::insert_in_face(kQ, 0, {0.25, 0.25, -1})));
  ASSERT_TRUE(sum.edit(SolidEdit::move(kP, 0, {-1.25, -1, -1})));
  ASSERT_TRUE(sum.undo());
  const Snapshot before = snapshot(sum);
  const std::uint32_t near = vertex_at(sum.p(), {1, 1, 1});
  const auto refused = [&](const std::vector<SolidEdit>& edits, ErrorCode code) {
    const auto made = sum.edit(edits);
    EXPECT_FALSE(made.ok()) << name(edits.back().kind);
    expect_state(sum, before);
    EXPECT_EQ(sum.undo_count(), 1u);
    EXPECT_EQ(sum.redo_count(), 1u);
    if (made.ok()) return Error{};
    EXPECT_EQ(made.error().code, code) << made.error().to_string();
    return made.error();
  };
  refused({SolidEdit::move(kP, 99, {})}, ErrorCode::out_of_range);
  refused({SolidEdit::remove(kQ, 99)}, ErrorCode::out_of_range);
  refused({SolidEdit::insert_in_face(kP, 99, {})}, ErrorCode::out_of_range);
  refused({SolidEdit::remove_shell(kP, 99)}, ErrorCode::out_of_range);
  refused({SolidEdit::invert(kP, 0, 99)}, ErrorCode::out_of_range);
  refused({SolidEdit::insert_in_edge(kP, 0, 0, {})}, ErrorCode::out_of_range);
  refused({SolidEdit::extrude(kP, {}, {0, 0, 1})}, ErrorCode::out_of_range);
  refused({SolidEdit::extrude(kP, {99}, {0, 0, 1})}, ErrorCode::out_of_range);
  refused({SolidEdit::extrude(kP, {1, 1}, {0, 0, 1})}, ErrorCode::out_of_range);
  refused({SolidEdit::add_shell(kP, {})}, ErrorCode::out_of_range);
  refused({SolidEdit::add_shell(kP, {{{9, 9, 9}}, {{0, 1, 2}}})}, ErrorCode::bad_index);
  refused({SolidEdit::move(kP, near, {NAN, 0, 0})}, ErrorCode::not_finite);
  refused({SolidEdit::extrude(kP, {0}, {0, 0, 0})}, ErrorCode::repeated_vertex);
  const Error same =
      refused({SolidEdit::move(kP, near, sum.p().vertices()[near == 0 ? 1 : 0])}, ErrorCode::repeated_vertex);
  EXPECT_TRUE(same.evidence.vertex && same.evidence.other_vertex);
  const Error crossing = refused({SolidEdit::move(kP, near, {0.5, 0.5, -1.5})}, ErrorCode::faces_cross);
  EXPECT_TRUE(crossing.evidence.face && crossing.evidence.other_face && crossing.evidence.x);
  const Error bent = refused({SolidEdit::move(kQ, vertex_at(sum.q(), {1, 1, 1}), {2, 1, 1})}, ErrorCode::not_planar);
  EXPECT_TRUE(bent.evidence.face);
  const Error apart =
      refused({SolidEdit::extrude(kP,
                                  {0,
                                   [&] {
                                     for (std::uint32_t f = 1; f < sum.p().faces().size(); ++f) {
                                       const Face &a = sum.p().faces()[0], &b = sum.p().faces()[f];
                                       if (std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) == a.end())
                                         return f;
                                     }
                                     return 1u;
                                   }()},
                                  {0, 0, 1})},
              ErrorCode::out_of_range);
  EXPECT_EQ(apart.evidence.face, 0);
  EXPECT_TRUE(apart.evidence.other_face);
  const Face quad = sum.q().faces()[0];
  const Error no_triangle = refused({SolidEdit::invert(kQ, quad[0], quad[1])}, ErrorCode::out_of_range);
  EXPECT_TRUE(no_triangle.evidence.face && no_triangle.evidence.other_vertex);
  // A tetrahedron with a corner fewer is flat; and one edit that is right does not save the other.
  const std::vector<SolidEdit> flat{SolidEdit::add_shell(kP, solids::pyramid(3, 1, 1).data()),
                                    SolidEdit::remove(kP, static_cast<std::uint32_t>(sum.p().vertices().size()))};
  EXPECT_FALSE(sum.edit(flat).ok());
  expect_state(sum, before);
  SolidEditOptions options;
  options.threads = -1;
  EXPECT_EQ(EditableSolidSum::create(sum.p(), sum.q(), options).error().code, ErrorCode::out_of_range);
  const Mesh thin = Mesh::with_thin_parts({{{0, 0, 0}, {1, 0, 0}}, {{0, 1}}}).value();
  EXPECT_EQ(EditableSolidSum::create(sum.p(), thin).error().code, ErrorCode::unsupported_operand);
}

TEST(EditableSolidSum, a_step_without_edits_is_none) {
  EditableSolidSum sum = boxes();
  ASSERT_TRUE(sum.edit(SolidEdit::extrude(kP, {face_at_height(sum.p(), 1)}, {0, 0, 0.5})).ok());
  ASSERT_TRUE(sum.undo().ok());
  ASSERT_TRUE(sum.edit(std::span<const SolidEdit>()).ok());
  EXPECT_EQ(sum.undo_count(), 0u);
  EXPECT_EQ(sum.redo_count(), 1u);
  ASSERT_TRUE(sum.redo().ok());
  EXPECT_EQ(sum.sum().volume(), 3 * 3 * 3.5);
}

TEST(EditableSolidSum, a_cancelled_step_changes_nothing) {
  bool stop = false;
  SolidEditOptions options;
  options.progress = [&](std::string_view, double) { return !stop; };
  options.kept_sums = 0;
  EditableSolidSum sum = boxes(options);
  ASSERT_TRUE(sum.edit(SolidEdit::extrude(kP, {0}, {0, 0, -1})));
  const Snapshot before = snapshot(sum);
  stop = true;
  EXPECT_EQ(sum.edit(SolidEdit::extrude(kP, {0}, {0, 0, -1})).error().code, ErrorCode::cancelled);
  EXPECT_EQ(sum.undo().error().code, ErrorCode::cancelled);
  expect_state(sum, before);
  EXPECT_EQ(sum.undo_count(), 1u);
  stop = false;
  ASSERT_TRUE(sum.undo());
  EXPECT_FALSE(sum.work().kept);
  EXPECT_EQ(sum.redo_count(), 1u);
}

TEST(EditableSolidSum, so_many_steps_and_sums_are_kept) {
  SolidEditOptions options;
  options.undo_steps = 4, options.kept_sums = 2;
  EditableSolidSum sum = boxes(options);
  for (int k = 0; k < 6; ++k)
    ASSERT_TRUE(sum.edit(SolidEdit::extrude(kP, {face_at_height(sum.p(), 1 + k)}, {0, 0, 1})));
  EXPECT_EQ(sum.undo_count(), 4u);
  std::vector<bool> kept;
  while (sum.undo()) kept.push_back(sum.work().kept);
  EXPECT_EQ(kept, (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(sum.sum().volume(), 3 * 3 * 5);
  EXPECT_EQ(sum.undo().error().code, ErrorCode::out_of_range);
  kept.clear();
  while (sum.redo()) kept.push_back(sum.work().kept);
  EXPECT_EQ(kept, (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(sum.redo().error().code, ErrorCode::out_of_range);
}

// Random edits.

int solid_rounds(int few) {
  const char* many = std::getenv("DYMSUM_SOLID_EDIT_ROUNDS");
  return many != nullptr ? std::atoi(many) : few;
}

/// Coordinates as users have them: on a grid, turned by 30 degrees, decimals, single precision, with noise.
Mesh with_coordinates(const Mesh& mesh, int kind, oracles::Random& random) {
  MeshData data = mesh.data();
  for (Point3& v : data.vertices) {
    const double c = std::cos(std::numbers::pi / 6), s = 0.5;
    if (kind == 1) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    for (double* x : {&v.x, &v.y, &v.z}) {
      if (kind == 2) *x = std::round(*x * 1000) / 1000;
      if (kind == 3) *x = static_cast<float>(*x * 1.1);
      if (kind == 4) *x += random.signed_unit() * 0x1p-40;
    }
  }
  return Mesh::create(data).value();
}

Point3 random_position(oracles::Random& random, int kind, double size) {
  const auto one = [&] {
    const double x = size * random.signed_unit();
    return kind == 0 ? std::round(x * 8) / 8 : kind == 2 ? std::round(x * 1000) / 1000 : kind == 3 ? float(x) : x;
  };
  const double x = one(), y = one();
  return {x, y, one()};
}

SolidEdit random_solid_edit(const EditableSolidSum& sum, oracles::Random& random, int coordinates) {
  const MovingOperand op = random.chance(70) ? kP : kQ;
  const Mesh& mesh = op == kP ? sum.p() : sum.q();
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random.below(static_cast<int>(n))); };
  if (mesh.empty()) return SolidEdit::add_shell(op, unit_box().data());
  const std::uint32_t vertex = below(mesh.vertices().size()), face = below(mesh.faces().size());
  const Point3 near = mesh.vertices()[vertex], by = random_position(random, coordinates, 0.5);
  const Point3 at{near.x + by.x, near.y + by.y, near.z + by.z};
  const std::size_t corner = below(mesh.faces()[face].size());
  const std::uint32_t from = mesh.faces()[face][corner],
                      to = mesh.faces()[face][(corner + 1) % mesh.faces()[face].size()];
  const Point3 &a = mesh.vertices()[from], &b = mesh.vertices()[to];
  const Point3 between{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
  const bool exactly = random.chance(40);
  switch (static_cast<Kind>(random.below(20) < 8 ? 0 : random.below(8))) {
    case Kind::move:
      return SolidEdit::move(op, vertex, at);
    case Kind::extrude: {
      std::set<std::uint32_t> faces{face};
      for (std::uint32_t f = 0; f < mesh.faces().size() && faces.size() < 3; ++f) {
        const Face& other = mesh.faces()[f];
        if (std::count(other.begin(), other.end(), from) + std::count(other.begin(), other.end(), to) == 2)
          faces.insert(f);
      }
      return SolidEdit::extrude(op, {faces.begin(), faces.end()}, by);
    }
    case Kind::invert:
      return SolidEdit::invert(op, from, to);
    case Kind::insert_in_face:
      return SolidEdit::insert_in_face(op, face, exactly ? between : at);
    case Kind::insert_in_edge:
      return SolidEdit::insert_in_edge(
          op, from, to, exactly ? between : Point3{between.x + by.x, between.y + by.y, between.z + by.z});
    case Kind::remove:
      return SolidEdit::remove(op, vertex);
    case Kind::add_shell: {
      MeshData shell = with_coordinates(solids::pyramid(3, 0.5, 0.5), coordinates, random).data();
      const Point3 move = random_position(random, coordinates, 3);
      for (Point3& v : shell.vertices) v = {v.x + move.x, v.y + move.y, v.z + move.z};
      return SolidEdit::add_shell(op, shell);
    }
    default:
      return SolidEdit::remove_shell(op, face);
  }
}

Mesh random_solid(oracles::Random& random) {
  switch (random.below(5)) {
    case 0:
      return solids::tessellated_cube(2, 1, solids::kDemoSnap);
    case 1:
      return solids::dipyramid(5, 1, 2, solids::kDemoSnap);
    case 2:
      return solids::geodesic_sphere(1, 1, 0x1p-4);
    case 3:
      return solids::pyramid(3, 1, 1, 0x1p-4);
    default:
      return solids::cylinder(5, 1, 1, 0x1p-6);
  }
}

void expect_right(const EditableSolidSum& sum, const SolidEditOptions& options) {
  SpatialOptions fresh;
  fresh.semantics = options.semantics, fresh.tight = options.tight, fresh.threads = 1;
  const SpatialSum scratch = minkowski_sum(sum.p(), options.reflect_q ? negated(sum.q()) : sum.q(), fresh).value();
  ASSERT_TRUE(sum.sum() == scratch);
  ASSERT_EQ(sum.sum().vertex_contacts, scratch.vertex_contacts);
  for (std::size_t f = 0; f < scratch.faces.size(); ++f) {
    ASSERT_EQ(sum.sum().faces[f].p, scratch.faces[f].p);
    ASSERT_EQ(sum.sum().faces[f].q, scratch.faces[f].q);
  }
  for (const MovingOperand op : {kP, kQ}) {
    const Mesh& mesh = op == kP ? sum.p() : sum.q();
    ASSERT_TRUE(mesh.data() == MeshData{} || Mesh::create(mesh.data()).ok());
    const std::set<std::uint64_t> vertices(sum.vertex_names(op).begin(), sum.vertex_names(op).end());
    const std::set<std::uint64_t> faces(sum.face_names(op).begin(), sum.face_names(op).end());
    ASSERT_EQ(vertices.size(), mesh.vertices().size());
    ASSERT_EQ(faces.size(), mesh.faces().size());
    ASSERT_EQ(sum.face_ancestors(op).size(), mesh.faces().size());
  }
}

TEST(EditableSolidSum, random_edits_equal_sums_from_scratch) {
  std::array<int, 8> made{}, refused{};
  int undone = 0;
  for (int round = 0, n = solid_rounds(20); round < n; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    oracles::Random random(static_cast<std::uint64_t>(round) + 1);
    const int coordinates = round % 5;
    SolidEditOptions options;
    options.semantics = static_cast<Semantics>(random.below(3));
    options.reflect_q = random.chance(30);
    options.kept_sums = static_cast<std::size_t>(random.below(3));
    const Mesh p = with_coordinates(random_solid(random), coordinates, random),
               q = with_coordinates(random_solid(random), coordinates, random);
    EditableSolidSum sum = EditableSolidSum::create(p, q, options).value();
    std::vector<Snapshot> states{snapshot(sum)};  // up to the one that is undone furthest
    std::size_t now = 0;
    for (int step = 0; step < 20; ++step) {
      if (random.chance(25) && now > 0) {
        ASSERT_TRUE(sum.undo());
        --now, ++undone;
      } else if (random.chance(25) && now + 1 < states.size()) {
        ASSERT_TRUE(sum.redo());
        ++now;
      } else {
        std::vector<SolidEdit> edits;
        for (int k = random.chance(25) ? 2 : 1; k > 0; --k)
          edits.push_back(random_solid_edit(sum, random, coordinates));
        const auto changes = sum.edit(edits);
        for (const SolidEdit& edit : edits) ++(changes ? made : refused)[static_cast<std::size_t>(edit.kind)];
        if (changes) {
          states.resize(++now);
          states.push_back(snapshot(sum));
          expect_right(sum, options);
        }
      }
      ASSERT_NO_FATAL_FAILURE(expect_state(sum, states[now])) << "step " << step;
      ASSERT_EQ(sum.undo_count(), now);
      ASSERT_EQ(sum.redo_count(), states.size() - 1 - now);
    }
  }
  for (std::size_t k = 0; k < made.size(); ++k) {
    std::cout << name(static_cast<Kind>(k)) << ": " << made[k] << " made, " << refused[k] << " refused\n";
    EXPECT_GT(made[k], 0);
  }
  EXPECT_GT(undone, 10);
}

}  // namespace
}  // namespace dymsum

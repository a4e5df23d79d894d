// Sums of solids and what is made of them: inner fits, openings, offsets, slices.
#include <cmath>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_offset.h"
#include "dymsum/solid_slice.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"
#include "enumeration.h"
#include "record.h"
#include "remember.h"
#include "spatial_operand.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_sums_of_solids(nb::module_& m) {
  m.def(
      "minkowski_sum",
      [](const Many<Mesh>& operands, const SpatialOptions& options) {
        std::vector<Mesh> all;
        nb::list kept;
        for (const MeshArgument& one : operands.items) {
          all.push_back(*one);
          kept.append(one.object);
        }
        SpatialSum sum = run_with(
            options, [&](const SpatialOptions& own) { return minkowski_sum(std::span<const Mesh>(all), own); });
        return remembered(std::move(sum), "solid_sum_of", kept, options);
      },
      "operands"_a, "options"_a = SpatialOptions(), "The sum of several operands, at least one.");
  m.def(
      "minkowski_sum",
      [](const SpatialOperandArgument& p, const SpatialOperandArgument& q, const SpatialOptions& options) {
        SpatialSum sum = run_with(options, [&](const SpatialOptions& own) { return minkowski_sum(*p, *q, own); });
        return remembered(std::move(sum), "solid_sum", p.object, q.object, options);
      },
      "p"_a, "q"_a, "options"_a = SpatialOptions(),
      "The exact sum of two solids of any shape, or results of them as closed sets, unrounded. Raises Error: "
      "cancelled; "
      "out_of_memory; unsupported_operand.");
  m.def(
      "as_mesh", [](const SpatialSum& sum) { return take(as_mesh(sum)); }, "sum"_a,
      "The regular part of a sum as an operand. Raises Error: unsupported_operand where no doubles hold a vertex.");
  m.def(
      "erode",
      [](const SpatialOperandArgument& a, const SpatialOperandArgument& b, const SpatialOptions& options) {
        SpatialSum fit = run_with(options, [&](const SpatialOptions& own) { return erode(*a, *b, own); });
        return remembered(std::move(fit), "solid_erode", a.object, b.object, options);
      },
      "a"_a, "b"_a, "options"_a = SpatialOptions(),
      "A (-) B = { x : x + B inside A }, positions without room to move included as tight features; of solids, or "
      "results "
      "of them, unrounded.");
  m.def(
      "negated",
      [](nb::handle_t<SpatialSum> sum) {
        return remembered(negated(nb::cast<const SpatialSum&>(sum)), "negated", sum);
      },
      "sum"_a, "{ -x : x in the sum }, exactly, with what is tight.");
}

/// Raises Error: not_finite.
std::vector<RationalPoint3> exact_of(const Positions<3>& positions) {
  if (!positions.not_finite.empty()) take(Rational::of(std::nan("")));
  if (!positions.exact.empty()) return positions.exact;
  std::vector<RationalPoint3> exact(positions.doubles.size);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double* at = positions.doubles.row(i);
    exact[i] = {take(Rational::of(at[0])), take(Rational::of(at[1])), take(Rational::of(at[2]))};
  }
  return exact;
}

void bind_spatial_contains(nb::module_& m) {
  m.def(
      "contains",
      [](const SpatialOperandArgument& p, const SpatialOperandArgument& q, const Position<3>& z, Semantics semantics) {
        if (!z.exact && !z.doubles) take(Rational::of(std::nan("")));
        return z.exact && take(without_gil([&] { return contains(*p, *q, *z.exact, semantics); }));
      },
      "p"_a, "q"_a, "z"_a, "semantics"_a = Semantics::closed,
      "The same of solids, or results of them. Raises Error: not_finite.");
  m.def(
      "contains_each",
      [](const SpatialOperandArgument& p, const SpatialOperandArgument& q, const Positions<3>& positions,
         Semantics semantics, const Progress& progress) {
        const std::vector<RationalPoint3> exact = exact_of(positions);
        const std::vector<bool> inside =
            run(progress, [&](const Progress& watched) { return contains_each(*p, *q, exact, semantics, watched); });
        return truths_of({inside.begin(), inside.end()});
      },
      "p"_a, "q"_a, "positions"_a, "semantics"_a = Semantics::closed, "progress"_a = nb::none(),
      "contains for many positions, shape (n, 3), which may be exact numbers, without the GIL: n truth values. Raises "
      "Error: not_finite, cancelled.");
  Record<SpatialCost>(m, "SpatialCost", "What a sum will take, before it is computed.")
      .field("face_vertex", &SpatialCost::face_vertex)
      .field("edge_edge", &SpatialCost::edge_edge)
      .field("full_face_vertex", &SpatialCost::full_face_vertex)
      .field("full_edge_edge", &SpatialCost::full_edge_edge)
      .field("bytes", &SpatialCost::bytes);
  m.def(
      "predict_cost", [](const MeshArgument& p, const MeshArgument& q) { return predict_cost(*p, *q); }, "p"_a, "q"_a);
}

void bind_opening(nb::module_& m) {
  enumeration<BetweenSteps>(m, "BetweenSteps", "What becomes of positions between two operations that are no doubles.");
  Record<SolidOpening>(m, "SolidOpening", "An opening or a closing.")
      .field("solid", &SolidOpening::solid)
      .field("moved", &SolidOpening::moved, "no vertex between was moved by more; 0: exact");
  m.def(
      "opening",
      [](const SpatialOperandArgument& a, const SpatialOperandArgument& b, const SpatialOptions& options,
         BetweenSteps between) {
        return run_with(options, [&](const SpatialOptions& own) { return opening(*a, *b, own, between); });
      },
      "a"_a, "b"_a, "options"_a = SpatialOptions(), "between"_a = BetweenSteps::exact,
      R"doc((A (-) B) (+) B: the union of all x + B inside A. Raises Error: of rounded steps
rounding_changed_topology.

>>> from dymsum import opening, solids
>>> ell = solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1)
>>> opening(ell, solids.box(0, 0, 0, 2, 1, 1)).solid.volume()
3.0
)doc");
  m.def(
      "closing",
      [](const SpatialOperandArgument& a, const SpatialOperandArgument& b, const SpatialOptions& options,
         BetweenSteps between) {
        return run_with(options, [&](const SpatialOptions& own) { return closing(*a, *b, own, between); });
      },
      "a"_a, "b"_a, "options"_a = SpatialOptions(), "between"_a = BetweenSteps::exact, "(A (+) B) (-) B.");
}

void bind_offset(nb::module_& m) {
  enumeration<OffsetBound>(m, "OffsetBound", "On which side of the exact offset a result lies.");
  Record<TessellatedBall>(m, "TessellatedBall", "A convex solid between two balls.")
      .field("mesh", &TessellatedBall::mesh)
      .field("low", &TessellatedBall::low)
      .field("high", &TessellatedBall::high);
  m.def(
      "tessellated_ball",
      [](double radius, double tolerance, OffsetBound bound) {
        return take(tessellated_ball(radius, tolerance, bound));
      },
      "radius"_a, "tolerance"_a, "bound"_a = OffsetBound::inside);
  Record<SolidOffset>(m, "SolidOffset", "An offset: between the exact ones by `low` and `high`.")
      .field("solid", &SolidOffset::solid)
      .field("low", &SolidOffset::low)
      .field("high", &SolidOffset::high)
      .field("ball_facets", &SolidOffset::ball_facets);
  m.def(
      "offset",
      [](const SpatialOperandArgument& set, double distance, double tolerance, OffsetBound bound,
         const SpatialOptions& options) {
        return run_with(options,
                        [&](const SpatialOptions& own) { return offset(*set, distance, tolerance, bound, own); });
      },
      "set"_a, "distance"_a, "tolerance"_a, "bound"_a = OffsetBound::inside, "options"_a = SpatialOptions(),
      "The solid grown by a distance, or shrunk by a negative one, up to the tolerance. Raises Error: out_of_range.");
}

void bind_slice(nb::module_& m) {
  Record<SolidSlice> slice(m, "SolidSlice", "The section of P (+) Q by the plane of one z.");
  Record<SolidSlice::Stats>(slice, "Stats", "The work that was done.")
      .field("bits", &SolidSlice::Stats::bits)
      .field("facets", &SolidSlice::Stats::facets)
      .field("crossed", &SolidSlice::Stats::crossed)
      .field("cells", &SolidSlice::Stats::cells)
      .field("collision_tests", &SolidSlice::Stats::collision_tests);
  slice.field("z", &SolidSlice::z)
      .field("section", &SolidSlice::section)
      .field("touching", &SolidSlice::touching)
      .field("contacts", &SolidSlice::contacts)
      .field("stats", &SolidSlice::stats);
  m.def(
      "slice_of_sum",
      [](const SpatialOperandArgument& p, const SpatialOperandArgument& q, double z, const SpatialOptions& options) {
        return run_with(options, [&](const SpatialOptions& own) { return slice_of_sum(*p, *q, z, own); });
      },
      "p"_a, "q"_a, "z"_a, "options"_a = SpatialOptions(),
      R"doc(One height of a sum of solids, or of results of them. Raises Error: not_finite.

>>> from dymsum import area, slice_of_sum, solids
>>> box = solids.box(0, 0, 0, 1, 2, 3)
>>> slice_of_sum(box, box, 1).section.bounds()
[0.0, 0.0, 2.0, 4.0]
)doc");
}

}  // namespace

void bind_spatial_sums(nb::module_& m) {
  bind_sums_of_solids(m);
  bind_spatial_contains(m);
  bind_opening(m);
  bind_offset(m);
  bind_slice(m);
}

}  // namespace dymsum::python

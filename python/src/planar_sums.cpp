// Sums of regions, their relatives, and tables of them.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/planar_sum.h"
#include "parallel.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

using OfTwo = Result<PlanarSum> (*)(const Region&, const Region&, const SumOptions&);

template <OfTwo function>
Remembered<PlanarSum> of_two(const char* name, const RegionArgument& p, const RegionArgument& q,
                             const SumOptions& options) {
  PlanarSum sum = run_with(options, [&](const SumOptions& own) { return function(*p, *q, own); });
  return remembered(std::move(sum), name, p.object, q.object, kept(options));
}

void bind_sums_of_regions(nb::module_& m) {
  m.def(
      "minkowski_sum",
      [](const RegionArgument& p, const RegionArgument& q, const SumOptions& options) {
        return of_two<minkowski_sum>("minkowski_sum", p, q, options);
      },
      "p"_a, "q"_a, "options"_a = SumOptions(),
      R"doc(P (+) Q = { p + q : p in P, q in Q }, exactly. Raises Error: cancelled; unsupported_operand beyond 2^1000.

>>> from dymsum import minkowski_sum
>>> minkowski_sum("POLYGON((0 0, 1 0, 0 1, 0 0))", [(0, 0), (2, 0), (2, 2), (0, 2)]).area_exact()
Fraction(17, 2)
)doc");
  m.def(
      "nfp",
      [](const RegionArgument& a, const RegionArgument& b, const SumOptions& options) {
        return of_two<nfp>("nfp", a, b, options);
      },
      "a"_a, "b"_a, "options"_a = SumOptions(),
      "The no-fit polygon A (+) -B: positions of B's reference point at which B meets A.");
  m.def(
      "erode",
      [](const RegionArgument& p, const RegionArgument& q, const SumOptions& options) {
        return of_two<erode>("erode", p, q, options);
      },
      "p"_a, "q"_a, "options"_a = SumOptions(),
      R"doc(The inner fit P (-) Q = { x : x + Q inside P }, positions without freedom included. Raises Error:
unsupported_operand when P has polylines or points, or Q is empty; cancelled.

>>> from dymsum import erode, shapes
>>> fit = erode(shapes.rectangle(0, 0, 3, 2), shapes.rectangle(0, 0, 1, 2))
>>> [(s.from_.at, s.to.at) for s in fit.segments]
[(Point(x=0.0, y=0.0), Point(x=2.0, y=0.0))]
)doc");
  m.def(
      "union_of",
      [](const Many<Region>& regions, const SumOptions& options) {
        std::vector<Region> all;
        nb::list given;
        for (const RegionArgument& region : regions.items) {
          all.push_back(*region);
          given.append(region.object);
        }
        PlanarSum sum = run_with(options, [&](const SumOptions& own) { return union_of(all, own); });
        return remembered(std::move(sum), "union_of", given, kept(options));
      },
      "regions"_a, "options"_a = SumOptions(), "The union of regions.");
  m.def(
      "rotated_sum",
      [](const RegionArgument& p, const RegionArgument& q, const Orientation& theta, const SumOptions& options) {
        PlanarSum sum = run_with(options, [&](const SumOptions& own) { return rotated_sum(*p, *q, theta, own); });
        return remembered(std::move(sum), "rotated_sum", p.object, q.object, theta, kept(options));
      },
      "p"_a, "q"_a, "theta"_a, "options"_a = SumOptions(),
      "R(theta) P (+) Q, P turned about the origin, never rounded.");
  m.def(
      "convolution_sizes", [](const RegionArgument& p, const RegionArgument& q) { return convolution_sizes(*p, *q); },
      "p"_a, "q"_a);
}

/// The doubles that a position is; TypeError where there are none.
Point doubles_of(const RationalPoint& z) {
  const Point at{z.x.to_double(), z.y.to_double()};
  const Result<Rational> x = Rational::of(at.x), y = Rational::of(at.y);
  if (x && y && *x == z.x && *y == z.y) return at;
  throw nb::type_error(
      "no double holds a position, and contains in the plane takes doubles; at exact positions ask "
      "check_translation(negated(q), p, z, z, Orientation(), touch).free");
}

template <class PositionOf>
auto contains_at(const Region& p, const Region& q, std::size_t count, const PositionOf& position_of,
                 Semantics semantics, int threads, const Progress& progress) {
  std::vector<std::uint8_t> inside(count);
  Watch watch(progress);
  const bool done = without_gil([&] {
    return for_each_item(count, 64, threads, watch.progress(),
                         [&](std::size_t i) { inside[i] = contains(p, q, position_of(i), semantics); });
  });
  watch.raise();
  if (!done) throw ErrorRaised({ErrorCode::cancelled, "stopped on request", {}});
  return truths_of(std::move(inside));
}

/// At positions given by exact numbers, which have to be doubles.
void bind_exact_positions(nb::module_& m) {
  m.def(
      "contains",
      [](const RegionArgument& p, const RegionArgument& q, const RationalPoint& z, Semantics semantics) {
        return contains(*p, *q, doubles_of(z), semantics);
      },
      "p"_a, "q"_a, "z"_a, "semantics"_a = Semantics::closed,
      "The same for exact numbers. Raises TypeError where no double holds the position: check_translation answers "
      "there.");
  m.def(
      "contains_each",
      [](const RegionArgument& p, const RegionArgument& q, const std::vector<RationalPoint>& positions,
         Semantics semantics, int threads, const Progress& progress) {
        std::vector<Point> at;
        for (const RationalPoint& z : positions) at.push_back(doubles_of(z));
        return contains_at(
            *p, *q, at.size(), [&](std::size_t i) { return at[i]; }, semantics, threads, progress);
      },
      "p"_a, "q"_a, "positions"_a, "semantics"_a = Semantics::closed, "threads"_a = 0, "progress"_a = nb::none(),
      "The same for exact numbers. Raises TypeError where no double holds a position.");
}

void bind_planar_contains(nb::module_& m) {
  m.def(
      "contains",
      [](const RegionArgument& p, const RegionArgument& q, Point z, Semantics semantics) {
        return contains(*p, *q, z, semantics);
      },
      "p"_a, "q"_a, "z"_a, "semantics"_a = Semantics::closed,
      "True when z lies in P (+) Q: P and z - Q meet (closed), or overlap (open). Exact; O(nm).");
  m.def(
      "contains_each",
      [](const RegionArgument& p, const RegionArgument& q, const Rows<2>& positions, Semantics semantics, int threads,
         const Progress& progress) {
        const auto at = [&](std::size_t i) { return Point{positions.row(i)[0], positions.row(i)[1]}; };
        return contains_at(*p, *q, positions.size, at, semantics, threads, progress);
      },
      "p"_a, "q"_a, "positions"_a, "semantics"_a = Semantics::closed, "threads"_a = 0, "progress"_a = nb::none(),

      R"doc(contains for many positions, shape (n, 2), on several threads (0: all cores); an array of n truth values.

>>> from dymsum import contains_each, shapes
>>> square = shapes.rectangle(0, 0, 1, 1)
>>> contains_each(square, square, [(1, 1), (2, 2), (3, 3)])
array([ True,  True, False])
)doc");
  bind_exact_positions(m);
}

using Table = std::vector<std::optional<Result<PlanarSum>>>;

Table table_of(const RegionPairs& pairs, const SumOptions& options, int threads) {
  Table sums(pairs.items.size());
  const Watch watch(options.progress), interrupts(Progress{});
  SumOptions own = options;
  own.progress = interrupts.progress();
  const bool done = without_gil([&] {
    return for_each_item(sums.size(), 1, threads, watch.progress(), [&](std::size_t i) {
      sums[i].emplace(nfp(*pairs.items[i].first, *pairs.items[i].second, own));
    });
  });
  watch.raise();
  interrupts.raise();
  if (!done) throw ErrorRaised({ErrorCode::cancelled, "stopped on request", {}});
  return sums;
}

nb::list nfp_each(const RegionPairs& pairs, const SumOptions& options, int threads, bool return_errors) {
  Table sums = table_of(pairs, options, threads);
  nb::list all;
  const nb::object options_kept = kept(options);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!sums[i]->ok() && return_errors) {
      all.append(error_object(sums[i]->error()));
      continue;
    }
    const auto& [a, b] = pairs.items[i];
    all.append(remembered(take(std::move(*sums[i])), "nfp", a.object, b.object, options_kept).object);
  }
  return all;
}

void bind_table(nb::module_& m) {
  m.def(
      "nfp_each",
      [](const RegionPairs& pairs, const SumOptions& options, int threads) {
        return nfp_each(pairs, options, threads, false);
      },
      "pairs"_a, "options"_a = SumOptions(), "threads"_a = 0,
      nb::sig("def nfp_each(pairs: collections.abc.Sequence[tuple[dymsum.RegionLike, dymsum.RegionLike]], options: "
              "SumOptions = ..., threads: int = 0) -> list[PlanarSum]"),
      R"doc(nfp of every pair (A, B), in parallel and without the GIL: the table that nesting asks for. One Region object in
several pairs is prepared once. threads 0: as many as there are cores.

>>> from dymsum import nfp_each, shapes
>>> parts = [shapes.letter_l(3, 3, 1), shapes.star(5, 1, 2)]
>>> table = nfp_each([(a, b) for a in parts for b in parts])
>>> [sum.vertex_count() for sum in table]
[8, 19, 19, 20]
)doc");
  m.def("nfp_each", &nfp_each, "pairs"_a, "options"_a = SumOptions(), "threads"_a = 0, nb::kw_only(), "return_errors"_a,
        nb::sig("def nfp_each(pairs: collections.abc.Sequence[tuple[dymsum.RegionLike, dymsum.RegionLike]], options: "
                "SumOptions = ..., threads: int = 0, *, return_errors: bool) -> list[PlanarSum | dymsum.Error]"),
        "The same; with return_errors what fails is an Error in the list instead of raised.");
}

}  // namespace

void bind_planar_sums(nb::module_& m) {
  bind_sums_of_regions(m);
  bind_planar_contains(m);
  bind_table(m);
}

}  // namespace dymsum::python

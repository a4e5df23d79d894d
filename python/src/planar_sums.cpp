// Sums of regions, their relatives, and tables of them.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/sum_io.h"
#include "dymsum/sum_locator.h"
#include "parallel.h"
#include "planar_operand.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

using OfTwo = Result<PlanarSum> (*)(const PlanarOperand&, const PlanarOperand&, const SumOptions&);

template <OfTwo function>
Remembered<PlanarSum> of_two(const char* name, const PlanarOperandArgument& p, const PlanarOperandArgument& q,
                             const SumOptions& options) {
  PlanarSum sum = run_with(options, [&](const SumOptions& own) { return function(*p, *q, own); });
  return remembered(std::move(sum), name, p.object, q.object, kept(options));
}

void bind_sums_of_regions(nb::module_& m) {
  m.def(
      "minkowski_sum",
      [](const PlanarOperandArgument& p, const PlanarOperandArgument& q, const SumOptions& options) {
        return of_two<minkowski_sum>("minkowski_sum", p, q, options);
      },
      "p"_a, "q"_a, "options"_a = SumOptions(),
      R"doc(P (+) Q = { p + q : p in P, q in Q }, exactly. Operands are regions, or results as they are: nothing is rounded in
between. Raises Error: cancelled; unsupported_operand beyond 2^1000.

>>> from dymsum import minkowski_sum
>>> minkowski_sum("POLYGON((0 0, 1 0, 0 1, 0 0))", [(0, 0), (2, 0), (2, 2), (0, 2)]).area_exact()
Fraction(17, 2)
)doc");
  m.def(
      "nfp",
      [](const PlanarOperandArgument& a, const PlanarOperandArgument& b, const SumOptions& options) {
        return of_two<nfp>("nfp", a, b, options);
      },
      "a"_a, "b"_a, "options"_a = SumOptions(),
      R"doc(The no-fit polygon A (+) -B: positions of B's reference point at which B meets A.

>>> from dymsum import nfp, shapes
>>> sum = nfp(shapes.rectangle(0, 0, 3, 2), shapes.rectangle(0, 0, 1, 1))
>>> sum.bounds(), sum.area()
([-1.0, -1.0, 3.0, 2.0], 12.0)
)doc");
  m.def(
      "erode",
      [](const PlanarOperandArgument& p, const PlanarOperandArgument& q, const SumOptions& options) {
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
      "minkowski_sum",
      [](const PlanarOperands& sets, const SumOptions& options) {
        const auto [all, given] = operands_of(sets);
        PlanarSum sum = run_with(options, [&](const SumOptions& own) { return minkowski_sum(all, own); });
        return remembered(std::move(sum), "planar_sum_of", given, kept(options));
      },
      "sets"_a, "options"_a = SumOptions(),
      R"doc(The sum of all regions and results of a list, exactly. Raises Error: out_of_range for none.

>>> from dymsum import minkowski_sum, shapes
>>> square = shapes.rectangle(0, 0, 1, 1)
>>> minkowski_sum([square, square, square]).area(), minkowski_sum(minkowski_sum(square, square), square).area()
(9.0, 9.0)
)doc");
  m.def(
      "opening",
      [](const PlanarOperandArgument& p, const PlanarOperandArgument& q, const SumOptions& options) {
        return of_two<opening>("opening", p, q, options);
      },
      "p"_a, "q"_a, "options"_a = SumOptions(),
      R"doc(All of P that translates of Q inside P cover: the erosion, then the sum, nothing rounded in between.

>>> from dymsum import opening, shapes
>>> opening(shapes.letter_u(4, 4, 1), shapes.rectangle(0, 0, 2, 1)).area()
4.0
)doc");
  m.def(
      "closing",
      [](const PlanarOperandArgument& p, const PlanarOperandArgument& q, const SumOptions& options) {
        return of_two<closing>("closing", p, q, options);
      },
      "p"_a, "q"_a, "options"_a = SumOptions(),
      "P with all that translates of -Q outside of P do not reach: the sum, then the erosion, nothing rounded in "
      "between.");
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
      "regions"_a, "options"_a = SumOptions(), R"doc(The union of regions.

>>> from dymsum import shapes, union_of
>>> union_of([shapes.rectangle(0, 0, 2, 2), shapes.rectangle(1, 1, 3, 3)]).area_exact()
Fraction(7, 1)
)doc");
  m.def(
      "rotated_sum",
      [](const RegionArgument& p, const RegionArgument& q, const Orientation& theta, const SumOptions& options) {
        PlanarSum sum = run_with(options, [&](const SumOptions& own) { return rotated_sum(*p, *q, theta, own); });
        return remembered(std::move(sum), "rotated_sum", p.object, q.object, theta, kept(options));
      },
      "p"_a, "q"_a, "theta"_a, "options"_a = SumOptions(),
      R"doc(R(theta) P (+) Q, P turned about the origin, never rounded.

>>> from dymsum import Orientation, rotated_sum, shapes
>>> square = shapes.rectangle(0, 0, 1, 1)
>>> rotated_sum(square, square, Orientation.parse("1/2")).area_exact()
Fraction(24, 5)
)doc");
  m.def(
      "convolution_sizes", [](const RegionArgument& p, const RegionArgument& q) { return convolution_sizes(*p, *q); },
      "p"_a, "q"_a);
}

std::span<const Point> positions_of(const Rows<2>& rows) {
  static_assert(sizeof(Point) == 2 * sizeof(double));
  return {reinterpret_cast<const Point*>(rows.data), rows.size};
}

/// Whether positions lie in a set: ask(positions, progress) of it. What is not finite lies in none.
Array<bool> inside_of(const Positions<2>& positions, const Progress& progress, auto&& ask) {
  if (positions.exact.empty()) {
    return truths_of(
        run(progress, [&](const Progress& watched) { return ask(positions_of(positions.doubles), watched); }));
  }
  std::vector<std::uint8_t> inside = run(
      progress, [&](const Progress& watched) { return ask(std::span<const RationalPoint>(positions.exact), watched); });
  for (const std::size_t k : positions.not_finite) inside[k] = 0;
  return truths_of(std::move(inside));
}

void bind_planar_contains(nb::module_& m) {
  m.def(
      "contains",
      [](const PlanarOperandArgument& p, const PlanarOperandArgument& q, const Position<2>& z, Semantics semantics) {
        if (z.doubles) return contains(*p, *q, *z.doubles, semantics);
        SumOptions options;
        options.semantics = semantics;
        return z.exact &&
               SumLocator(run_with(options, [&](const SumOptions& own) { return minkowski_sum(*p, *q, own); }),
                          semantics)
                   .contains_rational(*z.exact);
      },
      "p"_a, "q"_a, "z"_a, "semantics"_a = Semantics::closed,
      R"doc(True when z lies in P (+) Q: P and z - Q meet (closed), or overlap (open). Exact; nothing that is not finite
does. Where doubles do not hold z the sum is computed: see SumLocator for more than a few.

>>> from fractions import Fraction
>>> from dymsum import contains, shapes
>>> square = shapes.rectangle(0, 0, 1, 1)
>>> contains(square, square, (2, Fraction(1, 3))), contains(square, square, (2.5, 1))
(True, False)
)doc");
  m.def(
      "contains_each",
      [](const RegionArgument& p, const RegionArgument& q, const Positions<2>& positions, Semantics semantics,
         int threads, const Progress& progress) {
        return inside_of(positions, progress, [&](auto at, const Progress& watched) {
          return contains_each(*p, *q, at, semantics, threads, watched);
        });
      },
      "p"_a, "q"_a, "positions"_a, "semantics"_a = Semantics::closed, "threads"_a = 0, "progress"_a = nb::none(),
      R"doc(contains for many positions, shape (n, 2), on several threads (0: all cores); an array of n truth values.
Positions may be exact numbers. Many are found in the sum, which is computed once; few are answered one by one. Raises
Error: cancelled; unsupported_operand beyond 2^1000.

>>> from fractions import Fraction
>>> from dymsum import contains_each, shapes
>>> square = shapes.rectangle(0, 0, 1, 1)
>>> contains_each(square, square, [(1, 1), (2, 2), (3, 3)])
array([ True,  True, False])
>>> contains_each(square, square, [(Fraction(1, 3), 2), (Fraction(1, 3), 2 + Fraction(1, 10**40))])
array([ True, False])
)doc");
}

void bind_locator(nb::module_& m) {
  nb::class_<SumLocator>(m, "SumLocator", nb::dynamic_attr(),
                         R"doc(Answers whether points lie in a sum, a no-fit polygon, an inner fit, prepared once.

>>> from dymsum import SumLocator, nfp, shapes
>>> square = shapes.rectangle(0, 0, 1, 1)
>>> locator = SumLocator(nfp(square, square))
>>> locator.contains_each([(0, 0), (1, 1), (1, 1.5)])
array([ True,  True, False])
)doc")
      .def(
          "__init__",
          [](nb::pointer_and_handle<SumLocator> self, nb::handle_t<PlanarSum> sum, Semantics semantics) {
            const PlanarSum& of = *nb::inst_ptr<PlanarSum>(sum);
            without_gil([&] { new (self.p) SumLocator(of, semantics); });
            remember(self.h, "sum_locator", nb::make_tuple(sum, semantics));
          },
          "sum"_a, "semantics"_a = Semantics::closed,
          "Of a sum made with these semantics: closed, its parts, segments and points; regular, its parts; open, the "
          "interior of its parts without tight features.")
      .def(
          "contains",
          [](const SumLocator& self, const Position<2>& z) {
            if (z.doubles) return self.contains(*z.doubles);
            return z.exact && self.contains_rational(*z.exact);
          },
          "z"_a, "True when z lies in the set. Exact. Nothing that is not finite does.")
      .def("contains_rational", &SumLocator::contains_rational, "z"_a, "Raises Error: not_finite.")
      .def(
          "contains_each",
          [](const SumLocator& self, const Positions<2>& positions, int threads, const Progress& progress) {
            return inside_of(positions, progress, [&](auto at, const Progress& watched) {
              return self.contains_each(at, threads, watched);
            });
          },
          "positions"_a, "threads"_a = 0, "progress"_a = nb::none(),
          "contains for many positions, shape (n, 2), which may be exact numbers, on several threads (0: all cores): n "
          "truth values. Raises Error: cancelled.")
      .def("__reduce__", [](nb::handle_t<SumLocator> self) { return made_again(self); });
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
    all.append(
        remembered(of_item(i, [&] { return take(std::move(*sums[i])); }), "nfp", a.object, b.object, options_kept)
            .object);
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
  bind_locator(m);
  bind_table(m);
}

}  // namespace dymsum::python

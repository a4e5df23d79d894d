#include "nesting/kinds.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "dymsum/shapes.h"
#include "nesting/against_cgal.h"
#include "off_grid.h"
#include "thesis/thesis_shapes.h"

namespace dymsum::bench {
namespace {

NfpTable table_of(const Region& a, const Region& b, int orientations) {
  std::vector<Rational> degrees;
  for (int k = 0; k < orientations; ++k) degrees.push_back(Rational::of(360 * k, orientations).value());
  TableInput input;
  input.items = {{"a", a, degrees}, {"b", b, degrees}};
  return NfpTable::create(std::move(input)).value();
}

OffGridCase table_case(const std::string& name, const Region& a, const Region& b, int orientations) {
  return off_grid_case(name + ", " + std::to_string(orientations) + " angles", a, b,
                       [=](const Region& p, const Region& q) {
                         const NfpTable table = table_of(p, q, orientations);
                         OffGridWork work;
                         work.run = [=] {
                           TableOptions options;
                           options.threads = 1;
                           const TableResult made = compute_table(table, options).value();
                           std::size_t vertices = 0;
                           for (const std::optional<TableAnswer>& answer : made.answers) vertices += answer->vertices;
                           return vertices;
                         };
                         work.compare = [=] {
                           const Rivalry rivalry = against_cgal(table);
                           const std::size_t wrong = rivalry.rows - rivalry.equal - rivalry.witnessed;
                           std::string text = std::to_string(rivalry.equal) + " of " + std::to_string(rivalry.rows);
                           if (rivalry.witnessed > 0)
                             text += ", CGAL wrong " + std::to_string(rivalry.witnessed) + " times";
                           if (wrong > 0) text += ", " + std::to_string(wrong) + " NOT witnessed";
                           return Compared{text, wrong > 0, rivalry.cgal_ms};
                         };
                         return work;
                       });
}

const Region& shape_of(const std::vector<shapes::Named>& set, std::string_view name) {
  return std::find_if(set.begin(), set.end(), [&](const shapes::Named& n) { return n.name == name; })->region;
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const std::vector<shapes::Named> set = shapes::thesis_like_set();
  const Region ell = shapes::letter_l(3, 3, 1), u = shape_of(set, "U"), star = shape_of(set, "star"),
               comb = shapes::comb(7, 2, 1, 3), gear = shapes::gear(13, 2, 3, shapes::demo_snap(3));
  return off_grid_table(
      {"nesting",
       "The table of two items: all ordered pairs at all angles, rounded to doubles and as well-known binary, "
       "on one thread.",
       "vertex", "CGAL",
       "CGAL: one reduced convolution a row, its results not rounded. Compared: parts, holes, vertices and area of all "
       "rows; where they differ, its vertical decomposition is asked."},
      {table_case("L and U", ell, u, 4), table_case("L and U", ell, u, 8),
       table_case("comb 7 and gear 13", comb, gear, 4), table_case("star and comb 7", star, comb, 8)},
      folder);
}

}  // namespace dymsum::bench

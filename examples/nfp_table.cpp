// A small table: no-fit polygons of two parts in four orientations, and where they fit into a sheet.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const std::vector<Rational> quarters = {0, 90, 180, 270};
  TableInput input;
  input.items = {{"ell", shapes::letter_l(3, 3, 1), quarters}, {"bar", shapes::rectangle(0, 0, 2, 1), quarters}};
  input.bins = {{"sheet", shapes::rectangle(0, 0, 4, 3)}};
  const NfpTable table = NfpTable::create(input).value();
  const TableResult result = compute_table(table, {.threads = 2}).value();
  std::cout << table.rows().size() << " rows, " << table.task_count() << " sums computed\n";
  for (const TableRow& row : table.rows()) {
    if (row.kind != TableRow::Kind::bin_fit || input.items[row.moving].name != "ell") continue;
    const TableAnswer& answer = *result.answers[row.answer];
    std::cout << "ell at " << table.angles()[row.angle].degrees.to_double() << " degrees: " << answer.vertices
              << " vertices, " << answer.tight_segments << " tight segment\n";
  }
}

// Rows as lines on the screen, as CSV and markdown, and the summary against the targets.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "planar/measure.h"

namespace dymsum::bench {

/// Heading and rows of the table, one line each.
void print_heading(std::ostream& out);
void print_row(std::ostream& out, const Row& row);

/// One line for a whole nesting table: mean times, ratio of the totals, least ratio.
void print_table(std::ostream& out, Group group, const std::vector<Row>& rows);

/// Our engine alone: work and its price.
void print_work_heading(std::ostream& out);
void print_work(std::ostream& out, const Row& row);

/// What the project promises, with what was measured: a line each, "met" or "NOT met".
struct Target {
  std::string promise, measured;
  bool met = false;
};
std::vector<Target> targets(const std::vector<Row>& rows);

/// The sizes of our convolutions beside those the thesis prints, for its own polygons.
std::vector<std::string> thesis_counts(const std::vector<Row>& rows);

/// How both Clippers compare with ours where they finish.
std::vector<std::string> clipper_lines(const std::vector<Row>& rows);

/// Sizes of the convolutions and mean ratios of the groups.
void print_summary(std::ostream& out, const std::vector<Row>& rows);
void print_promises(std::ostream& out, const std::vector<Row>& rows);

std::string to_csv(const std::vector<Row>& rows);
std::string to_markdown(const std::vector<Row>& rows);

/// Writes planar.csv, planar.md and the three figures into a folder, which is made when missing. False when it cannot.
bool write_results(const std::string& folder, const std::vector<Row>& rows);

}  // namespace dymsum::bench

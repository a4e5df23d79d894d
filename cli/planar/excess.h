// What a set has beyond another one, in reports.
#pragma once

#include <iosfwd>
#include <string>

#include "dymsum/set_check.h"
#include "json_report.h"

namespace dymsum::cli {

/// {"parts", "area", "area_exact", "distance", "squared_exact", "at_most", "at", "at_exact", "nearest"}; the last six
/// are null where nothing is there, the distance "inf" where the other set is empty.
Json excess_json(const PlanarExcess& excess, bool exact);
/// The same of solids, with "shells", "volume" and "volume_exact".
Json excess_json(const SolidExcess& excess, bool exact);
void print_excess(std::ostream& out, const SolidExcess& excess, const std::string& what, const std::string& there);
/// "WHAT: area 0.5 in 1 part, up to 0.707107 from THERE, at (4, 4)\n"; nothing where nothing is there.
void print_excess(std::ostream& out, const PlanarExcess& excess, const std::string& what, const std::string& there);
/// "0.70710678", or "between 0.5 and 0.6" where it is not known exactly.
std::string shown_distance(double distance, double at_most, bool exact);

/// A distance of a report: a number, or "inf".
Json distance_json(double distance);
/// How a command ends that comes to this.
ExitCode exit_code_of(CheckVerdict verdict);
/// --within and others, a number of at least 0 that is taken exactly: 1/3, 0.1.
Rational read_tolerance(const std::string& text, const std::string& option);

}  // namespace dymsum::cli

// The complex of growing discs against CGAL's segment Delaunay graph, barcodes against sums at many radii.
#pragma once

#include <string>
#include <vector>

#include "dymsum/region.h"
#include "page.h"

namespace dymsum::bench {

struct DiagramRow {
  std::string name;
  std::size_t vertices = 0, nodes = 0;   ///< nodes of both sides
  double outside_ms = 0, inside_ms = 0;  ///< one thread
  double threads_ms = 0;                 ///< outside, all threads
  double cgal_ms = 0;                    ///< both sides at once; 0: not measured
  double exact_fraction = 0;             ///< of the decisions: those that intervals leave open
  bool certified = true;
};

/// Medians of `runs`.
DiagramRow measure_diagram(const std::string& name, const Region& region, int runs, bool with_cgal);
void report_diagrams(Report& report, const std::vector<DiagramRow>& rows);

struct BarcodeRow {
  std::string name;
  std::size_t vertices = 0, bars = 0;
  double barcode_ms = 0;  ///< all events and bars
  double sums_ms = 0;     ///< our sums with a disc of 32 vertices at so many radii, from a sample of them
};

/// `radii` radii evenly up to `fraction` of the extent; sums are timed at `samples` of them.
BarcodeRow measure_barcode(const std::string& name, const Region& region, double fraction, int radii, int samples);
void report_barcodes(Report& report, const std::vector<BarcodeRow>& rows);

}  // namespace dymsum::bench

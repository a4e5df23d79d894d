// Cells: what discs that touch a site touch first, at one position and at all of them, and whether the cells of all
// sites match.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "exact/orient.h"
#include "shape/complex/exact_complex.h"

namespace dymsum::shape {

// Exact decisions about the positions of a site, intervals first.

/// The signs that determine where a quadratic is negative, as far as they matter.
struct QuadraticSigns {
  int a = 0, b = 0, c = 0;
  int discriminant = 0;  ///< only where a is not zero
};

class Order {
 public:
  using Interval = exact::Interval;
  using Fine = exact::FineInterval;
  using Exact = exact::RootExpression;

  explicit Order(const Walks& walks) : walks_(walks), near_(walks), fine_(walks), exact_(walks) {}

  const Walks& walks() const { return walks_; }
  const Formulas<Interval>& near() const { return near_; }
  const Formulas<Exact>& exact() const { return exact_; }

  /// The sign of a - b.
  int compare(const Section& s, const Mark& a, const Mark& b);
  /// The signs of the difference that Formulas::difference names; `near` contains it.
  QuadraticSigns signs(const Section& s, std::uint32_t i, std::uint32_t j, const Quadratic<Interval>& near);
  /// Whether the disc that touches edge j at an end lies exactly opposite the section's axis.
  bool is_opposite(const Section& s, std::uint32_t j, int end);

  /// The sign of form(formulas), which is Formulas for one type of numbers after the other.
  template <class Form>
  int sign(Form&& form) {
    if (const std::optional<int> sign = sign_of(form(near_))) {
      counts.count(exact::Rung::doubles);
      return *sign;
    }
    return sign_beyond(form);
  }
  /// The same where intervals of doubles do not decide.
  template <class Form>
  int sign_beyond(Form&& form) {
    if (const std::optional<int> sign = sign_of(form(fine_))) {
      counts.count(exact::Rung::double_pairs);
      return *sign;
    }
    counts.count(exact::Rung::big);
    return exact::sign_of(form(exact_));
  }

  /// The mark with `near` filled in.
  Mark mark(const Section& s, Mark m) const {
    if (!m.is_infinite()) m.near = near_.value(s, m);
    return m;
  }
  Mark tangent(const Section& s, std::uint32_t j, int end) const {
    return mark(s, {.kind = Mark::Kind::tangent, .root = static_cast<std::uint8_t>(end), .i = j});
  }

  exact::RungCounts counts;

 private:
  /// Whether both marks are directions of integer vectors, and the same one: without roots.
  bool same_direction(const Section& s, const Mark& a, const Mark& b);

  const Walks& walks_;
  Formulas<Interval> near_;
  Formulas<Fine> fine_;
  Formulas<Exact> exact_;
};

// Where along a site a disc can touch another site, as far as these two are concerned.

struct Interval {
  Mark low, high;
};
struct Domain {
  std::array<Interval, 2> intervals;
  int count = 0;
  void add(Mark low, Mark high) { intervals[static_cast<std::size_t>(count++)] = {low, high}; }
};

/// A superset within which Formulas::function(s, j) is the disc's. At a vertex the function may be negative in it,
/// where no disc touches both. Empty where no disc does; ends may lie beyond the section's. Exact.
Domain domain(Order& order, const Section& s, std::uint32_t j);

/// An interval of a section along which the disc first touches `other`; kNoIndex: nothing.
struct Piece {
  std::uint32_t other = kNoIndex;
  Mark from, to;
};

/// The exact lower envelope over the sites inserted. The order of insertion does not matter, but for the names of marks
/// that are the same position.
class Envelope {
 public:
  Envelope(Order& order, const Section& section);

  void insert(std::uint32_t j);
  std::vector<Piece> pieces() const;

 private:
  struct Part {
    Mark from, to;
    std::uint32_t slot;  ///< of functions_; 0: nothing
  };
  struct Function {
    std::uint32_t site = kNoIndex;
    Quadratic<exact::Interval> near;
  };
  Order& order_;
  Section section_;
  bool on_edge_;
  std::vector<Function> functions_;
  std::vector<Part> parts_, scratch_;

  void insert_interval(std::uint32_t slot, Interval s);
  void compete(const Part& part, std::uint32_t slot, const Mark& low, const Mark& high);
  void put(const Mark& from, const Mark& to, std::uint32_t slot);
  bool less(const Mark& a, const Mark& b) { return order_.compare(section_, a, b) < 0; }
};

/// The sections of a site: one, but two of an isolated point.
std::vector<Section> sections_of(const Walks& walks, std::uint32_t site);

// The cells of all sites side by side: every walk as a circular row of pieces, each with its mate on the other side.

/// An interval of a site along which discs first touch `other`. Unless the site is an isolated point, `section` and
/// `to_section` are the same.
struct CellPiece {
  std::uint32_t site = 0, other = kNoIndex;
  Section section, to_section;
  Mark from, to;
  bool wraps = false;                ///< it begins before the first direction of an isolated point and ends after it
  std::uint32_t next = 0, prev = 0;  ///< in the walk
  std::uint32_t mate = kNoIndex;     ///< the same discs as seen from the other site; they go backwards there
};

struct Cells {
  std::vector<CellPiece> pieces;
};

/// Joins the envelopes of all sites (their sections in order). `rows[i]` are the pieces of section i.
Cells join_cells(const Walks& walks, const std::vector<Section>& sections, const std::vector<std::vector<Piece>>& rows);

/// Finds mates: along two sites the pieces that they share come in opposite orders. False where some piece has none:
/// then candidates are missing.
bool match_cells(Order& order, Cells& cells);

}  // namespace dymsum::shape

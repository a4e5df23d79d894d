// What a disc that touches a site at a given position touches first.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/complex/domain.h"

namespace dymsum::shape {

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

}  // namespace dymsum::shape

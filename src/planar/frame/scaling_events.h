// Exact scales at which segments begin or cease to meet, and hashes by which sums are distinguished.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/scaling_sum.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/scaling_window.h"

namespace dymsum::planar {

struct EventValue {
  exact::BigRational s;
  ScaleEvent::Kind kind = ScaleEvent::Kind::vertex_on_segment;
  std::vector<SegmentPosition>
      at;  ///< where something meets, each position once or more; in the units of the frame's lattice
};

/// All events in [low, high] among the segments live in a window, sorted, each value once, but for those that doubles
/// prove to lie in the open sum. Every scale there at which the boundary's combinatorics change is among them. `again`
/// is called every so many pairs: it throws to stop.
std::vector<EventValue> events_of(const Window& window, const ExactForms& forms, const exact::BigRational& low,
                                  const exact::BigRational& high, const std::function<void()>& again);

/// Whether all of its positions lie in the open sum, exactly: then nothing changes on the boundary. `frame`: of its
/// scale.
bool is_covered(const EventValue& event, ExactFrame& frame);

/// The first index that every value has in a list. Requires that the values requested are in it.
class FirstIndices {
 public:
  explicit FirstIndices(std::span<const std::uint32_t> values) {
    for (std::uint32_t k = 0; k < values.size(); ++k) {
      if (values[k] >= index_.size()) index_.resize(values[k] + std::size_t{1}, kNone);
      if (index_[values[k]] == kNone) index_[values[k]] = k;
    }
  }
  std::uint32_t operator[](std::uint32_t value) const { return index_[value]; }

 private:
  std::vector<std::uint32_t> index_;
};

/// Hashes of the lines of a pair's segments, which no scale changes: found once each, and kept from frame to frame.
class LineHashes {
 public:
  explicit LineHashes(std::shared_ptr<const OperandPair> base);
  /// See ScalingSum::combinatorial_hash.
  std::uint64_t of(const PlanarSum& sum);
  const ExactForms& forms() const { return forms_; }

 private:
  Segment segment(const Contact& c) const;
  std::uint64_t line(const Contact& c);

  std::shared_ptr<const OperandPair> base_;
  ExactForms forms_;
  std::array<FirstIndices, 2> edges_, vertices_;            // of the operands: indices in their walks
  std::unordered_map<std::uint64_t, std::uint64_t> lines_;  // of contacts
};

}  // namespace dymsum::planar

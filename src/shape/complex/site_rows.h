// The envelopes of all sites over their candidates, and what they request.
#pragma once

#include <cstdint>
#include <vector>

#include "base/poll.h"
#include "shape/complex/candidates.h"
#include "shape/complex/envelope.h"

namespace dymsum::shape {

class SiteRows {
 public:
  /// `candidates`: per site, ascending.
  SiteRows(const Walks& walks, Candidates candidates, int threads);

  /// Envelopes, and again with what their breakpoints name, until these name nothing new. Where an envelope jumps at
  /// the end of a site, that site's neighbours in the walk become candidates, then all sites.
  /// A rough guess is given up where it wants many rounds or all sites: then false, and nothing is complete.
  enum class Guess : std::uint8_t { good, rough };
  bool close(Guess guess, const Poll& poll);

  const std::vector<Section>& sections() const { return sections_; }
  /// The rows of each section.
  const std::vector<std::vector<Piece>>& rows() const { return rows_; }
  /// The unbounded cells go once round (outside), or there are none (inside). Exact.
  bool closes_at_infinity();

  Work work;

 private:
  struct Ends;  // two pieces in turn along a walk
  void make_rows(const std::vector<std::uint32_t>& sites, const Poll& poll);
  void make_some_rows(const std::uint32_t* first, const std::uint32_t* last);
  std::vector<std::uint32_t> extend();
  void query(std::uint32_t s, std::uint32_t j);
  void query_about(const Ends& e);
  void query_at_jump(std::uint32_t s, std::uint32_t other);
  bool is_continuous(const Ends& e);
  std::vector<std::uint32_t> take_queried();

  const Walks& walks_;
  Order order_;
  Candidates candidates_;
  int threads_;
  std::vector<Section> sections_;
  std::vector<std::uint32_t> first_section_;  // per site, and one more
  std::vector<std::vector<Piece>> rows_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> queried_;
  std::vector<std::uint8_t> full_;  // per site: all others are candidates, or would have to be
};

}  // namespace dymsum::shape

// Windows of positions - scales or angles - in which frames are made, with all that these look at and know: those that
// were left are kept, and the next one is made ahead. Positions are those of one family: scales of one ratio, say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "base/around_forks.h"
#include "base/memory_budget.h"
#include "base/poll.h"

namespace dymsum::planar {

class FrameWindow {
 public:
  explicit FrameWindow(std::uint64_t family = 0) : family_(family) {}
  FrameWindow(const FrameWindow&) = delete;
  FrameWindow& operator=(const FrameWindow&) = delete;
  virtual ~FrameWindow() = default;

  bool serves(std::uint64_t family, double at) const { return family == family_ && covers(at); }
  /// Whether frames at a position of its family are made here.
  virtual bool covers(double at) const = 0;
  /// The position at which it ends for a motion that goes up, or down.
  virtual double end(bool up) const = 0;
  virtual std::size_t bytes() const = 0;

 private:
  std::uint64_t family_;
};

/// What lists hold, with the room that they have.
template <class... Lists>
std::size_t bytes_of(const Lists&... lists) {
  return (std::size_t{0} + ... + (lists.capacity() * sizeof(typename Lists::value_type)));
}

/// Makes a window, on any thread, from what never changes. Nothing where that would cost too much, or is stopped.
using MakeWindow = std::function<std::unique_ptr<FrameWindow>(const base::StopToken&)>;

/// The candidates of every piece of a window.
struct CandidateIndex {
  base::CountedArray<std::uint32_t> first_of, of;  ///< those of piece i are of[first_of[i] .. first_of[i + 1])

  /// Candidates have pieces `a` and `b`.
  template <class Candidates>
  void index(const Candidates& candidates, std::size_t pieces) {
    first_of.assign(pieces + 1, 0);
    for (const auto& c : candidates) {
      ++first_of[c.a + 1];
      ++first_of[c.b + 1];
    }
    for (std::size_t i = 0; i < pieces; ++i) first_of[i + 1] += first_of[i];
    of.resize(first_of[pieces]);
    std::vector<std::uint32_t> fill(first_of.begin(), first_of.end() - 1);
    for (std::uint32_t c = 0; c < candidates.size(); ++c) {
      of[fill[candidates[c].a]++] = c;
      of[fill[candidates[c].b]++] = c;
    }
  }
};

/// Windows that were left, for when the motion comes back.
class KeptWindows {
 public:
  /// The most recently used one that covers a position of a family; it is kept no longer. None: nothing.
  std::unique_ptr<FrameWindow> take(std::uint64_t family, double at);
  bool covers(std::uint64_t family, double at) const;
  /// Keeps one. The least recently used ones go until all of them hold at most `most_bytes`.
  void keep(std::unique_ptr<FrameWindow> window, std::uint64_t most_bytes);
  std::uint64_t bytes() const { return bytes_; }
  std::size_t size() const { return windows_.size(); }

 private:
  struct Kept {
    std::unique_ptr<FrameWindow> window;
    std::uint64_t bytes = 0;
  };
  std::list<Kept> windows_;  // the most recently used first
  std::uint64_t bytes_ = 0;
};

/// A window that is made on a thread of its own while frames go on. What it becomes does not depend on when it is
/// ready. Used by one thread, except for the work itself. The thread that does it is started with the first window, and
/// waits for the next one: waking it costs a frame less than starting one. Destroying this stops the work and waits
/// until it has stopped. Around a fork the work rests: what was done for the window is lost, and the parent begins it
/// again. A child has no thread, so no window is under way there until one is started.
class WindowAhead final : private base::AroundForks {
 public:
  WindowAhead();
  ~WindowAhead();
  WindowAhead(const WindowAhead&) = delete;
  WindowAhead& operator=(const WindowAhead&) = delete;

  /// Requires: not busy.
  void start(MakeWindow make);
  /// A window is under way, or waits to be taken.
  bool busy() const { return busy_; }
  bool ready() const;
  /// Takes the window, or nothing where it would have cost too much; waits until it is ready. Requires: busy.
  std::unique_ptr<FrameWindow> take();

 private:
  void before_fork() override;
  void after_fork_in_parent() override;
  void after_fork_in_child() override;

  struct Worker;
  /// Starts the thread. False where memory or threads have run out.
  bool begin();

  bool busy_ = false;
  std::unique_ptr<Worker> worker_;  // nothing: no window comes of what was started
};

}  // namespace dymsum::planar

// The move that all moving sums share, on a motion without a motion: a window is a range of numbers, and every frame is
// the same sum.
#include "planar/frame/moving_sum.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <thread>

#include "dymsum/shapes.h"
#include "planar/motion/operand_pair.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

struct Range final : FrameWindow {
  Range(double low, double high) : low(low), high(high) {}
  bool covers(double at) const override { return at > low && at < high; }
  double end(bool up) const override { return up ? high : low; }
  std::size_t bytes() const override { return 100; }
  double low, high;
};

class Still final : public MovingSum {
 public:
  explicit Still(MovingOptions options) : MovingSum(std::move(options)) {}

  Result<FrameChanges> move_to(double to) {
    Move next;
    next.at = to;
    next.stays = to == at_;
    next.step = to - at_;
    next.widest = 1;
    next.requested = options.window;
    Result<FrameChanges> changes = move(next);
    if (changes) at_ = to;
    return changes;
  }

  bool undecided = false;  // frames inside the window fail
  bool too_expensive = false;
  bool followed = false;
  std::uint64_t identity = 0;  // of the one ring, as loops would keep it
  int built() const { return making_->built; }
  void make_for_ever(bool on = true) { making_->never_ready = on; }  // until it is stopped
  void wait_until_begun(int times) const {
    while (making_->begun < times) std::this_thread::yield();
  }
  int entered = 0, dropped = 0;
  double at_ = 0;

 private:
  PlacedPair placed(const Move&) const override { return pair_->placed_on_lattice(pair_->lattice); }
  MakeWindow window_for(const Move& to, const WindowController::Choice& reach) override {
    return maker(to.at - reach.behind, to.at + reach.ahead);
  }
  MakeWindow window_from(double end, const Move& to, double width) override {
    return to.step > 0 ? maker(end - 0.01, end + width) : maker(end - width, end + 0.01);
  }
  MakeWindow maker(double low, double high) {
    return [making = making_, low, high,
            nothing = too_expensive](const base::StopToken& stop) -> std::unique_ptr<FrameWindow> {
      if (nothing) return nullptr;
      ++making->begun;
      while (making->never_ready && !stop.stop_requested()) std::this_thread::yield();
      if (stop.stop_requested()) return nullptr;
      ++making->built;
      return std::make_unique<Range>(low, high);
    };
  }
  void window_changes(FrameWindow* next) override {
    entered += next != nullptr;
    dropped += next == nullptr;
  }
  std::optional<NextFrame> window_frame(const Move& to, FrameWork&) override {
    if (undecided) return std::nullopt;
    NextFrame next;
    next.sum = *placed_sum(placed(to), {});
    next.followed = followed;
    next.identities = {&identity};
    return next;
  }
  double cost_of(const FrameWork& done) override { return done.rebuilt ? 100 : 1; }
  double cost_of_window() const override { return 10; }

  struct Making {  // outlives this, as the thread does
    std::atomic<int> begun = 0, built = 0;
    std::atomic<bool> never_ready = false;
  };
  std::shared_ptr<Making> making_ = std::make_shared<Making>();
  std::shared_ptr<const OperandPair> pair_ =
      *pair_of_regions(shapes::rectangle(0, 0, 2, 1), shapes::rectangle(0, 0, 1, 3), PairOptions{.moved = 1});
};

MovingOptions with(FrameMode mode, double window = 0) {
  MovingOptions options;
  options.mode = mode;
  options.window = window;
  return options;
}

TEST(MovingSum, a_window_serves_until_its_end) {
  Still sum(with(FrameMode::window, 0.5));
  for (const double to : {0.1, 0.2, 0.3}) ASSERT_TRUE(sum.move_to(to).ok());
  EXPECT_EQ(sum.built(), 1);
  EXPECT_FALSE(sum.work.new_window);
  EXPECT_FALSE(sum.work.rebuilt);
  ASSERT_TRUE(sum.move_to(2).ok());
  EXPECT_EQ(sum.built(), 2);
  EXPECT_TRUE(sum.work.new_window);
}

TEST(MovingSum, rebuilding_opens_no_window) {
  Still sum(with(FrameMode::rebuild));
  for (const double to : {0.1, 0.2, 0.3}) {
    ASSERT_TRUE(sum.move_to(to).ok());
    EXPECT_TRUE(sum.work.rebuilt);
  }
  EXPECT_EQ(sum.built(), 0);
}

TEST(MovingSum, what_a_window_does_not_decide_is_rebuilt_and_the_window_stays) {
  Still sum(with(FrameMode::window, 0.5));
  ASSERT_TRUE(sum.move_to(0.1).ok());
  const PlanarSum before = sum.sum;
  sum.undecided = true;
  ASSERT_TRUE(sum.move_to(0.2).ok());
  EXPECT_TRUE(sum.work.rebuilt);
  EXPECT_TRUE(sum.sum == before);
  sum.undecided = false;
  ASSERT_TRUE(sum.move_to(0.3).ok());
  EXPECT_FALSE(sum.work.rebuilt);
  EXPECT_EQ(sum.built(), 1);
  EXPECT_EQ(sum.dropped, 0);
}

TEST(MovingSum, windows_that_would_cost_too_much_are_left) {
  Still sum(with(FrameMode::window, 0.5));
  sum.too_expensive = true;
  ASSERT_TRUE(sum.move_to(0.1).ok());
  EXPECT_TRUE(sum.work.rebuilt);
  EXPECT_FALSE(sum.work.new_window);
}

TEST(MovingSum, windows_that_were_left_are_entered_again) {
  Still sum(with(FrameMode::window, 0.5));
  for (const double to : {0.1, 2.0, 4.0, 2.1, 0.2, 4.1}) ASSERT_TRUE(sum.move_to(to).ok());
  EXPECT_EQ(sum.built(), 3);
  EXPECT_EQ(sum.entered, 6);
  EXPECT_EQ(sum.kept_windows().size(), 2u);
  EXPECT_EQ(sum.kept_windows().bytes(), 200u);
}

TEST(MovingSum, the_least_recently_used_window_goes_first) {
  MovingOptions options = with(FrameMode::window, 0.5);
  options.kept_window_bytes = 250;
  Still sum(options);
  for (const double to : {0.1, 2.0, 4.0, 0.2, 6.0}) ASSERT_TRUE(sum.move_to(to).ok());
  EXPECT_EQ(sum.built(), 4);
  EXPECT_EQ(sum.kept_windows().size(), 2u) << "those of 0.1 and 4, for 2 was left earlier";
  for (const double to : {4.1, 0.1}) ASSERT_TRUE(sum.move_to(to).ok());
  EXPECT_EQ(sum.built(), 4);
  ASSERT_TRUE(sum.move_to(2.1).ok());
  EXPECT_EQ(sum.built(), 5);
}

TEST(MovingSum, the_next_window_is_made_ahead_on_one_thread_for_all) {
  MovingOptions options;
  options.threads = 2;
  Still sum(options);
  ASSERT_TRUE(sum.move_to(0.01).ok());
  EXPECT_TRUE(sum.work.rebuilt) << "no frame waits";
  for (int k = 2; k < 60; ++k) {
    sum.finish_window_ahead();
    ASSERT_TRUE(sum.move_to(0.01 * k).ok());
    EXPECT_FALSE(sum.work.rebuilt) << k;
    EXPECT_FALSE(sum.work.new_window) << k;
  }
  EXPECT_GT(sum.entered, 3);
}

TEST(MovingSum, a_window_under_way_is_stopped_with_the_sum) {
  MovingOptions options;
  options.threads = 2;
  Still sum(options);
  sum.make_for_ever();
  for (const double to : {0.01, 0.02, 0.03}) {
    ASSERT_TRUE(sum.move_to(to).ok());
    EXPECT_TRUE(sum.work.rebuilt);
  }
  EXPECT_EQ(sum.built(), 0);
}

/// What `child` returns in a forked process.
template <class Child>
int status_of_child(Child&& child) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::alarm(20);
    ::_exit(child());
  }
  int status = 0;
  EXPECT_EQ(::waitpid(pid, &status, 0), pid);
  return status;
}

// The thread that makes windows is not there in a child.
TEST(MovingSum, a_forked_child_destroys_a_sum_that_makes_windows_ahead) {
  MovingOptions options;
  options.threads = 2;
  for (const bool never_ready : {false, true}) {
    auto sum = std::make_unique<Still>(options);
    sum->make_for_ever(never_ready);
    ASSERT_TRUE(sum->move_to(0.01).ok());
    sum->wait_until_begun(1);
    EXPECT_EQ(status_of_child([&] {
                sum = nullptr;
                return 0;
              }),
              0);
  }
}

TEST(MovingSum, a_forked_child_makes_windows_of_its_own) {
  MovingOptions options;
  options.threads = 2;
  for (const bool under_way : {false, true}) {
    Still sum(options);
    sum.make_for_ever(under_way);
    ASSERT_TRUE(sum.move_to(0.01).ok());
    sum.wait_until_begun(1);
    if (!under_way) sum.finish_window_ahead();
    const PlanarSum before = sum.sum;
    EXPECT_EQ(status_of_child([&] {
                sum.make_for_ever(false);
                bool right = true;
                for (int k = 2; k < 60; ++k) {
                  right = right && sum.move_to(0.01 * k).ok() && sum.sum == before;
                  sum.finish_window_ahead();
                }
                return right && sum.entered > 3 ? 0 : 1;
              }),
              0);
  }
}

TEST(MovingSum, a_window_under_way_is_begun_again_behind_a_fork) {
  MovingOptions options;
  options.threads = 2;
  Still sum(options);
  sum.make_for_ever();
  ASSERT_TRUE(sum.move_to(0.01).ok());
  sum.wait_until_begun(1);
  EXPECT_EQ(status_of_child([] { return 0; }), 0);
  sum.wait_until_begun(2);
  EXPECT_EQ(sum.built(), 0);
  sum.make_for_ever(false);
  sum.finish_window_ahead();
  EXPECT_EQ(sum.built(), 1);
  ASSERT_TRUE(sum.move_to(0.02).ok());
  EXPECT_FALSE(sum.work.rebuilt);
}

TEST(MovingSum, nothing_changes_where_it_is_stopped) {
  Still sum(with(FrameMode::window, 0.5));
  ASSERT_TRUE(sum.move_to(0.1).ok());
  const std::vector<std::uint64_t> ids = sum.ring_ids;
  sum.options.progress = [](std::string_view, double) { return false; };
  const Result<FrameChanges> stopped = sum.move_to(3);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  EXPECT_EQ(sum.at_, 0.1);
  EXPECT_EQ(sum.ring_ids, ids);
  EXPECT_EQ(sum.built(), 1);
}

TEST(MovingSum, identities_go_from_sums_to_loops_and_back) {
  Still sum(with(FrameMode::window, 0.5));
  const FrameChanges first = *sum.move_to(0.1);
  ASSERT_EQ(first.rings.size(), 1u);
  EXPECT_EQ(first.rings[0].kind, RingChange::Kind::appeared);
  ASSERT_EQ(sum.ring_ids.size(), 1u);
  EXPECT_EQ(sum.identity, sum.ring_ids[0]) << "the loops are told";
  const FrameChanges second = *sum.move_to(0.2);
  EXPECT_EQ(second.rings, (std::vector<RingChange>{{RingChange::Kind::moved, sum.ring_ids[0], 0, 0}}));
  sum.followed = true;
  sum.identity = 77;
  EXPECT_TRUE(sum.move_to(0.3)->rings.empty()) << "the loops tell changes";
  EXPECT_EQ(sum.ring_ids, std::vector<std::uint64_t>{77});
}

TEST(MovingSum, a_frame_where_the_last_one_was_moves_no_ring) {
  Still sum(with(FrameMode::rebuild));
  ASSERT_TRUE(sum.move_to(0.1).ok());
  EXPECT_TRUE(sum.move_to(0.1)->rings.empty());
}

}  // namespace
}  // namespace dymsum::planar

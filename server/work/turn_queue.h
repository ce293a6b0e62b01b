#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>

namespace trc::server {

// What waits for a thread of the worker pool. Groups take turns, and within a group it is first
// come first served: who has many streams waits longer for each of them than who has one. Guarded
// by its owner.
class TurnQueue {
 public:
  class Job {
   public:
    // One batch of work. May end in the destruction of the job; must not throw.
    virtual void turn() noexcept = 0;

   protected:
    ~Job() = default;
  };
  class Group;

  // A turn that has begun and stands still.
  struct StandingTurn {
    std::condition_variable changed{};
    bool goes_on = false;
  };
  // A job whose turn has not begun, or a turn that stands still.
  struct WaitingTurn {
    Group* group = nullptr;
    Job* job = nullptr;
    StandingTurn* standing = nullptr;
    std::chrono::steady_clock::time_point since{};
  };

  // What is treated as one; must live as long as something of it waits.
  class Group {
   public:
    [[nodiscard]] std::size_t standing() const { return standing_; }

   private:
    friend class TurnQueue;
    std::deque<WaitingTurn> waiting_{};
    std::size_t standing_ = 0;
  };

  // Turns that stand still keep threads, of which there are so many. A group may have as many as
  // it leaves to others, so that whoever comes later still begins; the last ones are for groups
  // that have none.
  static constexpr std::size_t most_standing = 256;
  static constexpr std::size_t most_standing_of_one_group = 96;

  void push(const WaitingTurn& waiting) {
    Group& group = *waiting.group;
    group.waiting_.push_back(waiting);
    if (group.waiting_.size() == 1) {
      try {
        turns_.push_back(&group);
      } catch (...) {
        group.waiting_.pop_back();
        throw;
      }
    }
    ++size_;
    if (waiting.standing == nullptr) return;
    ++group.standing_;
    ++standing_;
  }

  // The next one; not of an empty queue.
  WaitingTurn pop() {
    for (auto group = turns_.begin(); group != turns_.end(); ++group) {
      auto& waiting = (*group)->waiting_;
      auto next = waiting.begin();
      if (!may_begin(**group)) next = std::find_if(waiting.begin(), waiting.end(), is_standing);
      if (next != waiting.end()) return take(group, next);
    }
    return take(turns_.begin(), turns_.front()->waiting_.begin());
  }
  // The next one that stands still; there must be one.
  WaitingTurn pop_standing() {
    for (auto group = turns_.begin(); group != turns_.end(); ++group) {
      auto& waiting = (*group)->waiting_;
      const auto next = std::find_if(waiting.begin(), waiting.end(), is_standing);
      if (next != waiting.end()) return take(group, next);
    }
    return {};
  }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  // Since when the one that waits longest does, now if there is none. What its own group keeps from
  // beginning does not count.
  [[nodiscard]] std::chrono::steady_clock::time_point oldest() const {
    auto oldest = std::chrono::steady_clock::now();
    for (const Group* group : turns_) {
      auto first = group->waiting_.begin();
      if (group->standing_ > 0 && !may_begin(*group))
        first = std::find_if(first, group->waiting_.end(), is_standing);
      if (first != group->waiting_.end()) oldest = std::min(oldest, first->since);
    }
    return oldest;
  }

 private:
  using Turns = std::list<Group*>;

  static bool is_standing(const WaitingTurn& waiting) { return waiting.standing != nullptr; }
  [[nodiscard]] bool may_begin(const Group& group) const {
    if (group.standing_ == 0) return standing_ < most_standing;
    return group.standing_ + standing_ < 2 * most_standing_of_one_group;
  }

  WaitingTurn take(Turns::iterator place, const std::deque<WaitingTurn>::iterator& next) {
    Group& group = **place;
    const WaitingTurn taken = *next;
    group.waiting_.erase(next);
    --size_;
    if (is_standing(taken)) {
      --group.standing_;
      --standing_;
    }
    // To the back of the round, or out of it.
    if (group.waiting_.empty())
      turns_.erase(place);
    else
      turns_.splice(turns_.end(), turns_, place);
    return taken;
  }

  Turns turns_;  // groups with something that waits
  std::size_t size_ = 0;
  std::size_t standing_ = 0;
};

}  // namespace trc::server

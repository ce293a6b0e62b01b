#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "proto/wire/field_fault.h"

namespace trc::wire {

// Walks along a column that holds one value for each block of a sort, or a single
// one for all of them. A column of another length is a fault.
template <class Field>
class Spread {
 public:
  Spread(const Field& values, std::string_view name, std::size_t expected, const FieldPath& path,
         FieldFaults& faults)
      : values_(values), single_(values.size() == 1) {
    const auto size = static_cast<std::size_t>(values.size());
    if (size == expected || (size == 1 && expected > 1)) return;
    add_fault(FieldPath(path, name),
              "has " + std::to_string(size) + " values, expected are " + std::to_string(expected) +
                  " or one for all",
              faults);
  }
  auto next() { return values_.begin()[single_ ? 0 : next_++]; }

 private:
  const Field& values_;
  bool single_;
  int next_ = 0;
};

// Walks along the starts of a column: one for each block, or the first one only
// when every block starts where the one before it ends.
template <class Field>
class Starts {
 public:
  Starts(const Field& starts, std::string_view name, std::size_t expected, const FieldPath& path,
         FieldFaults& faults)
      : starts_(starts), chained_(starts.size() == 1) {
    const auto size = static_cast<std::size_t>(starts.size());
    if (size == expected || (size == 1 && expected > 1)) return;
    add_fault(FieldPath(path, name),
              "has " + std::to_string(size) + " values, expected are " + std::to_string(expected) +
                  " or the first one",
              faults);
  }
  // `end`: of the block this start belongs to.
  double next(double end) {
    const double start = chained_ && next_ > 0 ? last_end_ : starts_[chained_ ? 0 : next_];
    ++next_;
    last_end_ = end;
    return start;
  }

 private:
  const Field& starts_;
  bool chained_;
  int next_ = 0;
  double last_end_ = 0;
};

// Walks along a list whose entries stand at positions, in order of position.
template <class List>
class Sparse {
 public:
  explicit Sparse(const List& list) : list_(list) {}
  // The entry at this position; null when there is none.
  const typename List::value_type* at(std::size_t index) {
    if (used_up() || list_.Get(next_).index() != index) return nullptr;
    return &list_.Get(next_++);
  }
  [[nodiscard]] bool used_up() const { return next_ == list_.size(); }

 private:
  const List& list_;
  int next_ = 0;
};

}  // namespace trc::wire

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trc::wire {

// A field of a message that cannot be taken as it is.
struct FieldFault {
  std::string field{};        // path and index, "batch.blocks[3].linear.end.x"
  std::string description{};  // what is wrong and what is allowed, one sentence

  bool operator==(const FieldFault&) const = default;
};

// The faults found in one message, in the order of its fields.
class FieldFaults {
 public:
  // More are only counted: a status travels in trailers of 8 KB.
  static constexpr std::size_t most_listed = 20;

  void add(FieldFault fault) {
    if (listed_.size() < most_listed) listed_.push_back(std::move(fault));
    ++count_;
  }

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::vector<FieldFault>& listed() const { return listed_; }

 private:
  std::vector<FieldFault> listed_;
  std::size_t count_ = 0;
};

// Where a field stands in its message. Lives on the stack of the function that
// reads the field, so that a message without faults costs no text.
class FieldPath {
 public:
  explicit FieldPath(std::string_view name) : name_(name) {}
  FieldPath(const FieldPath& parent, std::string_view name) : parent_(&parent), name_(name) {}
  FieldPath(const FieldPath& parent, std::string_view name, std::size_t index)
      : parent_(&parent), name_(name), index_(index), indexed_(true) {}

  // "batch.blocks[3].linear"
  [[nodiscard]] std::string text() const;

 private:
  const FieldPath* parent_ = nullptr;
  std::string_view name_;
  std::size_t index_ = 0;
  bool indexed_ = false;
};

void add_fault(const FieldPath& path, std::string description, FieldFaults& faults);

// Where a message is being read, and where its faults go.
struct FieldReader {
  const FieldPath& path;
  FieldFaults& faults;
};

// What is allowed; the unit "" where there is none.
struct FieldRange {
  double low = 0;
  double high = 0;
  std::string_view unit{};
  bool low_is_allowed = true;
};
// Of a value that is not in the range.
void add_range_fault(double value, const FieldRange& range, const FieldPath& path,
                     FieldFaults& faults);

// Each returns whether the value can be taken, else adds a fault that names the
// value and the range. NaN and infinities are in no range.
inline bool check_range(double value, const FieldRange& range, const FieldPath& path,
                        FieldFaults& faults) {
  if (value >= range.low && value <= range.high && (range.low_is_allowed || value > range.low))
    return true;
  add_range_fault(value, range, path, faults);
  return false;
}
// Greater than `low`, at most `high`.
inline bool check_above(double value, FieldRange range, const FieldPath& path,
                        FieldFaults& faults) {
  range.low_is_allowed = false;
  return check_range(value, range, path, faults);
}

}  // namespace trc::wire

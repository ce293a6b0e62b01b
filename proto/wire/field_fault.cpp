#include "proto/wire/field_fault.h"

#include <cmath>
#include <utility>

#include "core/base/number_text.h"

namespace trc::wire {
namespace {

std::string number_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  return shortest(value);
}

std::string with_unit(double value, std::string_view unit) {
  std::string text = number_text(value);
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

}  // namespace

std::string FieldPath::text() const {
  std::string text = parent_ == nullptr ? std::string() : parent_->text();
  if (!text.empty()) text += '.';
  text += name_;
  if (indexed_) text.append("[").append(std::to_string(index_)).append("]");
  return text;
}

void add_fault(const FieldPath& path, std::string description, FieldFaults& faults) {
  faults.add({.field = path.text(), .description = std::move(description)});
}

void add_range_fault(double value, const FieldRange& range, const FieldPath& path,
                     FieldFaults& faults) {
  const std::string from = range.low_is_allowed ? "" : "above ";
  add_fault(path,
            "is " + number_text(value) + ", allowed is " + from + number_text(range.low) + " to " +
                with_unit(range.high, range.unit),
            faults);
}

}  // namespace trc::wire

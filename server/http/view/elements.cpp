#include "server/http/view/elements.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trc::server::http {

void Elements::add(Element element, const Segment& shape) {
  element.start = start_of(shape);
  element.end = end_of(shape);
  if (const auto* arc = std::get_if<Arc>(&shape)) {
    element.arc = static_cast<std::int32_t>(arcs_.size());
    arcs_.push_back({.center = arc->center, .sweep = arc->sweep});
  }
  elements_.push_back(element);
}

void Elements::index() {
  elements_.shrink_to_fit();
  arcs_.shrink_to_fit();
  groups_.clear();
  bounds_ = {};
  length_ = 0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (i % group_size == 0) groups_.push_back({.length = length_});
    const Segment shape = shape_of(elements_[i]);
    groups_.back().box.add(shape);
    groups_.back().has_special = groups_.back().has_special || elements_[i].is_special();
    length_ += length_of(elements_[i]);
  }
  for (const Group& group : groups_) {
    bounds_.add(group.box.low);
    bounds_.add(group.box.high);
  }
}

Segment Elements::shape_of(const Element& element) const {
  if (element.arc < 0) return Line{.start = element.start, .end = element.end};
  const ElementArc& arc = arcs_[static_cast<std::size_t>(element.arc)];
  return Arc{.start = element.start, .end = element.end, .center = arc.center, .sweep = arc.sweep};
}

std::size_t Elements::bytes() const {
  return elements_.capacity() * sizeof(Element) + arcs_.capacity() * sizeof(ElementArc) +
         groups_.capacity() * sizeof(Group);
}

double Elements::length_of(const Element& element) const {
  return std::hypot(trc::length_of(shape_of(element)),
                    static_cast<double>(element.third_to - element.third_from));
}

std::optional<Elements::Place> Elements::place_after(double length) const {
  if (elements_.empty()) return std::nullopt;
  const auto behind =
      std::upper_bound(groups_.begin(), groups_.end(), length,
                       [](double at, const Group& group) { return at < group.length; });
  const auto group = behind == groups_.begin() ? behind : std::prev(behind);
  double left = length - group->length;
  auto at = static_cast<std::size_t>(group - groups_.begin()) * group_size;
  for (;; ++at) {
    const double own = length_of(elements_[at]);
    if (left <= own || at + 1 == elements_.size())
      return Place{.element = at, .share = own > 0 ? std::clamp(left / own, 0.0, 1.0) : 1};
    left -= own;
  }
}

}  // namespace trc::server::http

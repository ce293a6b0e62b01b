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
  if (size_ % piece_size == 0) pieces_.emplace_back().reserve(piece_size);
  if (size_ % group_size == 0) groups_.push_back({.length = length_});
  Group& group = groups_.back();
  if (element.from_unknown)
    group.box.add(element.end);
  else
    group.box.add(shape);
  group.has_special = group.has_special || element.is_special();
  length_ += length_of(element, shape);
  blocks_ += element.ends_block ? 1 : 0;
  if (size_ == 0) lowest_ = highest_ = element.third_from;
  lowest_ = std::min(lowest_, element.third_to);
  highest_ = std::max(highest_, element.third_to);
  pieces_.back().push_back(element);
  ++size_;
}

verify::Bounds Elements::bounds() const {
  verify::Bounds all;
  for (const Group& group : groups_) {
    all.add(group.box.low);
    all.add(group.box.high);
  }
  return all;
}

void Elements::restyle(std::size_t index, Style style) {
  Element& element = pieces_[index / piece_size][index % piece_size];
  element.style = style;
  Group& group = groups_[index / group_size];
  group.has_special = group.has_special || element.is_special();
}

Segment Elements::shape_of(const Element& element) const {
  if (element.arc < 0) return Line{.start = element.start, .end = element.end};
  const ElementArc& arc = arcs_[static_cast<std::size_t>(element.arc)];
  return Arc{.start = element.start, .end = element.end, .center = arc.center, .sweep = arc.sweep};
}

double Elements::length_of(const Element& element, const Segment& shape) {
  const double in_plane = trc::length_of(shape);
  const double across = static_cast<double>(element.third_to - element.third_from);
  return across == 0 ? in_plane : std::hypot(in_plane, across);
}

std::optional<Elements::Place> Elements::place_after(double length) const {
  if (empty()) return std::nullopt;
  const auto behind =
      std::upper_bound(groups_.begin(), groups_.end(), length,
                       [](double at, const Group& group) { return at < group.length; });
  const auto group = behind == groups_.begin() ? behind : std::prev(behind);
  double left = length - group->length;
  auto at = static_cast<std::size_t>(group - groups_.begin()) * group_size;
  for (;; ++at) {
    const double own = length_of((*this)[at], shape_of((*this)[at]));
    if (left <= own || at + 1 == size_)
      return Place{.element = at, .share = own > 0 ? std::clamp(left / own, 0.0, 1.0) : 1};
    left -= own;
  }
}

}  // namespace trc::server::http

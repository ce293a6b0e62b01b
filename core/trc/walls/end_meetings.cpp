#include "core/trc/walls/end_meetings.h"

#include <algorithm>
#include <optional>

#include "core/geometry/box_tree.h"
#include "core/trc/walls/contact.h"
#include "core/trc/walls/crossing_leads.h"
#include "core/trc/walls/long_leads.h"

namespace trc {
namespace {

// One of the first or the last blocks.
struct End {
  std::size_t number = 0;
  Segment path{};
  double before = 0;  // mm of contour between it and that end
};

using Ends = std::pmr::vector<End>;

Ends first_blocks(const ContourView& contour, double reach, std::pmr::memory_resource* memory) {
  Ends blocks(memory);
  double before = 0;
  for (std::size_t number = 0; number < contour.count; ++number) {
    if (number >= blocks_at_ends && before >= reach) break;
    contour.pass();
    blocks.push_back({number, contour.segment(number), before});
    before += length_of(blocks.back().path);
  }
  return blocks;
}

Ends last_blocks(const ContourView& contour, double reach, std::pmr::memory_resource* memory) {
  Ends blocks(memory);
  double behind = 0;
  for (std::size_t number = contour.count; number-- > 0;) {
    if (contour.count - number > blocks_at_ends && behind >= reach) break;
    contour.pass();
    blocks.push_back({number, contour.segment(number), behind});
    behind += length_of(blocks.back().path);
  }
  return blocks;
}

// The first blocks, found by place.
class NearEnds {
 public:
  explicit NearEnds(const Ends& ends) : ends_(ends) {
    if (ends.size() <= few) return;
    tree_.emplace();
    for (const End& block : ends) tree_->append(bounding_box(block.path));
  }

  // Calls visit(index) for each block within `reach` mm of the place.
  template <class Visit>
  void for_each_near(const Box& place, double reach, const Visit& visit) const {
    if (tree_) return tree_->for_each_near(place, reach, visit);
    for (std::size_t index = 0; index < ends_.size(); ++index)
      if (squared_distance(bounding_box(ends_[index].path), place) <= reach * reach) visit(index);
  }

 private:
  // Up to this number, asking all is cheaper than a tree, and takes nothing from the heap.
  static constexpr std::size_t few = 24;

  const Ends& ends_;
  std::optional<BoxTree> tree_{};
};

}  // namespace

std::pmr::vector<EndsMeeting> meetings_of_ends(const ContourView& contour, double closing_tolerance,
                                               double tool_radius, double length,
                                               std::pmr::memory_resource* memory) {
  const double reach = reach_of_ends * tool_radius;
  const Ends first = first_blocks(contour, reach, memory);
  const Ends last = last_blocks(contour, reach, memory);
  const double most = 0.5 * length + 2 * closing_tolerance + contour.tolerances.same_place;
  const NearEnds ends(first);
  std::pmr::vector<EndsMeeting> meetings(memory);
  std::pmr::vector<Contact> contacts(memory);
  for (const End& end : last) {
    const double of_end = length_of(end.path);
    ends.for_each_near(bounding_box(end.path), closing_tolerance, [&](std::size_t index) {
      const End& begin = first[index];
      contour.pass();
      const bool few = are_few_outside(contour, begin.number, end.number);
      if (begin.number > end.number || (!few && begin.before + end.before > most)) return;
      // Two lines that follow each other have nothing between them.
      if (begin.number + 1 >= end.number && !is_arc(begin.path) && !is_arc(end.path)) return;
      contacts.clear();
      find_contacts(begin.path, end.path, closing_tolerance, contacts);
      for (const Contact& contact : contacts) {
        if (begin.number == end.number && contact.along_second - contact.along_first < 0.5 * of_end)
          continue;
        const double before = begin.before + contact.along_first;
        const double behind = end.before + of_end - contact.along_second;
        if (!few && before + behind > most) continue;
        meetings.push_back({.first = {begin.number, contact.along_first},
                            .second = {end.number, contact.along_second},
                            .before = before,
                            .behind = behind,
                            .gap = contact.gap,
                            .point = contact.point});
      }
    });
  }
  std::sort(meetings.begin(), meetings.end(), [&](const EndsMeeting& a, const EndsMeeting& b) {
    contour.pass();
    return a.before != b.before ? a.before < b.before : a.behind < b.behind;
  });
  return meetings;
}

}  // namespace trc

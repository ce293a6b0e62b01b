#include "core/trc/walls/closing.h"

#include <algorithm>
#include <iterator>
#include <memory_resource>
#include <optional>
#include <vector>

#include "core/trc/walls/crossing_leads.h"
#include "core/trc/walls/end_meetings.h"
#include "core/trc/walls/entry_turns.h"
#include "core/trc/walls/extent.h"
#include "core/trc/walls/inward_search.h"
#include "core/trc/walls/long_leads.h"
#include "core/trc/walls/repeated_laps.h"
#include "core/trc/walls/rings.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

// Whether `inner` lies within `outer`: then leads begin and end, or cross, in the outer point.
bool lies_within(const Closing& inner, const Closing& outer, double same_place) {
  const auto is_before = [&](const ContourPlace& a, const ContourPlace& b) {
    return a.number != b.number ? a.number < b.number : a.along < b.along - same_place;
  };
  return is_before(outer.first, inner.first) && is_before(inner.second, outer.second);
}

using Meetings = std::pmr::vector<EndsMeeting>;

// Searches among the meetings that may close the contour.
template <class MayClose>
std::optional<Closing> search_inward(const ContourView& contour, const Meetings& meetings,
                                     double tolerance, double tool_radius, Overruns overruns,
                                     const MayClose& may_close) {
  std::pmr::memory_resource* const memory = meetings.get_allocator().resource();
  Meetings some(memory);
  std::ranges::copy_if(meetings, std::back_inserter(some), [&](const EndsMeeting& meeting) {
    return may_close(meeting) && !is_lead_across_walls(contour, meeting, tolerance, tool_radius);
  });
  return search_inward(contour, {.may_close = some, .all = meetings}, tolerance, overruns, memory);
}

std::optional<Closing> between_long_leads(const ContourView& contour, const Meetings& meetings,
                                          const Extent& all, double tolerance, double tool_radius) {
  return search_inward(contour, meetings, tolerance, tool_radius, Overruns::along_the_begin,
                       [&](const EndsMeeting& meeting) {
                         return is_between_long_leads(contour, meeting, all, tolerance,
                                                      tool_radius);
                       });
}

std::optional<Closing> closing_of_some(const ContourView& contour, std::size_t first,
                                       std::size_t end, double closing_tolerance,
                                       double tool_radius);

// For the same lap at several depths: the last lap, which no link follows, shows which part is the
// lap. It is needed where the links are longer than the lap, and where `known`, the closing of the
// whole contour, takes the last of two laps for an overrun of the first.
std::optional<Closing> closing_of_repeated(const ContourView& contour,
                                           const std::optional<Closing>& known,
                                           double closing_tolerance, double tool_radius) {
  const auto repeated = repeated_laps(contour);
  if (!repeated) return std::nullopt;
  auto closing =
      closing_of_some(contour, repeated->last, contour.count, closing_tolerance, tool_radius);
  if (!closing) return std::nullopt;
  const auto length_between = [&](ContourPlace from, const ContourPlace& to) {
    double length = to.along - from.along;
    for (; from.number < to.number; ++from.number) {
      contour.pass();
      length += length_of(contour.segment(from.number));
    }
    return length;
  };
  const double lap = length_between(closing->first, closing->second);
  const auto in_lap_before = [&](ContourPlace place, std::size_t blocks) {
    place.number -= blocks;
    return place;
  };
  const ContourPlace first = in_lap_before(closing->first, repeated->last);
  const bool is_lap_for_overrun = known && known->overrun && known->first.number >= first.number &&
                                  length_between(first, known->first) >= 0.5 * lap;
  const bool has_long_links =
      2 * lap <= length_between(in_lap_before(closing->first, repeated->blocks), closing->first);
  if (!is_lap_for_overrun && !has_long_links) return std::nullopt;
  closing->first = first;
  if (closing->overrun)
    closing->overrun->first = in_lap_before(closing->overrun->first, repeated->last);
  closing->is_alone = false;
  closing->repeated_laps = repeated->last / repeated->blocks + 1;
  return closing;
}

std::optional<Closing> closing_of_all(const ContourView& contour, double closing_tolerance,
                                      double tool_radius) {
  Scratch scratch;
  std::pmr::memory_resource* const memory = scratch.memory();
  const Extent all = extent_of(contour);
  const auto meetings =
      meetings_of_ends(contour, closing_tolerance, tool_radius, all.length, memory);
  if (meetings.empty()) return std::nullopt;
  const auto search = [&](Overruns overruns) {
    return search_inward(contour, meetings, closing_tolerance, tool_radius, overruns,
                         [&](const EndsMeeting& meeting) {
                           return meeting.before + meeting.behind <= 0.5 * all.length;
                         });
  };
  auto closing = search(Overruns::along_the_begin);
  if (closing) {
    closing->is_alone = visits_of(contour, *closing, closing_tolerance, memory).size() == 2;
    if (!closing->is_alone) closing = search(Overruns::along_the_last_lap);
  }
  // Leads of few blocks may cross in one point, which then hides the laps.
  constexpr std::size_t few = 1000;
  if (!closing || !closing->is_alone || closing->overrun || contour.count <= few)
    if (auto repeated = closing_of_repeated(contour, closing, closing_tolerance, tool_radius))
      return repeated;
  auto long_leads = between_long_leads(contour, meetings, all, closing_tolerance, tool_radius);
  if (!closing ||
      (long_leads && lies_within(*long_leads, *closing, contour.tolerances.same_place) &&
       visits_of(contour, *closing, closing_tolerance, memory).size() == 2))
    return long_leads;
  return closing;
}

// The closing of some blocks of a contour, from `first` on and before `end`.
std::optional<Closing> closing_of_some(const ContourView& contour, std::size_t first,
                                       std::size_t end, double closing_tolerance,
                                       double tool_radius) {
  ContourView some = contour;
  some.count = end - first;
  some.segment = [&contour, first](std::size_t number) { return contour.segment(first + number); };
  some.role = nullptr;
  auto closing = closing_of_all(some, closing_tolerance, tool_radius);
  if (!closing) return std::nullopt;
  closing->first.number += first;
  closing->second.number += first;
  closing->joins += first;
  if (closing->overrun) {
    closing->overrun->first.number += first;
    closing->overrun->second.number += first;
  }
  return closing;
}

}  // namespace

std::optional<Closing> find_closing(const ContourView& contour, double closing_tolerance,
                                    double tool_radius) {
  if (const auto between = between_turns(contour, closing_tolerance)) {
    auto closing =
        closing_of_some(contour, between->first, between->end, closing_tolerance, tool_radius);
    if (closing && are_leads(contour, *between, *closing, closing_tolerance, tool_radius)) {
      closing->has_turns_in = between->first > 0;
      closing->has_turns_out = between->end < contour.count;
      return closing;
    }
  }
  return closing_of_all(contour, closing_tolerance, tool_radius);
}

std::optional<Closing> find_closing_of_long_leads(const ContourView& contour,
                                                  double closing_tolerance, double tool_radius) {
  Scratch scratch;
  const Extent all = extent_of(contour);
  const auto meetings =
      meetings_of_ends(contour, closing_tolerance, tool_radius, all.length, scratch.memory());
  return between_long_leads(contour, meetings, all, closing_tolerance, tool_radius);
}

}  // namespace trc

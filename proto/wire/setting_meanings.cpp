#include "proto/wire/setting_meanings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/tolerances.h"
#include "core/nc/dialect/trc_command.h"
#include "core/nc/state/tool_in_force.h"

namespace trc::wire {
namespace {

constexpr double largest_length = Tolerances{}.largest_coordinate;
constexpr double largest_radius = ToolInForce::largest_tool_radius;
constexpr double largest_count = std::numeric_limits<std::uint32_t>::max();

constexpr auto rows = std::to_array<SettingMeaning>({
    {"plane", "the plane of the contour", "", "xy"},
    {"start_position", "where the tool stands; coordinates that are left out are 0", "", "0,0,0"},
    {"start_position.x", "where the tool stands in X", "mm", "0", -largest_length, largest_length},
    {"start_position.y", "where the tool stands in Y", "mm", "0", -largest_length, largest_length},
    {"start_position.z", "where the tool stands in Z", "mm", "0", -largest_length, largest_length},
    {"tool_radius",
     "the size of the tool; negative: on the other side; with nominal_radius what the tool differs "
     "from that; without it a selection needs a D or T word",
     "mm", "", -largest_radius, largest_radius},
    {"selection_mode",
     "how the tool reaches and leaves the path; fanuc, linuxcnc and sinumerik begin with direct",
     "", "indirect"},
    {"transition",
     "what is inserted at outside corners; linuxcnc and sinumerik begin with circular", "",
     "linear"},
    {"contour_masking",
     "what becomes of contour that the tool cannot cut: off stops there, on leaves it out", "",
     "off"},
    {"feed_adaptation",
     "where the programmed feed holds: off at the tool centre, on at the contour; sinumerik begins "
     "with on",
     "", "off"},
    {"tangfeed_min_radius", "smallest radius of arcs on which G11 adapts the feed; 0: all", "mm",
     "0", 0, largest_length},
    {"min_feed_factor", "smallest factor that G11 puts on a feed", "", "0.01", 1e-6, 1},
    {"circle_center_mode.reference", "what circle centres I, J, K count from", "", "start"},
    {"circle_center_mode.correction",
     "whether the centre is moved where it does not fit the end point", "", "on"},
    {"circle_center_mode.max_shift", "G165: largest shift of a centre, else 20035", "mm", "2", 0,
     largest_length},
    {"circle_center_mode.max_shift_factor",
     "G165: largest shift of a centre as a share of the radius", "", "0.05", 0, 1},
    {"circle_center_mode.max_radius_difference",
     "G164: largest difference of start and end radius, else 21758", "mm", "0.1", 0,
     largest_length},
    {"circle_center_mode.max_radius_difference_factor",
     "G164: largest difference of both radii as a share of the radius", "", "0.01", 0, 1},
    {"circle_center_mode.warn_shift", "G165: a larger shift of a centre is told (900221)", "mm",
     "0.01", 0, largest_length},
    {"options.split.measure", "SPLIT: by the travel of an axis, by the path, or not at all", "",
     "off"},
    {"options.split.place", "SPLIT: at selection, at deselection, or at both", "", "pre"},
    {"options.split.axis", "SPLIT: the axis, 1 for X, 2 for Y, 3 for Z", "", "", 1, 3},
    {"look_ahead_blocks", "window of contour masking in blocks; 0: the whole selection", "", "0", 0,
     largest_count},
    {"implicit_contour_masking",
     "look for contour violations as G141 does, and stop at the first one", "", "false"},
    {"kerf_method", "how KERF_MASKING finds the points it moves: lines alone, or arcs as well", "",
     "circular"},
    {"axis_names", "the axes beside X, Y and Z, at most 32", "", "A,B,C,U,V,W"},
    {"max_passive_blocks", "most blocks without motion in a row (90011); not isg: 10000", "", "100",
     1, 10'000},
    {"response_layout", "how blocks travel from the server; both hold the same", "", "blocks"},
    {"include_inverse_path", "also the contour that is recovered from the path", "", "false"},
    {"client_tag", "a word for the log of the server, at most 64 printable characters", "", ""},
    {"want_resume_tokens", "ask for what a lost stream is resumed with; trc does so itself", "",
     "false"},
    {"verify",
     "measure the path: report warns of what comes too near (900216), enforce refuses it; "
     "compensate "
     "and plot report",
     "", "off"},
    {"leads", "which blocks of a contour are leads and bound no material", "", "auto"},
    {"leads.find", "how leads are found", "", "auto"},
    {"leads.blocks_in", "leads after the approach block, with leads.find=blocks", "", "0", 0,
     largest_count},
    {"leads.blocks_out", "leads before the retract block, with leads.find=blocks", "", "0", 0,
     largest_count},
    {"closing_tolerance", "up to here the end of a contour meets its start", "mm", "0.01", 0, 1},
    {"max_masked_share",
     "largest share of the wall of a selection that may be left out, in one stretch or in all "
     "those "
     "longer than 10 tool radii (900218)",
     "", "0.5", 0, 1},
    {"input_resolution", "how finely the program is written; less counts as touching", "mm",
     "0.001", 0, 0.1},
    {"allowance", "stock that is left on the part; negative: cuts deeper", "mm", "0",
     -largest_radius, largest_radius},
    {"nominal_radius",
     "the tool whose centre path the program is; without it the program is the contour", "mm", "",
     1e-4, largest_radius},
    {"max_wear", "a larger wear is refused (900222)", "mm", "1", 0, largest_radius},
    {"wear", "what the tool is larger by; negative: worn off; max_wear allows more than 1", "mm",
     "0", -largest_radius, largest_radius},
    {"language", "of messages, en or de", "", "en"},
    {"block_skip",
     "lines with /, as the switch of the machine stands: execute is off, leave_out on; refuse "
     "what hangs on it (900017)",
     "", "refuse"},
    {"pass_words",
     "words unknown here that say nothing about the path, as POPEN,G777: they pass, also in a "
     "contour",
     "", ""},
    {"encoding", "bytes in comments: utf8 alone (900007), latin1 and auto any; isg utf8, else auto",
     "", ""},
    {"renumber", "number the blocks anew, also those that are inserted", "", "false"},
    {"max_executed_lines", "lines that a program with loops and calls executes at most (900301)",
     "", "10000000", 1, 1e9},
    {"tools", "the tools of D words, and of T words in a program without D", "", ""},
    {"variables", "what variables hold that the program does not set itself", "", ""},
});

// The meanings of options, made from those of the #TRC words.
const std::map<std::string, SettingMeaning, std::less<>>& option_rows() {
  static const auto made = [] {
    static std::vector<std::string> initials;
    initials.reserve(trc_keywords().size());
    std::map<std::string, SettingMeaning, std::less<>> found;
    for (const TrcKeyword& keyword : trc_keywords()) {
      std::string name(keyword.name);
      std::transform(name.begin(), name.end(), name.begin(),
                     [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
      const bool of_split = keyword.meaning.starts_with("SPLIT:");
      const bool is_switch = keyword.smallest == 0 && keyword.largest == 1;
      const auto whole = static_cast<int>(keyword.initial);
      initials.push_back(is_switch ? (whole != 0 ? "true" : "false") : std::to_string(whole));
      SettingMeaning row{
          .meaning = keyword.meaning, .unit = keyword.unit, .initial = initials.back()};
      if (!is_switch) {
        row.least = keyword.smallest;
        row.most = keyword.available ? keyword.largest : keyword.initial;
      }
      found.emplace((of_split ? "options.split." : "options.") + name, row);
    }
    return found;
  }();
  return made;
}

}  // namespace

const SettingMeaning& meaning_of(std::string_view key) {
  static const SettingMeaning none;
  const auto* const row =
      std::find_if(rows.begin(), rows.end(), [&](const auto& one) { return one.key == key; });
  if (row != rows.end()) return *row;
  const auto option = option_rows().find(key);
  return option == option_rows().end() ? none : option->second;
}

}  // namespace trc::wire

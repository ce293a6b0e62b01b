#include "core/nc/dialect/kept_modes.h"

#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

// M70 of LinuxCNC keeps the modes in force, M72 restores them, M71 forgets them (D-113).

namespace trc {
namespace {

constexpr int keeping = 70;
constexpr int bringing_back = 72;

}  // namespace

bool check_kept_modes(Reading& reading, ProgramLine& line, const BlockWords& block) {
  if (!block.kept_modes) return true;
  for (WordRange& word : line.words)
    if (word.begin == block.kept_modes->begin) word.role = WordRole::mode;
  const std::string function = "M" + std::to_string(static_cast<int>(block.kept_modes->value));
  const auto refused = [&](std::string_view why) {
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = block.kept_modes->begin,
                                          .detail = function + std::string(why)});
  };
  if (reading.contour_open()) return refused(" while TRC is active");
  if (block.words > 1) return refused(" beside other words: write it into a line of its own");
  if (block.to_skip) return refused(", modes that may be skipped");
  if (block.kept_modes->value == bringing_back && !reading.gcode.kept && reading.faults.empty())
    return refused(", modes as they were at M70, which is not there");
  return true;
}

bool apply_kept_modes(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  if (block.kept_modes->value == keeping) {
    reading.gcode.kept = KeptModes{.unit = reading.unit,
                                   .incremental = reading.incremental,
                                   .absolute_center = reading.state.absolute_center(),
                                   .feed_mode = reading.feed_mode,
                                   .feed = reading.feed,
                                   .plane = reading.state.programmed_plane(),
                                   .work_offset = reading.gcode.coordinates.offset_axes == 0
                                                      ? reading.gcode.coordinates.work_offset
                                                      : 0};
    return true;
  }
  if (block.kept_modes->value != bringing_back) {
    reading.gcode.kept.reset();
    return true;
  }
  const KeptModes& kept = *reading.gcode.kept;
  reading.count_in(line, kept.unit);
  if (kept.incremental && !reading.incremental) reading.state.count_increments_since(line.source);
  reading.incremental = kept.incremental;
  reading.state.set_absolute_center(kept.absolute_center);
  reading.feed_mode = kept.feed_mode;
  reading.gcode.feed_mode_line = line.source.line;
  reading.feed = kept.feed;
  // M72 also restores the work offset and the tool offset.
  constexpr std::array all{true, true, true};
  const bool stays = kept.work_offset != 0 &&
                     kept.work_offset == reading.gcode.coordinates.work_offset &&
                     reading.gcode.coordinates.offset_axes == 0;
  if (!stays) reading.state.forget_position(all, line.source);
  reading.gcode.coordinates.work_offset = kept.work_offset;
  reading.place(line, block.kept_modes->begin);
  return reading.state.set_plane(kept.plane, line.source);
}

}  // namespace trc

#include <string>

#include "core/nc/dialect/block_words.h"

// M70 of LinuxCNC keeps what is in force, M72 brings it back, M71 forgets it (D-113).

namespace trc {
namespace {

constexpr int keeping = 70;
constexpr int bringing_back = 72;

}  // namespace

// In a line of their own, outside of contours: how they count with other words of a line, and what
// G40 … G42 have to do with them, has to be read nowhere then.
bool Interpreter::check_kept_modes(ProgramLine& line, const BlockWords& block) {
  if (!block.kept_modes) return true;
  for (WordRange& word : line.words)
    if (word.begin == block.kept_modes->begin) word.role = WordRole::mode;
  const std::string function = "M" + std::to_string(static_cast<int>(block.kept_modes->value));
  const auto refused = [&](std::string_view why) {
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.kept_modes->begin,
                                  .detail = function + std::string(why)});
  };
  if (contour_open()) return refused(" while TRC is active");
  if (block.words > 1) return refused(" beside other words: write it into a line of its own");
  if (block.to_skip) return refused(", modes that may be skipped");
  if (block.kept_modes->value == bringing_back && !code_.kept && faults_.empty())
    return refused(", modes as they were at M70, which is not there");
  return true;
}

bool Interpreter::apply_kept_modes(const ProgramLine& line, const BlockWords& block) {
  if (block.kept_modes->value == keeping) {
    code_.kept = KeptModes{.inch = inch_,
                           .incremental = incremental_,
                           .absolute_center = absolute_center_,
                           .feed_mode = feed_mode_,
                           .feed = feed_,
                           .plane = state_.programmed_plane(),
                           .work_offset = code_.offset_axes == 0 ? code_.work_offset : 0};
    return true;
  }
  if (block.kept_modes->value != bringing_back) {
    code_.kept.reset();
    return true;
  }
  const KeptModes& kept = *code_.kept;
  count_in(line, kept.inch);
  if (kept.incremental && !incremental_) state_.count_increments_since(line.source);
  incremental_ = kept.incremental;
  absolute_center_ = kept.absolute_center;
  state_.set_absolute_center(absolute_center_);
  feed_mode_ = kept.feed_mode;
  code_.feed_mode_line = line.source.line;
  feed_ = kept.feed;
  // The work offset comes back too, and the offset of the tool.
  constexpr std::array all{true, true, true};
  const bool stays =
      kept.work_offset != 0 && kept.work_offset == code_.work_offset && code_.offset_axes == 0;
  if (!stays) state_.forget_position(all, line.source);
  code_.work_offset = kept.work_offset;
  place(line, block.kept_modes->begin);
  return state_.set_plane(kept.plane, line.source);
}

}  // namespace trc

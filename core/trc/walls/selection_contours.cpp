#include "core/trc/walls/selection_contours.h"

#include <algorithm>

namespace trc {

std::vector<SelectionContour> contours_of(std::span<const Block> programmed) {
  std::vector<SelectionContour> contours;
  const TrcMode* before = nullptr;
  for (const Block& block : programmed) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || !motion->mode) continue;
    const TrcMode& mode = *motion->mode;
    if (!mode.active()) {
      before = nullptr;
      continue;
    }
    const bool begins = before == nullptr || before->selection_number != mode.selection_number;
    if (begins) contours.emplace_back();
    SelectionContour& contour = contours.back();
    const bool changes = !begins && before->side != mode.side;
    if (changes && !contour.blocks.empty()) contour.changes.push_back(contour.blocks.size());
    const bool leads_there = begins && mode.selection != Selection::perpendicular;
    if (!leads_there && (!changes || mode.options.reverse)) contour.blocks.push_back(motion);
    before = &mode;
  }
  for (SelectionContour& contour : contours)
    if (!contour.changes.empty() && contour.changes.back() == contour.blocks.size())
      contour.changes.pop_back();
  std::erase_if(contours, [](const SelectionContour& contour) { return contour.blocks.empty(); });
  return contours;
}

SidedWalls find_walls(const SelectionContour& contour, const LeadSettings& settings) {
  const std::vector<const MotionBlock*>& blocks = contour.blocks;
  double radius = 0;
  bool has_roles = false;
  for (const MotionBlock* block : blocks) {
    radius = std::max(radius, block->mode->cutting_radius());
    has_roles = has_roles || block->role != ContourRole::unspecified;
  }
  ContourView view{.count = blocks.size(),
                   .segment = [&](std::size_t number) { return blocks[number]->path; },
                   .tool_side = blocks.front()->mode->cutting_side()};
  if (has_roles) view.role = [&](std::size_t number) { return blocks[number]->role; };
  return find_walls(view, contour.changes, settings, radius);
}

}  // namespace trc

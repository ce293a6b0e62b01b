#include "core/verify/clearance.h"

#include <cstdint>
#include <optional>
#include <variant>

#include "core/verify/crossed_walls.h"
#include "core/verify/measure_selection.h"
#include "core/verify/selection_walls.h"

namespace trc::verify {
namespace {

// The place after the last piece of the selection that begins at `begin`. Rule numbers only rise.
std::size_t end_of_selection(const MeasuredPath& held, std::size_t begin, std::size_t end) {
  const auto selection_of = [&](std::size_t number) {
    return held.rule_of(held.programmed()[number]).selection;
  };
  const std::uint32_t selection = selection_of(begin);
  std::size_t behind = end;
  while (begin + 1 < behind) {
    const std::size_t middle = begin + (behind - begin) / 2;
    (selection_of(middle) == selection ? begin : behind) = middle;
  }
  return behind;
}

}  // namespace

void ClearanceReport::add(const ClearanceReport& other) {
  checked += other.checked;
  walls += other.walls;
  gouging += other.gouging;
  wall_length += other.wall_length;
  touched_length += other.touched_length;
  steps += other.steps;
  crossed.insert(crossed.end(), other.crossed.begin(), other.crossed.end());
  if (other.worst && (!worst || other.worst->margin() < worst->margin())) worst = other.worst;
  if (other.gouge && (!gouge || other.gouge->margin() < gouge->margin())) gouge = other.gouge;
}

ClearanceReport measure_clearance(const MeasuredPath& held, std::size_t end,
                                  const ClearanceSettings& settings, Checkpoint& checkpoint) {
  ClearanceReport report;
  const std::size_t all = held.path().end() - held.path().begin();
  if (settings.progress) settings.progress(0, all);
  std::size_t next = held.path().begin();
  for (std::size_t begin = held.programmed().begin(); begin < end;) {
    const std::size_t behind = end_of_selection(held, begin, end);
    std::optional<SelectionWalls> own;
    const SelectionWalls& walls =
        settings.known_walls != nullptr
            ? settings.known_walls->of(held, begin, behind, settings, checkpoint)
            : own.emplace(held, begin, behind, settings, checkpoint);
    const SelectionPieces selection{.held = held, .begin = begin, .end = behind, .walls = walls};
    const std::size_t first = next;
    ClearanceReport own_report = measure_selection(selection, next, settings, checkpoint);
    own_report.crossed = crossed_walls(selection, first, next, settings, checkpoint);
    report.add(own_report);
    begin = behind;
  }
  if (settings.progress) settings.progress(all, all);
  return report;
}

ClearanceReport measure_clearance(std::span<const Block> programmed,
                                  std::span<const CompensatedBlock> path, double allowed,
                                  const LeadSettings& leads) {
  return measure_clearance(programmed, path, {.allowed = allowed, .leads = leads});
}

ClearanceReport measure_clearance(std::span<const Block> programmed,
                                  std::span<const CompensatedBlock> path,
                                  const ClearanceSettings& settings) {
  MeasuredPath held;
  for (const Block& block : programmed) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion != nullptr && motion->mode && motion->mode->active()) held.add(*motion);
  }
  for (const CompensatedBlock& block : path) held.add(block);
  Checkpoint checkpoint({});
  return measure_clearance(held, held.programmed().end(), settings, checkpoint);
}

}  // namespace trc::verify

#include "client/cli/program_paths.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <map>
#include <string>
#include <string_view>

#include "client/cli/progress.h"
#include "client/cli/reporter.h"
#include "client/cli/verbose_text.h"
#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/session/contour_reader.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

bool is_inch(ContourReader& reader, const std::vector<Block>& blocks) {
  const MotionBlock* first = nullptr;
  for (const Block& block : blocks) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || !motion->mode) continue;
    if (first == nullptr || motion->mode->active()) first = motion;
    if (motion->mode->active()) break;
  }
  return first != nullptr && reader.is_inch(first->source.index);
}

// How far the middle of a path lies from the equidistant of the motion, and its end from the height
// of the motion's; mm.
double misfit(const CompensatedBlock& path, const MotionBlock& motion) {
  const Point middle = point_along(path.path, length_of(path.path) / 2);
  return std::abs(distance(middle, motion.path) - std::abs(motion.mode->cutting_radius())) +
         std::abs(path.normal.to - motion.normal.to);
}

// Whether nothing of the motion comes after this part of its path.
bool ends_with(const MotionBlock& motion, const CompensatedBlock& path) {
  constexpr double at_end = 1e-3;  // mm
  const double apart = (end_of(path.path) - end_of(motion.path)).norm();
  return std::abs(apart - std::abs(motion.mode->cutting_radius())) <= at_end;
}

// If a line has become several motions (a rounded corner, the arc of a lead), the service does not
// say which of them a block belongs to. This function takes the nearest, in their order.
void tell_parts(const std::vector<Block>& programmed, std::vector<CompensatedBlock>& path) {
  std::map<std::uint64_t, std::vector<const MotionBlock*>> motions_of_line;
  for (const Block& block : programmed)
    if (const auto* motion = std::get_if<MotionBlock>(&block); motion != nullptr && motion->mode)
      motions_of_line[motion->source.index].push_back(motion);
  std::erase_if(motions_of_line, [](const auto& line) { return line.second.size() < 2; });
  std::uint64_t line = Source{}.index;
  std::size_t at = 0;
  bool is_over = false;  // the motion there
  for (CompensatedBlock& block : path) {
    const auto found = motions_of_line.find(block.source.index);
    if (found == motions_of_line.end()) continue;
    const std::vector<const MotionBlock*>& motions = found->second;
    if (block.source.index != line) {
      at = 0;
      is_over = false;
    }
    line = block.source.index;
    if (block.origin == Origin::programmed) {
      const std::size_t next = at + (is_over && at + 1 < motions.size() ? 1 : 0);
      const auto nearest =
          std::min_element(motions.begin() + static_cast<std::ptrdiff_t>(next), motions.end(),
                           [&](const MotionBlock* a, const MotionBlock* b) {
                             return misfit(block, *a) < misfit(block, *b);
                           });
      at = static_cast<std::size_t>(nearest - motions.begin());
      is_over = ends_with(*motions[at], block);
    }
    block.source.part = motions[at]->source.part;
  }
}

}  // namespace

ProgramPaths read_paths(const ProgramOptions& options, v1::ProgramSetup setup, Input& input) {
  ProgramPaths paths;
  setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
  setup.mutable_path()->set_response_layout(v1::RESPONSE_LAYOUT_COLUMNS);
  wire::FieldFaults faults;
  const wire::ProgramSettings settings = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  // The service reports the fault of the setup. A contour read without that setup would differ.
  std::optional<ContourReader> reader;
  if (faults.empty()) reader.emplace(settings.path.session);
  paths.leads = settings.path.session.compensator.leads;
  paths.start = settings.path.session.program.start;
  input.watch([&](std::string_view text) {
    if (reader) reader->feed(text);
  });

  if (options.loudness.verbose) {
    paths.exit = tell_taken(input.name(), setup, options.service);
    if (paths.exit != Exit::done) return paths;
  }
  const auto began = std::chrono::steady_clock::now();
  Progress progress(Progress::Result::elsewhere, options.loudness, language_of(setup));
  Reporter reporter(input, setup, progress, options.loudness.quiet);
  const Outcome outcome =
      compensate_program(options.service, setup, input, reporter, [&](const Answer& answer) {
        paths.compensated.insert(paths.compensated.end(), answer.blocks.begin(),
                                 answer.blocks.end());
        paths.diagnostics.insert(paths.diagnostics.end(), answer.diagnostics.begin(),
                                 answer.diagnostics.end());
        return true;
      });
  paths.exit = outcome.exit;
  paths.summary = outcome.summary;
  if (options.loudness.verbose && outcome.summary)
    std::cerr << text_of_done(
        input.name(), *outcome.summary,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(),
        {.language = language_of(setup),
         .unit = counts_in_inch(options, setup) ? LengthUnit::inch : LengthUnit::mm});
  if (reader) {
    paths.programmed = reader->finish();
    paths.inch = is_inch(*reader, paths.programmed);
    tell_parts(paths.programmed, paths.compensated);
  }
  return paths;
}

}  // namespace trc::cli

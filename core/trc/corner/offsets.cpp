#include "core/trc/corner/offsets.h"

#include "core/geometry/parallel.h"

namespace trc {

PathBlock outline_of(const PathBlock& block) {
  PathBlock outline;
  outline.programmed.path = block.programmed.path;
  outline.programmed.mode = block.programmed.mode;
  outline.role = block.role;
  outline.at_start = block.at_start;
  outline.at_end = block.at_end;
  return outline;
}

void give_offsets(PathBlock& block) {
  const Segment& programmed = block.programmed.path;
  block.tangent_at_start = tangent_at_start(programmed);
  block.tangent_at_end = is_arc(programmed) ? tangent_at_end(programmed) : block.tangent_at_start;
  if (block.at_start.active)
    block.offset_start =
        parallel_point(start_of(programmed), block.tangent_at_start, block.at_start.shift);
  if (block.at_end.active)
    block.offset_end = parallel_point(end_of(programmed), block.tangent_at_end, block.at_end.shift);
}

}  // namespace trc

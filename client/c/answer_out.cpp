#include "client/c/answer_out.h"

#include <cstdint>
#include <variant>

#include "core/messages/diagnostic_text.h"
#include "proto/wire/compensated_block.h"

namespace trc::c {
namespace {

int word_of(Plane plane) { return plane == Plane::xy ? 17 : plane == Plane::zx ? 18 : 19; }

std::int32_t severity_of(Severity severity) {
  switch (severity) {
    case Severity::note:
      return TRC_NOTE;
    case Severity::warning:
      return TRC_WARNING;
    case Severity::error:
      break;
  }
  return TRC_ERROR;
}

}  // namespace

const trc_motion* AnswerOut::motion_of(const CompensatedBlock& block) {
  trc_motion& motion = motion_ = {};
  motion.size = sizeof motion;
  motion.origin = static_cast<std::int32_t>(wire::to_proto(block.origin));
  motion.plane = word_of(block.plane);
  motion.tangential = block.tangential ? 1 : 0;
  copy(from_plane(block.plane, start_of(block.path), block.normal.from), motion.start);
  copy(from_plane(block.plane, end_of(block.path), block.normal.to), motion.end);
  if (const auto* arc = std::get_if<Arc>(&block.path)) {
    motion.kind = arc->sweep < 0 ? TRC_CLOCKWISE : TRC_COUNTER_CLOCKWISE;
    copy(from_plane(block.plane, arc->center, block.normal.from), motion.center);
    motion.sweep = arc->sweep;
  } else {
    motion.kind = wire::is_text_alone(block) ? TRC_TEXT : block.rapid ? TRC_RAPID : TRC_LINE;
  }
  motion.feed = block.feed;
  motion.index = block.source.index;
  motion.number = block.source.number;
  motion.line = block.source.line;
  axis_start_.clear();
  axis_end_.clear();
  for (const AxisTravel& axis : block.tracking) {
    axis_start_.push_back(axis.from);
    axis_end_.push_back(axis.to);
  }
  motion.axis_count = static_cast<std::uint32_t>(axis_start_.size());
  motion.axis_start = axis_start_.data();
  motion.axis_end = axis_end_.data();
  motion.text = block.text.c_str();
  return &motion;
}

const trc_diagnostic* AnswerOut::diagnostic_of(const Diagnostic& found) {
  trc_diagnostic& diagnostic = diagnostic_ = {};
  diagnostic.size = sizeof diagnostic;
  diagnostic.code = static_cast<std::int32_t>(found.code);
  diagnostic.severity = severity_of(found.severity);
  diagnostic.index = found.source.index;
  diagnostic.number = found.source.number;
  diagnostic.line = found.source.line;
  diagnostic.column = found.column;
  texts_ = texts_of(found);
  diagnostic.reason = texts_.reason.c_str();
  diagnostic.title = texts_.title.c_str();
  diagnostic.text = texts_.text.c_str();
  diagnostic.help = texts_.help.c_str();
  diagnostic.detail = found.detail.c_str();
  values_.clear();
  for (const DiagnosticValue& value : found.values)
    values_.push_back({.name = value.name.c_str(), .value = value.value});
  diagnostic.values = values_.data();
  diagnostic.value_count = static_cast<std::uint32_t>(values_.size());
  if (found.point) {
    diagnostic.has_point = 1;
    copy({found.point->x, found.point->y, found.point->z}, diagnostic.point);
  }
  return &diagnostic;
}

}  // namespace trc::c

#include "core/nc/writer/writer_setup.h"

#include <algorithm>
#include <string>

namespace trc {

NcWriter::Setup writer_setup(const ProgramSetup& program, const Dialect& dialect) {
  const bool klartext = dialect.name == DialectName::heidenhain;
  // Decimals out of range are refused before anything is written.
  NcWriter::Setup writer{
      .decimals = std::clamp(program.decimals.value_or(default_decimals), 0, most_decimals - 1),
      .follows_decimals = !program.decimals,
      .limits = limits_of(dialect, program),
      .start = program.start,
      .motion = dialect.motion.value_or(MotionKind::rapid),
      .absolute_center = program.absolute_center || klartext,
      .plane = program.mode.plane,
      .unit = program.length_unit(),
      .spelling = {.points = dialect.writes_points, .klartext = klartext},
      .renumbers = program.renumbers};
  for (const std::string& axis : program.tracking_axes) {
    writer.tracking_letters += axis.size() == 1 ? axis.front() : '?';
    writer.tracking_names.push_back(axis.size() == 1 ? "" : axis);
  }
  return writer;
}

}  // namespace trc

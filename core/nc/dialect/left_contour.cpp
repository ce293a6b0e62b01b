#include "core/nc/dialect/left_contour.h"

#include <string>

namespace trc {

bool leave_contour(Reading& reading, const ProgramLine& line, const LineBesideContour& says) {
  if (says.copied) reading.state.have_left_contour(says.named);
  return !says.cuts || check_left_contour(reading, line, says.begin, says.named);
}

bool check_left_contour(Reading& reading, const ProgramLine& line, std::uint32_t begin,
                        const std::array<bool, 3>& named) {
  const auto& beside = reading.state.beside_contour();
  const char* const ended =
      reading.dialect.name == DialectName::heidenhain ? "R0 without motion" : "G40 without motion";
  for (std::size_t axis = 0; axis < beside.size(); ++axis)
    if (beside[axis] && !named[axis])
      return reading.refuse(line, TextFault{.code = Code::position_unknown,
                                            .begin = begin,
                                            .detail = std::string(1, "XYZ"[axis]) +
                                                      ", beside the contour since " + ended});
  return true;
}

}  // namespace trc

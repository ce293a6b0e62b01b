#include "client/cli/summary_line.h"

#include <cstddef>
#include <cstdint>

#include "client/cli/fixed_text.h"
#include "core/trc/result/compensated_block.h"

namespace trc::cli {
namespace {

std::string grouped(std::uint64_t count, Language language) {
  std::string digits = std::to_string(count);
  // A point would read as a decimal point.
  const char between = language == Language::german ? ' ' : ',';
  for (std::size_t place = digits.size(); place > 3;) {
    place -= 3;
    digits.insert(place, 1, between);
  }
  return digits;
}

}  // namespace

std::string summary_line(const wire::PathSummary& summary, LengthUnit unit, double seconds,
                         Language language) {
  const bool german = language == Language::german;
  const std::uint64_t blocks = summary.summary.blocks_out;
  const std::uint64_t masked =
      summary.summary.blocks_by_origin[static_cast<std::size_t>(Origin::masked)];
  std::string line = grouped(blocks, language);
  line += german ? (blocks == 1 ? " Satz" : " Sätze") : (blocks == 1 ? " block" : " blocks");
  if (masked > 0) line += ", " + grouped(masked, language) + (german ? " ausgeblendet" : " masked");
  if (const auto& worst = summary.clearance.worst) {
    line += german ? ", Abstand " : ", clearance ";
    line += unit == LengthUnit::inch ? fixed(worst->distance / mm_per_inch, 4) + " inch"
                                     : fixed(worst->distance, 3) + " mm";
    line += german ? " bei " : " at ";
    if (worst->path.number != Source::no_number)
      line += "N" + std::to_string(worst->path.number);
    else if (worst->path.line > 0)
      line += (german ? "Zeile " : "line ") + std::to_string(worst->path.line);
    else
      line += (german ? "Satz " : "block ") + std::to_string(worst->path.index);
  }
  return line + ", " + fixed(seconds, 2) + " s";
}

bool compensates_nothing(const wire::PathSummary& summary) {
  const auto& counts = summary.summary.blocks_by_origin;
  std::uint64_t compensated = 0;
  for (std::size_t origin = 0; origin < counts.size(); ++origin)
    if (static_cast<Origin>(origin) != Origin::passthrough &&
        static_cast<Origin>(origin) != Origin::uncompensated)
      compensated += counts[origin];
  return compensated == 0 && summary.warnings == 0;
}

}  // namespace trc::cli

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/session/program_session.h"
#include "core/trc/result/compensated_block.h"

namespace trc::support {

// What an `.expected` file beside an NC program says, one item a line, `#`
// begins a comment:
//
//   N origin line X Y -> X Y
//   N origin arc X Y -> X Y center X Y sweep DEGREES
//   N passthrough TEXT
//   diagnostic CODE line LINE
//
// mm and degrees in the compensation plane. After a block may follow
// `third FROM TO` (third main axis, else it must not move) and `F FEED` written
// as `F300` (else the feed is not looked at). `*` in place of N, origin or LINE
// stands for any. Blocks that move nothing are not listed; passthrough is
// compared as soon as one line lists it. No diagnostic may come but those listed.
struct ExpectedBlock {
  std::string text{};  // the line as written
  std::optional<std::int64_t> number{};
  std::string origin{};
  bool is_arc = false;
  Point start = Point::Zero();
  Point end = Point::Zero();
  Point center = Point::Zero();
  double sweep = 0;  // degrees
  AxisTravel third{};
  std::optional<double> feed{};
  std::string passthrough{};
};

struct ExpectedDiagnostic {
  Code code{};
  std::optional<std::uint32_t> line{};
};

struct Expectation {
  std::vector<ExpectedBlock> blocks{};
  std::vector<ExpectedDiagnostic> diagnostics{};
};

// Throws std::runtime_error with the line at fault.
[[nodiscard]] Expectation read_expectation(std::string_view text);

// The head of a program in `bad`: `; expect: CODE at line N`, N or `*`.
[[nodiscard]] ExpectedDiagnostic read_expected_refusal(std::string_view program);

// The setup of a program: defaults, and per line `; setup: tool NUMBER RADIUS`,
// `; setup: start X Y Z`, `; setup: look_ahead BLOCKS`, `; setup: implicit_masking`,
// `; setup: verify`, `; setup: dialect NAME`, `; setup: leads` (none) or `; setup: leads IN OUT`
// (so many blocks), `; setup: max_masked_share SHARE`, `; setup: wear MM`,
// `; setup: allowance MM`, `; setup: nominal_radius MM`.
[[nodiscard]] ProgramSessionSetup read_setup(std::string_view program);

// A sentence about the first difference beyond 1e-4 mm and 1e-4 degrees, or
// nothing. With `beginning` the result may stop early.
[[nodiscard]] std::string difference(const std::vector<CompensatedBlock>& actual,
                                     const std::vector<ExpectedBlock>& expected, bool beginning);

}  // namespace trc::support

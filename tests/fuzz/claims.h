#pragma once

#include <ctime>
#include <string_view>
#include <vector>

#include "core/trc/result/compensated_block.h"

namespace trc::fuzz {

// Ends the process, which is what a fuzzer takes for a find, unless the claim holds.
void claim(bool holds, std::string_view sentence);

// Every number is finite, every joint is shared.
void claim_path(const std::vector<CompensatedBlock>& blocks);

// Both paths have equal blocks, bit for bit.
void claim_same(const std::vector<CompensatedBlock>& actual,
                const std::vector<CompensatedBlock>& expected, std::string_view sentence);

// Claims that what happens while it lives takes this thread at most two seconds, which is ample for
// the few kilobytes of an input, sanitizers included.
class TimeBound {
 public:
  TimeBound();
  ~TimeBound();
  TimeBound(const TimeBound&) = delete;
  TimeBound& operator=(const TimeBound&) = delete;

 private:
  std::timespec started_{};
};

}  // namespace trc::fuzz

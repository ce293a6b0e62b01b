#include "tests/fuzz/claims.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/support/run.h"

namespace trc::fuzz {
namespace {

bool is_finite(const AxisTravel& travel) {
  return std::isfinite(travel.from) && std::isfinite(travel.to);
}

bool is_finite(const Segment& path) {
  return std::isfinite(length_of(path)) && start_of(path).allFinite() && end_of(path).allFinite();
}

bool is_finite(const CompensatedBlock& block) {
  for (const AxisTravel& axis : block.tracking)
    if (!is_finite(axis)) return false;
  return is_finite(block.path) && is_finite(block.normal) && std::isfinite(block.feed) &&
         (!block.inverse || is_finite(*block.inverse));
}

std::timespec time_of_thread() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time;
}

}  // namespace

void claim(bool holds, std::string_view sentence) {
  if (holds) return;
  std::fprintf(stderr, "%.*s\n", static_cast<int>(sentence.size()), sentence.data());
  std::abort();
}

void claim_path(const std::vector<CompensatedBlock>& blocks) {
  for (const CompensatedBlock& block : blocks)
    if (!is_finite(block)) claim(false, "Not finite: " + support::text_of(block));
  const std::string gap = support::first_gap(blocks);
  claim(gap.empty(), gap);
}

void claim_same(const std::vector<CompensatedBlock>& actual,
                const std::vector<CompensatedBlock>& expected, std::string_view sentence) {
  const support::Outcome left{.blocks = actual};
  const support::Outcome right{.blocks = expected};
  if (support::same(left, right)) return;
  claim(false, std::string(sentence) + "\nis\n" + support::text_of(actual) + "but not\n" +
                   support::text_of(expected));
}

TimeBound::TimeBound() : started_(time_of_thread()) {}

TimeBound::~TimeBound() {
  const std::timespec now = time_of_thread();
  const double seconds = static_cast<double>(now.tv_sec - started_.tv_sec) +
                         1e-9 * static_cast<double>(now.tv_nsec - started_.tv_nsec);
  if (seconds >= 2) claim(false, "Took " + std::to_string(seconds) + " s");
}

}  // namespace trc::fuzz

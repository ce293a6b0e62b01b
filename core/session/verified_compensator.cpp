#include "core/session/verified_compensator.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "core/trc/entry_help.h"
#include "core/verify/state_archive.h"

namespace trc {
namespace {

std::function<std::shared_ptr<const EntryHelp>(const RefusedWay&)> helper(
    const CompensatorSetup& setup) {
  if (!setup.helps_with_entries) return {};
  return [setup](const RefusedWay& way) { return selection::help_with(way, setup); };
}

}  // namespace

VerifiedCompensator::VerifiedCompensator(const CompensatorSetup& setup, Verify verify,
                                         Diagnostics& diagnostics, MeasuringNeeds needs)
    : compensator_(setup, diagnostics), diagnostics_(diagnostics) {
  if (verify == Verify::off) return;
  verification_.emplace(
      verify::VerificationSetup{.verify = verify,
                                .clearance = {.allowed = setup.tolerances.on_contour,
                                              .leads = setup.leads,
                                              .tolerances = setup.tolerances,
                                              .uncut = std::move(needs.uncut),
                                              .known_walls = needs.known_walls,
                                              .progress = std::move(needs.progress)},
                                .selection_blocks = setup.limits.selection_blocks,
                                .interrupt = setup.interrupt,
                                .help = helper(setup)},
      diagnostics);
}

std::size_t VerifiedCompensator::feed_until_report(std::span<Block> blocks,
                                                   std::vector<CompensatedBlock>& out) {
  if (!verification_) return compensator_.feed_until_report(blocks, out);
  if (const std::size_t held = verification_->held_only(blocks); held > 0)
    return take_held(blocks.first(held), out);
  const std::uint64_t line = index_of(blocks.front());
  std::size_t count = 0;
  while (count < blocks.size() && index_of(blocks[count]) == line && !is_releasing())
    if (!take(blocks[count++], out)) return blocks.size();
  return count;
}

// Measuring these blocks cannot report anything.
std::size_t VerifiedCompensator::take_held(std::span<Block> blocks,
                                           std::vector<CompensatedBlock>& out) {
  // Before the compensator moves the content out of the blocks.
  for (const Block& block : blocks.subspan(std::min(told_ahead_, blocks.size())))
    verification_->programmed(block);
  const std::size_t told = std::max(told_ahead_, blocks.size());
  measured_ = out.size();
  const std::size_t count = compensator_.feed_until_report(blocks, out);
  told_ahead_ = told - count;
  if (!diagnostics_.stopped()) measure(out);
  return count;
}

// One block at a time: the output before a stop must not depend on how the caller batches.
bool VerifiedCompensator::take(Block& block, std::vector<CompensatedBlock>& out) {
  if (told_ahead_ > 0)
    --told_ahead_;
  else if (!verification_->programmed(block))
    return false;
  measured_ = out.size();
  compensator_.feed_until_report({&block, 1}, out);
  return !diagnostics_.stopped() && measure(out);
}

bool VerifiedCompensator::measure(const std::vector<CompensatedBlock>& out) {
  const auto fresh = std::span(out).subspan(measured_);
  measured_ = out.size();
  if (!verification_->compensated(fresh)) return false;
  return !finishing_ || is_releasing() || verification_->finish();
}

bool VerifiedCompensator::finish_until_portion(const TrcMode& at_end,
                                               std::vector<CompensatedBlock>& out) {
  finishing_ = true;
  measured_ = out.size();
  return compensator_.finish_until_portion(at_end, out) && (!verification_ || measure(out));
}

bool VerifiedCompensator::release(std::vector<CompensatedBlock>& out) {
  measured_ = out.size();
  return compensator_.release(out) && (!verification_ || measure(out));
}

void VerifiedCompensator::save(StateWriter& archive) const {
  archive(compensator_);
  if (verification_) archive(*verification_);
}

void VerifiedCompensator::load(StateReader& archive) {
  archive(compensator_);
  if (verification_) archive(*verification_);
}

}  // namespace trc

#include "core/session/verified_compensator.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "core/verify/state_archive.h"

namespace trc {

VerifiedCompensator::VerifiedCompensator(const CompensatorSetup& setup, Verify verify,
                                         Diagnostics& diagnostics, verify::UncutSink uncut)
    : compensator_(measuring(setup, verify), diagnostics), diagnostics_(diagnostics) {
  if (verify == Verify::off) return;
  verification_.emplace(verify::VerificationSetup{.verify = verify,
                                                  .allowed = setup.tolerances.on_contour,
                                                  .leads = setup.leads,
                                                  .selection_blocks = setup.limits.selection_blocks,
                                                  .interrupt = setup.interrupt,
                                                  .uncut = std::move(uncut)},
                        diagnostics);
}

CompensatorSetup VerifiedCompensator::measuring(CompensatorSetup setup, Verify verify) {
  if (verify == Verify::off || !setup.take_portion) return setup;
  setup.take_portion = [this, take = std::move(setup.take_portion)](auto& out) {
    measure(out);
    take(out);
    measured_ = out.size();
  };
  return setup;
}

bool VerifiedCompensator::feed(std::vector<Block>& blocks, std::vector<CompensatedBlock>& out) {
  if (!verification_) return compensator_.feed(blocks, out);
  for (std::span<Block> left(blocks); !left.empty() && !diagnostics_.stopped();)
    left = left.subspan(feed_until_report(left, out));
  blocks.clear();
  return !diagnostics_.stopped();
}

std::size_t VerifiedCompensator::feed_until_report(std::span<Block> blocks,
                                                   std::vector<CompensatedBlock>& out) {
  if (!verification_) return compensator_.feed_until_report(blocks, out);
  if (const std::size_t held = verification_->held_only(blocks); held > 0)
    return take_held(blocks.first(held), out);
  const std::uint64_t line = index_of(blocks.front());
  std::size_t count = 0;
  while (count < blocks.size() && index_of(blocks[count]) == line)
    if (!take(blocks[count++], out)) return blocks.size();
  return count;
}

// Nothing can be reported of what is measured.
std::size_t VerifiedCompensator::take_held(std::span<Block> blocks,
                                           std::vector<CompensatedBlock>& out) {
  // The compensator takes what is in the blocks.
  for (const Block& block : blocks.subspan(std::min(told_ahead_, blocks.size())))
    verification_->programmed(block);
  const std::size_t told = std::max(told_ahead_, blocks.size());
  measured_ = out.size();
  const std::size_t count = compensator_.feed_until_report(blocks, out);
  told_ahead_ = told - count;
  if (!diagnostics_.stopped()) measure(out);
  return count;
}

// Alone: what has come out before a stop must not depend on how the caller batches.
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
  return verification_->compensated(fresh);
}

bool VerifiedCompensator::finish(const TrcMode& at_end, std::vector<CompensatedBlock>& out) {
  measured_ = out.size();
  if (!compensator_.finish(at_end, out)) return false;
  return !verification_ || (measure(out) && verification_->finish());
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

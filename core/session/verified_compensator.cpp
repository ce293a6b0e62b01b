#include "core/session/verified_compensator.h"

#include <cstdint>
#include <span>
#include <utility>

#include "core/verify/state_archive.h"

namespace trc {

VerifiedCompensator::VerifiedCompensator(const CompensatorSetup& setup, bool verify,
                                         Diagnostics& diagnostics)
    : compensator_(measuring(setup, verify), diagnostics), diagnostics_(diagnostics) {
  if (verify) verification_.emplace(setup.tolerances.on_contour, setup.leads, diagnostics);
}

CompensatorSetup VerifiedCompensator::measuring(CompensatorSetup setup, bool verify) {
  if (!verify || !setup.take_portion) return setup;
  setup.take_portion = [this, take = std::move(setup.take_portion)](auto& out) {
    measure(out);
    take(out);
    measured_ = out.size();
  };
  return setup;
}

// Block by block, as the compensator does: what has come out before a stop must not
// depend on how the caller batches.
bool VerifiedCompensator::feed(std::vector<Block>& blocks, std::vector<CompensatedBlock>& out) {
  if (!verification_) return compensator_.feed(blocks, out);
  for (Block& block : blocks)
    if (!take(block, out)) break;
  blocks.clear();
  return !diagnostics_.stopped();
}

std::size_t VerifiedCompensator::feed_until_report(std::span<Block> blocks,
                                                   std::vector<CompensatedBlock>& out) {
  if (!verification_) return compensator_.feed_until_report(blocks, out);
  const std::uint64_t line = index_of(blocks.front());
  std::size_t count = 0;
  while (count < blocks.size() && index_of(blocks[count]) == line)
    if (!take(blocks[count++], out)) return blocks.size();
  return count;
}

bool VerifiedCompensator::take(Block& block, std::vector<CompensatedBlock>& out) {
  verification_->programmed(block);
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

#include "client/load/digest.h"

#include <algorithm>
#include <bit>
#include <type_traits>

namespace trc::load {
namespace {

// Hands `text` to `add` in pieces that end where a checkpoint is due.
template <class Add>
void divide(std::string_view text, std::uint64_t interval, std::uint64_t size, Add add) {
  while (!text.empty()) {
    const std::uint64_t left = interval - size % interval;
    const std::string_view piece = text.substr(0, left);
    add(piece);
    size += piece.size();
    text.remove_prefix(piece.size());
  }
}

}  // namespace

// Both steps are invertible, so two results that differ in one word never become equal again.
void Digest::mix(std::uint64_t word) {
  value_ = (value_ ^ word) * 0xff51afd7ed558ccd;
  value_ ^= value_ >> 32U;
}

void Digest::mix(double number) { mix(std::bit_cast<std::uint64_t>(number)); }

void Digest::add(std::string_view bytes) {
  for (const char byte : bytes) mix(std::uint64_t{static_cast<unsigned char>(byte)});
  size_ += bytes.size();
}

void Digest::add(const CompensatedBlock& block) {
  mix(block.source.index);
  mix(static_cast<std::uint64_t>(block.source.number));
  mix(std::uint64_t{block.source.line});
  mix(std::uint64_t(block.origin) | std::uint64_t(block.plane) << 8U |
      std::uint64_t(block.rapid) << 16U | std::uint64_t(block.tangential) << 17U |
      std::uint64_t(is_arc(block.path)) << 18U);
  mix(start_of(block.path).x());
  mix(start_of(block.path).y());
  mix(end_of(block.path).x());
  mix(end_of(block.path).y());
  if (const Arc* arc = std::get_if<Arc>(&block.path)) {
    mix(arc->center.x());
    mix(arc->center.y());
    mix(arc->sweep);
  }
  mix(block.normal.from);
  mix(block.normal.to);
  mix(block.feed);
  for (const AxisTravel& axis : block.tracking) {
    mix(axis.from);
    mix(axis.to);
  }
  const std::uint64_t blocks = size_ + 1;
  add(std::string_view(block.text));
  size_ = blocks;
}

void ExpectedResult::note() {
  if (digest_.size() % interval_ == 0) checkpoints_.push_back(digest_.value());
}

void ExpectedResult::add(const CompensatedBlock& block) {
  digest_.add(block);
  note();
}

void ExpectedResult::add(std::string_view text) {
  divide(text, interval_, digest_.size(), [&](std::string_view piece) {
    digest_.add(piece);
    note();
  });
}

void ResultCheck::compare() {
  const std::uint64_t size = digest_.size();
  if (differs_ || size % expected_.interval_ != 0) return;
  const std::uint64_t checkpoint = size / expected_.interval_ - 1;
  differs_ = checkpoint >= expected_.checkpoints_.size() ||
             expected_.checkpoints_[checkpoint] != digest_.value();
  if (!differs_) right_ = size;
}

void ResultCheck::add(const CompensatedBlock& block) {
  digest_.add(block);
  compare();
}

void ResultCheck::add(std::string_view text) {
  divide(text, expected_.interval_, digest_.size(), [&](std::string_view piece) {
    digest_.add(piece);
    compare();
  });
}

void ResultCheck::finish() {
  differs_ = differs_ || digest_.size() != expected_.size() ||
             digest_.value() != expected_.digest_.value();
}

}  // namespace trc::load

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/trc/result/compensated_block.h"

namespace trc::load {

// A number that depends on every bit of a result, but not on how it was cut into messages. One
// changed bit always changes it; several do with a chance of failure of 2^-64.
class Digest {
 public:
  void add(const CompensatedBlock& block);
  void add(std::string_view bytes);

  // Blocks, or bytes.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t word);
  void mix(double number);

  std::uint64_t size_ = 0;
  std::uint64_t value_ = 0x9e3779b97f4a7c15;
};

// The expected result: its digest, and digests at intervals, so that a difference is noticed near
// its place and an endless result can be checked as well.
class ExpectedResult {
 public:
  // Blocks between two checkpoints; of text, bytes.
  explicit ExpectedResult(std::uint64_t interval) : interval_(interval) {}

  void add(const CompensatedBlock& block);
  void add(std::string_view text);

  [[nodiscard]] std::uint64_t size() const { return digest_.size(); }

 private:
  friend class ResultCheck;
  void note();

  std::uint64_t interval_;
  Digest digest_;
  std::vector<std::uint64_t> checkpoints_;
};

// Compares a result with the expected one while it arrives.
class ResultCheck {
 public:
  explicit ResultCheck(const ExpectedResult& expected) : expected_(expected) {}

  void add(const CompensatedBlock& block);
  void add(std::string_view text);
  // The result is complete.
  void finish();

  [[nodiscard]] bool differs() const { return differs_; }
  // Blocks or bytes that were right when the difference was noticed.
  [[nodiscard]] std::uint64_t right() const { return right_; }

 private:
  void compare();

  const ExpectedResult& expected_;
  Digest digest_;
  std::uint64_t right_ = 0;
  bool differs_ = false;
};

}  // namespace trc::load

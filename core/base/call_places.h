#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/utf8.h"
namespace trc {

// A subprogram that is being executed, and where it was called.
struct CallPlace {
  std::string subprogram{};       // as its comment in the flat program names it
  std::uint32_t called_from = 0;  // 1-based line, of the text that calls it
  // 1-based line within the text of a given subprogram; 0: the line stands in the program.
  std::uint32_t line_within = 0;

  bool operator==(const CallPlace&) const = default;
};

// The subprogram that each block of a program that computes comes from, as far as it was executed.
// Empty for other programs.
class CallPlaces {
 public:
  using Chain = std::uint32_t;
  static constexpr Chain main_program = 0;

  // The chain that ends with this call. Equal calls have one chain.
  Chain enter(Chain caller, const std::string& subprogram, std::uint32_t called_from) {
    const auto [known, is_new] = chains_.try_emplace({caller, called_from, subprogram},
                                                     static_cast<Chain>(calls_.size()) + 1);
    if (is_new)
      calls_.push_back({.caller = caller, .called_from = called_from, .subprogram = subprogram});
    return known->second;
  }

  // From this block (Source::index) on; blocks ascend. After very many changes nothing is known.
  void stand(std::uint64_t from_block, Chain chain, std::uint32_t line_within) {
    if (!changes_.empty() && changes_.back().from_block == from_block) changes_.pop_back();
    const bool same = changes_.empty() ? chain == main_program
                                       : changes_.back().chain == chain &&
                                             changes_.back().line_within == line_within;
    if (same || full_) return;
    full_ = changes_.size() >= most_changes;
    changes_.push_back({.from_block = from_block,
                        .chain = full_ ? main_program : chain,
                        .line_within = line_within});
  }

  // The innermost first; empty in the main program.
  [[nodiscard]] std::vector<CallPlace> of(std::uint64_t block) const {
    const auto behind = std::upper_bound(
        changes_.begin(), changes_.end(), block,
        [](std::uint64_t place, const Change& change) { return place < change.from_block; });
    if (behind == changes_.begin()) return {};
    return of(std::prev(behind)->chain, std::prev(behind)->line_within);
  }
  [[nodiscard]] std::vector<CallPlace> of(Chain chain, std::uint32_t line_within) const {
    std::vector<CallPlace> places;
    for (; chain != main_program; chain = calls_[chain - 1].caller) {
      const Call& call = calls_[chain - 1];
      places.push_back({.subprogram = as_utf8(call.subprogram),
                        .called_from = call.called_from,
                        .line_within = std::exchange(line_within, 0U)});
    }
    return places;
  }

 private:
  struct Call {
    Chain caller = main_program;
    std::uint32_t called_from = 0;
    std::string subprogram{};
  };
  struct Change {
    std::uint64_t from_block = 0;
    Chain chain = main_program;
    std::uint32_t line_within = 0;
  };
  static constexpr std::size_t most_changes = 1U << 20U;

  std::vector<Call> calls_{};
  std::map<std::tuple<Chain, std::uint32_t, std::string>, Chain> chains_{};
  std::vector<Change> changes_{};
  bool full_ = false;
};

}  // namespace trc

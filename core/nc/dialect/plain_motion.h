#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/nc/state/program_line.h"
#include "core/nc/state/program_state.h"

namespace trc {

// Reads most lines of a program: those with a motion and nothing else. Such a line has an N word,
// G00 to G03, X Y Z, I J K, R and F with plain numbers, each at most once, in any order, at least
// one of them a coordinate.
class PlainMotion {
 public:
  // Reads the line in one pass, if it is plain: then `words`, which must be empty, get those that
  // WordReader finds. False for any other line, right or wrong; `words` are undefined then. Does
  // not check whether the motion is possible.
  [[nodiscard]] bool read(std::string_view line, std::vector<WordRange>& words);

  [[nodiscard]] bool has_function() const { return has(function); }
  [[nodiscard]] MotionKind motion() const {
    return motion_of_function(static_cast<int>(values_[function]));
  }
  [[nodiscard]] bool has_feed() const { return has(feed_word); }
  [[nodiscard]] double feed() const { return values_[feed_word]; }
  // I J K or R.
  [[nodiscard]] bool has_circle_words() const { return (seen_ >> center & 0xF) != 0; }
  [[nodiscard]] bool has_radius() const { return has(radius); }
  // N, or Source::no_number.
  [[nodiscard]] std::int64_t number() const {
    return has(block_number) ? static_cast<std::int64_t>(values_[block_number]) : Source::no_number;
  }
  // Enters the coordinates into an empty request.
  void enter(MoveRequest& request) const {
    for (std::size_t axis = 0; axis < request.end.size(); ++axis) {
      if (has(end_point + axis)) request.end[axis] = values_[end_point + axis];
      if (has(center + axis)) request.center[axis] = values_[center + axis];
    }
    if (has(radius)) request.radius = values_[radius];
  }
  // Byte of the line where the first of them stands.
  [[nodiscard]] std::uint32_t first_coordinate() const { return first_coordinate_; }
  // Of the words.
  [[nodiscard]] RoleSet roles() const {
    RoleSet roles = bit(WordRole::coordinate);
    for (const Use use : {feed_word, block_number, function})
      if (has(use)) roles |= bit(role_of[use]);
    return roles;
  }
  // X Y Z, a bit each.
  [[nodiscard]] std::uint8_t main_axes() const { return seen_ & 0x7; }

 private:
  // What a word is for. Three axes and three words for the centre stand side by side.
  enum Use : std::uint8_t {
    end_point = 0,
    center = 3,
    radius = 6,
    feed_word,
    block_number,
    function,
    none,
    blank,
  };
  static constexpr std::size_t most_words = none;
  static constexpr std::array<WordRole, most_words> role_of{
      WordRole::coordinate, WordRole::coordinate, WordRole::coordinate, WordRole::coordinate,
      WordRole::coordinate, WordRole::coordinate, WordRole::coordinate, WordRole::feed,
      WordRole::number,     WordRole::motion};
  static constexpr std::uint32_t coordinates = (1U << feed_word) - 1;
  static const std::array<std::uint8_t, 256> use_of_sign;

  [[nodiscard]] bool has(std::size_t use) const { return (seen_ >> use & 1) != 0; }
  [[nodiscard]] bool is_possible(std::uint32_t whole_words) const;

  std::array<double, most_words> values_;  // by use; those that are not seen mean nothing
  std::uint32_t seen_ = 0;                 // a bit for each use
  std::uint32_t first_coordinate_ = 0;
};

}  // namespace trc

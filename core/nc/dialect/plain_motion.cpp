#include "core/nc/dialect/plain_motion.h"

#include <cmath>

#include "core/nc/text/decimal.h"
#include "core/nc/text/words.h"

namespace trc {

constexpr std::array<std::uint8_t, 256> PlainMotion::use_of_sign = [] {
  std::array<std::uint8_t, 256> uses{};
  uses.fill(none);
  const auto enter = [&](char letter, std::size_t use) {
    const std::size_t upper = static_cast<unsigned char>(letter);
    uses[upper] = uses[upper - 'A' + 'a'] = static_cast<std::uint8_t>(use);
  };
  for (const int axis : {0, 1, 2}) {
    enter(static_cast<char>('X' + axis), end_point + static_cast<std::size_t>(axis));
    enter(static_cast<char>('I' + axis), center + static_cast<std::size_t>(axis));
  }
  enter('R', radius);
  enter('F', feed_word);
  enter('N', block_number);
  enter('G', function);
  uses[' '] = uses['\t'] = blank;
  return uses;
}();

bool PlainMotion::read(std::string_view line, std::vector<WordRange>& words) {
  const char* at = line.data();
  const char* const end = at + line.size();
  std::uint32_t seen = 0;
  std::uint32_t whole_words = 0;
  while (at != end) {
    const char* const begin = at++;
    const unsigned use = use_of_sign[static_cast<unsigned char>(*begin)];
    if (use == blank) continue;
    if (use == none || (seen >> use & 1) != 0) return false;

    bool whole = false;
    double value = 0;
    if (!take_number(line, at, value, whole) || std::isinf(value)) return false;
    const auto place = static_cast<std::uint32_t>(begin - line.data());
    if ((seen & coordinates) == 0) first_coordinate_ = place;
    seen |= 1U << use;
    if (whole) whole_words |= 1U << use;
    values_[use] = value;
    words.push_back({.begin = place,
                     .end = static_cast<std::uint32_t>(at - line.data()),
                     .role = role_of[use]});
  }
  seen_ = seen;
  return (seen & coordinates) != 0 && is_possible(whole_words);
}

// The general reader reports numbers that a word cannot have.
bool PlainMotion::is_possible(std::uint32_t whole_words) const {
  const auto is_whole_up_to = [&](std::size_t use, double largest) {
    return (whole_words >> use & 1) != 0 && values_[use] >= 0 && values_[use] <= largest;
  };
  if (has(function) && !is_whole_up_to(function, last_motion_function)) return false;
  if (has(block_number) && !is_whole_up_to(block_number, largest_whole)) return false;
  return !has(feed_word) || values_[feed_word] > 0;
}

}  // namespace trc

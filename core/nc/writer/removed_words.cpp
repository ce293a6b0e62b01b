#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/nc/text/characters.h"
#include "core/nc/writer/nc_writer.h"

// The state that a copied line depends on: the feed of the program (D-70), and, before a call that
// only the machine can execute, the modes of TRC that the subprogram would find (D-69).

namespace trc {
namespace {

struct Mode {
  std::string_view beginning;  // of the word, in capitals
  char group;                  // of the words that end one another
};

// G40 to G42 are resolved for good, and a G40 that ends nothing stays (D-140); corners and leads
// belong to their block.
constexpr auto modes = std::to_array<Mode>({
    {"G10", 'f'},  {"G11", 'f'},  {"G25", 't'},        {"G26", 't'},    {"G138", 's'},
    {"G139", 's'}, {"G236", 's'}, {"G237", 's'},       {"G238", 's'},   {"G239", 's'},
    {"G140", 'm'}, {"G141", 'm'}, {"V.G.", 'r'},       {"OFFN", 'o'},   {"M109", 'f'},
    {"M110", 'f'}, {"M111", 'f'}, {"#SET TANGF", 'v'}, {"#TANGF", 'v'}, {"#TRC", ' '},
});

// Each option of #TRC is independent.
constexpr char of_no_group = ' ';
constexpr char radius_group = 'r';

const Mode* mode_of(std::string_view word) {
  const auto found = std::ranges::find_if(modes, [&](const Mode& mode) {
    const std::size_t length = mode.beginning.size();
    if (word.size() < length) return false;
    for (std::size_t at = 0; at < length; ++at)
      if (upper(word[at]) != mode.beginning[at]) return false;
    return !is_digit(mode.beginning.back()) || word.size() == length || !is_digit(word[length]);
  });
  return found == modes.end() ? nullptr : &*found;
}

// V.G.WZ_AKT.R += 0.1: the previous value still counts.
bool is_change(std::string_view word) {
  const std::size_t equals = word.find('=');
  return equals != std::string_view::npos && equals > 0 &&
         (word[equals - 1] == '+' || word.find_first_of("VRvr", equals) != std::string_view::npos);
}

bool stands_alone(std::string_view word) {
  return word.starts_with('#') || upper(word.front()) == 'V';
}

}  // namespace

void NcWriter::keep_removed_words(const ProgramLine& line) {
  if (!line.has(WordRole::technology) && !line.has(WordRole::trc)) return;
  const auto forget = [&](char group) {
    std::erase_if(removed_, [&](const RemovedWord& word) { return word.group == group; });
  };
  for (const WordRange& range : line.words) {
    const std::string_view word = line.word(range);
    // A new tool has its own data.
    const bool names_tool = word.size() > 1 && upper(word[0]) == 'D' && is_digit(word[1]);
    if (range.role == WordRole::technology && names_tool) forget(radius_group);
    if (range.role != WordRole::trc || word.empty()) continue;
    const Mode* const mode = mode_of(word);
    if (mode == nullptr) continue;
    if (mode->group != of_no_group && !(mode->group == radius_group && is_change(word)))
      forget(mode->group);
    else if (mode->group == of_no_group)
      std::erase_if(removed_, [&](const RemovedWord& known) { return known.text == word; });
    removed_.push_back({.group = mode->group, .text = std::string(word)});
  }
}

// G functions in one line, before the words that each need a line.
void NcWriter::write_removed_words(std::string& out) {
  const auto begin = [&] {
    begin_words();
    append_number_of_inserted();
  };
  bool any = false;
  for (const RemovedWord& word : removed_) {
    if (stands_alone(word.text)) continue;
    if (!std::exchange(any, true)) begin();
    words_.append(' ');
    words_.append(word.text);
  }
  if (any) write_words(line_end_, out);
  for (const RemovedWord& word : removed_) {
    if (!stands_alone(word.text)) continue;
    begin();
    words_.append(' ');
    words_.append(word.text);
    write_words(line_end_, out);
  }
  removed_.clear();
}

void NcWriter::write_what_it_counts_on(const ProgramLine& line, std::string& out) {
  if (line.calls_the_machine && !removed_.empty()) write_removed_words(out);
  const double feed = line.feed_it_takes;
  if (feed <= 0 || feed_is_programmed_ || line.has(WordRole::feed) ||
      motions_.same_feed(state_.feed, feed, state_.feed_unit))
    return;
  begin_words();
  append_number_of_inserted();
  if (klartext_) words_.append(" L");
  motions_.append_feed(words_, feed, state_);
  write_words(line_end_, out);
  feed_is_programmed_ = true;
}

}  // namespace trc

#pragma once

#include <gtest/gtest.h>

#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/nc/dialect/reading.h"

// Compares two readings of a program: by the reader of plain lines and, with a comment after each
// line, by the general reader.

namespace trc::testing {

inline std::vector<WordRange> words_without_comments(const ProgramLine& line) {
  std::vector<WordRange> words = line.words;
  std::erase_if(words, [](const WordRange& word) { return word.role == WordRole::comment; });
  return words;
}

inline void expect_same_line(const ProgramLine& plain, const ProgramLine& general) {
  EXPECT_EQ(words_without_comments(plain), words_without_comments(general));
  EXPECT_EQ(plain.roles | bit(WordRole::comment), general.roles | bit(WordRole::comment));
  EXPECT_EQ(plain.main_axes, general.main_axes);
  EXPECT_EQ(plain.names_other_axes, general.names_other_axes);
  EXPECT_EQ(plain.source, general.source);
  EXPECT_EQ(plain.has_words, general.has_words);
  EXPECT_EQ(plain.is_motion, general.is_motion);
  EXPECT_EQ(plain.motion, general.motion);
  EXPECT_EQ(plain.feed, general.feed);
  EXPECT_TRUE(plain.klartext == general.klartext);
}

inline void expect_same_block(const Block& plain, const Block& general) {
  ASSERT_EQ(plain.index(), general.index());
  std::visit(
      [&](const auto& block) {
        const auto& other = std::get<std::decay_t<decltype(block)>>(general);
        EXPECT_EQ(block.source, other.source);
        EXPECT_EQ(block.normal, other.normal);
        EXPECT_EQ(block.feed, other.feed);
        EXPECT_EQ(block.rapid, other.rapid);
        EXPECT_EQ(*block.mode, *other.mode);
        if constexpr (std::is_same_v<std::decay_t<decltype(block)>, MotionBlock>) {
          EXPECT_EQ(block.path, other.path);
        } else {
          EXPECT_EQ(block.text, other.text);
        }
      },
      plain);
}

inline void expect_same_reading(std::string_view plain_text, std::string_view general_text,
                                const ProgramSetup& setup = {}) {
  const Reading plain = read(plain_text, setup);
  const Reading general = read(general_text, setup);
  EXPECT_EQ(plain.stopped, general.stopped);
  ASSERT_EQ(plain.diagnostics.size(), general.diagnostics.size());
  for (std::size_t i = 0; i < plain.diagnostics.size(); ++i) {
    EXPECT_EQ(place_and_code(plain.diagnostics[i]), place_and_code(general.diagnostics[i]));
    EXPECT_EQ(message_of(plain.diagnostics[i]), message_of(general.diagnostics[i]));
  }
  ASSERT_EQ(plain.lines.size(), general.lines.size());
  const std::size_t whole_lines = plain.lines.size() - (plain.stopped ? 1 : 0);
  for (std::size_t i = 0; i < whole_lines; ++i) expect_same_line(plain.lines[i], general.lines[i]);
  ASSERT_EQ(plain.blocks.size(), general.blocks.size());
  for (std::size_t i = 0; i < plain.blocks.size(); ++i)
    expect_same_block(plain.blocks[i], general.blocks[i]);
}

}  // namespace trc::testing

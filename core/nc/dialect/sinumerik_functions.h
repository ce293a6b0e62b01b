#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/g_function.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/named_words.h"

namespace trc {

// Records that the word stands for the function.
bool read_as(const GFunction& function, const NamedWord& word, ProgramLine& line,
             BlockWords& block);

// A name without a value: TRANS, CFC, KONT …
bool read_name(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block);

// CALL "NAME", CALL BLOCK A TO B, PCALL NAME: calls that only the control resolves.
[[nodiscard]] bool calls_by_name(std::string_view name);

// NAME(…)
bool read_named_call(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block);

}  // namespace trc

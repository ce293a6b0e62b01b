#pragma once

#include <string>
#include <string_view>

#include "core/nc/state/program_setup.h"

namespace trc {

// Why a word may not be in ProgramSetup::pass_words: it is known and may affect the path, or it is
// no word at all. Empty: it may.
[[nodiscard]] std::string fault_of_pass_word(std::string_view word, DialectName dialect);

// The file that L NAME of ISG calls, in capitals: SPINDLE_OK.UP of `Spindle_OK.up [1]`.
[[nodiscard]] std::string called_file(std::string_view call);

// The function or name that begins at a byte of the line, in capitals; its number without leading
// zeros: G777 of `g0777 X1`, POPEN, #LASER.
[[nodiscard]] std::string word_to_pass(std::string_view line, std::size_t begin);

// Whether the setup says that it passes.
[[nodiscard]] inline bool passes_word(const ProgramSetup& setup, std::string_view line,
                                      std::size_t begin) {
  return !setup.pass_words.empty() && setup.pass_words.contains(word_to_pass(line, begin));
}

}  // namespace trc

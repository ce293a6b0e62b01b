#pragma once

#include <string>
#include <string_view>

#include "core/base/control_words.h"
#include "core/base/diagnostic.h"
#include "core/base/language.h"

namespace trc {

// The remedy for these words, in place of that in the row of the code; empty: the row applies.
[[nodiscard]] std::string_view help_in(ControlWords words, Code code, Language language);

// The text with G40, G41 and G42 replaced by the words of the control.
[[nodiscard]] std::string in_words_of(ControlWords words, std::string text);

}  // namespace trc

#pragma once

#include <string>
#include <string_view>

#include "core/base/language.h"

namespace trc::cli {

// Sets the language of messages of `trc` about a call, its files, options and servers; English
// until then. Messages about a program have the language of its setup.
void speak(Language language);
[[nodiscard]] Language spoken_language();

// A sentence of the table of German ones in the language of speak(); any other as it is. What
// stands in its gaps may be a sentence of the table in turn.
[[nodiscard]] std::string told(std::string_view english);

// "trc: " and the sentence, as told, in a line on standard error: printable, whatever names and
// texts of servers stand in it.
void complain(std::string_view english);

}  // namespace trc::cli

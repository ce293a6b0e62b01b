#pragma once

#include <string>

#include "core/base/utf8.h"

namespace trc::wire {

// The text of a program in a string of Protobuf, which holds UTF-8 alone: with another byte in it
// nobody could read the message.
template <typename Message>
void set_text(const std::string& text, Message& message) {
  if (is_utf8(text))
    message.set_text(text);
  else
    message.set_text(as_utf8(text));
}

}  // namespace trc::wire

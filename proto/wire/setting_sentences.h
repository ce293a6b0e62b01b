#pragma once

#include <span>

#include "core/messages/sentences.h"

namespace trc::wire {

// What is said of settings and fields that cannot be taken: "FIELD: is 3, allowed is 8 to 9 mm".
[[nodiscard]] std::span<const Sentence> setting_sentences();

}  // namespace trc::wire

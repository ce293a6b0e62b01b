#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/named_words.h"

namespace trc {

// A word with `=`: CR=, RND=, X=AC(), $TC_DP6[1,1]= …
bool read_assignment(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block);

}  // namespace trc

#include "core/session/answers.h"

#include <iterator>

namespace trc {
namespace {

template <class Sequence>
void append(Sequence& whole, Sequence& part) {
  if (whole.empty())
    whole = std::move(part);
  else
    whole.insert(whole.end(), std::make_move_iterator(part.begin()),
                 std::make_move_iterator(part.end()));
}

}  // namespace

void Answers::tell(std::vector<Diagnostic> diagnostics) {
  if (diagnostics.empty()) return;
  if (!parts_.back().diagnostics.empty()) close();
  parts_.back().diagnostics = std::move(diagnostics);
}

bool Answers::portion() {
  const std::size_t blocks = parts_.back().blocks.size();
  close();
  parts_.back().blocks.reserve(blocks);
  return wanted_;
}

bool Answers::hand_on() {
  if (sink_) close();
  return wanted_;
}

void Answers::close() {
  Answer& last = parts_.back();
  if (last.empty()) return;
  if (!sink_) {
    parts_.emplace_back();
    return;
  }
  wanted_ = wanted_ && sink_(last);
  last.text.clear();
  last.blocks.clear();
  last.diagnostics.clear();
}

Answer Answers::take() {
  Answer whole;
  for (Answer& part : parts_) {
    append(whole.text, part.text);
    append(whole.blocks, part.blocks);
    append(whole.diagnostics, part.diagnostics);
  }
  parts_.clear();
  parts_.emplace_back();
  return whole;
}

}  // namespace trc

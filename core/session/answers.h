#pragma once

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/trc/result/compensated_block.h"

namespace trc {

// A part of an answer: output that has become certain, NC text or blocks as the setup asks,
// followed by the diagnostics about it.
struct Answer {
  std::string text{};
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};

  [[nodiscard]] bool empty() const { return text.empty() && blocks.empty() && diagnostics.empty(); }
};

// Gets the parts of an answer in order, in the caller's thread, and may move their content out.
// False: no more is wanted.
using AnswerSink = std::function<bool(Answer&)>;

// The output of a session as one sequence, which only grows at its end. Sessions of this process
// and those of a server append to it in the same order:
//
//   - Blocks and text come as soon as they are certain: later input does not change them.
//   - A diagnostic follows everything that was certain at the end of the item, or of the line, in
//     which it was reported, and nothing else. What is reported of one line stays together.
//   - After an error only other errors that were found with it follow.
//
// None of this depends on how the input was cut. The bounds of the parts do, and have no
// meaning.
class Answers {
 public:
  // Keeps everything.
  Answers() : Answers(AnswerSink()) {}
  // Hands everything on.
  explicit Answers(AnswerSink sink) : sink_(std::move(sink)), parts_(1) {}
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;

  // To append to. Valid until the next call that is not const.
  [[nodiscard]] std::vector<CompensatedBlock>& blocks() { return open().blocks; }
  [[nodiscard]] std::string& text() { return open().text; }
  // Appends the diagnostics of one line or item, which has ended.
  void tell(std::vector<Diagnostic> diagnostics);
  // Ends a part that has grown large; the next is as large. Returns whether more is wanted.
  bool portion();
  // Hands all there is to the sink: nothing more is certain now. Returns whether more is wanted.
  bool hand_on();
  [[nodiscard]] bool wanted() const { return wanted_; }

  // What is kept, in order; the last part may still grow, and there always is one.
  [[nodiscard]] std::deque<Answer>& parts() { return parts_; }
  [[nodiscard]] const std::deque<Answer>& parts() const { return parts_; }
  // Takes all of it as one part, for callers who do not need its order.
  [[nodiscard]] Answer take();

 private:
  // The last part if it has no diagnostics yet, else a new one.
  Answer& open() {
    if (!parts_.back().diagnostics.empty()) close();
    return parts_.back();
  }
  void close();

  AnswerSink sink_;
  std::deque<Answer> parts_;  // with a sink the last one alone, used again and again
  bool wanted_ = true;
};

}  // namespace trc

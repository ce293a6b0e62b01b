#pragma once

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/trc/result/compensated_block.h"

namespace trc {

// A part of an answer: what has become certain, NC text or blocks as the setup asks, and behind it
// what is told about it.
struct Answer {
  std::string text{};
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};

  [[nodiscard]] bool empty() const { return text.empty() && blocks.empty() && diagnostics.empty(); }
};

// Gets the parts of an answer in order, in the caller's thread, and may take out what is in them.
// False: no more is wanted.
using AnswerSink = std::function<bool(Answer&)>;

// What a session says, as one sequence: what is appended comes behind everything there is. Sessions
// of this process and those of a server append to it in the same order:
//
//   - Blocks and text come as soon as they are certain: nothing that is given later changes them.
//   - A diagnostic follows everything that was certain at the end of the item, or of the line, in
//     which it was reported, and nothing else. What is reported of one line stays together.
//   - Behind an error comes nothing but other errors that were found with it.
//
// None of it depends on how the input was cut. Where one part ends and the next begins does, and
// says nothing.
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
  // What was reported in one line or item, which has ended.
  void tell(std::vector<Diagnostic> diagnostics);
  // Ends a part that has grown large: what follows is as much again. Returns whether it is wanted.
  bool portion();
  // Nothing more is certain now: what there is goes to the sink. Returns whether more is wanted.
  bool hand_on();
  [[nodiscard]] bool wanted() const { return wanted_; }

  // What is kept, in order; the last part may still grow, and there always is one.
  [[nodiscard]] std::deque<Answer>& parts() { return parts_; }
  [[nodiscard]] const std::deque<Answer>& parts() const { return parts_; }
  // Takes all of that as one part: for who asks for the whole, and not for its order.
  [[nodiscard]] Answer take();

 private:
  // The last part, as long as nothing is told in it.
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

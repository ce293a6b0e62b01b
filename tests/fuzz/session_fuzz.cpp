// Blocks of any kind, under any setup, through a path session. Claims for every path:
//   (1) no crash and no undefined behaviour (with the sanitizers), within two seconds
//   (2) what comes out is finite, and every joint is shared
//   (3) a path that does not come to its end was stopped by exactly one error
//   (4) sessions that go on where another was written down give the path of one
//   (5) blocks given in batches come out as one by one, up to the batch with an error
//   (6) what is passed through comes out once and in order

#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/messages/diagnostic_text.h"
#include "core/session/path_session.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/fuzzed_path.h"

namespace trc::fuzz {
namespace {

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

struct Result {
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};
  bool complete = false;
};

// One session, or the last of a row of them.
class Run {
 public:
  explicit Run(const SessionSetup& setup) : setup_(setup) { session_.emplace(setup_); }

  // Compensates after every `batch` items, and goes on in a new session after every `resumed` ones.
  Result result(const FuzzedPath& path, std::size_t batch, std::size_t resumed) {
    bool goes_on = true;
    std::size_t given = 0;
    for (const wire::PathInput& item : path.items) {
      goes_on = wire::apply(item, session_->program());
      ++given;
      if (!goes_on || given % batch == 0) goes_on = session_->advance(answers_) && goes_on;
      if (!goes_on) break;
      if (given % resumed == 0) go_on_elsewhere();
    }
    if (goes_on) goes_on = session_->advance(answers_);
    const bool complete = goes_on && session_->finish({.index = path.items.size()}, answers_);
    claim(complete != session_->diagnostics().stopped(), "Stopped, or complete");
    Answer whole = answers_.take();
    return {.blocks = std::move(whole.blocks),
            .diagnostics = std::move(whole.diagnostics),
            .complete = complete};
  }

 private:
  void go_on_elsewhere() {
    std::stringstream state;
    {
      StateWriter archive(state);
      session_->save(archive);
    }
    session_.emplace(setup_);
    StateReader archive(state);
    session_->load(archive);
  }

  SessionSetup setup_;
  std::optional<PathSession> session_;
  Answers answers_;
};

void claim_resumed(const Result& actual, const Result& expected) {
  claim_same(actual.blocks, expected.blocks, "The path of resumed sessions");
  claim(actual.complete == expected.complete, "Resumed, only one of two is complete");
  claim(actual.diagnostics.size() == expected.diagnostics.size(),
        "Resumed, there are more diagnostics or fewer");
  for (std::size_t i = 0; i < expected.diagnostics.size(); ++i)
    claim(actual.diagnostics[i].code == expected.diagnostics[i].code &&
              actual.diagnostics[i].source == expected.diagnostics[i].source,
          "Resumed, there is another diagnostic");
}

void claim_batches(const Result& actual, Result expected) {
  claim(actual.complete == expected.complete, "In batches, only one of two is complete");
  claim(actual.blocks.size() <= expected.blocks.size(), "In batches, more comes out");
  if (!actual.complete) expected.blocks.resize(actual.blocks.size());
  claim_same(actual.blocks, expected.blocks, "The path in batches");
}

void claim_told(const Result& result) {
  std::size_t errors = 0;
  for (const Diagnostic& raised : result.diagnostics) {
    if (raised.severity == Severity::error) ++errors;
    claim(!message_of(raised).empty(), "A diagnostic without words");
  }
  claim(errors == (result.complete ? 0 : 1), "Not one error where a path was stopped");
}

void claim_text(const Result& result, const FuzzedPath& path) {
  std::vector<std::string> programmed;
  for (const wire::PathInput& item : path.items)
    if (const auto* text = std::get_if<wire::Passthrough>(&item)) programmed.push_back(text->text);
  std::size_t next = 0;
  for (const CompensatedBlock& block : result.blocks) {
    if (block.origin != Origin::passthrough) continue;
    claim(next < programmed.size() && programmed[next] == block.text, "Text out of its order");
    ++next;
  }
  claim(!result.complete || next == programmed.size(), "Text was lost");
}

void check(const FuzzedPath& path) {
  const TimeBound bound;
  const SessionSetup& setup = path.settings.session;
  const Result one_by_one = Run(setup).result(path, 1, never);
  claim_path(one_by_one.blocks);
  claim_told(one_by_one);
  claim_text(one_by_one, path);
  claim_resumed(Run(setup).result(path, 1, path.cut), one_by_one);
  claim_batches(Run(setup).result(path, path.cut, never), one_by_one);
}

}  // namespace
}  // namespace trc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  trc::fuzz::check(trc::fuzz::fuzzed_path({bytes, size}));
  return 0;
}

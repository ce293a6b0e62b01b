// NC text of any kind, read in every dialect. Claims for every text:
//   (1) no crash and no undefined behaviour (with the sanitizers), within two seconds
//   (2) what comes out is finite, and every joint is shared
//   (3) text cut into pieces gives the same output and the same diagnostics as the whole text
// The first byte chooses the form of the output and the length of the pieces.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/messages/diagnostic_text.h"
#include "core/nc/dialect/dialect.h"
#include "core/session/program_session.h"
#include "tests/fuzz/claims.h"

namespace trc::fuzz {
namespace {

struct Given {
  Answer output{};
  std::string diagnostics{};
};

Given given_by(std::string_view text, const ProgramSessionSetup& setup, std::size_t piece) {
  ProgramSession session(setup);
  Answers answers;
  bool running = true;
  for (std::size_t at = 0; running && at < text.size(); at += piece)
    running = session.feed(text.substr(at, piece), answers);
  if (running) session.finish(answers);
  Given given{.output = answers.take()};
  for (const Diagnostic& found : given.output.diagnostics)
    given.diagnostics.append(std::to_string(found.source.line))
        .append(" ")
        .append(message_of(found))
        .append("\n");
  return given;
}

void check(std::string_view text, bool nc_text, std::size_t piece) {
  const TimeBound bound;
  for (const Dialect& dialect : all_dialects()) {
    ProgramSessionSetup setup{.nc_text = nc_text};
    ProgramSetup& program = setup.session.program;
    program.dialect = dialect.name;
    program.max_executed_lines = 2000;
    dialect.begin(program.mode);
    program.mode.tool_radius = 3;
    const Given whole = given_by(text, setup, std::max<std::size_t>(text.size(), 1));
    const Given pieces = given_by(text, setup, piece);
    claim(whole.output.text == pieces.output.text, "The text depends on where the input was cut");
    claim(whole.diagnostics == pieces.diagnostics, "The faults depend on where the input was cut");
    claim_same(pieces.output.blocks, whole.output.blocks, "The path of text in pieces");
    claim_path(whole.output.blocks);
  }
}

}  // namespace
}  // namespace trc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const bool nc_text = (bytes[0] & 1U) != 0;
  const std::size_t piece = 1 + bytes[0] / 2;
  const std::string text(bytes + 1, bytes + size);
  trc::fuzz::check(text, nc_text, piece);
  return 0;
}

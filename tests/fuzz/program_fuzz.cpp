// NC text of any kind through a program session. Claims for every text:
//   (1) no crash and no undefined behaviour (with the sanitizers), within two seconds
//   (2) what comes out is finite, and every joint is shared
//   (3) text cut into pieces gives the same output as the whole text
// The first byte chooses the form of the output and the length of the pieces.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/session/program_session.h"
#include "tests/fuzz/claims.h"

namespace trc::fuzz {
namespace {

Answer output_of(std::string_view text, bool nc_text, std::size_t piece) {
  ProgramSession session({.nc_text = nc_text});
  Answers out;
  bool running = true;
  for (std::size_t at = 0; running && at < text.size(); at += piece)
    running = session.feed(text.substr(at, piece), out);
  if (running) session.finish(out);
  return out.take();
}

void check(std::string_view text, bool nc_text, std::size_t piece) {
  const TimeBound bound;
  const Answer whole = output_of(text, nc_text, std::max<std::size_t>(text.size(), 1));
  const Answer pieces = output_of(text, nc_text, piece);
  claim(whole.text == pieces.text, "The text depends on where the input was cut");
  claim_same(pieces.blocks, whole.blocks, "The path of text in pieces");
  claim_path(whole.blocks);
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

// NC text of any kind through a program session. Claims for every text:
//   (1) no crash and no undefined behaviour (with the sanitizers)
//   (2) what comes out is finite, and every joint is shared
//   (3) text cut into pieces gives the same output as the whole text
// The first byte chooses the form of the output and the length of the pieces.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/session/program_session.h"
#include "tests/support/run.h"

namespace trc {
namespace {

void claim(bool holds, const std::string& sentence) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", sentence.c_str());
  std::abort();
}

ProgramOutput output_of(std::string_view text, bool nc_text, std::size_t piece) {
  ProgramSession session({.nc_text = nc_text});
  ProgramOutput out;
  bool running = true;
  for (std::size_t at = 0; running && at < text.size(); at += piece)
    running = session.feed(text.substr(at, piece), out);
  if (running) session.finish(out);
  return out;
}

bool is_finite(const Segment& path) {
  return std::isfinite(length_of(path)) && start_of(path).allFinite() && end_of(path).allFinite();
}

void check(std::string_view text, bool nc_text, std::size_t piece) {
  const ProgramOutput whole = output_of(text, nc_text, std::max<std::size_t>(text.size(), 1));
  const ProgramOutput pieces = output_of(text, nc_text, piece);
  claim(whole.text == pieces.text, "The text depends on where the input was cut");
  claim(support::text_of(whole.blocks) == support::text_of(pieces.blocks),
        "The blocks depend on where the input was cut");
  for (const CompensatedBlock& block : whole.blocks)
    claim(is_finite(block.path), "Not finite: " + support::text_of(block));
  const std::string gap = support::first_gap(whole.blocks);
  claim(gap.empty(), gap);
}

}  // namespace
}  // namespace trc

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const bool nc_text = (bytes[0] & 1U) != 0;
  const std::size_t piece = 1 + bytes[0] / 2;
  const std::string text(bytes + 1, bytes + size);
  trc::check(text, nc_text, piece);
  return 0;
}

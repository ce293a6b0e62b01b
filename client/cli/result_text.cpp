#include "client/cli/result_text.h"

#include "core/nc/state/program_state.h"
#include "core/nc/text/number_format.h"
#include "core/trc/result/listing.h"
#include "proto/wire/compensated_block.h"

namespace trc::cli {
namespace {

std::vector<std::string> axis_names(const v1::ProgramSetup& setup) {
  const auto& names = setup.path().axis_names();
  if (names.empty()) return ProgramSetup{}.tracking_axes;
  return {names.begin(), names.end()};
}

}  // namespace

ResultText::ResultText(const std::string& format, v1::ProgramSetup& setup)
    : as_json_(format == "jsonl"),
      as_nc_(format == "nc"),
      axes_(axis_names(setup)),
      decimals_(setup.has_decimals() ? static_cast<int>(setup.decimals()) : default_decimals) {
  setup.set_output(as_nc_ ? v1::PROGRAM_OUTPUT_NC : v1::PROGRAM_OUTPUT_BLOCKS);
}

const std::string& ResultText::of(const Answer& answer) {
  if (as_nc_) return answer.text;
  text_.clear();
  if (as_json_)
    add_json(answer);
  else
    add_listing(answer);
  return text_;
}

const std::string& ResultText::of(const wire::PathSummary& summary) {
  text_.clear();
  if (!as_json_) return text_;
  wire::to_proto(summary, *item_.mutable_summary());
  lines_.append(item_, text_);
  return text_;
}

void ResultText::add_json(const Answer& answer) {
  for (const CompensatedBlock& block : answer.blocks) {
    wire::to_proto(block, *item_.mutable_block());
    lines_.append(item_, text_);
  }
  for (const Diagnostic& told : answer.diagnostics) {
    wire::to_proto(told, *item_.mutable_diagnostic());
    lines_.append(item_, text_);
  }
}

void ResultText::add_listing(const Answer& answer) {
  for (const CompensatedBlock& block : answer.blocks) {
    append_listing(text_, block, axes_, decimals_);
    text_ += '\n';
  }
}

}  // namespace trc::cli

#include <optional>
#include <utility>
#include <variant>

#include "core/trc/compensator_passes.h"
#include "core/trc/entry_help.h"

// Where blocks leave the list of passes: the short ways, and help for a refused entry.

namespace trc {
namespace {

// Refusals of LoopRemoval that leads too narrow for the tool may have caused.
bool may_be_of_leads(Code code) {
  return code == Code::line_reversed || code == Code::arc_wrapped || code == Code::most_left_out;
}

}  // namespace

std::size_t Compensator::Passes::run(std::span<Block> blocks, std::vector<CompensatedBlock>& out) {
  PathBlock* held = relevant_blocks.held();
  PathBlock* open = transitions.open_block();
  if (blocks.size() < ways.least_in || held == nullptr || open == nullptr) return 0;
  if (diagnostics.stopped() || !short_way.may_begin(*open, *held) || !are_idle_for(*held)) return 0;
  const std::size_t count = short_way.take(*open, *held, blocks, out);
  if (count == 0) return 0;
  relevant_blocks.go_on_from_held();
  transitions.goes_on_behind(short_way.last_out());
  return count;
}

bool Compensator::Passes::are_idle_for(const PathBlock& block) const {
  return !relevant_blocks.counts_for_window(block) && rounded_input.ignores(block) &&
         kerf_masking.ignores(block) && inside_corner.ignores(block) &&
         contour_masking.ignores(block) &&
         (short_way.goes_into_loop_removal() ||
          (loop_removal.ignores(block) && bottlenecks.ignores(block)));
}

// Blocks that leave a selection as they came go straight into the result; if the next one does not,
// a few go through the passes.
bool Compensator::Passes::release(std::vector<CompensatedBlock>& out) {
  checkpoint.pass();
  const bool is_idle = path.blocks.empty() && bottlenecks.is_empty();
  if (is_idle && ways.short_out && short_release.put_out(out, out.size() + blocks_per_step))
    return true;
  return loop_removal.release_some(path.blocks) && finish_path(Input::more, out);
}

void Compensator::Passes::help_with_entry() {
  if (!setup.helps_with_entries || diagnostics.pending().empty()) return;
  std::optional<RefusedWay> refused = std::exchange(refused_way, std::nullopt);
  const Code code = diagnostics.pending().back().code;
  if (may_be_of_leads(code)) refused = loop_removal.refused_way();
  if (!refused) return;
  const auto* past_leads = std::get_if<WayPastLeads>(&refused->kind);
  if (past_leads != nullptr && !past_leads->at_begin && code != Code::most_left_out) return;
  const PathBlock* next = relevant_blocks.held();
  const bool goes_on = std::holds_alternative<WayIn>(refused->kind) && next != nullptr &&
                       next->role == Role::contour &&
                       start_of(next->programmed.path) == end_of(refused->blocks.back().path);
  if (goes_on) refused->blocks.push_back(next->programmed);
  diagnostics.help_with_entry(selection::help_with(*refused, setup));
}

}  // namespace trc

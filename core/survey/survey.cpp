#include "core/survey/survey.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>

#include "core/geometry/box_tree.h"
#include "core/nc/dialect/dialect.h"
#include "core/session/verified_compensator.h"

namespace trc::survey {
namespace {

constexpr double micrometre = 1e-3;  // mm
constexpr double per_mm = 1000;      // micrometres; dividing by it gives the number people write
constexpr double rounding = 1e-6;    // of a micrometre

std::optional<double> value_of(const Diagnostic& found, std::string_view name) {
  for (const DiagnosticValue& value : found.values)
    if (value.name == name) return value.value;
  return std::nullopt;
}

// The block that append_place() has named.
std::optional<Source> place_in(const Diagnostic& found, const std::string& name) {
  const auto index = value_of(found, name + "_index");
  if (!index) return std::nullopt;
  Source source{.index = static_cast<std::uint64_t>(*index)};
  if (const auto line = value_of(found, name + "_line"))
    source.line = static_cast<std::uint32_t>(*line);
  if (const auto number = value_of(found, name + "_number"))
    source.number = static_cast<std::int64_t>(*number);
  return source;
}

const MotionBlock* contour_of(const Block& block) {
  const auto* motion = std::get_if<MotionBlock>(&block);
  return motion != nullptr && motion->mode->active() ? motion : nullptr;
}

// Notes report one stretch as a whole or in several parts: `limits` names the first part.
void note(const Diagnostic& found, double least, Surveyed& result) {
  if (found.severity == Severity::warning) ++result.warnings;
  if (found.code != Code::blocks_masked) return;
  const double length = value_of(found, "left_out_length").value_or(0);
  result.left_out_length += length;
  if (length <= least || !result.limits.empty()) return;
  result.limits.push_back(found.source);
  if (const auto last = place_in(found, "last"); last && *last != found.source)
    result.limits.push_back(*last);
}

// Kerf masking fills a notch that the tool cannot enter, without a note: its walls are not reached.
void note_filled(const CompensatedBlock& block, std::vector<Source>& filled) {
  const bool is_known = filled.size() == 2 || (!filled.empty() && filled.back() == block.source);
  if (block.origin == Origin::kerf && !is_known) filled.push_back(block.source);
}

}  // namespace

Survey::Survey(SurveySetup setup, Reader reader)
    : setup_(std::move(setup)), reader_(std::move(reader)) {
  if (setup_.session.verify == Verify::off) setup_.session.verify = Verify::enforce;
}

double Survey::term_of(double radius) const {
  return radius - setup_.session.program.nominal_radius;
}

bool Survey::read() {
  // A centre path is read as for the nominal tool, from which nothing differs.
  const bool wear_mode = setup_.session.program.nominal_radius > 0;
  reading_ = read_with(wear_mode ? 0 : 1, setup_.session, reader_);
  return !reading_.refused;
}

Surveyed Survey::run(double radius) {
  std::optional<ProgramReading> own;
  if (reading_.moves_by_radius) own = read_with(term_of(radius), setup_.session, reader_);
  const ProgramReading& reading = own ? *own : reading_;
  Surveyed found{.radius = radius};
  if (own && own->refused) {
    for (const Diagnostic& fault : own->diagnostics)
      if (fault.severity == Severity::error && !found.refusal) found.refusal = fault;
  } else if (auto wear = too_much_wear(reading, radius)) {
    found.refusal = std::move(wear);
  } else {
    compensate(reading, LoopHandling::as_programmed, found);
  }
  found.reaches_all = found.accepted() && found.clearance.gouging == 0 && found.limits.empty();
  if (!found.reaches_all && found.limits.empty()) found.limits = limits_of(reading, found);
  tried_[radius] = {.reaches = found.reaches_all,
                    .guess = guess_of(found),
                    .refusal = found.refusal,
                    .limits = found.limits};
  if (setup_.uncut && !found.accepted() && !reading.refused) look_for_uncut(reading, found);
  return found;
}

void Survey::compensate(const ProgramReading& reading, LoopHandling loops, Surveyed& found) {
  // This many blocks still fit into the caches.
  constexpr std::size_t portion = 256;
  CompensatorSetup compensator = setup_.session.compensator;
  compensator.start = setup_.session.program.start;
  compensator.inverse_path = false;
  const bool removes_loops = loops == LoopHandling::removed;
  if (removes_loops) compensator.largest_masked_share = 1;
  verify::UncutSink uncut;
  if (setup_.uncut)
    uncut = [&found](const verify::UncutWall& wall) { found.uncut.push_back(wall); };
  ChangedModes modes(reading, {.radius = term_of(found.radius), .removes_loops = removes_loops});
  Diagnostics log;
  log.speak(setup_.session.language, dialect_of(setup_.session.program.dialect).words);
  log.count_as(reading.places);
  VerifiedCompensator session(
      compensator, setup_.session.verify, log,
      {.uncut = std::move(uncut), .known_walls = &walls_, .progress = setup_.session.measuring});
  std::vector<Block> blocks(portion);
  std::vector<CompensatedBlock> out;
  std::vector<Source> filled;
  const auto drop = [&] {
    if (!out.empty() && setup_.progressed) setup_.progressed();
    for (const CompensatedBlock& block : out) note_filled(block, filled);
    out.clear();
  };
  // The path itself is dropped; only its diagnostics and the filled notches are needed.
  const auto take = [&] {
    for (drop(); session.is_releasing(); drop()) session.release(out);
    for (const Diagnostic& told : log.take()) {
      note(told, setup_.session.compensator.tolerances.on_contour, found);
      if (told.severity == Severity::error && !found.refusal) found.refusal = told;
    }
  };
  for (std::size_t at = 0; at < reading.blocks.size() && !log.stopped(); at += portion) {
    const auto given =
        std::span(reading.blocks).subspan(at).first(std::min(portion, reading.blocks.size() - at));
    for (std::size_t i = 0; i < given.size(); ++i) modes.change(given[i], blocks[i]);
    for (std::span<Block> left = std::span(blocks).first(given.size());
         !left.empty() && !log.stopped();) {
      left = left.subspan(session.feed_until_report(left, out));
      take();
    }
  }
  if (!log.stopped()) session.finish_until_portion(modes.at_end(), out);
  take();
  if (found.limits.empty()) found.limits = std::move(filled);
  found.summary = session.summary();
  if (session.clearance() != nullptr) found.clearance = *session.clearance();
  found.uncut_known = setup_.uncut && found.accepted();
  found.wall_length = found.clearance.wall_length;
  found.uncut_length = found.clearance.wall_length - found.clearance.touched_length;
}

// Verification has not measured a path that was refused before its end.
void Survey::look_for_uncut(const ProgramReading& reading, Surveyed& found) {
  Surveyed other{.radius = found.radius};
  compensate(reading, LoopHandling::removed, other);
  found.uncut_known = other.accepted();
  found.uncut_by_removal = other.accepted();
  if (!other.accepted()) return;
  found.wall_length = other.wall_length;
  found.uncut_length = other.uncut_length;
  found.uncut = std::move(other.uncut);
}

// For a centre path only: otherwise reading has checked the wear, which is the same for all radii.
std::optional<Diagnostic> Survey::too_much_wear(const ProgramReading& reading,
                                                double radius) const {
  const ProgramSetup& program = setup_.session.program;
  if (program.nominal_radius <= 0) return std::nullopt;
  std::unordered_map<const TrcMode*, double> beyond;  // the wear of modes that have too much
  for (const RadiusUse& use : reading.uses) {
    const double wear = term_of(radius) + (use.terms.radius - reading.radius) + use.terms.wear;
    if (std::abs(wear) > program.max_wear) beyond.emplace(use.mode.get(), wear);
  }
  if (beyond.empty()) return std::nullopt;
  for (const Block& block : reading.blocks) {
    const MotionBlock* motion = contour_of(block);
    const auto found = motion != nullptr ? beyond.find(motion->mode.get()) : beyond.end();
    if (found == beyond.end()) continue;
    Diagnostic fault = diagnostic(Code::wear_too_large, motion->source);
    fault.values = {{"wear", found->second},
                    {"max_wear", program.max_wear},
                    {"nominal_radius", program.nominal_radius}};
    return fault;
  }
  return std::nullopt;
}

std::vector<Source> Survey::limits_of(const ProgramReading& reading, const Surveyed& found) const {
  if (!found.refusal) {
    if (!found.clearance.worst) return {};
    return {found.clearance.worst->path, found.clearance.worst->contour};
  }
  const Diagnostic& refusal = *found.refusal;
  if (const auto other = place_in(refusal, "other"))
    return *other == refusal.source ? std::vector{refusal.source}
                                    : std::vector{refusal.source, *other};
  if (refusal.code == Code::most_left_out)
    if (const auto last = place_in(refusal, "last")) return {refusal.source, *last};
  const bool pinched = refusal.code == Code::line_reversed || refusal.code == Code::arc_wrapped;
  return pinched ? around(reading, refusal.source) : std::vector{refusal.source};
}

// If nothing is left of a block, the blocks before and after it limit the tool. At the beginning
// or the end of the contour, the block itself takes the place of the missing one.
std::vector<Source> Survey::around(const ProgramReading& reading, const Source& pinched) {
  const MotionBlock* before = nullptr;
  const MotionBlock* own = nullptr;
  std::uint32_t selection = 0;
  for (const Block& block : reading.blocks) {
    const MotionBlock* motion = contour_of(block);
    if (motion == nullptr) continue;
    const bool begins =
        std::exchange(selection, motion->mode->selection_number) != motion->mode->selection_number;
    if (own != nullptr && begins) break;
    if (own != nullptr && motion->source.index > pinched.index)
      return {before != nullptr ? before->source : pinched, motion->source};
    if (motion->source.index == pinched.index) own = motion;
    // The approach is not part of the contour.
    const bool is_approach = begins && motion->mode->selection != Selection::perpendicular;
    if (own == nullptr) before = is_approach ? nullptr : motion;
  }
  if (own == nullptr || before == nullptr) return {pinched};
  return {before->source, pinched};
}

// Between two parallel walls the radius may be half of their distance.
std::optional<double> Survey::guess_of(const Surveyed& found) {
  if (found.clearance.gouge) {
    const verify::Clearance& worst = *found.clearance.gouge;
    return found.radius + 0.5 * (worst.distance + worst.required) - worst.required;
  }
  if (!found.refusal) return std::nullopt;
  const auto radius = value_of(*found.refusal, "tool_radius");
  if (!radius) return std::nullopt;
  for (const std::string_view name : {"largest_radius", "contour_radius"})
    if (const auto most = value_of(*found.refusal, name)) return found.radius + *most - *radius;
  return std::nullopt;
}

// A tool much larger than the part meets nothing new.
double Survey::search_limit() const {
  Box around;
  for (const Block& block : reading_.blocks)
    if (const MotionBlock* motion = contour_of(block)) around.extend(bounding_box(motion->path));
  constexpr double parts = 10;
  const double size = around.isEmpty() ? 0 : around.diagonal().norm();
  const double listed = tried_.empty() ? 0 : tried_.rbegin()->first;
  return std::clamp(parts * size, 2 * listed + 1, 0.5 * ToolInForce::largest_tool_radius);
}

const Survey::Tried& Survey::tried(Micrometres radius) {
  const double mm = static_cast<double>(radius) / per_mm;
  const auto known = tried_.find(mm);
  if (known != tried_.end()) return known->second;
  ++runs_;
  static_cast<void>(run(mm));
  return tried_.at(mm);
}

// A list may hold radii between two whole micrometres. The search assumes the same result for the
// whole ones next to them, and largest() tries these at its end.
Survey::Bracket Survey::bracket_of_list() const {
  Bracket bracket;
  for (const auto& [radius, known] : tried_) {
    if (!known.reaches) {
      bracket.high = static_cast<Micrometres>(std::ceil(radius / micrometre - rounding));
      bracket.guess = known.guess;
      break;
    }
    bracket.low = static_cast<Micrometres>(std::floor(radius / micrometre + rounding));
  }
  return bracket;
}

void Survey::look_above(Bracket& bracket) {
  const auto most = static_cast<Micrometres>(search_limit() / micrometre);
  constexpr Micrometres first = 1000;
  while (bracket.low < most) {
    const Micrometres next = std::min(std::max(2 * bracket.low, first), most);
    const Tried& found = tried(next);
    if (!found.reaches) {
      bracket.high = next;
      bracket.guess = found.guess;
      return;
    }
    bracket.low = next;
  }
}

// A failed run usually tells how large the tool may be: then two runs are enough, with that radius
// and the next one. Otherwise the interval is halved.
void Survey::narrow(Bracket& bracket) {
  constexpr unsigned guesses_in_a_row = 3;
  Micrometres& high = *bracket.high;
  bool guessed = false;
  for (unsigned step = 0; high - bracket.low > 1; ++step) {
    Micrometres next = bracket.low + (high - bracket.low) / 2;
    if (std::exchange(guessed, false)) {
      next = bracket.low + 1;
    } else if (bracket.guess && step % (guesses_in_a_row + 1) < guesses_in_a_row) {
      next = static_cast<Micrometres>(std::floor(*bracket.guess / micrometre + rounding));
      next = std::clamp(next, bracket.low + 1, high - 1);
      guessed = true;
    }
    const Tried& found = tried(next);
    if (found.reaches) {
      bracket.low = next;
    } else {
      high = next;
      bracket.guess = found.guess;
      guessed = false;
    }
  }
}

Largest Survey::largest() {
  const bool wanted_uncut = std::exchange(setup_.uncut, false);
  runs_ = 0;
  Largest result;
  for (Bracket bracket = bracket_of_list();;) {
    if (!bracket.high) look_above(bracket);
    if (bracket.high) narrow(bracket);
    if (bracket.low > 0 && !tried(bracket.low).reaches) {
      bracket = {.high = bracket.low};
      continue;
    }
    if (bracket.high && tried(*bracket.high).reaches) {
      bracket = {.low = *bracket.high};
      continue;
    }
    result.radius = static_cast<double>(bracket.low) / per_mm;
    result.is_limited = bracket.high.has_value();
    if (bracket.high) {
      const Tried& above = tried(*bracket.high);
      result.refusal = above.refusal;
      result.limits = above.limits;
    }
    break;
  }
  result.runs = runs_;
  setup_.uncut = wanted_uncut;
  return result;
}

}  // namespace trc::survey

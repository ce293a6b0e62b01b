#include "server/http/view/view_builder.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "core/base/checkpoint.h"
#include "core/session/contour_reader.h"
#include "core/session/not_travelled.h"
#include "proto/wire/compensated_block.h"
#include "server/http/view/plane_messages.h"
#include "server/http/view/seen.h"

namespace trc::server::http {
namespace {

Style style_of(Origin origin) {
  switch (origin) {
    case Origin::transition:
    case Origin::radius_change:
      return Style::transition;
    case Origin::approach:
    case Origin::retract:
      return Style::lead;
    case Origin::uncompensated:
      return Style::plain;
    case Origin::masked:
      return Style::contour_masked;
    default:
      return Style::path;
  }
}

}  // namespace

ViewBuilder::ViewBuilder(ViewedProgram program, Memory& memory, ViewMemory::MakeRoom make_room)
    : program_(std::move(program.text)),
      settings_(std::move(program.settings)),
      memory_(std::make_shared<ViewMemory>(memory)),
      make_room_(std::move(make_room)),
      first_on_path_(settings_.path.session.program.start),
      look_(program.look),
      plane_(program.plane.value_or(program.look.plane)),
      contour_(std::make_unique<ViewContour>(settings_.path.session, plane_)) {
  said_.set_name(std::move(program.name));
  memory_->add(program_.text().capacity());
}

template <class Work>
void ViewBuilder::in_turn(const Work& work) {
  if (!has_memory_) return;
  ViewMemory::Turn turn(*memory_, make_room_);
  try {
    turn.check();
    work(turn);
    turn.check();
  } catch (const std::bad_alloc&) {
    has_memory_ = false;
  }
}

bool ViewBuilder::has_memory() const {
  const std::lock_guard lock(mutex_);
  return has_memory_;
}

void ViewBuilder::lose_memory() {
  const std::lock_guard lock(mutex_);
  has_memory_ = false;
}

bool ViewBuilder::find_lines(std::uint64_t count) {
  // Far less than a millisecond, even of empty lines.
  constexpr std::size_t bytes_per_search = 16U << 10U;
  const std::size_t bytes = program_.text().size();
  if (program_.count() >= count || found_bytes_ >= bytes) return false;
  found_bytes_ = std::min(found_bytes_ + bytes_per_search, bytes);
  program_.find_to(found_bytes_);
  return true;
}

// The contour goes on after the block that stopped the compensation, so it is read from the text.
void ViewBuilder::read_contour(const std::function<void()>& pass) {
  contour_ = std::make_unique<ViewContour>(settings_.path.session, plane_);
  SessionSetup session = settings_.path.session;
  session.compensator.interrupt = pass;
  ContourReader(session).read(program_.text(), [&](const std::vector<Block>& blocks) {
    contour_->take(blocks);
    return true;
  });
}

void ViewBuilder::take_contour(std::span<const Block> blocks) {
  const std::lock_guard lock(mutex_);
  in_turn([&](ViewMemory::Turn& /*turn*/) { contour_->take(blocks); });
}

void ViewBuilder::take_path(std::span<const CompensatedBlock> blocks) {
  const std::lock_guard lock(mutex_);
  if (blocks.empty()) return;
  // At the end of a selection many blocks come at once.
  constexpr std::size_t blocks_per_check = 4096;
  in_turn([&](ViewMemory::Turn& turn) {
    for (std::size_t at = 0; at < blocks.size(); at += blocks_per_check) {
      turn.check();
      add_to_path(blocks.subspan(at, std::min(blocks_per_check, blocks.size() - at)));
    }
  });
}

void ViewBuilder::add_to_path(std::span<const CompensatedBlock> blocks) {
  // The rest of a long stretch without motions is left to those that follow, and to the end.
  constexpr int most_pieces = 16;
  const auto [first, last] = std::ranges::minmax_element(
      blocks, {}, [](const CompensatedBlock& block) { return block.source.index; });
  first_radius_ = first->source.index;
  contour_->read_radii(first_radius_, last->source.index, radii_);
  for (int piece = 0; piece < most_pieces && find_lines(last->source.line); ++piece) continue;
  for (const CompensatedBlock& block : blocks) {
    if (block.origin == Origin::passthrough) continue;
    if (block.origin == Origin::kerf || block.origin == Origin::converted_circle)
      replaced_.push_back(static_cast<std::uint32_t>(block.source.index));
    const Element element{.feed = block.rapid ? 0 : static_cast<float>(block.feed),
                          .line = block.source.line,
                          .tool_radius = tool_radius_of(block),
                          .style = style_of(block.origin),
                          .origin = static_cast<std::uint8_t>(wire::to_proto(block.origin)),
                          .rapid = block.rapid,
                          .from_unknown = first_on_path_.begins_at_unknown_place(
                              block.plane, block.path, block.normal, block.rapid)};
    add_seen(path_, element, {.plane = block.plane, .shape = block.path, .normal = block.normal},
             plane_);
  }
}

// The line of a retract is programmed without compensation: it has the tool of the previous block.
float ViewBuilder::tool_radius_of(const CompensatedBlock& block) {
  if (block.origin == Origin::uncompensated) return 0;
  const float radius = radii_[block.source.index - first_radius_];
  if (radius > 0) path_radius_ = radius;
  return path_radius_;
}

void ViewBuilder::add(const v1::Diagnostic& diagnostic) {
  const std::lock_guard lock(mutex_);
  in_turn([&](ViewMemory::Turn& /*turn*/) { keep(diagnostic); });
}

void ViewBuilder::keep(const v1::Diagnostic& diagnostic) {
  if (diagnostic.code() == static_cast<std::int32_t>(Code::blocks_masked)) {
    Diagnostic note = trc::diagnostic(Code::blocks_masked, {.index = diagnostic.source_index()});
    for (const auto& [name, value] : diagnostic.values()) note.values.push_back({name, value});
    masked_.push_back(std::move(note));
  }
  // The error comes last and matters most.
  const bool is_full = said_.diagnostics_size() >= most_diagnostics;
  if (is_full && diagnostic.severity() != v1::Diagnostic::ERROR)
    return said_.set_diagnostics_left_out(said_.diagnostics_left_out() + 1);
  *said_.add_diagnostics() = diagnostic;
}

std::shared_ptr<View> ViewBuilder::finish(std::string id, const std::function<void()>& interrupt) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<View> view;
  in_turn([&](ViewMemory::Turn& turn) {
    const auto pass = [&] {
      turn.check();
      if (interrupt) interrupt();
    };
    if (said_.refused()) read_contour(pass);
    while (find_lines(std::numeric_limits<std::uint64_t>::max())) pass();
    ViewContour::Whole contour = contour_->finish();
    mark_masked(contour, pass);
    said_.set_id(std::move(id));
    if (said_.refused()) said_.clear_measuring();
    describe(contour);
    view = std::make_shared<View>(memory_, ViewParts{.said = std::move(said_),
                                                     .contour = std::move(contour.elements),
                                                     .path = std::move(path_),
                                                     .program = std::move(program_),
                                                     .settings = settings_});
  });
  return has_memory_ ? view : nullptr;
}

void ViewBuilder::mark_masked(ViewContour::Whole& contour, const std::function<void()>& pass) {
  if (masked_.empty() && replaced_.empty()) return;
  const NotTravelled masked(masked_);
  std::sort(replaced_.begin(), replaced_.end());
  Checkpoint checkpoint(pass);
  for (std::size_t i = 0; i < contour.elements.size(); ++i) {
    checkpoint.pass();
    const std::uint32_t block = contour.blocks[i];
    if (masked.contains(block) || std::binary_search(replaced_.begin(), replaced_.end(), block))
      contour.elements.restyle(i, Style::contour_masked);
  }
  replaced_ = {};
}

void ViewBuilder::describe(const ViewContour::Whole& contour) {
  verify::Bounds all;
  for (const Elements* elements : {&contour.elements, &std::as_const(path_)}) {
    const verify::Bounds own = elements->bounds();
    if (own.empty) continue;
    all.add(own.low);
    all.add(own.high);
  }
  // A path without extent still needs a square.
  const double side = std::max(all.size().maxCoeff(), 1.0) * 1.25;
  const Point middle = all.low + all.size() / 2;
  set(*said_.mutable_low(), all.low);
  set(*said_.mutable_high(), all.high);
  set(*said_.mutable_tile_low(), middle - Vector(side, side) / 2);
  said_.set_tile_size(side);
  said_.set_most_level(most_level);
  said_.set_plane(message_of(plane_));
  said_.set_own_plane(message_of(look_.plane));
  said_.set_contour_blocks(contour.elements.blocks());
  said_.set_path_blocks(path_.blocks());
  said_.set_lines(program_.count());
  said_.set_path_length(path_.length());
  for (const double radius : contour.tool_radii) said_.add_tool_radii(radius);
  if (!contour.tool_radii.empty()) said_.set_tool_radius(contour.tool_radii.front());
  if (look_.moves && !contour.elements.empty())
    said_.set_unit(look_.is_inch ? v1::LENGTH_UNIT_INCH : v1::LENGTH_UNIT_MM);
  if (path_.empty()) return;
  said_.set_lowest(path_.lowest());
  said_.set_highest(path_.highest());
}

}  // namespace trc::server::http

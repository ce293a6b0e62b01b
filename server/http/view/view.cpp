#include "server/http/view/view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <new>
#include <span>
#include <utility>

#include "core/nc/program/program_reader.h"
#include "core/session/contour_reader.h"
#include "core/session/program_session.h"
#include "core/trc/result/compensated_block.h"
#include "core/verify/shape.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/geometry.h"
#include "proto/wire/path_item.h"
#include "server/http/view/plane_messages.h"
#include "server/http/view/tile.h"

namespace trc::server::http {
namespace {

// The size of a tile on the screen in pixels, from 0.7 to 1.4 times this. The omitted detail is
// then less than half a pixel.
constexpr double tile_pixels = 512;

LineEnd end_in(Plane plane, const Segment& path, const AxisTravel& normal, const Source& source) {
  const Position end = from_plane(plane, end_of(path), normal.to);
  return {.x = end[0], .y = end[1], .z = end[2], .line = source.line};
}

// Appends after there is room for both the text and the larger one that it may have to move to.
void append(std::string& text, std::string_view part, ViewMemory::Turn& turn) {
  const std::size_t bytes = text.size() + part.size();
  if (bytes > text.capacity()) {
    const std::size_t larger = bytes + bytes / 4;
    turn.check(larger);
    text.reserve(larger);
  }
  text += part;
}

}  // namespace

std::string View::tile(const TileName& name, std::size_t most_segments) const {
  const double side =
      std::ldexp(parts_.said.tile_size(), -static_cast<int>(std::min(name.level, most_level)));
  const Point low(parts_.said.tile_low().x() + side * name.x,
                  parts_.said.tile_low().y() + side * name.y);
  return tile_of(parts_.contour, parts_.path, plane_of(parts_.said.plane()),
                 {.low = low, .side = side},
                 {.tolerance = side / (4 * tile_pixels), .most_segments = most_segments});
}

v1::View View::said_by_now() const {
  v1::View said = parts_.said;
  const std::lock_guard lock(mutex_);
  if (output_ == nullptr && !lacks_output_) return said;
  said.clear_measuring();
  said.MergeFrom(measured_);
  return said;
}

// Adds the results that the answers lacked because the path had not been measured. The rest of the
// summary holds.
void View::measure(const ProgramSession& session, const std::vector<Diagnostic>& found) {
  const std::lock_guard lock(mutex_);
  v1::PathSummary& path = *measured_.mutable_summary()->mutable_path();
  if (const auto* clearance = session.clearance()) {
    v1::PathSummary whole;
    wire::to_proto(wire::PathSummary{.clearance = *clearance}, whole);
    if (whole.has_coverage()) path.set_coverage(whole.coverage());
    if (whole.has_min_clearance())
      path.mutable_min_clearance()->Swap(whole.mutable_min_clearance());
    if (whole.has_certificate()) path.mutable_certificate()->Swap(whole.mutable_certificate());
  }
  for (const Diagnostic& diagnostic : found) {
    if (diagnostic.code != Code::clearance_violated && diagnostic.code != Code::way_crosses_contour)
      continue;
    path.set_warnings(std::max(path.warnings(), parts_.said.summary().path().warnings()) + 1);
    if (parts_.said.diagnostics_size() + measured_.diagnostics_size() < most_diagnostics)
      wire::to_proto(diagnostic, *measured_.add_diagnostics());
  }
}

v1::ViewBlock View::described(const Elements& elements, std::size_t index) const {
  const Element& element = elements[index];
  const Plane plane = plane_of(parts_.said.plane());
  v1::ViewBlock block;
  block.set_on_path(&elements == &parts_.path);
  block.set_index(index);
  block.set_origin(static_cast<v1::CompensatedBlock::Origin>(element.origin));
  block.set_line(element.line);
  *block.mutable_start() = message_of(plane, element.start, double{element.third_from});
  *block.mutable_end() = message_of(plane, element.end, double{element.third_to});
  block.set_feed(double{element.feed});
  block.set_tool_radius(double{element.tool_radius});
  block.set_plane(message_of(element.plane));
  const Segment shape = elements.shape_of(element);
  if (const auto* arc = std::get_if<Arc>(&shape)) {
    set(*block.mutable_center(), arc->center);
    block.set_sweep(arc->sweep);
  }
  return block;
}

v1::ViewBlocks View::blocks_of_line(std::uint64_t line) const {
  constexpr int most_blocks = 1000;
  v1::ViewBlocks found;
  const auto look = [&](const Elements& elements) {
    for (std::size_t i = 0; i < elements.size() && found.blocks_size() < most_blocks; ++i)
      if (elements[i].line == line) *found.add_blocks() = described(elements, i);
  };
  look(parts_.contour);
  look(parts_.path);
  return found;
}

v1::ViewPlace View::place_at(double share) const {
  v1::ViewPlace place;
  const auto found = parts_.path.place_after(share * parts_.path.length());
  if (!found) return place;
  const Element& element = parts_.path[found->element];
  const Segment shape = parts_.path.shape_of(element);
  const Point point =
      verify::extent_of(shape) > 0 ? verify::place_at(shape, found->share).point : element.end;
  const double third =
      double{element.third_from} + found->share * double{element.third_to - element.third_from};
  *place.mutable_position() = message_of(plane_of(parts_.said.plane()), point, third);
  set(*place.mutable_point(), point);
  *place.mutable_block() = described(parts_.path, found->element);
  return place;
}

std::shared_ptr<const Lines> View::output() const {
  const std::lock_guard lock(mutex_);
  return output_;
}

bool View::lacks_output() const {
  const std::lock_guard lock(mutex_);
  return lacks_output_;
}

std::string View::compensated_text(Verify verify, const Making& making) {
  constexpr std::size_t bytes_per_piece = ProgramReader::bytes_between_questions;
  SessionSetup session_setup = parts_.settings.path.session;
  session_setup.compensator.interrupt = making.pass;
  session_setup.verify = verify;
  ProgramSession session({.session = session_setup, .nc_text = true});
  std::string text;
  std::vector<Diagnostic> diagnostics;
  Answers out([&](Answer& part) {
    append(text, part.text, making.turn);
    part.text.clear();
    if (verify != Verify::off) std::ranges::move(part.diagnostics, std::back_inserter(diagnostics));
    part.diagnostics.clear();
    return true;
  });
  std::string_view program = parts_.program.text();
  bool goes_on = true;
  while (goes_on && !program.empty()) {
    goes_on = session.feed(program.substr(0, bytes_per_piece), out);
    program.remove_prefix(std::min(program.size(), bytes_per_piece));
    making.pass();
  }
  if (goes_on) session.finish(out);
  if (verify != Verify::off) measure(session, diagnostics);
  return text;
}

std::shared_ptr<const Lines> View::compensated_lines(const Making& making) {
  struct TooLong {};
  // The time of measuring can grow with the square of the number of blocks.
  constexpr std::chrono::seconds most_measuring{60};
  const auto began = std::chrono::steady_clock::now();
  std::string text;
  try {
    const auto pass = [&] {
      making.pass();
      if (parts_.said.measuring() && std::chrono::steady_clock::now() - began > most_measuring)
        throw TooLong{};
    };
    text = compensated_text(parts_.said.measuring() ? Verify::report : Verify::off,
                            {.turn = making.turn, .pass = pass});
  } catch (const TooLong&) {
    text = compensated_text(Verify::off, making);
  }

  constexpr std::size_t bytes_per_search = 16U << 10U;  // far less than a millisecond
  const std::size_t bytes = text.size();
  auto lines = std::make_shared<Lines>(std::make_shared<const std::string>(std::move(text)));
  for (std::size_t at = 0; at < bytes; at += bytes_per_search) {
    lines->find_to(std::min(at + bytes_per_search, bytes));
    making.pass();
  }
  making.turn.check(lines->count() * sizeof(std::uint32_t));
  std::size_t next = 0;
  const Plane plane = plane_of(parts_.said.plane());
  LineSources sources(lines->count(), [&](LineEnd& end) {
    while (next < parts_.path.size() && !parts_.path[next].ends_block) ++next;
    if (next == parts_.path.size()) return false;
    const Element& element = parts_.path[next++];
    const Position at = from_plane(plane, element.end, double{element.third_to});
    end = {.x = at[0], .y = at[1], .z = at[2], .line = element.line};
    return true;
  });
  // Text and path have the same motions; reading the text tells where its lines end.
  SessionSetup session = parts_.settings.path.session;
  session.compensator.interrupt = making.pass;
  ContourReader(session).read(lines->text(), [&](const std::vector<Block>& blocks) {
    for (const Block& block : blocks)
      if (const auto* motion = std::get_if<MotionBlock>(&block); motion && motion->mode)
        sources.take(end_in(motion->mode->plane, motion->path, motion->normal, motion->source));
    return true;
  });
  lines->set_sources(sources.found());
  return lines;
}

void View::make_output(const std::function<void()>& interrupt,
                       const ViewMemory::MakeRoom& make_room) {
  ViewMemory::Turn turn(*memory_, make_room);
  std::shared_ptr<const Lines> lines;
  try {
    const auto pass = [&] {
      turn.check();
      interrupt();
    };
    lines = compensated_lines({.turn = turn, .pass = pass});
    turn.check();
  } catch (const std::bad_alloc&) {
    lines.reset();
  }
  const std::lock_guard lock(mutex_);
  lacks_output_ = lines == nullptr;
  output_ = std::move(lines);
}

}  // namespace trc::server::http

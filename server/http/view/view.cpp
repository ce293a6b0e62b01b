#include "server/http/view/view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

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

std::vector<LineEnd> ends_of(const std::vector<Block>& blocks) {
  std::vector<LineEnd> ends;
  for (const Block& block : blocks)
    if (const auto* motion = std::get_if<MotionBlock>(&block); motion && motion->mode)
      ends.push_back(end_in(motion->mode->plane, motion->path, motion->normal, motion->source));
  return ends;
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
  if (output_ == nullptr) return said;
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

v1::ViewBlocks View::blocks_of_line(std::uint32_t line) const {
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

std::string View::compensated_text(Verify verify, const std::function<void()>& interrupt) {
  SessionSetup session_setup = parts_.settings.path.session;
  session_setup.compensator.interrupt = interrupt;
  session_setup.verify = verify;
  ProgramSession session({.session = session_setup, .nc_text = true});
  Answers out;
  std::string_view text = parts_.program.text();
  bool goes_on = true;
  while (goes_on && !text.empty()) {
    goes_on = session.feed(text.substr(0, text_piece), out);
    text.remove_prefix(std::min(text.size(), text_piece));
    interrupt();
  }
  if (goes_on) session.finish(out);
  Answer whole = out.take();
  if (verify != Verify::off) measure(session, whole.diagnostics);
  return std::move(whole.text);
}

void View::make_output(const std::function<void()>& interrupt) {
  struct TooLong {};
  // The time of measuring can grow with the square of the number of blocks.
  constexpr std::chrono::seconds most_measuring{60};
  const auto began = std::chrono::steady_clock::now();
  std::string text;
  try {
    text = compensated_text(parts_.said.measuring() ? Verify::report : Verify::off, [&] {
      interrupt();
      if (parts_.said.measuring() && std::chrono::steady_clock::now() - began > most_measuring)
        throw TooLong{};
    });
  } catch (const TooLong&) {
    text = compensated_text(Verify::off, interrupt);
  }

  // Text and path have the same motions; reading the text tells where its lines end.
  ContourReader reader(parts_.settings.path.session);
  std::vector<LineEnd> reached;
  const auto reach = [&](const std::vector<Block>& blocks) {
    const std::vector<LineEnd> more = ends_of(blocks);
    reached.insert(reached.end(), more.begin(), more.end());
  };
  for (std::size_t at = 0; at < text.size(); at += text_piece) {
    reader.feed(std::string_view(text).substr(at, text_piece));
    reach(reader.take());
    interrupt();
  }
  reach(reader.finish());
  std::vector<LineEnd> ends;
  ends.reserve(parts_.path.size());
  const Plane plane = plane_of(parts_.said.plane());
  for (std::size_t i = 0; i < parts_.path.size(); ++i) {
    const Element& element = parts_.path[i];
    if (!element.ends_block) continue;
    const Position end = from_plane(plane, element.end, double{element.third_to});
    ends.push_back({.x = end[0], .y = end[1], .z = end[2], .line = element.line});
  }
  text.shrink_to_fit();
  const std::size_t bytes = text.size();
  auto lines = std::make_shared<Lines>(std::make_shared<const std::string>(std::move(text)));
  lines->find_to(bytes);
  lines->set_sources(sources_of(lines->count(), reached, ends));
  const std::lock_guard lock(mutex_);
  output_ = std::move(lines);
}

}  // namespace trc::server::http

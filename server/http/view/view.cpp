#include "server/http/view/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "core/session/contour_reader.h"
#include "core/session/outline.h"
#include "core/session/program_session.h"
#include "core/trc/result/compensated_block.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/geometry.h"
#include "server/http/view/tile.h"

namespace trc::server::http {
namespace {

constexpr std::uint32_t most_level = 24;
// A tile is shown about that large, in pixels.
constexpr double tile_pixels = 512;
constexpr std::size_t most_segments = 2048;
constexpr int most_diagnostics = 1000;
constexpr std::size_t text_piece = 16U << 10U;

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

Plane plane_to_show(const std::vector<Block>& blocks) {
  const MotionBlock* first = nullptr;
  for (const Block& block : blocks) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || motion->mode == nullptr) continue;
    if (motion->mode->active()) return motion->mode->plane;
    if (first == nullptr) first = motion;
  }
  return first == nullptr ? Plane::xy : first->mode->plane;
}

// A movement as the plane that is shown sees it, one element for each piece.
void add_seen(Elements& elements, Element element, Plane plane, const Segment& shape,
              const AxisTravel& normal, Plane shown) {
  if (!verify::is_finite(shape)) return;
  const bool same = plane == shown;
  element.third_from = static_cast<float>(normal.from);
  element.third_to = static_cast<float>(normal.to);
  std::vector<Segment> seen = project(plane, shape, normal, shown);
  // Straight at the viewer: a way without length in the plane.
  if (seen.empty() && normal.moves()) {
    const Point here = to_plane(shown, from_plane(plane, start_of(shape), normal.from));
    seen.emplace_back(Line{.start = here, .end = here});
  }
  for (const Segment& piece : seen) {
    if (!same) {
      const PlaneAxes axes = axes_of(shown);
      const Position from = from_plane(plane, start_of(shape), normal.from);
      const Position to = from_plane(plane, end_of(shape), normal.to);
      element.third_from = static_cast<float>(from[axes.third]);
      element.third_to = static_cast<float>(to[axes.third]);
    }
    elements.add(element, piece);
  }
}

v1::Position message_of(Plane plane, const Point& point, double third) {
  const Position position = from_plane(plane, point, third);
  v1::Position message;
  message.set_x(position[0]);
  message.set_y(position[1]);
  message.set_z(position[2]);
  return message;
}

void set(v1::PlanePoint& message, const Point& point) {
  message.set_x(point.x());
  message.set_y(point.y());
}

Plane plane_of(v1::Plane plane) {
  if (plane == v1::PLANE_ZX) return Plane::zx;
  return plane == v1::PLANE_YZ ? Plane::yz : Plane::xy;
}

v1::Plane message_of(Plane plane) {
  if (plane == Plane::zx) return v1::PLANE_ZX;
  return plane == Plane::yz ? v1::PLANE_YZ : v1::PLANE_XY;
}

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

std::string View::tile(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
  const double side = std::ldexp(said_.tile_size(), -static_cast<int>(std::min(level, most_level)));
  const Point low(said_.tile_low().x() + side * x, said_.tile_low().y() + side * y);
  return tile_of(contour_, path_, {.low = low, .side = side},
                 {.tolerance = side / (2 * tile_pixels), .most_segments = most_segments});
}

v1::ViewBlock View::described(const Elements& elements, std::size_t index, bool on_path) const {
  const Element& element = elements.all()[index];
  const Plane plane = plane_of(said_.plane());
  v1::ViewBlock block;
  block.set_on_path(on_path);
  block.set_index(index);
  block.set_origin(static_cast<v1::CompensatedBlock::Origin>(element.origin));
  block.set_line(element.line);
  *block.mutable_start() = message_of(plane, element.start, double{element.third_from});
  *block.mutable_end() = message_of(plane, element.end, double{element.third_to});
  block.set_feed(double{element.feed});
  block.set_tool_radius(double{element.tool_radius});
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
  const auto look = [&](const Elements& elements, bool on_path) {
    for (std::size_t i = 0; i < elements.all().size() && found.blocks_size() < most_blocks; ++i)
      if (elements.all()[i].line == line) *found.add_blocks() = described(elements, i, on_path);
  };
  look(contour_, false);
  look(path_, true);
  return found;
}

v1::ViewPlace View::place_at(double share) const {
  v1::ViewPlace place;
  const auto found = path_.place_after(share * path_.length());
  if (!found) return place;
  const Element& element = path_.all()[found->element];
  const Segment shape = path_.shape_of(element);
  const Point point =
      verify::extent_of(shape) > 0 ? verify::place_at(shape, found->share).point : element.end;
  const double third =
      double{element.third_from} + found->share * double{element.third_to - element.third_from};
  *place.mutable_position() = message_of(plane_of(said_.plane()), point, third);
  set(*place.mutable_point(), point);
  *place.mutable_block() = described(path_, found->element, true);
  return place;
}

std::shared_ptr<const Lines> View::output() const {
  const std::lock_guard lock(mutex_);
  return output_;
}

void View::make_output(const std::function<void()>& interrupt) {
  SessionSetup session_setup = settings_.path.session;
  session_setup.compensator.interrupt = interrupt;
  session_setup.verify = Verify::off;
  ProgramSession session(
      {.session = session_setup, .nc_text = true, .decimals = settings_.decimals});
  ProgramOutput out;
  std::string_view text = program_.text();
  bool goes_on = true;
  while (goes_on && !text.empty()) {
    goes_on = session.feed(text.substr(0, text_piece), out);
    text.remove_prefix(std::min(text.size(), text_piece));
    interrupt();
  }
  if (goes_on) session.finish(out);

  // Both make the same motions; the text as it is read says where its lines end.
  ContourReader reader(settings_.path.session);
  for (std::size_t at = 0; at < out.text.size(); at += text_piece) {
    reader.feed(std::string_view(out.text).substr(at, text_piece));
    interrupt();
  }
  std::vector<LineEnd> ends;
  ends.reserve(path_.all().size());
  const Plane plane = plane_of(said_.plane());
  for (const Element& element : path_.all()) {
    const Position end = from_plane(plane, element.end, double{element.third_to});
    ends.push_back({.x = end[0], .y = end[1], .z = end[2], .line = element.line});
  }
  auto lines = std::make_shared<Lines>(std::move(out.text));
  lines->set_sources(sources_of(lines->count(), ends_of(reader.finish()), ends));
  const std::lock_guard lock(mutex_);
  output_ = std::move(lines);
}

ViewBuilder::ViewBuilder(std::string text, const v1::ProgramSetup& setup,
                         wire::ProgramSettings settings, Memory& memory)
    : text_(std::move(text)), settings_(std::move(settings)), share_(memory) {
  said_.set_name(setup.file_name());
}

bool ViewBuilder::has_room_for(std::size_t blocks) {
  // What a block becomes, and what its line in the compensated text will take.
  constexpr std::size_t bytes_per_block = sizeof(Element) + 64;
  return share_.take(blocks * bytes_per_block);
}

void ViewBuilder::add(std::vector<CompensatedBlock> blocks) {
  for (CompensatedBlock& block : blocks) {
    if (block.origin == Origin::passthrough) continue;
    block.text = {};
    blocks_.push_back(std::move(block));
  }
}

void ViewBuilder::add(const v1::Diagnostic& diagnostic) {
  if (diagnostic.code() == static_cast<std::int32_t>(Code::blocks_masked)) {
    Diagnostic note = trc::diagnostic(Code::blocks_masked, {.index = diagnostic.source_index()});
    for (const auto& [name, value] : diagnostic.values()) note.values.push_back({name, value});
    masked_.push_back(std::move(note));
  }
  // An error comes last, and is what matters.
  const bool is_full = said_.diagnostics_size() >= most_diagnostics;
  if (is_full && diagnostic.severity() != v1::Diagnostic::ERROR)
    return said_.set_diagnostics_left_out(said_.diagnostics_left_out() + 1);
  *said_.add_diagnostics() = diagnostic;
}

std::shared_ptr<View> ViewBuilder::finish(std::string id) {
  ContourReader reader(settings_.path.session);
  for (std::size_t at = 0; at < text_.size(); at += text_piece)
    reader.feed(std::string_view(text_).substr(at, text_piece));
  const std::vector<Block> contour = reader.finish();
  plane_ = plane_to_show(contour);
  if (!share_.take(contour.size() * sizeof(Element))) return nullptr;
  add_contour(contour);
  add_path();
  contour_.index();
  path_.index();
  Lines program(std::move(text_));
  if (!share_.take(2 * program.bytes())) return nullptr;
  said_.set_id(std::move(id));
  describe(program);
  return std::make_shared<View>(std::move(share_), std::move(said_), std::move(contour_),
                                std::move(path_), std::move(program), settings_);
}

void ViewBuilder::add_contour(const std::vector<Block>& blocks) {
  const NotTravelled masked(masked_);
  for (const Block& block : blocks) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || motion->mode == nullptr) continue;
    const bool lost = masked.contains(motion->source.index);
    const Element element{
        .feed = motion->rapid ? 0 : static_cast<float>(motion->feed),
        .line = motion->source.line,
        .tool_radius = motion->mode->active() ? static_cast<float>(motion->mode->tool_radius) : 0,
        .style = lost ? Style::contour_masked : Style::contour,
        .rapid = motion->rapid};
    add_seen(contour_, element, motion->mode->plane, motion->path, motion->normal, plane_);
    if (said_.tool_radius() == 0 && element.tool_radius > 0)
      said_.set_tool_radius(motion->mode->tool_radius);
  }
}

void ViewBuilder::add_path() {
  // The tool of a block is that of the contour block it stems from; lines come in order but for
  // subprograms, where the last one seen will do.
  std::vector<float> radius_of_line;
  for (const Element& element : contour_.all()) {
    if (element.line >= radius_of_line.size()) radius_of_line.resize(element.line + 1);
    radius_of_line[element.line] = element.tool_radius;
  }
  for (const CompensatedBlock& block : blocks_) {
    const std::uint32_t line = block.source.line;
    const Element element{
        .feed = block.rapid ? 0 : static_cast<float>(block.feed),
        .line = line,
        .tool_radius = block.origin != Origin::uncompensated && line < radius_of_line.size()
                           ? radius_of_line[line]
                           : 0,
        .style = style_of(block.origin),
        .origin = static_cast<std::uint8_t>(wire::to_proto(block.origin)),
        .rapid = block.rapid};
    add_seen(path_, element, block.plane, block.path, block.normal, plane_);
  }
  blocks_ = {};
}

void ViewBuilder::describe(const Lines& program) {
  verify::Bounds all;
  for (const Elements* elements : {&contour_, &path_}) {
    if (elements->bounds().empty) continue;
    all.add(elements->bounds().low);
    all.add(elements->bounds().high);
  }
  // A path without extent still has a square to lie in.
  const double side = std::max(all.size().maxCoeff(), 1.0) * 1.25;
  const Point middle = all.low + all.size() / 2;
  set(*said_.mutable_low(), all.low);
  set(*said_.mutable_high(), all.high);
  set(*said_.mutable_tile_low(), middle - Vector(side, side) / 2);
  said_.set_tile_size(side);
  said_.set_most_level(most_level);
  said_.set_plane(message_of(plane_));
  said_.set_contour_blocks(contour_.all().size());
  said_.set_path_blocks(path_.all().size());
  said_.set_lines(program.count());
  said_.set_path_length(path_.length());
  if (path_.all().empty()) return;
  double lowest = double{path_.all().front().third_from};
  double highest = lowest;
  for (const Element& element : path_.all()) {
    lowest = std::min(lowest, double{element.third_to});
    highest = std::max(highest, double{element.third_to});
  }
  said_.set_lowest(lowest);
  said_.set_highest(highest);
}

}  // namespace trc::server::http

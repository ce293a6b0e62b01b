#include "server/http/view/view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "core/session/contour_reader.h"
#include "core/session/outline.h"
#include "core/session/program_session.h"
#include "core/trc/result/compensated_block.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/geometry.h"
#include "proto/wire/path_item.h"
#include "server/http/view/tile.h"

namespace trc::server::http {
namespace {

constexpr std::uint32_t most_level = 24;
// A tile is shown about that large, in pixels: from 0.7 to 1.4 times. What is left out of it is
// less than half a pixel then.
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

// The plane of the first compensated motion among these; none: nothing of them is compensated.
std::optional<Plane> compensated_plane(const std::vector<Block>& blocks) {
  for (const Block& block : blocks) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion != nullptr && motion->mode != nullptr && motion->mode->active())
      return motion->mode->plane;
  }
  return std::nullopt;
}

Plane first_plane(const std::vector<Block>& blocks) {
  for (const Block& block : blocks) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion != nullptr && motion->mode != nullptr) return motion->mode->plane;
  }
  return Plane::xy;
}

// A movement as the plane that is shown sees it, one element for each piece.
void add_seen(Elements& elements, Element element, Plane plane, const Segment& shape,
              const AxisTravel& normal, Plane shown) {
  if (!verify::is_finite(shape)) return;
  element.plane = plane;
  std::vector<Segment> seen = project(plane, shape, normal, shown);
  // Straight at the viewer: a way without length in the plane.
  if (seen.empty() && (normal.moves() || start_of(shape) != end_of(shape))) {
    const Point here = to_plane(shown, from_plane(plane, start_of(shape), normal.from));
    seen.emplace_back(Line{.start = here, .end = here});
  }
  const std::size_t third = axes_of(shown).third;
  const auto third_at = [&](std::size_t piece) {
    const double share = static_cast<double>(piece) / static_cast<double>(seen.size());
    const double across = normal.from + share * (normal.to - normal.from);
    if (plane == shown) return static_cast<float>(across);
    const Point at = share == 1 ? end_of(shape) : verify::place_at(shape, share).point;
    return static_cast<float>(from_plane(plane, at, across)[third]);
  };
  for (std::size_t i = 0; i < seen.size(); ++i) {
    element.third_from = third_at(i);
    element.third_to = third_at(i + 1);
    element.ends_block = i + 1 == seen.size();
    elements.add(element, seen[i]);
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

std::uint64_t blocks_in(const Elements& elements) {
  std::uint64_t blocks = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) blocks += elements[i].ends_block ? 1 : 0;
  return blocks;
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
  return tile_of(contour_, path_, plane_of(said_.plane()), {.low = low, .side = side},
                 {.tolerance = side / (4 * tile_pixels), .most_segments = most_segments});
}

v1::View View::said_by_now() const {
  v1::View said = said_;
  const std::lock_guard lock(mutex_);
  if (output_ == nullptr) return said;
  said.clear_measuring();
  said.MergeFrom(measured_);
  return said;
}

// What the answers lacked because the path was not measured for them.
void View::measure(const ProgramSession& session, const std::vector<Diagnostic>& found) {
  const std::lock_guard lock(mutex_);
  if (const auto* clearance = session.clearance())
    wire::to_proto(wire::PathSummary{.clearance = *clearance},
                   *measured_.mutable_summary()->mutable_path());
  for (const Diagnostic& diagnostic : found)
    if (diagnostic.code == Code::clearance_violated &&
        said_.diagnostics_size() + measured_.diagnostics_size() < most_diagnostics)
      wire::to_proto(diagnostic, *measured_.add_diagnostics());
}

v1::ViewBlock View::described(const Elements& elements, std::size_t index, bool on_path) const {
  const Element& element = elements[index];
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
  const auto look = [&](const Elements& elements, bool on_path) {
    for (std::size_t i = 0; i < elements.size() && found.blocks_size() < most_blocks; ++i)
      if (elements[i].line == line) *found.add_blocks() = described(elements, i, on_path);
  };
  look(contour_, false);
  look(path_, true);
  return found;
}

v1::ViewPlace View::place_at(double share) const {
  v1::ViewPlace place;
  const auto found = path_.place_after(share * path_.length());
  if (!found) return place;
  const Element& element = path_[found->element];
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

std::string View::compensated_text(Verify verify, const std::function<void()>& interrupt) {
  SessionSetup session_setup = settings_.path.session;
  session_setup.compensator.interrupt = interrupt;
  session_setup.verify = verify;
  ProgramSession session(
      {.session = session_setup, .nc_text = true, .decimals = settings_.decimals});
  Answers out;
  std::string_view text = program_.text();
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
  // Some contours cost the square of their blocks.
  constexpr std::chrono::seconds most_measuring{60};
  const auto began = std::chrono::steady_clock::now();
  std::string text;
  try {
    text = compensated_text(said_.measuring() ? Verify::report : Verify::off, [&] {
      interrupt();
      if (said_.measuring() && std::chrono::steady_clock::now() - began > most_measuring)
        throw TooLong{};
    });
  } catch (const TooLong&) {
    text = compensated_text(Verify::off, interrupt);
  }

  // Both make the same motions; the text as it is read says where its lines end.
  ContourReader reader(settings_.path.session);
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
  ends.reserve(path_.size());
  const Plane plane = plane_of(said_.plane());
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const Element& element = path_[i];
    if (!element.ends_block) continue;
    const Position end = from_plane(plane, element.end, double{element.third_to});
    ends.push_back({.x = end[0], .y = end[1], .z = end[2], .line = element.line});
  }
  auto lines = std::make_shared<Lines>(std::move(text));
  lines->set_sources(sources_of(lines->count(), reached, ends));
  const std::lock_guard lock(mutex_);
  output_ = std::move(lines);
}

ViewBuilder::ViewBuilder(std::string text, const v1::ProgramSetup& setup,
                         wire::ProgramSettings settings, std::optional<Plane> plane, Memory& memory,
                         std::function<bool()> make_room)
    : text_(std::move(text)),
      settings_(std::move(settings)),
      share_(memory),
      make_room_(std::move(make_room)),
      reader_(settings_.path.session),
      asked_plane_(plane) {
  said_.set_name(setup.file_name());
}

bool ViewBuilder::account() {
  // What a line in the compensated text will take.
  constexpr std::size_t output_bytes = 64;
  const std::size_t bytes = contour_.bytes() + path_.bytes() + output_bytes * path_.size() +
                            waiting_.size() * sizeof(Block) +
                            contour_blocks_.capacity() * sizeof(std::uint32_t) +
                            radius_of_line_.capacity() * sizeof(float);
  while (has_memory_ && bytes > share_.bytes())
    if (!share_.take(bytes - share_.bytes())) has_memory_ = make_room_();
  return has_memory_;
}

bool ViewBuilder::read_contour() {
  if (read_bytes_ == text_.size() || !has_memory_) return false;
  const std::string_view piece = std::string_view(text_).substr(read_bytes_, text_piece);
  read_bytes_ += piece.size();
  read_lines_ += static_cast<std::uint64_t>(std::count(piece.begin(), piece.end(), '\n'));
  reader_.feed(piece);
  add_contour(read_bytes_ == text_.size() ? reader_.finish() : reader_.take());
  return account();
}

bool ViewBuilder::add(const std::vector<CompensatedBlock>& blocks) {
  // A line may give its block only when the next ones have been read.
  constexpr std::uint64_t ahead = 100;
  std::uint64_t line = 0;
  for (const CompensatedBlock& block : blocks)
    line = std::max<std::uint64_t>(line, block.source.line);
  while (!plane_ || read_lines_ < line + ahead)
    if (!read_contour()) break;
  settle_plane();
  for (const CompensatedBlock& block : blocks) {
    if (block.origin == Origin::passthrough) continue;
    const bool has_tool =
        block.origin != Origin::uncompensated && block.source.line < radius_of_line_.size();
    const Element element{.feed = block.rapid ? 0 : static_cast<float>(block.feed),
                          .line = block.source.line,
                          .tool_radius = has_tool ? radius_of_line_[block.source.line] : 0,
                          .style = style_of(block.origin),
                          .origin = static_cast<std::uint8_t>(wire::to_proto(block.origin)),
                          .rapid = block.rapid};
    add_seen(path_, element, block.plane, block.path, block.normal, *plane_);
  }
  return account();
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
  while (read_contour()) {
  }
  settle_plane();
  mark_masked();
  contour_blocks_ = {};
  radius_of_line_ = {};
  if (!account()) return nullptr;
  Lines program(std::move(text_));
  const std::size_t bytes = 2 * program.bytes();
  while (!share_.take(bytes))
    if (!make_room_()) return nullptr;
  said_.set_id(std::move(id));
  if (said_.refused()) said_.clear_measuring();
  describe(program);
  return std::make_shared<View>(std::move(share_), std::move(said_), std::move(contour_),
                                std::move(path_), std::move(program), settings_);
}

void ViewBuilder::add_contour(const std::vector<Block>& blocks) {
  if (!plane_) settle_plane(compensated_plane(blocks));
  if (!plane_) {
    waiting_.insert(waiting_.end(), blocks.begin(), blocks.end());
    return;
  }
  for (const Block& block : waiting_) add_contour(block);
  waiting_ = {};
  for (const Block& block : blocks) add_contour(block);
}

void ViewBuilder::settle_plane(std::optional<Plane> own) {
  if (!own) return;
  own_plane_ = *own;
  plane_ = asked_plane_.value_or(*own);
}

void ViewBuilder::settle_plane() {
  if (plane_) return;
  settle_plane(first_plane(waiting_));
  add_contour(std::vector<Block>());
}

void ViewBuilder::add_contour(const Block& block) {
  if (!std::holds_alternative<MotionBlock>(block)) return;
  const MotionBlock& motion = std::get<MotionBlock>(block);
  if (motion.mode == nullptr) return;
  // What leads to a contour, or from one side of it to the other, is not part of it.
  const bool active = motion.mode->active();
  const Side side = active ? motion.mode->side : Side::off;
  const bool is_contour = active && std::exchange(side_, side) == side;
  if (!active) side_ = Side::off;
  // The first one, and then the first one that is compensated.
  if (contour_.empty() || (active && said_.tool_radius() == 0))
    said_.set_unit(reader_.is_inch(motion.source.index) ? v1::LENGTH_UNIT_INCH
                                                        : v1::LENGTH_UNIT_MM);
  const Element element{.feed = motion.rapid ? 0 : static_cast<float>(motion.feed),
                        .line = motion.source.line,
                        .tool_radius = active ? static_cast<float>(motion.mode->tool_radius) : 0,
                        .style = is_contour ? Style::contour : Style::plain,
                        .rapid = motion.rapid};
  add_seen(contour_, element, motion.mode->plane, motion.path, motion.normal, *plane_);
  contour_blocks_.resize(contour_.size(), static_cast<std::uint32_t>(motion.source.index));
  if (element.line >= radius_of_line_.size()) radius_of_line_.resize(element.line + 1);
  radius_of_line_[element.line] = element.tool_radius;
  if (said_.tool_radius() == 0 && element.tool_radius > 0)
    said_.set_tool_radius(motion.mode->tool_radius);
}

void ViewBuilder::mark_masked() {
  if (masked_.empty()) return;
  const NotTravelled masked(masked_);
  for (std::size_t i = 0; i < contour_.size(); ++i)
    if (masked.contains(contour_blocks_[i])) contour_.restyle(i, Style::contour_masked);
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
  said_.set_plane(message_of(*plane_));
  said_.set_own_plane(message_of(own_plane_));
  said_.set_contour_blocks(blocks_in(contour_));
  said_.set_path_blocks(blocks_in(path_));
  said_.set_lines(program.count());
  said_.set_path_length(path_.length());
  if (path_.empty()) return;
  double lowest = double{path_[0].third_from};
  double highest = lowest;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    lowest = std::min(lowest, double{path_[i].third_to});
    highest = std::max(highest, double{path_[i].third_to});
  }
  said_.set_lowest(lowest);
  said_.set_highest(highest);
}

}  // namespace trc::server::http

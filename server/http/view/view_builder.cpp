#include "server/http/view/view_builder.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "core/session/outline.h"
#include "core/trc/walls/selection_contours.h"
#include "proto/wire/compensated_block.h"
#include "server/http/view/plane_messages.h"

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

// Blocks of a selection. Of a longer one leads are hardly seen, and all it has would be held twice.
constexpr std::size_t longest_with_leads = 1U << 16U;

struct Movement {
  Plane plane = Plane::xy;
  Segment shape{};
  AxisTravel normal{};  // across the plane
};

// A movement as the plane that is shown sees it, one element for each piece.
void add_seen(Elements& elements, Element element, const Movement& movement, Plane shown) {
  const Plane plane = movement.plane;
  const Segment& shape = movement.shape;
  const AxisTravel& normal = movement.normal;
  if (!verify::is_finite(shape)) return;
  element.plane = plane;
  if (plane == shown && verify::extent_of(shape) > 0) {
    element.third_from = static_cast<float>(normal.from);
    element.third_to = static_cast<float>(normal.to);
    return elements.add(element, shape);
  }
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

}  // namespace

ViewBuilder::ViewBuilder(ViewedProgram program, Memory& memory, std::function<bool()> make_room)
    : program_(std::move(program.text)),
      settings_(std::move(program.settings)),
      share_(memory),
      make_room_(std::move(make_room)),
      reader_(settings_.path.session),
      first_on_contour_(settings_.path.session.program.start),
      first_on_path_(settings_.path.session.program.start),
      asked_plane_(program.plane) {
  said_.set_name(std::move(program.name));
}

bool ViewBuilder::account() {
  // What a line in the compensated text will take.
  constexpr std::size_t output_bytes = 64;
  const std::size_t bytes =
      contour_.bytes() + path_.bytes() + output_bytes * path_.size() +
      (waiting_.size() + selection_.capacity()) * sizeof(Block) +
      (contour_blocks_.capacity() + replaced_.capacity()) * sizeof(std::uint32_t) +
      radius_of_line_.capacity() * sizeof(float);
  while (has_memory_ && bytes > share_.bytes())
    if (!share_.take(bytes - share_.bytes())) has_memory_ = make_room_();
  return has_memory_;
}

bool ViewBuilder::read_contour() {
  const std::string_view text = program_.text();
  if (read_bytes_ == text.size() || !has_memory_) return false;
  const std::string_view piece = text.substr(read_bytes_, text_piece);
  read_bytes_ += piece.size();
  program_.find_to(read_bytes_);
  reader_.feed(piece);
  add_contour(read_bytes_ == text.size() ? reader_.finish() : reader_.take());
  return account();
}

bool ViewBuilder::add(const std::vector<CompensatedBlock>& blocks) {
  // A line may give its block only when the next ones have been read.
  constexpr std::uint64_t ahead = 100;
  std::uint64_t line = 0;
  for (const CompensatedBlock& block : blocks)
    line = std::max<std::uint64_t>(line, block.source.line);
  while (!plane_ || program_.count() < line + ahead)
    if (!read_contour()) break;
  settle_plane();
  for (const CompensatedBlock& block : blocks) {
    if (block.origin == Origin::passthrough) continue;
    if (block.origin == Origin::kerf || block.origin == Origin::converted_circle)
      replaced_.push_back(static_cast<std::uint32_t>(block.source.index));
    const Element element{
        .feed = block.rapid ? 0 : static_cast<float>(block.feed),
        .line = block.source.line,
        .tool_radius = tool_radius_of(block),
        .style = style_of(block.origin),
        .origin = static_cast<std::uint8_t>(wire::to_proto(block.origin)),
        .rapid = block.rapid,
        .unsaid = first_on_path_.begins_unsaid(block.plane, block.path, block.normal, block.rapid)};
    add_seen(path_, element, {.plane = block.plane, .shape = block.path, .normal = block.normal},
             *plane_);
  }
  return account();
}

// The line of a retract is programmed without compensation: it has the tool of the block before.
float ViewBuilder::tool_radius_of(const CompensatedBlock& block) {
  if (block.origin == Origin::uncompensated) return 0;
  const bool is_known =
      block.source.line < radius_of_line_.size() && radius_of_line_[block.source.line] > 0;
  if (is_known) path_radius_ = radius_of_line_[block.source.line];
  return path_radius_;
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
  mark_leads();
  mark_masked();
  contour_blocks_ = {};
  radius_of_line_ = {};
  if (!account()) return nullptr;
  const std::size_t bytes = 2 * program_.bytes();
  while (!share_.take(bytes))
    if (!make_room_()) return nullptr;
  said_.set_id(std::move(id));
  if (said_.refused()) said_.clear_measuring();
  describe();
  return std::make_shared<View>(std::move(share_), ViewParts{.said = std::move(said_),
                                                             .contour = std::move(contour_),
                                                             .path = std::move(path_),
                                                             .program = std::move(program_),
                                                             .settings = settings_});
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
  if (!active) {
    side_ = Side::off;
    mark_leads();
  }
  // The first one, and then the first one that is compensated.
  if (contour_.empty() || (active && said_.tool_radius() == 0))
    said_.set_unit(reader_.is_inch(motion.source.index) ? v1::LENGTH_UNIT_INCH
                                                        : v1::LENGTH_UNIT_MM);
  const Element element{
      .feed = motion.rapid ? 0 : static_cast<float>(motion.feed),
      .line = motion.source.line,
      .tool_radius = active ? static_cast<float>(motion.mode->cutting_radius()) : 0,
      .style = is_contour ? Style::contour : Style::plain,
      .rapid = motion.rapid,
      .unsaid = first_on_contour_.begins_unsaid(motion.mode->plane, motion.path, motion.normal,
                                                motion.rapid)};
  add_seen(contour_, element,
           {.plane = motion.mode->plane, .shape = motion.path, .normal = motion.normal}, *plane_);
  contour_blocks_.resize(contour_.size(), static_cast<std::uint32_t>(motion.source.index));
  if (active && selection_.size() <= longest_with_leads) selection_.push_back(block);
  if (element.line >= radius_of_line_.size()) radius_of_line_.resize(element.line + 1);
  radius_of_line_[element.line] = element.tool_radius;
  if (active) add_tool_radius(motion.mode->cutting_radius());
}

void ViewBuilder::add_tool_radius(double radius) {
  constexpr int most_radii = 16;
  const auto& radii = said_.tool_radii();
  if (radius <= 0 || radii.size() >= most_radii) return;
  if (std::find(radii.begin(), radii.end(), radius) != radii.end()) return;
  said_.add_tool_radii(radius);
  if (radii.size() == 1) said_.set_tool_radius(radius);
}

void ViewBuilder::mark_leads() {
  const std::vector<Block> selection = std::exchange(selection_, {});
  const std::size_t begin = std::exchange(selection_begin_, contour_.size());
  if (selection.size() > longest_with_leads) return;
  std::unordered_set<std::uint32_t> leads;
  for (const SelectionContour& contour : contours_of(selection)) {
    const SidedWalls walls = find_walls(contour, settings_.path.session.compensator.leads);
    for (std::size_t i = 0; i < contour.blocks.size(); ++i)
      if (walls.is_lead(i))
        leads.insert(static_cast<std::uint32_t>(contour.blocks[i]->source.index));
  }
  if (leads.empty()) return;
  for (std::size_t i = begin; i < contour_.size(); ++i)
    if (leads.contains(contour_blocks_[i])) contour_.restyle(i, Style::lead);
}

void ViewBuilder::mark_masked() {
  if (masked_.empty() && replaced_.empty()) return;
  const NotTravelled masked(masked_);
  std::sort(replaced_.begin(), replaced_.end());
  for (std::size_t i = 0; i < contour_.size(); ++i) {
    const std::uint32_t block = contour_blocks_[i];
    if (masked.contains(block) || std::binary_search(replaced_.begin(), replaced_.end(), block))
      contour_.restyle(i, Style::contour_masked);
  }
  replaced_ = {};
}

void ViewBuilder::describe() {
  verify::Bounds all;
  for (const Elements* elements : {&contour_, &path_}) {
    const verify::Bounds own = elements->bounds();
    if (own.empty) continue;
    all.add(own.low);
    all.add(own.high);
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
  said_.set_contour_blocks(contour_.blocks());
  said_.set_path_blocks(path_.blocks());
  said_.set_lines(program_.count());
  said_.set_path_length(path_.length());
  if (path_.empty()) return;
  said_.set_lowest(path_.lowest());
  said_.set_highest(path_.highest());
}

}  // namespace trc::server::http

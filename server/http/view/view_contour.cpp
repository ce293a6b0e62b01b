#include "server/http/view/view_contour.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "core/session/contour_reader.h"
#include "core/trc/walls/selection_contours.h"
#include "server/http/view/seen.h"

namespace trc::server::http {
namespace {

// Leads of a longer selection are hardly visible, and all its blocks would be stored twice.
constexpr std::size_t longest_with_leads = 1U << 16U;

bool moves(const MotionBlock& motion) {
  return std::holds_alternative<Arc>(motion.path) || motion.normal.moves() ||
         start_of(motion.path) != end_of(motion.path);
}

// Collects plane and unit from the first motions as they are read.
class Look {
 public:
  explicit Look(ContourReader& reader) : reader_(reader) {}

  // True once plane and unit are known.
  bool take(const std::vector<Block>& blocks) {
    return std::ranges::any_of(blocks, [this](const Block& block) {
      const auto* motion = std::get_if<MotionBlock>(&block);
      return motion != nullptr && motion->mode != nullptr && take(*motion);
    });
  }
  [[nodiscard]] FirstLook found() const { return found_; }

 private:
  bool take(const MotionBlock& motion) {
    const bool active = motion.mode->active();
    if (!plane_known_) found_.plane = motion.mode->plane;
    plane_known_ = true;
    if (active && !std::exchange(compensated_, true)) found_.plane = motion.mode->plane;
    if (active || (!found_.moves && moves(motion))) {
      found_.moves = true;
      found_.is_inch = reader_.is_inch(motion.source.index);
    }
    return active && motion.mode->cutting_radius() > 0;
  }

  ContourReader& reader_;
  FirstLook found_;
  bool plane_known_ = false;
  bool compensated_ = false;
};

}  // namespace

FirstLook first_look(std::string_view text, const SessionSetup& session,
                     const std::function<void()>& pass) {
  SessionSetup passing = session;
  passing.compensator.interrupt = pass;
  ContourReader reader(passing);
  Look look(reader);
  reader.read(text, [&](const std::vector<Block>& blocks) { return !look.take(blocks); });
  return look.found();
}

ViewContour::ViewContour(const SessionSetup& session, Plane shown)
    : leads_(session.compensator.leads), shown_(shown), first_(session.program.start) {}

void ViewContour::take(std::span<const Block> blocks) {
  for (const Block& block : blocks) add(block);
}

void ViewContour::read_radii(std::uint64_t first, std::uint64_t last,
                             std::vector<float>& radii) const {
  radii.assign(last - first + 1, 0);
  const std::uint64_t end = std::min<std::uint64_t>(last + 1, radius_of_block_.size());
  if (first < end)
    std::copy(radius_of_block_.begin() + static_cast<std::ptrdiff_t>(first),
              radius_of_block_.begin() + static_cast<std::ptrdiff_t>(end), radii.begin());
}

ViewContour::Whole ViewContour::finish() {
  mark_leads();
  radius_of_block_ = {};
  return std::exchange(whole_, {});
}

void ViewContour::add(const Block& block) {
  const auto* given = std::get_if<MotionBlock>(&block);
  if (given == nullptr || given->mode == nullptr) return;
  const MotionBlock& motion = *given;
  // A motion that leads to a contour, or from one side of it to the other, is not part of it.
  const bool active = motion.mode->active();
  const Side side = active ? motion.mode->side : Side::off;
  const bool is_contour = active && std::exchange(side_, side) == side;
  if (!active) {
    side_ = Side::off;
    mark_leads();
  }
  const Element element{
      .feed = motion.rapid ? 0 : static_cast<float>(motion.feed),
      .line = motion.source.line,
      .tool_radius = active ? static_cast<float>(motion.mode->cutting_radius()) : 0,
      .style = is_contour ? Style::contour : Style::plain,
      .rapid = motion.rapid,
      .from_unknown = first_.begins_at_unknown_place(motion.mode->plane, motion.path, motion.normal,
                                                     motion.rapid)};
  add_seen(whole_.elements, element,
           {.plane = motion.mode->plane, .shape = motion.path, .normal = motion.normal}, shown_);
  const std::uint64_t index = motion.source.index;
  whole_.blocks.resize(whole_.elements.size(), static_cast<std::uint32_t>(index));
  if (active && selection_.size() <= longest_with_leads) selection_.push_back(block);
  if (index >= radius_of_block_.size()) radius_of_block_.resize(index + 1);
  radius_of_block_[index] = element.tool_radius;
  if (active) add_tool_radius(motion.mode->cutting_radius());
}

void ViewContour::add_tool_radius(double radius) {
  constexpr std::size_t most_radii = 16;
  std::vector<double>& radii = whole_.tool_radii;
  if (radius <= 0 || radii.size() >= most_radii) return;
  if (std::find(radii.begin(), radii.end(), radius) == radii.end()) radii.push_back(radius);
}

void ViewContour::mark_leads() {
  const std::vector<Block> selection = std::exchange(selection_, {});
  const std::size_t begin = std::exchange(selection_begin_, whole_.elements.size());
  if (selection.size() > longest_with_leads) return;
  std::unordered_set<std::uint32_t> leads;
  for (const SelectionContour& contour : contours_of(selection)) {
    const SidedWalls walls = find_walls(contour, leads_);
    for (std::size_t i = 0; i < contour.blocks.size(); ++i)
      if (walls.is_lead(i))
        leads.insert(static_cast<std::uint32_t>(contour.blocks[i]->source.index));
  }
  if (leads.empty()) return;
  for (std::size_t i = begin; i < whole_.elements.size(); ++i)
    if (leads.contains(whole_.blocks[i])) whole_.elements.restyle(i, Style::lead);
}

}  // namespace trc::server::http

#include "client/plot/findings.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/plot/words.h"
#include "core/base/entry_help.h"
#include "core/messages/diagnostic_text.h"

namespace trc::plot {
namespace {

class Findings {
 public:
  Findings(const Contents& contents, Picture& picture)
      : contents_(contents), picture_(picture), words_(words_in(contents.language)) {}

  void add() {
    for (const Diagnostic& diagnostic : contents_.diagnostics) {
      if (diagnostic.severity == Severity::warning)
        add_remark(words_.warning, diagnostic, picture_.warnings);
      if (diagnostic.severity == Severity::note)
        add_remark(words_.note, diagnostic, picture_.notes);
      if (diagnostic.severity == Severity::error && !picture_.fault) add_fault(diagnostic);
      if (diagnostic.entry_help) add_proposals(*diagnostic.entry_help);
    }
  }

 private:
  void add_remark(const char* severity, const Diagnostic& diagnostic,
                  std::vector<Remark>& remarks) const {
    if (remarks.size() == most_warnings) return;
    remarks.push_back({.place = place_of(diagnostic),
                       .text = text_of(severity, diagnostic),
                       .remedy = remedy_of(diagnostic)});
  }

  void add_fault(const Diagnostic& diagnostic) {
    picture_.fault =
        Fault{.place = place_of(diagnostic),
              .text = text_of(words_.error, diagnostic),
              .remedy = remedy_of(diagnostic),
              .tool_radius = diagnostic.point ? tool_radius_at(diagnostic.source.index) : 0};
  }

  // The tool does not travel these proposals; the operator may add them to the program.
  void add_proposals(const EntryHelp& help) {
    if (axes_of(picture_.plane).third != help.third_axis) return;
    for (const EntryProposal& proposal : help.proposals) add(proposal, help.leaves);
  }

  void add(const EntryProposal& proposal, bool leaves) {
    Stroke stroke{.layer = Layer::proposal,
                  .title = std::string(leaves ? words_.proposed_exit : words_.proposed_entry) +
                           words_of(proposal.shape)};
    Point at = in_plane(proposal.start);
    for (const ProposedBlock& block : proposal.blocks) {
      const Point end = in_plane(block.end);
      if (block.center) {
        stroke.segments.emplace_back(
            Arc{.start = at, .end = end, .center = in_plane(*block.center), .sweep = block.sweep});
      } else {
        stroke.segments.emplace_back(Line{.start = at, .end = end});
      }
      at = end;
    }
    std::erase_if(stroke.segments, [](const Segment& segment) { return !is_finite(segment); });
    if (!stroke.segments.empty()) picture_.strokes.push_back(std::move(stroke));
  }

  [[nodiscard]] const char* words_of(EntryProposal::Shape shape) const {
    switch (shape) {
      case EntryProposal::Shape::line:
        break;
      case EntryProposal::Shape::quarter_circle:
        return words_.as_quarter;
      case EntryProposal::Shape::inside_corner:
        return words_.as_corner;
    }
    return words_.as_line;
  }

  [[nodiscard]] Point in_plane(const DiagnosticPoint& point) const {
    return to_plane(picture_.plane, Position{point.x, point.y, point.z});
  }

  [[nodiscard]] std::optional<Point> place_of(const Diagnostic& diagnostic) const {
    if (diagnostic.point) return in_plane(*diagnostic.point);
    std::optional<Point> reached;
    for (const Block& block : contents_.programmed) {
      const auto* motion = std::get_if<MotionBlock>(&block);
      if (!motion || !motion->mode || motion->mode->plane != picture_.plane) continue;
      if (motion->source.index == diagnostic.source.index) return place_at(motion->path, 0.5).point;
      if (motion->source.index > diagnostic.source.index) break;
      reached = place_at(motion->path, 1).point;
    }
    return reached;
  }

  // The radius of the last motion under TRC up to the block; the tool remains the same after it.
  [[nodiscard]] double tool_radius_at(std::uint64_t index) const {
    double radius = 0;
    for (const Block& block : contents_.programmed) {
      const auto* motion = std::get_if<MotionBlock>(&block);
      if (!motion || !motion->mode) continue;
      if (motion->source.index > index) break;
      if (motion->mode->active()) radius = motion->mode->cutting_radius();
    }
    return radius;
  }

  [[nodiscard]] std::string text_of(const char* severity, const Diagnostic& diagnostic) const {
    std::string text = severity + std::to_string(static_cast<std::int32_t>(diagnostic.code));
    if (diagnostic.source.line > 0) text += words_.in_line + std::to_string(diagnostic.source.line);
    if (diagnostic.source.number != Source::no_number)
      text += " (N" + std::to_string(diagnostic.source.number) + ")";
    // A sender without texts for people is shown with its message.
    const DiagnosticTexts texts = texts_of(diagnostic);
    return text + ": " + (texts.text.empty() ? texts.message : texts.text);
  }

  static std::string remedy_of(const Diagnostic& diagnostic) {
    const DiagnosticTexts texts = texts_of(diagnostic);
    return texts.help.empty() ? texts.remedy : texts.help;
  }

  const Contents& contents_;
  Picture& picture_;
  const Words& words_;
};

}  // namespace

void add_findings(const Contents& contents, Picture& picture) { Findings(contents, picture).add(); }

}  // namespace trc::plot

#include "proto/wire/diagnostic.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "core/base/entry_help.h"
#include "core/messages/diagnostic_text.h"
#include "proto/wire/enums.h"

namespace trc::wire {
namespace {

// Indexed by the axis across the plane.
constexpr std::array planes{v1::PLANE_YZ, v1::PLANE_ZX, v1::PLANE_XY};

using Shape = EntryProposal::Shape;
constexpr EnumTable<v1::EntryProposal::Shape, Shape, 3> shapes{{
    {v1::EntryProposal::SHAPE_LINE, Shape::line},
    {v1::EntryProposal::SHAPE_QUARTER_CIRCLE, Shape::quarter_circle},
    {v1::EntryProposal::SHAPE_INSIDE_CORNER, Shape::inside_corner},
}};

void write(const DiagnosticPoint& point, v1::Position& message) {
  message.set_x(point.x);
  message.set_y(point.y);
  message.set_z(point.z);
}

DiagnosticPoint point_of(const v1::Position& message) {
  return {.x = message.x(), .y = message.y(), .z = message.z()};
}

void write(const Source& source, std::uint32_t column, v1::ProgramPlace& message) {
  if (source.line != 0) message.set_line(source.line);
  if (column != 0) message.set_column(column);
  if (source.number != Source::no_number)
    message.set_source_number(static_cast<std::uint64_t>(source.number));
  if (source.index <= std::numeric_limits<std::uint32_t>::max())
    message.set_source_index(static_cast<std::uint32_t>(source.index));
}

void write(const EntryProposal& proposal, v1::EntryProposal& message) {
  message.set_shape(shapes.to_proto(proposal.shape));
  write(proposal.start, *message.mutable_start());
  for (const ProposedBlock& block : proposal.blocks) {
    v1::ProposedMotion& motion = *message.add_motions();
    if (!block.center) {
      write(block.end, *motion.mutable_line()->mutable_end());
      continue;
    }
    write(block.end, *motion.mutable_arc()->mutable_end());
    write(*block.center, *motion.mutable_arc()->mutable_center());
    motion.mutable_arc()->set_sweep(block.sweep);
  }
}

EntryProposal proposal_of(const v1::EntryProposal& message) {
  FieldFaults faults;
  EntryProposal proposal{
      .shape = shapes.from_proto(message.shape(), FieldPath("shape"), faults).value_or(Shape::line),
      .start = point_of(message.start())};
  for (const v1::ProposedMotion& motion : message.motions()) {
    ProposedBlock block{.end = point_of(motion.line().end())};
    if (motion.has_arc())
      block = {.end = point_of(motion.arc().end()),
               .center = point_of(motion.arc().center()),
               .sweep = motion.arc().sweep()};
    proposal.blocks.push_back(block);
  }
  return proposal;
}

void write(const EntryHelp& help, v1::EntryHelp& message) {
  message.set_leaves(help.leaves);
  message.set_plane(planes.at(help.third_axis));
  message.set_given_length(help.given_length);
  if (help.needed_length > 0) message.set_needed_length(help.needed_length);
  message.set_tried_on(help.tried_on);
  message.set_replaced_blocks(help.replaced);
  message.set_left_out_blocks(help.left_out);
  if (help.legal) write(*help.legal, *message.mutable_legal_point());
  for (const EntryProposal& proposal : help.proposals) write(proposal, *message.add_proposals());
}

EntryHelp help_of(const v1::EntryHelp& message) {
  EntryHelp help{.leaves = message.leaves(),
                 .given_length = message.given_length(),
                 .needed_length = message.needed_length(),
                 .tried_on = message.tried_on(),
                 .replaced = message.replaced_blocks(),
                 .left_out = message.left_out_blocks()};
  if (message.plane() == v1::PLANE_ZX) help.third_axis = 1;
  if (message.plane() == v1::PLANE_YZ) help.third_axis = 0;
  if (message.has_legal_point()) help.legal = point_of(message.legal_point());
  for (const v1::EntryProposal& proposal : message.proposals())
    help.proposals.push_back(proposal_of(proposal));
  return help;
}

}  // namespace

v1::Diagnostic::Severity to_proto(Severity severity) {
  switch (severity) {
    case Severity::note:
      return v1::Diagnostic::NOTE;
    case Severity::warning:
      return v1::Diagnostic::WARNING;
    case Severity::error:
      break;
  }
  return v1::Diagnostic::ERROR;
}

void to_proto(const Diagnostic& diagnostic, v1::Diagnostic& message) {
  message.Clear();
  const Source& source = diagnostic.source;
  DiagnosticTexts texts = texts_of(diagnostic);
  message.set_code(static_cast<std::int32_t>(diagnostic.code));
  message.set_severity(to_proto(diagnostic.severity));
  if (source.number != Source::no_number)
    message.set_source_number(static_cast<std::uint64_t>(source.number));
  if (source.index <= std::numeric_limits<std::uint32_t>::max())
    message.set_source_index(static_cast<std::uint32_t>(source.index));
  if (source.line != 0) message.set_line(source.line);
  if (diagnostic.column != 0) message.set_column(diagnostic.column);
  message.set_message(std::move(texts.message));
  for (const DiagnosticValue& value : diagnostic.values)
    (*message.mutable_values())[value.name] = value.value;
  message.set_remedy(std::move(texts.remedy));
  if (diagnostic.point) write(*diagnostic.point, *message.mutable_point());
  if (diagnostic.entry_help) write(*diagnostic.entry_help, *message.mutable_entry_help());
  message.set_reason(std::move(texts.reason));
  message.set_detail(diagnostic.detail);
  const Language language = diagnostic.language;
  message.set_title(std::move(texts.title));
  message.set_text(std::move(texts.text));
  message.set_help(std::move(texts.help));
  write(source, diagnostic.column, *message.mutable_place());
  for (const RelatedPlace& related : related_places(diagnostic)) {
    v1::RelatedPlace& place = *message.add_related_places();
    place.set_name(related.name);
    place.set_text(text_of(related, language));
    write(related.source, 0, *place.mutable_place());
  }
  message.set_language(language == Language::german ? "de" : "en");
  message.set_inch(diagnostic.inch);
  for (const CallPlace& place : diagnostic.calls) {
    v1::SubprogramCall& call = *message.add_calls();
    call.set_subprogram(place.subprogram);
    call.set_called_from(place.called_from);
    if (place.line_within > 0) call.set_line_within(place.line_within);
  }
}

Diagnostic from_proto(const v1::Diagnostic& message) {
  Diagnostic diagnostic;
  DiagnosticTexts texts{.message = message.message(),
                        .remedy = message.remedy(),
                        .reason = message.reason(),
                        .title = message.title(),
                        .text = message.text(),
                        .help = message.help()};
  // A sender without texts for people is shown with its message.
  if (texts.text.empty()) texts.text = texts.message;
  if (texts.help.empty()) texts.help = texts.remedy;
  diagnostic.texts = std::make_shared<const DiagnosticTexts>(std::move(texts));
  diagnostic.code = static_cast<Code>(message.code());
  // An unknown severity counts as the gravest.
  diagnostic.severity = message.severity() == v1::Diagnostic::NOTE      ? Severity::note
                        : message.severity() == v1::Diagnostic::WARNING ? Severity::warning
                                                                        : Severity::error;
  diagnostic.source = {.index = message.source_index(),
                       .number = message.has_source_number()
                                     ? static_cast<std::int64_t>(message.source_number())
                                     : Source::no_number,
                       .line = message.line()};
  diagnostic.column = message.column();
  diagnostic.detail = message.detail();
  for (const auto& [name, value] : message.values())
    diagnostic.values.push_back({.name = name, .value = value});
  std::sort(diagnostic.values.begin(), diagnostic.values.end(),
            [](const DiagnosticValue& a, const DiagnosticValue& b) { return a.name < b.name; });
  diagnostic.inch = message.inch();
  for (const v1::SubprogramCall& call : message.calls())
    diagnostic.calls.push_back({.subprogram = call.subprogram(),
                                .called_from = call.called_from(),
                                .line_within = call.line_within()});
  diagnostic.language = language_of_tag(message.language()).value_or(Language::english);
  if (message.has_point()) diagnostic.point = point_of(message.point());
  if (message.has_entry_help())
    diagnostic.entry_help = std::make_shared<const EntryHelp>(help_of(message.entry_help()));
  return diagnostic;
}

}  // namespace trc::wire

#include "client/load/sample_program.h"

#include <array>

#include "core/nc/text/number_format.h"

namespace trc::load {
namespace {

constexpr int decimals = 6;

void append_word(std::string_view letter, double mm, std::string& out) {
  out += letter;
  append_units(out, to_units(mm, decimals), decimals);
}

void append_point(const Point& point, std::string& out) {
  append_word(" X", point.x(), out);
  append_word(" Y", point.y(), out);
}

}  // namespace

void SampleProgram::append(std::uint64_t index, std::string& out) const {
  out += 'N';
  out += std::to_string(10 * (index + 1));
  const std::uint64_t behind_head = index - head_.size();
  if (index < head_.size()) {
    out += ' ';
    out += head_[index];
  } else if (behind_head == 0) {
    out += " G00";
    append_point(contour_.approach_from(), out);
  } else if (behind_head == 1) {
    out += " G42 G01";
    append_point(contour_.start(), out);
    out += " F1000";
  } else if (behind_head - 2 < contour_.size()) {
    append_element(behind_head - 2, out);
  } else if (behind_head - 2 == contour_.size()) {
    out += " G40 G01";
    append_point(contour_.retract_to(), out);
  } else {
    out += " M30";
  }
  out += '\n';
}

void SampleProgram::append_element(std::uint64_t index, std::string& out) const {
  constexpr std::array<std::string_view, 3> functions{" G01", " G02", " G03"};
  const ContourElement& element = contour_[index];
  out += functions[static_cast<std::size_t>(element.kind)];
  append_point(element.end, out);
  if (element.kind == ContourElement::Kind::line) return;
  const Point& from = index == 0 ? contour_.start() : contour_[index - 1].end;
  append_word(" I", element.center.x() - from.x(), out);
  append_word(" J", element.center.y() - from.y(), out);
}

std::string generate(const ShapeRequest& request, const TextSink& sink) {
  if (std::string fault = fault_of(request); !fault.empty()) return fault;
  constexpr std::size_t piece = 64U * 1024U;
  const SampleContour contour(request);
  std::string radius = "V.G.WZ_AKT.R = ";
  append_units(radius, to_units(request.tool_radius, decimals), decimals);
  const SampleProgram program(contour, {"G17 G90 G162 G139 G25", radius});
  std::string text;
  for (std::uint64_t line = 0; line < program.size(); ++line) {
    program.append(line, text);
    if (text.size() < piece && line + 1 < program.size()) continue;
    if (!sink(text)) break;
    text.clear();
  }
  return {};
}

}  // namespace trc::load

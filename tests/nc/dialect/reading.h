#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/nc/dialect/interpreter.h"

namespace trc::testing {

// What the reader made of a program.
struct Reading {
  std::vector<Block> blocks{};
  std::vector<ProgramLine> lines{};
  std::vector<Diagnostic> diagnostics{};
  bool stopped = false;

  // The only diagnostic, or an empty one of code 0.
  [[nodiscard]] Diagnostic only() const {
    return diagnostics.size() == 1 ? diagnostics.front() : Diagnostic{};
  }
  [[nodiscard]] Code code() const { return only().code; }

  [[nodiscard]] std::vector<MotionBlock> motions() const {
    std::vector<MotionBlock> found;
    for (const Block& block : blocks)
      if (const auto* motion = std::get_if<MotionBlock>(&block)) found.push_back(*motion);
    return found;
  }
  [[nodiscard]] MotionBlock last_motion() const {
    const auto all = motions();
    return all.empty() ? MotionBlock{} : all.back();
  }
  // The text of all passive blocks that carry one.
  [[nodiscard]] std::vector<std::string> technology() const {
    std::vector<std::string> found;
    for (const Block& block : blocks)
      if (const auto* passive = std::get_if<PassiveBlock>(&block);
          passive != nullptr && !passive->text.empty())
        found.push_back(passive->text);
    return found;
  }
  // All lines with their ends: the program.
  [[nodiscard]] std::string text() const {
    std::string joined;
    for (const ProgramLine& line : lines) joined.append(line.text).append(line.line_end);
    return joined;
  }
};

// Reads `text` given in pieces of `piece` bytes; 0: in one.
// The tool has a radius of 1 mm unless `given` says another one.
inline Reading read(std::string_view text, const ProgramSetup& given = {}, std::size_t piece = 0,
                    const ReaderLimits& limits = {}) {
  Reading reading;
  Diagnostics diagnostics;
  ProgramSetup setup = given;
  if (setup.mode.tool_radius == 0 && !setup.tool_radius_given) setup.mode.tool_radius = 1;
  ProgramState state(setup, {}, diagnostics, reading.blocks);
  Interpreter interpreter(limits, state, diagnostics);
  std::vector<LinePointer> lines;
  bool goes_on = true;
  const std::size_t step = piece == 0 ? std::max<std::size_t>(text.size(), 1) : piece;
  for (std::size_t at = 0; at < text.size() && goes_on; at += step)
    goes_on = interpreter.feed(text.substr(at, step), lines);
  if (goes_on) interpreter.finish(lines);
  for (LinePointer& line : lines) reading.lines.push_back(std::move(*line));
  reading.stopped = diagnostics.stopped();
  reading.diagnostics = diagnostics.take();
  return reading;
}

// As an operator reads it: "3:7 900008".
inline std::string place_and_code(const Diagnostic& diagnostic) {
  return std::to_string(diagnostic.source.line) + ":" + std::to_string(diagnostic.column) + " " +
         std::to_string(static_cast<int>(diagnostic.code));
}

}  // namespace trc::testing

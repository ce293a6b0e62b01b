#include "core/nc/convert/conversion.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "core/nc/convert/converted_comments.h"
#include "core/nc/convert/plain_words.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/interpreter.h"
#include "core/nc/text/characters.h"
#include "core/nc/writer/nc_writer.h"
#include "core/nc/writer/writer_setup.h"

namespace trc {
namespace {

// Plain programs use mm, the initial centre mode of the dialect and axis names of one letter.
NcWriter::Setup plain_setup(const ProgramSetup& setup, const Dialect& to) {
  NcWriter::Setup plain = writer_setup(setup, to);
  plain.absolute_center = to.name == DialectName::heidenhain;
  plain.unit = LengthUnit::mm;
  plain.renumbers = false;
  plain.tracking_names.clear();
  return plain;
}

constexpr std::int64_t unnamed_tool = -1;  // loaded by M6 without any T so far

class Conversion {
 public:
  Conversion(const ProgramSetup& setup, DialectName to)
      : to_(dialect_of(to)),
        setup_(setup),
        klartext_(to == DialectName::heidenhain),
        written_(plain_setup(setup, to_)),
        writer_(written_),
        words_(setup, to),
        place_(setup.start),
        plane_(setup.mode.plane) {}

  ConvertedProgram run(std::string_view program);

 private:
  bool write_line(const ProgramLine& line, std::vector<Block>& blocks);
  void write_text(const std::string& text, RoleSet roles = 0);
  void note_excess(const NcWriter::Excess& excess);
  bool write_tool(const ProgramLine& line, PlainWords& words);
  bool take_length(const ProgramLine& line, const PlainWords& words);
  bool check_length_of_motion(const ProgramLine& line, const std::vector<Block>& blocks);
  [[nodiscard]] std::string name_of_length(std::int64_t tool) const;
  // These controls only use the length of the tool in the spindle.
  [[nodiscard]] bool takes_own_length() const {
    return klartext_ || to_.name == DialectName::sinumerik;
  }
  [[nodiscard]] bool waits_for_motion(const ProgramLine& line,
                                      const std::vector<Block>& blocks) const;
  [[nodiscard]] std::string length_word();
  bool write_motions(const ProgramLine& line, const std::vector<Block>& blocks,
                     const std::string& words, const std::string& comment);
  [[nodiscard]] LinePointer line_of_motion(const ProgramLine& line, std::string_view words,
                                           std::string_view comment);
  [[nodiscard]] std::string spelled(const PlainWords& words) const;
  [[nodiscard]] AxisSet axes_named(const ProgramLine& line) const;
  [[nodiscard]] LinePointer new_line();
  void begin();
  void end();

  const Dialect& to_;
  const ProgramSetup& setup_;
  bool klartext_;
  NcWriter::Setup written_;
  NcWriter writer_;
  PlainWordsReader words_;
  ConvertedProgram result_{};
  std::uint64_t index_ = 0;
  Position place_;
  Plane plane_;
  std::int64_t tool_ = 0;  // of the T word, until M6 loads it
  // The tool in the spindle, if the program has named it, and the tool made ready.
  std::optional<std::int64_t> loaded_{};
  std::optional<std::int64_t> ready_{};
  std::int64_t length_ = 0;           // the tool whose length is in force; 0: none
  bool has_length_to_write_ = false;  // the output still has another length
  // The tool whose length the output has in force if the control takes it with the change.
  std::int64_t length_taken_ = 0;
  bool has_feed_ = false;
  bool ended_ = false;
  std::uint32_t line_ = 1;  // of the given program, which is being written
  std::optional<ConvertedProgram::Fault> too_long_{};
};

LinePointer Conversion::new_line() {
  LinePointer line = std::make_unique<ProgramLine>();
  line->line_end = "\n";
  line->has_words = true;
  line->source = {.index = index_++, .line = 1};
  line->absolute_center = klartext_;
  line->plane = plane_;
  // The feed is not one of the program: the writer adds the feed that its own text needs.
  line->feed = -1;
  return line;
}

void Conversion::write_text(const std::string& text, RoleSet roles) {
  LinePointer line = new_line();
  line->text = text;
  line->roles = roles;
  if (text.size() > to_.limits.characters)
    note_excess({.count = text.size(), .limit = to_.limits.characters});
  writer_.take(std::move(line), {});
}

void Conversion::begin() {
  const std::string plane(name_of(plane_));
  switch (to_.name) {
    case DialectName::heidenhain:
      return write_text("BEGIN PGM CONVERTED MM");
    case DialectName::fanuc:
      return write_text(plane + " G21 G40 G90 G94");
    case DialectName::linuxcnc:
      return write_text(plane + " G21 G40 G90 G91.1 G94");
    case DialectName::sinumerik:
      return write_text(plane + " G71 G40 G90 G94");
    case DialectName::isg:
      return write_text(plane + " G71 G40 G90 G94 G162");
  }
}

void Conversion::end() {
  if (klartext_) return write_text("END PGM CONVERTED MM");
  if (!ended_) write_text("M30");
}

std::string Conversion::spelled(const PlainWords& words) const {
  std::string text;
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " ") + word; };
  if (!klartext_ && words.tool) add("T" + std::to_string(*words.tool));
  if (!klartext_ && words.loads_tool) add("M6");
  if (!klartext_ && !words.speed.empty()) add("S" + words.speed);
  for (const std::string& function : words.functions) add(function);
  return text;
}

// Klartext writes tool and speed as a separate statement.
bool Conversion::write_tool(const ProgramLine& line, PlainWords& words) {
  if (!klartext_) return true;
  if (words.tool) tool_ = *words.tool;
  if (words.loads_tool && tool_ == 0) return words_.fail(line, "M6 without a tool");
  if (words.loads_tool || !words.speed.empty())
    write_text("TOOL CALL " + (words.loads_tool ? std::to_string(tool_) + " " : std::string()) +
               "Z" + (words.speed.empty() ? "" : " S" + words.speed));
  return true;
}

// Finds the length that is in force from the line on. SINUMERIK and HEIDENHAIN activate the length
// of a tool with its change, the others with a separate word.
bool Conversion::take_length(const ProgramLine& line, const PlainWords& words) {
  const bool comes_with_tool =
      setup_.dialect == DialectName::sinumerik || setup_.dialect == DialectName::heidenhain;
  if (words.tool) ready_ = words.tool;
  if (words.loads_tool && ready_) loaded_ = ready_;
  if (words.next_tool) ready_ = words.next_tool;
  std::optional<std::int64_t> wanted = words.length;
  if (words.begins_length && !wanted) wanted = loaded_;
  if (words.ends_length && length_ != 0) wanted = 0;
  if (comes_with_tool && words.loads_tool) wanted = loaded_;
  if (words.loads_tool && takes_own_length()) length_taken_ = loaded_.value_or(unnamed_tool);
  // D beside a T that M6 loads later is that of its tool.
  if (words.names_edge && !loaded_ && !words.tool && to_.name != DialectName::sinumerik &&
      !klartext_)
    return words_.fail(line, "D1, the length of a tool without its T");
  if (words.begins_length && !wanted) return words_.fail(line, "G43 without the number of a tool");
  if (!wanted) return true;
  if (takes_own_length() && *wanted != 0 && *wanted != loaded_)
    return words_.fail(line, name_of_length(*wanted) +
                                 (loaded_ ? ", the length of another tool than the one loaded"
                                          : ", the length of a tool without its T"));
  if (klartext_ && *wanted == 0 && words.ends_length) return words_.fail(line, "G49");
  length_ = *wanted;
  has_length_to_write_ = !klartext_;
  return true;
}

std::string Conversion::name_of_length(std::int64_t tool) const {
  return (setup_.dialect == DialectName::isg ? "D" : "G43 H") + std::to_string(tool);
}

// The change of the tool has put its length in force in the output: a motion across the plane may
// not have it unless the program has it too.
bool Conversion::check_length_of_motion(const ProgramLine& line, const std::vector<Block>& blocks) {
  const std::size_t third = axes_of(plane_).third;
  const bool is_same = !takes_own_length() || has_length_to_write_ || length_taken_ == length_;
  if (is_same || blocks.empty() || (axes_named(line) & axis_bit(third)) == 0) return true;
  if (length_ != 0)
    return words_.fail(
        line, name_of_length(length_) + ", the length of another tool than the one loaded");
  if (klartext_)
    return words_.fail(line, std::string(1, "XYZ"[third]) + " without the length of tool " +
                                 std::to_string(length_taken_));
  has_length_to_write_ = true;
  return true;
}

std::string Conversion::length_word() {
  has_length_to_write_ = false;
  length_taken_ = length_;
  const std::string number = std::to_string(length_);
  if (to_.name == DialectName::sinumerik) return length_ == 0 ? "D0" : "D1";
  if (to_.name == DialectName::isg) return "D" + number;
  return length_ == 0 ? "G49" : "G43 H" + number;
}

// FANUC: G43 alone in a block moves some machines by the length. It therefore waits for the next Z,
// as programmers write it.
bool Conversion::waits_for_motion(const ProgramLine& line, const std::vector<Block>& blocks) const {
  return to_.name == DialectName::fanuc && (blocks.empty() || (axes_named(line) & 4) == 0);
}

AxisSet Conversion::axes_named(const ProgramLine& line) const {
  if (line.klartext) return line.klartext->axes;
  AxisSet named = line.main_axes;
  if (!line.names_other_axes) return named;
  for (const WordRange& word : line.words) {
    if (word.role != WordRole::coordinate) continue;
    if (is_polar(line, word)) named |= 7;
    const std::size_t axis = written_.tracking_letters.find(upper(line.text[word.begin]));
    if (axis != std::string::npos && names_an_axis(line, word)) named |= axis_bit(3 + axis);
  }
  return named;
}

// Keeps the axis words of the line even if the axes do not have to move by our count: perhaps the
// line alone gives their position on the machine (D-94).
LinePointer Conversion::line_of_motion(const ProgramLine& line, std::string_view words,
                                       std::string_view comment) {
  LinePointer written = new_line();
  written->is_motion = written->has_trc_words = true;
  const AxisSet named = axes_named(line);
  written->main_axes = static_cast<std::uint8_t>(named & 7);
  const auto add = [&](std::string_view word, WordRole role) {
    if (word.empty()) return;
    const auto begin = static_cast<std::uint32_t>(written->text.size());
    written->text += word;
    written->words.push_back(
        {.begin = begin, .end = static_cast<std::uint32_t>(written->text.size()), .role = role});
    written->text += ' ';
    written->roles |= bit(role);
  };
  if (klartext_) {
    written->klartext = KlartextLine{.axes = named};
  } else {
    const std::string letters = "XYZ" + written_.tracking_letters;
    for (std::size_t axis = 0; axis < letters.size(); ++axis)
      if ((named & axis_bit(axis)) != 0)
        add(std::string_view(letters).substr(axis, 1), WordRole::coordinate);
    written->names_other_axes = (named & ~AxisSet{7}) != 0;
  }
  add(words, WordRole::technology);
  add(comment, WordRole::comment);
  return written;
}

bool Conversion::write_motions(const ProgramLine& line, const std::vector<Block>& blocks,
                               const std::string& words, const std::string& comment) {
  LinePointer written = line_of_motion(line, words, comment);
  NcWriter::Meaning meaning{.gives_block = true};
  std::vector<CompensatedBlock> motions;
  for (const Block& block : blocks) {
    CompensatedBlock& motion = motions.emplace_back();
    motion.source = written->source;
    std::visit(
        [&](const auto& given) {
          motion.plane = given.mode->plane;
          motion.rapid = given.rapid;
          motion.normal = given.normal;
          motion.feed = given.feed;
          motion.tracking = given.tracking;
        },
        block);
    const auto* moved = std::get_if<MotionBlock>(&block);
    const Point stands = to_plane(motion.plane, place_);
    motion.path = moved != nullptr ? moved->path : Segment(Line{stands, stands});
    place_ = from_plane(motion.plane, end_of(motion.path), motion.normal.to);
    const bool cuts = !motion.rapid && (moved != nullptr || std::get<PassiveBlock>(block).moves);
    // The previous feed would stay in force.
    if (cuts && motion.feed == 0 && has_feed_)
      return words_.fail(line, "a feed that is no number per minute");
    has_feed_ |= motion.feed > 0;
  }
  meaning.end = place_;
  writer_.follow_decimals(line);
  writer_.take(std::move(written), meaning);
  for (const CompensatedBlock& motion : motions) writer_.write(motion, result_.text);
  if (writer_.excess()) note_excess(*writer_.excess());
  return true;
}

// The first one is told.
void Conversion::note_excess(const NcWriter::Excess& excess) {
  const bool digits = excess.of == NcWriter::Excess::Of::digits;
  if (!too_long_)
    too_long_ = {.word = std::string(digits ? "a number of " : "a line of ") +
                         std::to_string(excess.count) + (digits ? " digits" : " characters") +
                         ", of which the control takes " + std::to_string(excess.limit),
                 .line = line_};
}

bool Conversion::write_line(const ProgramLine& line, std::vector<Block>& blocks) {
  line_ = line.source.line;
  PlainWords words;
  const bool said = words_.read(line, words);
  ended_ |= words.ends_program;
  if (words.plane && *words.plane != plane_) {
    plane_ = *words.plane;
    write_text(std::string(name_of(plane_)), bit(WordRole::mode));
  }
  const bool takes_length =
      said && take_length(line, words) && check_length_of_motion(line, blocks);
  if (!write_tool(line, words) || !said || !takes_length) return false;
  // The control turns the length with the plane.
  if (plane_ != Plane::xy && length_ != 0 && setup_.dialect == DialectName::sinumerik)
    return words_.fail(line, std::string(name_of(plane_)) + " with the length of a tool");
  std::string text = spelled(words);
  const std::string comment = spelled_comment(std::move(words.comment), to_.name);
  std::erase_if(blocks, [](const Block& block) {
    const auto* passive = std::get_if<PassiveBlock>(&block);
    return passive != nullptr && !passive->text.empty();
  });
  const bool on_arc = std::ranges::any_of(blocks, [](const Block& block) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    return motion != nullptr && is_arc(motion->path);
  });
  std::string length;
  if (has_length_to_write_ && !waits_for_motion(line, blocks)) length = length_word();
  if (!length.empty() && on_arc && to_.name == DialectName::fanuc)
    return words_.fail(line, length + " in an arc");
  if (!length.empty() && !blocks.empty() && (words.loads_tool || to_.name == DialectName::fanuc))
    text += (text.empty() ? "" : " ") + std::exchange(length, {});
  if (!length.empty() && !blocks.empty()) write_text(std::exchange(length, {}));
  if (blocks.empty()) {
    if (!text.empty() && !comment.empty()) text += ' ';
    text += comment;
    if (!text.empty()) write_text(text);
    if (!length.empty()) write_text(length);
  } else if (!write_motions(line, blocks, text, comment)) {
    return false;
  }
  // T2 M6 T3: T3 comes after the change.
  if (words.next_tool && klartext_) tool_ = *words.next_tool;
  if (words.next_tool && !klartext_) write_text("T" + std::to_string(*words.next_tool));
  return true;
}

ConvertedProgram Conversion::run(std::string_view program) {
  Diagnostics diagnostics;
  std::vector<Block> blocks;
  ProgramState state(setup_, {}, diagnostics, blocks);
  Interpreter interpreter({.longest_line = 1 << 20}, state, diagnostics);
  std::vector<LinePointer> lines;
  if (interpreter.feed(with_settings_as_comments(program, setup_.dialect), lines))
    interpreter.finish(lines);
  if (diagnostics.stopped()) {
    const std::vector<Diagnostic> told = diagnostics.take();
    return {.faults = {{.word = message_of(told.back()), .line = told.back().source.line}}};
  }
  if (klartext_ && plane_ != Plane::xy)
    words_.faults().push_back({.word = std::string(name_of(plane_)).append(plane_of_klartext)});
  words_.look_for_tool_changes(lines);
  begin();
  auto next = blocks.begin();
  for (const LinePointer& line : lines) {
    std::vector<Block> own;
    while (line->has_words && next != blocks.end() && index_of(*next) == line->source.index)
      own.push_back(std::move(*next++));
    if (ended_) break;
    (void)write_line(*line, own);
  }
  if (!words_.faults().empty()) return {.faults = std::move(words_.faults())};
  end();
  writer_.finish(result_.text);
  if (too_long_) return {.faults = {std::move(*too_long_)}};
  return std::move(result_);
}

}  // namespace

ConvertedProgram convert_program(std::string_view program, const ProgramSetup& setup,
                                 DialectName to) {
  return Conversion(setup, to).run(program);
}

}  // namespace trc

#include "core/session/conversion.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/interpreter.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_tool_words.h"
#include "core/nc/text/words.h"
#include "core/nc/writer/nc_writer.h"

namespace trc {
namespace {

std::string capitals(std::string_view text) {
  std::string result;
  for (const char sign : text)
    if (sign != ' ' && sign != '\t') result += upper(sign);
  return result;
}

// A letter and a whole number; -1: anything else.
std::int64_t whole_behind(std::string_view word, char letter) {
  if (word.size() < 2 || word.size() > 10 || word[0] != letter) return -1;
  std::int64_t number = 0;
  for (const char digit : word.substr(1)) {
    if (digit < '0' || digit > '9') return -1;
    number = 10 * number + (digit - '0');
  }
  return number;
}

// A number of S, without sign.
bool is_speed(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.") == std::string_view::npos;
}

std::string_view name_of(Plane plane) {
  return plane == Plane::xy ? "G17" : plane == Plane::zx ? "G18" : "G19";
}

constexpr std::string_view plane_of_klartext = ", a plane: Klartext has it with TOOL CALL";

// What a line says besides its motion.
struct Words {
  std::vector<std::string> functions{};  // M
  std::string speed{};                   // S, its number
  std::optional<std::int64_t> tool{};
  std::optional<std::int64_t> next_tool{};  // T2 M6 T3: made ready behind the change
  bool loads_tool = false;
  std::string comment{};  // its text
};

// #500=#500+1, R1=R1+1 and V.S.PARTS = 2, which the control keeps for programs of its own (D-88,
// D-89). Where what sets them begins; npos: the line is another one.
std::size_t begin_of_setting(std::string_view line, DialectName dialect) {
  constexpr std::string_view digits = "0123456789";
  const auto behind_blanks = [&](std::size_t at) {
    return std::min(line.find_first_not_of(" \t", at), line.size());
  };
  std::size_t begin = behind_blanks(0);
  if (begin < line.size() && upper(line[begin]) == 'N')
    begin = behind_blanks(std::min(line.find_first_not_of(digits, begin + 1), line.size()));
  const std::string text = capitals(line.substr(begin));
  const auto is_parameter = [&] {
    const std::size_t behind = text.find_first_not_of(digits, 1);
    return text.starts_with('R') && behind > 1 && behind != std::string::npos &&
           text[behind] == '=';
  };
  // #3003 and the like are switches of the control.
  constexpr std::size_t most_digits = 3;
  bool sets = false;
  if (dialect == DialectName::fanuc)
    sets = text.starts_with('#') && text.find_first_not_of(digits, 1) <= most_digits + 1;
  else if (dialect == DialectName::linuxcnc)
    sets = text.starts_with('#');
  else if (dialect == DialectName::sinumerik)
    sets = is_parameter();
  else if (dialect == DialectName::isg)
    sets = text.starts_with("V.S.") || text.starts_with("V.E.");
  return sets ? begin : std::string_view::npos;
}

// (ABORT, …): a comment that LINUXCNC acts on.
bool is_command_of_linuxcnc(std::string_view comment) {
  constexpr auto commands = std::to_array<std::string_view>(
      {"ABORT,", "DEBUG,", "LOG,", "LOGAPPEND,", "LOGCLOSE", "LOGOPEN,", "MSG,", "PRINT,",
       "PROBECLOSE", "PROBEOPEN", "PY,", "PYRUN,"});
  const std::string text = capitals(comment);
  return std::ranges::any_of(commands, [&](auto command) { return text.starts_with(command); });
}

// The program with such settings as comments: another control has no such variables.
std::string with_settings_as_comments(std::string_view program, DialectName dialect) {
  std::string text;
  for (std::size_t at = 0; at < program.size();) {
    const std::size_t end = std::min(program.find('\n', at), program.size() - 1) + 1;
    const std::string_view line = program.substr(at, end - at);
    at = end;
    const std::size_t begin = begin_of_setting(line, dialect);
    if (begin == std::string_view::npos) {
      text.append(line);
      continue;
    }
    const bool sinumerik = dialect == DialectName::sinumerik;
    const std::size_t behind =
        std::min(line.find_first_of(sinumerik ? "\r\n" : "(;\r\n", begin), line.size());
    text.append(line.substr(0, begin)).append(sinumerik ? ";" : "(");
    text.append(without_blanks_behind(line.substr(begin, behind - begin)));
    text.append(sinumerik ? "" : ")").append(line.substr(behind));
  }
  return text;
}

class Conversion {
 public:
  Conversion(const ProgramSetup& setup, DialectName to)
      : from_(dialect_of(setup.dialect)),
        to_(dialect_of(to)),
        setup_(setup),
        klartext_(to == DialectName::heidenhain),
        writer_({.decimals = setup.decimals,
                 .start = setup.start,
                 .motion = to_.motion.value_or(MotionKind::rapid),
                 .absolute_center = klartext_,
                 .plane = setup.mode.plane,
                 .spelling = {.points = to_.writes_points, .klartext = klartext_},
                 .tracking_letters = letters_of(setup)}),
        place_(setup.start),
        plane_(setup.mode.plane) {}

  ConvertedProgram run(std::string_view program);

 private:
  static std::string letters_of(const ProgramSetup& setup) {
    std::string letters;
    for (const std::string& axis : setup.tracking_axes)
      letters += axis.size() == 1 ? axis.front() : '?';
    return letters;
  }

  bool fail(const ProgramLine& line, std::string word) {
    constexpr std::size_t most_faults = 50;
    const bool known = std::ranges::find(result_.faults, word, &ConvertedProgram::Fault::word) !=
                       result_.faults.end();
    if (!known && result_.faults.size() < most_faults)
      result_.faults.push_back({.word = std::move(word), .line = line.source.line});
    return false;
  }
  bool read_words(const ProgramLine& line, Words& words);
  bool read_word(const ProgramLine& line, const WordRange& range, Words& words);
  bool read_mode(const ProgramLine& line, std::string_view word);
  bool read_technology(const ProgramLine& line, std::string_view word, Words& words);
  bool read_tool_call(const ProgramLine& line, std::string_view given, Words& words);
  bool write_line(const ProgramLine& line, std::vector<Block>& blocks);
  void write_text(const std::string& text, RoleSet roles = 0);
  bool write_tool(const ProgramLine& line, Words& words);
  bool write_motions(const ProgramLine& line, const std::vector<Block>& blocks,
                     const std::string& words, const std::string& comment);
  [[nodiscard]] LinePointer line_of_motion(const ProgramLine& line, std::string_view words,
                                           std::string_view comment);
  [[nodiscard]] std::string spelled(const Words& words) const;
  [[nodiscard]] std::string spelled_comment(std::string comment) const;
  [[nodiscard]] AxisSet axes_named(const ProgramLine& line) const;
  [[nodiscard]] LinePointer new_line();
  void begin();
  void end();

  const Dialect& from_;
  const Dialect& to_;
  const ProgramSetup& setup_;
  bool klartext_;
  NcWriter writer_;
  ConvertedProgram result_{};
  std::uint64_t index_ = 0;
  Position place_;
  Plane plane_;
  std::int64_t tool_ = 0;  // of T, until it is loaded
  bool has_feed_ = false;
  bool ended_ = false;
  bool changes_by_t_ = false;  // SINUMERIK without M6 (D-56)
};

LinePointer Conversion::new_line() {
  LinePointer line = std::make_unique<ProgramLine>();
  line->line_end = "\n";
  line->has_words = true;
  line->source = {.index = index_++, .line = 1};
  line->absolute_center = klartext_;
  line->plane = plane_;
  // No feed of the program: the writer puts in what its own text needs.
  line->feed = -1;
  return line;
}

void Conversion::write_text(const std::string& text, RoleSet roles) {
  LinePointer line = new_line();
  line->text = text;
  line->roles = roles;
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

bool Conversion::read_mode(const ProgramLine& line, std::string_view word) {
  if (word.starts_with("BEGINPGM")) return true;
  // The coordinates are written absolutely and in mm, whatever they were.
  for (const std::string_view known : {"G90", "G91", "G20", "G21", "G70", "G71", "G700", "G710",
                                       "G40", "R0", "G161", "G162", "G90.1", "G91.1"})
    if (word == known) return true;
  for (const Plane plane : {Plane::xy, Plane::zx, Plane::yz}) {
    if (word != name_of(plane)) continue;
    if (plane == plane_) return true;
    if (klartext_) return fail(line, std::string(word).append(plane_of_klartext));
    plane_ = plane;
    write_text(std::string(word), bit(WordRole::mode));
    return true;
  }
  return fail(line, std::string(word));
}

// TOOL CALL 5 Z S900 F120 DR+0.1: the radius has been compensated, a length would be lost.
bool Conversion::read_tool_call(const ProgramLine& line, std::string_view given, Words& words) {
  const std::string statement = statement_of(given);
  KlartextToolReader reader(
      std::string_view(statement).substr(std::string_view("TOOL CALL").size()));
  bool first = true;
  for (KlartextToolWord word = reader.next(); word.kind != KlartextToolWord::Kind::end;
       word = reader.next()) {
    const bool is_tool = std::exchange(first, false) && word.kind == KlartextToolWord::Kind::number;
    const bool has_number = word.has == KlartextToolWord::Value::number;
    const std::string text = capitals(word.text);
    if (is_tool && is_whole(word.value)) {
      words.tool = static_cast<std::int64_t>(word.value);
      words.loads_tool = true;
    } else if (word.name == "S" && has_number && is_speed(std::string_view(text).substr(1))) {
      words.speed = text.substr(1);
    } else if (word.name == "M" && has_number) {
      if (!read_technology(line, text, words)) return false;
    } else if (!(word.name == "Z" || word.name.starts_with("DR") ||
                 ((word.name == "F" || (word.name == "DL" && word.value == 0)) && has_number))) {
      return fail(line, text + " of TOOL CALL");
    }
  }
  return true;
}

bool Conversion::read_technology(const ProgramLine& line, std::string_view given, Words& words) {
  const std::string word = capitals(given);
  if (word[0] == '/' && setup_.block_skip == BlockSkip::execute) return true;
  if (word.starts_with("TOOLCALL")) return read_tool_call(line, given, words);
  if (word.starts_with("BLKFORM")) {
    words.comment = given;
    return true;
  }
  if (word[0] == 'S' && is_speed(std::string_view(word).substr(1))) {
    words.speed = word.substr(1);
    return true;
  }
  if (const std::int64_t tool = whole_behind(word, 'T'); tool >= 0) {
    if (words.next_tool) return fail(line, word + ", a third tool of its line");
    (words.tool ? words.next_tool : words.tool) = tool;
    words.loads_tool |= changes_by_t_;
    return true;
  }
  // The radius of D has been compensated. An edge of Sinumerik has a length of its own, and without
  // a tool there is none.
  if (const std::int64_t edge = whole_behind(word, 'D');
      edge == 1 || (edge > 1 && from_.name != DialectName::sinumerik))
    return true;
  const std::int64_t m = whole_behind(word, 'M');
  if (m == 6) {
    words.loads_tool = true;
    return true;
  }
  if ((m >= 0 && m <= 9) || m == 30) {
    words.functions.push_back("M" + std::to_string(m));
    ended_ |= m == 2 || m == 30;
    return true;
  }
  // What holds at the start anyway.
  double number = 0;
  bool whole = false;
  if (word[0] == 'G' && read_number(std::string_view(word).substr(1), number, whole) > 0)
    if (const GFunction* function = from_.function(number);
        function != nullptr && function->initial && function->group != GGroup::zero_shift)
      return true;
  return fail(line, word);
}

// All words are read, also behind one that cannot be said.
bool Conversion::read_words(const ProgramLine& line, Words& words) {
  const auto has = [&](char first, std::string_view whole = {}) {
    return std::ranges::any_of(line.words, [&](const WordRange& range) {
      const std::string_view word = line.word(range);
      return range.role == WordRole::technology && upper(word[0]) == first &&
             (whole.empty() || capitals(word) == whole);
    });
  };
  // Stops and coolant behind a `/` that the setup has decided about; the line has nothing else.
  if (setup_.block_skip == BlockSkip::leave_out && has('/')) return true;
  // The limit would become the speed.
  if (from_.name == DialectName::fanuc && has('S') && has('G', "G50"))
    return fail(line, "G50 with S, a limit of the speed");
  bool said = true;
  for (const WordRange& range : line.words) said &= read_word(line, range, words);
  return said;
}

bool Conversion::read_word(const ProgramLine& line, const WordRange& range, Words& words) {
  const std::string_view word = line.word(range);
  // How TRC goes on has been resolved.
  if (from_.name == DialectName::sinumerik && (capitals(word) == "NORM" || capitals(word) == "CFC"))
    return true;
  switch (range.role) {
    case WordRole::comment: {
      std::string_view text = word.substr(1);
      if (word[0] == '(' && text.ends_with(')')) text.remove_suffix(1);
      // The number of a program has no place here.
      if (word[0] != '(' && word[0] != ';' && word[0] != '*') return true;
      words.comment += words.comment.empty() ? "" : " ";
      words.comment += without_blanks_in_front(without_blanks_behind(text));
      return true;
    }
    case WordRole::mode:
      // A label is one to which nothing jumps.
      return word.ends_with(':') || read_mode(line, capitals(word));
    case WordRole::technology:
    case WordRole::stop:
      // The arcs of a pole have their centres in their own blocks.
      if (line.klartext && line.klartext->sets_pole) return true;
      return capitals(word).starts_with("ENDPGM") || read_technology(line, word, words);
    case WordRole::trc:
      return fail(line, capitals(word));
    case WordRole::coordinate:
      // X1=5: how another control calls the axis nobody says.
      if (const std::string_view name = long_name_of(line, range);
          std::ranges::any_of(setup_.tracking_axes, [name](const std::string& axis) {
            return axis.size() > 1 && same_name(axis, name);
          }))
        return fail(line, capitals(word));
      return !says_way_round(line, range) || fail(line, capitals(word) + ", a way round");
    case WordRole::feed:
      // FZ0.1, FQ1: the feed before would stay in force.
      return line.feed > 0 || fail(line, capitals(word));
    default:
      return true;
  }
}

std::string Conversion::spelled(const Words& words) const {
  std::string text;
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " ") + word; };
  if (!klartext_ && words.tool) add("T" + std::to_string(*words.tool));
  if (!klartext_ && words.loads_tool) add("M6");
  if (!klartext_ && !words.speed.empty()) add("S" + words.speed);
  for (const std::string& function : words.functions) add(function);
  return text;
}

// In Klartext tool and speed are a statement of their own.
bool Conversion::write_tool(const ProgramLine& line, Words& words) {
  if (!klartext_) return true;
  if (words.tool) tool_ = *words.tool;
  if (words.loads_tool && tool_ == 0) return fail(line, "M6 without a tool");
  if (words.loads_tool || !words.speed.empty())
    write_text("TOOL CALL " + (words.loads_tool ? std::to_string(tool_) + " " : std::string()) +
               "Z" + (words.speed.empty() ? "" : " S" + words.speed));
  return true;
}

AxisSet Conversion::axes_named(const ProgramLine& line) const {
  if (line.klartext) return line.klartext->axes;
  AxisSet named = line.main_axes;
  if (!line.names_other_axes) return named;
  const std::string letters = letters_of(setup_);
  for (const WordRange& word : line.words) {
    if (word.role != WordRole::coordinate) continue;
    if (is_polar(line, word)) named |= 7;
    const std::size_t axis = letters.find(upper(line.text[word.begin]));
    if (axis != std::string::npos && names_an_axis(line, word)) named |= axis_bit(3 + axis);
  }
  return named;
}

// A bracket would end a comment in brackets, and what is behind it would be words.
std::string Conversion::spelled_comment(std::string comment) const {
  if (comment.empty()) return comment;
  // One of Klartext may have several lines, others end with theirs.
  std::ranges::replace_if(
      comment, [](char sign) { return sign == '\r' || sign == '\n'; }, ' ');
  if (klartext_ || to_.name == DialectName::sinumerik) return "; " + comment;
  if (to_.name == DialectName::linuxcnc && is_command_of_linuxcnc(comment)) comment.insert(0, "- ");
  std::replace(comment.begin(), comment.end(), '(', '[');
  std::replace(comment.begin(), comment.end(), ')', ']');
  return "(" + comment + ")";
}

// The words of the line for axes stay, also where they need not move by our count: where the
// machine stands on them before, the line alone may say (D-94).
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
    const std::string letters = "XYZ" + letters_of(setup_);
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
    // The feed before it would stay in force.
    if (cuts && motion.feed == 0 && has_feed_)
      return fail(line, "a feed that is no number per minute");
    has_feed_ |= motion.feed > 0;
  }
  meaning.end = place_;
  writer_.take(std::move(written), meaning);
  for (const CompensatedBlock& motion : motions) writer_.write(motion, result_.text);
  return true;
}

bool Conversion::write_line(const ProgramLine& line, std::vector<Block>& blocks) {
  Words words;
  const bool said = read_words(line, words);
  if (!write_tool(line, words) || !said) return false;
  std::string text = spelled(words);
  const std::string comment = spelled_comment(std::move(words.comment));
  std::erase_if(blocks, [](const Block& block) {
    const auto* passive = std::get_if<PassiveBlock>(&block);
    return passive != nullptr && !passive->text.empty();
  });
  if (blocks.empty()) {
    if (!text.empty() && !comment.empty()) text += ' ';
    text += comment;
    if (!text.empty()) write_text(text);
  } else if (!write_motions(line, blocks, text, comment)) {
    return false;
  }
  // T2 M6 T3: behind the change.
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
  if (interpreter.feed(with_settings_as_comments(program, from_.name), lines))
    interpreter.finish(lines);
  if (diagnostics.stopped()) {
    const std::vector<Diagnostic> told = diagnostics.take();
    result_.faults.push_back({.word = message_of(told.back()), .line = told.back().source.line});
    return std::move(result_);
  }
  if (klartext_ && plane_ != Plane::xy)
    result_.faults.push_back({.word = std::string(name_of(plane_)).append(plane_of_klartext)});
  const auto changes_tool = [](const LinePointer& line) {
    return std::ranges::any_of(line->words, [&](const WordRange& word) {
      return whole_behind(capitals(line->word(word)), 'M') == 6;
    });
  };
  changes_by_t_ = from_.name == DialectName::sinumerik && std::ranges::none_of(lines, changes_tool);
  begin();
  auto next = blocks.begin();
  for (const LinePointer& line : lines) {
    std::vector<Block> own;
    while (line->has_words && next != blocks.end() && index_of(*next) == line->source.index)
      own.push_back(std::move(*next++));
    if (ended_) break;
    (void)write_line(*line, own);
  }
  if (!result_.faults.empty()) {
    result_.text.clear();
    return std::move(result_);
  }
  end();
  writer_.finish(result_.text);
  return std::move(result_);
}

}  // namespace

ConvertedProgram convert_program(std::string_view program, const ProgramSetup& setup,
                                 DialectName to) {
  return Conversion(setup, to).run(program);
}

}  // namespace trc

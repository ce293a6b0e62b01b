#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/nc/state/program_line.h"
#include "core/nc/writer/motion_writer.h"
#include "core/trc/result/compensated_block.h"

namespace trc {

// Writes the program text with TRC resolved: Source::index brings compensated blocks and the lines
// that they came from together.
//
// A line comes out byte for byte when a reader of the output does with it what
// the program meant: no TRC words in it, motion uncompensated, and position,
// motion function and feed as the line takes them for granted. Else its words
// are written anew: N word, modes, motion, then technology and comments in their
// order. Blocks that TRC inserts are lines of their own, without N word. A line
// of which nothing but its N word is left does not come out.
//
// Lines that give no block wait for the next block of the program, so that the
// output does not depend on when the text arrives.
class NcWriter {
 public:
  struct Setup {
    int decimals = default_decimals;  // mm; one more for inch; at most those of `limits`
    bool follows_decimals = false;    // more of them where the program has more (D-180)
    LineLimits limits{};
    Position start{};                       // mm
    MotionKind motion = MotionKind::rapid;  // of lines that do not say it
    bool absolute_center = false;
    Plane plane = Plane::xy;
    LengthUnit unit = LengthUnit::mm;
    Spelling spelling{};
    std::string tracking_letters{};  // one per tracking axis
    // Names of more than one character, which are written X1=5; else empty.
    std::vector<std::string> tracking_names{};
    bool renumbers = false;
  };
  explicit NcWriter(const Setup& setup);

  // The meaning of a line in the program, before TRC.
  struct Meaning {
    bool gives_block = false;   // write() gets a block with its Source, unless TRC drops it
    Position end{};             // where the program is after the line
    bool keeps_place = false;   // a radius of 0: the path is the program
    std::uint32_t motions = 0;  // in the plane, of the last line that has some
    AxisSet moved{};            // axes across the plane and tracking axes that travel

    template <class Archive>
    void serialize(Archive& archive) {
      archive(gives_block, end, keeps_place, motions, moved);
    }
  };
  // The next line of the program.
  void take(LinePointer line, const Meaning& meaning);
  // The next block of the path: appends the text that has become certain.
  void write(const CompensatedBlock& block, std::string& out);
  // From here on coordinates have as many decimals as those of the line, if the setup says so.
  // Lines that are written anew are counted without being asked for.
  void follow_decimals(const ProgramLine& line);
  // A line written anew that the control does not take. It has not come out, and nothing after it
  // does.
  struct Excess {
    enum class Of : std::uint8_t { characters, digits };
    Of of = Of::characters;
    std::size_t count = 0;
    std::size_t limit = 0;
  };
  [[nodiscard]] const std::optional<Excess>& excess() const { return excess_; }
  // Appends the waiting lines if none of them gives a block.
  void write_silent_lines(std::string& out);
  // No more blocks: appends all waiting lines.
  void finish(std::string& out);

  // Bytes held since the last line that gives a block.
  [[nodiscard]] std::size_t silent_bytes() const { return silent_bytes_; }
  // Gives back the lines that have come out: `taker` may use their memory again. Until then they
  // are kept.
  template <class Taker>
  void release_lines(Taker taker) {
    for (std::size_t i = 0; i < first_; ++i) taker(std::move(waiting_[i].line));
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(state_, feed_is_programmed_, waiting_, first_, waiting_for_blocks_, silent_bytes_,
            rewritten_index_, copied_index_, line_end_missing_, next_number_, numbered_, removed_,
            open_feed_, open_feed_holds_, motions_, limits_.digits, number_of_pole_);
    serialize_line_end(archive, line_end_);
  }

 private:
  struct WaitingLine {
    LinePointer line{};
    Meaning meaning{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(line, meaning);
    }
  };

  void drop_first();
  [[nodiscard]] bool comes_before(const WaitingLine& waiting, const Source& source) const {
    const Source& own = waiting.line->source;
    return own.index < source.index || (own.index == source.index && !waiting.line->has_words);
  }
  void write_lines_before(const Source& source, std::string& out);

  // Writes, before a copied line, what the line relies on and the output lacks.
  void write_what_it_counts_on(const ProgramLine& line, std::string& out);
  void write_removed_words(std::string& out);
  // Keeps the modes among the TRC words of the line, which do not come out.
  void keep_removed_words(const ProgramLine& line);
  // Writes the line without its motion and TRC words; unchanged if it has neither.
  void write_without_motion(const WaitingLine& own, std::string& out);
  // Copies the line if a reader makes the motion of the block from it.
  bool copy_motion(const WaitingLine& own, const CompensatedBlock& block, std::string& out);
  // Whether a reader who starts at `after` makes that motion; moves `after` to its end.
  [[nodiscard]] bool reads_as(const WaitingLine& own, const CompensatedBlock& block,
                              WrittenState& after) const;

  // Whether the output has what a line of Klartext relies on: pole, polar radius, previous tangent.
  [[nodiscard]] bool has_what_it_counts_on(const ProgramLine& line,
                                           const CompensatedBlock& block) const;
  enum class LineForm : std::uint8_t { copied, rewritten };
  void enter_klartext(const ProgramLine& line, LineForm form);
  void write_pole_handed_on(const ProgramLine& line, std::string& out);
  void write_pole(const Point& pole, Plane plane, std::string& out);
  // Of a CC of the program that does not come out.
  void keep_number_of_pole(const ProgramLine& line);

  void write_motion(const CompensatedBlock& block, std::string& out);
  void write_arc(const CompensatedBlock& block, const Arc& arc, double from, double to,
                 std::string& out);
  // One line of output: the piece of the block that ends after a share of its way. `numbers`: of
  // an arc.
  void write_piece(const CompensatedBlock& block, const Segment& piece,
                   const MotionWriter::ArcNumbers* numbers, double share, std::string& out);
  void write_plane(Plane plane, std::string& out);

  void begin_words() {
    words_.clear();
    last_comment_.clear();
  }
  void append(const ProgramLine& line, const WordRange& word);
  // Writes the line unchanged, except for its number where lines are renumbered.
  void write_line(const ProgramLine& line, std::string& out);
  void append_number(const ProgramLine& line, const WordRange& word, TextBuffer& words);
  // Writes the number of an inserted line.
  void append_number_of_inserted();
  [[nodiscard]] std::string take_number();
  // The axes of the line with a direction of rotation, whose words stay as the program has them.
  [[nodiscard]] AxisSet axes_with_way_round(const ProgramLine& line) const;
  void append_ways_round(const ProgramLine& line, const TrackingTravel& tracking);
  void append_feed_and_rest(const CompensatedBlock& block);
  void append_feed(double feed);
  void enter_feed(const ProgramLine& line);
  void note_open_feed(const ProgramLine& line);
  // Whether the block has a feed for which a reader of the output would use another one.
  [[nodiscard]] bool lacks_open_feed(const CompensatedBlock& block) const {
    return !open_feed_.empty() && !open_feed_holds_ && !block.rapid && block.feed == 0;
  }
  // Whether the feed of the block is in force without a word for it.
  [[nodiscard]] bool has_feed(const CompensatedBlock& block) const;
  void follow_digits(const ProgramLine& line);
  // Whether the control takes the line of output that stands in words_.
  bool check_limits();
  void write_words(std::string_view line_end, std::string& out);
  void write_text(std::string_view text, std::string_view line_end, std::string& out);
  void end_line_before(std::string& out) {
    if (std::exchange(line_end_missing_, false)) out += line_end_;
  }
  void enter_modes(const WaitingLine& own);
  [[nodiscard]] AxisSet axes_to_keep(const WaitingLine& own, const CompensatedBlock& block,
                                     const Position& end) const;
  [[nodiscard]] AxisSet axes_named_in(const ProgramLine& line) const {
    if (line.klartext) return line.klartext->axes;
    return line.names_other_axes || center_letters_are_axes_ ? all_axes_named_in(line)
                                                             : AxisSet{line.main_axes};
  }
  [[nodiscard]] AxisSet all_axes_named_in(const ProgramLine& line) const;

  MotionWriter motions_;
  bool follows_decimals_;
  LineLimits limits_;
  std::optional<Excess> excess_{};
  bool klartext_;
  std::string tracking_letters_;
  bool center_letters_are_axes_;  // I J K R among them
  WrittenState state_;
  WrittenState after_;              // of the line being judged
  bool feed_is_programmed_ = true;  // the last F word is one of the program
  // The feed of the program where only the control knows its value, of Klartext: FQ5, FZ0.1. It is
  // written anew after a feed that holds for some blocks only.
  std::string open_feed_{};
  bool open_feed_holds_ = false;  // it is the last F word that has come out
  // The block number of the last CC that has not come out, of Klartext, up to the next motion.
  std::string number_of_pole_{};
  // A TRC mode that is in force in the program and missing in the output.
  struct RemovedWord {
    char group = ' ';  // a later one of the same group takes its place
    std::string text{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(group, text);
    }
  };
  std::vector<RemovedWord> removed_{};

  // Lines that have not come out are those from `first_` on.
  std::vector<WaitingLine> waiting_;
  std::size_t first_ = 0;
  std::size_t waiting_for_blocks_ = 0;
  std::size_t silent_bytes_ = 0;
  // The line whose motion was last written anew: its stop words, after the motion, are still to
  // come.
  std::uint64_t rewritten_index_ = std::numeric_limits<std::uint64_t>::max();
  // Index of the line copied last: its further blocks have come out with it.
  std::uint64_t copied_index_ = std::numeric_limits<std::uint64_t>::max();
  const WaitingLine* own_ = nullptr;  // the line of the block being written, until it has come out
  TextBuffer words_;                  // of the line being written, a blank before each
  TextBuffer last_comment_;           // after them: what begins with `;` ends the line
  TrackingTravel tracking_{};         // of the piece being written
  std::string_view line_end_ = "\n";  // of the lines TRC inserts: that of the line before
  bool line_end_missing_ = false;     // the text so far ends with a line without
  bool renumbers_;
  std::uint64_t next_number_ = 0;
  bool numbered_ = false;  // a number has come out
};

}  // namespace trc

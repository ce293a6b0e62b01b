#include "core/nc/writer/nc_writer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/nc/text/characters.h"
#include "core/nc/writer/written_block.h"

namespace trc {
namespace {

// The roles that a line keeps besides its N word when its motion is gone.
constexpr RoleSet roles_without_motion =
    bit(WordRole::mode) | bit(WordRole::feed) | bit(WordRole::technology) | bit(WordRole::comment);

// The roles of a rewritten line before and after the words of its motion.
constexpr RoleSet roles_in_front = bit(WordRole::number) | bit(WordRole::mode);
constexpr RoleSet roles_behind =
    bit(WordRole::technology) | bit(WordRole::comment) | bit(WordRole::feed);

}  // namespace

NcWriter::NcWriter(const Setup& setup)
    : motions_(setup.decimals, setup.tracking_letters, setup.spelling, setup.tracking_names,
               setup.limits.digits),
      follows_decimals_(setup.follows_decimals),
      limits_(setup.limits),
      klartext_(setup.spelling.klartext),
      tracking_letters_(setup.tracking_letters),
      center_letters_are_axes_(setup.tracking_letters.find_first_of("IJKR") != std::string::npos),
      renumbers_(setup.renumbers) {
  state_.motion = setup.motion;
  state_.absolute_center = setup.absolute_center;
  state_.plane = setup.plane;
  state_.unit = state_.feed_unit = setup.unit;
  state_.position = setup.start;
  state_.tracking.resize(setup.tracking_letters.size());
}

void NcWriter::take(LinePointer line, const Meaning& meaning) {
  if (meaning.gives_block) {
    ++waiting_for_blocks_;
    silent_bytes_ = 0;
  } else {
    silent_bytes_ += sizeof(WaitingLine) + sizeof(ProgramLine) + line->text.size();
  }
  waiting_.push_back({.line = std::move(line), .meaning = meaning});
}

void NcWriter::drop_first() {
  const WaitingLine& first = waiting_[first_++];
  if (first.meaning.gives_block) --waiting_for_blocks_;
  if (first.line->has_words) keep_removed_words(*first.line);
}

void NcWriter::write_lines_before(const Source& source, std::string& out) {
  while (first_ < waiting_.size() && comes_before(waiting_[first_], source)) {
    write_without_motion(waiting_[first_], out);
    drop_first();
  }
}

void NcWriter::write_silent_lines(std::string& out) {
  if (waiting_for_blocks_ == 0) finish(out);
}

void NcWriter::finish(std::string& out) {
  while (first_ < waiting_.size()) {
    write_without_motion(waiting_[first_], out);
    drop_first();
  }
  silent_bytes_ = 0;
}

void NcWriter::write(const CompensatedBlock& block, std::string& out) {
  if (first_ < waiting_.size() && comes_before(waiting_[first_], block.source))
    write_lines_before(block.source, out);
  const bool has_own =
      first_ < waiting_.size() && waiting_[first_].line->source.index == block.source.index;
  own_ = has_own ? &waiting_[first_] : nullptr;
  if (block.origin == Origin::passthrough) {
    // The technology of a motion line comes with the motion, that of the program end after
    // everything.
    if (!has_own) {
      // After a motion that was rewritten: M00 and the like.
      if (block.source.index == rewritten_index_) write_text(block.text, line_end_, out);
      return;
    }
    if (own_->line->is_motion || own_->line->ends_program) return;
    write_without_motion(*own_, out);
    drop_first();
    return;
  }
  if (!has_own && klartext_ && block.source.index == copied_index_) {
    // A further turn of a helix.
    state_.position = from_plane(block.plane, end_of(block.path), block.normal.to);
    return;
  }
  if (!has_own || !copy_motion(*own_, block, out)) write_motion(block, out);
  if (own_ != nullptr && (own_->line->roles & roles_without_motion) != 0) {
    write_without_motion(*own_, out);
    own_ = nullptr;
  }
  if (has_own && own_ == nullptr) drop_first();
}

void NcWriter::write_without_motion(const WaitingLine& own, std::string& out) {
  const ProgramLine& line = *own.line;
  if (line.third_set) state_.position[axes_of(line.plane).third] = *line.third_set;
  write_what_it_counts_on(line, out);
  if (line.klartext && line.klartext->hands_pole_on) write_pole_handed_on(line, out);
  if (!line.has_trc_words && !line.is_motion) {
    write_line(line, out);
  } else {
    begin_words();
    bool has_more_than_number = false;
    bool has_name = false;  // L before its feed
    const std::uint64_t number = next_number_;
    for (const WordRange& word : line.words) {
      if (word.role == WordRole::trc || word.role == WordRole::coordinate) continue;
      if (klartext_ && word.role == WordRole::mode) continue;
      if (word.role == WordRole::motion && line.is_motion) continue;
      if (klartext_ && word.role == WordRole::feed && !has_name) words_.append(" L");
      has_name |= word.role == WordRole::motion;
      // L RL alone, L R0 FMAX: nothing remains.
      has_more_than_number |=
          word.role != WordRole::number && !(klartext_ && word.role == WordRole::motion);
      append(line, word);
    }
    if (has_more_than_number) {
      write_words(line.line_end, out);
    } else {
      next_number_ = number;
      keep_number_of_pole(line);
    }
  }
  enter_modes(own);
  const bool copied = !line.has_trc_words && !line.is_motion;
  if (line.klartext) enter_klartext(line, copied ? LineForm::copied : LineForm::rewritten);
  if (own.line->has(WordRole::feed)) enter_feed(line);
  if (own.line->has(WordRole::motion) && !line.is_motion) state_.motion = line.motion;
}

// The state that a reader of the output knows after the line.
void NcWriter::enter_klartext(const ProgramLine& line, LineForm form) {
  const bool copied = form == LineForm::copied;
  const KlartextLine& says = *line.klartext;
  if (says.sets_polar_radius) state_.other_radius = !copied;
  if (line.is_motion) state_.other_tangent = !copied;
  if (says.loses_pole) state_.has_pole = false;
  if (!says.sets_pole) return;
  state_.pole_written = !copied;
  if (!copied) return;
  state_.pole = {says.pole_x, says.pole_y};
  state_.has_pole = true;
}

// The pole of an arc takes the place of the CC of the program that stood before it.
void NcWriter::keep_number_of_pole(const ProgramLine& line) {
  if (renumbers_ || !line.klartext || !line.klartext->sets_pole) return;
  const auto number = std::ranges::find(line.words, WordRole::number, &WordRange::role);
  number_of_pole_ = number == line.words.end() ? "" : line.word(*number);
}

void NcWriter::write_pole(const Point& pole, Plane plane, std::string& out) {
  begin_words();
  append_number_of_inserted();
  if (own_ != nullptr && !number_of_pole_.empty()) {
    words_.append(' ');
    words_.append(std::exchange(number_of_pole_, {}));
  }
  motions_.append_pole(words_, pole, plane, state_);
  write_words(line_end_, out);
  state_.pole_written = true;
  state_.has_pole = true;
}

void NcWriter::write_pole_handed_on(const ProgramLine& line, std::string& out) {
  if (!state_.pole_written) return;
  write_pole(Point(line.klartext->pole_x, line.klartext->pole_y), line.plane, out);
  state_.pole_written = false;
}

void NcWriter::write_motion(const CompensatedBlock& block, std::string& out) {
  if (own_ != nullptr) {
    enter_modes(*own_);
    follow_decimals(*own_->line);
    follow_digits(*own_->line);
  }
  const Arc* arc = std::get_if<Arc>(&block.path);
  if (arc == nullptr) return write_piece(block, block.path, nullptr, 1, out);
  const Plane plane = state_.plane;
  if (block.plane != plane) write_plane(block.plane, out);
  write_arc(block, *arc, 0, 1, out);
  if (block.plane != plane) write_plane(plane, out);
}

void NcWriter::write_arc(const CompensatedBlock& block, const Arc& arc, double from, double to,
                         std::string& out) {
  const MotionWriter::ArcNumbers numbers = motions_.numbers_of(arc, block.plane, state_);
  switch (numbers.form) {
    case MotionWriter::ArcForm::arc:
      return write_piece(block, arc, &numbers, to, out);
    case MotionWriter::ArcForm::halves: {
      const double middle = (from + to) / 2;
      const std::array<Arc, 2> halves = halves_of(arc);
      write_arc(block, halves[0], from, middle, out);
      write_arc(block, halves[1], middle, to, out);
      return;
    }
    case MotionWriter::ArcForm::line:
      return write_piece(block, Line{.start = arc.start, .end = arc.end}, nullptr, to, out);
  }
}

void NcWriter::write_piece(const CompensatedBlock& block, const Segment& piece,
                           const MotionWriter::ArcNumbers* numbers, double share,
                           std::string& out) {
  const auto part_way = [share](const AxisTravel& travel) {
    return share == 1 ? travel.to : travel.from + share * (travel.to - travel.from);
  };
  const Position end = from_plane(block.plane, end_of(piece), part_way(block.normal));
  if (share != 1) {
    tracking_ = block.tracking;
    for (AxisTravel& travel : tracking_) travel.to = part_way(travel);
  }
  const TrackingTravel& tracking = share == 1 ? block.tracking : tracking_;
  const bool in_plane = moves_in_plane(block);
  AxisSet always = in_plane ? plane_axes(block.plane) : 0;
  // Only the machine may know its position on an axis that the program has not named.
  if (own_ != nullptr && block.origin == Origin::uncompensated && !is_arc(piece))
    always &= axes_named_in(*own_->line);
  if (own_ != nullptr) always |= axes_to_keep(*own_, block, end);
  const Arc* arc = std::get_if<Arc>(&piece);
  const bool must_be_written = (always & (in_plane ? ~plane_axes(block.plane) : ~AxisSet{0})) != 0;
  if (arc == nullptr && !must_be_written && !motions_.moves(end, tracking, state_)) return;

  if (klartext_ && arc != nullptr &&
      !(state_.has_pole && motions_.reaches(arc->center.x(), state_.pole.x(), state_.unit) &&
        motions_.reaches(arc->center.y(), state_.pole.y(), state_.unit)))
    write_pole(arc->center, block.plane, out);
  if (own_ != nullptr && own_->line->klartext) enter_klartext(*own_->line, LineForm::rewritten);
  if (klartext_) state_.other_tangent = true;
  begin_words();
  if (own_ != nullptr && (own_->line->roles & roles_in_front) != 0) {
    for (const WordRange& word : own_->line->words)
      if (word.role == WordRole::number || (word.role == WordRole::mode && !klartext_))
        append(*own_->line, word);
  }
  if (own_ == nullptr) append_number_of_inserted();
  const MotionKind kind = kind_of(block);
  MotionWriter::Axes axes{.end = end, .tracking = tracking, .always = always};
  if (own_ != nullptr && own_->line->names_other_axes)
    axes.never = axes_with_way_round(*own_->line);
  if (arc != nullptr) {
    motions_.append_arc(words_, {*arc, *numbers, block.plane}, axes, state_);
  } else {
    motions_.append_line(words_, kind == MotionKind::rapid ? kind : MotionKind::linear, axes,
                         state_);
  }
  if (axes.never != 0) append_ways_round(*own_->line, tracking);
  append_feed_and_rest(block);
  write_words(own_ != nullptr ? own_->line->line_end : line_end_, out);
  if (own_ != nullptr) rewritten_index_ = own_->line->source.index;
  if (own_ != nullptr) number_of_pole_.clear();
  own_ = nullptr;
}

// The axis words of the line that need not move by our count. They stay: at the start of the
// program, or after a shift of the zero point, only the line gives the position of the machine.
// Under TRC the line names the programmed position, not that of the tool.
AxisSet NcWriter::axes_to_keep(const WaitingLine& own, const CompensatedBlock& block,
                               const Position& end) const {
  AxisSet kept = axes_named_in(*own.line) & ~own.meaning.moved;
  if (block.origin != Origin::uncompensated) return kept & ~plane_axes(block.plane);
  for (std::size_t axis = 0; axis < end.size(); ++axis) {
    if ((plane_axes(block.plane) & axis_bit(axis)) == 0) continue;
    if (!motions_.reaches(end[axis], own.meaning.end[axis], state_.unit)) kept &= ~axis_bit(axis);
  }
  return kept;
}

void NcWriter::append_feed_and_rest(const CompensatedBlock& block) {
  const bool needs_feed = !block.rapid && block.feed > 0;
  if (needs_feed && !(own_ != nullptr && own_->line->has(WordRole::feed)) && !has_feed(block))
    append_feed(block.feed);
  if (lacks_open_feed(block) && !(own_ != nullptr && own_->line->has(WordRole::feed))) {
    words_.append(' ');
    words_.append(open_feed_);
    open_feed_holds_ = true;
  }
  if (own_ == nullptr || (own_->line->roles & roles_behind) == 0) return;
  const ProgramLine& line = *own_->line;
  for (const WordRange& word : line.words) {
    if (word.role == WordRole::technology || word.role == WordRole::comment) {
      append(line, word);
    } else if (word.role == WordRole::feed) {
      note_open_feed(line);
      // FMAX gives the feed of its block; the feed of the line comes with the next block.
      if (klartext_ && block.rapid) continue;
      if (needs_feed && !motions_.same_feed(line.feed, block.feed, line.feed_unit)) {
        append_feed(block.feed);
      } else {
        append(line, word);
        enter_feed(line);
      }
    }
  }
}

// After a feed word of the program itself, a reader has the programmed feed, even if that is per
// revolution and meaningless here.
bool NcWriter::has_feed(const CompensatedBlock& block) const {
  if (feed_is_programmed_ && own_ != nullptr && own_->line->feed == block.feed) return true;
  return motions_.same_feed(state_.feed, block.feed, state_.feed_unit);
}

void NcWriter::append_feed(double feed) {
  motions_.append_feed(words_, feed, state_);
  feed_is_programmed_ = false;
  open_feed_holds_ = false;
}

void NcWriter::enter_feed(const ProgramLine& line) {
  state_.feed = line.feed;
  feed_is_programmed_ = true;
  note_open_feed(line);
  open_feed_holds_ = true;
}

void NcWriter::note_open_feed(const ProgramLine& line) {
  open_feed_.clear();
  open_feed_holds_ = false;
  if (!klartext_ || line.feed > 0) return;
  const auto word = std::ranges::find(line.words, WordRole::feed, &WordRange::role);
  // TOOL CALL with FZ or FU is copied as a whole.
  open_feed_ = word == line.words.end() ? "F AUTO" : line.word(*word);
}

void NcWriter::write_plane(Plane plane, std::string& out) {
  if (klartext_) return;  // the axis of the tool determines its plane
  begin_words();
  append_number_of_inserted();
  words_.append(plane == Plane::xy ? " G17" : plane == Plane::zx ? " G18" : " G19");
  write_words(line_end_, out);
  state_.plane = plane;
}

void NcWriter::enter_modes(const WaitingLine& own) {
  if (!own.line->has(WordRole::mode)) return;
  state_.incremental = own.line->incremental;
  state_.unit = own.line->unit;
  state_.feed_unit = own.line->feed_unit;
  state_.absolute_center = own.line->absolute_center;
  state_.plane = own.line->plane;
}

AxisSet NcWriter::axes_with_way_round(const ProgramLine& line) const {
  AxisSet axes = 0;
  for (const WordRange& word : line.words)
    if (const std::size_t axis = tracking_letters_.find(upper(line.text[word.begin]));
        axis != std::string::npos && says_way_round(line, word))
      axes |= axis_bit(3 + axis);
  return axes;
}

void NcWriter::append_ways_round(const ProgramLine& line, const TrackingTravel& tracking) {
  for (const WordRange& word : line.words) {
    if (!says_way_round(line, word)) continue;
    append(line, word);
    const std::size_t axis = tracking_letters_.find(upper(line.text[word.begin]));
    if (axis < tracking.size()) state_.tracking[axis] = tracking[axis].to;
  }
}

AxisSet NcWriter::all_axes_named_in(const ProgramLine& line) const {
  AxisSet named = 0;
  for (const WordRange& word : line.words) {
    if (word.role != WordRole::coordinate) continue;
    if (const std::string_view name = long_name_of(line, word); !name.empty())
      if (const auto axis = motions_.axis_named(name)) {
        named |= axis_bit(3 + *axis);
        continue;
      }
    if (is_polar(line, word)) named |= plane_axes(line.plane);
    if (!names_an_axis(line, word)) continue;
    const char letter = upper(line.text[word.begin]);
    if (letter >= 'X' && letter <= 'Z') {
      named |= axis_bit(static_cast<std::size_t>(letter - 'X'));
    } else if (const std::size_t axis = tracking_letters_.find(letter); axis != std::string::npos) {
      named |= axis_bit(3 + axis);
    }
  }
  return named;
}

}  // namespace trc

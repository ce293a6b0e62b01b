#include "core/nc/program/klartext_outline.h"

#include <algorithm>
#include <charconv>

#include "core/nc/dialect/klartext_block.h"

namespace trc::program {
namespace {

// Contours of cycles are in labels too.
bool names_labels_for_cycles(std::string_view statement) {
  return begins_with_word(statement, "CYCL DEF 14") || begins_with_word(statement, "CONTOUR DEF") ||
         begins_with_word(statement, "SEL CONTOUR");
}

bool has_word(std::string_view statement, std::string_view word) {
  for (std::size_t at = statement.find(word); at != std::string_view::npos;
       at = statement.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || statement[at - 1] == ' ') && (end == statement.size() || statement[end] == ' '))
      return true;
  }
  return false;
}

bool ends_program(std::string_view statement) {
  return begins_with_word(statement, "END") || has_word(statement, "M2") ||
         has_word(statement, "M02") || has_word(statement, "M30");
}

// After the block number and the skip sign.
std::size_t begin_of_statement(std::string_view line) {
  return std::min(line.find_first_not_of("0123456789 \t/"), line.size());
}

// CALL LBL Q5
bool is_parameter(std::string_view label) { return label.starts_with('Q'); }

}  // namespace

LabelStatement label_statement_in(std::string_view line, std::string_view words) {
  LabelStatement found{.begin = begin_of_statement(line)};
  const bool calls = begins_with_word(words, "CALL LBL");
  if (ends_program(words)) found.kind = LabelStatement::Kind::program_end;
  if (!calls && !begins_with_word(words, "LBL")) return found;
  found.kind = calls ? LabelStatement::Kind::call : LabelStatement::Kind::label;
  found.label = label_of(line, found.begin, words);
  const std::size_t behind = calls ? words.find(" REP") : std::string::npos;
  if (behind == std::string::npos) return found;
  found.repeats = true;
  const std::size_t digits = std::min(words.find_first_not_of(' ', behind + 4), words.size());
  std::uint64_t times = 0;
  const char* const end = words.data() + words.size();
  // REP 3/2, REP 3 /2: the number after the stroke counts the repetitions left. REP alone repeats
  // once.
  const auto read = std::from_chars(words.data() + digits, end, times);
  const std::string_view behind_number(read.ptr, static_cast<std::size_t>(end - read.ptr));
  const std::size_t stroke = behind_number.find_first_not_of(' ');
  const bool is_number =
      read.ec == std::errc{} && (stroke == std::string_view::npos || behind_number[stroke] == '/');
  if (digits == words.size()) found.repetitions = 1;
  if (is_number) found.repetitions = times;
  return found;
}

LabelStatement label_statement_in(std::string_view line) {
  return label_statement_in(line, statement_of(line.substr(begin_of_statement(line))));
}

std::size_t KlartextOutline::index_of(const std::string& name) {
  const auto [known, is_new] = names_.try_emplace(name, labels_.size());
  if (is_new) labels_.emplace_back();
  return known->second;
}

const KlartextOutline::Label* KlartextOutline::label(const std::string& name) const {
  const auto known = names_.find(name);
  if (known == names_.end() || labels_[known->second].line == nowhere) return nullptr;
  return &labels_[known->second];
}

std::optional<KlartextEffects> KlartextOutline::effects_of(const std::string& name) {
  if (is_parameter(name)) return effects_.of_any();
  const auto known = names_.find(name);
  if (known == names_.end() || !effects_.has(known->second)) return {};
  return effects_.of(known->second);
}

void KlartextOutline::read(std::string_view line, Execution execution) {
  const std::string words = statement_of(line.substr(begin_of_statement(line)));
  is_named_by_cycles_ |= names_labels_for_cycles(words);
  if (place_of_klartext_side(line) != nowhere) {
    in_contour_ = true;
    contours_.push_back(lines_);
    sections_.back().last_contour = lines_;
  }
  if (has_word(words, "R0") || begins_with_word(words, "DEP")) in_contour_ = false;
  const LabelStatement statement = label_statement_in(line, words);
  if (statement.kind == LabelStatement::Kind::label) read_label(statement.label);
  if (statement.kind == LabelStatement::Kind::call) {
    const std::size_t called = index_of(statement.label);
    if (!statement.repeats) labels_[called].is_called = true;
    calls_.push_back({.line = lines_,
                      .section = sections_.size() - 1,
                      .label = called,
                      .repeats = statement.repeats,
                      .in_contour = in_contour_});
  }
  if (execution != Execution::never) read_effects(line, words, statement, execution);
  ++lines_;
}

void KlartextOutline::read_effects(std::string_view line, std::string_view words,
                                   const LabelStatement& statement, Execution execution) {
  const auto target_of = [&](const std::string& label) {
    return is_parameter(label) ? LabelEffects::no_label : index_of(label);
  };
  const KlartextEffects effects = effects_of_line(line.substr(statement.begin), words);
  const bool calls = statement.kind == LabelStatement::Kind::call;
  if (jumps(words)) {
    const std::size_t at = words.find("LBL ");
    effects_.add_jump(at == std::string_view::npos
                          ? LabelEffects::no_label
                          : target_of(label_of(line, statement.begin, words.substr(at))));
  }
  if (calls && !statement.repeats) effects_.add_call(target_of(statement.label));
  // REP executes the lines after the label again.
  const bool is_choice = execution == Execution::perhaps && (calls || effects.touched() != 0);
  if (is_choice || (calls && statement.repeats)) effects_.add_choice();
  effects_.add(effects);
  if (statement.kind == LabelStatement::Kind::program_end) effects_.end_section();
}

void KlartextOutline::read_label(const std::string& name) {
  if (name == "0") {
    for (const std::size_t index : sections_.back().labels) labels_[index].end = lines_;
    sections_.emplace_back();
    effects_.end_section();
    return;
  }
  const std::size_t index = index_of(name);
  Label& label = labels_[index];
  label.is_twice = label.line != nowhere;
  if (label.is_twice) return;
  label.line = lines_;
  effects_.begin_label(index);
  sections_.back().labels.push_back(index);
}

void KlartextOutline::finish() {
  find_contours_of_labels();
  for (const Call& call : calls_) {
    const Label& label = labels_[call.label];
    if (label.line == nowhere) continue;
    const bool repeats = call.repeats ? label.line < call.line && has_contour(label.line, call.line)
                                      : label.has_contour;
    repeats_contour_ |= repeats || call.in_contour;
  }
}

void KlartextOutline::take_contour(Section& section, std::size_t line) {
  for (; section.with_contour < section.labels.size(); ++section.with_contour) {
    const std::size_t index = section.labels[section.with_contour];
    if (labels_[index].line > line) return;
    // Without LBL 0 the label never returns.
    if (labels_[index].end == nowhere) continue;
    labels_[index].has_contour = true;
    reached_.push_back(index);
  }
}

// A label has a contour if a contour follows it in its section, or a call of a label with a
// contour. Each call is examined once, when its label turns out to have one.
void KlartextOutline::find_contours_of_labels() {
  std::vector<std::vector<std::size_t>> calls_of_label(labels_.size());
  for (std::size_t call = 0; call < calls_.size(); ++call)
    if (!calls_[call].repeats) calls_of_label[calls_[call].label].push_back(call);
  for (Section& section : sections_)
    if (section.last_contour != nowhere) take_contour(section, section.last_contour);
  while (!reached_.empty()) {
    const std::size_t label = reached_.back();
    reached_.pop_back();
    for (const std::size_t call : calls_of_label[label]) {
      contours_.push_back(calls_[call].line);
      take_contour(sections_[calls_[call].section], calls_[call].line);
    }
  }
  std::ranges::sort(contours_);
}

bool KlartextOutline::has_contour(std::size_t begin, std::size_t end) const {
  const auto first = std::ranges::lower_bound(contours_, begin);
  return first != contours_.end() && *first < end;
}

}  // namespace trc::program

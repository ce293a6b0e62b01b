#include <algorithm>
#include <array>
#include <utility>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/named_words.h"

// Lines after the program in the text that come out after its end:
//
//   - contours that cycles find in the program itself, by the names given to them: CYCLE62 and
//     older cycles name labels or a subprogram, and the control looks for them there as well
//   - programs that nobody calls: those of an archive (D-157)

namespace trc::program {
namespace {

// The text argument of a cycle: NAME, /_N_WKS_DIR/_N_A_WPD/NAME.SPF, or BEGIN:END.
void add_names(std::string_view text, std::vector<std::string>& names) {
  text.remove_prefix(text.find_last_of("/\\") + 1);
  while (!text.empty()) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    std::string name = in_upper_case(text.substr(0, std::min(text.find('.'), colon)));
    if (std::string plain = program_of_header("%" + name); !plain.empty()) name = std::move(plain);
    names.push_back(std::move(name));
    text.remove_prefix(std::min(colon + 1, text.size()));
  }
}

// A mere list of motions may contain PROC and RET too.
bool begins_or_ends(std::string_view word) { return word == "PROC" || word == "RET"; }

// X=R1, which alone does not make a program one that computes.
bool has_variable(std::string_view line) {
  NamedWordReader reader(line);
  for (NamedWord word = reader.next(); word.kind != NamedWord::Kind::end; word = reader.next()) {
    if (word.kind == NamedWord::Kind::fault) return false;
    if (word.is_variable) return true;
  }
  return false;
}

}  // namespace

void SinumerikFlow::note_named_by_cycles(std::string_view written) {
  for (std::size_t at = place_of_word(written, 0, "CYCLE", WordEnd::open);
       at != std::string_view::npos; at = place_of_word(written, at + 1, "CYCLE", WordEnd::open)) {
    const std::size_t open = behind_blanks(written, at + name_at(written, at).size());
    if (sign_at(written, open) != '(') continue;
    std::string_view values = written.substr(open, behind_bracket(written, open) - open);
    std::vector<std::string> names;
    for (std::size_t quote = values.find('"'); quote != std::string_view::npos;
         quote = values.find('"')) {
      values.remove_prefix(quote + 1);
      const std::size_t end = std::min(values.find('"'), values.size());
      add_names(values.substr(0, end), names);
      values.remove_prefix(std::min(end + 1, values.size()));
    }
    if (!names.empty()) named_by_cycles_.insert(std::move(names));
  }
}

// From the first of two labels to the last one. Lines before the executed ones have come out
// already.
bool SinumerikFlow::find_named_labels(const std::vector<std::string>& names,
                                      std::set<std::size_t>& lines) {
  const Frame& main = frames_.front();
  const auto& labels = outline_of(main).labels;
  std::set<std::size_t> found;
  for (const std::string& name : names)
    for (const std::string& label : {name, "E_LAB_A_" + name, "E_LAB_E_" + name})
      if (const auto known = labels.find(label); known != labels.end() && !name.empty())
        found.insert(known->second.begin(), known->second.end());
  if (found.size() < 2 || *found.rbegin() < start_) return true;
  for (std::size_t line = *found.begin(); line <= *found.rbegin(); ++line) {
    checkpoint_.pass();
    if (was_seen(main, line) || line < start_) {
      frames_.front().current = line;
      return refuse(Code::nc_unsupported, 0, "a contour of a cycle that the program runs through");
    }
    lines.insert(line);
  }
  return true;
}

void SinumerikFlow::find_named_units(const std::vector<std::string>& names,
                                     std::set<std::size_t>& lines) const {
  for (const Unit& unit : units_) {
    const bool is_named = !unit.name.empty() && unit.text == 0 &&
                          unit.begin >= frames_.front().end &&
                          std::ranges::find(names, unit.name) != names.end();
    if (is_named) append_lines_of(unit, lines);
  }
}

// Appends the lines with their header.
void SinumerikFlow::append_lines_of(const Unit& unit, std::set<std::size_t>& lines) const {
  const bool has_header =
      unit.begin > 0 && !program_of_header(texts_.front().line(unit.begin - 1)).empty();
  for (std::size_t line = unit.begin - (has_header ? 1 : 0); line < unit.end; ++line) {
    checkpoint_.pass();
    lines.insert(line);
  }
}

// By unit, whether another unit contains its name.
std::vector<bool> SinumerikFlow::said_by_others() const {
  if (units_.size() == 1) return {false};
  std::map<std::string, std::size_t, std::less<>> said_first;
  std::set<std::string, std::less<>> said_by_several;
  for (std::size_t index = 0; index < units_.size(); ++index) {
    const Unit& unit = units_[index];
    for (std::size_t line = unit.begin; line < unit.end; ++line) {
      checkpoint_.pass();
      const std::string_view content = texts_[unit.text].line(line);
      if (!program_of_header(content).empty()) continue;
      for (std::size_t at = 0; at < content.size() && content[at] != ';';) {
        const std::string name = name_at(content, at);
        if (!name.empty() && said_first.try_emplace(name, index).first->second != index)
          said_by_several.insert(name);
        at += std::max<std::size_t>(name.size(), 1);
      }
    }
  }
  std::vector<bool> said(units_.size());
  for (std::size_t index = 0; index < units_.size(); ++index) {
    const auto first = said_first.find(units_[index].name);
    said[index] = said_by_several.contains(units_[index].name) ||
                  (first != said_first.end() && first->second != index);
  }
  return said;
}

void SinumerikFlow::find_units_nobody_calls(const std::vector<bool>& called,
                                            std::set<std::size_t>& lines) const {
  for (std::size_t index = 0; index < units_.size(); ++index) {
    const Unit& unit = units_[index];
    const bool is_behind = unit.text == 0 && unit.begin >= frames_.front().end;
    if (is_behind && !unit.name.empty() && !called[index]) append_lines_of(unit, lines);
  }
}

// The values of a line that computes are no longer known.
bool SinumerikFlow::keep_part(std::size_t line, std::string& flat) {
  const ProgramText& text = texts_.front();
  const std::string_view content = text.line(line);
  const NamedHead head = named_head_of(content);
  const bool is_plain = begins_or_ends(name_at(content, head.behind)) ||
                        (!sinumerik_computes(setup_, content.substr(head.behind)) &&
                         !has_variable(content.substr(head.behind)));
  if (!is_plain) {
    frames_.front().current = line;
    return refuse(Code::nc_unsupported, head.behind, "a contour of a cycle that computes");
  }
  flat.append(content).append(text.line_end(line).empty() ? line_end() : text.line_end(line));
  return true;
}

bool SinumerikFlow::keep_parts_behind_end(const std::vector<bool>& called, std::string& flat) {
  std::set<std::size_t> lines;
  for (const std::vector<std::string>& names : named_by_cycles_) {
    if (!find_named_labels(names, lines)) return false;
    find_named_units(names, lines);
  }
  std::set<std::size_t> of_others;
  find_units_nobody_calls(called, of_others);
  if (lines.empty() && of_others.empty()) return true;
  // Nothing has ended the program: these lines would become a part of it.
  if (flat.empty())
    return refuse(Code::block_structure, 0,
                  lines.empty() ? "a program after one without M30"
                                : "a contour of a cycle after a program without M30");
  is_as_written_ = false;
  const ProgramText& text = texts_.front();
  std::set<std::size_t> all = lines;
  all.insert(of_others.begin(), of_others.end());
  for (const std::size_t line : all) {
    if (lines.contains(line) && !of_others.contains(line)) {
      if (!keep_part(line, flat)) return false;
      continue;
    }
    flat.append(text.line(line))
        .append(text.line_end(line).empty() ? line_end() : text.line_end(line));
  }
  return true;
}

}  // namespace trc::program

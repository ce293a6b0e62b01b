#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trc::program {

// Records what an assignment depends on, while its value is read. A variable that outlives the
// program and is set from its own old value is a counter: its assignment stays in the flat program,
// so that the control computes it anew in each run. The counter stands there by its name, other
// variables, which the flat program lacks, by their values (D-88).
class KeptText {
 public:
  // `kept`: the variable that is set if it outlives the program, else empty.
  void begin(std::string kept) {
    *this = {};
    reads_ = true;
    kept_ = std::move(kept);
  }
  void end() { reads_ = false; }
  // Returns the result of `read`, which reads an index: its variables are not part of the text.
  template <class Read>
  [[nodiscard]] auto read_aside(const Read& read) {
    const bool reads = std::exchange(reads_, false);
    auto value = read();
    reads_ = reads;
    return value;
  }

  // Whether the value of the variable may be unknown here, because the control has it.
  [[nodiscard]] bool may_be_unknown(std::string_view name) const { return reads_ && name == kept_; }
  // The variable that is read is one that the control holds.
  void keep(const std::string& name) {
    if (!reads_) return;
    if (name != kept_) return hang_by_the_way();
    counts_ = true;
    name_ = name;
  }
  // For a variable that has no value here.
  void keep_unknown(const std::string& name) {
    keep(name);
    if (reads_ && name == kept_) is_known_ = false;
  }
  // The variable was computed from values given for the machine, and is not in the output.
  void hang_by_the_way() { hangs_by_the_way_ |= reads_; }
  // A variable has been read, from `begin` of the line to `end`.
  void take(std::size_t begin, std::size_t end, std::string value) {
    if (reads_) parts_.push_back({begin, end, name_.empty() ? std::move(value) : name_});
    name_.clear();
  }

  [[nodiscard]] bool stays() const { return counts_; }
  [[nodiscard]] bool hangs_on_machine() const { return counts_ || hangs_by_the_way_; }
  [[nodiscard]] bool hangs_by_the_way() const { return hangs_by_the_way_; }
  [[nodiscard]] bool is_known() const { return is_known_; }
  // Of the expression that stands there in the line.
  [[nodiscard]] std::string text(std::string_view line, std::size_t begin, std::size_t end) const {
    std::string text;
    for (const Part& part : parts_) {
      if (part.begin < begin) continue;
      text.append(line.substr(begin, part.begin - begin)).append(part.instead);
      begin = part.end;
    }
    return text.append(line.substr(begin, end - begin));
  }

 private:
  struct Part {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::string instead{};
  };
  std::vector<Part> parts_{};
  std::string kept_{};
  std::string name_{};  // of the variable that is being read, where it stands by name
  bool reads_ = false;
  bool counts_ = false;
  bool is_known_ = true;
  bool hangs_by_the_way_ = false;
};

}  // namespace trc::program

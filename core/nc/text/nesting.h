#pragma once

namespace trc {

// One operand of an expression within another: after a sign, in brackets, an argument, an index.
// The reader recurses for each, so their depth is bounded: the stack must not run out.
class Nesting {
 public:
  // Counts in `depth` for as long as it lives.
  explicit Nesting(int& depth) : depth_(++depth) {}
  ~Nesting() { --depth_; }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;

  [[nodiscard]] bool is_too_deep() const { return depth_ > deepest; }

  // People write a handful of levels, and controls allow fewer than ten.
  static constexpr int deepest = 64;
  static constexpr const char* told = "nested too deeply";

 private:
  int& depth_;
};

}  // namespace trc

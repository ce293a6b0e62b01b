#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/nc/dialect/klartext_effects.h"

namespace trc::program {

// The effects of labels, when called from elsewhere, on the modes that RL and RR depend on (D-160).
// It takes the lines one by one; each is looked at once, however often the label is called. Where
// labels call themselves, or one another deeper than `deepest_call`, they cannot be followed:
// KlartextMode::anything.
class LabelEffects {
 public:
  static constexpr std::size_t no_label = static_cast<std::size_t>(-1);

  void begin_label(std::size_t label);
  void add(const KlartextEffects& effects);
  void add_call(std::size_t label);
  // `label`: no_label where a parameter names it.
  void add_jump(std::size_t label);
  // Some lines of the section may be executed, skipped or repeated.
  void add_choice() { sections_.back().has_choice = true; }
  // LBL 0, or the end of the program: no call goes beyond it.
  void end_section();

  // To be called after the last line, for a label that exists.
  [[nodiscard]] KlartextEffects of(std::size_t label);
  [[nodiscard]] bool has(std::size_t label) const {
    return label < labels_.size() && labels_[label].section != nowhere;
  }
  // The effects of a label that a parameter names.
  [[nodiscard]] KlartextEffects of_any() const { return of_any_; }

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  struct Label {
    std::size_t section = nowhere;
    std::size_t step = 0;  // the first one after it
  };
  // The effect of a line.
  struct Step {
    enum class Kind : std::uint8_t { effects, call, jump };
    Kind kind = Kind::effects;
    KlartextEffects effects{};
    std::size_t label = nowhere;
  };
  struct Section {
    std::size_t begin = 0;  // steps
    std::size_t known = 0;  // from this one on, up to the end of the section
    bool has_choice = false;
    bool has_label = false;
    bool leads_on = false;  // by calls or jumps
    bool is_looked_at = false;
    KlartextEffects own{};  // of its lines after the first label, if they are executed
  };

  void add_step(const Step& step);
  [[nodiscard]] KlartextEffects from(std::size_t section, std::size_t step, std::size_t depth);
  [[nodiscard]] KlartextEffects of_step(const Step& step, std::size_t section, std::size_t depth);

  std::vector<Label> labels_{};
  std::vector<Step> steps_{};
  std::vector<KlartextEffects> behind_{};  // from each step to the end of its section
  std::vector<Section> sections_{1};
  KlartextEffects of_any_{};
};

}  // namespace trc::program

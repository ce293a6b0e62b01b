#include "core/nc/program/klartext_label_effects.h"

#include "core/nc/program/flow.h"

namespace trc::program {
namespace {

constexpr KlartextEffects unknown{.unsure = KlartextMode::anything};

}  // namespace

void LabelEffects::begin_label(std::size_t label) {
  if (labels_.size() <= label) labels_.resize(label + 1);
  labels_[label] = {.section = sections_.size() - 1, .step = steps_.size()};
  sections_.back().has_label = true;
}

void LabelEffects::add_step(const Step& step) {
  steps_.push_back(step);
  behind_.emplace_back();
  sections_.back().known = steps_.size();
}

void LabelEffects::add(const KlartextEffects& effects) {
  if (effects.touched() == 0) return;
  add_step({.effects = effects});
  Section& section = sections_.back();
  if (!section.has_label) return;
  section.own = section.own.then(effects.perhaps());
  of_any_ = of_any_.then(effects.perhaps());
}

void LabelEffects::add_call(std::size_t label) {
  add_step({.kind = Step::Kind::call, .label = label});
  sections_.back().leads_on = true;
}

void LabelEffects::add_jump(std::size_t label) {
  add_step({.kind = Step::Kind::jump, .label = label});
  add_choice();
  sections_.back().leads_on = true;
}

void LabelEffects::end_section() {
  sections_.push_back({.begin = steps_.size(), .known = steps_.size()});
}

KlartextEffects LabelEffects::of(std::size_t label) {
  return from(labels_[label].section, labels_[label].step, 0);
}

// Works backwards from the end of the section, so that each step is examined once.
KlartextEffects LabelEffects::from(std::size_t section, std::size_t step, std::size_t depth) {
  Section& within = sections_[section];
  const std::size_t end =
      section + 1 < sections_.size() ? sections_[section + 1].begin : steps_.size();
  if (within.has_choice) step = within.begin;
  if (step < within.known) {
    if (within.is_looked_at || depth > deepest_call) return unknown;
    within.is_looked_at = true;
    while (within.known > step) {
      const std::size_t at = within.known - 1;
      const KlartextEffects effects = of_step(steps_[at], section, depth);
      behind_[at] = (within.has_choice ? effects.perhaps() : effects)
                        .then(at + 1 < end ? behind_[at + 1] : KlartextEffects{});
      within.known = at;
    }
    within.is_looked_at = false;
  }
  return step < end ? behind_[step] : KlartextEffects{};
}

KlartextEffects LabelEffects::of_step(const Step& step, std::size_t section, std::size_t depth) {
  if (step.kind == Step::Kind::effects) return step.effects;
  if (step.label == no_label) return step.kind == Step::Kind::call ? of_any_ : unknown;
  if (!has(step.label)) return unknown;
  const Label& label = labels_[step.label];
  if (step.kind == Step::Kind::call) return from(label.section, label.step, depth + 1);
  if (label.section == section) return {};
  const Section& target = sections_[label.section];
  return target.leads_on ? unknown : target.own;
}

}  // namespace trc::program

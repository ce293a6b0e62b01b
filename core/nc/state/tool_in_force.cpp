#include "core/nc/state/tool_in_force.h"

#include <cmath>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "core/nc/text/characters.h"

namespace trc {

void give_radius(const RadiusTerms& terms, Side side, TrcMode& mode) {
  const double beside = terms.beside();
  mode.tool_radius = std::abs(beside);
  mode.nominal_radius = terms.scaled_nominal();
  mode.below_nominal = terms.nominal > 0 && beside < 0;
  mode.side = side;
  if (beside < 0) mode.side = opposite(side);
}

ToolInForce::ToolInForce(const ProgramSetup& setup)
    : setup_(setup),
      terms_{.radius = setup.mode.tool_radius,
             .wear = setup.wear,
             .allowance = setup.allowance,
             .nominal = setup.nominal_radius} {
  // A centre path needs only the nominal radius, if nothing differs from it.
  if (setup.tool_radius_given || setup.mode.tool_radius != 0 || setup.nominal_radius > 0)
    giver_ = RadiusGiver::setup;
  if (setup.every_radius) {
    terms_.radius = *setup.every_radius;
    giver_ = RadiusGiver::setup;
  }
}

std::optional<Refusal> ToolInForce::set_radius(double radius) {
  RadiusTerms terms = terms_;
  terms.radius = radius;
  return enter_terms(terms, RadiusGiver::program);
}

// A T word that waits for its first motion gives the radius that is changed here.
std::optional<Refusal> ToolInForce::change_radius(double more) {
  if (has_tool_that_waits())
    if (auto refusal = take_tool(std::exchange(prepared_, no_tool))) return refusal;
  if (giver_ == RadiusGiver::nobody)
    return Refusal{.code = Code::no_tool_radius,
                   .detail = "a radius that is changed has to be there"};
  RadiusTerms terms = terms_;
  terms.radius += more;
  return change_terms(terms);
}

std::optional<Refusal> ToolInForce::set_wear(double wear) {
  RadiusTerms terms = terms_;
  terms.wear = wear;
  return change_terms(terms);
}

std::optional<Refusal> ToolInForce::set_allowance(double allowance) {
  RadiusTerms terms = terms_;
  terms.allowance = allowance;
  return change_terms(terms);
}

std::optional<Refusal> ToolInForce::set_scale(double scale) {
  RadiusTerms terms = terms_;
  terms.scale = scale;
  return change_terms(terms);
}

std::optional<Refusal> ToolInForce::set_tool(std::int64_t number, const WordPlace& place) {
  if (const auto row = row_of_tool(number)) return call_tool(*row);
  if (number != 0 && setup_.tools.empty())
    return Refusal{.code = Code::tool_unknown, .detail = "D" + std::to_string(number)};
  giver_ = RadiusGiver::nobody;
  missing_ = number;
  missing_letter_ = 'D';
  missing_place_ = place;
  prepared_ = no_tool;
  return {};
}

std::optional<Refusal> ToolInForce::define_tool(std::int64_t number, double radius) {
  defined_[number] = radius;
  if (setup_.every_radius) return {};
  const auto row = setup_.tools.find(number);
  const bool is_in_table = row != setup_.tools.end();
  const bool is_only = setup_.tools.empty() && setup_.mode.tool_radius != 0;
  const double given = is_in_table ? row->second.radius : setup_.mode.tool_radius;
  constexpr double alike = 1e-9;
  if ((!is_in_table && !is_only) || std::abs(given - radius) <= alike) return {};
  const bool has_edges = setup_.dialect == DialectName::sinumerik;
  const std::string edge = has_edges ? " D" + std::to_string(edge_of_row(number)) : "";
  const char* const letter = setup_.dialect == DialectName::fanuc ? "D" : "T";
  return Refusal{.code = Code::tool_radius_contradicts,
                 .detail = letter + std::to_string(tool_of_row(number)) + edge,
                 .values = {{"tool_radius", radius}, {"radius_of_setup", given}}};
}

double ToolInForce::wear_of(std::int64_t number) const {
  if (const auto wear = wears_.find(number); wear != wears_.end()) return wear->second;
  const auto tool = setup_.tools.find(number);
  if (tool != setup_.tools.end()) return tool->second.wear;
  return setup_.tools.empty() && !defined_.contains(number) ? setup_.wear : 0;
}

std::optional<Refusal> ToolInForce::call_tool(const ToolRow& row) {
  return enter_row(row, RadiusGiver::program);
}

std::optional<Refusal> ToolInForce::load_tool() {
  loads_tools_ = true;
  if (prepared_ == no_tool) return {};
  loaded_ = std::exchange(prepared_, no_tool);
  return take_tool(loaded_);
}

std::int64_t ToolInForce::tool_named(std::string_view name) const {
  const auto tool = setup_.tool_names.find(in_capitals_as_utf8(name));
  return tool == setup_.tool_names.end() ? no_tool_number : tool->second;
}

std::optional<ToolRow> ToolInForce::row_of_tool(std::int64_t number) const {
  const auto tool = setup_.tools.find(number);
  const bool is_in_table = tool != setup_.tools.end();
  if (const auto defined = defined_.find(number); defined != defined_.end())
    return ToolRow(defined->second, wear_of(number));
  if (is_in_table) return ToolRow(tool->second.radius, wear_of(number));
  if (setup_.every_radius && number != 0) return ToolRow(*setup_.every_radius, setup_.wear);
  return std::nullopt;
}

std::optional<Refusal> ToolInForce::enter_row(const ToolRow& row, RadiusGiver giver) {
  RadiusTerms terms = terms_;
  terms.radius = row.radius;
  terms.wear = setup_.every_radius ? setup_.wear : row.wear;
  return enter_terms(terms, giver);
}

std::optional<Refusal> ToolInForce::enter_terms(const RadiusTerms& terms, RadiusGiver giver) {
  giver_ = giver;
  missing_ = no_tool;
  if (!setup_.every_radius) return change_terms(terms);
  RadiusTerms surveyed = terms;
  const double radius = *setup_.every_radius;
  surveyed.radius = terms.nominal > 0 ? radius : std::copysign(radius, terms.radius);
  return change_terms(surveyed);
}

std::optional<Refusal> ToolInForce::change_terms(const RadiusTerms& terms) {
  const auto fits = [](double value) {
    return value >= -largest_tool_radius && value <= largest_tool_radius;  // false for NaN
  };
  if (!fits(terms.radius) || !fits(terms.effective()))
    return Refusal{
        .code = Code::tool_radius_out_of_range,
        .values = {{"tool_radius", fits(terms.radius) ? terms.effective() : terms.radius},
                   {"largest", largest_tool_radius}}};
  if (terms != terms_ && terms.beside() != 0) zero_reported_ = false;
  terms_ = terms;
  return {};
}

// A radius of the setup applies to tools that the table does not have.
std::optional<Refusal> ToolInForce::take_tool(std::int64_t number) {
  if (giver_ == RadiusGiver::program) return {};
  if (defined_.contains(number) || setup_.tools.contains(number))
    return enter_row(*row_of_tool(number), RadiusGiver::tool_in_spindle);
  if (giver_ == RadiusGiver::setup && (wears_.empty() || setup_.every_radius)) return {};
  if (giver_ == RadiusGiver::setup) return set_wear(wear_of(number));
  giver_ = RadiusGiver::nobody;
  missing_ = number;
  missing_letter_ = 'T';
  missing_place_ = prepared_place_;
  return {};
}

std::optional<Refusal> ToolInForce::check_at_first_motion(const Source& selected) {
  // If the tool is still missing, it is reported where it was called.
  const bool is_missed = giver_ == RadiusGiver::nobody && !defined_.contains(loaded_);
  const bool reads_register =
      setup_.dialect == DialectName::fanuc && loaded_ != no_tool && !is_missed;
  if (has_tool_that_waits() || reads_register)
    if (auto refusal = take_tool(has_tool_that_waits() ? prepared_ : loaded_)) return refusal;
  return check(selected);
}

std::optional<Refusal> ToolInForce::check(const Source& selected) {
  if (giver_ == RadiusGiver::nobody && missing_ > 0 && !setup_.tools.empty())
    return Refusal{.code = Code::tool_unknown,
                   .detail = missing_letter_ + std::to_string(missing_),
                   .place = missing_place_};
  if (giver_ == RadiusGiver::nobody)
    return Refusal{.code = Code::no_tool_radius, .detail = missing_radius(selected)};
  const bool wear_mode = terms_.nominal > 0;
  const double wear = wear_mode ? terms_.radius + terms_.wear : terms_.wear;
  if (!(std::abs(wear) <= setup_.max_wear)) {
    Refusal refusal{.code = Code::wear_too_large,
                    .values = {{"wear", wear}, {"max_wear", setup_.max_wear}}};
    if (wear_mode) refusal.values.push_back({"nominal_radius", terms_.nominal});
    return refusal;
  }
  const bool is_zero = !wear_mode && terms_.beside() == 0;
  if (!is_zero || std::exchange(zero_reported_, true)) return {};
  return Refusal{.code = Code::tool_radius_zero};
}

std::string ToolInForce::missing_radius(const Source& selected) const {
  const bool klartext = setup_.dialect == DialectName::heidenhain;
  std::string text = (klartext ? "RL or RR " : "G41 or G42 ") + place_of(selected);
  if (missing_ == 0) return text + ", D0 or T0 is no tool";
  if (missing_ != no_tool) return text + ", the tool table has no T" + std::to_string(missing_);
  if (prepared_ != no_tool) return text + ", T" + std::to_string(prepared_) + " without M06";
  return text;
}

}  // namespace trc

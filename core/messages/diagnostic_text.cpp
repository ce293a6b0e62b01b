#include "core/messages/diagnostic_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/entry_help.h"
#include "core/base/length_unit.h"
#include "core/base/reasons.h"
#include "core/messages/english.h"
#include "core/messages/german.h"
#include "core/messages/german_detail.h"
#include "core/messages/help_by_reason.h"
#include "core/messages/in_words_of.h"

namespace trc {
namespace {

enum class Measure { length, angle, share, feed, count, lines, block_number };

struct ValueWords {
  std::string_view name;
  std::string_view english;
  std::string_view german;
  Measure measure = Measure::length;
};

// A name that is missing here is a length, and its own words describe it.
constexpr auto words_of_values = std::to_array<ValueWords>({
    {"angle", "angle", "Winkel", Measure::angle},
    {"blocks", "blocks too near", "Sätze zu nah", Measure::count},
    {"bytes", "bytes", "Bytes", Measure::count},
    {"center_shift", "shift of the centre", "Verschiebung des Mittelpunkts", Measure::length},
    {"characters", "characters", "Zeichen", Measure::count},
    {"clearance", "clearance", "Abstand", Measure::length},
    {"compensated_length", "compensated length", "korrigierte Länge", Measure::length},
    {"contour_radius", "radius of the contour", "Radius der Kontur", Measure::length},
    {"coordinate", "coordinate", "Koordinate", Measure::length},
    {"corrected_radius", "corrected radius", "korrigierter Radius", Measure::length},
    {"corrected_sweep", "sweep of its path", "Bogenwinkel seiner Bahn", Measure::angle},
    {"decimals", "decimals", "Nachkommastellen", Measure::count},
    {"deeper", "deeper", "tiefer", Measure::length},
    {"difference", "difference", "Unterschied", Measure::length},
    {"digits", "digits", "Stellen", Measure::count},
    {"distance", "distance", "Abstand", Measure::length},
    {"end_radius", "end radius", "Endradius", Measure::length},
    {"feed", "feed", "Vorschub", Measure::feed},
    {"gap", "gap", "Lücke", Measure::length},
    {"largest", "largest", "höchstens", Measure::length},
    {"largest_angle", "largest angle", "größter Winkel", Measure::angle},
    {"largest_coordinate", "largest coordinate", "größte Koordinate", Measure::length},
    {"largest_difference", "largest difference", "größter Unterschied", Measure::length},
    {"largest_radius", "largest radius there", "größter Radius dort", Measure::length},
    {"largest_shift", "largest shift", "größte Verschiebung", Measure::length},
    {"largest_sweep", "largest sweep", "größter Bogenwinkel", Measure::angle},
    {"left_out_in_all", "of all stretches above ten tool radii",
     "von allen Stücken über zehn Werkzeugradien", Measure::length},
    {"left_out_length", "length left out", "ausgelassene Länge", Measure::length},
    {"limit", "limit", "Grenze", Measure::count},
    {"lines", "lines", "Zeilen", Measure::lines},
    {"longest_line", "longest line in characters", "längste Zeile in Zeichen", Measure::count},
    {"look_ahead_blocks", "blocks of the window", "Sätze des Fensters", Measure::count},
    {"max_masked_share", "largest share", "größter Anteil", Measure::share},
    {"max_wear", "largest wear", "größter Verschleiß", Measure::length},
    {"needed_length", "needed length", "nötige Länge", Measure::length},
    {"nominal_radius", "nominal radius", "Nennradius", Measure::length},
    {"path_radius", "radius of the path", "Radius der Bahn", Measure::length},
    {"programmed_length", "programmed length", "programmierte Länge", Measure::length},
    {"radius", "radius", "Radius", Measure::length},
    {"radius_of_setup", "radius of the setup", "Radius des Setups", Measure::length},
    {"selection_block", "selection block", "Anwahlsatz", Measure::block_number},
    {"slot_width", "width of the slot", "Breite der Nut", Measure::length},
    {"smallest_difference", "smallest difference", "kleinster Unterschied", Measure::length},
    {"smallest_radius", "smallest radius", "kleinster Radius", Measure::length},
    {"start_radius", "start radius", "Anfangsradius", Measure::length},
    {"tool_radius", "tool radius", "Werkzeugradius", Measure::length},
    {"turn", "turn", "Drehung", Measure::angle},
    {"value", "value", "Wert", Measure::count},
    {"wall_length", "length of all walls", "Länge aller Wände", Measure::length},
    {"wear", "wear", "Verschleiß", Measure::length},
});

static_assert(std::ranges::is_sorted(words_of_values, {}, &ValueWords::name));

struct PlaceWords {
  std::string_view name;
  std::string_view english;
  std::string_view german;
};

constexpr auto words_of_places = std::to_array<PlaceWords>({
    {"first", "first block", "erster Satz"},
    {"last", "last block", "letzter Satz"},
    {"other", "other block", "anderer Satz"},
    {"selection", "selection block", "Anwahlsatz"},
});

Measure measure_of(std::string_view name) {
  const auto row = std::ranges::lower_bound(words_of_values, name, {}, &ValueWords::name);
  return row != words_of_values.end() && row->name == name ? row->measure : Measure::length;
}

std::string words_of(std::string_view name, Language language) {
  const auto row = std::ranges::lower_bound(words_of_values, name, {}, &ValueWords::name);
  if (row != words_of_values.end() && row->name == name)
    return std::string(language == Language::german ? row->german : row->english);
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

// How lengths are written.
struct Lengths {
  LengthUnit unit = LengthUnit::mm;
  int decimals = 3;  // at least

  [[nodiscard]] bool in_inch() const { return unit == LengthUnit::inch; }
  [[nodiscard]] double in_unit(double length) const { return length / mm_of(unit); }
};

std::string written(double value, std::chars_format format, int precision) {
  std::array<char, 400> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, format, precision);
  return {digits.data(), end.ptr};
}

constexpr double least = 1e-9;  // mm, above the rounding error of a length that should be 0

// Written with the decimals of its unit. A length above `least` that these would show as 0 is
// written with significant digits.
std::string length_text(double length, const Lengths& lengths) {
  const double value = std::abs(length) < least ? 0 : lengths.in_unit(length);
  if (value != 0 && std::abs(value) < (lengths.in_inch() ? 0.00005 : 0.0005))
    return written(value, std::chars_format::general, 3);
  if (std::abs(value) >= 1e9) return written(value, std::chars_format::general, 9);
  return written(value, std::chars_format::fixed, lengths.decimals);
}

LengthUnit unit_of(const Diagnostic& diagnostic) {
  return diagnostic.inch ? LengthUnit::inch : LengthUnit::mm;
}

// With enough decimals to tell all these lengths apart, except for those that differ by rounding
// errors only.
Lengths lengths_for(std::span<const DiagnosticValue> values, LengthUnit unit) {
  constexpr int most = 9;
  Lengths lengths{.unit = unit, .decimals = unit == LengthUnit::inch ? 4 : 3};
  const auto look_the_same = [&] {
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t k = i + 1; k < values.size(); ++k)
        if (std::abs(values[i].value - values[k].value) > least &&
            measure_of(values[i].name) == Measure::length &&
            measure_of(values[k].name) == Measure::length &&
            length_text(values[i].value, lengths) == length_text(values[k].value, lengths))
          return true;
    return false;
  };
  while (lengths.decimals < most && look_the_same()) ++lengths.decimals;
  return lengths;
}

std::string with_unit(double length, const Lengths& lengths) {
  return length_text(length, lengths) + (lengths.in_inch() ? " in" : " mm");
}

std::string value_text(const DiagnosticValue& value, const Lengths& lengths, Language language) {
  const std::string words = words_of(value.name, language) + " ";
  switch (measure_of(value.name)) {
    case Measure::length:
      return words + with_unit(value.value, lengths);
    case Measure::angle:
      return words + written(value.value, std::chars_format::fixed, 3) +
             (language == Language::german ? " Grad" : " degrees");
    case Measure::share:
      return words + written(100 * value.value, std::chars_format::general, 9) + " %";
    case Measure::feed:
      return words +
             written(lengths.in_unit(value.value), std::chars_format::general,
                     lengths.in_inch() ? 6 : 9) +
             (lengths.in_inch() ? " in/min" : " mm/min");
    case Measure::lines:
      return "in " + written(value.value, std::chars_format::general, 9) + " " +
             words_of(value.name, language);
    case Measure::block_number:
      return words + "N" + written(value.value, std::chars_format::general, 9);
    case Measure::count:
      break;
  }
  return words + written(value.value, std::chars_format::general, 9);
}

// The words that begin the message about a place too narrow for the tool, and the name of the
// value they contain.
struct Narrowness {
  std::string english{};
  std::string german{};
  std::string_view said{};  // name of the value, which is not repeated after the title
};

std::optional<double> value_named(const Diagnostic& diagnostic, std::string_view name) {
  const auto found = std::ranges::find(diagnostic.values, name, &DiagnosticValue::name);
  if (found == diagnostic.values.end()) return std::nullopt;
  return found->value;
}

// "tool ⌀12.000 mm does not fit into the arc of radius 5.000 mm: "
Narrowness narrowness_of_arc(const Diagnostic& diagnostic) {
  const auto radius = value_named(diagnostic, "tool_radius");
  const auto arc = value_named(diagnostic, "contour_radius");
  if (!radius || !arc) return {};
  const std::array<DiagnosticValue, 2> both{{{"", *radius}, {"", *arc}}};
  const Lengths lengths = lengths_for(both, unit_of(diagnostic));
  const std::string tool = with_unit(2 * *radius, lengths);
  const std::string room = with_unit(*arc, lengths);
  return {.english = "tool ⌀" + tool + " does not fit into the arc of radius " + room + ": ",
          .german = "Werkzeug ⌀" + tool + " passt nicht in den Bogen mit Radius " + room + ": ",
          .said = "contour_radius"};
}

// "tool ⌀12.000 mm does not fit, the slot is 8.000 mm wide here: ". Empty if the room is unknown.
Narrowness narrowness_of(const Diagnostic& diagnostic) {
  if (diagnostic.code == Code::tool_not_smaller_than_arc) return narrowness_of_arc(diagnostic);
  const bool does_not_fit = diagnostic.code == Code::line_reversed ||
                            diagnostic.code == Code::arc_wrapped ||
                            diagnostic.code == Code::bottleneck;
  const auto radius = value_named(diagnostic, "tool_radius");
  const auto width = value_named(diagnostic, "slot_width");
  const auto largest = value_named(diagnostic, "largest_radius");
  if (!does_not_fit || !radius || !(width || largest)) return {};
  const std::array<DiagnosticValue, 2> both{
      {{"", 2 * *radius}, {"", width ? *width : 2 * *largest}}};
  const Lengths lengths = lengths_for(both, unit_of(diagnostic));
  const std::string tool = with_unit(both[0].value, lengths);
  const std::string room = with_unit(both[1].value, lengths);
  if (width)
    return {.english = "tool ⌀" + tool + " does not fit, the slot is " + room + " wide here: ",
            .german = "Werkzeug ⌀" + tool + " passt nicht, die Nut ist hier " + room + " breit: ",
            .said = "slot_width"};
  constexpr double none = 1e-3;  // mm
  if (*largest < none)
    return {.english = "tool ⌀" + tool + " does not fit, there is no room for any here: ",
            .german = "Werkzeug ⌀" + tool + " passt nicht, hier ist Platz für keines: ",
            .said = "largest_radius"};
  return {.english = "tool ⌀" + tool + " does not fit, there is room for ⌀" + room + " here: ",
          .german = "Werkzeug ⌀" + tool + " passt nicht, hier ist Platz für ⌀" + room + ": ",
          .said = "largest_radius"};
}

// The title, after the words that say how narrow the place is.
std::string with_narrowness(const Narrowness& narrow, std::string title, Language language) {
  if (narrow.said.empty()) return title;
  const bool german = language == Language::german;
  constexpr auto same = std::to_array<std::string_view>(
      {"the tool does not fit: ", "the tool does not fit into the arc: ",
       "das Werkzeug passt nicht: ", "das Werkzeug passt nicht in den Kreisbogen: "});
  for (const std::string_view words : same)
    if (title.starts_with(words)) title.erase(0, words.size());
  return (german ? narrow.german : narrow.english) + title;
}

// Help for a slip; {instead} is the text that was probably meant.
struct SlipHelp {
  SlipKind kind = SlipKind::none;
  std::string_view english;
  std::string_view german;
};

constexpr auto slip_helps = std::to_array<SlipHelp>({
    {SlipKind::decimal_comma, "Write a decimal point: {instead}.",
     "Dezimalpunkt statt Komma schreiben: {instead}."},
    {SlipKind::letter_o, "The letter O stands where a 0 belongs: did you mean {instead}?",
     "Der Buchstabe O steht, wo eine 0 hingehört: ist {instead} gemeint?"},
    {SlipKind::letter_l, "The letter l stands where a 1 belongs: did you mean {instead}?",
     "Der Buchstabe l steht, wo eine 1 hingehört: ist {instead} gemeint?"},
    {SlipKind::other_keyboard,
     "These look like signs of an NC program, but are not: type {instead} on the keyboard.",
     "Diese Zeichen sehen nur so aus wie die eines NC-Programms: {instead} mit der Tastatur "
     "eingeben."},
    {SlipKind::quotes, "Typographic quotes come from a word processor: write {instead}.",
     "Typografische Anführungszeichen stammen aus einer Textverarbeitung: {instead} schreiben."},
    {SlipKind::unit_of_another,
     "Under ISG G20 and G21 are about mirroring: write {instead} for the unit (G70 inch, G71 mm). "
     "If this is a program for Fanuc, Haas or the like, declare it: --dialect fanuc, `dialect` in "
     "the setup.",
     "Bei ISG gehören G20 und G21 zum Spiegeln: {instead} für die Maßeinheit schreiben (G70 Zoll, "
     "G71 mm). Ist das Programm für Fanuc, Haas oder dergleichen, dann dies angeben: --dialect "
     "fanuc, `dialect` im Setup."},
});

}  // namespace

std::string place_of(const Source& source, Language language) {
  const bool german = language == Language::german;
  std::string place = source.line > 0
                          ? (german ? "in Zeile " : "in line ") + std::to_string(source.line)
                          : (german ? "in Satz " : "in block ") + std::to_string(source.index);
  if (source.number != Source::no_number) place += " (N" + std::to_string(source.number) + ")";
  return place;
}

std::string text_of(const RelatedPlace& related, Language language) {
  const auto* const row = std::ranges::find(words_of_places, related.name, &PlaceWords::name);
  if (row == words_of_places.end()) return related.name + " block";
  return std::string(language == Language::german ? row->german : row->english);
}

namespace {

// Blocks of Klartext have numbers without N: "line 7 (block 6)".
std::string with_block_numbers(std::string text, Language language) {
  const std::string_view word = language == Language::german ? "Satz " : "block ";
  for (std::size_t at = text.find("(N"); at != std::string::npos; at = text.find("(N", at + 1)) {
    const std::size_t end = text.find_first_not_of("0123456789", at + 2);
    if (end != std::string::npos && end > at + 2 && text[end] == ')') text.replace(at + 1, 1, word);
  }
  return text;
}

}  // namespace

std::string_view title_of(Code code, Language language) {
  return language == Language::german ? german_row_of(code).title : english_row_of(code).cause;
}

std::string message_of(const Diagnostic& diagnostic, Language language) {
  const bool german = language == Language::german;
  const Narrowness narrow = narrowness_of(diagnostic);
  std::string text = with_narrowness(
      narrow, in_words_of(diagnostic.words, std::string(title_of(diagnostic.code, language))),
      language);
  if (!diagnostic.detail.empty())
    text.append(": ").append(german ? german_detail(diagnostic.detail) : diagnostic.detail);
  const char* separator = " (";
  std::span<const DiagnosticValue> values(diagnostic.values);
  const Lengths lengths = lengths_for(values, unit_of(diagnostic));
  while (!values.empty()) {
    if (values.front().name == narrow.said) {
      values = values.subspan(1);
      continue;
    }
    text.append(separator);
    if (values.front().name.ends_with("_index")) {
      const RelatedPlace place = take_place(values);
      text.append(text_of(place, language))
          .append(" ")
          .append(place_of(place.source, language).substr(std::string_view("in ").size()));
    } else {
      text.append(value_text(values.front(), lengths, language));
      values = values.subspan(1);
    }
    separator = ", ";
  }
  if (separator[0] == ',') text.append(")");
  if (!diagnostic.calls.empty()) text.append(", ").append(text_of(diagnostic.calls, language));
  return diagnostic.words == ControlWords::klartext ? with_block_numbers(std::move(text), language)
                                                    : text;
}

std::string text_of(const std::vector<CallPlace>& calls, Language language) {
  const bool german = language == Language::german;
  std::string text;
  for (auto place = calls.begin(); place != calls.end();) {
    const CallPlace& call = *place;
    const auto next =
        std::find_if(place, calls.end(), [&call](const CallPlace& other) { return other != call; });
    const auto times = next - place;
    text.append(text.empty() ? "in " : " in ");
    if (call.line_within > 0)
      text.append(german ? "Zeile " : "line ")
          .append(std::to_string(call.line_within))
          .append(german ? " von " : " of ");
    text.append(call.subprogram)
        .append(german ? ", aufgerufen in Zeile " : ", called from line ")
        .append(std::to_string(call.called_from));
    if (times > 1)
      text.append(" (").append(std::to_string(times)).append(german ? "-mal)" : " times)");
    place = next;
  }
  return text;
}

namespace {

// If G138 or G139 begins in an inside corner, a smaller tool does not fit either.
std::string help_in_corner(ControlWords words, Language language) {
  const bool german = language == Language::german;
  std::string text(german ? "So nicht fertigen. Die Kontur an einer anderen Stelle beginnen"
                          : "Do not machine it so. Begin the contour in another place");
  if (words == ControlWords::isg)
    text += german ? " oder mit G238 anwählen" : ", or select with G238";
  return text + (german ? ": in einer Innenecke hat kein Fräser Platz, wie klein er auch ist."
                        : ": in an inside corner no tool has room, however small.");
}

bool begins_in_corner(const Diagnostic& diagnostic) {
  const auto is_in_corner = [](const EntryProposal& proposal) {
    return proposal.shape == EntryProposal::Shape::inside_corner;
  };
  return diagnostic.entry_help &&
         std::ranges::any_of(diagnostic.entry_help->proposals, is_in_corner);
}

// An arc that is given by its radius has no centre to correct. In Klartext, a single word that is
// refused often belongs to another control.
std::string_view help_about_values(const Diagnostic& diagnostic, Language language) {
  const bool german = language == Language::german;
  if (diagnostic.code == Code::circle_center_misfit &&
      value_named(diagnostic, "smallest_radius").has_value())
    return german ? "Den Radius oder den Endpunkt berichtigen: der Radius muss wenigstens den "
                    "halben Weg vom Anfang zum Ende messen."
                  : "Correct the radius or the end point: the radius must be at least half of the "
                    "way from the start to the end.";
  // Whether the program calls a tool by name or not at all is not known here.
  const bool names_no_tool = diagnostic.detail.starts_with("G41 or G42 in ") ||
                             diagnostic.detail.starts_with("RL or RR in ");
  if (diagnostic.code == Code::no_tool_radius && names_no_tool &&
      diagnostic.detail.find(", ") == std::string::npos)
    return german ? "tool_radius im Setup angeben, oder eine Tabelle mit dem Werkzeug, das das "
                    "Programm vor G41 oder G42 aufruft (`tools` des Setups); ruft es keines auf, "
                    "hilft eine Tabelle nicht."
                  : "Give tool_radius in the setup, or a table with the tool that the program "
                    "calls before G41 or G42 (`tools` of the setup); if it calls none, a "
                    "table does not help.";
  if (diagnostic.code == Code::nc_unknown_function &&
      diagnostic.detail.ends_with(reason::with_axis_words))
    return german
               ? "Sie entfernen, oder an ihre Stelle die Bewegungen schreiben, die sie ausführt: "
                 "was Achsen bewegt, lässt sich nicht weiterreichen."
               : "Remove it, or write the motions that it makes in its place: what moves axes "
                 "cannot be passed on.";
  const bool is_center_word =
      diagnostic.detail == "I" || diagnostic.detail == "J" || diagnostic.detail == "K";
  if (diagnostic.code == Code::nc_unsupported && is_center_word)
    return german ? "Es streichen: in dieser Ebene ist es kein Mittelpunkt, und die Steigung einer "
                    "Helix folgt aus ihrem Ende."
                  : "Take it out: it is no centre in this plane, and the pitch of a helix follows "
                    "from its end.";
  const bool has_number = diagnostic.detail.size() > 2 && diagnostic.detail[1] >= '0' &&
                          diagnostic.detail[1] <= '9' &&
                          diagnostic.detail.find('=') != std::string::npos;
  if (diagnostic.code == Code::nc_axis_unknown && has_number)
    return german ? "Den Buchstaben allein schreiben, wo die Achse der Ebene gemeint ist, X statt "
                    "X1; eine Achse für sich zu den mitgeführten Achsen des Setups nehmen, mit "
                    "dem Namen, den sie hier hat: --set axis_names=X1."
                  : "Write the letter alone where the axis of the plane is meant, X for X1; add an "
                    "axis of its own to the tracking axes of the setup, by the name it has here: "
                    "--set axis_names=X1.";
  const bool is_word_alone =
      !diagnostic.detail.empty() && diagnostic.detail.find_first_of(" ,") == std::string::npos;
  if (diagnostic.code == Code::nc_unsupported && diagnostic.words == ControlWords::klartext &&
      is_word_alone)
    return german ? "Die Schreibweise prüfen. Ist es das Programm einer anderen Steuerung, dann "
                    "deren Dialekt angeben (--dialect, `dialect` im Setup)."
                  : "Check its spelling. If this is a program of another control, declare its "
                    "dialect (--dialect, `dialect` in the setup).";
  return {};
}

// How to declare the program after "TRANS, …, as in sinumerik". Empty if no dialect is named.
std::string help_to_declare(const Diagnostic& diagnostic, Language language) {
  struct Family {
    std::string_view dialect;
    std::string_view english;
    std::string_view german;
  };
  constexpr auto families = std::to_array<Family>(
      {{"fanuc", "for Fanuc, Haas or the like", "für Fanuc, Haas oder dergleichen"},
       {"linuxcnc", "for LinuxCNC", "für LinuxCNC"},
       {"sinumerik", "for Sinumerik", "für Sinumerik"},
       {"heidenhain", "in Klartext of Heidenhain", "in Klartext von Heidenhain"}});
  if (diagnostic.code != Code::other_dialect) return {};
  const auto* const family = std::ranges::find_if(families, [&](const Family& each) {
    return diagnostic.detail.ends_with(std::string(reason::as_in_dialect).append(each.dialect));
  });
  if (family == families.end()) return {};
  const std::string name(family->dialect);
  const bool is_of_isg = diagnostic.words == ControlWords::isg;
  if (language == Language::german)
    return "Ist dies ein Programm " + std::string(family->german) +
           ", dann dies angeben: --dialect " + name + ", `dialect` im Setup. " +
           (is_of_isg ? "Ist es eines für ISG, das" : "Sonst das") + " Wort streichen." +
           (name == "fanuc" ? " LinuxCNC hat viele dieser Wörter auch: --dialect linuxcnc." : "");
  return "If this is a program " + std::string(family->english) + ", declare it: --dialect " +
         name + ", `dialect` in the setup. " +
         (is_of_isg ? "If it is one for ISG, remove" : "Else remove") + " the word." +
         (name == "fanuc" ? " LinuxCNC has many of these words too: --dialect linuxcnc." : "");
}

}  // namespace

DiagnosticTexts texts_of(const Diagnostic& diagnostic) {
  if (diagnostic.texts) return *diagnostic.texts;
  return {.message = message_of(diagnostic),
          .remedy = help_of(diagnostic),
          .reason = std::string(row_of(diagnostic.code).reason),
          .title = in_words_of(diagnostic.words,
                               std::string(title_of(diagnostic.code, diagnostic.language))),
          .text = message_of(diagnostic, diagnostic.language),
          .help = help_of(diagnostic, diagnostic.language)};
}

std::string help_of(const Diagnostic& diagnostic, Language language) {
  const bool german = language == Language::german;
  if (begins_in_corner(diagnostic)) return help_in_corner(diagnostic.words, language);
  const auto* const slip = std::ranges::find(slip_helps, diagnostic.slip.kind, &SlipHelp::kind);
  if (slip == slip_helps.end()) {
    if (std::string declared = help_to_declare(diagnostic, language); !declared.empty())
      return declared;
    std::string_view help = help_in(diagnostic.words, diagnostic.code, language);
    constexpr std::array of_words{
        Code::nc_unsupported,    Code::position_unknown,     Code::nc_number,
        Code::circle_incomplete, Code::circle_center_misfit, Code::ended_while_active,
        Code::no_tool_radius,    Code::side_behind_end,      Code::line_reversed,
        Code::arc_wrapped,       Code::clearance_violated,   Code::circular_selection_block};
    // For these reasons the general help for expressions says little.
    constexpr std::array<std::string_view, 14> own_reasons{reason::no_colon_after_number,
                                                           reason::words_after_statement,
                                                           reason::number_after_words,
                                                           reason::set_by_program,
                                                           reason::variable_of_haas,
                                                           reason::changed_by_program,
                                                           reason::argument_without_point,
                                                           reason::machine_variable_set,
                                                           reason::tool_in_spindle,
                                                           reason::beside_m98,
                                                           reason::beside_m98_with_calls,
                                                           reason::beside_g65,
                                                           reason::beside_g66,
                                                           reason::text_in_utf16};
    const bool has_own_reason = std::ranges::any_of(
        own_reasons, [&](std::string_view reason) { return diagnostic.detail.ends_with(reason); });
    // Klartext has its own help for an unknown position.
    const bool is_of_klartext =
        diagnostic.words == ControlWords::klartext && diagnostic.code == Code::position_unknown;
    const std::string_view by_reason =
        is_of_klartext ? std::string_view()
        : has_own_reason || std::ranges::find(of_words, diagnostic.code) != of_words.end()
            ? help_by_reason(diagnostic.detail, language)
            : std::string_view();
    if (const std::string_view of_values = help_about_values(diagnostic, language);
        !of_values.empty())
      help = of_values;
    if (!by_reason.empty()) help = by_reason;
    if (help.empty())
      help = german ? german_row_of(diagnostic.code).help : english_row_of(diagnostic.code).remedy;
    return in_words_of(diagnostic.words, std::string(help));
  }
  std::string text(german ? slip->german : slip->english);
  constexpr std::string_view hole = "{instead}";
  return text.replace(text.find(hole), hole.size(), diagnostic.slip.instead);
}

}  // namespace trc

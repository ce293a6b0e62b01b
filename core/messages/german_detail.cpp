#include "core/messages/german_detail.h"

#include <algorithm>
#include <array>

#include "core/base/reasons.h"
#include "core/messages/german_fragments.h"

namespace trc {
namespace {

struct Phrase {
  std::string_view english;
  std::string_view german;
};

// Phrases of details about a word: the meanings of functions, and the readers' own phrases.
constexpr auto phrases = std::to_array<Phrase>({
    {"G20, inch in fanuc and linuxcnc", "G20, Zoll bei fanuc und linuxcnc"},
    {"L, a subprogram call", "L, ein Unterprogrammaufruf"},
    {"P, a parameter", "P, ein Parameter"},
    {"[ ] of no array", "[ ] ohne Feld"},
    {"a block to skip on demand", "ein ausblendbarer Satz"},
    {"a block without a colon after its number", "ein Satz ohne Doppelpunkt hinter seiner Nummer"},
    {"a bracket without )", "eine Klammer ohne )"},
    {"a bracket without ]", "eine Klammer ohne ]"},
    {"a call after words", "ein Aufruf hinter Wörtern"},
    {"a call of lines that are not followed", "ein Aufruf von Zeilen, denen nicht gefolgt wird"},
    {"a comment without )", "ein Kommentar ohne )"},
    {"a comparison", "ein Vergleich"},
    {"a comparison of numbers that are nearly equal",
     "ein Vergleich von Zahlen, die fast gleich sind"},
    {"a condition without IF", "eine Bedingung ohne IF"},
    {"a condition without GOTO", "eine Bedingung ohne GOTO"},
    {"a condition without [ ]", "eine Bedingung ohne [ ]"},
    {"a control character", "ein Steuerzeichen"},
    {"a control statement", "eine Steueranweisung"},
    {"a cycle of the program", "ein Zyklus des Programms"},
    {"a decimal comma: write a point", "ein Dezimalkomma: Punkt schreiben"},
    {"a division by zero", "eine Division durch null"},
    {"a jump", "ein Sprung"},
    {"a jump to a label", "ein Sprung zu einem Label"},
    {"a jump without target", "ein Sprung ohne Ziel"},
    {"a line after the end of a subprogram", "eine Zeile hinter dem Ende eines Unterprogramms"},
    {"a line between $SWITCH and its first $CASE",
     "eine Zeile zwischen $SWITCH und seinem ersten $CASE"},
    {"a line to skip that computes", "eine ausblendbare Zeile, die rechnet"},
    {"a main program call", "ein Programmaufruf"},
    {"a motion after G90 or G91 that may be skipped",
     "eine Bewegung hinter G90 oder G91, die ausgeblendet sein kann"},
    {"a name without >", "ein Name ohne >"},
    {"a number without letter", "eine Zahl ohne Adressbuchstaben"},
    {"a parameter without name", "ein Parameter ohne Namen"},
    {"a tool radius without a decimal point: say what whole numbers count in",
     "ein Werkzeugradius ohne Dezimalpunkt: angeben, worin ganze Zahlen zählen"},
    {"a wear without a decimal point: say what whole numbers count in",
     "ein Verschleiß ohne Dezimalpunkt: angeben, worin ganze Zahlen zählen"},
    {"a place metres away without a decimal point: say what whole numbers count in",
     "ein Ort in Metern Entfernung ohne Dezimalpunkt: angeben, worin ganze Zahlen zählen"},
    {"a parameter and no radius", "ein Parameter und kein Radius"},
    {"a power without value", "eine Potenz ohne Wert"},
    {"a rounding or a chamfer", "eine Rundung oder Fase"},
    {"a second block in the line, or a comment that reads as one",
     "ein zweiter Satz in der Zeile oder ein Kommentar, der sich so liest"},
    {"a second call in one line", "ein zweiter Aufruf in einer Zeile"},
    {"a second program", "ein zweites Programm"},
    {"a second program in one text", "ein zweites Programm in einem Text"},
    {"a statement", "eine Anweisung"},
    {"a statement in parentheses", "eine Anweisung in Klammern"},
    {"a statement on several lines", "eine Anweisung über mehrere Zeilen"},
    {"a subprogram", "ein Unterprogramm"},
    {"a subprogram after the program", "ein Unterprogramm hinter dem Programm"},
    {"a subprogram call", "ein Unterprogrammaufruf"},
    {"a subprogram or a loop", "ein Unterprogramm oder eine Schleife"},
    {"a subprogram that is not given", "ein Unterprogramm, das nicht angegeben ist"},
    {"a subprogram without M99", "ein Unterprogramm ohne M99"},
    {"a subprogram without its end", "ein Unterprogramm ohne sein Ende"},
    {"a system variable", "eine Systemvariable"},
    {"a tool change", "ein Werkzeugwechsel"},
    {"a text", "ein Text"},
    {"a variable of Haas or a tool offset of Fanuc",
     "eine Variable von Haas oder eine Werkzeugkorrektur von Fanuc"},
    {"after blocks without a number of their program",
     "hinter Sätzen ohne eine Nummer ihres Programms"},
    {"a text and a number", "ein Text und eine Zahl"},
    {"a text that is too long", "ein zu langer Text"},
    {"a text without end", "ein Text ohne Ende"},
    {"a text without its end", "ein Text ohne Ende"},
    {"a turning axis under G254", "eine Drehachse unter G254"},
    {"a type", "ein Datentyp"},
    {"a unit or a plane that may be skipped",
     "eine Maßeinheit oder Ebene, die ausgeblendet sein kann"},
    {"a variable", "eine Variable"},
    {"a variable or an expression", "eine Variable oder ein Ausdruck"},
    {"a variable with the name of an address", "eine Variable mit dem Namen einer Adresse"},
    {"a variable without =", "eine Variable ohne ="},
    {"a variable without an address", "eine Variable ohne Adresse"},
    {"a word after a # command", "ein Wort hinter einem #-Befehl"},
    {"an approach that goes on smoothly: NORM or KONT",
     "ein Anfahren mit stetigem Übergang: NORM oder KONT"},
    {"an array as parameter", "ein Feld als Parameter"},
    {"an array without [ ]", "ein Feld ohne [ ]"},
    {"an expression", "ein Ausdruck"},
    {"an expression or a name", "ein Ausdruck oder ein Name"},
    {"an index beyond its array", "ein Index außerhalb seines Feldes"},
    {"an unknown function", "eine unbekannte Funktion"},
    {"ISO mode: the program is one of --dialect fanuc",
     "ISO-Modus: das Programm ist eines für --dialect fanuc"},
    {"back boring", "Rückwärtsbohren"},
    {"after $ELSE", "hinter $ELSE"},
    {"a block number after other words", "eine Satznummer hinter anderen Wörtern"},
    {"below 0", "kleiner 0"},
    {"beside G65", "neben G65"},
    {"beside M98", "neben M98"},
    {"beyond the range of its type", "außerhalb des Bereichs des Datentyps"},
    {"bits of what is no whole number", "Bits von etwas, was keine ganze Zahl ist"},
    {"boring", "Ausdrehen"},
    {"boring with dwell", "Ausdrehen mit Verweilzeit"},
    {"chamfer", "Fase"},
    {"circle in space", "Kreis im Raum"},
    {"circular pocket, clockwise", "Kreistasche im Uhrzeigersinn"},
    {"circular pocket, counter-clockwise", "Kreistasche gegen den Uhrzeigersinn"},
    {"collision check of approach and retract", "Kollisionsprüfung beim An- und Abfahren"},
    {"compensation of the tool length in five axes", "Werkzeuglängenkorrektur in fünf Achsen"},
    {"compensation of the tool radius in space", "Werkzeugradiuskorrektur im Raum"},
    {"contour rotation", "Drehung der Kontur"},
    {"corner angle setting", "Einstellung des Eckenwinkels"},
    {"cylindrical interpolation", "Mantelflächenbearbeitung"},
    {"cylindrical mapping", "Mantelflächenbearbeitung"},
    {"data setting", "Daten setzen"},
    {"deep hole drilling", "Tieflochbohren"},
    {"deep hole drilling with chip breaking", "Tieflochbohren mit Spanbrechen"},
    {"diameter programming", "Durchmesserprogrammierung"},
    {"diameter words", "Durchmesserangaben"},
    {"drilling", "Bohren"},
    {"drilling with chip breaking", "Bohren mit Spanbrechen"},
    {"drilling with dwell", "Bohren mit Verweilzeit"},
    {"dynamic work offset", "dynamische Nullpunktverschiebung"},
    {"engraving", "Gravieren"},
    {"feature coordinate system", "Koordinatensystem der schrägen Fläche"},
    {"fine boring", "Feinbohren"},
    {"finishing of a turned profile", "Schlichten eines Drehprofils"},
    {"from the reference point", "vom Referenzpunkt"},
    {"further tool offset", "weitere Werkzeugkorrektur"},
    {"holes on a circle; alone inch", "Lochkreis; allein Zoll"},
    {"holes on a line", "Lochreihe"},
    {"holes on an arc; alone mm", "Löcher auf einem Bogen; allein mm"},
    {"homing", "Referenzpunktfahrt"},
    {"implicit subprogram call", "impliziter Unterprogrammaufruf"},
    {"in a subprogram", "in einem Unterprogramm"},
    {"in a text that is only passed on", "in einem Text, der nur weitergereicht wird"},
    {"inch", "Zoll"},
    {"keeping of the compensation vector; with R a tangential exit",
     "Halten des Korrekturvektors; mit R tangentiales Abfahren"},
    {"left-hand tapping", "Linksgewindebohren"},
    {"left-hand tapping in space", "Linksgewindebohren im Raum"},
    {"local coordinate system", "lokales Koordinatensystem"},
    {"macro call", "Makroaufruf"},
    {"manual mode", "Handbetrieb"},
    {"measuring", "Messen"},
    {"measuring of a tool diameter", "Messen des Werkzeugdurchmessers"},
    {"measuring of a tool length; with R a tangential entry",
     "Messen der Werkzeuglänge; mit R tangentiales Anfahren"},
    {"measuring of a zero point", "Messen des Nullpunkts"},
    {"measuring of a zero point; with R a rounding", "Messen des Nullpunkts; mit R eine Rundung"},
    {"measuring shift off", "Messversatz aus"},
    {"measuring shift on", "Messversatz ein"},
    {"mirroring", "Spiegeln"},
    {"modal macro call", "modaler Makroaufruf"},
    {"more than 0 and at most 1000000000 mm/min", "mehr als 0 und höchstens 1000000000 mm/min"},
    {"more than 30 arguments", "mehr als 30 Argumente"},
    {"more values than elements", "mehr Werte als Elemente"},
    {"motion in machine coordinates", "Bewegung in Maschinenkoordinaten"},
    {"motion in step with the spindle", "Bewegung synchron zur Spindel"},
    {"motion until a signal", "Bewegung bis zu einem Signal"},
    {"nested too deeply", "zu tief geschachtelt"},
    {"no UTF-8", "kein UTF-8"},
    {"not in the program", "nicht im Programm"},
    {"of 0 and 0", "von 0 und 0"},
    {"of a loop that was not begun", "einer Schleife, die nicht begonnen wurde"},
    {"of a subprogram", "eines Unterprogramms"},
    {"of what has no end, or of itself", "von etwas, was kein Ende hat oder sich selbst enthält"},
    {"output of positions", "Ausgabe von Positionen"},
    {"outside a comment", "außerhalb eines Kommentars"},
    {"outside of what is declared", "außerhalb dessen, was deklariert ist"},
    {"outside of what is repeated", "außerhalb dessen, was wiederholt wird"},
    {"plane U V", "Ebene U V"},
    {"plane V W", "Ebene V W"},
    {"plane W U", "Ebene W U"},
    {"pocket milling of a contour in a subprogram", "Taschenfräsen einer Kontur im Unterprogramm"},
    {"polar coordinate interpolation", "Polarkoordinaten-Interpolation"},
    {"polar coordinate interpolation, or a work offset of Haas",
     "Polarkoordinaten-Interpolation, oder ein Nullpunkt von Haas"},
    {"polar coordinates", "Polarkoordinaten"},
    {"positioning from one side", "Positionieren von einer Seite"},
    {"probing", "Antasten"},
    {"radius programming", "Radiusprogrammierung"},
    {"retract", "Rückzug"},
    {"retract from tapping", "Rückzug aus dem Gewinde"},
    {"return or endsub outside of a sub", "return oder endsub außerhalb eines sub"},
    {"rigid left-hand tapping", "Linksgewindebohren ohne Ausgleichsfutter"},
    {"rigid tapping", "Gewindebohren ohne Ausgleichsfutter"},
    {"rotation", "Drehung"},
    {"roughing of a turned profile", "Schruppen eines Drehprofils"},
    {"rounding", "Rundung"},
    {"scaling", "Skalieren"},
    {"shift of the coordinates", "Verschiebung der Koordinaten"},
    {"smooth approach along a quarter circle: use a straight G41 block",
     "weiches Anfahren im Viertelkreis: einen geraden G41-Satz nehmen"},
    {"smooth approach along a semicircle: use a straight G41 block",
     "weiches Anfahren im Halbkreis: einen geraden G41-Satz nehmen"},
    {"smooth approach along a straight line: use a straight G41 block",
     "weiches Anfahren auf einer Geraden: einen geraden G41-Satz nehmen"},
    {"smooth approach in space", "weiches Anfahren im Raum"},
    {"smooth approach in the plane", "weiches Anfahren in der Ebene"},
    {"smooth retract along a quarter circle: use a straight G40 block",
     "weiches Abfahren im Viertelkreis: einen geraden G40-Satz nehmen"},
    {"smooth retract along a semicircle: use a straight G40 block",
     "weiches Abfahren im Halbkreis: einen geraden G40-Satz nehmen"},
    {"smooth retract along a straight line: use a straight G40 block",
     "weiches Abfahren auf einer Geraden: einen geraden G40-Satz nehmen"},
    {"software limit", "Software-Endschalter"},
    {"spline", "Spline"},
    {"storing of a position", "Speichern einer Position"},
    {"tapping", "Gewindebohren"},
    {"tapping in space", "Gewindebohren im Raum"},
    {"tapping with compensating chuck", "Gewindebohren mit Ausgleichsfutter"},
    {"the beginning of the program after its subprograms",
     "der Anfang des Programms hinter seinen Unterprogrammen"},
    {"the call of either of two subprograms", "der Aufruf eines von zwei Unterprogrammen"},
    {"the dialect heidenhain", "der Dialekt heidenhain"},
    {"the end of a subprogram", "das Ende eines Unterprogramms"},
    {"the end of the line", "das Ende der Zeile"},
    {"the name of a call in a variable", "der Name eines Aufrufs in einer Variablen"},
    {"text in UTF-16", "Text in UTF-16"},
    {"thread cutting", "Gewindeschneiden"},
    {"thread turning", "Gewindedrehen"},
    {"tilted working plane", "geschwenkte Bearbeitungsebene"},
    {"to a fixed point", "auf einen Festpunkt"},
    {"to a further reference point", "auf einen weiteren Referenzpunkt"},
    {"to a stored position", "auf eine gespeicherte Position"},
    {"to an end that its loop changes", "bis zu einem Ende, das die Schleife ändert"},
    {"to the reference point", "auf den Referenzpunkt"},
    {"too large", "zu groß"},
    {"tool axis orientation", "Orientierung der Werkzeugachse"},
    {"tool centre point control", "Führung der Werkzeugspitze"},
    {"tool data and zero points", "Werkzeugdaten und Nullpunkte"},
    {"tool length along the tool axis", "Werkzeuglänge in der Werkzeugachse"},
    {"tool offset decrease", "Werkzeugkorrektur verkleinern"},
    {"tool offset given by axis words", "Werkzeugkorrektur durch Achswörter"},
    {"tool offset increase", "Werkzeugkorrektur vergrößern"},
    {"tool offset, twice", "Werkzeugkorrektur, doppelt"},
    {"too large", "zu groß"},
    {"turns from a place that is not known", "Umläufe von einem unbekannten Ort aus"},
    {"turns beside a radius", "Umläufe neben einem Radius"},
    {"turns without I J K alone", "Umläufe ohne I J K allein"},
    {"turns, at most 1000", "Umläufe, höchstens 1000"},
    {"under the thread", "im Gewinde"},
    {"what stands between ( and )", "was zwischen ( und ) steht"},
    {"where == compares", "wo == vergleicht"},
    {"which DEF does not name", "die DEF nicht nennt"},
    {"which LinuxCNC does not have", "gibt es bei LinuxCNC nicht"},
    {"which is declared nowhere", "die nirgends deklariert ist"},
    {"which is there twice", "das es zweimal gibt"},
    {"which the motion of the program changes", "die die Bewegung des Programms ändert"},
    {"which the subprogram and its caller have", "die das Unterprogramm und sein Aufrufer haben"},
    {"with a motion", "mit einer Bewegung"},
    {"with a target", "mit einem Ziel"},
    {"with an expression", "mit einem Ausdruck"},
    {"with axis words", "mit Achswörtern"},
    {"percentages of axes, beside a motion or another function of axes",
     "Prozente von Achsen, neben einer Bewegung oder einer anderen Funktion mit Achsen"},
    {"V.G.NP, a zero offset, in a contour or beside other words",
     "V.G.NP, eine Nullpunktverschiebung, in einer Kontur oder neben anderen Wörtern"},
    {"TRC beside #SUPPRESS OFFSETS", "Werkzeugradiuskorrektur neben #SUPPRESS OFFSETS"},
    {"with more values than it takes", "mit mehr Werten, als es hat"},
    {"within a sub", "in einem sub"},
    {"without $IF", "ohne $IF"},
    {"without $SWITCH", "ohne $SWITCH"},
    {"without )", "ohne )"},
    {"without =", "ohne ="},
    {"without DO", "ohne DO"},
    {"without END", "ohne END"},
    {"without ENDFOR", "ohne ENDFOR"},
    {"without ENDIF", "ohne ENDIF"},
    {"without ENDLOOP", "ohne ENDLOOP"},
    {"without ENDWHILE", "ohne ENDWHILE"},
    {"without FOR", "ohne FOR"},
    {"without GOTO or THEN", "ohne GOTO oder THEN"},
    {"without LOOP", "ohne LOOP"},
    {"without OF", "ohne OF"},
    {"without P", "ohne P"},
    {"without REPEAT", "ohne REPEAT"},
    {"without TO", "ohne TO"},
    {"without UNTIL", "ohne UNTIL"},
    {"without WHILE", "ohne WHILE"},
    {"without [ ]", "ohne [ ]"},
    {"without a name", "ohne Namen"},
    {"without a time", "ohne Zeit"},
    {"without an assignment", "ohne eine Zuweisung"},
    {"$FOR whose end hangs on the last digits", "$FOR, dessen Ende an den letzten Stellen hängt"},
    {"a computed value between #VAR and #ENDVAR", "ein berechneter Wert zwischen #VAR und #ENDVAR"},
    {"more than 0 and below 360", "mehr als 0 und weniger als 360"},
    {"so many variables", "so viele Variablen"},
    {"two decimal signs", "zwei Dezimalzeichen"},
    {"which is declared whole", "die als ganze Zahl vereinbart ist"},
    {"which is not the program's", "die nicht dem Programm gehört"},
    {"which its own line sets", "die dieselbe Zeile setzt"},
    {"whose order needs brackets", "dessen Reihenfolge Klammern braucht"},
    {"words after $ELSEIF", "Wörter hinter $ELSEIF"},
    {"$FOR wants a beginning, an end and a step",
     "$FOR braucht einen Anfang, ein Ende und eine Schrittweite"},
    {"without a loop", "ohne Schleife"},
    {"without endif", "ohne endif"},
    {"without endrepeat", "ohne endrepeat"},
    {"without endsub", "ohne endsub"},
    {"without endwhile", "ohne endwhile"},
    {"without repeat", "ohne repeat"},
    {"without while", "ohne while"},
    {"without its beginning", "ohne seinen Anfang"},
    {"without label", "ohne Marke"},
    {"work coordinate system", "Werkstück-Koordinatensystem"},
});

constexpr std::string_view while_active = " while TRC is active";
constexpr std::string_view while_active_german = " bei aktiver Werkzeugradiuskorrektur";

// "TRANS, …, as in sinumerik": a word of another dialect.
constexpr std::string_view as_in = reason::as_in_dialect;
constexpr std::string_view as_in_german = ", wie bei ";

const Phrase* phrase_of(std::string_view english) {
  const auto* const found = std::ranges::find(phrases, english, &Phrase::english);
  return found == phrases.end() ? nullptr : found;
}

// Translates the phrase that the detail is or ends with.
std::string with_german_meaning(std::string_view detail) {
  if (const Phrase* whole = phrase_of(detail)) return std::string(whole->german);
  // "G68, rotation": the word and its meaning. Words of the program may contain commas too.
  for (std::size_t at = detail.find(", "); at != std::string_view::npos;
       at = detail.find(", ", at + 2))
    if (const Phrase* meaning = phrase_of(detail.substr(at + 2));
        meaning != nullptr && !goes_on_in_fragment(detail, at + 2))
      return std::string(detail.substr(0, at + 2)).append(meaning->german);
  for (std::size_t at = detail.find(' '); at != std::string_view::npos;
       at = detail.find(' ', at + 1))
    if (const Phrase* state = phrase_of(detail.substr(at + 1));
        state != nullptr && !goes_on_in_fragment(detail, at + 1))
      return std::string(detail.substr(0, at + 1)).append(state->german);
  return std::string(detail);
}

// Translates the endings after the phrase too: two at most, as words of the program may repeat
// them.
std::string with_german_phrase(std::string_view detail) {
  std::string behind;
  for (int ends = 0; ends < 2; ++ends) {
    if (detail.ends_with(while_active)) {
      detail.remove_suffix(while_active.size());
      behind.insert(0, while_active_german);
      const std::string_view before = detail.substr(0, detail.find_last_not_of(',') + 1);
      behind.insert(0, detail.substr(before.size()));
      detail = before;
    } else if (const std::size_t at = detail.rfind(as_in);
               at != std::string_view::npos && phrase_of(detail) == nullptr) {
      behind.insert(0, detail.substr(at + as_in.size()));
      behind.insert(0, as_in_german);
      detail = detail.substr(0, at);
    }
  }
  return with_german_meaning(detail).append(behind);
}

}  // namespace

std::string german_detail(std::string_view detail) {
  return with_german_fragments(with_german_phrase(detail));
}

}  // namespace trc

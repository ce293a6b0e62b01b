#include "core/base/german_fragments.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace trc {
namespace {

struct Fragment {
  std::string_view english;
  std::string_view german;
};

// What stands between words of the program.
constexpr auto fragments = std::to_array<Fragment>({
    {"G141 finds no way past this block; #TRC [REMOVE_MASKED_BLOCKS=1] leaves out whole loops",
     "G141 findet an diesem Satz nicht vorbei; #TRC [REMOVE_MASKED_BLOCKS=1] lässt ganze Schleifen "
     "weg"},
    {"G40 … G42 between a smooth approach and its contour",
     "G40 … G42 zwischen weichem Anfahren und seiner Kontur"},
    {"D of G41, G42 is the number of a tool: G41.1, G42.1 take a diameter",
     "D von G41, G42 ist die Nummer eines Werkzeugs: einen Durchmesser nehmen G41.1, G42.1"},
    {"RL, RR in the contour of the cycles of line", "RL, RR in der Kontur der Zyklen von Zeile"},
    {"SPLIT needs a main axis (or SPLIT_PATH) and a positive DIST_SEG and FEED_SEG for each "
     "segment",
     "SPLIT braucht eine Hauptachse (oder SPLIT_PATH) und für jeden Abschnitt DIST_SEG und "
     "FEED_SEG größer 0"},
    {"TRC behind what may be skipped, in line",
     "Korrektur hinter dem, was ausgeblendet sein kann, in Zeile"},
    {"TRC in a block that may be skipped",
     "Werkzeugradiuskorrektur in einem Satz, der ausgeblendet sein kann"},
    {"TRC in space (CUT3D…)", "Werkzeugradiuskorrektur im Raum (CUT3D…)"},
    {"CALL LBL with a parameter", "CALL LBL mit einem Parameter"},
    {"TRC under", "Werkzeugradiuskorrektur unter"},
    {"polar coordinate interpolation, or a work offset of Haas",
     "Polarkoordinaten-Interpolation, oder einem Nullpunkt von Haas"},
    {"the end of the program in a label", "das Programmende in einem Label"},
    {"TRC under a modal cycle of the machine",
     "Werkzeugradiuskorrektur unter einem modalen Zyklus der Maschine"},
    {"TRC of DIN/ISO", "Werkzeugradiuskorrektur von DIN/ISO"},
    {"TRC while coordinates are not followed (polar, scaled or tilted)",
     "Werkzeugradiuskorrektur, während Koordinaten nicht verfolgt werden (polar, skaliert oder "
     "geschwenkt)"},
    {"a byte order mark, which cannot be seen", "eine Bytereihenfolge-Marke, die man nicht sieht"},
    {"G40 without a motion behind it", "G40 ohne eine Bewegung dahinter"},
    {"I, J beside G40, a vector of the wall behind it",
     "I, J neben G40, ein Vektor der Wand dahinter"},
    {"I, J beside G41, G42, a vector of the contour behind it",
     "I, J neben G41, G42, ein Vektor der Kontur dahinter"},
    {"R in a straight motion", "R in einer geraden Bewegung"},
    {"R0 without a motion behind it", "R0 ohne eine Bewegung dahinter"},
    {"a block of DIN/ISO of Heidenhain", "ein Satz in DIN/ISO von Heidenhain"},
    {"a full circle to the contour", "ein Vollkreis zur Kontur"},
    {"a function of DIN/ISO", "eine Funktion von DIN/ISO"},
    {"as G91 holds since line", "da G91 gilt seit Zeile"},
    {"counted from there", "von dort gezählt"},
    {"without T, which tool it is of", "ohne T, von welchem Werkzeug"},
    {"a call", "ein Aufruf"},
    {"a call of what only the machine has while TRC is active",
     "der Aufruf von etwas, das nur die Maschine hat, bei aktiver Werkzeugradiuskorrektur"},
    {"a chamfer beside an arc", "eine Fase neben einem Bogen"},
    {"a circle word in a straight motion", "ein Kreiswort in einer Geraden"},
    {"a compensation along one axis", "eine Korrektur längs einer Achse"},
    {"a computed spindle", "eine berechnete Spindel"},
    {"a contour of X and Z in the plane X Y", "eine Kontur aus X und Z in der Ebene X Y"},
    {"a cycle call", "ein Zyklusaufruf"},
    {"a cycle or motion of its own", "ein Zyklus oder eine eigene Bewegung"},
    {"a cycle with the contour of", "ein Zyklus mit der Kontur von"},
    {"a dash that is no minus sign", "ein Strich, der kein Minuszeichen ist"},
    {"a direction mark, which cannot be seen",
     "ein Zeichen für die Schreibrichtung, das man nicht sieht"},
    {"a feed of one block", "ein Vorschub eines einzigen Satzes"},
    {"a frame", "ein Frame"},
    {"a frame that scales", "ein Frame, der skaliert"},
    {"a hyphen that is no minus sign", "ein Bindestrich, der kein Minuszeichen ist"},
    {"a line separator, which cannot be seen", "ein Zeilentrenner, den man nicht sieht"},
    {"a minus sign that is not the one of the keyboard",
     "ein Minuszeichen, das nicht das der Tastatur ist"},
    {"a modal cycle", "ein modaler Zyklus"},
    {"a motion of an axis by itself", "eine Bewegung einer Achse für sich"},
    {"a motion that may be skipped", "eine Bewegung, die ausgeblendet sein kann"},
    {"a motion under G66 of a macro that only the machine has",
     "eine Bewegung unter G66 mit einem Makro, das nur die Maschine hat"},
    {"a motion with L, which is repeated", "eine Bewegung mit L, die wiederholt wird"},
    {"a name", "ein Name"},
    {"a number without a letter: that of a program begins with O",
     "eine Zahl ohne Adressbuchstaben: die eines Programms beginnt mit O"},
    {"a narrow no-break space", "ein schmales geschütztes Leerzeichen"},
    {"a no-break space", "ein geschütztes Leerzeichen"},
    {"a paragraph separator, which cannot be seen", "ein Absatztrenner, den man nicht sieht"},
    {"a plane: Klartext has it with TOOL CALL", "eine Ebene: in Klartext steht sie bei TOOL CALL"},
    {"a position of a drilling cycle", "eine Position eines Bohrzyklus"},
    {"a position that is not followed", "eine Position, die nicht verfolgt wird"},
    {"a radius or a corner that may be skipped",
     "ein Radius oder eine Ecke, die ausgeblendet sein können"},
    {"a radius that is changed has to be there",
     "ein Radius, der geändert wird, muss vorher da sein"},
    {"a reference that it cannot have", "ein Bezug, den es nicht haben kann"},
    {"a retract along the tool", "ein Rückzug in Werkzeugrichtung"},
    {"a rounding or a chamfer beside G40 … G42, or behind a motion that is none",
     "eine Rundung oder Fase neben G40 … G42, oder hinter einer Bewegung, die keine ist"},
    {"a rounding or a chamfer that is not between two motions of one contour, at feed and in the "
     "plane",
     "eine Rundung oder Fase, die nicht zwischen zwei Bewegungen einer Kontur steht, im Vorschub "
     "und in der Ebene"},
    {"a rounding or a chamfer the motions have no room for",
     "eine Rundung oder Fase, für die in den Bewegungen kein Platz ist"},
    {"a search for bottlenecks: CDOF", "eine Suche nach Engstellen: CDOF"},
    {"a second OFFN", "ein zweites OFFN"},
    {"a second rounding or chamfer", "eine zweite Rundung oder Fase"},
    {"a second time", "ein zweites Mal"},
    {"a smooth approach within a contour or behind another",
     "weiches Anfahren innerhalb einer Kontur oder hinter einem anderen"},
    {"a soft hyphen, which cannot be seen", "ein weiches Trennzeichen, das man nicht sieht"},
    {"a space as wide as a digit", "ein Leerzeichen so breit wie eine Ziffer"},
    {"a spline or a polynomial", "ein Spline oder ein Polynom"},
    {"a sum offset of the tool", "eine Summenkorrektur des Werkzeugs"},
    {"a tangential entry: program its line and arc",
     "tangentiales Anfahren: dessen Gerade und Bogen programmieren"},
    {"a tangential exit: program its arc and line",
     "tangentiales Abfahren: dessen Bogen und Gerade programmieren"},
    {"a thin space", "ein schmales Leerzeichen"},
    {"a tool offset in the plane", "eine Werkzeugkorrektur in der Ebene"},
    {"a transformation", "eine Transformation"},
    {"a variable or function", "eine Variable oder Funktion"},
    {"a wide space", "ein breites Leerzeichen"},
    {"a word joiner, which cannot be seen", "ein Wortverbinder, den man nicht sieht"},
    {"a zero width character, which cannot be seen",
     "ein Zeichen ohne Breite, das man nicht sieht"},
    {"a zero width space, which cannot be seen",
     "ein Leerzeichen ohne Breite, das man nicht sieht"},
    {"across the plane", "quer zur Ebene"},
    {"alone behind a contour: write both", "allein hinter einer Kontur: beide schreiben"},
    {"an approach or a departure that has no room: LCT from within its circle, CT, G247 and G347 "
     "with an arc that is smaller than the tool, G147 with DISR= that leaves no line",
     "ein An- oder Abfahren, für das kein Platz ist: LCT aus seinem Kreis heraus, CT, G247 und "
     "G347 mit einem Bogen, der kleiner als das Werkzeug ist, G147 mit DISR=, das keine Gerade "
     "übrig lässt"},
    {"an approach round the corner: NORM", "Anfahren um die Ecke: NORM"},
    {"an arc to the contour that does not run on into its first block",
     "ein Bogen zur Kontur, der nicht in ihren ersten Satz übergeht"},
    {"an arc directly behind G40 under G239, where the tool stands at the compensated point",
     "ein Bogen unmittelbar nach G40 unter G239, wo das Werkzeug auf dem korrigierten Punkt steht"},
    {"an increment from a place that is not known",
     "ein Kettenmaß von einer Stelle aus, die nicht bekannt ist"},
    {"an offset of the tool beside its data", "eine Korrektur des Werkzeugs neben seinen Daten"},
    {"an operator", "ein Operator"},
    {"an unknown name", "ein unbekannter Name"},
    {"another wear than the setup gives that tool",
     "ein anderer Verschleiß, als das Setup diesem Werkzeug gibt"},
    {"before", "vor"},
    {"behind G40: write both into one block", "hinter G40: beide in einen Satz schreiben"},
    {"beside", "neben"},
    {"beside G40", "neben G40"},
    {"beside none of G147, G148, G247, G248, G347, G348",
     "neben keinem von G147, G148, G247, G248, G347, G348"},
    {"beside or behind G93, G95: only feeds per minute are followed",
     "neben oder hinter G93, G95: nur Vorschübe je Minute werden verfolgt"},
    {"beyond the contour: set it behind G41, G42, and to 0 in front of G40",
     "über die Kontur hinaus: hinter G41, G42 setzen, und vor G40 auf 0"},
    {"calls", "aufruft"},
    {"corners of small steps", "Ecken aus kleinen Schritten"},
    {"corners that reach out: DISC=0", "überstehende Ecken: DISC=0"},
    {"data of a tool", "Daten eines Werkzeugs"},
    {"degrees", "Grad"},
    {"feed per turn", "Vorschub je Umdrehung"},
    {"finds no way past this block", "findet an diesem Satz nicht vorbei"},
    {"from a height that is not known", "aus einer Höhe, die nicht bekannt ist"},
    {"from a place that is not known", "von einer Stelle aus, die nicht bekannt ist"},
    {"from the pole itself", "vom Pol selbst aus"},
    {"in a block that may be skipped", "in einem Satz, der ausgeblendet sein kann"},
    {"in a block without an axis of the plane", "in einem Satz ohne eine Achse der Ebene"},
    {"in a section that line", "in einem Abschnitt, den Zeile"},
    {"in a subprogram", "in einem Unterprogramm"},
    {"in an arc, beside a corner or a further axis",
     "in einem Bogen, neben einer Ecke oder einer weiteren Achse"},
    {"in block", "in Satz"},
    {"in coordinates that are scaled or led by the tool tip",
     "in Koordinaten, die skaliert sind oder von der Werkzeugspitze geführt werden"},
    {"in front of a contour", "vor einer Kontur"},
    {"in front of the end of the program", "vor dem Programmende"},
    {"in line", "in Zeile"},
    {"inside a line", "innerhalb einer Zeile"},
    {"is less than 0", "ist kleiner als 0"},
    {"is missing", "fehlt"},
    {"is no tool", "ist kein Werkzeug"},
    {"is not alone with its time", "steht nicht mit seiner Zeit allein"},
    {"known are", "bekannt sind"},
    {"machine coordinates", "Maschinenkoordinaten"},
    {"modes as they were at M70", "die Zustände, wie sie bei M70 waren"},
    {"modes as they were in front of a subprogram",
     "die Zustände, wie sie vor einem Unterprogramm waren"},
    {"more than 0 and at most 360", "mehr als 0 und höchstens 360"},
    {"no feed per minute", "kein Vorschub je Minute"},
    {"not alone in its block", "nicht allein in seinem Satz"},
    {"of", "von"},
    {"of TOOL CALL", "von TOOL CALL"},
    {"of a further axis", "einer weiteren Achse"},
    {"of a lathe", "einer Drehmaschine"},
    {"once, 0 or more", "einmal, 0 oder mehr"},
    {"only", "allein"},
    {"open corners", "offene Ecken"},
    {"or", "oder"},
    {"or behind what moves it", "oder hinter etwas, das ihn verschiebt"},
    {"perhaps", "vielleicht"},
    {"straight back", "geradewegs zurück"},
    {"that is not between the plane of the contour and where the tool comes from or goes to",
     "das nicht zwischen der Ebene der Kontur und der Höhe liegt, aus der das Werkzeug kommt oder "
     "in die es geht"},
    {"the angle of a motion", "der Winkel einer Bewegung"},
    {"the end of a smooth approach", "das Ende eines weichen Anfahrens"},
    {"the table has", "die Tabelle hat"},
    {"the tool has no room at the first point of the contour",
     "am ersten Punkt der Kontur ist für das Werkzeug kein Platz"},
    {"the tool has no room at the last point of the contour",
     "am letzten Punkt der Kontur ist für das Werkzeug kein Platz"},
    {"the tool table has no", "in der Werkzeugtabelle fehlt"},
    {"the tool tip is led", "die Werkzeugspitze wird geführt"},
    {"the turns of an arc", "die Umdrehungen eines Bogens"},
    {"to", "bis"},
    {"unknown since the change", "nicht bekannt seit dem Wechsel"},
    {"wear or a sum of a tool radius", "Verschleiß oder eine Summe als Werkzeugradius"},
    {"which is called", "das aufgerufen wird"},
    {"which is compensated", "die korrigiert wird"},
    {"which is not followed", "was nicht verfolgt wird"},
    {"which may have been set by", "vielleicht gesetzt von"},
    {"which no function of the line takes", "das keine Funktion der Zeile braucht"},
    {"which repeats a compensated contour", "was eine korrigierte Kontur wiederholt"},
    {"which sets a variable that DEF of the main program does not name",
     "was eine Variable setzt, die kein DEF des Hauptprogramms nennt"},
    {"which was not programmed anew behind", "das nicht neu programmiert ist hinter"},
    {"which writes the radius of a tool", "das den Radius eines Werkzeugs schreibt"},
    {"while TRC is active", "bei aktiver Werkzeugradiuskorrektur"},
    {"while coordinates are scaled or the tool tip is led",
     "während Koordinaten skaliert sind oder die Werkzeugspitze geführt wird"},
    {"whose contour stands behind the end: write the lines of the label in its place",
     "deren Kontur hinter dem Ende steht: die Zeilen des Labels an dieser Stelle schreiben"},
    {"whose point between names the two axes of the plane",
     "dessen Zwischenpunkt die beiden Achsen der Ebene nennt"},
    {"whose points lie in one line", "dessen Punkte auf einer Geraden liegen"},
    {"whose tool and edge are no numbers", "dessen Werkzeug und Schneide keine Zahlen sind"},
    {"with", "mit"},
    {"with DISCL= below 0", "mit DISCL= kleiner 0"},
    {"with DISRP=, the plane it returns to: program that height in blocks of its own",
     "mit DISRP=, der Rückzugsebene: diese Höhe in eigenen Sätzen programmieren"},
    {"with F alone", "mit F allein"},
    {"with FAD= that is no feed", "mit FAD=, das kein Vorschub ist"},
    {"with IPA against DR", "mit IPA gegen DR"},
    {"with R below 0", "mit R kleiner 0"},
    {"with X, Y or Z of its plane", "mit X, Y oder Z seiner Ebene"},
    {"with a change of side", "mit einem Seitenwechsel"},
    {"with a coordinate across the plane", "mit einer Koordinate quer zur Ebene"},
    {"with a place in the plane", "mit einer Stelle in der Ebene"},
    {"with a radius in P", "mit einem Radius in P"},
    {"with a radius that the program has changed",
     "mit einem Radius, den das Programm geändert hat"},
    {"with an increment of a turning axis", "mit dem Kettenmaß einer Drehachse"},
    {"with either its end or its centre", "mit seinem Ende oder seinem Mittelpunkt"},
    {"with more than 1000 turns", "mit mehr als 1000 Umdrehungen"},
    {"with the feed at the contour (G11, CFC)", "mit dem Vorschub an der Kontur (G11, CFC)"},
    {"with the tool of the section that line", "mit dem Werkzeug des Abschnitts, den Zeile"},
    {"within a comment", "in einem Kommentar"},
    {"within a contour", "innerhalb einer Kontur"},
    {"without", "ohne"},
    {"without D, the diameter", "ohne D, den Durchmesser"},
    {"without DISR=, its length", "ohne DISR=, seine Länge"},
    {"without DISR=, its radius, above 0", "ohne DISR=, seinen Radius, größer 0"},
    {"without G40: write G40 beside it", "ohne G40: G40 daneben schreiben"},
    {"without a contour before it", "ohne eine Kontur davor"},
    {"without a contour behind it", "ohne eine Kontur dahinter"},
    {"without a motion in the plane before it", "ohne eine Bewegung in der Ebene davor"},
    {"without a tool", "ohne ein Werkzeug"},
    {"without an end in the plane: G140, G141 or G142",
     "ohne ein Ende in der Ebene: G140, G141 oder G142"},
    {"without its size", "ohne seine Größe"},
    {"without the height it retracts to", "ohne die Höhe, auf die es zurückzieht"},
    {"without value", "ohne Wert"},
});

bool begins_word(std::string_view text, std::size_t at) {
  return at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
}

bool ends_word(std::string_view text, std::size_t at) {
  return at == text.size() || std::string_view(" ,:;()").find(text[at]) != std::string_view::npos;
}

// The longest one that stands there.
const Fragment* fragment_at(std::string_view text, std::size_t at) {
  const Fragment* longest = nullptr;
  for (const Fragment& one : fragments)
    if (text.substr(at).starts_with(one.english) && ends_word(text, at + one.english.size()) &&
        (longest == nullptr || longest->english.size() < one.english.size()))
      longest = &one;
  return longest;
}

}  // namespace

std::string with_german_fragments(std::string_view text) {
  std::string german;
  for (std::size_t at = 0; at < text.size();) {
    const Fragment* const found = begins_word(text, at) ? fragment_at(text, at) : nullptr;
    if (found != nullptr)
      german += found->german;
    else
      german += text[at];
    at += found != nullptr ? found->english.size() : 1;
  }
  return german;
}

}  // namespace trc

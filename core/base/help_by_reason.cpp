#include "core/base/help_by_reason.h"

#include <algorithm>
#include <array>

namespace trc {
namespace {

struct ReasonHelp {
  std::string_view reason;  // part of the detail
  std::string_view english;
  std::string_view german;
};

// Of FL, FLT, FC, FCT and FPOL.
constexpr std::string_view write_free_contour =
    "Have the control convert the free contour to blocks of L and C, and give that program.";
constexpr std::string_view write_free_contour_in_german =
    "Die freie Kontur in der Steuerung in Sätze mit L und C umwandeln und dieses Programm geben.";

constexpr std::string_view write_corner =
    "Write the corner as blocks of its own: the lines up to it, the arc or the chamfer, the line "
    "behind it.";
constexpr std::string_view write_corner_in_german =
    "Die Ecke als eigene Sätze schreiben: die Gerade bis dorthin, den Bogen oder die Fase, die "
    "Gerade dahinter.";
constexpr std::string_view write_what_is_missing = "Write what is missing in the block.";
constexpr std::string_view write_what_is_missing_in_german = "Das Fehlende in den Satz schreiben.";

constexpr std::string_view change_lead =
    "Let the lead be wider than the tool, shorter, or at another place. A block that is taken for "
    "a lead and bounds material has to be marked as a wall, or counted: leads in the setup.";
constexpr std::string_view change_lead_in_german =
    "Den An- oder Abfahrweg weiter als das Werkzeug, kürzer oder an anderer Stelle programmieren. "
    "Ein Satz, der dafür gehalten wird und Material begrenzt, ist als Wand zu kennzeichnen oder "
    "abzuzählen: leads im Setup.";

// The first one that fits counts.
constexpr auto helps = std::to_array<ReasonHelp>({
    {"say what whole numbers count in",
     "Write decimal points, or say it: `whole_numbers` UNITS (X10 is 10 mm) or INCREMENTS (X10 is "
     "0.010 mm) in the setup.",
     "Dezimalpunkte schreiben, oder es sagen: `whole_numbers` UNITS (X10 ist 10 mm) oder "
     "INCREMENTS (X10 ist 0.010 mm) im Setup."},
    {"finds no way past this lead", change_lead, change_lead_in_german},
    {"no room where the lead-in begins", change_lead, change_lead_in_german},
    {"no room where the lead-out ends", change_lead, change_lead_in_german},
    {"REMOVE_MASKED_BLOCKS finds no way past this block",
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. If one of the two blocks "
     "bounds no material, say that it is a lead: leads in the setup.",
     "Einen kleineren Fräser nehmen: SurveyRadii (trc radii) sagt, welcher passt. Begrenzt einer "
     "der beiden Sätze kein Material, sagen, dass er zum An- oder Abfahren gehört: leads im "
     "Setup."},
    {" without LEN", write_what_is_missing, write_what_is_missing_in_german},
    {" without R", write_what_is_missing, write_what_is_missing_in_german},
    {" without CCA", write_what_is_missing, write_what_is_missing_in_german},
    {" without its size", write_what_is_missing, write_what_is_missing_in_german},
    {" without a time", write_what_is_missing, write_what_is_missing_in_german},
    {" without D, the diameter", write_what_is_missing, write_what_is_missing_in_german},
    {" without DISR=", write_what_is_missing, write_what_is_missing_in_german},
    {" without DR", "Write DR+ or DR- in the block.", "DR+ oder DR- in den Satz schreiben."},
    {"CIP, whose", "Write a point between with I1= and J1=, off the line to the end point.",
     "Einen Punkt dazwischen mit I1= und J1= schreiben, abseits der Geraden zum Endpunkt."},
    {"AR= with either", "Write AR= with the end point, or with I and J.",
     "AR= mit dem Endpunkt schreiben, oder mit I und J."},
    {" without CC, or behind", "Write CC in front of it, behind what moves it.",
     "Davor CC schreiben, hinter dem, was ihn verschiebt."},
    {"a chamfer beside an arc", write_corner, write_corner_in_german},
    {"corners that reach out", "Program DISC=0 in its place.",
     "An seine Stelle DISC=0 programmieren."},
    {"an approach that goes on smoothly", "Program NORM or KONT in its place.",
     "An seine Stelle NORM oder KONT programmieren."},
    {"an approach or a departure that has no room",
     "Correct its length or its radius, or begin farther off.",
     "Ihre Länge oder ihren Radius berichtigen, oder weiter weg beginnen."},
    {"a compensation along one axis",
     "Write the coordinates with the radius in them; a contour has RL or RR.",
     "Die Koordinaten mit dem Radius darin schreiben; eine Kontur hat RL oder RR."},
    {"TRC in space (CUT3D", "Let the control compensate in space; contours of a plane have CUT2D.",
     "Im Raum die Steuerung korrigieren lassen; Konturen einer Ebene haben CUT2D."},
    {"a jump", "Write the blocks in the order in which they run.",
     "Die Sätze in der Reihenfolge schreiben, in der sie laufen."},
    {"polar coordinates",
     "Write the end points in rectangular coordinates, with both axes of the plane.",
     "Die Endpunkte rechtwinklig schreiben, mit beiden Achsen der Ebene."},
    {"CT straight back", "Write the arc with its centre or its radius.",
     "Den Bogen mit seinem Mittelpunkt oder seinem Radius schreiben."},
    {"without T, which tool it is",
     "Program the T of the tool in front of it, or give the radius of that one tool: tool_radius, "
     "without a table of tools.",
     "Davor das T des Werkzeugs programmieren, oder den Radius dieses einen Werkzeugs angeben: "
     "tool_radius, ohne Werkzeugtabelle."},
    {"a function of DIN/ISO",
     "Write the block in Klartext: L, CC and C. Is this a program of G functions? Declare its "
     "dialect (--dialect, `dialect` in the setup).",
     "Den Satz in Klartext schreiben: L, CC und C. Ist es ein Programm aus G-Funktionen? Seinen "
     "Dialekt angeben (--dialect, `dialect` im Setup)."},
    {"TRC of DIN/ISO",
     "Is this a program of G functions? Declare its dialect (--dialect, `dialect` in the setup).",
     "Ist es ein Programm aus G-Funktionen? Seinen Dialekt angeben (--dialect, `dialect` im "
     "Setup)."},
    {"a call of what only the machine has",
     "End the contour in front of the call with G40, and begin "
     "it anew with G41 or G42 behind it.",
     "Die Kontur vor dem Aufruf mit G40 beenden und dahinter mit G41 oder G42 neu beginnen."},
    {"not programmed anew behind",
     "Write G90 (or G91) and G00 or G01 into a block behind the call, in front of the contour: the "
     "call may have left others in force. In ISG and SINUMERIK a name that changes nothing may be "
     "declared in pass_words.",
     "G90 (oder G91) und G00 oder G01 in einen Satz hinter dem Aufruf schreiben, vor der Kontur: "
     "nach dem Aufruf können andere gelten. In ISG und SINUMERIK kann ein Name, der nichts ändert, "
     "in pass_words angegeben werden."},
    {"as G91 holds since",
     "Program G90 in front of it, if its coordinates are absolute; else all axes of the plane "
     "absolutely (G90) behind the change.",
     "Davor G90 programmieren, wenn seine Koordinaten absolut sind; sonst hinter dem Wechsel alle "
     "Achsen der Ebene absolut (G90)."},
    {"another wear than the setup gives",
     "Give the tool that wear in the table of the setup, or take the line out.",
     "Dem Werkzeug diesen Verschleiß in der Tabelle des Setups geben, oder die Zeile streichen."},
    {"TOOL CALL in a section", "Write the TOOL CALL in front of the contour itself.",
     "Den TOOL CALL vor der Kontur selbst schreiben."},
    {"with the tool of the section", "Write the TOOL CALL in front of the contour itself.",
     "Den TOOL CALL vor der Kontur selbst schreiben."},
    {"CT while TRC is active", "Write the arc with its centre or its radius.",
     "Den Bogen mit seinem Mittelpunkt oder seinem Radius schreiben."},
    {"CT, TURN=", "Write the motion with both axes of the plane, an arc with its centre or radius.",
     "Die Bewegung mit beiden Achsen der Ebene schreiben, einen Bogen mit Mittelpunkt oder "
     "Radius."},
    {"a position of a drilling cycle",
     "End the cycle in front of the contour: with G80, in SINUMERIK with MCALL alone.",
     "Den Zyklus vor der Kontur beenden: mit G80, in SINUMERIK mit MCALL allein."},
    {"the end of the program in a label", "Write M30 or M2 in front of the labels that are called.",
     "M30 oder M2 vor die Labels schreiben, die aufgerufen werden."},
    {"a block of DIN/ISO of Heidenhain",
     "Convert it to Klartext, on the control or at its programming station, and give that program.",
     "Es in der Steuerung oder am Programmierplatz in Klartext umwandeln und dieses Programm "
     "geben."},
    {"TRC under a modal cycle", "End the cycle in front of the contour: #DISABLE MODAL CYCLE.",
     "Den Zyklus vor der Kontur beenden: #DISABLE MODAL CYCLE."},
    {"a work offset of Haas",
     "Program G113 in front of the contour; for the work offset of Haas write G154 P3.",
     "G113 vor der Kontur programmieren; für den Nullpunkt von Haas G154 P3 schreiben."},
    {"does not run on into its first block",
     "Let the arc end in the direction of the block behind it, or lead to the contour on a "
     "straight "
     "line.",
     "Den Bogen in der Richtung des Satzes hinter ihm enden lassen, oder auf einer Geraden an die "
     "Kontur fahren."},
    {"a full circle to the contour",
     "Lead to the contour on a line or a shorter arc, and go round behind it.",
     "Auf einer Geraden oder einem kürzeren Bogen an die Kontur fahren und dahinter herumfahren."},
    {"a vector of the wall behind it",
     "Take I, J and K out: the path then leaves in a straight line. Check that way.",
     "I, J und K streichen: der Weg verlässt die Kontur dann auf einer Geraden. Diesen Weg "
     "prüfen."},
    {"a vector of the contour behind it", "Take I, J and K out: the contour itself says it.",
     "I, J und K streichen: die Kontur selbst sagt es."},
    {"R in a straight motion",
     "To round the corner write ,R with a comma in front of it; an arc has G02 or G03.",
     "Für eine Rundung der Ecke ,R mit einem Komma davor schreiben; ein Bogen hat G02 oder G03."},
    {"without a motion behind it", "Program a motion in the plane behind it, before the end.",
     "Dahinter eine Bewegung in der Ebene programmieren, vor dem Ende."},
    {"a motion under G66", "End the macro with G67 in front of the contour.",
     "Das Makro vor der Kontur mit G67 beenden."},
    {"a position that is not followed",
     "End in front of the contour what gives coordinates another meaning.",
     "Vor der Kontur beenden, was Koordinaten eine andere Bedeutung gibt."},
    {"a motion with L, which is repeated", "Write the motion as often as it runs.",
     "Die Bewegung so oft schreiben, wie sie läuft."},
    {"a rounding or a chamfer", write_corner, write_corner_in_german},
    {"the angle of a motion", "Write the end point of the line with both axes.",
     "Den Endpunkt der Geraden mit beiden Achsen schreiben."},
    {"a variable, while TRC is active", "Write its value in its place.",
     "Ihren Wert an ihre Stelle schreiben."},
    {"corners of small steps", "Take M97 out: steps smaller than the radius are told by number.",
     "M97 streichen: Stufen, die kleiner sind als der Radius, werden mit ihrer Nummer gemeldet."},
    {"open corners", "Take M98 out, and lead the contour past the open corner by the radius.",
     "M98 streichen und die Kontur um den Radius über die offene Ecke hinausführen."},
    {"FL while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FLT while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FC while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FCT while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FPOL while TRC is active", write_free_contour, write_free_contour_in_german},
    {"while TRC is active",
     "It has no place within a contour: end the contour in front of it with "
     "G40, and begin it anew with G41 or G42 behind it.",
     "In einer Kontur hat es keinen Platz: die Kontur davor mit G40 beenden und dahinter mit G41 "
     "oder G42 neu beginnen."},
    {"that may be skipped",
     "Take the `/` out, or say by block_skip of the setup whether such lines are executed.",
     "Den `/` streichen, oder mit block_skip im Setup sagen, ob solche Sätze ausgeführt werden."},
    {"a subprogram behind the program",
     "Put it in front of the program, whose first line is % with its name.",
     "Es vor das Programm stellen, dessen erste Zeile % mit seinem Namen ist."},
    {"a call behind words", "Write the call in a line of its own, behind the words.",
     "Den Aufruf in eine eigene Zeile hinter den Wörtern schreiben."},
    {"the name of a call in a variable", "Write the name of the subprogram in its place.",
     "Den Namen des Unterprogramms an ihre Stelle schreiben."},
    {"the call of either of two subprograms",
     "Write a blank behind L or LL, in front of the name that is meant.",
     "Hinter L oder LL ein Leerzeichen schreiben, vor den Namen, der gemeint ist."},
    {"a second program", "Give each program as a text of its own.",
     "Jedes Programm als eigenen Text übergeben."},
    {"a second block in the line", "Write each block in a line of its own, and comments in ( ).",
     "Jeden Satz in eine eigene Zeile schreiben, Kommentare in ( )."},
    {"behind other words",
     "Write the number in front of its block; a jump or a call by N is not known in "
     "this dialect.",
     "Die Nummer vor ihren Satz schreiben; einen Sprung oder Aufruf mit N kennt dieser Dialekt "
     "nicht."},
    {"a subprogram", "Write the lines of the subprogram in the place of its call.",
     "Die Zeilen des Unterprogramms an die Stelle seines Aufrufs schreiben."},
    {"macro call", "Write the motion of the macro in the place of its call.",
     "Die Bewegungen des Makros an die Stelle seines Aufrufs schreiben."},
    {"modes as they were",
     "Program the functions that held before once more: G90 or G91, G20 or G21, the plane, F.",
     "Die Funktionen von vorher noch einmal programmieren: G90 oder G91, G20 oder G21, die Ebene, "
     "F."},
    {"a variable", "Write its value in its place, or assign it in the program.",
     "Ihren Wert an ihre Stelle schreiben oder sie im Programm setzen."},
    {"an expression or a name", "Write its value in its place. A comment stands in ( ).",
     "Seinen Wert an seine Stelle schreiben. Ein Kommentar steht in ( )."},
    {"an expression", "Write its value in its place.", "Seinen Wert an seine Stelle schreiben."},
    {"a parameter", "Write its value in its place.", "Seinen Wert an seine Stelle schreiben."},
    {"EXTCALL", "Give the text of the program that it calls in `subprograms` (--subprograms).",
     "Den Text des Programms, das es aufruft, in `subprograms` angeben (--subprograms)."},
    {"a statement",
     "What it does has to be written out: the blocks in the order in which they run.",
     "Was sie bewirkt, muss ausgeschrieben sein: die Sätze in der Reihenfolge, in der sie laufen."},
    {"a name",
     "Correct its spelling. Where it does not change the path, declare it in pass_words of the "
     "setup; a subprogram is given in `subprograms`.",
     "Die Schreibweise berichtigen. Wo er den Weg nicht ändert, ihn in pass_words des Setups "
     "angeben; ein Unterprogramm gehört in `subprograms`."},
    {"thread cutting", "A thread is no contour of a mill: take it into a program of its own.",
     "Ein Gewinde ist keine Kontur zum Fräsen: es in ein eigenes Programm auslagern."},
    {"tool offset increase", "Write the coordinates with the offset in them.",
     "Die Koordinaten mit der Korrektur darin schreiben."},
    {"tool offset decrease", "Write the coordinates with the offset in them.",
     "Die Koordinaten mit der Korrektur darin schreiben."},
    {"a reference that it cannot have", "Write the value without AC( ) or IC( ).",
     "Den Wert ohne AC( ) oder IC( ) schreiben."},
    {"LinuxCNC does not have", "Take the word out, or declare the dialect that has it.",
     "Das Wort streichen oder den Dialekt angeben, der es hat."},
});

}  // namespace

std::string_view help_by_reason(std::string_view detail, Language language) {
  const auto* const found = std::ranges::find_if(helps, [&](const ReasonHelp& each) {
    return detail.find(each.reason) != std::string_view::npos;
  });
  if (found == helps.end()) return {};
  return language == Language::german ? found->german : found->english;
}

}  // namespace trc

#include "core/messages/help_by_reason.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/base/reasons.h"

namespace trc {
namespace {

struct ReasonHelp {
  std::string_view reason;  // part of the detail
  std::string_view english;
  std::string_view german;
};

// For FL, FLT, FC, FCT and FPOL.
constexpr std::string_view write_free_contour =
    "Have the control convert the free contour to blocks of L and C, and give that program.";
constexpr std::string_view write_free_contour_in_german =
    "Die freie Kontur in der Steuerung in Sätze mit L und C umwandeln und dieses Programm geben.";

constexpr std::string_view write_corner =
    "Write the corner as blocks of its own: the lines up to it, the arc or the chamfer, the line "
    "after it.";
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
constexpr std::string_view end_scaling =
    "End the scaling before the contour, with a straight motion after it that names both "
    "axes of the plane, and write the contour in full size.";
constexpr std::string_view end_scaling_in_german =
    "Die Skalierung vor der Kontur beenden, dahinter eine Gerade mit beiden Achsen der Ebene "
    "programmieren, und die Kontur in wahrer Größe schreiben.";

// The first match counts.
constexpr auto helps = std::to_array<ReasonHelp>({
    {", a subprogram before ",
     "Put the main program first in the text, and what it calls after it. Of several main "
     "programs give each in a text of its own.",
     "Das Hauptprogramm an den Anfang des Texts stellen, was es aufruft dahinter. Von mehreren "
     "Hauptprogrammen jedes in einem eigenen Text geben."},
    {", an endless loop whose rounds differ",
     "End the program with M30, and write the rounds that are wanted as a loop, with WHILE and "
     "END.",
     "Das Programm mit M30 beenden, und die gewünschten Durchläufe als Schleife schreiben, mit "
     "WHILE und END."},
    {reason::changed_by_program,
     "Write the value in its place. No one value holds for what the program changes, so that it "
     "cannot be given from outside.",
     "An ihre Stelle den Wert schreiben. Für das, was das Programm selbst ändert, gilt nicht "
     "überall ein Wert, so dass er nicht von außen gegeben werden kann."},
    {reason::argument_without_point,
     "Write the argument with a decimal point, X10. for X10: in which increment a whole number "
     "counts hangs on its letter and on the control.",
     "Das Argument mit Dezimalpunkt schreiben, X10. für X10: in welchem Inkrement eine ganze Zahl "
     "zählt, hängt von ihrem Buchstaben und von der Steuerung ab."},
    {reason::beside_m98_with_calls,
     "Where it says how often the subprogram runs write L: M98 P2000 L3. Else take it out.",
     "Wo es sagt, wie oft das Unterprogramm läuft, L schreiben: M98 P2000 L3. Sonst es streichen."},
    {reason::beside_m98,
     "Take the word out: a subprogram is executed from its beginning. Of one that is called from "
     "within, make the lines after that place a program of its own.",
     "Das Wort streichen: ein Unterprogramm läuft von seinem Anfang an. Von einem, das mittendrin "
     "begonnen wird, die Zeilen ab dort zu einem eigenen Programm machen."},
    {reason::beside_g65,
     "Take the word out, or write it into a line of its own: it is no argument.",
     "Das Wort streichen oder in eine eigene Zeile schreiben: es ist kein Argument."},
    {reason::beside_g66,
     "Take the word out, or write it into a line of its own: it is no argument.",
     "Das Wort streichen oder in eine eigene Zeile schreiben: es ist kein Argument."},
    {reason::tool_in_spindle,
     "Name it: its D beside G41 or G42, or its T with M06 before it; and give a table with "
     "each tool of the program.",
     "Es benennen: sein D neben G41 oder G42, oder sein T mit M06 davor; und eine Tabelle mit "
     "jedem Werkzeug des Programms angeben."},
    {"D0 or T0 is no tool",
     "Program the tool before G41 or G42 with its number, which is not 0: its D or T word, "
     "in Klartext TOOL CALL.",
     "Das Werkzeug vor G41 oder G42 mit seiner Nummer programmieren, die nicht 0 ist: sein D- "
     "oder T-Wort, in Klartext TOOL CALL."},
    {reason::closes_in_inside_corner,
     "Do not machine it so. Begin the contour in another place, in the middle of a block.",
     "So nicht fertigen. Die Kontur an einer anderen Stelle beginnen, mitten in einem Satz."},
    {reason::comes_from_other_side,
     "Do not machine it. Check the side, G41 or G42. If it is right, begin the contour in the "
     "middle of a block: in its inside corner no tool has room.",
     "Nicht fertigen. Die Seite prüfen, G41 oder G42. Stimmt sie, die Kontur mitten in einem Satz "
     "beginnen: in ihrer Innenecke hat kein Fräser Platz."},
    {" without M06",
     "Program M06 after the T word, before G41 or G42, or give tool_radius in the setup.",
     "M06 hinter dem T-Wort programmieren, vor G41 oder G42, oder tool_radius im Setup angeben."},
    {"a radius that is changed has to be there",
     "Program the tool or its radius before the change, or give tool_radius in the setup.",
     "Das Werkzeug oder seinen Radius vor der Änderung programmieren, oder tool_radius im Setup "
     "angeben."},
    {reason::variable_of_haas,
     "Where it is a variable of the program, write one of #100 to #199 or #500 to #999 in its "
     "place: #100 for #10100. The radius of a tool is given by G10 L12 P R.",
     "Wo sie eine Variable des Programms ist, an ihre Stelle eine von #100 bis #199 oder #500 bis "
     "#999 schreiben: #100 für #10100. Den Radius eines Werkzeugs gibt G10 L12 P R."},
    {reason::words_after_statement,
     "Write what follows into a line of its own: a control statement stands alone in its line.",
     "Was folgt, in eine eigene Zeile schreiben: eine Steueranweisung steht allein in ihrer "
     "Zeile."},
    {"which fits where they are absolute",
     "Where I, J and K are meant absolutely, say so: circle_center_mode.reference ABSOLUTE in "
     "the setup, or in the program G90.1 of LinuxCNC, G161 of ISG. Else correct them or the end "
     "point.",
     "Sind I, J und K absolut gemeint, dies sagen: circle_center_mode.reference ABSOLUTE im "
     "Setup, oder im Programm G90.1 bei LinuxCNC, G161 bei ISG. Sonst sie oder den Endpunkt "
     "berichtigen."},
    {"which fits where they count from the start",
     "Where I, J and K are meant from the start of the arc, say so: circle_center_mode.reference "
     "START in the setup, or in the program G91.1 of LinuxCNC, G162 of ISG. Else correct them or "
     "the end "
     "point.",
     "Sind I, J und K vom Anfang des Bogens aus gemeint, dies sagen: circle_center_mode.reference "
     "START im Setup, oder im Programm G91.1 bei LinuxCNC, G162 bei ISG. Sonst sie oder den "
     "Endpunkt "
     "berichtigen."},
    {"is the number of a register",
     "Write the number of the register that holds the radius, as D1, or give tool_radius in the "
     "setup and take the word out.",
     "Die Nummer des Registers schreiben, das den Radius hat, wie D1, oder tool_radius im Setup "
     "angeben und das Wort streichen."},
    {"is the number of a tool",
     "Write the number of the tool, or G41.1 or G42.1 where D is the diameter.",
     "Die Nummer des Werkzeugs schreiben, oder G41.1 oder G42.1, wo D der Durchmesser ist."},
    {"an arc directly after G40", "Program a straight motion between G40 and the arc.",
     "Zwischen G40 und dem Bogen eine Gerade programmieren."},
    {"TRC under scaling", end_scaling, end_scaling_in_german},
    {"TRC under a frame that scales", end_scaling, end_scaling_in_german},
    {"in coordinates that are scaled or led by the tool tip",
     "End that before the contour: the cycle of the scale with 1, M128 with M129. After it "
     "move in a straight line with both axes of the plane.",
     "Das vor der Kontur beenden: den Zyklus des Maßfaktors mit 1, M128 mit M129. Dahinter eine "
     "Gerade mit beiden Achsen der Ebene fahren."},
    {"G347 within a contour", "End the contour before it with G40 or DEP: an approach begins one.",
     "Die Kontur davor mit G40 oder DEP beenden: ein Anfahren beginnt eine."},
    {"a smooth approach within a contour",
     "End the contour before it with G40: a smooth approach begins one.",
     "Die Kontur davor mit G40 beenden: ein weiches Anfahren beginnt eine."},
    {"without a contour after it", "Program the contour after it, before G40.",
     "Dahinter die Kontur programmieren, vor G40."},
    {"without a contour before it", "Program the contour before it.",
     "Davor die Kontur programmieren."},
    {"a cycle with the contour of",
     "The cycle compensates it itself: leave G41 and G42 out in the label, or write the contour "
     "into a label of its own after the end of the program.",
     "Der Zyklus korrigiert sie selbst: G41 und G42 im Label weglassen, oder die Kontur in ein "
     "eigenes Label hinter dem Programmende schreiben."},
    {"in the contour of the cycles of line",
     "Put the label after the end of the program (M30 or M2), as the cycles expect it.",
     "Das Label hinter das Programmende (M30 oder M2) stellen, wie die Zyklen es erwarten."},
    {" without L, with RL or RR", "Write L before the coordinates: L X+0 Y+0 RL.",
     "L vor die Koordinaten schreiben: L X+0 Y+0 RL."},
    {"FL with RL or RR", write_free_contour, write_free_contour_in_german},
    {"FLT with RL or RR", write_free_contour, write_free_contour_in_german},
    {"FC with RL or RR", write_free_contour, write_free_contour_in_german},
    {"FCT with RL or RR", write_free_contour, write_free_contour_in_german},
    {"FPOL with RL or RR", write_free_contour, write_free_contour_in_german},
    {"LN with RL or RR", "Let the control compensate in space; a contour in the plane has L.",
     "Im Raum die Steuerung korrigieren lassen; eine Kontur in der Ebene hat L."},
    {"SPL with RL or RR", "Have the CAM system write lines and arcs in place of the spline.",
     "Das CAM-System Geraden und Bögen statt des Splines schreiben lassen."},
    {"a spline or a polynomial", "Have the CAM system write lines and arcs in place of the spline.",
     "Das CAM-System Geraden und Bögen statt des Splines schreiben lassen."},
    {"which no function of the line takes",
     "Take the word out, or write the function that takes it into the line.",
     "Das Wort streichen, oder die Funktion, die es braucht, in die Zeile schreiben."},
    {"the orientation of a turning tool",
     "Write L0 for a mill, or no L; turning is not compensated here.",
     "Für einen Fräser L0 schreiben oder kein L; Drehen wird hier nicht korrigiert."},
    {"a motion of an axis by itself", "Write it as a motion of the path: G00 or G01 with the axis.",
     "Es als Bewegung der Bahn schreiben: G00 oder G01 mit der Achse."},
    {"the time of a block, in force since",
     "Write G94 and a feed per minute before the contour, and G93 anew after it: the blocks "
     "of "
     "the path have other lengths.",
     "Vor der Kontur G94 und einen Vorschub je Minute schreiben, dahinter G93 neu: die Sätze der "
     "Bahn sind anders lang."},
    {"with the feed at the contour (G11, CFC)",
     "Write before the contour G10 of ISG, CFTCP of SINUMERIK: the feed at the tool centre; "
     "or a feed per minute, G94.",
     "Vor der Kontur G10 bei ISG, CFTCP bei SINUMERIK schreiben: der Vorschub an der "
     "Werkzeugmitte; oder einen Vorschub je Minute, G94."},
    {"no feed per minute", "Write the feed as a number per minute, before the contour begins.",
     "Den Vorschub als Zahl je Minute schreiben, bevor die Kontur beginnt."},
    {"MCALL of a subprogram", "Write the call after each of the motions, in place of MCALL.",
     "Statt MCALL den Aufruf hinter jede der Bewegungen schreiben."},
    {"a contour of a cycle", "Write the contour of the cycle with numbers alone, after M30.",
     "Die Kontur des Zyklus nur mit Zahlen schreiben, hinter M30."},
    {"SAVE of PROC", "Take SAVE out, and program after the call the functions that held before it.",
     "SAVE streichen und hinter dem Aufruf die Funktionen programmieren, die davor galten."},
    {"without an end in the plane: G140",
     "Write one of the functions that it names, or an end with both axes of the plane.",
     "Eine der genannten Funktionen schreiben, oder einen Endpunkt mit beiden Achsen der Ebene."},
    {"only feeds per minute are followed", "Write G94 and a feed per minute before it.",
     "Davor G94 und einen Vorschub je Minute schreiben."},
    {"a synchronized action",
     "Take it out where it does not move the axes of the plane: what runs beside the program is "
     "not followed.",
     "Sie streichen, wo sie die Achsen der Ebene nicht bewegt: was neben dem Programm läuft, wird "
     "nicht verfolgt."},
    {"not in the program",
     "Take it out where it does not move the axes of the plane: what runs beside the program is "
     "not followed.",
     "Es streichen, wo es die Achsen der Ebene nicht bewegt: was neben dem Programm läuft, wird "
     "nicht verfolgt."},
    {"RNDM= beyond the contour",
     "Write RNDM= into a block after the one with G41 or G42, and RNDM=0 into the last block of "
     "the contour: it ends the corner that this block leads to.",
     "RNDM= in einen Satz hinter dem mit G41 oder G42 schreiben, und RNDM=0 in den letzten Satz "
     "der Kontur: es beendet die Ecke, zu der dieser Satz führt."},
    {"an offset of the tool beside its data",
     "Take it out, and give the tool the radius with the offset in it.",
     "Es streichen, und dem Werkzeug den Radius mit der Korrektur darin geben."},
    {"write both into one block", "Write both into one block.", "Beide in einen Satz schreiben."},
    {"write G40 beside it", "Write G40 beside it, in the same block.",
     "G40 daneben schreiben, in denselben Satz."},
    {"that is not between the plane of the contour",
     "Write DISCL= smaller than the height from which the tool comes down.",
     "DISCL= kleiner schreiben als die Höhe, aus der das Werkzeug kommt."},
    {"the end of a smooth approach",
     "Write a straight motion in the plane after the approach, in a block without a corner and "
     "without a further axis.",
     "Hinter dem Anfahren eine Gerade in der Ebene schreiben, in einem Satz ohne Ecke und ohne "
     "weitere Achse."},
    {"the plane it returns to", "Take DISRP= out, and program that height in a block of its own.",
     "DISRP= streichen und diese Höhe in einem eigenen Satz programmieren."},
    {"inch of the ISO mode",
     "Write G70 in its place. If this is a program in ISO mode, declare it: "
     "--dialect fanuc, `dialect` in the setup.",
     "An seine Stelle G70 schreiben. Ist es ein Programm im ISO-Modus, dies angeben: "
     "--dialect fanuc, `dialect` im Setup."},
    {"mm of the ISO mode",
     "Write G71 in its place. If this is a program in ISO mode, declare it: "
     "--dialect fanuc, `dialect` in the setup.",
     "An seine Stelle G71 schreiben. Ist es ein Programm im ISO-Modus, dies angeben: "
     "--dialect fanuc, `dialect` im Setup."},
    {"ISO mode: the program is one of", "Declare it: --dialect fanuc, `dialect` in the setup.",
     "Dies angeben: --dialect fanuc, `dialect` im Setup."},
    {", a zero offset, in a contour",
     "Write it into a line of its own before the contour, or after it.",
     "Es in eine eigene Zeile vor oder hinter der Kontur schreiben."},
    {"#SUPPRESS OFFSETS",
     "Take it out of the contour: a block before or after it may lead to such a place.",
     "Es aus der Kontur nehmen: ein Satz vor oder hinter ihr kann an eine solche Stelle führen."},
    {reason::percentages_beside_a_motion,
     "Write the function and its axis words into a block of their own.",
     "Die Funktion und ihre Achswörter in einen eigenen Satz schreiben."},
    {reason::after_percent,
     "Where one program goes on there, take the line with the % out: after the first block a % "
     "ends the program. What stands after it as another program, give in a text of its own.",
     "Geht dort ein und dasselbe Programm weiter, die Zeile mit dem % streichen: nach dem ersten "
     "Satz beendet ein % das Programm. Was als weiteres Programm dahinter steht, in einem eigenen "
     "Text geben."},
    {reason::with_axis_words,
     "Write the axes into a block of their own where the function does not take them; what moves "
     "axes cannot be passed on.",
     "Die Achsen in einen eigenen Satz schreiben, wo die Funktion sie nicht braucht; was Achsen "
     "bewegt, lässt sich nicht weiterreichen."},
    {"a computed spindle", "Write the speed as a number.", "Die Drehzahl als Zahl schreiben."},
    {"a circle word without its arc",
     "TURN= belongs to an arc with its centre, I1= J1= K1= to CIP: take it out, or complete the "
     "arc.",
     "TURN= gehört zu einem Bogen mit Mittelpunkt, I1= J1= K1= zu CIP: es streichen oder den Bogen "
     "vervollständigen."},
    {"a circle word in a straight motion",
     "An arc has G02 or G03. A rounding of the corner has a word of its own: ,R of FANUC, RND= "
     "of SINUMERIK.",
     "Ein Bogen hat G02 oder G03. Eine Rundung der Ecke hat ein eigenes Wort: ,R bei FANUC, RND= "
     "bei SINUMERIK."},
    {"a tangential entry: program",
     "Write the entry as blocks of its own: a line with G41 or G42, and an arc that touches the "
     "contour.",
     "Das Anfahren als eigene Sätze schreiben: eine Gerade mit G41 oder G42, und einen Bogen, "
     "der die Kontur berührt."},
    {"a tangential exit: program",
     "Write the exit as blocks of its own: an arc that touches the contour, and a line with G40.",
     "Das Abfahren als eigene Sätze schreiben: einen Bogen, der die Kontur berührt, und eine "
     "Gerade mit G40."},
    {"say what whole numbers count in",
     "Write decimal points, or say it: `whole_numbers` UNITS (X10 is 10 mm) or INCREMENTS (X10 is "
     "0.010 mm) in the setup.",
     "Dezimalpunkte schreiben, oder es sagen: `whole_numbers` UNITS (X10 ist 10 mm) oder "
     "INCREMENTS (X10 ist 0.010 mm) im Setup."},
    {reason::no_way_past_lead, change_lead, change_lead_in_german},
    {reason::no_room_at_lead_in, change_lead, change_lead_in_german},
    {reason::no_room_at_lead_out, change_lead, change_lead_in_german},
    {reason::no_way_past_block,
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. If one of the two blocks "
     "bounds no material, say that it is a lead: leads in the setup.",
     "Einen kleineren Fräser nehmen: SurveyRadii (trc radii) sagt, welcher passt. Begrenzt einer "
     "der beiden Sätze kein Material, sagen, dass er zum An- oder Abfahren gehört: leads im "
     "Setup."},
    {" without LEN", write_what_is_missing, write_what_is_missing_in_german},
    {"without R0 in between", "Write a motion with R0 before the block.",
     "Vor den Satz eine Bewegung mit R0 schreiben."},
    {" without R", write_what_is_missing, write_what_is_missing_in_german},
    {" without CCA", write_what_is_missing, write_what_is_missing_in_german},
    {" without its size", write_what_is_missing, write_what_is_missing_in_german},
    {" without a time", write_what_is_missing, write_what_is_missing_in_german},
    {" without D, the diameter", write_what_is_missing, write_what_is_missing_in_german},
    {" without D after",
     "Write the D of the cycle beside it, D0 where its path is that of the tool centre.",
     "Das D des Zyklus daneben schreiben, D0, wo seine Bahn die des Mittelpunkts ist."},
    {" without DISR=", write_what_is_missing, write_what_is_missing_in_german},
    {" without DR", "Write DR+ or DR- in the block.", "DR+ oder DR- in den Satz schreiben."},
    {"CIP, whose", "Write a point between with I1= and J1=, off the line to the end point.",
     "Einen Punkt dazwischen mit I1= und J1= schreiben, abseits der Geraden zum Endpunkt."},
    {"AR= with either", "Write AR= with the end point, or with I and J.",
     "AR= mit dem Endpunkt schreiben, oder mit I und J."},
    {" without CC of both axes",
     "Write CC with both axes before it: one of them alone counts from the CC before.",
     "Davor CC mit beiden Achsen schreiben: eine allein zählt vom CC davor."},
    {", whose pole is unknown since",
     "Write CC with both axes after the change: one of them alone counts from the CC before.",
     "CC mit beiden Achsen hinter dem Wechsel schreiben: eine allein zählt vom CC davor."},
    {"a chamfer beside an arc", write_corner, write_corner_in_german},
    {"corners that reach out", "Program DISC=0 in its place.",
     "An seine Stelle DISC=0 programmieren."},
    {"an approach that goes on smoothly", "Program NORM or KONT in its place.",
     "An seine Stelle NORM oder KONT programmieren."},
    {"a lead by LCT whose line",
     "Let the lead come from a place, and lead to one, on the side of the contour where the tool "
     "runs.",
     "Den Punkt vor APPR und den von DEP auf die Seite der Kontur legen, auf der das Werkzeug "
     "läuft."},
    {"where the feed before is not known",
     "Write the feed of the contour in a motion before the corner.",
     "Den Vorschub der Kontur in eine Bewegung vor der Ecke schreiben."},
    {"CT directly after RND or CHF", "Write the arc with its centre or its radius.",
     "Den Bogen mit Mittelpunkt oder Radius schreiben."},
    {"an approach or a departure that has no room",
     "Correct its length or its radius, or begin farther off.",
     "Ihre Länge oder ihren Radius berichtigen, oder weiter weg beginnen."},
    {"a compensation along one axis",
     "Write the coordinates with the radius in them; a contour has RL or RR.",
     "Die Koordinaten mit dem Radius darin schreiben; eine Kontur hat RL oder RR."},
    {"TRC in space (CUT3D", "Let the control compensate in space; contours of a plane have CUT2D.",
     "Im Raum die Steuerung korrigieren lassen; Konturen einer Ebene haben CUT2D."},
    {"a jump to a label",
     "Write the blocks in the order in which they run, what repeats as CALL LBL 1 REP 3. A program "
     "without RL and RR needs no compensation.",
     "Die Sätze in der Reihenfolge schreiben, in der sie laufen, was sich wiederholt als CALL LBL "
     "1 REP 3. Ein Programm ohne RL und RR braucht keine Korrektur."},
    {"a jump", "Write the blocks in the order in which they run.",
     "Die Sätze in der Reihenfolge schreiben, in der sie laufen."},
    {"TRC beside axis words that are no positions",
     "Write G41 or G42, with its D, into the block of the motion to the contour.",
     "G41 oder G42, mit seinem D, in den Satz der Bewegung an die Kontur schreiben."},
    {"TRC in a line that calls",
     "Write G41 or G42 into a block after the call, with the motion to the contour.",
     "G41 oder G42 in einen Satz hinter dem Aufruf schreiben, mit der Bewegung an die Kontur."},
    {"TRC under polar coordinates", "Program G15 before the contour.",
     "G15 vor der Kontur programmieren."},
    {"polar coordinates",
     "Write the end points in rectangular coordinates, with both axes of the plane.",
     "Die Endpunkte rechtwinklig schreiben, mit beiden Achsen der Ebene."},
    {"CT straight back", "Write the arc with its centre or its radius.",
     "Den Bogen mit seinem Mittelpunkt oder seinem Radius schreiben."},
    {"without T, which tool it is",
     "Program the T of the tool before it, or give the radius of that one tool: tool_radius, "
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
     "End the contour before the call with G40, and begin "
     "it anew with G41 or G42 after it.",
     "Die Kontur vor dem Aufruf mit G40 beenden und dahinter mit G41 oder G42 neu beginnen."},
    {"not programmed anew after",
     "Write G90 (or G91) and G00 or G01 into a block after the call, before the contour: the "
     "call may have left others in force. In ISG and SINUMERIK a name that changes nothing, though "
     "not an L with a number, may be declared in pass_words.",
     "G90 (oder G91) und G00 oder G01 in einen Satz hinter dem Aufruf schreiben, vor der Kontur: "
     "nach dem Aufruf können andere gelten. In ISG und SINUMERIK kann ein Name, der nichts ändert, "
     "aber kein L mit einer Zahl, in pass_words angegeben werden."},
    {"because no Y precedes it",
     "A mill: program where its Y axis stands before G41, G42. A lathe: let it compensate the "
     "nose of its tool.",
     "Eine Fräsmaschine: vor G41, G42 programmieren, wo die Y-Achse steht. Eine Drehmaschine: sie "
     "die Schneide selbst korrigieren lassen."},
    {"as G91 holds since",
     "Program G90 before it, if its coordinates are absolute; else the axis that is named "
     "absolutely (G90) after the change.",
     "Davor G90 programmieren, wenn seine Koordinaten absolut sind; sonst hinter dem Wechsel die "
     "genannte Achse absolut (G90)."},
    {", unknown since the variable",
     "Give the value of the variable: --variable NAME=VALUE; or program the axis that is named "
     "absolutely after it, before G91, circles or G41.",
     "Den Wert der Variablen angeben: --variable NAME=VALUE; oder die genannte Achse dahinter "
     "absolut programmieren, vor G91, Kreisen oder G41."},
    {", read in mm",
     "Say what lengths count in before the program does, --unit inch or --unit mm, or write the "
     "unit before all lengths.",
     "Angeben, worin Längen zählen, bevor das Programm es sagt: --unit inch oder --unit mm; oder "
     "die Maßeinheit vor alle Längen schreiben."},
    {", in the unit of the machine, which nobody has said",
     "Say the unit of the machine: --unit inch or --unit mm.",
     "Die Maßeinheit der Maschine angeben: --unit inch oder --unit mm."},
    {", unknown since the change",
     "Program the axis that is named absolutely (G90, G00 or G01) after the change, and so each "
     "other one of the plane, before G91, circles or G41.",
     "Hinter dem Wechsel die genannte Achse absolut programmieren (G90, G00 oder G01), und so jede "
     "andere der Ebene, vor G91, Kreisen oder G41."},
    {"another wear than the setup gives",
     "Give the tool that wear in the table of the setup, or take the line out.",
     "Dem Werkzeug diesen Verschleiß in der Tabelle des Setups geben, oder die Zeile streichen."},
    {"a call of lines that are not followed",
     "Write the lines of the label in the place of its call.",
     "Die Zeilen des Labels an die Stelle seines Aufrufs schreiben."},
    {"with the tool of the section", "Write the TOOL CALL before the contour itself.",
     "Den TOOL CALL vor der Kontur selbst schreiben."},
    {"where the tool stands before the contour",
     "Write the motion to where the approach begins before it, or say where the tool stands: "
     "--set start_position=X,Y,Z.",
     "Davor die Bewegung dorthin schreiben, wo das Anfahren beginnt, oder sagen, wo das Werkzeug "
     "steht: --set start_position=X,Y,Z."},
    {"CIP of a contour, which holds after it",
     "Write CIP, G1, G2 or G3 into the first block after the contour.",
     "CIP, G1, G2 oder G3 in den ersten Satz hinter der Kontur schreiben."},
    {"$TC_DP6 after the call of its tool",
     "Write the D of the edge after it, or $TC_DP6 before the T or D that calls it.",
     "Das D der Schneide dahinter schreiben, oder $TC_DP6 vor das T oder D, das sie aufruft."},
    {"CT of a contour, which holds after it",
     "Write CT, G1, G2 or G3 into the first block after the contour.",
     "CT, G1, G2 oder G3 in den ersten Satz hinter der Kontur schreiben."},
    {"FL while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FLT while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FC while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FCT while TRC is active", write_free_contour, write_free_contour_in_german},
    {"FPOL while TRC is active", write_free_contour, write_free_contour_in_german},
    {"CT while TRC is active", "Write the arc with its centre or its radius.",
     "Den Bogen mit seinem Mittelpunkt oder seinem Radius schreiben."},
    {"a variable without a value",
     "Give the value of the variable: --variable NAME=VALUE; or write the number in its place.",
     "Den Wert der Variablen angeben: --variable NAME=VALUE; oder an ihre Stelle die Zahl "
     "schreiben."},
    {"a centre or a radius of an arc beside AP=, RP=",
     "Leave it out: the centre of such an arc is the pole, its radius RP=.",
     "Sie weglassen: Der Mittelpunkt eines solchen Bogens ist der Pol, sein Radius RP=."},
    {reason::set_by_program,
     "Take the line out. The radius of a tool is set by G10 L12 P… R…, its wear by G10 L13.",
     "Die Zeile streichen. Den Radius eines Werkzeugs setzt G10 L12 P… R…, seinen Verschleiß "
     "G10 L13."},
    {"which is not followed here",
     "Write the motion with both axes of the plane, an arc with its centre or radius.",
     "Die Bewegung mit beiden Achsen der Ebene schreiben, einen Bogen mit Mittelpunkt oder "
     "Radius."},
    {"a position of a drilling cycle",
     "End the cycle before the contour: with G80, in SINUMERIK with MCALL alone.",
     "Den Zyklus vor der Kontur beenden: mit G80, in SINUMERIK mit MCALL allein."},
    {"the end of the program in a label", "Write M30 or M2 before the labels that are called.",
     "M30 oder M2 vor die Labels schreiben, die aufgerufen werden."},
    {"a block of DIN/ISO of Heidenhain",
     "Convert it to Klartext, on the control or at its programming station, and give that program.",
     "Es in der Steuerung oder am Programmierplatz in Klartext umwandeln und dieses Programm "
     "geben."},
    {"a block of Okuma",
     "Programs of Okuma are not read here: have them posted for a control of Fanuc.",
     "Programme von Okuma werden hier nicht gelesen: sie für eine Fanuc-Steuerung ausgeben "
     "lassen."},
    {"TRC under a modal cycle", "End the cycle before the contour: #DISABLE MODAL CYCLE.",
     "Den Zyklus vor der Kontur beenden: #DISABLE MODAL CYCLE."},
    {"TRC under scaling", "End the scaling before the contour: G50, in SINUMERIK SCALE alone.",
     "Die Skalierung vor der Kontur beenden: G50, in SINUMERIK SCALE allein."},
    {"a work offset of Haas",
     "Program G113 before the contour; for the work offset of Haas write G154 P3.",
     "G113 vor der Kontur programmieren; für den Nullpunkt von Haas G154 P3 schreiben."},
    {"does not run on into its first block",
     "Let the arc end in the direction of the block after it, or lead to the contour on a "
     "straight line.",
     "Den Bogen in der Richtung des Satzes hinter ihm enden lassen, oder auf einer Geraden an die "
     "Kontur fahren."},
    {"a full circle to the contour",
     "Lead to the contour on a line or a shorter arc, and go round after it.",
     "Auf einer Geraden oder einem kürzeren Bogen an die Kontur fahren und dahinter herumfahren."},
    {"a vector of the wall after it",
     "Take I, J and K out: the path then leaves in a straight line. Check that way.",
     "I, J und K streichen: der Weg verlässt die Kontur dann auf einer Geraden. Diesen Weg "
     "prüfen."},
    {"a vector of the contour after it", "Take I, J and K out: the contour itself says it.",
     "I, J und K streichen: die Kontur selbst sagt es."},
    {"a parameter and no radius",
     "Write CR= in place of R: CR=40. A parameter gets its value by =, in a line of its own: "
     "R1=40.",
     "Statt R das Wort CR= schreiben: CR=40. Ein Parameter bekommt seinen Wert durch =, in einer "
     "eigenen Zeile: R1=40."},
    {"R in a straight motion",
     "To round the corner write ,R with a comma before it; an arc has G02 or G03.",
     "Für eine Rundung der Ecke ,R mit einem Komma davor schreiben; ein Bogen hat G02 oder G03."},
    {"without a motion after it", "Program a motion in the plane after it, before the end.",
     "Dahinter eine Bewegung in der Ebene programmieren, vor dem Ende."},
    {"a motion under G66", "End the macro with G67 before the contour.",
     "Das Makro vor der Kontur mit G67 beenden."},
    {"a position that is not followed",
     "Before the contour end what gives coordinates another meaning.",
     "Vor der Kontur beenden, was Koordinaten eine andere Bedeutung gibt."},
    {"a motion with L, which is repeated", "Write the motion as often as it runs.",
     "Die Bewegung so oft schreiben, wie sie läuft."},
    {"a line without a number, the rest of the block above",
     "Write it at the end of the line above, as one line, or ~ at the end of that.",
     "Sie an das Ende der Zeile darüber schreiben, als eine Zeile, oder ~ an deren Ende."},
    {"the motion before it has no length",
     "Let the tool come to the start of the arc in a straight line: before the selection it has to "
     "stand elsewhere.",
     "Das Werkzeug in einer Geraden zum Anfang des Bogens fahren: vor der Anwahl muss es an "
     "anderer Stelle stehen."},
    {"RND as a smooth approach",
     "Write APPR CT with the first point of the contour, CCA90, the radius as R, and RL or RR, in "
     "place of the motion with RL or RR and of RND.",
     "An Stelle der Bewegung mit RL oder RR und von RND APPR CT schreiben, mit dem ersten Punkt "
     "der "
     "Kontur, CCA90, dem Radius als R, und RL oder RR."},
    {"RND as a smooth departure", "Write DEP CT with CCA90 and the radius as R in place of RND.",
     "An Stelle von RND DEP CT mit CCA90 und dem Radius als R schreiben."},
    {" where a contour begins", "Take it out: there is no corner of the contour.",
     "Streichen: dort ist keine Ecke der Kontur."},
    {" where a contour ends", "Take it out: there is no corner of the contour.",
     "Streichen: dort ist keine Ecke der Kontur."},
    {"a rounding or a chamfer that is not between",
     "Where the contour begins or ends take it out, as there is no corner of it; elsewhere write "
     "the corner as blocks of its own.",
     "Am Anfang und am Ende der Kontur streichen, dort ist keine Ecke; sonst die Ecke als eigene "
     "Sätze schreiben."},
    {"a rounding or a chamfer where the contour turns back",
     "Take it out: no arc and no chamfer lies between two motions along the same line.",
     "Streichen: zwischen zwei Bewegungen auf derselben Linie liegt weder Bogen noch Fase."},
    {"a rounding or a chamfer", write_corner, write_corner_in_german},
    {"the angle of a rotation", "Write it beside ROT or AROT, before the contour.",
     "Ihn neben ROT oder AROT schreiben, vor der Kontur."},
    {"the angle of a motion", "Write the end point of the line with both axes.",
     "Den Endpunkt der Geraden mit beiden Achsen schreiben."},
    {reason::machine_variable_set,
     "Write the value in its place: only the machine knows what it has made of the one that was "
     "assigned. A variable of the program has a DEF at its beginning.",
     "An ihre Stelle den Wert schreiben: was aus dem zugewiesenen geworden ist, weiß nur die "
     "Maschine. Eine Variable des Programms hat ein DEF an seinem Anfang."},
    {"a word of the language that is not read here",
     "Take it out. Where the path does not depend on it, it may be declared in pass_words.",
     "Es streichen. Wo der Weg nicht davon abhängt, kann es in pass_words angegeben werden."},
    {"AC or IC of a further axis",
     "Write where the axis goes, as G90 counts: C90. Or move it before the contour.",
     "Schreiben, wohin die Achse fährt, wie G90 zählt: C90. Oder sie vor der Kontur bewegen."},
    {"a variable, while TRC is active", "Write its value in its place.",
     "Ihren Wert an ihre Stelle schreiben."},
    {"corners of small steps", "Take M97 out: steps smaller than the radius are told by number.",
     "M97 streichen: Stufen, die kleiner sind als der Radius, werden mit ihrer Nummer gemeldet."},
    {"open corners", "Take M98 out, and lead the contour past the open corner by the radius.",
     "M98 streichen und die Kontur um den Radius über die offene Ecke hinausführen."},
    {reason::no_colon_after_number,
     "Write a colon after the number of the block that the jump leads to: N70: Y0.",
     "Hinter die Nummer des Satzes, zu dem der Sprung führt, einen Doppelpunkt schreiben: N70: "
     "Y0."},
    {"after G40 without motion",
     "Program a motion in the plane after G40, before it: only there the tool leaves the "
     "contour.",
     "Hinter G40 und davor eine Bewegung in der Ebene programmieren: erst sie führt das Werkzeug "
     "von der Kontur weg."},
    {"while TRC is active",
     "It has no place within a contour: end the contour before it with "
     "G40, and begin it anew with G41 or G42 after it.",
     "In einer Kontur hat es keinen Platz: die Kontur davor mit G40 beenden und dahinter mit G41 "
     "oder G42 neu beginnen."},
    {"that may be skipped",
     "Take the `/` out, or say by block_skip of the setup whether such lines are executed.",
     "Den `/` streichen, oder mit block_skip im Setup sagen, ob solche Sätze ausgeführt werden."},
    {"a subprogram after the program",
     "Put it before the program, whose first line is % with its name.",
     "Es vor das Programm stellen, dessen erste Zeile % mit seinem Namen ist."},
    {"a call after words", "Write the call in a line of its own, after the words.",
     "Den Aufruf in eine eigene Zeile hinter den Wörtern schreiben."},
    {"the name of a call in a variable", "Write the name of the subprogram in its place.",
     "Den Namen des Unterprogramms an ihre Stelle schreiben."},
    {"the call of either of two subprograms",
     "Write a blank after L or LL, before the name that is meant.",
     "Hinter L oder LL ein Leerzeichen schreiben, vor den Namen, der gemeint ist."},
    {"after blocks without a number of their program",
     "Take the blocks before it out, or put the number before them; if they are a "
     "program "
     "of their own, give each as a text of its own.",
     "Die Sätze davor streichen oder die Nummer vor sie stellen; sind sie ein eigenes Programm, "
     "jedes als eigenen Text übergeben."},
    {"a second program", "Give each program as a text of its own.",
     "Jedes Programm als eigenen Text übergeben."},
    {"a second block in the line", "Write each block in a line of its own, and comments in ( ).",
     "Jeden Satz in eine eigene Zeile schreiben, Kommentare in ( )."},
    {"write it into a line of its own", "Write it into a line of its own.",
     "Es in eine eigene Zeile schreiben."},
    {reason::number_after_words,
     "Write the number at the beginning of its block, before all other words.",
     "Die Nummer an den Anfang ihres Satzes schreiben, vor alle anderen Wörter."},
    {"a subprogram that is not given",
     "Give its text in `subprograms` (--subprograms), or write its lines in the place of its call.",
     "Seinen Text in `subprograms` angeben (--subprograms), oder seine Zeilen an die Stelle seines "
     "Aufrufs schreiben."},
    {"a subprogram", "Write the lines of the subprogram in the place of its call.",
     "Die Zeilen des Unterprogramms an die Stelle seines Aufrufs schreiben."},
    {"macro call", "Write the motion of the macro in the place of its call.",
     "Die Bewegungen des Makros an die Stelle seines Aufrufs schreiben."},
    {"modes as they were",
     "Program the functions that held before once more: G90 or G91, G20 or G21, the plane, F.",
     "Die Funktionen von vorher noch einmal programmieren: G90 oder G91, G20 oder G21, die Ebene, "
     "F."},
    {"a variable or an expression",
     "Write its value in its place, assign it in the program, or give it: `variables` of the "
     "setup.",
     "Den Wert an ihre Stelle schreiben, sie im Programm setzen oder ihren Wert angeben: "
     "`variables` des Setups."},
    {"a variable", "Write its value in its place, or assign it in the program.",
     "Ihren Wert an ihre Stelle schreiben oder sie im Programm setzen."},
    {"turns beside a radius", "Write the centre of the arc, I and J, in place of its radius.",
     "Statt des Radius den Mittelpunkt des Bogens schreiben, I und J."},
    {"a condition without IF",
     "Write IF before it, and GOTO with the number of the block in place of M99 P.",
     "IF davorschreiben, und GOTO mit der Satznummer statt M99 P."},
    {"an expression or a name", "Write its value in its place. A comment stands in ( ).",
     "Seinen Wert an seine Stelle schreiben. Ein Kommentar steht in ( )."},
    {"an expression", "Write its value in its place.", "Seinen Wert an seine Stelle schreiben."},
    {"a parameter", "Write its value in its place.", "Seinen Wert an seine Stelle schreiben."},
    {"EXTCALL", "Give the text of the program that it calls in `subprograms` (--subprograms).",
     "Den Text des Programms, das es aufruft, in `subprograms` angeben (--subprograms)."},
    {"a statement",
     "What it does has to be written out: the blocks in the order in which they run. If this is a "
     "program of another control, declare its dialect (--dialect, `dialect` in the setup).",
     "Was sie bewirkt, muss ausgeschrieben sein: die Sätze in der Reihenfolge, in der sie laufen. "
     "Ist es ein Programm einer anderen Steuerung, deren Dialekt angeben (--dialect, `dialect` im "
     "Setup)."},
    {"a name",
     "Correct its spelling. Where it does not change the path, declare it in pass_words of the "
     "setup; a subprogram is given in `subprograms`.",
     "Die Schreibweise berichtigen. Wo er den Weg nicht ändert, ihn in pass_words des Setups "
     "angeben; ein Unterprogramm gehört in `subprograms`."},
    {reason::text_in_utf16, "Save the program as plain text in UTF-8 or ASCII.",
     "Das Programm als reinen Text in UTF-8 oder ASCII speichern."},
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
    {"tool offset, twice", "Write the coordinates with the offset in them.",
     "Die Koordinaten mit der Korrektur darin schreiben."},
    {"a motion function of its own",
     "Write G00 or G01 beside G41 or G42, or before them: what moves the axes before lasts up "
     "to the next motion function.",
     "G00 oder G01 neben G41 oder G42 schreiben, oder davor: was die Achsen davor bewegt, gilt bis "
     "zur nächsten Wegbedingung."},
    {"TRC under",
     "Before the contour end what gives coordinates another meaning, with a straight motion "
     "after it that names both axes of the plane.",
     "Vor der Kontur beenden, was Koordinaten eine andere Bedeutung gibt, und dahinter eine "
     "Gerade mit beiden Achsen der Ebene programmieren."},
    {"P beside G41, G42",
     "Leave P out: what it means differs from control to control. Give tool_radius in the setup, "
     "or write a D word in its place, whose radius the tool table or G10 L12 P R gives.",
     "P weglassen: was es bedeutet, ist je nach Steuerung verschieden. tool_radius im Setup "
     "angeben, oder an seine Stelle ein D-Wort schreiben, dessen Radius die Werkzeugtabelle oder "
     "G10 L12 P R angibt."},
    {"which suppresses TRC",
     "Take it out, and CUTCONOF with it: end the contour before it with G40, and begin it "
     "anew with G41 or G42 where CUTCONOF stands.",
     "Es mit CUTCONOF streichen: die Kontur davor mit G40 beenden, und sie dort, wo CUTCONOF "
     "steht, mit G41 oder G42 neu beginnen."},
    {"a correction of LINUXCNC, or a direction",
     "If this is a program for LinuxCNC, declare it: --dialect linuxcnc, `dialect` in the setup. A "
     "contour of FANUC has G41 or G42 with the number D of its register.",
     "Ist dies ein Programm für LinuxCNC, dies angeben: --dialect linuxcnc, `dialect` im Setup. "
     "Eine Kontur von FANUC hat G41 oder G42 mit der Nummer D ihres Registers."},
    {"compensation of the tool radius in space",
     "Let the control compensate in space; contours of a plane have G41 or G42.",
     "Im Raum die Steuerung korrigieren lassen; Konturen einer Ebene haben G41 oder G42."},
    {", whose RL and RR are not followed",
     "Compensate that program on its own, and give the control the result: the call stays as it "
     "is. "
     "Where its text is not given, the call passes.",
     "Jenes Programm für sich korrigieren und der Steuerung das Ergebnis geben: der Aufruf bleibt, "
     "wie er ist. Wo sein Text nicht angegeben ist, geht der Aufruf durch."},
    {"C in a straight motion of a contour",
     "To chamfer the corner write ,C with a comma before it. An axis C stands in a block before "
     "the contour first.",
     "Für eine Fase der Ecke ,C mit einem Komma davor schreiben. Eine Achse C steht zuerst in "
     "einem Satz vor der Kontur."},
    {"G301, chamfer", write_corner, write_corner_in_german},
    {"G302, rounding", write_corner, write_corner_in_german},
    {"#RND=", write_corner, write_corner_in_german},
    {"#CHR=", write_corner, write_corner_in_german},
    {"#OTC",
     "Take it out, and give the tool its radius with the wear in it: what the control corrects "
     "while it machines cannot be in the path.",
     "Es streichen, und dem Werkzeug seinen Radius mit dem Verschleiß geben: was die Steuerung "
     "beim Fertigen korrigiert, kann nicht im Weg stehen."},
    {"the contour of a cycle",
     "The cycle compensates its contour itself: leave G41 and G42 out of it, and end it with "
     "#CONTOUR END.",
     "Der Zyklus korrigiert seine Kontur selbst: G41 und G42 darin weglassen, und sie mit "
     "#CONTOUR END beenden."},
    {"#CONTOUR ",
     "Write the contour of the cycle before G41 and G42, or after G40: it does not belong to "
     "the contour that is cut here.",
     "Die Kontur des Zyklus vor G41 und G42 schreiben, oder hinter G40: sie gehört nicht zu der "
     "Kontur, die hier gefräst wird."},
    {"#ROTATION ", "Take it out, and write the coordinates as they are after the rotation.",
     "Es streichen, und die Koordinaten so schreiben, wie sie nach der Drehung sind."},
    {"a sum of a tool radius",
     "Write the value itself under G90: G10 L12 P R the radius, L13 its wear, G10 L1 P R in "
     "LINUXCNC; or leave it out, and give both in the table of the setup.",
     "Den Wert selbst unter G90 schreiben: G10 L12 P R den Radius, L13 seinen Verschleiß, G10 L1 "
     "P R bei LINUXCNC; oder es weglassen und beide in der Tabelle des Setups angeben."},
    {"measuring", "Take it into a program of its own: where it stops only the machine knows.",
     "Es in ein eigenes Programm auslagern: wo es hält, weiß nur die Maschine."},
    {"APPR ", "Write LT, LN, CT, LCT, or PLT to PLCT, after APPR.",
     "Hinter APPR LT, LN, CT, LCT oder PLT bis PLCT schreiben."},
});

}  // namespace

std::vector<std::string_view> reasons_with_help() {
  std::vector<std::string_view> reasons;
  std::ranges::transform(helps, std::back_inserter(reasons), &ReasonHelp::reason);
  return reasons;
}

std::string_view help_by_reason(std::string_view detail, Language language) {
  const auto* const found = std::ranges::find_if(helps, [&](const ReasonHelp& each) {
    return detail.find(each.reason) != std::string_view::npos;
  });
  if (found == helps.end()) return {};
  return language == Language::german ? found->german : found->english;
}

}  // namespace trc

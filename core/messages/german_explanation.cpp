#include "core/messages/german_explanation.h"

#include <algorithm>

namespace trc {
namespace {

constexpr std::string_view no_g40_before = "Davor fehlt G40.";
constexpr std::string_view no_g40_behind = "Hinter der Kontur davor fehlt G40.";
constexpr std::string_view from_a_cycle =
    "Ein Zyklus oder ein Unterprogramm, das in die Kontur eingesetzt wurde, bringt es mit.";
constexpr std::string_view two_lines = "Zwei Zeilen wurden zu einer zusammengefügt.";
constexpr std::string_view slip = "Ein Tippfehler.";
constexpr std::string_view other_control = "Das Programm ist für eine andere Steuerung.";
constexpr std::string_view wrong_side = "Die Kontur wird auf der falschen Seite korrigiert.";
constexpr std::string_view wrong_side_or_lead =
    "Die Kontur wird auf der falschen Seite korrigiert, oder ein An- oder Abfahrweg schneidet eine "
    "Wand: dann passt kein Radius, gleich wofür an einer Stelle Platz ist.";
constexpr std::string_view no_point = "Ein Dezimalpunkt fehlt.";
constexpr std::string_view other_unit = "Das Programm zählt in einer anderen Maßeinheit.";
constexpr std::string_view coarse = "I, J, K oder der Endpunkt sind zu grob gerundet.";
constexpr std::string_view absolute_or_not =
    "I, J, K sind absolut geschrieben, wo sie ab dem Anfangspunkt zählen, oder umgekehrt (G161, "
    "G162).";

constexpr auto rows = std::to_array<GermanExplanation>({
    {.code = Code::full_circle_with_radius_word,
     .meaning = "Ein Kreis, der endet, wo er anfängt, braucht einen Mittelpunkt: zu einem Radius "
                "allein passen beliebig viele Kreise.",
     .causes = {"Der Endpunkt ist versehentlich gleich dem Anfangspunkt.",
                "Ein Vollkreis war gemeint und ist mit R geschrieben."}},
    {.code = Code::circle_center_misfit,
     .meaning = "Anfangs- und Endpunkt müssen gleich weit vom Mittelpunkt liegen. Hier "
                "unterscheiden sich die Abstände um mehr, als durch Verschieben des Mittelpunkts "
                "berichtigt werden darf (G165).",
     .causes = {absolute_or_not,
                "Ein falscher Endpunkt, oder einer, der nach einer Änderung stehen geblieben ist.",
                "Der Satz davor ist mit G239 korrigiert, wonach das Werkzeug neben dem "
                "programmierten Punkt steht."}},
    {.code = Code::circle_radius_zero,
     .meaning = "Der Mittelpunkt liegt im Anfangspunkt, oder R ist 0: ein solcher Bogen hat keine "
                "Richtung.",
     .causes = {"I, J, K sind auf 0 geblieben.",
                "Das Programm zählt in einer so groben Einheit, dass der Radius auf 0 gerundet "
                "wird."}},
    {.code = Code::radius_and_tool_word_together,
     .meaning = "Beide Wörter setzen den Werkzeugradius, und nichts sagt, welches gelten soll.",
     .causes = {"Ein D-Wort ist in eine Zeile geraten, die schon V.G.WZ_AKT.R setzt."}},
    {.code = Code::transition_type_twice,
     .meaning = "G25 schließt Außenecken mit Geraden, G26 mit Bögen. Beides in einem Satz geht "
                "nicht.",
     .causes = {two_lines}},
    {.code = Code::compensation_side_twice,
     .meaning = "G40, G41 und G42 schließen einander aus: links der Kontur, rechts davon, oder "
                "ohne Korrektur.",
     .causes = {two_lines, "G41 wurde durch G42 ersetzt und nicht gelöscht."}},
    {.code = Code::selection_mode_twice,
     .meaning = "Die Anwahlart sagt, wie das Werkzeug an die Kontur fährt. Ein Satz wählt eine.",
     .causes = {two_lines}},
    {.code = Code::plane_change_while_active,
     .meaning = "Die Korrektur rechnet in einer Ebene. Mitten in der Kontur kann die Bahn nicht "
                "in eine andere übergehen.",
     .causes = {"Vor dem Wechsel fehlt G40.",
                "Ein G17, das ein CAM-System an den Anfang jeder Bearbeitung schreibt, obwohl die "
                "Kontur davor noch offen ist."}},
    {.code = Code::axis_link_while_active,
     .meaning = "Eine Achskopplung gibt die Bewegungen einer Achse an eine andere weiter. Bei "
                "aktiver Korrektur sind die nächsten Sätze schon mit dem gerechnet, was jetzt "
                "gilt; dazwischen kann es sich nicht ändern.",
     .causes = {no_g40_before, from_a_cycle}},
    {.code = Code::preset_while_active,
     .meaning = "Istwertsetzen gibt dem Ort, an dem das Werkzeug steht, eine andere Koordinate. "
                "Bei aktiver Korrektur sind die nächsten Sätze schon mit dem gerechnet, was jetzt "
                "gilt; dazwischen kann es sich nicht ändern.",
     .causes = {no_g40_before, from_a_cycle}},
    {.code = Code::coordinate_system_while_active,
     .meaning = "Ein neues Koordinatensystem verschiebt oder dreht alles, was folgt. Bei aktiver "
                "Korrektur sind die nächsten Sätze schon mit dem gerechnet, was jetzt gilt; "
                "dazwischen kann es sich nicht ändern.",
     .causes = {no_g40_before, from_a_cycle}},
    {.code = Code::negative_tangfeed_minimum,
     .meaning = "RMIN ist der Konturradius, unter dem der Vorschub nicht weiter gesenkt wird. Kein "
                "Radius ist negativ.",
     .causes = {"Ein Vorzeichen aus Versehen."}},
    {.code = Code::center_and_radius_together,
     .meaning = "Mittelpunkt und Radius sagen jeder für sich, wo der Kreis liegt; zusammen können "
                "sie einander widersprechen.",
     .causes = {"R wurde in eine Zeile geschrieben, die schon einen Mittelpunkt hat."}},
    {.code = Code::tangential_ignored_with_inside_corner,
     .meaning = "G238 beginnt und endet in einer Innenecke; einen tangentialen Bogen, den G05 "
                "einfügen könnte, gibt es dort nicht. Das Programm läuft ohne ihn weiter.",
     .causes = {"G05 steht in einem Programmkopf, der für alle Anwahlarten dient."}},
    {.code = Code::inside_corner_selected_while_active,
     .meaning = "G238 legt mit dem ersten Satz der Kontur fest, wo eine geschlossene Kontur "
                "beginnt. Eine begonnene kann es nicht übernehmen.",
     .causes = {no_g40_behind}},
    {.code = Code::mode_change_under_inside_corner,
     .meaning = "Unter G238 endet eine Kontur in der Ecke, in der sie begonnen hat; eine andere "
                "Anwahlart würde sie anderswo verlassen.",
     .causes = {no_g40_behind}},
    {.code = Code::point_to_point_while_active,
     .meaning = "Mit #PTP fährt jede Achse für sich: die Bahn zwischen zwei Punkten ist nicht "
                "bekannt. Bei aktiver Korrektur sind die nächsten Sätze schon mit dem gerechnet, "
                "was jetzt gilt; dazwischen kann es sich nicht ändern.",
     .causes = {no_g40_before, from_a_cycle}},
    {.code = Code::circle_radii_differ,
     .meaning = "Unter G164 gilt der Mittelpunkt, wie er geschrieben ist, und Anfangs- und "
                "Endpunkt liegen nicht gleich weit von ihm.",
     .causes = {coarse, absolute_or_not}},
    {.code = Code::stretch_factor_out_of_range,
     .meaning = "STRETCH_FACTOR sagt, um wie viele Werkzeugradien ein Satz an einer Außenecke "
                "verlängert werden darf. Statt eines Werts außerhalb des Bereichs gilt 1.",
     .causes = {"Statt eines Faktors wurden Prozent geschrieben."}},
    {.code = Code::spatial_circle_while_active,
     .meaning = "G303 ist ein Kreis im Raum. Die Korrektur kennt nur Kreise in ihrer Ebene.",
     .causes = {no_g40_before}},
    {.code = Code::inverse_without_online,
     .meaning = "INVERSE gehört zur Korrektur während der Bearbeitung (ONLINE), die dieses "
                "Programm nicht hat.",
     .causes = {"Ein Programm für eine Steuerung, die während der Bearbeitung korrigiert."}},
    {.code = Code::real_time_loop_while_active,
     .meaning = "#RT WHILE wiederholt Zeilen, während die Maschine fährt. Bei aktiver Korrektur "
                "sind die nächsten Sätze schon mit dem gerechnet, was jetzt gilt; dazwischen kann "
                "es sich nicht ändern.",
     .causes = {no_g40_before, from_a_cycle}},
    {.code = Code::circular_selection_block,
     .meaning = "Unter G138, G139, G238 und G239 fährt das Werkzeug geradlinig an die Kontur: ein "
                "Kreis würde neben seinem Endpunkt enden und wäre keiner mehr.",
     .causes = {"Die erste Bewegung hinter G41 ist schon der erste Bogen der Kontur.",
                "Ein CAM-System, das im Bogen anfährt, schreibt G41 in den Bogen und nicht in die "
                "Gerade davor."}},
    {.code = Code::too_many_passive_blocks,
     .meaning = "Um eine Ecke zu kennen, muss die Korrektur die nächste Bewegung in der Ebene "
                "sehen. Sätze dazwischen (M-Funktionen, Bewegungen der dritten Achse, "
                "Verweilzeiten) werden bis dahin aufbewahrt, und nur so viele.",
     .causes = {"Eine lange Reihe von Technologiewörtern mitten in der Kontur.",
                "G40 wurde vergessen, und das Bohren hinter der Kontur zählt zu ihr."}},
    {.code = Code::tool_not_smaller_than_arc,
     .meaning = "Ein Bogen, den das Werkzeug von innen schneidet, wird um den Werkzeugradius "
                "kleiner. Von diesem bleibt nichts übrig.",
     .causes = {"Das Werkzeug ist zu groß für eine Ausrundung oder eine Taschenecke.",
                "Die Seite ist falsch: außen am Bogen passt das Werkzeug."}},
    {.code = Code::arc_radii_differ,
     .meaning = "Unter G164 gilt der Mittelpunkt, wie er geschrieben ist. Ein Bogen, der in "
                "verschiedenen Abständen von ihm anfängt und endet, ist eine Spirale, und die hat "
                "keine Äquidistante.",
     .causes = {coarse}},
    {.code = Code::line_reversed,
     .meaning = "Zwischen ihren beiden Ecken bleibt von der Strecke so wenig übrig, dass das "
                "Werkzeug auf ihr rückwärts fahren und ins Teil schneiden müsste.",
     .causes = {"Das Werkzeug ist zu groß für eine Stufe, eine Nut oder eine Fase zwischen zwei "
                "Innenecken.",
                wrong_side_or_lead,
                "Zwei Ecken liegen wenige Mikrometer auseinander, wie CAM-Systeme sie "
                "schreiben."}},
    {.code = Code::arc_wrapped,
     .meaning = "Zwischen seinen beiden Ecken bleibt vom Bogen nichts übrig: das Werkzeug müsste "
                "den Rest des Kreises herumfahren und ins Teil schneiden.",
     .causes = {"Das Werkzeug ist zu groß für die Ausrundung und die Geraden daneben.",
                wrong_side_or_lead}},
    {.code = Code::no_feed_adaptation_in_tangential_block,
     .meaning = "G11 hält den Vorschub an der Kontur. In diesem Bogen von G05 stünde die Kontur "
                "still: der Satz läuft mit dem programmierten Vorschub des Mittelpunkts.",
     .causes = {"Der Anfangspunkt liegt für das Werkzeug zu nahe an der Kontur."}},
    {.code = Code::selection_point_too_near,
     .meaning = "G238 beginnt im Freien: wo das Werkzeug vor der Kontur steht, darf es sie "
                "nirgends berühren.",
     .causes = {"Der Anfangspunkt einer Tasche liegt näher an einer Wand als der Werkzeugradius.",
                "Das Werkzeug ist größer als das, für das programmiert wurde."}},
    {.code = Code::radius_change_under_inside_corner,
     .meaning = "Unter G238 endet eine Kontur in der Ecke, in der sie begonnen hat; mit einem "
                "anderen Radius läge sie anderswo.",
     .causes = {"Zwischen G41 und G40 steht ein D-Wort oder V.G.WZ_AKT.R."}},
    {.code = Code::inside_corner_angle_too_large,
     .meaning = "Das Werkzeug müsste um die erste Ecke der Kontur herumfahren, um auf seine Seite "
                "zu kommen.",
     .causes = {"Der Anfangspunkt liegt auf der anderen Seite der Kontur."}},
    {.code = Code::center_out_of_range,
     .meaning = "Koordinaten reichen bis eine Million mm. Darüber sind Gleitkommazahlen zu grob "
                "für ein Tausendstel.",
     .causes = {no_point, other_unit}},
    {.code = Code::end_point_out_of_range,
     .meaning = "Koordinaten reichen bis eine Million mm. Auch eine korrigierte Ecke kann dort "
                "liegen, obwohl die programmierte es nicht tut: wo sich zwei Geraden unter sehr "
                "kleinem Winkel schneiden.",
     .causes = {no_point, other_unit}},
    {.code = Code::spatial_circle_after_deselection,
     .meaning = "Mit der ersten Bewegung hinter G40 verlässt das Werkzeug die Kontur. Diese muss "
                "in der Ebene liegen.",
     .causes = {"G40 steht unmittelbar vor G303."}},
    {.code = Code::nc_syntax,
     .meaning = "An dieser Stelle beginnt nichts, was ein Wort sein könnte: ein Adressbuchstabe "
                "mit Zahl, eine Funktion, ein Kommentar oder ein Befehl.",
     .causes = {"Vor einer Zahl fehlt ein Buchstabe.",
                "Das Programm ist für eine andere Steuerung (trc info FILE sagt, wonach es "
                "aussieht)."}},
    {.code = Code::nc_unknown_function,
     .meaning = "Eine unbekannte G-Funktion könnte die Bahn ändern; sie lässt sich nicht "
                "übergehen.",
     .causes = {slip, "Eine Funktion des Maschinenherstellers.", other_control}},
    {.code = Code::nc_unsupported,
     .meaning = "Das Wort rechnet, springt, ruft auf oder verschiebt: was das Werkzeug dann tut, "
                "weiß nur die Steuerung.",
     .causes =
         {"Ein Unterprogramm, in einer Kontur gerufen, dessen Zeilen nicht im Programm stehen.",
          "Koordinaten, die in einer Kontur verschoben oder gedreht werden.", other_control}},
    {.code = Code::trc_option_unknown,
     .meaning = "#TRC [ ] nimmt die Schlüsselwörter aus der Tabelle der Optionen, jedes mit einem "
                "Wert.",
     .causes = {slip}},
    {.code = Code::trc_option_out_of_range,
     .meaning = "Jedes Schlüsselwort von #TRC hat seinen Bereich. Außerhalb hält das Programm an, "
                "statt mit einem anderen Wert zu schneiden.",
     .causes = {"Ein Schalter nimmt 0 oder 1.",
                "Eine Länge oder ein Winkel steht in einer anderen Einheit."}},
    {.code = Code::nc_line_too_long,
     .meaning = "Zeilen werden als Ganzes gehalten; ihre Länge ist deshalb begrenzt.",
     .causes = {"Die Datei ist kein NC-Programm.",
                "Beim Kopieren der Datei gingen die Zeilenenden verloren."}},
    {.code = Code::nc_not_text,
     .meaning = "NC-Programme sind einfacher Text. Ein Steuerzeichen, oder ein Byte, das kein "
                "UTF-8 ist, zeigt, dass dieses keiner ist oder beschädigt wurde.",
     .causes = {"Kommentare in einer älteren Kodierung, etwa Umlaute aus einem Editor unter "
                "Windows.",
                "Eine Übertragung hat am Anfang oder am Ende eigene Bytes hinterlassen.",
                "Ein Grad-, Durchmesser- oder Toleranzzeichen außerhalb eines Kommentars."}},
    {.code = Code::nc_number,
     .meaning = "Hinter einem Adressbuchstaben steht eine Dezimalzahl im Bereich dieses Worts.",
     .causes = {"Ein Komma statt des Dezimalpunkts.", "Der Buchstabe O statt der Ziffer 0.",
                "Ein Vorschub von 0."}},
    {.code = Code::nc_unclosed,
     .meaning = "Eine Klammer, ein Kommentar oder eine fortgesetzte Zeile reicht bis ans Ende der "
                "Zeile oder des Programms.",
     .causes = {"Eine schließende Klammer fehlt.", "Die Datei endet zu früh."}},
    {.code = Code::nc_word_twice,
     .meaning =
         "Eine Adresse sagt in einem Satz eines. Welche von zweien gilt, hält jede Steuerung "
         "anders.",
     .causes = {two_lines, "Eine Koordinate wurde geändert, und die ältere blieb stehen."}},
    {.code = Code::nc_axis_unknown,
     .meaning = "Das Wort bewegt eine Achse, die in den Einstellungen nicht steht: sie könnte zur "
                "Bahn gehören.",
     .causes = {"Eine Rund- oder Zusatzachse, die in den Einstellungen nicht steht.", slip}},
    {.code = Code::nc_group_twice,
     .meaning = "Funktionen einer Gruppe schließen einander aus, wie G00 und G01, und nichts sagt, "
                "welche gemeint ist.",
     .causes = {two_lines}},
    {.code = Code::tool_unknown,
     .meaning = "Das D- oder T-Wort nennt ein Werkzeug, dessen Radius nicht bekannt ist.",
     .causes = {"Die Werkzeugtabelle wurde nicht angegeben.",
                "Die Nummer ist die einer anderen Maschine.",
                "Die Tabelle hat das Werkzeug, aber nicht seinen Namen oder nicht diese "
                "Schneide."}},
    {.code = Code::program_empty,
     .meaning = "Es gibt nichts zu korrigieren: keine Zeile des Programms enthält ein Wort.",
     .causes = {"Die falsche Datei, oder eine, die nicht zu Ende geschrieben wurde."}},
    {.code = Code::side_behind_end,
     .meaning = "Was hinter M02 oder M30 steht, oder hinter dem % nach dem ersten Satz, wird nicht "
                "ausgeführt. Eine Korrektur, die dort angewählt wird, ginge verloren.",
     .causes = {"Zwei Programme stehen in einer Datei.",
                "Mitten im Programm steht eine Zeile mit %."}},
    {.code = Code::other_dialect,
     .meaning = "Wörter bedeuten je Steuerung Verschiedenes: G20 heißt bei der einen Zoll, bei der "
                "anderen etwas anderes. Was hier steht, sieht nach einem anderen Dialekt aus als "
                "dem angegebenen.",
     .causes = {"Der Dialekt wurde nicht angegeben; dann ist es ISG."}},
    {.code = Code::block_skip_undecided,
     .meaning = "Ein Schalter der Maschine entscheidet, ob Sätze hinter `/` ausgeführt werden. Die "
                "Kontur hat mit ihnen eine andere Bahn als ohne sie, und nur eine davon kann "
                "geschrieben werden.",
     .causes = {"Ein `/` vor G41, G40 oder einer Bewegung der Kontur.",
                "Ein Satz hinter `/`, der rechnet oder sagt, was die Koordinaten hinter ihm "
                "bedeuten."}},
    {.code = Code::turning,
     .meaning = "Eine Drehmaschine korrigiert die Schneidenspitze in der Ebene der Spindel, nach "
                "der Lage der Schneide. Dieses Programm fräst.",
     .causes = {"Ein Programm einer Drehmaschine wurde angegeben."}},
    {.code = Code::motion_unknown,
     .meaning = "Ohne ein Wort davor fährt eine Steuerung mit G00 oder mit G01, je nach ihrer "
                "Einstellung. Der Weg wird hier mit dem Wort geschrieben, und im Eilgang darf "
                "keine Kontur gefräst werden.",
     .causes = {"Das Programm ist ein Teil eines anderen, in dem G01 steht.",
                "G01 wurde vergessen."}},
    {.code = Code::circle_incomplete,
     .meaning = "Ein Bogen braucht in seinem Satz einen Mittelpunkt oder einen Radius: die des "
                "Satzes davor gelten nicht weiter.",
     .causes = {"G02 oder G03 gilt noch vom Satz davor, und eine Gerade war gemeint.",
                "I, J oder R wurde vergessen."}},
    {.code = Code::not_available,
     .meaning = "Die Funktion gibt es, doch kann sie nur eine Steuerung während der Bearbeitung.",
     .causes = {"ONLINE, INVERSE und ONLINE_BY_VECTOR."}},
    {.code = Code::deselection_without_motion,
     .meaning = "Hinter G40 verlässt das Werkzeug die Kontur mit der nächsten Bewegung in der "
                "Ebene. Vorher kann es an keine andere geführt werden.",
     .causes = {"Die Abfahrbewegung wurde gelöscht.",
                "Abgefahren wird mit der dritten Achse allein."}},
    {.code = Code::tool_radius_out_of_range,
     .meaning = "Ein so großer Werkzeugradius ist ein Versehen.",
     .causes = {no_point, "Der Radius steht in einer anderen Maßeinheit, als das Programm zählt."}},
    {.code = Code::field_invalid,
     .meaning = "Ein Wert der Einstellungen oder eines Befehls ist keine Zahl oder liegt außerhalb "
                "seines Bereichs.",
     .causes = {"Eine andere Maßeinheit.", "Ein Feld wurde errechnet und ist unendlich geworden."}},
    {.code = Code::position_unknown,
     .meaning =
         "Eine Verschiebung oder ein anderes Koordinatensystem rückt den Nullpunkt um etwas, "
         "das nur die Steuerung kennt. Wo das Werkzeug in den neuen Koordinaten steht, "
         "bleibt offen, bis es gesagt wird.",
     .causes = {"G54 bis G59, G92 oder eine Verschiebung, und dahinter ein Kettenmaß, ein Kreis "
                "oder G41."}},
    {.code = Code::selection_block_too_short,
     .meaning = "G236 führt das Werkzeug auf dem Satz selbst an die Kontur; dafür muss er lang "
                "genug sein.",
     .causes = {"Das Anfahren ist kürzer als der Werkzeugradius.",
                "Das Werkzeug ist größer als das, für das programmiert wurde."}},
    {.code = Code::tangential_start_on_tangent,
     .meaning = "G05 fährt in einem Bogen an, der die Kontur berührt. Von einem Punkt auf der "
                "Geraden, mit der die Kontur beginnt, führt kein solcher Bogen.",
     .causes = {"Der Anfangspunkt liegt in der Verlängerung des ersten Satzes der Kontur, vor "
                "dessen Anfang."}},
    {.code = Code::circular_deselection_block,
     .meaning = "Unter G138, G139 und G238 verlässt das Werkzeug die Kontur geradlinig.",
     .causes = {"Ein CAM-System, das im Bogen abfährt, schreibt G40 in den Bogen und nicht in die "
                "Gerade dahinter."}},
    {.code = Code::selection_without_contour,
     .meaning = "Zwischen G41 oder G42 und G40 steht keine Bewegung in der Ebene: die Bahn ist die "
                "programmierte.",
     .causes = {"Die Kontur wurde gelöscht, oder sie steht hinter G40."}},
    {.code = Code::ended_while_active,
     .meaning = "Am Ende des Programms steht das Werkzeug am korrigierten Ende der Kontur; nichts "
                "hat es von dort weggeführt.",
     .causes = {"G40 wurde vergessen.", "Die Datei endet zu früh."}},
    {.code = Code::circular_side_change_block,
     .meaning = "Von einer Seite der Kontur auf die andere fährt das Werkzeug geradlinig.",
     .causes = {"G42 steht in einem Bogen der Kontur."}},
    {.code = Code::side_change_without_contour,
     .meaning = "Eine Seite wird an einem Satz der Kontur eingenommen. Zwischen Anwahl und "
                "Wechsel, oder zwischen zwei Wechseln, steht keiner.",
     .causes = {"G42 steht in dem Satz, zu dem G41 hinführt."}},
    {.code = Code::contour_not_closed,
     .meaning = "Unter G238 endet eine Kontur in der Ecke, in der sie beginnt. Diese endet "
                "anderswo oder hat keinen Satz.",
     .causes = {"Der letzte Satz wurde vergessen.",
                "Ein Endpunkt ist anders gerundet als der Anfang."}},
    {.code = Code::last_block_full_circle,
     .meaning = "Unter G238 ist die schließende Ecke die zwischen letztem und erstem Satz. Ein "
                "Vollkreis hat kein eigenes Ende.",
     .causes = {"Eine Bohrung wurde ans Ende der Kontur gesetzt."}},
    {.code = Code::approach_crosses_contour,
     .meaning = "Auf dem Weg zur ersten Ecke würde das Werkzeug durch eine Wand schneiden.",
     .causes = {"Der Anfangspunkt liegt außerhalb einer Tasche, oder innerhalb eines Zapfens."}},
    {.code = Code::side_change_under_inside_corner,
     .meaning = "Unter G238 endet eine Kontur in der Ecke, in der sie begonnen hat, und auf "
                "derselben Seite.",
     .causes = {no_g40_behind}},
    {.code = Code::selection_too_long,
     .meaning = "Was vor dem Ende der Kontur nicht bekannt sein kann, hält ihre Sätze zurück, und "
                "nur so viele. Auch das Nachmessen der Bahn tut das: mit verify=report ist es eine "
                "Warnung, und die Bahn neben dieser Kontur wird nicht gemessen.",
     .causes = {"Eine einzige Anwahl über eine ganze Fläche.", "G40 wurde vergessen."}},
    {.code = Code::blocks_masked,
     .meaning = "Unter G141 werden Sätze, die das Werkzeug nicht erreicht, ausgelassen: die Kontur "
                "bleibt dort stehen. Zu tief geschnitten wird nichts.",
     .causes = {"Das Werkzeug ist zu groß für eine Nut, eine Stufe oder eine Kerbe."}},
    {.code = Code::bottleneck,
     .meaning = "An dieser Stelle hält das Werkzeug Abstand zu dem Satz, dem es folgt, kommt aber "
                "einem anderen zu nahe.",
     .causes = {"Ein Hals, der enger ist als das Werkzeug.",
                "Eine Kontur, die sich selbst trifft."}},
    {.code = Code::beyond_window,
     .meaning = "Die Konturausblendung sucht Schleifen in einem Fenster von so vielen Sätzen. Eine "
                "Schleife, die länger ist, bleibt in der Bahn.",
     .causes = {"look_ahead_blocks ist kleiner als die Kontur."}},
    {.code = Code::clearance_violated,
     .meaning =
         "Die fertige Bahn wird nach einem eigenen Verfahren gegen die Kontur gemessen. Hier "
         "kommt sie zu nahe: das Teil würde beschädigt.",
     .causes = {"Ein Hals, der enger ist als das Werkzeug, unter G140, das nur benachbarte Sätze "
                "ansieht.",
                "Die Kontur beginnt und endet in einer Innenecke, oder die Seite ist die falsche.",
                "Konturverletzungen werden übergangen (IGNORE_CONT_DAMAGE)."}},
    {.code = Code::side_changed_at_corner,
     .meaning = "Mit REVERSE wechselt die Seite, wo die Bewegung auf sich selbst zurückläuft. Hier "
                "tut sie es nicht: das Werkzeug fährt über die Ecke.",
     .causes = {"Es fehlt ein Punkt, an dem die Bewegung umkehrt.",
                "Der Endpunkt eines Satzes ist gerundet, so dass der Rückweg ein anderer ist."}},
    {.code = Code::most_left_out,
     .meaning = "Die Schleifenentfernung würde einen so großen Teil der Kontur auslassen, dass es "
                "kaum gemeint sein kann.",
     .causes = {"Das Werkzeug kommt durch einen Hals nicht hindurch, und dahinter liegt der größte "
                "Teil der Kontur.",
                "An- oder Abfahrwege kreuzen die Kontur, oder Eilgang verbindet mehrere Konturen "
                "in einer Anwahl: G40 dazwischen setzen.",
                wrong_side}},
    {.code = Code::no_tool_radius,
     .meaning = "Welche Bahn das Werkzeug fährt, hängt von seinem Radius ab, und weder Programm "
                "noch Einstellungen haben einen genannt.",
     .causes = {"Die Werkzeugtabelle wurde nicht angegeben.",
                "Das D- oder T-Wort steht hinter G41."}},
    {.code = Code::tool_radius_zero,
     .meaning = "Mit einem Radius von 0 ist die Bahn die Kontur selbst.",
     .causes = {"Die Werkzeugtabelle hat für dieses Werkzeug keinen Radius.",
                "Ein Programm aus Mittelpunktsbahnen, für das ein Radius von 0 gedacht ist."}},
    {.code = Code::center_corrected,
     .meaning = "Unter G165 wird der Mittelpunkt verschoben, bis Anfangs- und Endpunkt gleich weit "
                "von ihm liegen. Hier um so viel, dass man es ansehen sollte.",
     .causes = {coarse, "Ein falscher Endpunkt."}},
    {.code = Code::wear_too_large,
     .meaning = "Verschleiß sind wenige Zehntel. Über max_wear gilt er als der ganze Radius oder "
                "als Versehen.",
     .causes = {"Als Verschleiß wurde der ganze Radius angegeben.",
                "Ein Durchmesser, oder eine andere Maßeinheit."}},
    {.code = Code::wear_not_deeper,
     .meaning = "Eine Mittelpunktsbahn ist eine Kontur, die ihr Nennwerkzeug schon gerundet hat. "
                "Ein kleineres Werkzeug folgt dieser Rundung: die Innenecke bleibt so weit wie "
                "zuvor.",
     .causes = {"Ein abgenutztes oder nachgeschliffenes Werkzeug, mit nominal_radius."}},
    {.code = Code::tool_radius_contradicts,
     .meaning = "Ein Programm kann den Radius eines Werkzeugs in die Tabelle der Maschine "
                "schreiben: TOOL DEF, G10, $TC_DP6. Die Maschine nähme diesen, also gilt er auch "
                "hier.",
     .causes = {"Das Werkzeug wurde nachgeschliffen und nur an einer Stelle berichtigt.",
                "Das Setup hat ein Werkzeug einer anderen Maschine, oder einen Durchmesser."}},
    {.code = Code::tool_may_have_changed,
     .meaning = "Zwischen zwei Konturen ruft das Programm auf, was nur die Maschine hat, und "
                "dahinter sagt nichts, welches Werkzeug in der Spindel ist. Wechselt der Aufruf "
                "es, so hat die zweite Kontur den Radius des ersten Werkzeugs. In ISG hat ihn auch "
                "die erste Kontur hinter einem Aufruf, wenn V.G.WZ_AKT.R davor den Radius angibt.",
     .causes = {"Ein Unterprogramm des Maschinenherstellers wechselt das Werkzeug."}},
    {.code = Code::call_taken_as_harmless,
     .meaning =
         "Ein Unterprogramm, dessen Text fehlt, kann alles umstellen. Position, Wegbedingung "
         "und G90 oder G91 müssen dahinter neu programmiert werden, das übrige ändern "
         "Unterprogramme kaum: es gilt als unverändert, und das wird einmal gesagt.",
     .causes = {"Das Unterprogramm steht in der Steuerung oder in einer eigenen Datei."}},
    {.code = Code::machine_compensates,
     .meaning = "G12, G13 und G150 von Haas bleiben, wie sie sind: ihren Radius nimmt die Maschine "
                "aus dem Register, das D nennt. Die Konturen mit G41 und G42 hat das Ergebnis "
                "schon korrigiert, ihre D-Wörter sind fort.",
     .causes = {"Das Programm fräst Kreistaschen oder Taschen mit Zyklen der Maschine."}},
    {.code = Code::given_value_kept,
     .meaning = "Ein Zähler in #500, R1 und dergleichen überlebt das Programm, und die Steuerung "
                "erhöht ihn bei jedem Lauf neu, wenn eine Zuweisung ihn aus ihm selbst setzt. Was "
                "über eine andere Variable oder aus einem angegebenen Wert gesetzt ist, ändert "
                "sich von Lauf zu Lauf nicht.",
     .causes = {"Ein Zähler wird über eine lokale Variable erhöht.",
                "Ein Messwert der Maschine, dessen Wert angegeben ist, wird gespeichert."}},
    {.code = Code::way_crosses_contour,
     .meaning = "An- und Abfahren laufen wie programmiert und werden neben der Bahn nachgemessen: "
                "hier geht die Mitte des Werkzeugs durch eine Wand seiner Kontur, in deren Tiefe.",
     .causes = {"G40 führt geradewegs zum nächsten Ort, quer durch das Teil.",
                "Das Werkzeug beginnt auf der anderen Seite der Kontur, oder die Seite ist "
                "falsch."}},
    {.code = Code::line_beyond_control,
     .meaning =
         "Alte Steuerungen von Fanuc nehmen acht Stellen in einer Zahl, LinuxCNC 255 Zeichen "
         "in einer Zeile, Sinumerik 512, ISG 4000. Eine Zeile, die neu geschrieben wird, "
         "darf nicht länger werden.",
     .causes = {"Ein langer Kommentar steht in einer Zeile der Kontur.",
                "Eine Position über 10 m hat vier Nachkommastellen."}},
    {.code = Code::selection_stands_still,
     .meaning = "Der erste Satz nach G41 oder G42, der sich in der Ebene bewegt, fährt die Kontur "
                "an: an seinem Anfang steht die Mitte des Werkzeugs noch auf der programmierten "
                "Bahn. Steht der Satz der Anwahl schon in seinem Ziel, ist das der nächste, der "
                "die erste Wand sein soll.",
     .causes = {"Das Werkzeug ist vor der Anwahl zum ersten Punkt der Kontur gefahren.",
                "Das Programm stammt aus einem Generator ohne Anfahrweg."}},
    {.code = Code::too_many_lines_executed,
     .meaning = "Schleifen, Sprüngen und Aufrufen wird gefolgt, und jede ausgeführte Zeile wird "
                "eine Zeile des flachen Programms. Eine Grenze verhindert, dass eine Schleife "
                "ohne Ende ewig läuft.",
     .causes = {"Der Zähler einer Schleife wird nicht erhöht oder verkehrt herum verglichen.",
                "Ein Rücksprung ohne Bedingung, wie für einen Stangenlader oder zum Warmlaufen."}},
    {.code = Code::calls_too_deep,
     .meaning = "Jeder Aufruf wird innerhalb des vorigen ausgeführt. Steuerungen erlauben 4 bis "
                "10 Ebenen, hier werden 32 verfolgt.",
     .causes = {"Ein Unterprogramm ruft sich selbst auf, unmittelbar oder über ein anderes."}},
    {.code = Code::variable_unset,
     .meaning = "Was die Variable enthält, weiß nur die Maschine, oder niemand. An ihre Stelle "
                "wird nichts gesetzt.",
     .causes = {"Eine Variable, die an der Maschine ihren Wert behält (#500 und darüber bei "
                "Fanuc), wird dort von Hand gesetzt.",
                "Ein Versehen in ihrer Nummer oder ihrem Namen.",
                "Ein Unterprogramm wird ohne ein Argument aufgerufen, das es braucht."}},
    {.code = Code::division_by_zero,
     .meaning = "Der Teiler einer Division oder von MOD ist 0, wenn die Zeile ausgeführt wird.",
     .causes = {"Eine Variable im Teiler ist leer, was als 0 zählt.",
                "Eine Anzahl von 0 wurde angegeben, etwa von Bohrungen oder Zustellungen."}},
    {.code = Code::jump_target_unknown,
     .meaning = "Ein Sprung braucht eine Stelle, an der es weitergeht. Ein Unterprogramm hat "
                "eigene Nummern, die Sprünge von außen nicht erreichen.",
     .causes = {"Die Nummer ging verloren, als das Programm neu nummeriert wurde.",
                "Das Ziel steht in einem anderen Programm der Datei.",
                "Hinter M99 P haben sowohl das Unterprogramm als auch sein Aufrufer die Nummer: "
                "Fanuc meint den Aufrufer, Haas das Unterprogramm."}},
    {.code = Code::subprogram_unknown,
     .meaning = "Was das Unterprogramm fährt, gehört zur Bahn. Nach Dateien wird nicht gesucht, "
                "wenn sie nicht angegeben sind.",
     .causes = {"Das Unterprogramm liegt im Speicher der Steuerung oder in einer eigenen Datei.",
                "Ein Versehen in seiner Nummer oder seinem Namen."}},
    {.code = Code::machine_state,
     .meaning = "Positionen, Verschiebungen, Zeiten, Signale und das Ergebnis eines Messtasters "
                "sind bekannt, wenn das Programm läuft, nicht vorher.",
     .causes = {"Eine Systemvariable wie #5041 oder #5021.",
                "Eine Zeile, die eine Verschiebung der Maschine schreibt.",
                "Ein Programm, das misst."}},
    {.code = Code::expression_invalid,
     .meaning = "Etwas steht, wo eine Zahl, eine Variable, ein Operator oder das Ende der Zeile "
                "hingehört.",
     .causes = {"Eine Klammer fehlt.",
                "Gerechnet wird hinter einer Adresse ohne Klammern, X#1+5 statt X[#1+5].",
                "Runde Klammern, die hier Kommentare sind, statt eckiger."}},
    {.code = Code::value_invalid,
     .meaning = "Die Wurzel aus einer negativen Zahl, der Arkussinus von mehr als 1, eine "
                "Variable oder ein Programm ohne ganze Nummer: damit kann keine Steuerung "
                "weitermachen.",
     .causes = {"Die Daten eines Makros passen nicht zueinander, etwa eine Sehne, die länger als "
                "der Durchmesser ist.",
                "Eine Variable wurde mit einer anderen verwechselt."}},
    {.code = Code::block_structure,
     .meaning = "Schleifen und Verzweigungen sind Paare von Zeilen, und ein Unterprogramm endet, "
                "wo es zurückspringt.",
     .causes = {"Die Nummern hinter DO und END sind verschieden.",
                "Schleifen überlappen sich, statt ineinander zu liegen.",
                "M99 fehlt am Ende eines Unterprogramms."}},
    {.code = Code::computing_text_too_long,
     .meaning = "Von seiner ersten Zeile mit einer Variablen, einem Sprung oder einem Aufruf an "
                "wird ein Programm als Ganzes vorgehalten, da jede Zeile angesprungen werden "
                "kann.",
     .causes = {"Eine Zeile, die rechnet, vor der Ausgabe eines CAM-Systems."}},
    {.code = Code::program_alarm,
     .meaning = "#3000 hält eine Maschine mit einem Text an. Ein Programm verwendet das, wo "
                "seine Daten nicht so sind, wie es sie braucht.",
     .causes = {"Ein Argument eines Makros fehlt oder ist nicht erlaubt."}},
});

static_assert(std::ranges::is_sorted(rows, {}, &GermanExplanation::code));

}  // namespace

std::span<const GermanExplanation> german_explanations() { return rows; }

const GermanExplanation* german_explanation_of(Code code) {
  const auto* const found = std::ranges::lower_bound(rows, code, {}, &GermanExplanation::code);
  return found != rows.end() && found->code == code ? found : nullptr;
}

}  // namespace trc

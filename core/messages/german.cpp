#include "core/messages/german.h"

#include <algorithm>
#include <array>

namespace trc {
namespace {

constexpr auto rows = std::to_array<GermanRow>({
    {.code = Code::full_circle_with_radius_word,
     .title = "ein Vollkreis lässt sich nicht allein mit dem Radius angeben",
     .help = "Den Mittelpunkt mit I, J, K statt R programmieren."},
    {.code = Code::circle_center_misfit,
     .title = "der Kreismittelpunkt passt nicht zu Anfangs- und Endpunkt des Kreisbogens",
     .help = "I, J, K oder den Endpunkt berichtigen."},
    {.code = Code::circle_radius_zero,
     .title = "der Kreisradius ist null",
     .help = "Einen Mittelpunkt (I, J, K) abseits des Anfangspunkts oder einen Radius ungleich 0 "
             "programmieren."},
    {.code = Code::radius_and_tool_word_together,
     .title = "ein D-Wort und ein Wert für den Werkzeugradius stehen in einem Satz",
     .help = "Den Werkzeugradius in einen eigenen Satz hinter das D-Wort schreiben."},
    {.code = Code::transition_type_twice,
     .title = "in einem Satz steht mehr als eine Übergangsart (G25, G26)",
     .help = "Nur eine davon stehen lassen."},
    {.code = Code::compensation_side_twice,
     .title = "in einem Satz steht mehr als eines von G40, G41, G42",
     .help = "Nur eines davon stehen lassen."},
    {.code = Code::selection_mode_twice,
     .title = "in einem Satz steht mehr als eine Anwahlart (G138, G139, G236 bis G239)",
     .help = "Nur eine davon stehen lassen. Allein G05 darf neben einer anderen stehen."},
    {.code = Code::plane_change_while_active,
     .title = "die Ebene wechselt bei aktiver Werkzeugradiuskorrektur",
     .help = "Die Werkzeugradiuskorrektur vor G17, G18 oder G19 mit G40 und einer Bewegung in der "
             "Ebene abwählen."},
    {.code = Code::axis_link_while_active,
     .title = "eine Achskopplung ändert sich bei aktiver Werkzeugradiuskorrektur",
     .help = "Die Werkzeugradiuskorrektur vor dem Befehl mit G40 abwählen."},
    {.code = Code::preset_while_active,
     .title = "#PSET oder #PRESET steht bei aktiver Werkzeugradiuskorrektur",
     .help = "Die Werkzeugradiuskorrektur vor dem Befehl mit G40 abwählen."},
    {.code = Code::coordinate_system_while_active,
     .title = "das Koordinatensystem wechselt bei aktiver Werkzeugradiuskorrektur",
     .help = "Die Werkzeugradiuskorrektur vor dem Befehl mit G40 abwählen."},
    {.code = Code::negative_tangfeed_minimum,
     .title = "der kleinste Konturradius von #TANGFEED ist negativ",
     .help = "RMIN mit 0 oder positiv programmieren."},
    {.code = Code::center_and_radius_together,
     .title = "ein Satz gibt für einen Kreis Mittelpunkt und Radius zugleich an",
     .help = "Entweder I, J, K oder R stehen lassen."},
    {.code = Code::tangential_ignored_with_inside_corner,
     .title = "G05 wirkt unter G238 nicht und wird übergangen",
     .help = "G05 streichen oder eine andere Anwahlart nehmen."},
    {.code = Code::inside_corner_selected_while_active,
     .title =
         "G238 steht, während die Werkzeugradiuskorrektur in einer anderen Anwahlart aktiv ist",
     .help = "Die Werkzeugradiuskorrektur vor G238 mit G40 abwählen."},
    {.code = Code::mode_change_under_inside_corner,
     .title = "die Anwahlart wechselt, obwohl mit G238 angewählt wurde",
     .help = "Die Werkzeugradiuskorrektur vor dem Wechsel mit G40 abwählen."},
    {.code = Code::point_to_point_while_active,
     .title = "#PTP steht bei aktiver Werkzeugradiuskorrektur",
     .help = "Die Werkzeugradiuskorrektur vor dem Befehl mit G40 abwählen."},
    {.code = Code::circle_radii_differ,
     .title = "Anfang und Ende des Kreisbogens sind vom Mittelpunkt nicht gleich weit weg (G164)",
     .help = "I, J, K oder den Endpunkt berichtigen, oder den Mittelpunkt mit G165 korrigieren "
             "lassen."},
    {.code = Code::stretch_factor_out_of_range,
     .title = "STRETCH_FACTOR liegt nicht zwischen 1 und 9 und wird auf 1 gesetzt",
     .help = "Einen Wert von 1 bis 9 programmieren."},
    {.code = Code::spatial_circle_while_active,
     .title = "G303 steht bei aktiver Werkzeugradiuskorrektur",
     .help = "Vor G303 die Werkzeugradiuskorrektur mit G40 und einer Geraden in der Ebene "
             "abwählen."},
    {.code = Code::inverse_without_online,
     .title = "INVERSE ist ohne ONLINE gesetzt",
     .help = "INVERSE streichen; die Rückrechnung der Bahn im Setup verlangen.",
     .on_command_line = "INVERSE streichen; die Rückrechnung der Bahn schreibt --set "
                        "include_inverse_path=true --format jsonl."},
    {.code = Code::real_time_loop_while_active,
     .title = "#RT WHILE steht bei aktiver Werkzeugradiuskorrektur",
     .help = "Die Werkzeugradiuskorrektur vor dem Befehl mit G40 abwählen."},
    {.code = Code::circular_selection_block,
     .title = "die Werkzeugradiuskorrektur wird in einem Kreissatz angewählt",
     .help = "Die erste Bewegung nach G41 oder G42 als Gerade programmieren, oder mit G236 oder "
             "G237 anwählen."},
    {.code = Code::too_many_passive_blocks,
     .title =
         "bei aktiver Werkzeugradiuskorrektur folgen zu viele Sätze ohne Bewegung in der Ebene "
         "aufeinander",
     .help = "Sie vor G41 oder hinter G40 setzen, oder die Grenze anheben.",
     .on_command_line = "Sie vor G41 oder hinter G40 setzen, oder die Grenze anheben: --set "
                        "max_passive_blocks=200."},
    {.code = Code::tool_not_smaller_than_arc,
     .title = "das Werkzeug passt nicht in den Kreisbogen: sein Radius ist nicht kleiner als der "
              "des Bogens",
     .help = "Einen kleineren Fräser oder einen größeren Bogen nehmen, oder G141 mit #TRC "
             "[CONV_CIR_TO_LIN=1].",
     .on_command_line = "Einen kleineren Fräser nehmen (trc radii sagt, welcher passt) oder einen "
                        "größeren Bogen, oder G141 mit #TRC [CONV_CIR_TO_LIN=1]."},
    {.code = Code::arc_radii_differ,
     .title = "Anfangs- und Endradius des Kreisbogens sind verschieden, er hat also keine "
              "Äquidistante (G164)",
     .help = "I, J, K oder den Endpunkt berichtigen, oder den Mittelpunkt mit G165 korrigieren "
             "lassen."},
    {.code = Code::line_reversed,
     .title = "das Werkzeug passt nicht: neben dieser Geraden liefe seine Bahn rückwärts und "
              "würde die Kontur verletzen",
     .help = "Einen kleineren Fräser nehmen: SurveyRadii (trc radii) sagt, welcher passt. G141 "
             "blendet solche Sätze aus, wo es noch nicht eingeschaltet ist, und dann lässt #TRC "
             "[REMOVE_MASKED_BLOCKS=1] ganze Schleifen weg.",
     .on_command_line = "Einen kleineren Fräser nehmen: trc radii sagt, welcher passt. G141 "
                        "blendet solche Sätze aus, wo es noch nicht eingeschaltet ist, und dann "
                        "lässt #TRC [REMOVE_MASKED_BLOCKS=1] ganze Schleifen weg."},
    {.code = Code::arc_wrapped,
     .title = "das Werkzeug passt nicht: neben diesem Bogen liefe seine Bahn falsch herum und "
              "würde die Kontur verletzen",
     .help = "Einen kleineren Fräser nehmen: SurveyRadii (trc radii) sagt, welcher passt. G141 "
             "blendet solche Sätze aus, wo es noch nicht eingeschaltet ist, und dann lässt #TRC "
             "[REMOVE_MASKED_BLOCKS=1] ganze Schleifen weg.",
     .on_command_line = "Einen kleineren Fräser nehmen: trc radii sagt, welcher passt. G141 "
                        "blendet solche Sätze aus, wo es noch nicht eingeschaltet ist, und dann "
                        "lässt #TRC [REMOVE_MASKED_BLOCKS=1] ganze Schleifen weg."},
    {.code = Code::no_feed_adaptation_in_tangential_block,
     .title = "der Vorschub des G05-Satzes lässt sich nicht anpassen (G11): der Werkzeugradius ist "
              "zu groß",
     .help = "Einen kleineren Fräser, ein weiteres Anfahren oder G10 nehmen."},
    {.code = Code::selection_point_too_near,
     .title = "der Anfangspunkt der Anwahl mit G238 liegt näher an der Kontur als der "
              "Werkzeugradius",
     .help = "Weiter weg von der Kontur beginnen."},
    {.code = Code::radius_change_under_inside_corner,
     .title = "der Werkzeugradius ändert sich, obwohl mit G238 angewählt wurde",
     .help = "Die Werkzeugradiuskorrektur vor der Änderung mit G40 abwählen."},
    {.code = Code::inside_corner_angle_too_large,
     .title = "der Winkel zwischen dem Anfahrsatz von G238 und dem ersten Kontursatz ist zu groß",
     .help = "Auf der anderen Seite beginnen, oder mit G138 oder G139 anwählen."},
    {.code = Code::center_out_of_range,
     .title = "der Mittelpunkt eines Kreises liegt außerhalb des Koordinatenbereichs",
     .help = "Nach einer falschen Maßeinheit oder einem fehlenden Dezimalpunkt suchen."},
    {.code = Code::end_point_out_of_range,
     .title = "ein Endpunkt liegt außerhalb des Koordinatenbereichs",
     .help = "Nach einer falschen Maßeinheit, einem fehlenden Dezimalpunkt oder zwei Geraden mit "
             "sehr spitzem Winkel suchen."},
    {.code = Code::spatial_circle_after_deselection,
     .title = "G303 folgt auf G40 ohne eine Bewegung in der Ebene",
     .help = "Zwischen G40 und G303 eine Gerade in der Ebene programmieren."},

    {.code = Code::nc_syntax,
     .title = "der Text ist kein NC-Wort",
     .help = "Das Wort an der angegebenen Stelle berichtigen."},
    {.code = Code::nc_unknown_function,
     .title = "die G-Funktion ist nicht bekannt",
     .help = "Sie streichen; GetServerInfo nennt die bekannten.",
     .on_command_line = "Sie streichen; trc info nennt die bekannten. Wo sie den Weg nicht ändert: "
                        "--set pass_words=NAME."},
    {.code = Code::nc_unsupported,
     .title = "das Wort ändert den Weg so, dass er hier nicht verfolgt wird",
     .help = "Vor der Korrektur auflösen: Variablen, Schleifen, Unterprogramme und "
             "Koordinatenwechsel in einfache Bewegungssätze umsetzen."},
    {.code = Code::trc_option_unknown,
     .title = "das Schlüsselwort von #TRC ist nicht bekannt",
     .help = "Die Schreibweise berichtigen; GetServerInfo nennt alle Schlüsselwörter.",
     .on_command_line = "Die Schreibweise berichtigen; trc info nennt alle Schlüsselwörter."},
    {.code = Code::trc_option_out_of_range,
     .title = "der Wert eines Schlüsselworts von #TRC fehlt oder liegt außerhalb seines Bereichs",
     .help = "Einen Wert aus dem Bereich programmieren; GetServerInfo nennt alle Bereiche.",
     .on_command_line = "Einen Wert aus dem Bereich programmieren; trc info nennt alle Bereiche."},
    {.code = Code::nc_line_too_long,
     .title = "eine Zeile ist länger als die Grenze",
     .help = "Prüfen, ob das ein NC-Programm mit Zeilenenden ist, oder die Grenze anheben.",
     .on_command_line = "Prüfen, ob das ein NC-Programm mit Zeilenenden ist."},
    {.code = Code::nc_not_text,
     .title =
         "ein Zeichen gehört in kein NC-Programm: ein Steuerzeichen, kein UTF-8, oder außerhalb "
         "von Kommentaren kein ASCII",
     .help = "Es herausnehmen und das Programm als reinen Text in UTF-8 speichern; auch ASCII ist "
             "UTF-8.",
     .on_command_line = "Es herausnehmen und das Programm als reinen Text in UTF-8 speichern; auch "
                        "ASCII ist UTF-8. Kommentare in Latin-1 bleiben mit --set encoding=auto, "
                        "wie sie sind."},
    {.code = Code::nc_number,
     .title = "eine Zahl fehlt, ist falsch geschrieben oder außerhalb des Bereichs",
     .help = "Hinter den Adressbuchstaben eine Dezimalzahl schreiben; wo ein Bereich genannt ist, "
             "eine aus diesem."},
    {.code = Code::nc_unclosed,
     .title = "etwas ist geöffnet, aber nicht geschlossen",
     .help = "Die Klammer oder den Kommentar schließen, oder die fortgesetzte Zeile ergänzen."},
    {.code = Code::nc_word_twice,
     .title = "eine Adresse steht zweimal in einem Satz",
     .help = "Nur eines der beiden Wörter stehen lassen."},
    {.code = Code::nc_axis_unknown,
     .title = "die Achse ist nicht unter denen des Setups",
     .help = "Den Namen berichtigen, oder die Achse zu den mitgeführten Achsen des Setups nehmen.",
     .on_command_line = "Den Namen berichtigen, oder die mitgeführten Achsen nennen: --set "
                        "axis_names=A,B,Q."},
    {.code = Code::nc_group_twice,
     .title = "in einem Satz stehen zwei Funktionen, die einander ausschließen",
     .help = "Nur eine davon stehen lassen."},
    {.code = Code::tool_unknown,
     .title = "die Werkzeugtabelle hat dieses Werkzeug nicht",
     .help = "Das Werkzeug in die Tabelle des Setups aufnehmen: Nummer, Name und Schneide, wo das "
             "Programm sie nennt, und seinen Radius.",
     .on_command_line = "Die Tabelle mit dem Werkzeug angeben: --tools tools.csv, mit "
                        "number,name,edge,radius, soweit das Programm sie nennt; oder jedes "
                        "Werkzeug des Programms, auch das von --radius: --set "
                        "tools=NUMMER:RADIUS, einmal für jedes."},
    {.code = Code::program_empty,
     .title = "das Programm hat keinen Satz",
     .help = "Prüfen, ob es die gemeinte Datei ist und ob sie vollständig ist."},
    {.code = Code::side_behind_end,
     .title = "G41 oder G42 steht hinter dem Programmende (M02, M30, zweites %)",
     .help = "Streichen, was hinter dem Ende steht, oder es als eigenes Programm korrigieren."},
    {.code = Code::other_dialect,
     .title = "das Wort bedeutet etwas anderes in dem Dialekt, nach dem das Programm aussieht",
     .help = "Den Dialekt des Programms angeben (--dialect, `dialect` im Setup). Ist es ISG, das "
             "Wort streichen.",
     .on_command_line = "Den Dialekt des Programms angeben: --dialect fanuc, linuxcnc, sinumerik "
                        "oder heidenhain. Ist es ISG, das Wort streichen."},
    {.code = Code::block_skip_undecided,
     .title = "die Bahn hängt vom Schalter für das Ausblenden von Sätzen ab",
     .help = "Sagen, wie er steht: `block_skip` EXECUTE im Setup, wo Sätze hinter `/` ausgeführt "
             "werden, LEAVE_OUT, wo nicht.",
     .on_command_line = "Sagen, wie er steht: --set block_skip=execute, wo Sätze hinter `/` "
                        "ausgeführt werden, leave_out, wo nicht."},
    {.code = Code::turning,
     .title = "das ist ein Drehprogramm: Drehen wird hier nicht korrigiert",
     .help = "Die Schneidenradiuskorrektur der Drehmaschine überlassen."},
    {.code = Code::motion_unknown,
     .title = "in einer Kontur wird gefahren, obwohl das Programm nicht gesagt hat, ob im Vorschub "
              "oder im "
              "Eilgang",
     .help = "G01 (oder G00) vor der Kontur oder in ihrem ersten Satz programmieren."},

    {.code = Code::circle_incomplete,
     .title = "ein Kreissatz hat weder Mittelpunkt noch Radius",
     .help =
         "I, J, K oder R im Satz selbst programmieren, oder G01, wenn eine Gerade gemeint ist."},
    {.code = Code::not_available,
     .title = "die Funktion gibt es hier nicht",
     .help = "Sie streichen oder eine andere nehmen.",
     .on_command_line = "Sie streichen; trc info sagt, welche Optionen es gibt."},
    {.code = Code::deselection_without_motion,
     .title = "G41 oder G42 folgt auf G40, obwohl keine Bewegung in der Ebene von der Kontur "
              "weggeführt hat",
     .help = "Hinter G40 die Abfahrbewegung programmieren, oder G237 oder G239 nehmen."},
    {.code = Code::tool_radius_out_of_range,
     .title = "der Werkzeugradius liegt außerhalb des Bereichs",
     .help = "Die Maßeinheit prüfen: der Radius zählt in mm, unter G70 in Zoll."},
    {.code = Code::field_invalid,
     .title = "ein Wert ist keine Zahl oder außerhalb des Bereichs",
     .help = "Das genannte Wort oder Feld berichtigen."},
    {.code = Code::position_unknown,
     .title = "die Bewegung beginnt an einer Stelle, die nicht bekannt ist",
     .help = "Hinter dem Wechsel zuerst alle Achsen der Ebene absolut programmieren (G90, G00 oder "
             "G01), vor G91, Kreisen oder G41."},

    {.code = Code::selection_block_too_short,
     .title = "der Anfahrsatz oder Abfahrsatz ist kürzer, als seine Anwahlart braucht",
     .help = "Den Satz verlängern oder einen kleineren Fräser nehmen."},
    {.code = Code::tangential_start_on_tangent,
     .title = "vom Anfangspunkt führt kein Kreis tangential an die Kontur (G05)",
     .help = "Abseits der Tangente des ersten Kontursatzes beginnen."},
    {.code = Code::circular_deselection_block,
     .title = "die Werkzeugradiuskorrektur wird in einem Kreissatz abgewählt",
     .help = "Die erste Bewegung nach G40 als Gerade programmieren, oder G236 oder G237 nehmen."},
    {.code = Code::selection_without_contour,
     .title = "die Werkzeugradiuskorrektur wird an- und abgewählt, ohne dass eine Kontur "
              "dazwischen liegt; korrigiert wird nichts",
     .help = "Die Anwahl streichen, oder die Kontur vor G40 programmieren."},
    {.code = Code::ended_while_active,
     .title = "das Programm endet, bevor das Werkzeug von der Kontur weggefahren ist; die Bahn "
              "endet am letzten korrigierten Punkt",
     .help = "Vor dem Ende G40 und eine Bewegung in der Ebene programmieren."},
    {.code = Code::circular_side_change_block,
     .title = "die Seite der Werkzeugradiuskorrektur wechselt in einem Kreissatz",
     .help = "Den Satz, der zwischen G41 und G42 wechselt, als Gerade programmieren."},
    {.code = Code::side_change_without_contour,
     .title = "die Seite der Werkzeugradiuskorrektur wechselt, wo auf einer der beiden Seiten kein "
              "Kontursatz liegt",
     .help = "Zwischen G41, G42 und G40 mindestens einen Kontursatz programmieren."},
    {.code = Code::contour_not_closed,
     .title = "eine mit G238 angewählte Kontur endet nicht dort, wo sie begonnen hat",
     .help = "Die Kontur schließen, oder mit G138 oder G139 anwählen."},
    {.code = Code::last_block_full_circle,
     .title = "der letzte Satz einer mit G238 angewählten Kontur ist ein Vollkreis",
     .help = "Den Kreis teilen, oder mit einer anderen Anwahlart anwählen."},
    {.code = Code::approach_crosses_contour,
     .title = "der Anfahrsatz von G238 kreuzt einen Kontursatz",
     .help = "Auf der Seite der Kontur beginnen, auf der das Werkzeug läuft."},
    {.code = Code::side_change_under_inside_corner,
     .title = "die Seite der Werkzeugradiuskorrektur wechselt innerhalb einer mit G238 angewählten "
              "Kontur",
     .help = "Mit G40 abwählen, bevor die andere Seite angewählt wird."},
    {.code = Code::selection_too_long,
     .title = "eine Anwahl umfasst mehr Sätze, als zurückgehalten werden dürfen",
     .help = "Die Kontur teilen, oder die Grenze der Sätze je Anwahl anheben.",
     .on_command_line =
         "Die Kontur teilen, oder die Grenze anheben: --max-blocks-per-selection, bei "
         "einem Server dessen Einstellung dieses Namens."},
    {.code = Code::blocks_masked,
     .title = "Kontursätze, an die das Werkzeug nicht herankommt, sind ausgeblendet",
     .help = "Für sie einen kleineren Fräser nehmen.",
     .on_command_line = "Für sie einen kleineren Fräser nehmen: trc radii sagt, welcher an jede "
                        "Wand kommt."},
    {.code = Code::bottleneck,
     .title = "Engstelle: das Werkzeug kommt einem anderen Satz der Kontur näher als sein Radius",
     .help = "Einen kleineren Fräser nehmen oder die Kontur berichtigen.",
     .on_command_line = "Einen kleineren Fräser nehmen (trc radii sagt, welcher passt) oder die "
                        "Kontur berichtigen."},
    {.code = Code::beyond_window,
     .title = "die Kontur ist länger als das Fenster der Konturausblendung, die keine längere "
              "Schleife als dieses sieht",
     .help = "look_ahead_blocks anheben, oder auf 0 setzen für die ganze Kontur.",
     .on_command_line = "Die ganze Kontur ansehen: --set look_ahead_blocks=0."},
    {.code = Code::clearance_violated,
     .title = "nachgemessen kommt die korrigierte Bahn der Kontur näher als der Werkzeugradius",
     .help = "Nicht fertigen. Einen kleineren Fräser nehmen oder die Kontur berichtigen, oder die "
             "Schleifen durch G141 mit REMOVE_MASKED_BLOCKS herausnehmen lassen. Mehrere Konturen "
             "brauchen G40 dazwischen.",
     .on_command_line = "Nicht fertigen. Einen kleineren Fräser nehmen (trc radii sagt, welcher "
                        "passt) oder die Kontur berichtigen, oder die Schleifen durch G141 mit "
                        "REMOVE_MASKED_BLOCKS herausnehmen lassen. Mehrere Konturen brauchen G40 "
                        "dazwischen."},
    {.code = Code::side_changed_at_corner,
     .title = "die Seite wechselt, wo die Bewegung nicht umkehrt (REVERSE): das Werkzeug kreuzt "
              "die Ecke näher als sein Radius",
     .help = "Die Bewegung genau dort umkehren lassen, oder vor der anderen Seite mit G40 "
             "abwählen."},
    {.code = Code::most_left_out,
     .title = "von der Kontur bliebe mehr stehen als erlaubt",
     .help = "Einen kleineren Fräser nehmen: SurveyRadii (trc radii) sagt, welcher passt. Ist ein "
             "Satz im Weg, der keinen Werkstoff begrenzt, ihn als Anfahr- oder Abfahrsatz "
             "kennzeichnen, oder An- und Abfahrwege größer machen als das Werkzeug. Wo das Stück "
             "wegbleiben darf, max_masked_share anheben.",
     .on_command_line = "Einen kleineren Fräser nehmen: trc radii sagt, welcher passt. Ist ein "
                        "Satz im Weg, der keinen Werkstoff begrenzt, An- und Abfahrwege größer "
                        "machen als das Werkzeug, oder sagen, wie viele Sätze an- und abfahren: "
                        "--set leads=blocks:1,1. Wo das Stück wegbleiben darf: --set "
                        "max_masked_share=1."},
    {.code = Code::no_tool_radius,
     .title = "die Werkzeugradiuskorrektur wird angewählt, obwohl kein Werkzeugradius angegeben "
              "ist",
     .help = "Ein D-Wort oder T-Wort programmieren, dessen Radius die Werkzeugtabelle des Setups "
             "hat, oder tool_radius im Setup angeben.",
     .on_command_line = "Den Radius angeben: --radius 5, oder die der Werkzeuge, die das Programm "
                        "nennt: --tools tools.csv, --set tools=1:5, einmal für jedes."},
    {.code = Code::tool_radius_zero,
     .title = "der Werkzeugradius ist mit 0 angegeben: korrigiert wird nichts",
     .help = "Prüfen, ob der Radius 0 sein soll."},
    {.code = Code::center_corrected,
     .title = "der Kreismittelpunkt passt nicht zu Anfangs- und Endpunkt und wird verschoben "
              "(G165)",
     .help = "I, J, K oder den Endpunkt berichtigen; der Bogen läuft um den verschobenen "
             "Mittelpunkt."},
    {.code = Code::wear_too_large,
     .title = "der Verschleiß des Werkzeugs ist größer, als max_wear erlaubt",
     .help = "Ist das der ganze Radius? Mit nominal_radius ist der Werkzeugradius nur der "
             "Unterschied zu diesem: ihn angeben, oder max_wear anheben.",
     .on_command_line = "Ist das der ganze Radius? Mit nominal_radius ist der Werkzeugradius nur "
                        "der Unterschied zu diesem: ihn angeben, oder mehr zulassen: --set "
                        "max_wear=2."},
    {.code = Code::wear_not_deeper,
     .title = "das Werkzeug ist kleiner als das Nennwerkzeug, aber die verschobene "
              "Mittelpunktsbahn führt es nicht tiefer in diese Innenecke",
     .help = "Wo die Ecke schärfer werden soll, die Kontur selbst mit dem ganzen Radius "
             "korrigieren."},
    {.code = Code::tool_radius_contradicts,
     .title = "das Programm gibt einem Werkzeug einen anderen Radius als das Setup, und der "
              "des Programms gilt",
     .help = "Prüfen, welches Werkzeug in der Maschine ist, und Werkzeugtabelle oder Programm "
             "berichtigen."},
    {.code = Code::tool_may_have_changed,
     .title = "seit der Angabe des Radius, der weiter gilt, kann das Werkzeug gewechselt worden "
              "sein",
     .help = "Dahinter das T- oder D-Wort des Werkzeugs programmieren, mit seinem Radius in der "
             "Werkzeugtabelle, oder die Teile des Programms einzeln korrigieren. Was kein Werkzeug "
             "wechselt, wird in pass_words angegeben.",
     .on_command_line = "Dahinter das T- oder D-Wort des Werkzeugs programmieren, mit seinem "
                        "Radius in der Werkzeugtabelle, oder die Teile des Programms einzeln "
                        "korrigieren. Was kein Werkzeug wechselt: --set pass_words=NAME."},
    {.code = Code::call_taken_as_harmless,
     .title =
         "der Text eines aufgerufenen Unterprogramms fehlt: Ebene, Einheit, G25 oder G26, G140 "
         "oder G141 und #TRC gelten dahinter als unverändert",
     .help =
         "Seinen Text in `subprograms` angeben, oder hinter dem Aufruf programmieren, was gelten "
         "soll. Ein Name, der nichts ändert, wird in pass_words angegeben.",
     .on_command_line = "Seine Datei angeben (--subprograms FILE oder der Ordner), oder hinter dem "
                        "Aufruf programmieren, was gelten soll. Ein Name, der nichts ändert: "
                        "--set pass_words=NAME."},
    {.code = Code::machine_compensates,
     .title = "diesen Zyklus korrigiert die Maschine selbst, mit ihrem eigenen D-Register",
     .help = "Den Radius in diesem Register stehen lassen, ohne ihn würde der Zyklus zu groß "
             "gefräst, oder die Mittelpunktsbahn mit D0 programmieren."},
    {.code = Code::given_value_kept,
     .title = "eine Variable, die die Steuerung behält, bekommt eine Zahl, die aus Werten der "
              "Maschine berechnet ist, wie sie angegeben sind",
     .help = "Das Ergebnis gilt nur für diese Werte. Einen Zähler in einer einzigen Zuweisung aus "
             "ihm selbst erhöhen: diese bleibt stehen. Oder für jeden Wert neu korrigieren."},
    {.code = Code::way_crosses_contour,
     .title = "der An- oder Abfahrweg führt durch die Kontur",
     .help = "Auf der Seite der Kontur beginnen und enden, auf der das Werkzeug läuft, oder das "
             "Werkzeug abheben, bevor es kreuzt."},
    {.code = Code::line_beyond_control,
     .title =
         "so lang, wie diese Zeile im Ergebnis würde, nimmt die Steuerung keine an, oder keine "
         "Zahl mit so vielen Stellen",
     .help = "Die Wörter der Zeile aufteilen oder ihren Kommentar kürzen; ist es eine Zahl, mit "
             "weniger Nachkommastellen schreiben (decimals).",
     .on_command_line = "Die Wörter der Zeile aufteilen oder ihren Kommentar kürzen; ist es eine "
                        "Zahl, mit --decimals weniger Nachkommastellen schreiben."},
    {.code = Code::selection_stands_still,
     .title = "die Bewegung, die die WRK anwählt, bewegt nichts, so dass erst die nächste anfährt",
     .help = "Neben der Kontur beginnen und mit einer eigenen Bewegung anfahren, sonst fährt das "
             "Werkzeug in die erste Wand; oder die Wörter weglassen, die nichts bewegen."},
    {.code = Code::too_many_lines_executed,
     .title = "es werden mehr Zeilen ausgeführt als erlaubt",
     .help = "Nach einer Schleife suchen, die nie endet. Ein Programm, das so lang sein soll, "
             "braucht ein größeres max_executed_lines.",
     .on_command_line = "Nach einer Schleife suchen, die nie endet. Ist das Programm so lang "
                        "gemeint: --max-executed-lines."},
    {.code = Code::calls_too_deep,
     .title = "Unterprogramme sind zu tief verschachtelt",
     .help = "Nach einem Unterprogramm suchen, das sich selbst aufruft. Keine Steuerung erlaubt "
             "mehr als einige Ebenen."},
    {.code = Code::variable_unset,
     .title = "eine Variable wird gelesen, die keinen Wert hat",
     .help = "Sie im Programm setzen oder ihren Wert in `variables` des Setups angeben.",
     .on_command_line = "Sie im Programm setzen oder ihren Wert angeben: --variable NAME=VALUE."},
    {.code = Code::division_by_zero,
     .title = "eine Zahl wird durch null geteilt",
     .help = "Die Werte der Variablen im Teiler prüfen."},
    {.code = Code::jump_target_unknown,
     .title = "das Ziel eines Sprungs ist nicht da, oder nicht das einzige, das gemeint sein kann",
     .help = "Die Nummer oder die Marke berichtigen. Sie muss im selben Programm stehen; in "
             "einem Programm von mehr als 64 KiB reichen Sprünge nur bis zur ersten Zeile "
             "zurück, die rechnet."},
    {.code = Code::subprogram_unknown,
     .title = "ein Unterprogramm wird aufgerufen, das nicht da ist",
     .help = "Es in denselben Text stellen, wo der Dialekt es hat (ISG: vor das Programm, hinter "
             "%L NAME), oder seinen Text in `subprograms` des Setups angeben.",
     .on_command_line = "Es in dieselbe Datei stellen, wo der Dialekt es hat (ISG: vor das "
                        "Programm, hinter %L NAME), oder seine Datei angeben: --subprograms FILE, "
                        "oder den Ordner."},
    {.code = Code::machine_state,
     .title = "das Programm fragt nach einem Zustand, den nur die Maschine kennt, oder ändert ihn",
     .help = "Wo sein Wert bekannt ist, ihn in `variables` des Setups angeben; sonst die Zeile "
             "herausnehmen.",
     .on_command_line = "Wo sein Wert bekannt ist, ihn angeben: --variable NAME=VALUE; sonst die "
                        "Zeile herausnehmen."},
    {.code = Code::expression_invalid,
     .title = "ein Ausdruck oder eine Anweisung ist nicht so geschrieben, wie die Steuerung sie "
              "liest",
     .help = "Mit dem Handbuch der Steuerung vergleichen: Klammern [ ] paarweise, ein Vergleich "
             "in jedem Paar."},
    {.code = Code::value_invalid,
     .title = "ein berechneter Wert ist dort nicht möglich",
     .help = "Die Werte der Variablen prüfen: eine Funktion nimmt nur gewisse Werte, und eine "
             "Nummer oder ein Index ist ganzzahlig und nicht negativ."},
    {.code = Code::block_structure,
     .title = "der Anfang oder das Ende einer Schleife, einer Verzweigung oder eines "
              "Unterprogramms fehlt",
     .help = "Beide schreiben, mit derselben Nummer oder demselben Namen; ein Unterprogramm mit "
             "seinem Rücksprung beenden."},
    {.code = Code::computing_text_too_long,
     .title = "der Text eines Programms, das rechnet, ist zu lang, um ihn vorzuhalten",
     .help = "Das Programm teilen, oder den Teil, der nicht rechnet, ein eigenes Programm sein "
             "lassen."},
    {.code = Code::program_alarm,
     .title = "das Programm selbst löst einen Alarm aus",
     .help = "Sein Text sagt, was das Programm verlangt; die Zeilen davor ansehen."},
});

static_assert(std::ranges::is_sorted(rows, {}, &GermanRow::code));

}  // namespace

std::span<const GermanRow> german_rows() { return rows; }

const GermanRow& german_row_of(Code code) {
  const auto* const found = std::ranges::lower_bound(rows, code, {}, &GermanRow::code);
  if (found != rows.end() && found->code == code) return *found;
  // An unknown code, as in english_row_of().
  static constexpr GermanRow unknown{
      .code = Code{},
      .title = "ein Fehler, dessen Nummer nicht in der Tabelle steht",
      .help = "Dieses Programm aktualisieren."};
  return unknown;
}

}  // namespace trc

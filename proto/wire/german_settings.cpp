#include "proto/wire/german_settings.h"

#include <algorithm>
#include <array>

namespace trc::wire {
namespace {

struct German {
  std::string_view english;
  std::string_view german;
};

// Rows by the key of the setting.
constexpr auto meanings = std::to_array<German>({
    {"plane", "die Ebene der Kontur"},
    {"start_position", "wo das Werkzeug steht; Koordinaten, die fehlen, sind 0"},
    {"start_position.x", "wo das Werkzeug in X steht"},
    {"start_position.y", "wo das Werkzeug in Y steht"},
    {"start_position.z", "wo das Werkzeug in Z steht"},
    {"tool_radius",
     "die Größe des Werkzeugs; negativ: auf der anderen Seite; mit nominal_radius, was das "
     "Werkzeug von diesem abweicht; ohne ihn braucht eine Anwahl ein D- oder T-Wort"},
    {"selection_mode",
     "wie das Werkzeug an die Bahn heran und von ihr weg fährt; fanuc, linuxcnc und sinumerik "
     "beginnen mit direct"},
    {"transition",
     "was an Außenecken eingefügt wird; linuxcnc und sinumerik beginnen mit circular"},
    {"contour_masking",
     "was aus Kontur wird, die das Werkzeug nicht fräsen kann: off hält dort an, on lässt sie aus"},
    {"feed_adaptation",
     "wo der programmierte Vorschub gilt: off an der Werkzeugmitte, on an der Kontur; sinumerik "
     "beginnt mit on"},
    {"tangfeed_min_radius",
     "kleinster Radius von Bögen, auf denen G11 den Vorschub anpasst; 0: alle"},
    {"min_feed_factor", "kleinster Faktor, den G11 auf einen Vorschub gibt"},
    {"circle_center_mode.reference", "ab wo Kreismittelpunkte I, J, K zählen"},
    {"circle_center_mode.correction",
     "ob der Mittelpunkt verschoben wird, wo er nicht zum Endpunkt passt"},
    {"circle_center_mode.max_shift", "G165: größte Verschiebung eines Mittelpunkts, sonst 20035"},
    {"circle_center_mode.max_shift_factor",
     "G165: größte Verschiebung eines Mittelpunkts als Anteil des Radius"},
    {"circle_center_mode.max_radius_difference",
     "G164: größter Unterschied von Anfangs- und Endradius, sonst 21758"},
    {"circle_center_mode.max_radius_difference_factor",
     "G164: größter Unterschied beider Radien als Anteil des Radius"},
    {"circle_center_mode.warn_shift",
     "G165: eine größere Verschiebung eines Mittelpunkts wird gemeldet (900221)"},
    {"options.split.measure", "SPLIT: nach dem Weg einer Achse, nach der Bahn oder gar nicht"},
    {"options.split.place", "SPLIT: bei der Anwahl, bei der Abwahl oder bei beiden"},
    {"options.split.axis", "SPLIT: die Achse, 1 für X, 2 für Y, 3 für Z"},
    {"look_ahead_blocks",
     "Fenster der Konturausblendung in Sätzen; 0: alles zwischen An- und Abwahl"},
    {"implicit_contour_masking", "Konturverletzungen suchen wie G141, und bei der ersten anhalten"},
    {"kerf_method",
     "wie KERF_MASKING die Punkte findet, die es verschiebt: nur mit Geraden, oder auch mit Bögen"},
    {"axis_names", "die Achsen neben X, Y und Z, höchstens 32"},
    {"max_passive_blocks",
     "höchstens so viele Sätze ohne Bewegung hintereinander (90011); außer bei isg: 10000"},
    {"response_layout", "wie Sätze vom Server kommen; beides enthält dasselbe"},
    {"include_inverse_path", "auch die Kontur, die aus der Bahn zurückgerechnet wird"},
    {"client_tag", "ein Wort für das Protokoll des Servers, höchstens 64 druckbare Zeichen"},
    {"want_resume_tokens",
     "das verlangen, womit ein verlorener Strom weitergeht; trc tut es selbst"},
    {"verify",
     "die Bahn nachmessen: report warnt, was zu nahe kommt (900216), enforce lehnt es ab; "
     "compensate und plot melden"},
    {"leads", "welche Sätze einer Kontur an- und abfahren und keinen Werkstoff begrenzen"},
    {"leads.find", "wie An- und Abfahrsätze gefunden werden"},
    {"leads.blocks_in", "Sätze hinter dem Anfahrsatz, die noch anfahren, mit leads.find=blocks"},
    {"leads.blocks_out", "Sätze vor dem Abfahrsatz, die schon abfahren, mit leads.find=blocks"},
    {"closing_tolerance", "bis hierhin trifft das Ende einer Kontur ihren Anfang"},
    {"max_masked_share",
     "größter Anteil der Wand zwischen An- und Abwahl, der an einem Stück wegbleiben darf "
     "(900218)"},
    {"input_resolution", "wie fein das Programm geschrieben ist; weniger gilt als Berührung"},
    {"allowance", "Aufmaß, das am Teil bleibt; negativ: schneidet tiefer"},
    {"nominal_radius",
     "das Werkzeug, dessen Mittelpunktsbahn das Programm ist; ohne ihn ist das Programm die "
     "Kontur"},
    {"max_wear", "ein größerer Verschleiß wird abgelehnt (900222)"},
    {"wear", "um was das Werkzeug größer ist; negativ: abgenutzt; max_wear lässt mehr als 1 zu"},
    {"language", "der Meldungen, en oder de"},
    {"block_skip",
     "Zeilen hinter /, wie der Schalter der Maschine steht: execute aus, leave_out ein; refuse "
     "lehnt ab, was davon abhängt (900017)"},
    {"pass_words",
     "hier unbekannte Wörter, die über den Weg nichts sagen, wie POPEN,G777: sie bleiben, auch in "
     "einer Kontur"},
    {"encoding",
     "Bytes in Kommentaren: utf8 allein (900007), latin1 und auto beliebige; isg utf8, sonst auto"},
    {"renumber", "die Sätze neu nummerieren, auch die eingefügten"},
    {"max_executed_lines",
     "so viele Zeilen führt ein Programm mit Schleifen und Aufrufen höchstens aus (900301)"},
    {"variables", "was Variablen enthalten, die das Programm nicht selbst setzt"},
    {"tools", "die Werkzeuge der D-Wörter, und der T-Wörter in einem Programm ohne D"},
    {"options.conv_cir_to_lin",
     "Bögen, für die das Werkzeug zu groß ist, werden Geraden (mit G141)"},
    {"options.kerf_masking",
     "Punkte in Kerben, in die das Werkzeug nicht kommt, werden verschoben"},
    {"options.reverse", "die Seite wechselt an Umkehrpunkten ohne Zwischensatz"},
    {"options.ignore_cont_damage", "Konturverletzungen halten nicht an"},
    {"options.remove_masked_blocks", "Konturschleifen werden entfernt (mit G141)"},
    {"options.ext_angle_block_intersection", "bis 181 Grad wird nichts eingefügt"},
    {"options.g236_lin", "G236 fügt zwischen 90 und 180 Grad eine Gerade statt eines Bogens ein"},
    {"options.stretch_factor", "größte Verlängerung eines Satzes, in Werkzeugradien"},
    {"options.tangential_limit", "Knicke bis dahin gelten als tangential"},
    {"options.perpendicular_radius_change", "ein neuer Radius wirkt sofort, quer zur Kontur"},
    {"options.gen_cir_block_in_corner", "Innenecken erhalten einen Kreis mit Radius 0"},
    {"options.suppress_trc", "nur KERF_MASKING wirkt, nichts wird versetzt"},
    {"options.inverse", "braucht ONLINE, ohne es 22125"},
    {"options.online", "Korrektur eines Radius, der sich beim Bearbeiten ändert"},
    {"options.online_by_vector", "ONLINE für einen geneigten Draht"},
    {"options.split.dist_seg1", "SPLIT: Länge des ersten Abschnitts"},
    {"options.split.feed_seg1", "SPLIT: Vorschub des ersten Abschnitts"},
    {"options.split.dist_seg2", "SPLIT: Länge des zweiten Abschnitts"},
    {"options.split.feed_seg2", "SPLIT: Vorschub des zweiten Abschnitts"},
});

// Kinds of values, and their units.
constexpr auto words = std::to_array<German>({
    {"a number", "eine Zahl"},
    {"a whole number", "eine ganze Zahl"},
    {"true or false", "true oder false"},
    {"text", "Text"},
    {"x,y,z in mm", "x,y,z in mm"},
    {"names with commas between", "Namen mit Kommas dazwischen"},
    {"names with their values, as in #500=12.5,#501=3",
     "Namen mit ihren Werten, wie #500=12.5,#501=3"},
    {"auto, none or blocks:IN,OUT", "auto, none oder blocks:EIN,AUS"},
    {"the tool table, number of the D or T word:radius in mm, as in 1:5,2:3.5, or with the wear "
     "too, as in 1:5:-0.02; a name stands in quotes, an edge after a slash, as in 7\"ROUGH\"/2:5",
     "die Werkzeugtabelle, Nummer des D- oder T-Worts:Radius in mm, wie 1:5,2:3.5, oder auch mit "
     "dem Verschleiß, wie 1:5:-0.02; ein Name steht in Anführungszeichen, eine Schneide hinter "
     "einem Strich, wie 7\"ROUGH\"/2:5"},
    {"degrees", "Grad"},
});

template <class Rows>
std::string_view german_of(const Rows& rows, std::string_view english) {
  const auto* const row = std::ranges::find(rows, english, &German::english);
  return row == rows.end() ? std::string_view() : row->german;
}

}  // namespace

std::string_view german_meaning_of(std::string_view key) { return german_of(meanings, key); }

std::string_view german_values_of(std::string_view values) {
  const std::string_view found = german_of(words, values);
  return found.empty() ? values : found;
}

}  // namespace trc::wire

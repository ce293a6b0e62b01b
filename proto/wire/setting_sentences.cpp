#include "proto/wire/setting_sentences.h"

#include <array>

namespace trc::wire {
namespace {

constexpr auto sentences = std::to_array<Sentence>({
    {"{} is no setting; write key=value", "{} ist keine Einstellung; NAME=WERT schreiben"},
    {"{} is no value; write NAME=VALUE", "{} ist kein Wert; NAME=WERT schreiben"},
    {"{}: {} is not possible; it takes {}; write {}, with a decimal point",
     "{}: {} ist nicht möglich; es nimmt {}; {} schreiben, mit Dezimalpunkt"},
    {"{}: {} is not possible; it takes {}", "{}: {} ist nicht möglich; es nimmt {}"},
    {"{} is not possible; it takes {}", "{} ist nicht möglich; es nimmt {}"},
    {"{} may be {} or {}; write the whole key",
     "{} kann {} oder {} sein; den ganzen Namen schreiben"},
    {"{} is no D or T word with its radius in mm, as in {}, or with its wear too, as in {}; commas "
     "separate tools, decimals have a point",
     "{} ist kein D- oder T-Wort mit seinem Radius in mm, wie in {}, oder dazu seinem Verschleiß, "
     "wie in {}; Kommas trennen Werkzeuge, Dezimalstellen haben einen Punkt"},
    {"{} is no D or T word with its radius in mm, as in {}, or with its wear too, as in {}",
     "{} ist kein D- oder T-Wort mit seinem Radius in mm, wie in {}, oder dazu seinem Verschleiß, "
     "wie in {}"},
    {"{} is no from:to:step", "{} ist kein von:bis:Schritt"},
    {"{}: is {}, allowed is above {} to {}", "{}: ist {}, erlaubt ist über {} bis {}"},
    {"{}: is {}, allowed is {} to {}", "{}: ist {}, erlaubt ist {} bis {}"},
    {"{}: is {}, which the enum has not", "{}: ist {}, was es nicht gibt"},
    {"{}: has {} entries, allowed are {}", "{}: hat {} Einträge, erlaubt sind {}"},
    {"{}: has more than {} entries", "{}: hat mehr als {} Einträge"},
    {"{}: names {}, as subprograms do", "{}: nennt {} wie subprograms"},
    {"{}: has a name that is not 1 to {} bytes long",
     "{}: hat einen Namen, der nicht 1 bis {} Byte lang ist"},
    {"{}: is not a letter followed by up to 15 letters, digits or '_'",
     "{}: ist kein Buchstabe mit bis zu 15 weiteren Buchstaben, Ziffern oder '_'"},
    {"{}: names the axis {} a second time", "{}: nennt die Achse {} ein zweites Mal"},
    {"{}: names the tool {} a second time", "{}: nennt das Werkzeug {} ein zweites Mal"},
    {"{}: is the name of another tool", "{}: ist der Name eines anderen Werkzeugs"},
    {"{}: is longer than {} bytes", "{}: ist länger als {} Byte"},
    {"{}: counts blocks, which only FIND_BLOCKS does", "{}: zählt Sätze, was nur FIND_BLOCKS tut"},
    {"{}: is not at most 64 bytes of printable ASCII",
     "{}: sind nicht höchstens 64 Byte druckbares ASCII"},
    {"{}: is neither en nor de", "{}: ist weder en noch de"},
    {"{}: is no name and no function in capitals, such as SOFTA or G777",
     "{}: ist kein Name und keine Funktion in Großbuchstaben, wie SOFTA oder G777"},
    {"{}: {} is known", "{}: {} ist bekannt"},
    {"{}: {} is no function", "{}: {} ist keine Funktion"},
    {"{}: {} is the word of an address", "{}: {} ist das Wort einer Adresse"},
    {"{}: {} names axes", "{}: {} nennt Achsen"},
    {"{}: {} is no name and no function in capitals, such as SOFTA or G777",
     "{}: {} ist kein Name und keine Funktion in Großbuchstaben, wie SOFTA oder G777"},
    {"{}: stands there a second time", "{}: steht ein zweites Mal da"},
    {"{}: are more than {} radii", "{}: sind mehr als {} Radien"},
    {"{}: are more than {} with the range", "{}: sind mit dem Bereich mehr als {}"},
    {"{}: is empty, and the largest one is not asked for",
     "{}: ist leer, und nach dem größten wird nicht gefragt"},
    {"{}: is missing", "{}: fehlt"},
    {"{}: is not available, only {} is allowed", "{}: gibt es hier nicht, nur {} ist erlaubt"},
    // JSON.
    {"{}: there is no such field", "{}: dieses Feld gibt es nicht"},
    {"{}: is given more than once", "{}: ist mehrmals angegeben"},
    {"{}: is null, where a list has values", "{}: ist null, wo eine Liste Werte hat"},
    {"{}: is a list within a list", "{}: ist eine Liste in einer Liste"},
    {"' stands where JSON has \"", "' steht, wo JSON \" hat"},
    {"{}: it takes one value, no list", "{}: es nimmt einen Wert, keine Liste"},
    {"{}: it takes one of its kinds, not two", "{}: es nimmt eine seiner Arten, nicht zwei"},
    {"{}: it takes one value, no object", "{}: es nimmt einen Wert, kein Objekt"},
    {"it must be an object in { }", "es muss ein Objekt in { } sein"},
    {"it is no JSON", "es ist kein JSON"},
    {"line {}, column {}: {}", "Zeile {}, Spalte {}: {}"},
    {"at {}: {}", "bei {}: {}"},
    {"the text ends too early", "der Text endet zu früh"},
    {"the closing quote is missing", "das schließende Anführungszeichen fehlt"},
    {"the name of a field in quotes, or } is expected",
     "hier gehört der Name eines Felds in Anführungszeichen hin, oder }"},
    {"a colon is expected behind the name", "hinter den Namen gehört ein Doppelpunkt"},
    {"a comma or ] is expected", "hier gehört ein Komma oder ] hin"},
    {"a comma or } is expected", "hier gehört ein Komma oder } hin"},
    {"a value is expected", "hier gehört ein Wert hin"},
    {"this is no value", "das ist kein Wert"},
    {"this is no number", "das ist keine Zahl"},
    {"this number is too large", "diese Zahl ist zu groß"},
    {"something stands behind the end", "hinter dem Ende steht noch etwas"},
    {"this is no UTF-8", "das ist kein UTF-8"},
    {"this is no escape sequence", "das ist keine Escape-Folge"},
    {"it is nested too deeply", "es ist zu tief verschachtelt"},
    {"an object in { }", "ein Objekt in { }"},
    {"text in Base64", "Text in Base64"},
    // What values are.
    {"a number", "eine Zahl"},
    {"a whole number", "eine ganze Zahl"},
    {"true or false", "true oder false"},
    {"text", "Text"},
    {"names with commas between", "Namen mit Kommas dazwischen"},
    {"auto, none or blocks:IN,OUT", "auto, none oder blocks:EIN,AUS"},
    {"3,5,8 or 3:8:0.5, mm", "3,5,8 oder 3:8:0.5, mm"},
});

}  // namespace

std::span<const Sentence> setting_sentences() { return sentences; }

}  // namespace trc::wire

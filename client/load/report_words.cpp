#include "client/load/report_words.h"

#include <array>

#include "core/messages/sentences.h"

namespace trc::load {
namespace {

constexpr auto sentences = std::to_array<Sentence>({
    // What was run.
    {"open loop, {} streams/s, at most {} at once",
     "offener Kreis, {} Streams/s, höchstens {} zugleich"},
    {"closed loop, {} streams at once", "geschlossener Kreis, {} Streams zugleich"},
    {"each of {} lines, {} a batch, {}, {}", "je {} Zeilen, {} je Nachricht, {}, {}"},
    {"each of {} blocks, {} a batch, {}, {}", "je {} Sätze, {} je Nachricht, {}, {}"},
    {"{} connections", "{} Verbindungen"},
    {"{} connection", "{} Verbindung"},
    {"server in this process", "Server in diesem Prozess"},
    {"server {}", "Server {}"},
    // Names of the rows.
    {"measured", "gemessen"},
    {"blocks/s", "Sätze/s"},
    {"streams/s", "Streams/s"},
    {"bytes/block", "Byte/Satz"},
    {"first output", "erste Antwort"},
    {"batch", "Nachricht"},
    {"stream", "Stream"},
    {"errors", "Fehler"},
    {"verified", "verglichen"},
    {"streams", "Streams"},
    {"server", "Server"},
    {"memory", "Speicher"},
    {"this program", "dieses trc"},
    // Contents of the rows.
    {"none", "keine"},
    {"{} s, interrupted, at most {} streams open", "{} s, abgebrochen, höchstens {} Streams offen"},
    {"{} s, at most {} streams open", "{} s, höchstens {} Streams offen"},
    {"{} in, {} out", "{} hinein, {} heraus"},
    {"{} sent, {} received", "{} gesendet, {} empfangen"},
    {"{} million", "{} Millionen"},
    {"{} streams, bit for bit the core's", "{} Streams, Bit für Bit wie der Kern"},
    {"{} of {} streams DIFFER; stream {}: {}", "{} von {} Streams WEICHEN AB; Stream {}: {}"},
    {"what follows {} blocks is not what the core gives",
     "was auf {} Sätze folgt, ist nicht das des Kerns"},
    {"what follows {} bytes is not what the core gives",
     "was auf {} Byte folgt, ist nicht das des Kerns"},
    {"{} cancelled on purpose", "{} mit Absicht abgebrochen"},
    {"{} read slowly", "{} langsam gelesen"},
    {"{} unfinished when the time was over", "{} nicht fertig, als die Zeit um war"},
    {"not on this machine, or not to be looked at",
     "nicht auf diesem Rechner, oder nicht zu beobachten"},
    {"process {}", "Prozess {}"},
    {"{} ns CPU a block ({} in the kernel)", "{} ns CPU je Satz ({} im Betriebssystem)"},
    {"{} ns CPU a block", "{} ns CPU je Satz"},
    {"{} % of a core", "{} % eines Kerns"},
    {"{} MiB at first, {} after a second, then {} to {}",
     "{} MiB am Anfang, {} nach einer Sekunde, dann {} bis {}"},
    {"at most {} ms behind its schedule", "höchstens {} ms hinter seinem Plan"},
});

}  // namespace

std::string said(std::string_view english, Language language) {
  return language == Language::german ? translated(english, {sentences}) : std::string(english);
}

}  // namespace trc::load

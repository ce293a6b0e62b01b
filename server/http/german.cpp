#include "server/http/german.h"

#include <array>
#include <string>
#include <string_view>

#include "core/messages/sentences.h"
#include "proto/wire/setting_sentences.h"
#include "server/rpc/status.h"

namespace trc::server::http {
namespace {

constexpr auto sentences = std::to_array<Sentence>({
    // Titles for the codes of gRPC.
    {"The request has a value that cannot be taken", "Ein Wert der Anfrage ist nicht möglich"},
    {"The request cannot be taken as it is", "Die Anfrage ist so nicht möglich"},
    {"The request is out of sequence", "Die Anfrage ist nicht an der Reihe"},
    {"The request was not complete in time", "Die Anfrage war nicht rechtzeitig vollständig"},
    {"This client is not allowed", "Dieser Client ist nicht zugelassen"},
    {"This client is not known", "Dieser Client ist nicht bekannt"},
    {"There is no such thing", "Das gibt es nicht"},
    {"There is no such method", "Diese Methode gibt es nicht"},
    {"A limit of the server is reached", "Eine Grenze des Servers ist erreicht"},
    {"The server takes no work at the moment", "Der Server nimmt gerade keine Arbeit an"},
    {"The work was not done in time", "Die Arbeit war nicht rechtzeitig fertig"},
    {"The server has failed", "Der Server hat versagt"},
    // Paths, methods and callers.
    {"There is nothing at this path", "Unter diesem Pfad gibt es nichts"},
    {"see /v1/openapi.json for what there is", "was es gibt, steht in /v1/openapi.json"},
    {"there is no such RPC; {} has {}", "diesen RPC gibt es nicht; {} hat {}"},
    {"the page has no such file", "die Seite hat keine solche Datei"},
    {"no program is offered under this name", "unter diesem Namen wird kein Programm angeboten"},
    {"This method is not possible here", "Diese Methode ist hier nicht möglich"},
    {"possible are {}", "möglich sind {}"},
    {"This server is for this machine", "Dieser Server ist für diesen Rechner da"},
    {"the Host header must be localhost, 127.0.0.1 or [::1]; a proxy has to send one of them, or "
     "http-listen has to be an address that other machines can reach",
     "der Kopf Host muss localhost, 127.0.0.1 oder [::1] sein; ein Proxy muss einen davon senden, "
     "oder http-listen muss eine Adresse sein, die andere Rechner erreichen"},
    {"This server is not the one that is meant", "Dieser Server ist nicht der gemeinte"},
    {"targets begin with {}:// here", "hier beginnen Adressen mit {}://"},
    {"Pages of this origin may not use the server",
     "Seiten dieser Herkunft dürfen den Server nicht benutzen"},
    {"the setting http-cors-origins does not name it",
     "die Einstellung http-cors-origins nennt sie nicht"},
    // Heads and bodies.
    {"Compressed bodies are not taken", "Komprimierte Inhalte werden nicht angenommen"},
    {"send the body without Content-Encoding", "den Inhalt ohne Content-Encoding senden"},
    {"Bodies are taken in UTF-8", "Inhalte werden in UTF-8 angenommen"},
    {"send the body with charset=utf-8", "den Inhalt mit charset=utf-8 senden"},
    {"The timeout cannot be taken", "Diese Frist ist nicht möglich"},
    {"Connect-Timeout-Ms must be a whole number of at most ten digits",
     "Connect-Timeout-Ms muss eine ganze Zahl mit höchstens zehn Ziffern sein"},
    {"A header that may come once comes twice", "Ein Kopf, der einmal kommen darf, kommt zweimal"},
    {"The request has no Host header", "Die Anfrage hat keinen Kopf Host"},
    {"HTTP/1.1 asks for one", "HTTP/1.1 verlangt ihn"},
    {"This is not HTTP", "Das ist kein HTTP"},
    {"Content-Length must be one whole number", "Content-Length muss eine ganze Zahl sein"},
    {"The transfer encoding is not known", "Diese Transfer-Encoding ist nicht bekannt"},
    {"a body comes with Content-Length or with Transfer-Encoding: chunked",
     "ein Inhalt kommt mit Content-Length oder mit Transfer-Encoding: chunked"},
    {"The target of the request is not one", "Das Ziel der Anfrage ist keines"},
    {"a # in it is sent as %23", "ein # darin wird als %23 gesendet"},
    {"The expectation is not known", "Diese Erwartung (Expect) ist nicht bekannt"},
    {"only 100-continue is met", "erfüllt wird nur 100-continue"},
    {"The head of the request is too large", "Der Kopf der Anfrage ist zu groß"},
    {"The trailer of the request is too large", "Der Nachspann der Anfrage ist zu groß"},
    {"The body of the request is too large", "Der Inhalt der Anfrage ist zu groß"},
    {"none is taken here", "hier wird keiner angenommen"},
    {"at most {} bytes are taken here (http-max-body-mib, max-message-bytes)",
     "höchstens {} Byte werden hier angenommen (http-max-body-mib, max-message-bytes)"},
    {"requests and views take all the memory the setting http-max-memory-mib allows; try again "
     "later",
     "Anfragen und Ansichten nehmen allen Speicher ein, den die Einstellung http-max-memory-mib "
     "erlaubt; später noch einmal versuchen"},
    {"requests of this address take all the memory the setting http-max-memory-per-peer-mib "
     "allows; try again later",
     "Anfragen dieser Adresse nehmen allen Speicher ein, den die Einstellung "
     "http-max-memory-per-peer-mib erlaubt; später noch einmal versuchen"},
    {"The content type is not taken here", "Dieser Content-Type wird hier nicht angenommen"},
    {"The body must be JSON", "Der Inhalt muss JSON sein"},
    {"send a {} as application/json", "eine Nachricht {} als application/json senden"},
    {"The body must be NC text", "Der Inhalt muss NC-Text sein"},
    {"send it as text/plain; charset=utf-8", "ihn als text/plain; charset=utf-8 senden"},
    {"The body is no {}", "Der Inhalt ist kein {}"},
    // Parameters.
    {"A query parameter cannot be taken", "Ein Parameter der Adresse ist nicht möglich"},
    {"A query parameter is no setting that can be taken",
     "Ein Parameter der Adresse ist keine mögliche Einstellung"},
    {"{}: is no UTF-8", "{}: ist kein UTF-8"},
    {"there are {} parameters, at most {} are taken",
     "es sind {} Parameter, höchstens {} werden angenommen"},
    {"{}: takes a whole number", "{}: muss eine ganze Zahl sein"},
    {"{}: takes a number from 0 to 1", "{}: muss eine Zahl von 0 bis 1 sein"},
    {"{}: is not known: there are no parameters here",
     "{}: ist nicht bekannt: Parameter gibt es hier keine"},
    {"{}: is not known: there are {}", "{}: ist nicht bekannt: es gibt {}"},
    {"{}: it takes {}", "{}: möglich sind {}"},
    {"unknown setting {}; nearest: {}", "unbekannte Einstellung {}; am ähnlichsten: {}"},
    // Connect.
    {"this RPC takes {}, not compressed", "dieser RPC nimmt {}, nicht komprimiert"},
    {"application/json or application/proto", "application/json oder application/proto"},
    {"application/connect+json or application/connect+proto",
     "application/connect+json oder application/connect+proto"},
    {"the call takes no query parameters, but a message",
     "der Aufruf nimmt keine Parameter in der Adresse, sondern eine Nachricht"},
    {"Connect-Protocol-Version must be 1", "Connect-Protocol-Version muss 1 sein"},
    {"the body must be one envelope without compression",
     "der Inhalt muss ein Umschlag ohne Komprimierung sein"},
    {"it must be a {}", "es muss ein {} sein"},
    // Paths of blocks.
    {"The path is too large", "Die Bahn ist zu groß"},
    {"it takes {} bytes, at most {} are taken (max-message-bytes); divide the path, send it as an "
     "NC program, or stream it with gRPC",
     "sie ist {} Byte groß, höchstens {} werden angenommen (max-message-bytes); die Bahn teilen, "
     "sie als NC-Programm senden oder mit gRPC übertragen"},
    {"The path has no block", "Die Bahn hat keinen Satz"},
    {"give its blocks in batch.blocks or in columns",
     "ihre Sätze in batch.blocks oder in columns angeben"},
    {"it has {} blocks, at most {} are taken (max-blocks-per-batch); divide the path, send it as "
     "an "
     "NC program, or stream it with gRPC",
     "sie hat {} Sätze, höchstens {} werden angenommen (max-blocks-per-batch); die Bahn teilen, "
     "sie "
     "als NC-Programm senden oder mit gRPC übertragen"},
    // Views.
    {"the view takes more memory than the setting http-max-memory-mib leaves; close other views or "
     "try again later",
     "die Ansicht braucht mehr Speicher, als die Einstellung http-max-memory-mib übrig lässt; "
     "andere Ansichten schließen oder es später noch einmal versuchen"},
    {"the compensated text takes more memory than the setting http-max-memory-mib leaves; get it "
     "with POST /v1/programs:compensate, which sends it while it is made",
     "der korrigierte Text braucht mehr Speicher, als die Einstellung http-max-memory-mib übrig "
     "lässt; mit POST /v1/programs:compensate holen, das ihn sendet, während er entsteht"},
    {"There is no such view", "Diese Ansicht gibt es nicht"},
    {"views are given up when there are too many or after a while; make a new one",
     "Ansichten werden aufgegeben, wenn es zu viele sind oder nach einer Weile; eine neue anlegen"},
    {"There is no such tile", "Diese Kachel gibt es nicht"},
    {"levels and tiles are counted from 0", "Stufen und Kacheln zählen ab 0"},
});

std::string german(std::string_view english) {
  return translated(english, {refusal_sentences(), wire::setting_sentences(), sentences});
}

}  // namespace

void make_german(v1::Problem& problem) {
  problem.set_title(german(problem.title()));
  problem.set_detail(german(problem.detail()));
  for (v1::FieldProblem& field : *problem.mutable_fields()) {
    const bool is_detail = problem.detail() == field.field() + " " + field.description();
    // The sentence patterns begin with the field.
    const std::string begin = field.field() + ": ";
    const std::string sentence = german(begin + field.description());
    const bool is_known = sentence != begin + field.description() && sentence.starts_with(begin);
    field.set_description(is_known ? sentence.substr(begin.size()) : german(field.description()));
    if (is_detail) problem.set_detail(field.field() + " " + field.description());
  }
}

}  // namespace trc::server::http

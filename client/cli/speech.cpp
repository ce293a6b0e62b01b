#include "client/cli/speech.h"

#include <array>
#include <iostream>

#include "client/cli/printable.h"
#include "core/messages/sentences.h"
#include "proto/wire/setting_sentences.h"
#include "server/rpc/status.h"

namespace trc::cli {
namespace {

Language spoken = Language::english;  // set by main() before any output

// Bytes of a complaint: a server may send a message of any length.
constexpr std::size_t longest = 4000;

constexpr auto rows = std::to_array<Sentence>({
    // Faults of a call.
    {"there is no command {}; did you mean {}?", "es gibt keinen Befehl {}; ist {} gemeint?"},
    {"there is no command {}; commands are {}", "es gibt keinen Befehl {}; Befehle sind {}"},
    {"{}: there is no option {}; did you mean {}?", "{}: es gibt keine Option {}; ist {} gemeint?"},
    {"{}: there is no option {}; {} --help lists all",
     "{}: es gibt keine Option {}; alle nennt {} --help"},
    {"say what to do: commands are {}", "es fehlt, was zu tun ist: Befehle sind {}"},
    {"Run {} --help for more information.", "Mehr sagt {} --help."},
    {"FILE or --record is required", "FILE oder --record muss angegeben werden"},
    {"{} is required", "{} muss angegeben werden"},
    {"{}: File does not exist: {}", "{}: die Datei gibt es nicht: {}"},
    {"{}: File is actually a directory: {}", "{}: die Datei ist ein Verzeichnis: {}"},
    {"{}: Path does not exist: {}", "{}: das gibt es nicht: {}"},
    {"{}: Value {} not in range {} to {}", "{}: der Wert {} liegt nicht zwischen {} und {}"},
    {"{} is {}, which is no number", "{} ist {}, und das ist keine Zahl"},
    {"{}: {} is no number; write {}, with a decimal point",
     "{}: {} ist keine Zahl; {} schreiben, mit Dezimalpunkt"},
    {"{}: {} is no number", "{}: {} ist keine Zahl"},
    {"{}: its value is empty", "{}: der Wert ist leer"},
    {"{}: it takes {}", "{}: möglich sind {}"},
    {"{}: {} not in {{}}; did you mean {}?", "{}: {} gehört nicht zu {{}}; ist {} gemeint?"},
    {"{}: {} not in {{}}", "{}: {} gehört nicht zu {{}}"},
    {"{}: {} required {} missing", "{}: es fehlen Angaben ({} × {})"},
    {"{}: At Most {} required but received {}", "{}: höchstens {} erlaubt, angegeben sind {}"},
    {"{} requires {}", "{} gilt nur mit {}"},
    {"{} excludes {}", "{} gilt nicht zusammen mit {}"},
    {"The following argument was not expected: {}", "dieses Argument ist zu viel: {}"},
    {"The following arguments were not expected: {}", "diese Argumente sind zu viel: {}"},
    {"{}: several programs need --output-dir, where their results go",
     "{}: mehrere Programme brauchen --output-dir, wohin die Ergebnisse gehen"},
    {"{}: warning: nothing is compensated: no G41, G42 (RL, RR) with a radius",
     "{}: Warnung: nichts wird korrigiert: kein G41, G42 (RL, RR) mit einem Radius"},
    {"there is no code {}; trc explain lists all",
     "es gibt keinen Code {}; trc explain nennt alle"},
    // Settings in the spelling of the command line.
    {"--radii: {}", "--radii: {}"},
    {"--variable: {}", "--variable: {}"},
    {"--set: {} (all of them: trc compensate --help)", "--set: {} (alle: trc compensate --help)"},
    {"--set: {}", "--set: {}"},
    {"{}: {} has an option of its own: write {}", "{}: {} hat eine eigene Option: {} schreiben"},
    {"note: the environment variable {} is not read; did you mean {}?",
     "Hinweis: die Umgebungsvariable {} wird nicht gelesen; ist {} gemeint?"},
    {"unknown setting {}; nearest: {}", "unbekannte Einstellung {}; am ähnlichsten: {}"},
    // Tables of tools and subprograms.
    {"--tools: {}", "--tools: {}"},
    {"--listen {}: the page is for this machine alone; trcd --http-listen serves others",
     "--listen {}: die Seite ist nur für diesen Rechner da; anderen dient trcd --http-listen"},
    {"note: the radii of {} are read in mm, as the file names no unit, though the program counts "
     "in inch; a first line unit,inch or a column unit of a CSV says otherwise, --unit inch of "
     "other tables",
     "Hinweis: die Radien von {} werden in mm gelesen, da die Datei keine Einheit nennt, obwohl "
     "das Programm in Zoll rechnet; anders sagt es eine erste Zeile unit,inch oder eine Spalte "
     "unit einer CSV, --unit inch bei anderen Tabellen"},
    {"--wear is of the tool of --radius: tools of a table have a wear of their own",
     "--wear gilt dem Werkzeug von --radius: Werkzeuge einer Tabelle haben ihren eigenen "
     "Verschleiß"},
    {"R has no decimal point: say what it counts in with --whole-numbers",
     "R hat keinen Dezimalpunkt: mit --whole-numbers sagen, worin es zählt"},
    {"note: radii and wear of --radius, --wear and --set are in mm, though the program counts in "
     "inch: 0.25 inch are 6.35",
     "Hinweis: Radien und Verschleiß von --radius, --wear und --set gelten in mm, obwohl das "
     "Programm in Zoll rechnet: 0.25 Zoll sind 6.35"},
    {"{}: line {}: {}", "{}: Zeile {}: {}"},
    {"it is text in UTF-16; save it as CSV UTF-8",
     "sie ist Text in UTF-16; als CSV UTF-8 speichern"},
    {"{}: it is text in UTF-16; save it as CSV UTF-8",
     "{}: ist Text in UTF-16; als CSV UTF-8 speichern"},
    {"{}: {} more line is wrong", "{}: {} weitere Zeile ist falsch"},
    {"{}: {} more lines are wrong", "{}: {} weitere Zeilen sind falsch"},
    {"it names no tool with a radius", "sie nennt kein Werkzeug mit einem Radius"},
    {"{}: it names no tool with a radius", "{}: nennt kein Werkzeug mit einem Radius"},
    {"{} has wear, but no radius", "{} hat Verschleiß, aber keinen Radius"},
    {"tool {}, edge {}", "Werkzeug {}, Schneide {}"},
    {"{} a second time", "{} ein zweites Mal"},
    {"tool {}", "Werkzeug {}"},
    {"column {}", "Spalte {}"},
    {"unit is {}, not mm or inch", "unit ist {}, nicht mm oder inch"},
    {"{} is no number of a tool", "{} ist keine Nummer eines Werkzeugs"},
    {"{} is no row of a table of tools; a CSV begins with a header such as number,radius",
     "{} ist keine Zeile einer Werkzeugtabelle; eine CSV beginnt mit einem Kopf wie "
     "number,radius"},
    {"{} has no number directly after it", "hinter {} fehlt die Zahl"},
    {"{} has no letter before it", "vor {} fehlt der Buchstabe"},
    {"{} names no tool, as in wz[1].radius", "{} nennt kein Werkzeug, wie in wz[1].radius"},
    {"{} is {}, which is no whole number", "{} ist {}, und das ist keine ganze Zahl"},
    {"{}.mass_einheit is neither 0 (mm) nor 1 (inch)",
     "{}.mass_einheit ist weder 0 (mm) noch 1 (Zoll)"},
    {"{} has a radius for each path, and one is read",
     "{} hat einen Radius je Pfad, und nur einer wird gelesen"},
    {"{} has another number by its tool_id: give such tools as a CSV",
     "{} hat durch seine tool_id eine andere Nummer: solche Werkzeuge als CSV angeben"},
    {"{} is no word of a table of LinuxCNC", "{} ist kein Wort einer Tabelle von LinuxCNC"},
    {"whether a line with the block skip / counts is not known: remove the / or the line",
     "ob ein ausblendbarer Satz (/) gilt, ist nicht bekannt: das / oder die Zeile entfernen"},
    {"G10 L12 and G10 L13 need P and R", "G10 L12 und G10 L13 brauchen P und R"},
    {"{} names no tool and edge, as in {}", "{} nennt kein Werkzeug mit Schneide, wie in {}"},
    {"it has more values than the header; decimals have a point, or semicolons stand between the "
     "values",
     "sie hat mehr Werte als der Kopf; Dezimalstellen haben einen Punkt, oder zwischen den Werten "
     "stehen Semikolons"},
    {"its first line has neither MM nor INCH after the name of the table",
     "nach dem Namen der Tabelle steht weder MM noch INCH"},
    {"the table has no column {}", "die Tabelle hat keine Spalte {}"},
    {"it has tabs, and columns are found by their place: replace each with blanks, or make it a "
     "CSV",
     "sie enthält Tabulatoren, und Spalten werden an ihrer Lage erkannt: jeden durch Leerzeichen "
     "ersetzen, oder eine CSV daraus machen"},
    {"its values do not begin below the name of column {}: restore the blanks between the columns, "
     "or make it a CSV",
     "ihre Werte beginnen nicht unter dem Namen der Spalte {}: die Leerzeichen zwischen den "
     "Spalten wiederherstellen, oder eine CSV daraus machen"},
    {"unknown column {}; a table may have number, radius, diameter, wear, name, edge, holds, unit",
     "unbekannte Spalte {}; eine Tabelle kann number, radius, diameter, wear, name, edge, holds, "
     "unit haben"},
    {"a quotation mark is not closed in its line",
     "ein Anführungszeichen ist in seiner Zeile nicht geschlossen"},
    {"after the closing quotation mark of {} more of the cell follows",
     "nach dem schließenden Anführungszeichen von {} geht die Zelle weiter"},
    {"{} stands in a column that has no name; decimals have a point, or semicolons stand between "
     "the values",
     "{} steht in einer Spalte ohne Namen; Dezimalstellen haben einen Punkt, oder zwischen den "
     "Werten stehen Semikolons"},
    {"the header needs number or name, and one of radius, diameter",
     "der Kopf braucht number oder name, und radius oder diameter"},
    {"edge is {}, which is none", "edge ist {}, und das ist keine Schneide"},
    {"holds is {}, not RADIUS or DIAMETER", "holds ist {}, nicht RADIUS oder DIAMETER"},
    {"the tool has neither number nor name", "das Werkzeug hat weder Nummer noch Namen"},
    {"--subprograms: {} cannot be read", "--subprograms: {} lässt sich nicht lesen"},
    {"--subprograms: {} is no NC text", "--subprograms: {} ist kein NC-Text"},
    {"--subprograms: more than 900 KiB; name the files that the program calls",
     "--subprograms: mehr als 900 KiB; die Dateien nennen, die das Programm aufruft"},
    // Files.
    {"cannot read standard input: {}", "die Standardeingabe lässt sich nicht lesen: {}"},
    {"cannot read {}: {}", "{} lässt sich nicht lesen: {}"},
    {"cannot read {}", "{} lässt sich nicht lesen"},
    {"cannot write standard output: {}", "die Standardausgabe lässt sich nicht schreiben: {}"},
    {"cannot write standard output", "die Standardausgabe lässt sich nicht schreiben"},
    {"cannot hold back {}: {}", "{} lässt sich nicht zurückhalten: {}"},
    {"cannot write {}: {}", "{} lässt sich nicht schreiben: {}"},
    {"cannot make {}: {}", "{} lässt sich nicht anlegen: {}"},
    {"-o {}: the name must end in .svg or .html, or --format must say which it is",
     "-o {}: der Name muss auf .svg oder .html enden, oder --format muss es sagen"},
    {"--picture {}: the name must end in .svg", "--picture {}: der Name muss auf .svg enden"},
    {"-o {} is the program itself; write another file, or say --force",
     "-o {} ist das Programm selbst; eine andere Datei schreiben, oder --force angeben"},
    {"{} is the program itself; write another file",
     "{} ist das Programm selbst; eine andere Datei schreiben"},
    {"{} is the table of --tools; write another file",
     "{} ist die Tabelle von --tools; eine andere Datei schreiben"},
    {"{} is a file of --subprograms; write another file",
     "{} ist eine Datei von --subprograms; eine andere Datei schreiben"},
    {"{} is the file of {}; write another file",
     "{} ist die Datei von {}; eine andere Datei schreiben"},
    {"--to writes an NC program: leave out --format {}",
     "--to schreibt ein NC-Programm: --format {} weglassen"},
    {"{} has {} blocks of contour and path, a page holds {}; use trc view, or write .svg",
     "{} hat {} Sätze an Kontur und Bahn, eine Seite fasst {}; trc view nehmen, oder .svg "
     "schreiben"},
    {"{} is given twice; its results would have one name",
     "{} ist zweimal angegeben; die Ergebnisse hätten denselben Namen"},
    {"{}: error: --to {} does not convert {} (line {} of the compensated program)",
     "{}: Fehler: --to {} setzt {} nicht um (Zeile {} des korrigierten Programms)"},
    {"{}, the length of a tool without its T", "{}, die Länge eines Werkzeugs ohne sein T,"},
    {"{}, the length of another tool than the one loaded",
     "{}, die Länge eines anderen Werkzeugs als des eingewechselten,"},
    {"{} without the length of tool {}", "{} ohne die Länge von Werkzeug {}"},
    {"a line of {} characters, of which the control takes {}",
     "eine Zeile von {} Zeichen, von denen die Steuerung {} nimmt"},
    {"a number of {} digits, of which the control takes {}",
     "eine Zahl von {} Stellen, von denen die Steuerung {} nimmt"},
    {"G43 without the number of a tool", "G43 ohne Werkzeugnummer"},
    {"M6 without a tool", "M6 ohne Werkzeug"},
    {"TOOL CALL without a tool", "TOOL CALL ohne Werkzeug"},
    {"a feed that is no number per minute", "einen Vorschub, der keine Zahl je Minute ist,"},
    {"{} with the length of a tool", "{} mit der Länge eines Werkzeugs"},
    {"{} in an arc", "{} in einem Bogen"},
    {"{} of TOOL CALL", "{} von TOOL CALL"},
    {"{}, a third tool of its line", "{}, ein drittes Werkzeug der Zeile,"},
    {"G50 with S, a limit of the speed", "G50 mit S, eine Grenze der Drehzahl,"},
    {"{}, a way round", "{}, einen Drehsinn,"},
    {"{} would be written over the program itself", "{} würde das Programm selbst überschreiben"},
    {"{} would be written over the table of --tools",
     "{} würde die Tabelle von --tools überschreiben"},
    {"{} would be written over a file of --subprograms",
     "{} würde eine Datei von --subprograms überschreiben"},
    {"{}: no process can be started for it", "{}: dafür lässt sich kein Prozess starten"},
    {"{}: the process was ended by signal {}", "{}: der Prozess wurde durch Signal {} beendet"},
    // The table of a folder; its columns are as wide as in English.
    {"not begun", "offen"},
    {"unchanged", "unverändert"},
    {"done", "fertig"},
    {"refused", "abgelehnt"},
    {"failed", "gescheitert"},
    {"interrupted", "abgebrochen"},
    {"{} blocks, clearance {} of {} mm, {} warnings",
     "{} Sätze, Abstand {} von {} mm, {} Warnungen"},
    {"{} blocks, clearance {} of {} mm", "{} Sätze, Abstand {} von {} mm"},
    {"{} blocks, {} warnings", "{} Sätze, {} Warnungen"},
    {"{} blocks", "{} Sätze"},
    {"error {} at line {}", "Fehler {} in Zeile {}"},
    {"error {}", "Fehler {}"},
    {"{} programs", "{} Programme"},
    // Messages of the system.
    {"No such file or directory", "die Datei oder das Verzeichnis gibt es nicht"},
    {"Permission denied", "keine Berechtigung"},
    {"Is a directory", "es ist ein Verzeichnis"},
    {"No space left on device", "kein Platz mehr auf dem Gerät"},
    {"Not a directory", "es ist kein Verzeichnis"},
    {"File exists", "die Datei gibt es schon"},
    {"Input/output error", "Ein-/Ausgabefehler"},
    // Shapes of trc generate and trc load.
    {"unknown shape {}", "unbekannte Form {}"},
    {"a {} of this tool radius has at most {} blocks",
     "{} hat bei diesem Werkzeugradius höchstens {} Sätze"},
    {"--{} {}: the server admits {} ({})", "--{} {}: der Server lässt {} zu ({})"},
    {"the core refuses this contour: {}", "der Kern lehnt diese Kontur ab: {}"},
    // Records of jobs.
    {"{}: it is no record of a job: {}", "{}: das ist kein Auftragsprotokoll: {}"},
    {"format is {}", "format ist {}"},
    {"{}: it has been changed: {}", "{}: es wurde verändert: {}"},
    {"{}: it has been changed: its own SHA-256 is not there",
     "{}: es wurde verändert: seine eigene SHA-256 fehlt"},
    {"{}: it has been changed since it was written: its SHA-256 is {}, the one in it says {}",
     "{}: es wurde verändert, seit es geschrieben wurde: seine SHA-256 ist {}, die darin ist {}"},
    {"{}: it was made by version {} ({}), this is {} ({})",
     "{}: es stammt von Version {} ({}), dies ist {} ({})"},
    {"{}: {} does not hold what came out when this record was made",
     "{}: {} enthält nicht, was herauskam, als dieses Protokoll entstand"},
    {"{} is not here: only the bytes made anew were compared",
     "{} ist nicht hier: nur die neu erzeugten Bytes wurden verglichen"},
    {"the record holds: {} bytes, SHA-256 {}, {}", "das Protokoll stimmt: {} Byte, SHA-256 {}, {}"},
    {"{}: input: SHA-256 is {} of {} bytes, the record says {} of {}",
     "{}: Programm: SHA-256 ist {} von {} Byte, im Protokoll steht {} von {}"},
    {"{}: output: SHA-256 is {} of {} bytes, the record says {} of {}",
     "{}: Ergebnis: SHA-256 ist {} von {} Byte, im Protokoll steht {} von {}"},
    {"{}: summary: {}", "{}: Zusammenfassung: {}"},
    {"{}: diagnostics: {}", "{}: Meldungen: {}"},
    {"modified: {}", "geändert: {}"},
    {"added: {}", "hinzugekommen: {}"},
    {"deleted: {}", "weggefallen: {}"},
    {"name the program: trc verify --record {} FILE",
     "das Programm nennen: trc verify --record {} FILE"},
    {"{}: outcome: {}, the record says {}", "{}: Ausgang: {}, im Protokoll steht {}"},
    // trc verify.
    {"nothing to verify: no compensated contour", "nichts zu messen: keine korrigierte Kontur"},
    {"{} blocks of the path checked, {}", "{} Sätze der Bahn gemessen, {}"},
    {"smallest clearance {} of {} at {}, path of {} beside contour block {}",
     "kleinster Abstand {} von {} bei {}, Bahn von {} neben Kontursatz {}"},
    {"the contour closes there: that is a touch, no gouge",
     "dort schließt die Kontur: das ist eine Berührung, keine Konturverletzung"},
    {"the path touches {} of {} of wall", "die Bahn berührt {} von {} Wand"},
    {"  {} mm {}: {} stretch, the longest {} of {}",
     "  {} mm {}: {} Strecke, die längste {} von {}"},
    {"  {} mm {}: {} stretches, the longest {} of {}",
     "  {} mm {}: {} Strecken, die längste {} von {}"},
    {"  {} in {}: {} stretch, the longest {} of {}",
     "  {} in {}: {} Strecke, die längste {} von {}"},
    {"  {} in {}: {} stretches, the longest {} of {}",
     "  {} in {}: {} Strecken, die längste {} von {}"},
    {"lie in inside corners, into which a round tool does not reach",
     "liegen in Innenecken, in die ein rundes Werkzeug nicht reicht"},
    {"are left out or passed by, as the tool has no room there",
     "sind ausgelassen oder umgangen, weil das Werkzeug dort keinen Platz hat"},
    {"have the path farther away than the tool radius",
     "haben die Bahn weiter entfernt als den Werkzeugradius"},
    {"{}: gouge: {} block comes nearer to the contour than the tool radius, {}",
     "{}: Konturverletzung: {} Satz kommt der Kontur näher als der Werkzeugradius, {}"},
    {"{}: gouge: {} blocks come nearer to the contour than the tool radius, {}",
     "{}: Konturverletzung: {} Sätze kommen der Kontur näher als der Werkzeugradius, {}"},
    {"{}: the approach or the retract leads through the contour at line {}",
     "{}: der An- oder Abfahrweg führt in Zeile {} durch die Kontur"},
    {"{} (line {})", "{} (Zeile {})"},
    {"line {}", "Zeile {}"},
    // trc info FILE.
    {"dialect: {}, but it is DIN/ISO of Heidenhain, which is not read",
     "Dialekt: {}, es ist aber DIN/ISO von Heidenhain, das nicht gelesen wird"},
    {"dialect: {}, but it looks like {}", "Dialekt: {}, sieht aber aus wie {}"},
    {"dialect: {}", "Dialekt: {}"},
    {"unit: inch", "Maßeinheit: Zoll"},
    {"unit: {}", "Maßeinheit: {}"},
    {"tools of the program (line): {}", "Werkzeuge des Programms (Zeile): {}"},
    {"passed on (line): {}", "durchgereicht (Zeile): {}"},
    {"computes: yes, {} line executed", "rechnet: ja, {} Zeile ausgeführt"},
    {"computes: yes", "rechnet: ja"},
    {"lines: {}, read up to {}", "Zeilen: {}, gelesen bis {}"},
    {"lines: {}", "Zeilen: {}"},
    {"computes: yes, {} lines executed", "rechnet: ja, {} Zeilen ausgeführt"},
    {"selections before the fault: {}, {} blocks, {}", "Anwahlen vor dem Fehler: {}, {} Sätze, {}"},
    {"tools: none are given, so that nothing is said of what fits",
     "Werkzeuge: keine angegeben, so dass nichts darüber gesagt wird, was passt"},
    {"selections: {}, {} blocks, {}", "Anwahlen: {}, {} Sätze, {}"},
    {"refused:", "abgelehnt:"},
    {"nothing to refuse", "nichts abzulehnen"},
    {"to look at:", "zu beachten:"},
    // Servers and limits.
    {"serving", "nimmt Arbeit an"},
    {"not serving", "nimmt keine Arbeit an"},
    {"the server at {} is there, but shuts down and takes no new programs",
     "der Server {} ist da, fährt aber herunter und nimmt keine neuen Programme"},
    {"the server at {} does not let this client in", "der Server {} lässt diesen Client nicht ein"},
    {"lost the connection to the server at {}; the path is not complete",
     "die Verbindung zum Server {} ging verloren; die Bahn ist nicht vollständig"},
    {"lost the connection to the server; the path is not complete",
     "die Verbindung zum Server ging verloren; die Bahn ist nicht vollständig"},
    {"cannot reach a server at {}; is trcd running there, and do the --tls files fit?",
     "kein Server unter {} erreichbar; läuft dort trcd, und passen die Dateien von --tls?"},
    {"cannot reach a server at {}: its certificate is not one that --tls-ca vouches for",
     "kein Server unter {} erreichbar: für sein Zertifikat bürgt --tls-ca nicht"},
    {"cannot reach a server at {}: its certificate is for another name",
     "kein Server unter {} erreichbar: sein Zertifikat gilt einem anderen Namen"},
    {"cannot reach a server at {}: nobody knows that name",
     "kein Server unter {} erreichbar: diesen Namen kennt niemand"},
    {"cannot reach a server at {}: nothing listens there; is trcd running?",
     "kein Server unter {} erreichbar: dort horcht nichts; läuft trcd?"},
    {"cannot reach a server at {}: what listens there closes the connection: with --tls-ca it may "
     "speak without TLS, without --tls-ca with TLS, and without --tls-cert it may ask for one",
     "kein Server unter {} erreichbar: was dort horcht, schließt die Verbindung: mit --tls-ca "
     "spricht es vielleicht ohne TLS, ohne --tls-ca mit TLS, und ohne --tls-cert fragt es "
     "vielleicht danach"},
    {"{}: '{}' holds no certificate", "{}: '{}' enthält kein Zertifikat"},
    {"{}: '{}' holds no key without pass phrase",
     "{}: '{}' enthält keinen Schlüssel ohne Passwort"},
    {"{}: '{}' does not belong to '{}'", "{}: '{}' gehört nicht zu '{}'"},
    {"the server at {} shuts down; waiting for up to {} s (--wait)",
     "der Server {} fährt herunter; bis zu {} s wird gewartet (--wait)"},
    {"the server at {} has no room now: {}; waiting for up to {} s (--wait)",
     "der Server {} hat gerade keinen Platz: {}; bis zu {} s wird gewartet (--wait)"},
    // As the shipped HAProxy says it (deploy/haproxy/h2.cfg).
    {"this address has as many open calls as the balancer allows; try again later",
     "von dieser Adresse sind so viele Aufrufe offen, wie der Balancer erlaubt; später noch einmal "
     "versuchen"},
    {"the server at {} was lost, and the one there now cannot go on: it was started anew, or has "
     "another resume-key-file or version; run it again",
     "der Server {} ging verloren, und der jetzige kann nicht weitermachen: er wurde neu gestartet "
     "oder hat eine andere resume-key-file oder Version; noch einmal aufrufen"},
    {"the server at {} was lost; waiting for up to {} s (--wait)",
     "der Server {} ging verloren; bis zu {} s wird gewartet (--wait)"},
    {"--memory-limit-mib, --max-session-memory-mib and --max-blocks-per-selection are of a run in "
     "this process; a server has limits of its own (trc info --server)",
     "--memory-limit-mib, --max-session-memory-mib und --max-blocks-per-selection gelten für einen "
     "Lauf in diesem Prozess; ein Server hat eigene Grenzen (trc info --server)"},
    {"a client certificate and its key belong together",
     "ein Client-Zertifikat und sein Schlüssel gehören zusammen"},
    {"in a list of servers {} must be an IP address and a port",
     "in einer Liste von Servern muss {} eine IP-Adresse mit Port sein"},
    {"{} mixes IPv4 and IPv6", "{} mischt IPv4 und IPv6"},
    {"{}: {} is no port: write a number from 1 to 65535",
     "{}: {} ist kein Port: eine Zahl von 1 bis 65535 schreiben"},
    {"{} has no port: write {}", "{} hat keinen Port: {} schreiben"},
    {"with TLS give one name that stands for all servers, dns:///NAME:PORT: {} has none their "
     "certificates could be checked against",
     "mit TLS einen Namen angeben, der für alle Server steht, dns:///NAME:PORT: {} hat keinen, an "
     "dem sich ihre Zertifikate prüfen ließen"},
    {"listen: {} is not HOST:PORT", "listen: {} ist nicht HOST:PORT"},
    {"http-listen: {} is not HOST:PORT", "http-listen: {} ist nicht HOST:PORT"},
    {"http-listen: {} can be reached by other machines; give tls-cert-file and tls-key-file, or "
     "allow plain text with insecure-http",
     "http-listen: {} ist von anderen Rechnern erreichbar; tls-cert-file und tls-key-file angeben, "
     "oder Klartext mit insecure-http erlauben"},
    {"the program needs more memory than this run may take; raise --max-session-memory-mib or "
     "--memory-limit-mib, or hold less: --set look_ahead_blocks=10000 --set verify=off",
     "das Programm braucht mehr Speicher, als dieser Lauf nehmen darf; --max-session-memory-mib "
     "oder --memory-limit-mib anheben, oder weniger halten: --set look_ahead_blocks=10000 --set "
     "verify=off"},
    {"there is not enough memory for this program",
     "für dieses Programm reicht der Speicher nicht"},
    {"internal error: {}", "innerer Fehler: {}"},
});

std::string in_german(std::string_view english) {
  return translated(english, {server::refusal_sentences(), wire::setting_sentences(), rows});
}

}  // namespace

void speak(Language language) { spoken = language; }

Language spoken_language() { return spoken; }

std::string told(std::string_view english) {
  return spoken == Language::german ? in_german(english) : std::string(english);
}

void complain(std::string_view english) {
  std::cerr << "trc: " << printable(told(english), longest) << '\n';
}

}  // namespace trc::cli
